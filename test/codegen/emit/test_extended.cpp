// SPDX-License-Identifier: MIT
// Extended filters from end to end: a design file with equations, what is emitted of it, compiled and run, against the
// host's numbers to the bit and against a reference of 60 digits.
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <unity.h>

#include "design/solve.hpp"
#include "design_text.hpp"
#include "emit/c/header.hpp"
#include "emitted.hpp"
#include "extended_reference.hpp"
#include "input/design_file.hpp"

using namespace lqg_test;

namespace reference = extended_reference;

namespace {

const std::string ship_plant = R"--([plant]
domain = "discrete"
sample_time = 0.5
states = ["px", "py", "heading", "speed"]
inputs = ["turn"]
outputs = ["distance", "bearing"]
f = ["px + 0.5*speed*cos(heading)", "py + 0.5*speed*sin(heading)", "heading + 0.5*turn", "speed*exp(-0.5/64)"]
h = ["sqrt(px^2 + py^2)", "atan2(py, px)"]
)--";
const std::string ship_filter = R"--([kalman]
gain = "extended"
wraps = ["bearing"]
spike = inf
process_noise = [0.01, 0.01, 1e-4, 0.01]
measurement_noise = [0.25, 0.0004]
initial_state = [-38, 22, -1.25, 5]
initial_covariance = [25, 25, 0.25, 4]
)--";
const std::string cart_plant = R"--([plant]
domain = "continuous"
sample_time = 0.01
states = ["p", "v", "th", "om"]
inputs = ["F"]
outputs = ["position", "angle"]
f = ["v", "(F - 0.1*v + 0.2*sin(th)*(0.3*om^2 - 9.81*cos(th)))/(0.5 + 0.2*sin(th)^2)", "om",
     "(9.81*0.7*sin(th) - cos(th)*(F - 0.1*v + 0.2*0.3*om^2*sin(th)))/(0.3*(0.5 + 0.2*sin(th)^2))"]
h = ["p", "th"]
)--";
const std::string cart_filter = R"--([kalman]
gain = "extended"
noise = "discrete"
spike = inf
process_noise = [1e-6, 1e-4, 1e-6, 1e-3]
measurement_noise = [[0.0004, 0.0002], [0.0002, 0.0025]]
initial_state = [0, 0, 0.25, 0]
initial_covariance = [0.01, 1, 0.25, 1]
)--";

std::string code(const std::string& real, const std::string& arithmetic) {
  return "[code]\nflash = 1000000\nupdates = \"each\"\nreal = \"" + real + "\"\narithmetic = \"" + arithmetic + "\"\n";
}

std::string named(const std::string& name, const std::string& rest) { return "name = \"" + name + "\"\n" + rest; }

void test_the_code_has_the_bits_of_the_host_in_every_arithmetic() {
  for (const char* real : {"float", "double"})
    for (const char* arithmetic : {"plain", "fused"})
      for (const char* covariance : {"ud", "plain"}) {
        const std::string kind = std::string("_") + real + "_" + arithmetic + "_" + covariance;
        const std::string form = std::string("covariance = \"") + covariance + "\"\n", end = code(real, arithmetic);
        expect_emitted_to_pass(
            controller_of(named("ship" + kind, ship_plant + ship_filter + form + "gate = 6\n" + end)), {Language::c});
        expect_emitted_to_pass(controller_of(named("cart" + kind, cart_plant + cart_filter + form + end)),
                               {Language::c});
      }
}

// Everything that a formula may have, abs, min and max with their kinks among it, and h of the last input.
void test_all_functions_as_c_and_as_cpp() {
  const std::string design = R"--([plant]
domain = "continuous"
sample_time = 0.05
states = ["a", "b", "c"]
inputs = ["w"]
outputs = ["p", "q", "r"]
f = ["-tan(a/4) + tanh(b) + abs(c)", "-b^3 + min(a, c) + exp(-c^2)*w", "atan(a) - max(b, 2*c) - c/(2 + a^2)"]
h = ["asin(sin(a)/2) + acos(cos(b)/2)", "log(2 + sin(c))*sqrt(1 + b^2) + w", "(2 + cos(a))^1.5 + atan2(b, 2 + c^2)"]
[kalman]
gain = "extended"
noise = "discrete"
process_noise = [0.01, 0.02, 0.01]
measurement_noise = [0.1, 0.1, 0.2]
)--";
  for (const char* real : {"float", "double"})
    expect_emitted_to_pass(controller_of(named(std::string("functions_") + real, design + code(real, "plain"))),
                           {Language::c, Language::cxx});
}

void test_a_filter_without_inputs_and_one_by_euler() {
  const std::string design = R"--([plant]
domain = "continuous"
sample_time = 0.1
states = ["a", "b"]
outputs = ["y"]
f = ["b", "-sin(a) - 0.25*b"]
h = ["a^2"]
[kalman]
gain = "extended"
integrator = "euler"
process_noise = [0.01, 0.02]
measurement_noise = [0.1]
initial_state = [1, 0]
)--";
  expect_emitted_to_pass(controller_of(named("no_input", design + code("float", "plain"))), {Language::c});
}

// Angle, rate and torque of the operating point are not 0.
void test_a_law_about_the_operating_point() {
  const std::string design = R"--([plant]
domain = "continuous"
sample_time = 0.02
states = ["angle", "rate"]
inputs = ["torque"]
outputs = ["sight"]
f = ["rate", "24.5*sin(angle) - 0.125*rate + 20*torque"]
h = ["angle"]
operating_point = { states = [0.5, 0], inputs = ["?"] }
[lqr]
Q = [10, 1]
R = [1]
[kalman]
gain = "extended"
noise = "discrete"
process_noise = [1e-6, 1e-3]
measurement_noise = [1e-4]
initial_state = [0.3, 0]
[limits]
u_min = [-2]
u_max = [2]
)--";
  for (const char* real : {"float", "double"})
    expect_emitted_to_pass(controller_of(named("held", design + code(real, "plain"))), {Language::c});
  const auto controller = controller_of(named("held", design + code("double", "plain")));
  // It begins where the file says, to the bit, and at the operating point it asks for the input that holds it.
  std::istringstream answer(run_with_header(controller, R"--(#include <stdio.h>
#include "held.h"
int main(void)
{
    held_t self;
    double u[1];
    held_init(&self);
    printf("%.17g ", self.x[0]);
    self.x[0] = 0.5;
    (void)held_control(&self, u);
    printf("%.17g\n", u[0]);
    return 0;
}
)--"));
  double angle = 0, torque = 0;
  answer >> angle >> torque;
  TEST_ASSERT_TRUE(angle == 0.3);
  TEST_ASSERT_TRUE(std::abs(torque - -24.5 * std::sin(0.5) / 20) < 1e-14);
}

std::string numbers(const double* values, int count) {
  std::ostringstream out;
  out.precision(17);
  for (int i = 0; i < count; ++i)
    if (std::isnan(values[i]))
      out << (i ? ", " : "") << "(double)NAN";
    else
      out << (i ? ", " : "") << values[i];
  return out.str();
}

template <std::size_t nx, std::size_t np>
void expect_reference(const std::string& name, const std::string& design, const double (&y)[reference::samples][2],
                      const double (&u)[reference::samples][1], const double (&x)[reference::samples][nx],
                      const double (&P)[reference::samples][np]) {
  const std::string N = std::to_string(nx), M = std::to_string(np), K = std::to_string(reference::samples);
  const std::string program =
      "#include <stdio.h>\n#include \"" + name + ".h\"\nstatic const double y[] = {" +
      numbers(&y[0][0], 2 * reference::samples) + "};\nstatic const double u[] = {" +
      numbers(&u[0][0], reference::samples) + "};\nint main(void)\n{\n    " + name + "_t self;\n    double P[" + M +
      "];\n    " + name + "_init(&self);\n    for (int k = 0; k < " + K + "; k++) {\n        (void)" + name +
      "_step(&self, y + 2 * k, u + k);\n        " + name + "_covariance(&self, P);\n        for (int i = 0; i < " + N +
      "; i++) { printf(\"%.17g \", self.x[i]); }\n        for (int i = 0; i < " + M +
      "; i++) { printf(\"%.17g \", P[i]); }\n    }\n    return 0;\n}\n";
  std::istringstream answers(run_with_header(controller_of(design), program));
  for (int k = 0; k < reference::samples; ++k) {
    double largest = 0, found = 0;
    for (const double entry : P[k]) largest = std::max(largest, std::abs(entry));
    for (std::size_t i = 0; i < nx && answers >> found; ++i)
      TEST_ASSERT_TRUE(std::abs(found - x[k][i]) <= 1e-12 * std::max(1.0, std::abs(x[k][i])));
    for (std::size_t i = 0; i < np && answers >> found; ++i)
      TEST_ASSERT_TRUE(std::abs(found - P[k][i]) <= 1e-12 * largest);
    TEST_ASSERT_FALSE(answers.fail());
  }
}

void test_the_code_in_double_has_twelve_digits_of_the_reference() {
  for (const char* arithmetic : {"plain", "fused"}) {
    expect_reference("ship", named("ship", ship_plant + ship_filter + code("double", arithmetic)), reference::ship_y,
                     reference::ship_u, reference::ship_x, reference::ship_P);
    // Its P needs a function only where it is U and d.
    expect_reference("cart", named("cart", cart_plant + cart_filter + code("double", arithmetic)), reference::cart_y,
                     reference::cart_u, reference::cart_x, reference::cart_P);
  }
}

// Where h has no value its output is left out and its bit set; where f has none, all begins anew.
void test_what_has_no_value_is_told() {
  const std::string design = R"--([plant]
domain = "discrete"
sample_time = 1
states = ["a", "b"]
outputs = ["level", "other"]
f = ["a", "b/a"]
h = ["log(a)", "b"]
[kalman]
gain = "extended"
process_noise = [0.01, 0.01]
measurement_noise = [0.1, 0.1]
initial_state = [1, 2]
)--";
  const auto controller = controller_of(named("guarded", design + code("float", "plain")));
  TEST_ASSERT_EQUAL_STRING("1 1 1\n", run_with_header(controller, R"--(#include <stdio.h>
#include "guarded.h"
int main(void)
{
    static const float y[2] = {0.0f, 2.0f};
    guarded_t self;
    lqg_status_t update, predict;
    guarded_init(&self);
    self.x[0] = -1.0f;
    update = guarded_update(&self, y);
    self.x[0] = 0.0f;
    predict = guarded_predict(&self);
    printf("%d %d %d\n", update == (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(0)),
           (predict & LQG_STATE_RESET) != 0u, self.x[0] == 1.0f && self.x[1] == 2.0f);
    return 0;
}
)--")
                                          .c_str());
}

void expect_refusal(const std::string& text, const std::string& key) {
  const lqg::input::DesignFile file = lqg::input::parse_design(text);
  lqg::design::Findings findings = file.findings;
  if (file.problem) lqg::design::solve(*file.problem, findings);
  for (const lqg::design::Finding& finding : findings)
    if (finding.severity == lqg::design::Severity::error && finding.key.rfind(key, 0) == 0) return;
  TEST_FAIL_MESSAGE((key + " is not refused in\n" + text).c_str());
}

void test_what_does_not_go_with_it_is_refused() {
  const std::string start = named("refused", "");
  expect_refusal(start + R"--([plant]
sample_time = 1
A = [[1]]
C = [[1]]
[kalman]
gain = "extended"
process_noise = [1]
measurement_noise = [1]
)--",
                 "kalman.gain");
  const std::string plant = start + R"--([plant]
domain = "discrete"
sample_time = 1
states = ["a"]
outputs = ["y"]
f = ["a"]
h = ["a"]
)--";
  const std::string filter = R"--([kalman]
gain = "extended"
process_noise = [1]
measurement_noise = [1]
)--";
  expect_refusal(plant + filter + "form = \"predictor\"\n", "kalman.form");
  expect_refusal(plant + filter + "wraps = [\"z\"]\n", "kalman.wraps");
  expect_refusal(plant + filter + "cross_noise = [[0.5]]\n", "kalman.cross_noise");
  expect_refusal(plant + filter + "integrator = \"heun\"\n", "kalman.integrator");
  expect_refusal(plant + filter + "integrator = \"rk4\"\n", "kalman.integrator");  // of a discrete plant
  expect_refusal(plant + filter + "[code]\nstyle = \"compact\"\n", "code.style");
  expect_refusal(plant + filter + "[code]\nrealisation = \"modal\"\n", "code.realisation");
  expect_refusal(plant + "output_delay = [1]\n" + filter, "plant.output_delay");
  expect_refusal(plant + filter + "[[stage]]\nfrom = 3\nprocess_noise = [2]\n", "stage");
}

}  // namespace

void setUp(void) {}
void tearDown(void) {}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_the_code_has_the_bits_of_the_host_in_every_arithmetic);
  RUN_TEST(test_all_functions_as_c_and_as_cpp);
  RUN_TEST(test_a_filter_without_inputs_and_one_by_euler);
  RUN_TEST(test_a_law_about_the_operating_point);
  RUN_TEST(test_the_code_in_double_has_twelve_digits_of_the_reference);
  RUN_TEST(test_what_has_no_value_is_told);
  RUN_TEST(test_what_does_not_go_with_it_is_refused);
  return UNITY_END();
}
