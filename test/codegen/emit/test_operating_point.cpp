// SPDX-License-Identifier: MIT
// Controllers about an operating point: what is emitted passes its own test, answers bit for bit as the same controller
// of a plant at 0 does for shifted data.
#include <cmath>

#include <unity.h>

#include "controller/operating_point.hpp"
#include "design_text.hpp"
#include "emit/c/batch.hpp"
#include "emit/c/header.hpp"
#include "emitted.hpp"
#include "input/design_file.hpp"
#include "trace/print.hpp"

using namespace lqg_test;
using lqg::controller::Kind;
using lqg::emit::Controller;

namespace {

// ---- designs

// Position, speed and a slow force; every number of the point is one of floats, so that firmware's and the test's
// agree.
const std::string plant = R"(name = "about"
[plant]
domain = "discrete"
sample_time = 0.125
A = [[1, 0.125, 0], [0, 0.9, 0.125], [0, 0, 0.95]]
B = [[0], [0.125], [0.25]]
C = [[1, 0, 0], [0, 1, 0.5]]
outputs = ["position [m]", "motion"]
operating_point = { states = [3, -0.5, 0.25], inputs = [1.5], outputs = [3.5, -2] }
)";
const std::string filter = R"([kalman]
process_noise = [0.01, 0.01, 0.01]
measurement_noise = [0.1, 0.2]
)";
const std::string law = "[lqr]\nQ = [1, 1, 1]\nR = [1]\n";
const std::string code = "[code]\nflash = 1000000\nupdates = \"each\"\n";

std::string inserted(std::string text, const std::string& after, const std::string& line) {
  const std::size_t at = text.find(after);
  TEST_ASSERT_TRUE(at != std::string::npos);
  return text.insert(at + after.size(), line + "\n");
}

const std::string limits = "[limits]\nu_min = [1.25]\nu_max = [2]\nu_rate = [4]\n";
const std::string integral = law + "integral = { outputs = [0], Q = [1] }\n";

// Every form in which a sample is written, with all that the point has to do with.
std::vector<std::string> texts() {
  const std::string range = "output_min = [-10, -8]\noutput_max = [8, inf]\n";
  const std::string with_D = inserted(plant, "C = [[1, 0, 0], [0, 1, 0.5]]\n", "D = [[0.25], [0.5]]");
  const std::string delayed = inserted(plant, "sample_time = 0.125\n", "delay = 0.25");
  const std::string late = inserted(plant, "sample_time = 0.125\n", "output_delay = [0.25, 0]");
  const std::string correlated =
      "[kalman]\nprocess_noise = [0.01, 0.01, 0.01]\nmeasurement_noise = "
      "[[0.1, 0.05], [0.05, 0.2]]\ncross_noise = [[0, 0], [0.01, 0], [0, 0.01]]\n";
  const std::string online = "gain = \"online\"\ngate = 3\n";
  return {plant + filter + law + code,
          plant + filter + range + integral + limits + code + "real = \"double\"\n",
          with_D + filter + "form = \"predictor\"\n" + range + law + limits + code,
          delayed + filter + "gate = 3\n" + law + "track = [0]\ninput_rate = [1]\n" + limits + code,
          late + filter + "disturbance = { u0 = 0.25 }\n" + law + "track = [0]\n" + code,
          with_D + correlated + online + range + integral + limits + code,
          plant + filter + online + "covariance = \"plain\"\n" + range + integral + limits + code,
          plant + filter + "gain = \"schedule\"\nhorizon = 6\n" + law + "horizon = 8\n" + code,
          plant + filter + "form = \"predictor\"\n" + law + code + "realisation = \"folded\"\n",
          plant + filter + law + code + "realisation = \"modal\"\n",
          plant + filter + online + law + limits + code + "realisation = \"modal\"\n",
          plant + filter + law + "[compensator]\norder = 2\n" + code,
          plant + integral + limits + code,
          plant + law + code,
          plant + filter + online + code,
          delayed + filter + law + "track = [0]\n" + limits +
              "horizon = 4\noutputs = { motion = [-2.5, -1] }\nstates = { x1 = [-1, 0.25] }\n" + code,
          plant + law + "track = [0]\n" + limits + "horizon = 3\n" + code};
}

std::vector<Controller> controllers() {
  std::vector<Controller> all;
  for (const std::string& text : texts())
    for (const char* arithmetic : {"plain", "fused"}) {
      if (std::string(arithmetic) == "fused" && all.size() % 3 != 0) continue;  // a third of them
      all.push_back(controller_of(text + "arithmetic = \"" + arithmetic + "\"\n"));
    }
  return all;
}

void test_what_is_emitted_passes_its_own_test() {
  for (const Controller& controller : controllers()) expect_emitted_to_pass(controller, {Language::c});
}

// ---- shifted data

std::string list(const Eigen::VectorXd& values, Eigen::Index size, bool is_double) {
  std::string out;
  for (Eigen::Index i = 0; i < std::max<Eigen::Index>(size, 1); ++i)
    out += (i ? ", " : "") + lqg::trace::literal(values.size() > i ? values(i) : 0, is_double);
  return "{" + out + "}";
}

// What both controllers keep has the same bits, but for a sign of zero; references are those of the caller.
std::string same_members(const Controller& controller) {
  std::string out;
  for (const auto& field : lqg::controller::state_fields(controller)) {
    const std::string a = "about." + field.name, b = "plain." + field.name;
    if (field.name == "r") continue;
    if (field.kind == Kind::reals)
      out += "    expect_same(" + a + ", " + b + ", sizeof " + a + " / sizeof *" + a + ");\n";
    if (field.kind == Kind::counters) out += "    expect(memcmp(" + a + ", " + b + ", sizeof " + a + ") == 0);\n";
    if (field.kind == Kind::counter || field.kind == Kind::total) out += "    expect(" + a + " == " + b + ");\n";
  }
  return out;
}

std::string call(const std::string& name, const std::string& of_about, const std::string& of_plain) {
  return "    expect(about_" + name + "(" + of_about + ") == plain_" + name + "(" + of_plain + "));\n";
}

// u of both by `arguments` of control, and that it is within its limits.
std::string control(const Controller& controller, const std::string& of_about, const std::string& of_plain) {
  std::string out = call("control", of_about, of_plain) + "    expect_shifted(u, v, u0, NU);\n";
  if (!controller.problem.limits) return out;
  const bool is_double = controller.target.is_double;
  return out +
         "    expect(u[0] >= " + lqg::trace::literal(lqg::controller::own_input_limits(controller, +1)(0), is_double) +
         " && u[0] <= " + lqg::trace::literal(lqg::controller::own_input_limits(controller, -1)(0), is_double) + ");\n";
}

std::string estimate(const Controller& controller) {
  if (!controller.has.filter) return "";
  const bool converts = controller.linear || controller.modal;
  return std::string("    about_estimate(&about, x);\n") +
         (converts ? "    plain_estimate(&plain, z);\n" : "    memcpy(z, plain.x, sizeof z);\n") +
         "    expect_shifted(x, z, x0, NX);\n";
}

std::string sample_of_form(const Controller& controller) {
  if (controller.is_predictor)
    return control(controller, "&about, u", "&plain, v") + estimate(controller) +
           call("advance", "&about, y", "&plain, dy");
  return control(controller, "&about, y, u", "&plain, dy, v") + estimate(controller) +
         call("advance", "&about", "&plain");
}

std::string sample_of_filter(const Controller& controller) {
  std::string out, act;
  const bool has_S = controller.has.variance;
  out += std::string("    about_innovation(&about, y, nu") + (has_S ? ", S" : "") +
         ");\n    plain_innovation(&plain, dy, mu" + (has_S ? ", S" : "") + ");\n    expect_same(nu, mu, NY);\n";
  if (controller.has.regulator) act = control(controller, "&about, u", "&plain, v");
  if (controller.is_predictor) out += act;
  out += "    if (k % 5 == 3) {\n" + call("partial_update", "&about, y, 2", "&plain, dy, 2") +
         "    } else if (k % 5 == 4) {\n";
  for (int i = 0; i < controller.size.ny; ++i)
    if (has_update_alone(controller, i)) {
      const std::string entry = "[" + std::to_string(i) + "]";
      out += call("update_" + controller.problem.plant.outputs[static_cast<std::size_t>(i)].name, "&about, y" + entry,
                  "&plain, dy" + entry);
    }
  out += "    } else {\n" + call("update", "&about, y", "&plain, dy") + "    }\n" + estimate(controller);
  if (!controller.is_predictor) out += act;
  // What was applied is sometimes something else.
  out += "    for (int i = 0; i < NU; i++) {\n        u[i] = k % 7 == 5 ? u0[i] + draw() : " +
         std::string(controller.has.regulator ? "u[i]" : "u0[i] + draw()") + ";\n        v[i] = u[i] - u0[i];\n    }\n";
  out += call("predict", "&about, u", "&plain, v");
  out += "    if (k % 11 == 10) {\n" + call("set_state", "&about, given", "&plain, dx");
  if (can_set_input(controller)) out += call("set_input", "&about, u", "&plain, v");
  return out + "    }\n";
}

std::string sample_of_regulator(const Controller& controller) {
  const std::string about = controller.keeps.any ? "&about, " : "", plain = controller.keeps.any ? "&plain, " : "";
  std::string out = control(controller, about + "given, u", plain + "dx, v");
  if (can_set_input(controller))
    out += "    if (k % 5 == 4) {\n        u[0] = u0[0] + draw();\n        v[0] = u[0] - u0[0];\n" +
           call("set_input", about + "given, u", plain + "dx, v") + "    }\n";
  return out;
}

std::string program(const Controller& controller) {
  const auto& size = controller.size;
  const auto& point = controller.point;
  const bool is_double = controller.target.is_double;
  const std::string declarations = controller.keeps.any ? "static about_t about;\nstatic plain_t plain;\n" : "";
  return std::string(
             "#include <math.h>\n#include <stdio.h>\n#include <string.h>\n#include \"about.h\"\n#include \"plain.h\"\n"
             "typedef ") +
         (is_double ? "double" : "float") + " real;\nenum { NX = " + std::to_string(size.nx) +
         ", NU = " + std::to_string(size.nu) + ", NY = " + std::to_string(size.ny) +
         ", NR = " + std::to_string(size.nr) + " };\n" + declarations +
         "static real x0[] = " + list(point.x, size.nx, is_double) + ", u0[] = " + list(point.u, size.nu, is_double) +
         ", y0[] = " + list(point.y, size.ny, is_double) + ", r0[] = " + list(point.r, size.nr, is_double) + R"(;
static int failures, k;

/* A product and a sum are never made one here. */
static void expect(int holds)
{
    failures += !holds;
}
static void expect_same(const real a[], const real b[], unsigned long count)
{
    for (unsigned long i = 0; i < count; i++)
        expect(a[i] == b[i] || (a[i] != a[i] && b[i] != b[i]));
}
static void expect_shifted(const real own[], const real deviations[], const real point[], int count)
{
    for (int i = 0; i < count; i++)
        expect(own[i] == point[i] + deviations[i]);
}
static real draw(void)
{
    static unsigned seed = 1;
    seed = seed * 1664525u + 1013904223u;
    return (real)((int)(seed >> 22) - 512) / 256;  /* sums with the point are exact */
}

int main(void)
{
    real u[NU + 1] = {0}, v[NU + 1] = {0}, y[NY + 1] = {0}, dy[NY + 1] = {0}, x[NX], z[NX], given[NX], dx[NX],
         nu[NY + 1], mu[NY + 1], S[NY + 1];
    (void)y, (void)dy, (void)x, (void)z, (void)given, (void)dx, (void)expect_same;
    (void)nu, (void)mu, (void)S, (void)y0, (void)r0;
)" + (controller.keeps.any ? "    about_init(&about);\n    plain_init(&plain);\n" : "") +
         (size.nr ? "    expect_same(about.r, r0, NR);\n" : "") + R"(    for (k = 0; k < 400; k++) {
    for (int i = 0; i < NY; i++) {
        dy[i] = k % 13 == 12 ? (real)NAN : k % 50 == 49 ? 100 * draw() : draw();
        y[i] = y0[i] + dy[i];
    }
    for (int i = 0; i < NX; i++) {
        dx[i] = draw();
        given[i] = x0[i] + dx[i];
    }
)" +
         (size.nr ? "    if (k >= 10)\n        for (int i = 0; i < NR; i++) {\n"
                    "            plain.r[i] = k % 40 == 39 ? (real)NAN : draw();\n"
                    "            about.r[i] = r0[i] + plain.r[i];\n        }\n"
                  : "") +
         (controller.linear       ? sample_of_form(controller)
          : controller.has.filter ? sample_of_filter(controller)
                                  : sample_of_regulator(controller)) +
         (controller.keeps.any ? same_members(controller) : "") +
         "    }\n    printf(\"%d\", failures);\n    return 0;\n}\n";
}

void test_they_answer_as_those_of_a_plant_at_zero_do_for_shifted_data() {
  for (Controller about : controllers())
    for (const auto& [style, sharing, suffix] : ways_of(about)) {
      about.style = style, about.sharing = sharing;
      Controller plain = lqg::controller::without_point(about);
      plain.problem.name = "plain";
      const std::string text = program(about), outcome = run_with_headers({about, plain}, text);
      if (outcome != "0") TEST_FAIL_MESSAGE((outcome + " failures" + suffix + "\n" + text).c_str());
    }
}

// ---- what is 0 costs nothing

std::string without_comments(const std::string& header) { return header.substr(header.find("#ifndef ABOUT_H")); }

void test_a_point_of_zeros_is_the_code_without_one() {
  for (const std::string& text : texts()) {
    std::string zeros = text, none = text;
    const std::size_t at = text.find("operating_point"), end = text.find('\n', at);
    zeros.replace(at, end - at, "operating_point = { states = [0, 0, 0] }");
    none.erase(at, end + 1 - at);
    if (text.find("[limits]") != std::string::npos) {
      zeros.replace(zeros.find("u_min = [1.25]"), 14, "u_min = [-0.25]");
      none.replace(none.find("u_min = [1.25]"), 14, "u_min = [-0.25]");
    }
    const Controller with = controller_of(zeros), without = controller_of(none);
    TEST_ASSERT_EQUAL_STRING(without_comments(lqg::emit::header(without)).c_str(),
                             without_comments(lqg::emit::header(with)).c_str());
  }
}

void test_an_entry_of_zero_takes_no_operation() {
  std::string text = plant + filter + law + code;
  text.replace(text.find("outputs = [3.5, -2]"), 19, "outputs = [3.5, 0]");
  const std::string header = lqg::emit::header(controller_of(text));
  TEST_ASSERT_TRUE(header.find("y_position - ABOUT_OPERATING_Y_POSITION") != std::string::npos);
  TEST_ASSERT_TRUE(header.find("OPERATING_Y_MOTION") == std::string::npos);
}

// ---- what is refused, and what the design says

std::string complaint_of(const std::string& text) {
  const lqg::input::DesignFile file = lqg::input::parse_design(text);
  TEST_ASSERT_FALSE(file.problem.has_value());
  return file.findings.front().key + ": " + file.findings.front().message;
}

void expect_complaint(const std::string& text, const std::string& begin) {
  const std::string found = complaint_of(text);
  TEST_ASSERT_EQUAL_STRING(begin.c_str(), found.substr(0, begin.size()).c_str());
}

void test_points_that_mean_nothing_are_refused() {
  expect_complaint(plant + filter + law + "[limits]\nu_min = [-1]\nu_max = [1]\n" + code,
                   "plant.operating_point.inputs[0]: expected a number within limits.u_min and limits.u_max, -1 to 1, "
                   "found 1.5");
  expect_complaint(
      plant + filter + "output_max = [3, inf]\n" + law + code,
      "plant.operating_point.outputs[0]: expected a number within kalman.output_min and kalman.output_max");
  expect_complaint(inserted(plant, "sample_time = 0.125\n", "dropout = [0.1, 0]") + filter + law + code,
                   "plant.dropout: expected 0 for position, which is not 0 at the operating point");
}

void test_the_header_says_where_it_is() {
  const std::string header = lqg::emit::header(controller_of(texts()[1]));
  for (const char* line : {"Operating point:", "outputs  position = 3.5 m, motion = -2", "1.25 ≤ u[0] ≤ 2",
                           "deviations from the operating point", "plant.operating_point.inputs[0]"})
    if (header.find(line) == std::string::npos) TEST_FAIL_MESSAGE((std::string(line) + "\n" + header).c_str());
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_what_is_emitted_passes_its_own_test);
  RUN_TEST(test_they_answer_as_those_of_a_plant_at_zero_do_for_shifted_data);
  RUN_TEST(test_a_point_of_zeros_is_the_code_without_one);
  RUN_TEST(test_an_entry_of_zero_takes_no_operation);
  RUN_TEST(test_points_that_mean_nothing_are_refused);
  RUN_TEST(test_the_header_says_where_it_is);
  return UNITY_END();
}
