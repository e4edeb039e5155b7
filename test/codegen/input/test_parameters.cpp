// SPDX-License-Identifier: MIT
// [parameters], and expressions in place of numbers: values against many digits of another program, and what is said of
// those that are wrong.
#include <cstdlib>
#include <initializer_list>
#include <string>

#include <unity.h>

#include "design/exact_matrix.hpp"
#include "design/numeric/digits.hpp"
#include "input/design_file.hpp"

using namespace lqg;
using input::Settings;

namespace {

// A design of one state; `a` and `b` stand in A and B, `parameters` in [parameters].
std::string design_of(const std::string& parameters, const std::string& a = "0", const std::string& b = "1") {
  return "name = \"d\"\n[parameters]\n" + parameters +
         "\n[plant]\ndomain = \"continuous\"\nsample_time = 0.01\nA = [[" + a + "]]\nB = [[" + b +
         "]]\n[lqr]\nQ = [1]\nR = [1]\n";
}

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

std::string lines(const input::DesignFile& file) {
  std::string text;
  for (const design::Finding& finding : file.findings)
    text += input::format("d.toml", input::locate(file, finding.key), finding) + "\n";
  return text;
}

design::Problem problem(const std::string& text, const Settings& settings = {}) {
  const input::DesignFile file = input::parse_design(text, {}, settings);
  if (!file.problem) TEST_FAIL_MESSAGE(lines(file).c_str());
  return *file.problem;
}

void expect_lines(const char* expected, const std::string& text, const Settings& settings = {}) {
  TEST_ASSERT_EQUAL_STRING(expected, lines(input::parse_design(text, {}, settings)).c_str());
}

const char* const motor = "R = 2.32\nKt = 0.0234\nKe = 0.0231\nJ = 1.08e-6\n";

// By mpmath 1.3.0 with mp.dps = 90: each number of the text is the double that it reads as, mpf(2.32).
const std::pair<const char*, const char*> values[] = {
    {"-Kt*Ke/(R*J)", "-215.73275862068965969162711331582675065555973860745827894798027"},
    {"2*pi*50", "314.15926535897932384626433832795028841971693993751058209749446"},
    {"sqrt(2)", "1.4142135623730950488016887242096980785696718753769480731766797"},
    {"sin(1) + cos(2) - tan(0.5)", "-0.12097834158303639360024537365074857344098943045696507124648965"},
    {"asin(0.3)*acos(-0.7)", "0.71486802288800021234565355650867101428395503935790337554665650"},
    {"atan(3) + atan2(-1, -2)", "-1.4288992721907326964184700745371983590908029409590888381093423"},
    {"exp(-2.5)*log(7)", "0.15973003190743609204271419733906547447642544388259779841263969"},
    {"tanh(0.1)", "0.099667994624955822614277043698624833255378754022911789316131972"},
    {"2^0.1 - 3^-2.5", "1.0076234326263347500581174207746721716820950361554586442039326"},
    {"-0.1^2^3", "-0.000000010000000000000004440892098500627024511141757845039210965327982"},
    {"1e16/3 - 3333333333333333", "0.33333333333333333333333333333333333333333333333333333333333333"},
    {"min(pi, R)/max(-R, 0.7)", "3.3142857142857142675881955163239737002834112191996458336701295"},
    {"abs(-Kt)*1.1e-3", "0.000025740000000000002277275590323313325034659688169523193855416407"},
    {"sin(1e22)", "-0.85220084976718880177270589375302936826176215041004365625650933"},
};

void test_an_entry_has_all_digits_of_its_expression_and_is_rounded_once() {
  const design::Digits scope(100);
  for (const auto& [text, digits] : values) {
    const design::ExactMatrix A = problem(design_of(motor, quoted(text))).plant.A;
    TEST_ASSERT_NOT_NULL_MESSAGE(A.exact(), text);
    const design::Real wanted(digits), found = design::real(A)(0, 0);
    TEST_ASSERT_TRUE_MESSAGE(abs(found - wanted) < abs(wanted) * design::Real("1e-60"), text);
    TEST_ASSERT_TRUE_MESSAGE(A(0, 0) == std::strtod(digits, nullptr), text);
  }
}

void test_what_is_a_double_is_kept_as_one() {
  const design::ExactMatrix A = problem(design_of(motor, "\"3*0.25\"")).plant.A;
  TEST_ASSERT_NULL(A.exact());
  TEST_ASSERT_TRUE(A(0, 0) == 0.75);
}

void test_what_cancels_in_all_digits_is_0() {
  for (const char* zero : {"sin(pi)", "1/3*3 - 1", "sqrt(2)^2 - 2", "cos(pi/2)", "exp(log(7)) - 7", "tan(pi)"})
    TEST_ASSERT_TRUE_MESSAGE(problem(design_of(motor, quoted(zero))).plant.A(0, 0) == 0, zero);
  TEST_ASSERT_TRUE(problem(design_of(motor, "\"1 + 1e-200 - 1\"")).plant.A(0, 0) == 1e-200);
}

void test_digits_reach_symmetric_weights() {
  const std::string text = R"(name = "d"
[parameters]
q = 0.1
[plant]
domain = "continuous"
sample_time = 0.01
A = [[0, 1], [0, 0]]
B = [[0], [1]]
[lqr]
Q = [[1, "q/3"], ["q/3", "1/3"]]
R = ["q/7"]
)";
  const design::Regulator regulator = *problem(text).regulator;
  const design::Digits scope(100);
  const design::Real tenth(0.1);
  TEST_ASSERT_TRUE(abs(design::real(regulator.Q)(0, 1) - tenth / 3) < design::Real("1e-95"));
  TEST_ASSERT_TRUE(abs(design::real(regulator.Q)(1, 0) - tenth / 3) < design::Real("1e-95"));
  TEST_ASSERT_TRUE(abs(design::real(regulator.R)(0, 0) - tenth / 7) < design::Real("1e-95"));
}

void test_any_number_may_be_an_expression() {
  const design::Problem all = problem(R"(name = "d"
[parameters]
T = "1/400"
range = 12
N = 3
[plant]
domain = "continuous"
sample_time = "T"
delay = "T/2"
A = [[0, 1], [0, -1]]
B = [[0], [1]]
C = [[1, 0]]
states = ["angle", "speed"]
inputs = ["voltage"]
[lqr]
Q = ["1/N^2", 1]
R = [1]
settling_time = "100*T"
[limits]
u_max = ["range*0.5"]
u_min = ["-range"]
states = { speed = ["-N", "2*N"] }
horizon = "2*N"
blocks = ["N", "1", "N - 1"]
price = { speed = "10^N" }
[kalman]
process_noise = [0, "T"]
measurement_noise = [1e-6]
disturbance = { voltage = "range/100" }
[require]
gain_margin_dB = "N"
[[scenario]]
name = "s"
duration = "1000*T"
[[scenario.load]]
input = "voltage"
value = "range/4"
)");
  TEST_ASSERT_TRUE(all.plant.sample_time == 0.0025 && all.plant.delay == 0.00125);
  TEST_ASSERT_TRUE(all.regulator->Q(0, 0) == 1.0 / 9 && *all.regulator->settling_time == 0.25);
  TEST_ASSERT_TRUE(all.limits->u_max(0) == 6 && all.limits->u_min(0) == -12 && all.limits->horizon == 6);
  TEST_ASSERT_TRUE(all.limits->states.range(1, 0) == -3 && all.limits->states.range(1, 1) == 6);
  TEST_ASSERT_EQUAL_INT(3, all.limits->blocks.size());
  TEST_ASSERT_EQUAL_INT(2, all.limits->blocks[2]);
  TEST_ASSERT_TRUE(all.limits->states.price(1) == 1000);
  TEST_ASSERT_TRUE(all.estimator->disturbance[0].size == 0.12 && all.estimator->W(1, 1) == 0.0025);
  TEST_ASSERT_TRUE(*all.requirements.gain_margin_dB == 3);
  TEST_ASSERT_TRUE(all.scenarios[0].duration == 2.5 && all.scenarios[0].load[0].value == 3);
}

void test_poles_may_be_expressions() {
  const design::Problem placed = problem(R"(name = "d"
[parameters]
w = 2
[plant]
domain = "continuous"
sample_time = 0.01
A = [[0, 1], [0, 0]]
B = [[0], [1]]
[pole_placement]
continuous_poles = [["-w", "w/2"], ["-w", "-w/2"]]
)");
  TEST_ASSERT_TRUE(placed.regulator->poles->values[0] == std::complex<double>(-2, 1));
}

void test_words_stay_words() {
  expect_lines(
      "d.toml:8:8: lqr.cost: expected \"sampled\", \"discrete\" or \"continuous\", found \"2*3\"\n"
      "d.toml:11:12: plant.states[0]: expected a C identifier (letters, digits and _, a letter first), found \"2*a\"\n",
      "name = \"d\"\n[parameters]\na = 1\n[lqr]\nQ = [1]\nR = [1]\n\ncost = \"2*3\"\n[plant]\ndomain = "
      "\"continuous\"\nstates = [ \"2*a\"]\nsample_time = 0.01\nA = [[0]]\nB = [[1]]\n");
}

void test_names_of_signals_may_be_parameters() {
  TEST_ASSERT_TRUE(
      problem(design_of("x = 2\ny = \"x^2\"\nu = 3\ni = 1\np = 1\nL = 7\ne = 1", "\"x*y*u*i*p*L*e\"")).plant.A(0, 0) ==
      168);
}

void test_order_of_the_table_does_not_matter() {
  const design::Problem late = problem(design_of("c = \"a + b\"\nb = \"2*a\"\na = 3", "\"c\""));
  TEST_ASSERT_TRUE(late.plant.A(0, 0) == 9);
  TEST_ASSERT_EQUAL_STRING("c", late.parameters[0].name.c_str());
  TEST_ASSERT_EQUAL_STRING("a + b", late.parameters[0].formula.c_str());
  TEST_ASSERT_EQUAL_STRING("plant.A[0][0]", late.formulas[0].key.c_str());
}

void test_circle_is_shown_once() {
  expect_lines(
      "d.toml:3:6: parameters.a: expected a value that does not hang on itself, found the circle a → b → c → a\n",
      design_of("a = \"b + 1\"\nb = \"2*c\"\nc = \"sin(a)\"\nd = \"c\"", "\"d\""));
}

void test_long_circle_is_cut() {
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "p" + std::to_string(i) + " = \"p" + std::to_string((i + 1) % 1000) + "\"\n";
  expect_lines(
      "d.toml:3:7: parameters.p0: expected a value that does not hang on itself, found the circle p0 → p1 → p2 → p3 → "
      "p4 → p5 → p6 → p7 → … → p0\n",
      design_of(many, "\"p7\""));
  expect_lines("d.toml:2:1: parameters: expected at most 1000 parameters, found 1001\n", design_of(many + "q = 1"));
}

void test_chain_of_parameters_that_doubles_is_no_burden() {
  std::string chain = "p0 = 1\n";
  for (int i = 1; i < 400; ++i)
    chain += "p" + std::to_string(i) + " = \"p" + std::to_string(i - 1) + " + p" + std::to_string(i - 1) + "\"\n";
  TEST_ASSERT_TRUE(problem(design_of(chain, "\"p399/p397\"")).plant.A(0, 0) == 4);
}

void test_name_that_is_not_there_has_its_place_and_the_nearest() {
  expect_lines(
      "d.toml:11:14: plant.A[0][0]: expected the name of a parameter, a function or pi, found \"Ktt\"; did you mean "
      "`Kt`?\n",
      design_of(motor, "\"2*R + Ktt\""));
  expect_lines(
      "d.toml:11:8: plant.A[0][0]: expected a number or an expression, found \"fast\": no parameter has this name\n",
      design_of(motor, "\"fast\""));
  expect_lines(
      "d.toml:3:13: parameters.a: expected the name of a parameter, a function or pi, found \"cosh\"; did you mean "
      "`cos`?\n",
      design_of("a = \"1 + 2*(cosh - 1)\""));
}

void test_place_counts_characters_and_stays_at_a_string_with_escapes() {
  expect_lines("d.toml:3:30: parameters.a: expected the name of a parameter, a function or pi, found \"q\"\n",
               design_of("a = { unit = \"Ω\", value = \"2*q\" }"));
  expect_lines("d.toml:3:5: parameters.a: expected the name of a parameter, a function or pi, found \"q\"\n",
               design_of("a = \"2\\u002aq\""));
}

void test_text_that_is_no_expression_is_refused_where_it_goes_wrong() {
  expect_lines(
      "d.toml:8:20: plant.A[0][0]: expected a number or an expression, found \"2 R\": expected an operator or the end, "
      "found R\n",
      "name = \"d\"\n[parameters]\nR = 1\n[plant]\ndomain = \"continuous\"\nsample_time = 0.01\nB = [[1]]\nA = [[     "
      "     \"2 R\"]]\n[lqr]\nQ = [1]\nR = [1]\n");
}

void test_values_that_are_no_finite_numbers_have_a_reason() {
  const std::pair<const char*, const char*> wrong[] = {
      {"1/0", "d.toml:11:9: plant.A[0][0]: 1/0 is no finite number\n"},
      {"sqrt(-1)", "d.toml:11:8: plant.A[0][0]: sqrt(-1) is no finite number\n"},
      {"2*log(0)", "d.toml:11:10: plant.A[0][0]: log(0) is no finite number\n"},
      {"asin(2)", "d.toml:11:8: plant.A[0][0]: asin(2) is no finite number\n"},
      {"(-8)^0.5", "d.toml:11:12: plant.A[0][0]: (-8)^0.5 is no finite number\n"},
      {"0^-1", "d.toml:11:9: plant.A[0][0]: 0^-1 is no finite number\n"},
      {"exp(1000)", "d.toml:11:8: plant.A[0][0]: its value is beyond what a double can be\n"},
      {"exp(-1000)", "d.toml:11:8: plant.A[0][0]: its value is not 0, but nearer to it than a double can be\n"},
      {"sin(10^(10^9))", "d.toml:11:14: plant.A[0][0]: 10^1e+09 is too large\n"},
      {"1/(1/3*3 - 1)", "d.toml:11:9: plant.A[0][0]: 1/0 is no finite number\n"},
      {"1/sin(pi)",
       "d.toml:11:9: plant.A[0][0]: its value hangs on a part that is 0, whatever digits it is computed with\n"}};
  for (const auto& [text, line] : wrong) expect_lines(line, design_of(motor, quoted(text)));
}

void test_whole_numbers_are_whole_in_all_digits() {
  const auto horizon = [](const std::string& text) {
    return design_of("N = 4\nM = 0.1") + "horizon = " + quoted(text) + "\n";
  };
  TEST_ASSERT_EQUAL_INT(8, problem(horizon("2*N")).regulator->horizon);
  expect_lines(
      "d.toml:13:11: lqr.horizon: expected a whole number from 0 to 100000, found 3.000000000000000166533454\n",
      horizon("30*M"));
}

void test_what_stands_in_the_table_is_a_number_or_an_expression() {
  expect_lines(
      "d.toml:3:1: parameters.sin: expected a name that no function has, and not pi, found \"sin\"\n"
      "d.toml:4:1: parameters.\"a b\": expected a C identifier (letters, digits and _, a letter first), found \"a b\"\n"
      "d.toml:5:5: parameters.a: expected a number, an expression in quotes, or { value = …, unit = \"…\" }, found an "
      "array\n"
      "d.toml:6:7: parameters.b: expected value and unit, found \"val\"\n"
      "d.toml:7:5: parameters.c: expected value = …, found none\n"
      "d.toml:8:5: parameters.d: expected a finite number, found inf\n"
      "d.toml:9:15: parameters.e: expected a number or an expression in quotes, found a boolean\n"
      "d.toml:10:25: parameters.f.unit: expected a unit in quotes, found a number\n",
      design_of(
          "sin = 1\n\"a b\" = 2\na = [1]\nb = { val = 2 }\nc = { unit = \"m\" }\nd = inf\ne = { value = true }\nf = "
          "{ value = 1, unit = 3 }",
          "\"a + b + c + d + e + f\""));
  expect_lines("d.toml:2:14: parameters: expected a table of numbers and expressions, found a number\n",
               "name = \"d\"\nparameters = 3\n[plant]\ndomain = \"continuous\"\nsample_time = 1\nA = [[0]]\nB = "
               "[[1]]\n[lqr]\nQ = [1]\nR = [1]\n");
}

void test_hostile_texts_end_in_refusals() {
  const auto is_refused = [](const std::string& text) {
    const input::DesignFile file = input::parse_design(text);
    TEST_ASSERT_FALSE(file.problem);
    for (const design::Finding& finding : file.findings) TEST_ASSERT_TRUE(finding.message.size() < 1000);
  };
  is_refused(design_of("", quoted(std::string(3000, '(') + "1" + std::string(900, ')'))));
  is_refused(design_of("", quoted(std::string(1000000, '1'))));
  is_refused(design_of("", quoted("1e999")));
  is_refused(design_of("", quoted("1" + std::string(900, '-'))));
  is_refused(design_of(std::string(1000000, 'a') + " = 1"));
  is_refused(design_of("", quoted(std::string(1000000, 'a'))));
  is_refused(design_of("a = \"" + std::string(1000, 'b') + "\"", "\"a\""));
  std::string much = "[[";
  for (int i = 0; i < 200; ++i)
    much += (i ? ", " : "") + quoted("1" + std::string(1500, ' ') + "+ 1.5" + std::string(1500, ' '));
  is_refused(design_of("", "0", "1") + "N = " + much + "]]\n");
}

void test_setting_takes_the_place_of_a_value() {
  const std::string text = design_of("R = { value = 2, unit = \"ohm\" }\nL = \"R/4\"", "\"-R\"", "\"L\"");
  const design::Problem set = problem(text, {{"R", "3"}});
  TEST_ASSERT_TRUE(set.plant.A(0, 0) == -3 && set.plant.B(0, 0) == 0.75);
  TEST_ASSERT_TRUE(set.parameters[0].is_set && !set.parameters[1].is_set);
  TEST_ASSERT_EQUAL_STRING("ohm", set.parameters[0].unit.c_str());
  TEST_ASSERT_TRUE(problem(text, {{"R", "3"}, {"L", "2*R"}}).plant.B(0, 0) == 6);
  TEST_ASSERT_TRUE(problem(text, {{"R", "3"}, {"R", "-5"}}).plant.A(0, 0) == 5);
}

void test_setting_that_is_wrong_says_so() {
  const std::string text = design_of("R = 2\nL = \"R/4\"", "\"-R\"", "\"L\"");
  expect_lines("d.toml:2:1: parameters: --set: expected the name of a parameter, found \"r\"; did you mean `R`?\n",
               text, {{"r", "3"}});
  expect_lines(
      "d.toml:3:5: parameters.R: --set: expected a number or an expression, found \"2*\": expected a number, a "
      "name or (, found the end\n",
      text, {{"R", "2*"}});
  expect_lines(
      "d.toml:3:5: parameters.R: --set: expected a value that does not hang on itself, found the circle R → L → R\n",
      text, {{"R", "L"}});
  expect_lines("d.toml:1:1: parameters: --set: expected the name of a parameter, found \"R\"\n",
               "name = \"d\"\nplant = { domain = \"continuous\", sample_time = 1, A = [[0]], B = [[1]] }\nlqr = { Q = "
               "[1], R = [1] }\n",
               {{"R", "3"}});
}

void test_text_of_a_setting_is_a_name_and_a_value() {
  TEST_ASSERT_EQUAL_STRING("R", input::setting_of("R=2=3")->name.c_str());
  TEST_ASSERT_EQUAL_STRING("2=3", input::setting_of("R=2=3")->value.c_str());
  TEST_ASSERT_FALSE(input::setting_of("R").has_value());
  TEST_ASSERT_FALSE(input::setting_of("=2").has_value());
}

// What a person would multiply by hand is the nearest double of the same.
void test_motor_of_parameters_is_the_motor_of_numbers() {
  const std::string head = "[plant]\ndomain = \"continuous\"\nsample_time = 0.001\n";
  const design::Problem named = problem(
      "name = \"d\"\n[parameters]\nR = 2.5\nL = 0.5\nKt = 0.25\nKe = 0.25\nJ = "
      "0.125\nb = 0.5\n" +
      head +
      "A = [[0, 1, 0], [0, \"-b/J\", \"Kt/J\"], [0, \"-Ke/L\", \"-R/L\"]]\nB = [[0], "
      "[0], [\"1/L\"]]\n[lqr]\nQ = [100, 0, 0]\nR = [1]\n");
  Eigen::Matrix3d A;
  A << 0, 1, 0, 0, -4, 2, 0, -0.5, -5;
  TEST_ASSERT_TRUE(named.plant.A == A);
  TEST_ASSERT_TRUE(named.plant.B == Eigen::Vector3d(0, 0, 2));
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_an_entry_has_all_digits_of_its_expression_and_is_rounded_once);
  RUN_TEST(test_what_is_a_double_is_kept_as_one);
  RUN_TEST(test_what_cancels_in_all_digits_is_0);
  RUN_TEST(test_digits_reach_symmetric_weights);
  RUN_TEST(test_any_number_may_be_an_expression);
  RUN_TEST(test_poles_may_be_expressions);
  RUN_TEST(test_words_stay_words);
  RUN_TEST(test_names_of_signals_may_be_parameters);
  RUN_TEST(test_order_of_the_table_does_not_matter);
  RUN_TEST(test_circle_is_shown_once);
  RUN_TEST(test_long_circle_is_cut);
  RUN_TEST(test_chain_of_parameters_that_doubles_is_no_burden);
  RUN_TEST(test_name_that_is_not_there_has_its_place_and_the_nearest);
  RUN_TEST(test_place_counts_characters_and_stays_at_a_string_with_escapes);
  RUN_TEST(test_text_that_is_no_expression_is_refused_where_it_goes_wrong);
  RUN_TEST(test_values_that_are_no_finite_numbers_have_a_reason);
  RUN_TEST(test_whole_numbers_are_whole_in_all_digits);
  RUN_TEST(test_what_stands_in_the_table_is_a_number_or_an_expression);
  RUN_TEST(test_hostile_texts_end_in_refusals);
  RUN_TEST(test_setting_takes_the_place_of_a_value);
  RUN_TEST(test_setting_that_is_wrong_says_so);
  RUN_TEST(test_text_of_a_setting_is_a_name_and_a_value);
  RUN_TEST(test_motor_of_parameters_is_the_motor_of_numbers);
  return UNITY_END();
}
