// SPDX-License-Identifier: MIT
#include "emit/c/contents.hpp"

#include <algorithm>
#include <vector>

#include "emit/text/columns.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

// When, what is called, and what for.
struct Entry {
  std::string when, call, why;
};

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, columns(text)), ' ');
}

std::vector<Entry> sample_of_linear_form(const Controller& controller) {
  if (controller.is_predictor)
    return {{"each sample", "{name}_control(&loop, u)", "u for the actuator, before y is measured"},
            {"", "{name}_advance(&loop, y)", "y of this sample"},
            {"  or", "{name}_step(&loop, y, u)", "the two in one call"}};
  return {{"each sample", "{name}_control(&loop, y, u)", "y has been measured; u for the actuator"},
          {"", "{name}_advance(&loop)", "after u has been written to the actuator"},
          {"  or", "{name}_step(&loop, y, u)", "the two in one call"}};
}

std::vector<Entry> sample_of_filter(const Controller& controller) {
  const bool acts = controller.has.regulator, has_input = controller.size.nu > 0;
  const Entry update = {"", "{name}_update(&loop, y)", "y has been measured"};
  const Entry control = {"", "{name}_control(&loop, u)", "u for the actuator"};
  std::vector<Entry> out;
  if (acts && controller.is_predictor) out.push_back(control);
  out.push_back(update);
  if (acts && !controller.is_predictor) out.push_back(control);
  out.push_back({"", has_input ? "{name}_predict(&loop, u)" : "{name}_predict(&loop)",
                 has_input ? "the u that was applied" : "from this sample to the next"});
  out.push_back({"  or", has_input ? "{name}_step(&loop, y, u)" : "{name}_step(&loop, y)",
                 acts ? "all three in one call" : "both in one call"});
  out.front().when = "each sample";
  return out;
}

std::vector<Entry> sample_of_regulator(const Controller& controller) {
  return {{"each sample", controller.keeps.any ? "{name}_control(&loop, x, u)" : "{name}_control(x, u)",
           "u of the state x"}};
}

// Sensors: what is called where some outputs are missing, and to watch them.
void add_sensors(const Controller& controller, const std::string& functions, std::vector<Entry>& out) {
  const auto has = [&](const std::string& function) {
    return functions.find(controller.problem.name + function + "(") != std::string::npos;
  };
  if (controller.linear) return out.push_back({"a sensor has failed", "y[i] = NAN", "counts as the expected value"});
  out.push_back({"a sensor has failed", "y[i] = NAN", "that output is not used"});
  if (has("_partial_update"))
    out.push_back({"a sensor is slower", "{name}_partial_update(&loop, y, used)", "instead of update"});
  for (int i = 0; i < controller.size.ny; ++i)
    if (has_update_alone(controller, i)) {
      const std::string output = controller.problem.plant.outputs[static_cast<std::size_t>(i)].name;
      out.push_back({"", "{name}_update_" + output + "(&loop, y_" + output + ")", "one output, instead of update"});
    }
  if (has("_innovation"))
    out.push_back({"to watch the sensors",
                   "{name}_innovation(&loop, y, innovation" + std::string(controller.has.variance ? ", S)" : ")"),
                   "before update"});
  if (has("_covariance"))
    out.push_back({"to watch P", "{name}_covariance(&loop, P)", controller.modal ? "P of x̂" : "P of U and d"});
}

void add_transfers(const Controller& controller, std::vector<Entry>& out) {
  const bool has_filter = controller.has.filter;
  if (controller.linear)
    out.push_back({"to read the estimate", "{name}_estimate(&loop, x)", "between control and advance"});
  else if (has_estimate(controller))
    out.push_back({"to read the estimate", "{name}_estimate(&loop, x)",
                   controller.modal ? "x̂ of the z that the filter keeps" : "x̂ in the plant's own units"});
  if (has_filter && controller.has.regulator && !controller.linear)
    out.push_back({"in manual mode", "{name}_predict(&loop, u)", "after update, with the manual u; no control"});
  if (has_filter)
    out.push_back({"the state is known", "{name}_set_state(&loop, x)",
                   controller.linear ? "between advance and control" : "between predict and update"});
  if (!controller.linear && can_set_input(controller))
    out.push_back({controller.has.regulator ? "manual to automatic" : "the input is known",
                   has_filter ? "{name}_set_input(&loop, u)" : "{name}_set_input(&loop, x, u)",
                   "the last manual input: bumpless transfer"});
}

}  // namespace

std::string table_of_contents(const Controller& controller, const std::string& functions) {
  std::vector<Entry> entries;
  const auto add = [&](const std::vector<Entry>& more) { entries.insert(entries.end(), more.begin(), more.end()); };
  if (controller.keeps.any) add({{"once", "{name}_init(&loop)", "at the start"}});
  if (controller.size.nr) add({{"a new reference", "loop.r[i] = …", "at any time between two calls"}});
  add(controller.linear       ? sample_of_linear_form(controller)
      : controller.has.filter ? sample_of_filter(controller)
                              : sample_of_regulator(controller));
  if (controller.has.filter) add_sensors(controller, functions, entries);
  add_transfers(controller, entries);
  if (functions.find("LQG_STATE_RESET") != std::string::npos)
    add({{"after LQG_STATE_RESET", "the same calls as before",
          std::string(controller.solution.compensator ? "z is that of init" : "x̂ is that of init") +
              (controller.size.nr ? ", r is kept" : "")}});
  std::size_t when = 0, call = 0;
  for (Entry& entry : entries) {
    entry.call = fill(entry.call, common_words(controller));
    when = std::max(when, columns(entry.when));
    call = std::max(call, columns(entry.call));
  }
  std::string out = " * What is called when:\n *\n";
  for (const Entry& entry : entries) {
    const std::string begin = " *   " + padded(entry.when, when + 2), line = padded(entry.call, call + 2) + entry.why;
    if (columns(begin + line) <= widest_line)
      out += begin + line + "\n";
    else
      out += begin + entry.call + "\n *   " + padded("", when + 4) + entry.why + "\n";
  }
  return out + (controller.has.filter
                    ? " *\n * A status other than LQG_OK says what happened; each function lists its bits.\n"
                    : "");
}

}  // namespace lqg::emit
