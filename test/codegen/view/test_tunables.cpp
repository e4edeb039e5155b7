// SPDX-License-Identifier: MIT
// Sliders: each has a number of the file, a name that a person knows, and a range that holds the number. Arguments:
// design files, all of whose sliders are tried.
#include <algorithm>
#include <cmath>
#include <string>

#include <unity.h>

#include "input/edit.hpp"
#include "view/tunables.hpp"

using namespace lqg;
using namespace lqg::view;

namespace {

std::vector<std::string> design_files;

const std::string plant = R"(name = "t"
[plant]
domain = "continuous"
sample_time = 0.01
A = [[0, 1], [0, -1]]
B = [[0], [1]]
C = [[1, 0]]
states = ["angle [rad]", "speed [rad/s]"]
inputs = ["voltage [V]"]
outputs = ["angle [rad]"]
)";

std::vector<Tunable> of(const std::string& text) {
  const input::DesignFile file = input::parse_design(text);
  for (const design::Finding& finding : file.findings) TEST_ASSERT_TRUE_MESSAGE(file.problem, finding.message.c_str());
  return tunables(file);
}

const Tunable* find(const std::vector<Tunable>& all, const std::string& key) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Tunable& tunable) {
    return std::any_of(tunable.targets.begin(), tunable.targets.end(),
                       [&](const Target& target) { return target.key == key; });
  });
  return found == all.end() ? nullptr : &*found;
}

const Tunable& at(const std::vector<Tunable>& all, const std::string& key) {
  const Tunable* const found = find(all, key);
  TEST_ASSERT_NOT_NULL_MESSAGE(found, key.c_str());
  return *found;
}

void test_parameters_that_are_numbers_have_sliders() {
  const std::string text =
      plant +
      "[lqr]\nQ = [\"R\", 1]\nR = [1]\n[parameters]\nR = { unit = \"ohm\", value = 2.5 }\nb = 0\nk = "
      "-3.0  # stays\nL = \"R/2\"\nJ = { value = \"R/3\" }\n";
  const auto all = of(text);
  const Tunable& R = at(all, "parameters.R.value");
  TEST_ASSERT_EQUAL_STRING("Parameters", R.group.c_str());
  TEST_ASSERT_EQUAL_STRING("R", R.name.c_str());
  TEST_ASSERT_EQUAL_STRING("ohm", R.unit.c_str());
  TEST_ASSERT_TRUE(R.scale == Scale::logarithmic && R.low == 0.25 && R.high == 25);
  TEST_ASSERT_TRUE(at(all, "parameters.b").low == 0 && at(all, "parameters.b").high > 0);
  TEST_ASSERT_TRUE(at(all, "parameters.k").low == -12 && at(all, "parameters.k").high == 0);
  for (const char* expression : {"parameters.L", "parameters.J", "parameters.J.value", "lqr.Q[0]"})
    TEST_ASSERT_NULL_MESSAGE(find(all, expression), expression);
  const auto changed = input::set_numbers(text, {{"parameters.R.value", 3}, {"parameters.k", -4}});
  std::string wanted = text;
  wanted.replace(wanted.find("2.5"), 3, "3.0").replace(wanted.find("-3.0"), 4, "-4.0");
  TEST_ASSERT_EQUAL_STRING(wanted.c_str(), std::get<std::string>(changed).c_str());
  const input::DesignFile file = input::parse_design(std::get<std::string>(changed));
  TEST_ASSERT_TRUE(file.problem->regulator->Q(0, 0) == 3);
}

void test_weights_and_noises_have_names_and_decades() {
  const auto all = of(plant +
                      "[lqr]\nQ = [4, 0]\nR = [[0.1]]\n[kalman]\nprocess_noise = [[1e-3, 0], [0, 2]]\n"
                      "measurement_noise = [1e-6]\n");
  const Tunable& weight = at(all, "lqr.Q[0]");
  TEST_ASSERT_EQUAL_STRING("angle", weight.name.c_str());
  TEST_ASSERT_EQUAL_STRING("Weights of the states, lqr.Q", weight.group.c_str());
  TEST_ASSERT_TRUE(weight.scale == Scale::logarithmic && weight.low == 4e-3 && weight.high == 4e3);
  TEST_ASSERT_TRUE(at(all, "lqr.Q[1]").scale == Scale::linear);
  TEST_ASSERT_EQUAL_DOUBLE(4, at(all, "lqr.Q[1]").high);
  TEST_ASSERT_EQUAL_STRING("voltage", at(all, "lqr.R[0][0]").name.c_str());
  TEST_ASSERT_EQUAL_STRING("speed", at(all, "kalman.process_noise[1][1]").name.c_str());
  TEST_ASSERT_EQUAL_STRING("angle", at(all, "kalman.measurement_noise[0]").name.c_str());
  TEST_ASSERT_NULL(find(all, "kalman.process_noise[0][1]"));
  TEST_ASSERT_NULL(find(all, "plant.A[1][1]"));
}

void test_acceptable_values_and_limits_have_the_units_of_their_signals() {
  const auto all = of(plant +
                      "[lqr]\nbryson = { states = [0.1, 2], inputs = [12], rho = 2 }\n"
                      "[limits]\nu_min = [-12]\nu_max = [inf]\nu_rate = [100]\n");
  TEST_ASSERT_EQUAL_STRING("rad/s", at(all, "lqr.bryson.states[1]").unit.c_str());
  TEST_ASSERT_EQUAL_STRING("V", at(all, "lqr.bryson.inputs[0]").unit.c_str());
  TEST_ASSERT_EQUAL_STRING("rho", at(all, "lqr.bryson.rho").name.c_str());
  TEST_ASSERT_EQUAL_STRING("V", at(all, "limits.u_min[0]").unit.c_str());
  TEST_ASSERT_EQUAL_DOUBLE(-48, at(all, "limits.u_min[0]").low);
  TEST_ASSERT_EQUAL_DOUBLE(0, at(all, "limits.u_min[0]").high);
  TEST_ASSERT_NULL(find(all, "limits.u_max[0]"));
  TEST_ASSERT_EQUAL_STRING("V/s", at(all, "limits.u_rate[0]").unit.c_str());
}

void test_sizes_of_disturbances_have_the_names_of_their_inputs() {
  const std::string begin = plant + "[lqr]\nQ = [1, 1]\nR = [1]\n[kalman]\nprocess_noise = [1, 1]\n";
  const auto all = of(begin + "measurement_noise = [1]\ndisturbance = { voltage = 0.5 }\n");
  const Tunable& size = at(all, "kalman.disturbance.voltage");
  TEST_ASSERT_EQUAL_STRING("voltage", size.name.c_str());
  TEST_ASSERT_EQUAL_STRING("V/√s", size.unit.c_str());
  TEST_ASSERT_EQUAL_STRING("Disturbances, kalman.disturbance", size.group.c_str());
  TEST_ASSERT_TRUE(size.scale == Scale::logarithmic && size.low == 0.005 && size.high == 50);
  const auto by_default = of(begin + "measurement_noise = [1]\ndisturbance = [0]\n[limits]\nu_max = [1]\n");
  TEST_ASSERT_NULL(find(by_default, "kalman.disturbance[0]"));
}

void test_times_steps_and_gates_have_fitting_scales() {
  const auto all = of(plant +
                      "delay = 0.02\n[lqr]\nQ = [1, 1]\nR = [1]\nhorizon = 30\n"
                      "[kalman]\nprocess_noise = [1, 1]\nmeasurement_noise = [1]\ngate = 4\nspike = 300\n"
                      "recovery = 0.5\n");
  TEST_ASSERT_TRUE(at(all, "plant.sample_time").scale == Scale::logarithmic);
  TEST_ASSERT_EQUAL_STRING("s", at(all, "plant.sample_time").unit.c_str());
  TEST_ASSERT_EQUAL_DOUBLE(0.05, at(all, "plant.delay").high);
  TEST_ASSERT_EQUAL_DOUBLE(0, at(all, "plant.delay").step);
  TEST_ASSERT_TRUE(at(all, "lqr.horizon").scale == Scale::whole);
  TEST_ASSERT_EQUAL_DOUBLE(120, at(all, "lqr.horizon").high);
  TEST_ASSERT_EQUAL_DOUBLE(10, at(all, "kalman.gate").high);
  TEST_ASSERT_TRUE(at(all, "kalman.spike").scale == Scale::logarithmic);
  TEST_ASSERT_EQUAL_STRING("recovery", at(all, "kalman.recovery").name.c_str());
  TEST_ASSERT_EQUAL_DOUBLE(5e-4, at(all, "kalman.recovery").low);
}

void test_delay_and_factor_of_R_are_there_although_the_file_leaves_them_out() {
  const std::string text = plant + "[lqr]\nbryson = { states = [1, 1], inputs = [1] }\n";
  const auto all = of(text);
  const Tunable& delay = at(all, "plant.delay");
  TEST_ASSERT_TRUE(delay.value == 0 && delay.low == 0 && delay.high >= 0.01);
  const Tunable& rho = at(all, "lqr.bryson.rho");
  TEST_ASSERT_TRUE(rho.value == 1 && rho.scale == Scale::logarithmic);
  TEST_ASSERT_NULL(find(of(plant + "[lqr]\nQ = [1, 1]\nR = [1]\n"), "lqr.bryson.rho"));
  const auto longer = input::set_numbers(text, {{"plant.delay", 0.005}, {"lqr.bryson.rho", 4}});
  const input::DesignFile file = input::parse_design(std::get<std::string>(longer));
  TEST_ASSERT_TRUE(file.problem->plant.delay == 0.005 && file.problem->regulator->bryson->rho == 4);
}

void test_the_delay_of_samples_moves_by_whole_samples() {
  const auto all =
      of("name = \"t\"\n[plant]\ndomain = \"discrete\"\nsample_time = 0.1\ndelay = 0.2\nA = [[0.5]]\n"
         "B = [[1]]\n[lqr]\nQ = [1]\nR = [1]\n");
  TEST_ASSERT_EQUAL_DOUBLE(0.1, at(all, "plant.delay").step);
}

void test_conjugate_poles_move_together() {
  const auto all = of(plant +
                      "[pole_placement]\npoles = [[0.9, -0.1], [0.9, 0.1]]\n"
                      "[observer]\ncontinuous_poles = [-30, -40]\n");
  const Tunable& real = at(all, "pole_placement.poles[0][0]");
  TEST_ASSERT_EQUAL_UINT(2, real.targets.size());
  TEST_ASSERT_EQUAL_DOUBLE(1, real.targets[0].factor * real.targets[1].factor);
  const Tunable& imaginary = at(all, "pole_placement.poles[0][1]");
  TEST_ASSERT_EQUAL_UINT(2, imaginary.targets.size());
  TEST_ASSERT_EQUAL_STRING("pole_placement.poles[1][1]", imaginary.targets[0].key.c_str());
  TEST_ASSERT_EQUAL_DOUBLE(-1, imaginary.targets[0].factor * imaginary.targets[1].factor);
  TEST_ASSERT_EQUAL_DOUBLE(0.1, imaginary.value);
  TEST_ASSERT_EQUAL_STRING("1/s", at(all, "observer.continuous_poles[1]").unit.c_str());
  TEST_ASSERT_EQUAL_DOUBLE(-160, at(all, "observer.continuous_poles[1]").low);
}

// Of every slider of every design: its ends make a file that is one, with these values and no others.
void check_slider(const input::DesignFile& file, const Tunable& tunable) {
  const std::string key = tunable.targets.front().key;
  TEST_ASSERT_TRUE_MESSAGE(tunable.low <= tunable.value && tunable.value <= tunable.high, key.c_str());
  TEST_ASSERT_TRUE_MESSAGE(tunable.low < tunable.high, key.c_str());
  TEST_ASSERT_TRUE_MESSAGE(tunable.scale != Scale::logarithmic || tunable.low > 0, key.c_str());
  TEST_ASSERT_FALSE(tunable.name.empty() || tunable.group.empty());
  const double inside = tunable.scale == Scale::logarithmic ? std::sqrt(tunable.low * tunable.high)
                                                            : std::floor((tunable.low + tunable.high) / 2 + 1);
  std::vector<input::Change> changes;
  for (const Target& target : tunable.targets) changes.push_back({target.key, target.factor * inside});
  const auto text = input::set_numbers(file.text, changes);
  TEST_ASSERT_TRUE_MESSAGE(std::holds_alternative<std::string>(text), key.c_str());
  const input::DesignFile changed = input::parse_design(std::get<std::string>(text));
  const auto again = tunables(input::parse_design(file.text));
  TEST_ASSERT_TRUE_MESSAGE(find(again, key) != nullptr, key.c_str());
  if (changed.problem) TEST_ASSERT_EQUAL_DOUBLE(inside, at(tunables(changed), key).value);
}

void test_every_slider_of_every_design_sets_its_number() {
  TEST_ASSERT_TRUE(design_files.size() > 5);
  for (const std::string& path : design_files) {
    const input::DesignFile file = input::read_design_file(path);
    TEST_ASSERT_TRUE_MESSAGE(file.problem.has_value(), path.c_str());
    const auto all = tunables(file);
    TEST_ASSERT_TRUE_MESSAGE(all.size() >= 3, path.c_str());
    for (const Tunable& tunable : all) check_slider(file, tunable);
  }
}

}  // namespace

int main(int argc, char** argv) {
  design_files.assign(argv + 1, argv + argc);
  UNITY_BEGIN();
  RUN_TEST(test_parameters_that_are_numbers_have_sliders);
  RUN_TEST(test_weights_and_noises_have_names_and_decades);
  RUN_TEST(test_acceptable_values_and_limits_have_the_units_of_their_signals);
  RUN_TEST(test_sizes_of_disturbances_have_the_names_of_their_inputs);
  RUN_TEST(test_times_steps_and_gates_have_fitting_scales);
  RUN_TEST(test_delay_and_factor_of_R_are_there_although_the_file_leaves_them_out);
  RUN_TEST(test_the_delay_of_samples_moves_by_whole_samples);
  RUN_TEST(test_conjugate_poles_move_together);
  RUN_TEST(test_every_slider_of_every_design_sets_its_number);
  return UNITY_END();
}
