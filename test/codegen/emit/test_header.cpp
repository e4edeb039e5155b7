// SPDX-License-Identifier: MIT
// The header as a text: its parts and their order, its checks of what it is compiled with, the same bytes each time.
#include <clocale>
#include <locale>

#include <unity.h>

#include "emit/text/columns.hpp"
#include "emit/text/wording.hpp"
#include "design_text.hpp"
#include "emit/c/header.hpp"
#include "emit/c/preamble.hpp"
#include "emit/report/json.hpp"
#include "emit/report/summary.hpp"
#include "emit/unit_test/unit_test.hpp"
#include "emitted.hpp"
#include "trace/print.hpp"

using namespace lqg_test;
using lqg::design::Style;
using lqg::emit::Controller;

namespace fs = std::filesystem;

namespace {

Controller controller_in(Style style, DesignText design = double_integrator()) {
  design.style = style == Style::compact ? "compact" : "unrolled";
  return controller_of(design);
}

// Each part stands behind the one before it.
void expect_order(const std::string& text, const std::vector<std::string>& parts) {
  std::size_t at = 0;
  for (const std::string& part : parts) {
    const std::size_t found = text.find(part, at);
    if (found == std::string::npos)
      TEST_FAIL_MESSAGE((part + (text.find(part) == std::string::npos ? " is missing" : " is misplaced")).c_str());
    at = found + part.size();
  }
}

// No place is left open, and no mark.
void expect_no_rest_of_a_template(const std::string& text) {
  TEST_ASSERT_TRUE(text.find("//?") == std::string::npos);
  for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at + 1)) {
    const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_", at + 1);
    if (end > at + 1 && end < text.size() && text[end] == '}') TEST_FAIL_MESSAGE(text.substr(at, end + 1 - at).c_str());
  }
}

const char* const functions[] = {"loop_init(loop_t *self)", "loop_update(loop_t *self, const float y[LOOP_NY])",
                                 "loop_control(const loop_t *self, float u[LOOP_NU])",
                                 "loop_predict(loop_t *self, const float u[LOOP_NU])",
                                 "loop_step(loop_t *self, const float y[LOOP_NY], float u[LOOP_NU])"};

// As a user names a file, with all that a check of names lets pass.
void test_a_file_name_that_looks_like_code_stays_text() {
  const fs::path folder = empty_folder("file_name");
  for (const Style style : {Style::unrolled, Style::compact}) {
    Controller controller = controller_in(style);
    controller.source.file = "it's {name} ${x} %s <b> & #if 0 ?: ä*.toml";
    write(folder / "loop.h", lqg::emit::header(controller));
    write(folder / "loop_test.c", lqg::emit::unit_test(controller));
    for (const std::string& compiler : {as_c, as_cxx}) {
      const Outcome outcome =
          run(compiler + " -fsyntax-only" + options(controller, folder) + " " + (folder / "loop_test.c").string());
      TEST_ASSERT_TRUE_MESSAGE(outcome.succeeded, outcome.output.c_str());
    }
  }
}

void test_nothing_of_a_template_is_left_in_a_header() {
  Random random(11);
  for (int k = 0; k < 12; ++k) {
    const DesignText design = random_design(random, random.between(1, 3));
    for (const Style style : {Style::unrolled, Style::compact})
      expect_no_rest_of_a_template(lqg::emit::header(controller_in(style, design)));
  }
}

void test_header_has_its_parts_in_the_order_of_the_contract() {
  for (const Style style : {Style::unrolled, Style::compact}) {
    const Controller controller = controller_in(style);
    std::vector<std::string> parts = {"/* loop: a loop of the tests\n",
                                      "Made by lqgen " + lqg::emit::version() + " from loop.toml",
                                      controller.source.sha256,
                                      "under any licence",
                                      "What is called when:",
                                      "loop_init(&loop)",
                                      "loop_step(&loop, y, u)",
                                      "Plant, sampled every 0.1 s",
                                      "states   x[0] position [m], x[1] speed [m/s]",
                                      "inputs   u[0] force [N]",
                                      "outputs  y[0] position [m]",
                                      " A = [",
                                      " B = [",
                                      " C = [",
                                      "Regulator",
                                      " K = [",
                                      "poles of A − B K",
                                      "Kalman filter, filter form",
                                      " L = [",
                                      "poles of A − L_predictor C",
                                      "Closed loop",
                                      "gain margin",
                                      "phase margin",
                                      "disk margin",
                                      "multiply-adds",
                                      "bytes of RAM",
                                      "flash",
                                      "stack",
                                      "*/\n#ifndef LOOP_H",
                                      "#include \"lqg/",
                                      "#if LQG_HEADER_FORMAT != ",
                                      "#error",
                                      "regenerate it with the library's lqgen",
                                      "#endif",
                                      "#define LOOP_NX 2",
                                      "#define LOOP_NU 1",
                                      "#define LOOP_NY 1",
                                      "#define LOOP_SAMPLE_TIME 0.1f",
                                      "LOOP_X_POSITION = 0,",
                                      "LOOP_X_SPEED = 1",
                                      "LOOP_U_FORCE = 0",
                                      "LOOP_Y_POSITION = 0",
                                      "float x[LOOP_NX];",
                                      "} loop_t;"};
    parts.insert(parts.end(), std::begin(functions), std::end(functions));
    parts.push_back("#endif\n");
    expect_order(lqg::emit::header(controller), parts);
  }
}

// The comment above a function says its equation, its arguments and its status.
void test_every_function_carries_its_contract() {
  const std::string text = lqg::emit::header(controller_in(Style::unrolled));
  expect_order(text,
               {"/* Initial state: x̂", functions[0], "/* x̂ ← x̂ + L (y − C x̂)", "y  in:", "Status:", functions[1],
                "/* u = −K x̂", "u  out:", "Status:", functions[2], "/* From this sample to the next:  x̂ ← A x̂ + B u",
                "u  in:", "Status:", functions[3], "/* One sample: update, control, predict", functions[4]});
}

void test_step_makes_its_calls_in_the_order_of_the_form() {
  DesignText design = double_integrator();
  const std::string update = "loop_update(self, y);", control = "loop_control(self, u);",
                    predict = "loop_predict(self, u);";
  design.form = "filter";
  expect_order(lqg::emit::header(controller_in(Style::compact, design)), {functions[4], update, control, predict});
  design.form = "predictor";
  expect_order(lqg::emit::header(controller_in(Style::compact, design)), {functions[4], control, update, predict});
}

// Straight-line code has the text of the calls there. Where a bit may depend on the update's recovery it comes first.
void test_step_is_one_text_in_the_order_of_the_form() {
  DesignText design = double_integrator();
  const std::string update = "/* x̂ ← x̂ + L innovation", recovery = "status = loop_reset(self, status);",
                    read_again = "= self->x[0];", control = "/* u = −K x̂", predict = "/* x̂ ← A x̂ + B u";
  design.form = "filter";
  expect_order(lqg::emit::header(controller_in(Style::unrolled, design)),
               {functions[4], update, recovery, read_again, control, predict, recovery});
  design.form = "predictor";
  expect_order(lqg::emit::header(controller_in(Style::unrolled, design)),
               {functions[4], control, update, recovery, read_again, predict, recovery});
}

void test_what_a_controller_does_not_have_is_not_written() {
  DesignText design = double_integrator();
  design.Q.resize(0, 0);
  const std::string estimator = lqg::emit::header(controller_of(design));
  TEST_ASSERT_TRUE(estimator.find("loop_control") == std::string::npos);
  TEST_ASSERT_TRUE(estimator.find("Regulator") == std::string::npos);
  design = double_integrator();
  design.W.resize(0, 0), design.C.resize(0, 0), design.G.resize(0, 0), design.outputs = "";
  const std::string regulator = lqg::emit::header(controller_of(design));
  for (const char* absent : {"loop_t", "loop_update", "loop_predict", "loop_step", "LOOP_NY", "LOOP_Y_", "Kalman"})
    TEST_ASSERT_TRUE_MESSAGE(regulator.find(absent) == std::string::npos, absent);
  expect_order(regulator, {"loop_control(const float x[LOOP_NX], float u[LOOP_NU])"});
}

// An observer in predictor form on x⁺ = x + T v, v⁺ = v + T u, y = x. By hand: (z − 0.5)(z − 0.6) is the characteristic
// polynomial of [1 − l₁  T; −l₂  1], so that l₁ = 2 − 1.1 and l₂ = (1 − 1.1 + 0.3)/T.
void test_predictor_form_prints_the_gain_that_its_code_uses() {
  const std::string plant =
      "name = \"loop\"\n[plant]\ndomain = \"discrete\"\nsample_time = 0.1\nA = [[1, 0.1], [0, 1]]\n"
      "B = [[0.005], [0.1]]\nC = [[1, 0]]\n[lqr]\nQ = [1, 1]\nR = [1]\n";
  const Controller observer = controller_of(plant + "[observer]\npoles = [0.5, 0.6]\n");
  for (const std::string& text : {lqg::emit::header(observer), lqg::emit::summary(observer)}) {
    expect_order(text, {"  L_predictor = [ 0.9 ]\n", "[ 2.0 ]\n", "poles of A − L_predictor C: 0.6, 0.5"});
    TEST_ASSERT_TRUE(text.find(" L = [") == std::string::npos);
  }
  expect_order(lqg::emit::header(observer), {"+ (0.9f * last_innovation_y0);", "+ (2.0f * last_innovation_y0);"});
  const std::string noise = "process_noise = [0.01, 0.01]\nmeasurement_noise = [0.01]\n";
  const std::string filter = lqg::emit::header(controller_of(plant + "[kalman]\nform = \"predictor\"\n" + noise));
  expect_order(filter, {" L = [", " L_predictor = [", "poles of A − L_predictor C"});
  const Controller both = controller_of(plant + "[kalman]\n" + noise + "cross_noise = [[0.001], [0.002]]\n");
  expect_order(lqg::emit::header(both), {" L = [", " M = [ ", "poles of A − L_predictor C"});
}

void test_the_gain_in_the_comment_is_that_of_the_design() {
  const Controller controller = controller_in(Style::unrolled);
  const std::string text = lqg::emit::header(controller);
  for (int j = 0; j < 2; ++j) {
    const double K = mpfr_get_flt(controller.solution.regulator->K(0, j).backend().data(), MPFR_RNDN);
    std::string number = lqg::trace::literal(K, false);
    number.pop_back();
    const std::size_t line = text.find(" K = [");
    TEST_ASSERT_TRUE(text.substr(line, text.find('\n', line) - line).find(number) != std::string::npos);
  }
}

void expect_lines_to_fit(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    const std::string line = text.substr(at, end - at);
    TEST_ASSERT_TRUE_MESSAGE(lqg::emit::columns(line) <= 120, line.c_str());
    at = end + 1;
  }
}

// Names of 31 characters, the longest there are, with units; seven states fill more than a line of a matrix.
DesignText with_longest_names() {
  DesignText design = double_integrators(4);
  const auto names = [](int count, const std::string& unit) {
    std::string out;
    for (int i = 0; i < count; ++i)
      out += std::string(i ? ", " : "[") + "\"a_signal_with_a_name_as_long_a" + std::to_string(i) + " [" + unit + "]\"";
    return out + "]";
  };
  design.name = "a_design_with_a_name_as_long_as";
  design.states = names(8, "rad/s"), design.inputs = names(4, "N m"), design.outputs = names(4, "m/s^2");
  design.u_min = Eigen::VectorXd::Constant(4, -0.3), design.u_max = Eigen::VectorXd::Constant(4, 0.7);
  return design;
}

void test_lines_fit_120_columns_whatever_the_names() {
  for (const Style style : {Style::unrolled, Style::compact})
    for (const char* gain : {"steady", "online"})
      for (const char* real : {"float", "double"}) {
        DesignText design = with_longest_names();
        design.gain = gain, design.real = real;
        const Controller controller = controller_in(style, design);
        expect_lines_to_fit(lqg::emit::header(controller));
        expect_lines_to_fit(lqg::emit::unit_test(controller));
      }
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  return text.substr(from, text.find(end, from) - from);
}

void test_limits_and_bounds_are_constants_with_their_origin() {
  for (const Style style : {Style::unrolled, Style::compact}) {
    DesignText design = double_integrator();
    design.inputs = "[\"force [N]\"]";
    design.u_min = Eigen::VectorXd::Constant(1, -0.3), design.u_max = Eigen::VectorXd::Constant(1, 7);
    const std::string text = lqg::emit::header(controller_in(style, design));
    TEST_ASSERT_TRUE(text.find("(-0.3f) ") != std::string::npos || text.find("(-0.29999998f) ") != std::string::npos);
    TEST_ASSERT_TRUE(text.find("/* N, limits.u_min = -0.3, rounded inwards */") != std::string::npos);
    TEST_ASSERT_TRUE(text.find("/* N, limits.u_max = 7.0 */") != std::string::npos);
    const std::string code = text.substr(text.find("LQG_STRICT_BEGIN"));
    for (const char* number : {"0.3f", "0.29999998f", "7.0f", "e+", "000.0f"})
      TEST_ASSERT_TRUE_MESSAGE(code.find(number) == std::string::npos, number);
  }
}

// A flipped bit of one would be undefined behaviour.
void test_the_state_has_no_bool_and_no_enumeration() {
  Random random(13);
  for (int k = 0; k < 12; ++k) {
    const std::string state =
        between(lqg::emit::header(controller_of(random_design(random, 2))), "typedef struct {", "}");
    for (const char* type : {"bool", "enum", "lqg_status_t"}) TEST_ASSERT_TRUE(state.find(type) == std::string::npos);
  }
}

void test_a_contract_promises_limits_only_where_there_are_some() {
  DesignText design = double_integrator();
  design.u_min.resize(0), design.u_max.resize(0);
  const std::string free = lqg::emit::header(controller_of(design));
  TEST_ASSERT_TRUE(free.find("within the limits") == std::string::npos);
  TEST_ASSERT_TRUE(free.find("LQG_INPUT_LIMITED (not finite and set to 0)") != std::string::npos);
  design.u_max = Eigen::VectorXd::Constant(1, 7);
  TEST_ASSERT_TRUE(lqg::emit::header(controller_of(design)).find("always finite and within the limits") !=
                   std::string::npos);
}

// The table of contents names each function that firmware may call, and no other.
void test_the_table_of_contents_names_each_function() {
  Random random(14);
  for (int k = 0; k < 12; ++k) {
    const std::string text = lqg::emit::header(controller_of(random_design(random, random.between(1, 3))));
    const std::string contents = between(text, "What is called when", " * Plant");
    for (std::size_t at = text.find("\nstatic inline "); at != std::string::npos;
         at = text.find("\nstatic inline ", at + 1)) {
      const std::string line = text.substr(at, text.find('(', at) - at);
      const std::string name = line.substr(line.rfind(' ') + 1);
      if (name == "loop_kalman") continue;  // the description of a stage, for the library's calls
      TEST_ASSERT_TRUE_MESSAGE(contents.find(name + "(") != std::string::npos, name.c_str());
    }
  }
}

struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

std::string all_files(const DesignText& design) {
  const Controller controller = controller_of(design);
  return lqg::emit::header(controller) + lqg::emit::unit_test(controller) + lqg::emit::json(controller);
}

// Numbers with a comma and grouped digits: in iostreams always, in C's functions where such a locale is installed.
void test_the_same_design_gives_the_same_bytes_in_any_locale() {
  DesignText design = double_integrator();
  design.sample_time = 0.123456789;
  for (const char* style : {"unrolled", "compact"})
    for (const char* real : {"float", "double"}) {
      design.style = style, design.real = real;
      const std::string first = all_files(design);
      TEST_ASSERT_TRUE(first == all_files(design));
      const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
      for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"})
        if (std::setlocale(LC_ALL, name)) break;
      const std::string other = all_files(design);
      std::setlocale(LC_ALL, "C");
      std::locale::global(before);
      TEST_ASSERT_TRUE(first == other);
    }
}

// Writes the header; compiles a file that includes it with more options.
Outcome compile(const Controller& controller, const std::string& more_options,
                const fs::path& include = LQG_INCLUDE_FOLDER) {
  const fs::path folder = empty_folder("compile");
  write(folder / "loop.h", lqg::emit::header(controller));
  write(folder / "user.c", "#include \"loop.h\"\n");
  return run(as_c + " -I" + include.string() + options(controller, folder) + " -fsyntax-only " + more_options + " " +
             (folder / "user.c").string());
}

void expect_refusal(const Outcome& outcome, const std::string& reason) {
  TEST_ASSERT_FALSE(outcome.succeeded);
  TEST_ASSERT_TRUE_MESSAGE(outcome.output.find(reason) != std::string::npos, outcome.output.c_str());
}

void test_header_of_another_format_is_refused_with_what_to_do() {
  const fs::path include = empty_folder("other_format");
  fs::copy(LQG_INCLUDE_FOLDER, include, fs::copy_options::recursive);
  std::string version = read(include / "lqg/version.h");
  const std::string own = "#define LQG_HEADER_FORMAT " + lqg::emit::header_format() + "\n";
  TEST_ASSERT_TRUE(version.find(own) != std::string::npos);
  version.replace(version.find(own), own.size(), "#define LQG_HEADER_FORMAT 999\n");
  write(include / "lqg/version.h", version);
  for (const Style style : {Style::unrolled, Style::compact}) {
    const Controller controller = controller_in(style);
    TEST_ASSERT_TRUE(compile(controller, "").succeeded);
    expect_refusal(compile(controller, "", include),
                   "This file needs header format " + lqg::emit::header_format() +
                       ", the library has another one: regenerate it with the library's lqgen.");
  }
}

void test_fast_math_is_refused() {
  for (const Style style : {Style::unrolled, Style::compact})
    for (const char* option : {"-ffast-math", "-ffinite-math-only"})
      expect_refusal(compile(controller_in(style), option), "cannot be compiled with -ffast-math");
}

void test_compact_refuses_the_options_of_another_library() {
  DesignText design = double_integrator();
  expect_refusal(compile(controller_in(Style::compact, design), "-DLQG_REAL_DOUBLE"),
                 "This file computes in float: do not define LQG_REAL_DOUBLE");
  expect_refusal(compile(controller_in(Style::compact, design), "-DLQG_FUSED"),
                 "This file uses plain arithmetic: do not define LQG_FUSED");
  design.real = "double", design.arithmetic = "fused";
  const Controller controller = controller_in(Style::compact, design);
  TEST_ASSERT_TRUE(compile(controller, "").succeeded);
  expect_refusal(compile(controller, "-ULQG_REAL_DOUBLE"), "This file computes in double: define LQG_REAL_DOUBLE");
  expect_refusal(compile(controller, "-ULQG_FUSED"), "This file uses fused multiply-adds: define LQG_FUSED");
}

void test_unrolled_does_not_care_about_the_options_of_the_library() {
  for (const char* options : {"", "-DLQG_REAL_DOUBLE", "-DLQG_FUSED -DLQG_REAL_DOUBLE"})
    TEST_ASSERT_TRUE(compile(controller_in(Style::unrolled), options).succeeded);
}

void test_fused_multiply_adds_without_the_instruction_are_told() {
#if defined __x86_64__
  const std::string told = "fused multiply-adds are slow here";
  DesignText design = double_integrator();
  for (const Style style : {Style::unrolled, Style::compact})
    for (const char* real : {"float", "double"}) {
      design.real = real, design.arithmetic = "fused";
      const Controller fused = controller_in(style, design);
      TEST_ASSERT_TRUE(compile(fused, "-mno-fma").output.find(told) != std::string::npos);
      for (const char* options : {"-mfma", "-mno-fma -DLQG_SLOW_FUSED"})
        TEST_ASSERT_TRUE(compile(fused, options).output.find(told) == std::string::npos);
      design.arithmetic = "plain";
      TEST_ASSERT_TRUE(compile(controller_in(style, design), "-mno-fma").output.find(told) == std::string::npos);
    }
#else
  TEST_IGNORE_MESSAGE("Only x86-64 can be compiled for with and without the instruction");
#endif
}

// What gcc contracts and clang may: the header switches it off from the inside, at any optimisation.
void test_contraction_around_the_header_changes_no_bit() {
#if defined __x86_64__
  if (!__builtin_cpu_supports("fma")) TEST_IGNORE_MESSAGE("this processor has no fused multiply-add");
  const std::string fused = "-mfma ";
#elif defined __aarch64__
  const std::string fused;
#else
  TEST_IGNORE_MESSAGE("unknown processor");
#endif
#ifdef __clang__
  const std::string contract = "-ffp-contract=on ";
#else
  const std::string contract = "-ffp-contract=fast ";
#endif
  DesignText design = double_integrators(2);
  design.gain = "online";
  const Controller controller = controller_in(Style::unrolled, design);
  const fs::path folder = empty_folder("contraction");
  write(folder / "loop.h", lqg::emit::header(controller));
  write(folder / "loop_test.c", lqg::emit::unit_test(controller));
  const std::string program = (folder / "program").string();
  const Outcome compiled = run(as_c + " -O3 " + fused + contract + options(controller, folder) + " -o " + program +
                               " " + (folder / "loop_test.c").string() + " " LQG_UNITY_LIBRARY " -lm");
  TEST_ASSERT_TRUE_MESSAGE(compiled.succeeded, compiled.output.c_str());
  const Outcome outcome = run(program);
  TEST_ASSERT_TRUE_MESSAGE(outcome.succeeded, outcome.output.c_str());
}

// sizeof(loop_t) is what the figures say, of targets whose counters have four bytes.
void test_ram_is_exactly_the_size_of_the_state() {
  DesignText design = double_integrators(2);
  design.D = Eigen::MatrixXd::Constant(2, 2, 0.5);
  design.Swv = Eigen::MatrixXd::Constant(2, 2, 0.01);
  for (const char* gain : {"steady", "online"})
    for (const char* real : {"float", "double"}) {
      design.gain = gain, design.real = real;
      const Controller controller = controller_of(design);
      const std::string counters = carries_covariance(controller) ? "4" : "3";  // two of them are of the outputs
      const std::string size =
          run_with_header(controller,
                          "#include <stddef.h>\n#include <stdio.h>\n#include \"loop.h\"\n"
                          "int main(void)\n{\n    const int real = (int)sizeof(" +
                              std::string(real) + "), bytes = (int)offsetof(loop_t, resets) + 4 * " + counters +
                              ";\n"
                              "    return printf(\"%d\", (bytes + real - 1) / real * real) < 0;\n}\n");
      TEST_ASSERT_EQUAL_STRING(std::to_string(controller.cost.ram).c_str(), size.c_str());
    }
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_header_has_its_parts_in_the_order_of_the_contract);
  RUN_TEST(test_a_file_name_that_looks_like_code_stays_text);
  RUN_TEST(test_nothing_of_a_template_is_left_in_a_header);
  RUN_TEST(test_every_function_carries_its_contract);
  RUN_TEST(test_step_makes_its_calls_in_the_order_of_the_form);
  RUN_TEST(test_step_is_one_text_in_the_order_of_the_form);
  RUN_TEST(test_what_a_controller_does_not_have_is_not_written);
  RUN_TEST(test_predictor_form_prints_the_gain_that_its_code_uses);
  RUN_TEST(test_the_gain_in_the_comment_is_that_of_the_design);
  RUN_TEST(test_lines_fit_120_columns_whatever_the_names);
  RUN_TEST(test_limits_and_bounds_are_constants_with_their_origin);
  RUN_TEST(test_the_state_has_no_bool_and_no_enumeration);
  RUN_TEST(test_a_contract_promises_limits_only_where_there_are_some);
  RUN_TEST(test_the_table_of_contents_names_each_function);
  RUN_TEST(test_the_same_design_gives_the_same_bytes_in_any_locale);
  RUN_TEST(test_header_of_another_format_is_refused_with_what_to_do);
  RUN_TEST(test_fast_math_is_refused);
  RUN_TEST(test_compact_refuses_the_options_of_another_library);
  RUN_TEST(test_unrolled_does_not_care_about_the_options_of_the_library);
  RUN_TEST(test_fused_multiply_adds_without_the_instruction_are_told);
  RUN_TEST(test_contraction_around_the_header_changes_no_bit);
  RUN_TEST(test_ram_is_exactly_the_size_of_the_state);
  return UNITY_END();
}
