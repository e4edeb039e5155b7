// SPDX-License-Identifier: MIT
// plant.f, plant.h and plant.operating_point: what is accepted, what is refused, and where.
#include <cmath>
#include <string>

#include <unity.h>

#include "input/design_file.hpp"

using namespace lqg;
using input::DesignFile;

namespace {

const std::string head =
    "name = \"pendulum\"\n[parameters]\nl = { value = 0.5, unit = \"m\" }\ngravity = 9.81\n[plant]\n";
const std::string names =
    "domain = \"continuous\"\nsample_time = 0.01\nstates = [\"th [rad]\", \"om [rad/s]\"]\ninputs = [\"u\"]\n";
const std::string equations = "f = [\"om\", \"u - gravity/l*sin(th)\"]\nh = [\"th\"]\n";
const std::string point = "operating_point = { states = [0.5, 0], inputs = [\"?\"] }\n";
const std::string rest = "[lqr]\nQ = [1, 1]\nR = [1]\n[kalman]\nprocess_noise = [1, 1]\nmeasurement_noise = [1]\n";

DesignFile read(const std::string& plant) { return input::parse_design(head + plant + rest); }

void expect_equal(double expected, double found) {
  TEST_ASSERT_TRUE_MESSAGE(expected == found, (std::to_string(expected) + ", found " + std::to_string(found)).c_str());
}

std::string all_findings(const DesignFile& file) {
  std::string out;
  for (const design::Finding& finding : file.findings)
    out += input::format("p.toml", input::locate(file, finding.key), finding) + "\n";
  return out;
}

design::Problem accepted(const std::string& plant) {
  const DesignFile file = read(plant);
  TEST_ASSERT_TRUE_MESSAGE(file.problem.has_value(), all_findings(file).c_str());
  return *file.problem;
}

// One finding that begins so.
void expect_refusal(const std::string& plant, const std::string& expected) {
  const DesignFile file = read(plant);
  const std::string found = all_findings(file);
  TEST_ASSERT_FALSE_MESSAGE(file.problem.has_value(), expected.c_str());
  TEST_ASSERT_EQUAL_MESSAGE(1, file.findings.size(), found.c_str());
  TEST_ASSERT_TRUE_MESSAGE(found.rfind("p.toml:" + expected, 0) == 0, found.c_str());
}

void test_equations_become_the_matrices_of_their_linearisation() {
  const design::Plant plant = accepted(names + equations + point).plant;
  expect_equal(1, plant.A(0, 1));
  TEST_ASSERT_TRUE(std::abs(plant.A(1, 0) + 9.81 / 0.5 * std::cos(0.5)) < 1e-14);
  TEST_ASSERT_NOT_NULL(plant.A.exact());
  expect_equal(1, plant.B(1, 0));
  expect_equal(1, plant.C(0, 0));
  expect_equal(0, plant.D(0, 0));
  TEST_ASSERT_TRUE(plant.operating_point.has_value());
  expect_equal(0.5, plant.operating_point->x(0));
  TEST_ASSERT_TRUE(std::abs(plant.operating_point->u(0) - 9.81 / 0.5 * std::sin(0.5)) < 1e-14);
  expect_equal(0.5, plant.operating_point->y(0));
  TEST_ASSERT_EQUAL_STRING("u - gravity/l*sin(th)", plant.equations->f_text[1].c_str());
}

void test_names_without_a_list_are_those_of_matrices_and_a_plant_may_have_no_inputs() {
  const DesignFile file = input::parse_design(
      "name = \"p\"\n[plant]\ndomain = \"discrete\"\nsample_time = 1\n"
      "f = [\"x0/2 + x1^2\", \"\"\"x1/3\n + 0*x0\"\"\"]\nh "
      "= [\"x0\"]\noperating_point = {}\n[kalman]\nprocess_noise = [1, 1]\nmeasurement_noise = [1]\n");
  TEST_ASSERT_TRUE_MESSAGE(file.problem.has_value(), all_findings(file).c_str());
  expect_equal(0.5, file.problem->plant.A(0, 0));
  TEST_ASSERT_EQUAL(0, file.problem->plant.B.cols());
  TEST_ASSERT_EQUAL_STRING("x1/3 + 0*x0", file.problem->plant.equations->f_text[1].c_str());
}

void test_short_names_are_states_and_parameters_like_others() {
  const DesignFile file = input::parse_design(
      "name = \"p\"\n[parameters]\nL = 2\np = 3\n[plant]\ndomain = \"continuous\"\nsample_time = 0.1\nstates = "
      "[\"x\", \"y\", \"i\"]\ninputs = [\"u\"]\nf = [\"y\", \"i - x\", \"(u - i*p)/L\"]\nh = [\"x\"]\noperating_point "
      "= { states = [\"?\", \"?\", 1], inputs = [\"?\"] }\n[lqr]\nQ = [1, 1, 1]\nR = [1]\n");
  TEST_ASSERT_TRUE_MESSAGE(file.problem.has_value(), all_findings(file).c_str());
  expect_equal(3, file.problem->plant.operating_point->u(0));
}

void test_what_stands_beside_equations_is_refused() {
  expect_refusal(names + equations + point + "B = [[0], [1]]\n",
                 "13:5: plant.B: comes from plant.f and plant.h: expected one of the two");
  expect_refusal(names + equations + "operating_point = { states = [0, 0], outputs = [0] }\n",
                 "12:48: plant.operating_point.outputs: comes from plant.f and plant.h: expected one of the two");
  expect_refusal(names + "A = [[0, 1], [0, 0]]\nB = [[0], [1]]\nC = [[1, 0]]\noperating_point = { inputs = [\"?\"] }\n",
                 "13:31: plant.operating_point.inputs[0]: expected a number or a formula: \"?\" needs plant.f");
  expect_refusal(names + "A = [[0, 1], [0, 0]]\nB = [[0], [1]]\nC = [[1, 0]]\nh = [\"th\"]\n",
                 "13:5: plant.h: needs plant.f");
}

void test_a_missing_operating_point_is_asked_for() {
  expect_refusal(names + equations, "5:1: plant.operating_point: missing: where plant.f is linearised");
}

void test_a_wrong_name_is_told_with_its_place_and_a_likely_one() {
  expect_refusal(names + "f = [\"om\", \"u - gravty/l*sin(th)\"]\nh = [\"th\"]\n" + point,
                 "10:17: plant.f[1]: expected the name of a state, an input, a parameter, a function or pi, found "
                 "\"gravty\"; did you mean `gravity`?");
  expect_refusal(names + "f = [\"om\", \"u - \"]\nh = [\"th\"]\n" + point, "10:");
  expect_refusal(names + equations + "operating_point = { states = [\"th\", 0], inputs = [\"?\"] }\n",
                 "12:32: plant.operating_point.states[0]: expected the name of a parameter, a function or pi, found "
                 "\"th\"");
}

void test_lists_have_their_form_and_length() {
  const auto with_f = [](const std::string& f) { return names + "f = " + f + "\nh = [\"th\"]\n" + point; };
  expect_refusal(with_f("\"om\""), "10:5: plant.f: expected an array of formulas in quotes, found a string");
  expect_refusal(with_f("[]"), "10:5: plant.f: expected an array of formulas in quotes, found an empty array");
  expect_refusal(with_f("[\"om\", true]"), "10:12: plant.f[1]: expected a formula in quotes, found a boolean");
  const std::string found = all_findings(read(with_f("[\"om\"]")));
  TEST_ASSERT_TRUE_MESSAGE(found.rfind("p.toml:8:10: plant.states: expected 1 name (nx), found 2", 0) == 0,
                           found.c_str());
  std::string many = "[";
  for (int i = 0; i < 257; ++i) many += "\"om\", ";
  TEST_ASSERT_TRUE(all_findings(read(with_f(many + "]"))).find("plant.f: expected at most 256, found 257") !=
                   std::string::npos);
}

void test_names_that_clash_are_refused() {
  const auto with_names = [](const std::string& states, const std::string& inputs) {
    return "domain = \"continuous\"\nsample_time = 0.01\nstates = " + states + "\ninputs = " + inputs + "\n" +
           "f = [\"0\", \"0\"]\nh = [\"0\"]\noperating_point = {}\n";
  };
  expect_refusal(with_names("[\"l\", \"om\"]", "[\"u\"]"),
                 "8:11: plant.states[0]: expected a name of its own in plant.f, found that of a parameter, \"l\"");
  expect_refusal(with_names("[\"a\", \"sin\"]", "[\"u\"]"), "8:16: plant.states[1]: expected a name of its own in");
  expect_refusal(with_names("[\"a\", \"b\"]", "[\"a\"]"),
                 "9:11: plant.inputs[0]: expected a name of its own in plant.f, found that of a state, \"a\"");
}

void test_units_have_to_be_those_of_the_signals() {
  expect_refusal(names + "f = [\"om + l\", \"u\"]\nh = [\"th\"]\n" + point, "10:10: plant.f[0]: ");
  expect_refusal(names + "f = [\"om\", \"u\"]\noutputs = [\"place [m]\"]\nh = [\"th*l*l\"]\n" + point,
                 "12:6: plant.h[0]: expected a formula in m, found one in m²");
}

void test_the_point_has_its_form() {
  const auto with_point = [](const std::string& text) {
    return names + equations + "operating_point = " + text + "\n";
  };
  expect_refusal(with_point("{ states = [0], inputs = [0] }"),
                 "12:30: plant.operating_point.states: expected 2 numbers (nx), found 1");
  expect_refusal(with_point("{ states = [0, true] }"),
                 "12:34: plant.operating_point.states[1]: expected a number, a formula or \"?\", found");
  expect_refusal(with_point("{ states = [0, 0], steady = [\"thh\"] }"),
                 "12:48: plant.operating_point.steady[0]: expected the name of a state, found \"thh\"; did you mean "
                 "`th`?");
  expect_refusal(with_point("{ steady = [\"th\"] }\nsteady = [\"th\"]"),
                 "13:10: plant.steady: says the same as operating_point.steady: expected one of the two");
  expect_refusal(with_point("{}\nsteady = [\"thh\"]"),
                 "13:11: plant.steady[0]: expected the name of a state, found \"thh\"; did you mean `th`?");
  expect_refusal(with_point("{ states = [0.5, 0], inputs = [0] }"),
                 "12:19: plant.operating_point: expected a point at rest, found dom/dt = -9.406");
  expect_equal(0, accepted(with_point("{ states = [\"? 0.1\", \"?\"] }")).plant.operating_point->x(0));
}

void test_a_scenario_has_other_parameters_of_equations_alone() {
  const std::string scenario = "[[scenario]]\nname = \"long\"\nduration = 1\nplant = { parameters = { ";
  const auto read_with = [&](const std::string& plant, const std::string& change) {
    return input::parse_design(head + plant + rest + scenario + change + " } }\n");
  };
  const DesignFile good = read_with(names + equations + point, "l = \"2*0.5\"");
  TEST_ASSERT_TRUE_MESSAGE(good.problem.has_value(), all_findings(good).c_str());
  expect_equal(1, good.problem->scenarios[0].plant.parameters.at("l"));
  TEST_ASSERT_EQUAL_STRING(
      "p.toml:22:26: scenario[0].plant.parameters: expected the name of a parameter, found \"gravty\"; did you mean "
      "`gravity`?\n",
      all_findings(read_with(names + equations + point, "gravty = 1")).c_str());
  const std::string matrices = "A = [[0, 1], [0, 0]]\nB = [[0], [1]]\nC = [[1, 0]]\n";
  TEST_ASSERT_TRUE(all_findings(read_with(names + matrices, "l = 1")).find("needs plant.f") != std::string::npos);
}

void test_matrices_of_stages_and_scenarios_need_a_plant_of_matrices() {
  const auto findings = [](const std::string& more) {
    return all_findings(input::parse_design(head + names + equations + point + rest + more));
  };
  const auto expect = [&](const std::string& more, const std::string& expected) {
    const std::string found = findings(more);
    TEST_ASSERT_TRUE_MESSAGE(found.find(expected) != std::string::npos, found.c_str());
  };
  expect("[[stage]]\nfrom = 5\nA = [[0, 1], [0, 0]]\n", "stage[0].A: needs a plant of matrices");
  const std::string scenario = "[[scenario]]\nname = \"s\"\nduration = 1\n";
  expect(scenario + "plant = { A = [[0, 1], [0, 0]] }\n", "scenario[0].plant.A: needs a plant of matrices");
  expect(scenario + "spread = { A = 0.1 }\n", "scenario[0].spread.A: needs a plant of matrices");
}

std::string designs;

// Whose matrices have 12 digits, computed from the same source by hand.
void test_the_robot_from_its_equations_is_the_one_of_matrices() {
  const auto plant_of = [](const char* name) {
    const DesignFile file = input::read_design_file(designs + "/" + name);
    TEST_ASSERT_TRUE_MESSAGE(file.problem.has_value(), all_findings(file).c_str());
    return file.problem->plant;
  };
  const design::Plant by_hand = plant_of("balancing_robot.toml"), found = plant_of("balancing_robot_equations.toml");
  const auto expect_same = [](const Eigen::MatrixXd& expected, const Eigen::MatrixXd& other, const char* what) {
    for (Eigen::Index i = 0; i < expected.size(); ++i)
      TEST_ASSERT_TRUE_MESSAGE(std::abs(other.data()[i] - expected.data()[i]) <= 5e-12 * std::abs(expected.data()[i]),
                               what);
  };
  expect_same(by_hand.A, found.A, "A");
  expect_same(by_hand.B, found.B, "B");
  expect_same(by_hand.C, found.C, "C");
  expect_same(by_hand.G, found.G, "G");
}

// A = [0 1 0; 980 0 −2.8; 0 0 −100] with i = 7 A; here i = √(mass g gap/K).
void test_the_levitated_ball_is_that_of_its_source() {
  const DesignFile file = input::read_design_file(designs + "/magnetic_levitation.toml");
  TEST_ASSERT_TRUE_MESSAGE(file.problem.has_value(), all_findings(file).c_str());
  const design::Plant& plant = file.problem->plant;
  const double i = std::sqrt(0.05 * 9.81 * 0.01 / 0.0001);
  TEST_ASSERT_TRUE(std::abs(plant.operating_point->x(2) - i) < 1e-14);
  TEST_ASSERT_TRUE(std::abs(plant.A(1, 0) - 980 * i * i / 49) < 1.1);
  TEST_ASSERT_TRUE(std::abs(plant.A(1, 2) + 2.8 * i / 7) < 1e-12);
  expect_equal(-100, plant.A(2, 2));
  expect_equal(100, plant.B(2, 0));
}

}  // namespace

int main(int, char** arguments) {
  designs = arguments[1];
  UNITY_BEGIN();
  RUN_TEST(test_the_robot_from_its_equations_is_the_one_of_matrices);
  RUN_TEST(test_the_levitated_ball_is_that_of_its_source);
  RUN_TEST(test_equations_become_the_matrices_of_their_linearisation);
  RUN_TEST(test_names_without_a_list_are_those_of_matrices_and_a_plant_may_have_no_inputs);
  RUN_TEST(test_short_names_are_states_and_parameters_like_others);
  RUN_TEST(test_what_stands_beside_equations_is_refused);
  RUN_TEST(test_a_missing_operating_point_is_asked_for);
  RUN_TEST(test_a_wrong_name_is_told_with_its_place_and_a_likely_one);
  RUN_TEST(test_lists_have_their_form_and_length);
  RUN_TEST(test_names_that_clash_are_refused);
  RUN_TEST(test_units_have_to_be_those_of_the_signals);
  RUN_TEST(test_the_point_has_its_form);
  RUN_TEST(test_a_scenario_has_other_parameters_of_equations_alone);
  RUN_TEST(test_matrices_of_stages_and_scenarios_need_a_plant_of_matrices);
  return UNITY_END();
}
