// SPDX-License-Identifier: MIT
// lqgen: the command line. One design file in; header, test, JSON and report out, or a clear refusal and nothing.
// `check` designs and writes nothing; `new` writes a design file to begin with; `simulate` runs its scenarios; `run`
// runs the controller by a pipe; `watch` serves a live page of a design; `compare` writes a page of several.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "commands/check.hpp"
#include "commands/new.hpp"
#include "commands/orders.hpp"
#include "commands/run.hpp"
#include "commands/simulate.hpp"
#include "emit/c/batch.hpp"
#include "emit/c/header.hpp"
#include "emit/text/wording.hpp"
#include "emit/report/json.hpp"
#include "emit/plan/plan.hpp"
#include "emit/proof/proof.hpp"
#include "emit/report/report.hpp"
#include "emit/report/summary.hpp"
#include "emit/text/files.hpp"
#include "emit/text/sha256.hpp"
#include "emit/unit_test/unit_test.hpp"
#include "design/number_memory.hpp"
#include "design/orders.hpp"
#include "design/solve.hpp"
#include "input/design_file.hpp"
#include "input/keys.hpp"
#include "input/text.hpp"
#include "reference/documents.hpp"
#include "view/compare.hpp"
#include "view/watch.hpp"
#include "watch.hpp"

namespace {

using namespace lqg;

enum Exit { written = 0, impossible = 1, wrong = 2, unreadable = 3 };

struct Arguments {
  std::string design_file;
  bool wants_json = false;  // of `check`
  bool wants_orders = false;
  std::string folder = ".";
  std::vector<std::string> only = {"h", "test", "json", "html"};
  std::string style, real;
  std::vector<std::string> settings;  // "R=2.5"
  bool quiet = false;
  std::optional<unsigned> time_limit;  // s
};

bool wants(const Arguments& arguments, const char* what) {
  return std::find(arguments.only.begin(), arguments.only.end(), what) != arguments.only.end();
}

// The design file as messages and headers name it.
std::string shown_path(const Arguments& arguments) {
  return arguments.design_file == "-" ? "standard input" : arguments.design_file;
}

input::Settings settings_of(const Arguments& arguments) {
  input::Settings settings;
  for (const std::string& text : arguments.settings)
    if (const auto setting = input::setting_of(text)) settings.push_back(*setting);
  return settings;
}

// What is wrong with a text that is no setting; else nothing.
std::string refuse_setting(const std::string& text) {
  return input::setting_of(text) ? "" : "expected NAME=VALUE, found " + input::in_quotes(text);
}

void report(const Arguments& arguments, const input::DesignFile& file, const design::Findings& findings) {
  for (const design::Finding& finding : findings)
    if (finding.severity == design::Severity::error || !arguments.quiet)
      std::cerr << input::format(shown_path(arguments), input::locate(file, finding.key), finding) << "\n";
}

void override_code(const Arguments& arguments, design::Code& code) {
  if (arguments.style == "unrolled") code.style = design::Style::unrolled;
  if (arguments.style == "compact") code.style = design::Style::compact;
  if (arguments.style == "auto") code.style = design::Style::automatic;
  if (arguments.real == "float") code.real = design::Scalar::float32;
  if (arguments.real == "double") code.real = design::Scalar::float64;
}

std::vector<emit::File> files(const Arguments& arguments, const emit::Controller& controller,
                              const design::Findings& findings) {
  const std::string& name = controller.problem.name;
  std::vector<emit::File> out;
  if (wants(arguments, "h")) out.push_back({name + ".h", emit::header(controller)});
  if (wants(arguments, "test")) out.push_back({name + "_test.c", emit::unit_test(controller)});
  if (wants(arguments, "json")) out.push_back({name + ".json", emit::json(controller)});
  if (wants(arguments, "proof")) out.push_back({name + "_proof.h", emit::proof(controller)});
  if (wants(arguments, "batch")) out.push_back({name + "_batch.h", emit::batch_header(controller)});
  if (wants(arguments, "html")) out.push_back({name + ".html", emit::report(controller, findings)});
  return out;
}

// A design that is called NAME.json would otherwise be lost.
bool overwrites_design(const Arguments& arguments, const std::vector<emit::File>& files) {
  const std::filesystem::path folder = arguments.folder;
  std::error_code ignored;
  for (const emit::File& file : files)
    if (std::filesystem::equivalent(arguments.design_file, folder / file.name, ignored)) return true;
  return false;
}

void show_summary(const Arguments& arguments, const emit::Controller& controller) {
  if (!arguments.quiet && ::isatty(STDOUT_FILENO)) std::cout << emit::summary(controller);
}

// What the design is held against.
enum class Requires { all, nothing };

// The controller of the file; none where the findings, which are printed, say why not: then `status` is set. `findings`
// are those of the design.
std::optional<emit::Controller> controller_of(const Arguments& arguments, const input::DesignFile& file,
                                              Requires wanted, Watch& watch, int& status, design::Findings& findings) {
  report(arguments, file, file.findings);
  status = !file.readable ? unreadable : wrong;
  if (!file.problem || design::has_error(file.findings)) return std::nullopt;

  design::Problem problem = *file.problem;
  override_code(arguments, problem.code);
  if (wanted == Requires::nothing) problem = design::without_requirements(problem);
  std::optional<design::Solution> solution =
      design::solve(problem, findings, [&](const std::string& work) { watch.show(work); });
  std::optional<emit::Controller> controller;
  if (solution && !design::has_error(findings)) {
    const std::string file_name = shown_path(arguments) == arguments.design_file
                                      ? std::filesystem::path(arguments.design_file).filename().string()
                                      : shown_path(arguments);
    controller =
        emit::make_controller(std::move(problem), std::move(*solution), {file_name, emit::sha256(file.text)}, findings);
  }
  watch.clear();
  input::sort_by_place(file, findings);
  report(arguments, file, findings);
  status = controller ? written : impossible;
  if (controller) controller->problem.requirements = file.problem->requirements;
  return controller;
}

std::optional<emit::Controller> design_controller(const Arguments& arguments, Watch& watch, int& status,
                                                  design::Findings& findings) {
  return controller_of(arguments, input::read_design_file(arguments.design_file, settings_of(arguments)), Requires::all,
                       watch, status, findings);
}

// `lqgen check`: nothing is written but to the terminal.
int check(const Arguments& arguments) {
  Watch watch(shown_path(arguments), arguments.quiet, arguments.time_limit);
  const input::DesignFile file = input::read_design_file(arguments.design_file, settings_of(arguments));
  design::Findings findings;
  int status = written;
  const std::optional<emit::Controller> controller =
      controller_of(arguments, file, Requires::all, watch, status, findings);
  watch.end();
  if (arguments.wants_json) {
    findings.insert(findings.begin(), file.findings.begin(), file.findings.end());
    std::cout << commands::check_json(status, file, findings, controller ? &*controller : nullptr);
  } else if (controller) {
    show_summary(arguments, *controller);
  }
  return status;
}

int generate(const Arguments& arguments) {
  Watch watch(shown_path(arguments), arguments.quiet, arguments.time_limit);
  int status = written;
  design::Findings findings;
  const std::optional<emit::Controller> controller = design_controller(arguments, watch, status, findings);
  if (!controller) return status;
  if (const auto why = wants(arguments, "batch") ? emit::why_no_batch(*controller) : std::nullopt) {
    watch.end();
    std::cerr << input::printable(shown_path(arguments)) << ": --only batch: " << *why << "\n";
    return impossible;
  }

  watch.show("code, test and report");
  const std::vector<emit::File> outputs = files(arguments, *controller, findings);
  watch.end();
  if (overwrites_design(arguments, outputs)) {
    std::cerr << input::printable(arguments.design_file)
              << ": expected a design file that is not one of the outputs; rename it, or choose another folder "
                 "with -o\n";
    return wrong;
  }
  if (const auto failure = emit::write_all(arguments.folder, outputs)) {
    std::cerr << input::printable(*failure) << "\n";
    return unreadable;
  }
  show_summary(arguments, *controller);
  return written;
}

// `lqgen --orders`: a table on standard output, and no file.
int show_orders(const Arguments& arguments) {
  Watch watch(shown_path(arguments), arguments.quiet, arguments.time_limit);
  const input::DesignFile file = input::read_design_file(arguments.design_file, settings_of(arguments));
  report(arguments, file, file.findings);
  if (!file.readable) return unreadable;
  if (!file.problem || design::has_error(file.findings)) return wrong;
  design::Findings findings;
  watch.show("compensators of each order");
  const auto orders =
      design::costs_of_orders(*file.problem, findings, [&](const std::string& work) { watch.show(work); });
  watch.end();
  input::sort_by_place(file, findings);
  report(arguments, file, findings);
  if (!orders) return impossible;
  std::cout << commands::table_of_orders(*orders);
  return std::cout.flush() ? written : unreadable;
}

// `lqgen run`: samples come by standard input, which the design file can thus not come by.
int run_controller(const Arguments& arguments) {
  if (arguments.design_file == "-") {
    std::cerr << "lqgen run: expected the path of a design file, found -: standard input has the samples\n";
    return wrong;
  }
  int status = written;
  std::optional<emit::Controller> controller;
  {
    Watch watch(shown_path(arguments), arguments.quiet, arguments.time_limit);
    design::Findings findings;
    controller = design_controller(arguments, watch, status, findings);
    watch.end();
  }
  if (!controller) return status;
  const std::string why = commands::run(*controller, std::cin, std::cout);
  if (!why.empty()) std::cerr << "standard input: " << why << "\n";
  if (!std::cout) std::cerr << "standard output: cannot be written\n";
  return !why.empty() ? wrong : std::cout ? written : unreadable;
}

// False where it could not be written.
bool write_simulations(const Arguments& arguments, const commands::SimulateArguments& wanted,
                       const emit::Controller& controller, const emit::Simulations& simulations) {
  if (wanted.wants_json) {
    std::cout << emit::simulations_json(controller, simulations);
    return static_cast<bool>(std::cout.flush());
  }
  if (const auto failure = emit::write_all(arguments.folder, commands::simulation_files(controller, simulations))) {
    std::cerr << input::printable(*failure) << "\n";
    return false;
  }
  if (!arguments.quiet) std::cout << commands::simulation_lines(controller, simulations);
  return true;
}

// `lqgen simulate`: numbers on standard output, samples in files. A design that misses what [require] asks for is
// shown, too: then the status tells.
int simulate_design(const Arguments& arguments, const commands::SimulateArguments& wanted) {
  Watch watch(shown_path(arguments), arguments.quiet, arguments.time_limit);
  const input::DesignFile file = input::read_design_file(arguments.design_file, settings_of(arguments));
  design::Findings findings;
  int status = written;
  const std::optional<emit::Controller> controller =
      controller_of(arguments, file, Requires::nothing, watch, status, findings);
  if (!controller) return status;
  std::string why;
  const auto simulations = commands::run_simulations(
      *controller, wanted, [&](const std::string& work, double share) { watch.show(work, share); }, why);
  watch.end();
  if (!simulations) {
    std::cerr << "lqgen simulate: " << input::printable(why) << "\n";
    return wrong;
  }
  if (!write_simulations(arguments, wanted, *controller, *simulations)) return unreadable;
  design::Findings missed = commands::missed_requirements(*controller, *simulations);
  input::sort_by_place(file, missed);
  report(arguments, file, missed);
  return missed.empty() ? written : impossible;
}

struct NewArguments {
  std::string name, starter;
  std::string folder = ".";
};

// `lqgen new`: without --from it says what there is.
int make_new(const NewArguments& arguments) {
  if (arguments.starter.empty()) {
    std::cout << "lqgen new NAME --from STARTER writes NAME.toml, a design file to begin with:\n\n"
              << commands::list_of_starters();
    return written;
  }
  if (arguments.name.empty()) {
    std::cerr << "lqgen new: expected the name of the design, found none: lqgen new NAME --from "
              << input::printable(arguments.starter) << "\n";
    return wrong;
  }
  if (const auto why = commands::refuse_name(arguments.name)) {
    std::cerr << "lqgen new: name: " << input::printable(*why) << "\n";
    return wrong;
  }
  const auto text = commands::text_of_starter(arguments.starter, arguments.name);
  if (!text) {
    const std::string near = commands::nearest_starter(arguments.starter);
    std::cerr << "lqgen new: unknown starter `" << input::printable(arguments.starter) << "`"
              << (near.empty() ? "; lqgen new lists them" : ", did you mean `" + near + "`?") << "\n";
    return wrong;
  }
  if (const auto failure = commands::write_new(arguments.folder, arguments.name, *text)) {
    std::cerr << input::printable(*failure) << "\n";
    return unreadable;
  }
  return written;
}

int compare_designs(const view::CompareArguments& arguments) {
  Watch watch("lqgen compare", arguments.quiet, std::nullopt);
  return view::compare(arguments, [&](const std::string& work) { watch.show(work); });
}

// --NAME prints a text and ends, whatever else the command line has, as --version does. The end of the last line is
// CLI11's.
void add_printed(CLI::App& app, const std::string& name, std::string (*text)(), const std::string& help) {
  const auto print = [text] {
    std::string lines = text();
    lines.pop_back();
    throw CLI::CallForVersion(lines, written);
  };
  app.add_flag_callback(name, print, help);
}

// Says what the command line's unknown options may mean, in their order; false where there are none.
bool explain_unknown_options(const CLI::App& whole) {
  const std::vector<CLI::App*> chosen = whole.get_subcommands();
  const CLI::App& app = chosen.empty() ? whole : *chosen.front();
  std::vector<std::string> known = {"--help"};
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  bool found = false;
  for (const std::string& argument : app.remaining()) {
    if (argument.size() < 2 || argument[0] != '-') continue;
    const std::string name = argument.substr(0, argument.find('='));
    const std::string near = input::nearest_word(known, name);
    std::cerr << "lqgen: unknown option `" << input::printable(name) << "`"
              << (near.empty() ? "; lqgen --help lists them" : ", did you mean `" + near + "`?") << "\n";
    found = true;
  }
  return found;
}

// Options of all that designs.
void add_design_options(CLI::App& app, Arguments& arguments) {
  app.add_option("DESIGN", arguments.design_file, "design file (TOML); - is standard input")
      ->option_text("DESIGN.toml");
  app.add_option("--style", arguments.style, "instead of code.style of the design")
      ->check(CLI::IsMember({"unrolled", "compact", "auto"}))
      ->option_text("unrolled|compact|auto");
  app.add_option("--real", arguments.real, "instead of code.real of the design")
      ->check(CLI::IsMember({"float", "double"}))
      ->option_text("float|double");
  app.add_option("--set", arguments.settings,
                 "a number or an expression in place of a parameter's value; again for more")
      ->allow_extra_args(false)
      ->check(CLI::Validator(refuse_setting, ""))
      ->option_text("NAME=VALUE");
  app.add_option("--time-limit", arguments.time_limit, "end without a result when so many seconds have passed")
      ->check(CLI::Range(1u, 1000000u))
      ->option_text("S");
  app.add_flag("--quiet", arguments.quiet, "print nothing but errors");
}

void add_folder(CLI::App& app, std::string& folder) {
  app.add_option("-o", folder, "folder for what is written")->option_text("DIR [.]");
}

CLI::App* add_watch(CLI::App& app, view::WatchArguments& arguments) {
  CLI::App* const watch =
      app.add_subcommand("watch", "Serves a live page of a design at this machine, with sliders, until Ctrl-C.");
  watch->add_option("DESIGN", arguments.design_file, "design file (TOML), which the page follows")
      ->required()
      ->option_text("DESIGN.toml");
  watch->add_option("--port", arguments.port, "port of 127.0.0.1; without it a free one")
      ->check(CLI::Range(1u, 65535u))
      ->option_text("N");
  return watch;
}

CLI::App* add_compare(CLI::App& app, view::CompareArguments& arguments) {
  CLI::App* const comparison =
      app.add_subcommand("compare", "Writes compare.html: several designs side by side, their curves over each other.");
  comparison->add_option("DESIGNS", arguments.design_files, "two or more design files (TOML)")
      ->required()
      ->expected(2, 1000)
      ->option_text("A.toml B.toml …");
  comparison->add_flag("--quiet", arguments.quiet, "print nothing but errors");
  add_folder(*comparison, arguments.folder);
  return comparison;
}

CLI::App* add_simulate(CLI::App& app, Arguments& arguments, commands::SimulateArguments& wanted) {
  CLI::App* const command =
      app.add_subcommand("simulate", "Runs the scenarios of a design: NAME_SCENARIO.csv, and the numbers that decide.");
  add_design_options(*command, arguments);
  add_folder(*command, arguments.folder);
  command->add_option("--scenario", wanted.scenarios, "only the scenario of this name; again for more")
      ->option_text("NAME");
  const auto runs = command->add_option("--runs", wanted.runs, "a Monte Carlo of so many runs of each scenario")
                        ->check(CLI::Range(1, 10000000))
                        ->option_text("N");
  command->add_option("--first", wanted.first, "number of the first run, to share the runs among machines")
      ->check(CLI::Range(0, 1000000000))
      ->option_text("K [0]")
      ->needs(runs);
  command->add_option("--seed", wanted.seed, "of the noises")->option_text("S [1]");
  command->add_option("--replay", wanted.log, "run the filter over a log of outputs and inputs instead")
      ->option_text("LOG.csv")
      ->excludes(runs);
  command->add_flag("--json", wanted.wants_json, "print all as JSON, write no file");
  return command;
}

}  // namespace

// Setting up the command line throws only where two options have one name.
// NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  design::use_number_stores();
  Arguments arguments;
  NewArguments new_arguments;
  CLI::App app{"Designs an LQG controller and writes it as C99: NAME.h, NAME_test.c, NAME.json, NAME.html.", "lqgen"};
  app.set_version_flag("--version", emit::version());
  add_design_options(app, arguments);
  add_folder(app, arguments.folder);
  app.add_option("--only", arguments.only, "write only these")
      ->delimiter(',')
      ->check(CLI::IsMember({"h", "test", "json", "html", "proof", "batch"}))
      ->option_text("h,test,json,html,proof,batch");
  app.add_flag("--orders", arguments.wants_orders,
               "print the least cost of a compensator of each order, write no file");
  add_printed(app, "--keys", reference::page, "print all keys of a design file and exit");
  add_printed(app, "--schema", reference::schema, "print the JSON Schema of a design file and exit");

  CLI::App* const checking = app.add_subcommand("check", "Designs and writes nothing: for editors and CI.");
  add_design_options(*checking, arguments);
  checking->add_flag("--json", arguments.wants_json, "print what there is to say, and the design, as JSON");
  commands::SimulateArguments simulate_arguments;
  const CLI::App* const simulation = add_simulate(app, arguments, simulate_arguments);
  CLI::App* const runner = app.add_subcommand("run", "Runs the controller: y on standard input, u on standard output.");
  add_design_options(*runner, arguments);
  CLI::App* const beginning = app.add_subcommand("new", "Writes a commented design file to begin with, NAME.toml.");
  beginning->add_option("NAME", new_arguments.name, "name of the design")->option_text("NAME");
  beginning->add_option("--from", new_arguments.starter, "what to begin with; `lqgen new` lists what there is")
      ->option_text("STARTER");
  add_folder(*beginning, new_arguments.folder);
  view::WatchArguments watch_arguments;
  const CLI::App* const watching = add_watch(app, watch_arguments);
  view::CompareArguments compare_arguments;
  const CLI::App* const comparison = add_compare(app, compare_arguments);
  app.require_subcommand(0, 1);
  bool has_design = true;  // one, in arguments
  try {
    app.parse(argc, argv);
    has_design = !*beginning && !*watching && !*comparison;
    if (has_design && arguments.design_file.empty()) throw CLI::RequiredError("DESIGN");
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0 && explain_unknown_options(app)) return wrong;
    return app.exit(error) == 0 ? written : wrong;
  }
  const std::string command = app.get_subcommands().empty() ? "" : app.get_subcommands().front()->get_name();
  try {
    if (*beginning) return make_new(new_arguments);
    if (*watching) return view::watch(watch_arguments);
    if (*comparison) return compare_designs(compare_arguments);
    if (*checking) return check(arguments);
    if (*runner) return run_controller(arguments);
    if (*simulation) return simulate_design(arguments, simulate_arguments);
    return arguments.wants_orders ? show_orders(arguments) : generate(arguments);
  } catch (const std::exception& error) {
    const std::string what = has_design ? shown_path(arguments) : "lqgen " + command;
    std::cerr << input::printable(what) << ": lqgen failed: " << input::printable(error.what()) << "\n";
    return impossible;
  }
}
