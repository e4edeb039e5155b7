// SPDX-License-Identifier: MIT
// From a design file to a problem: every key, every default, and where findings stand.
#include <cmath>
#include <cstdio>
#include <string>

#include <unity.h>

#include "input/design_file.hpp"

using namespace lqg;
using design::Problem;

namespace {

const std::string full = R"(name = "pair"
brief = "two masses, µ and °"
[plant]
domain = "continuous"
sample_time = 0.5
A = [[0, 1], [-0.5, -0.25]]
B = [[0, 3], [1, 4]]
C = [[1, 0.5]]
D = [[0.125, 2]]
G = [[1], [2]]
states = ["dx [m]", "v[m/s]"]
inputs = ["force", " torque [ N m ] "]
outputs = ["angle [°/s]"]
[lqr]
Q = [[2, 0.5], [0.5, 1]]
R = [3, 4]
N = [[0.25, 0], [0, 0.5]]
cost = "continuous"
[kalman]
process_noise = [[7]]
measurement_noise = [8]
cross_noise = [[0.0625]]
noise = "discrete"
gain = "online"
form = "predictor"
covariance = "plain"
initial_state = [5, 6]
initial_covariance = [9, 10]
[limits]
u_min = [-1, -inf]
u_max = [1, 2]
[code]
real = "double"
arithmetic = "fused"
style = "compact"
realisation = "cheapest"
flash = 1024
)";

const std::string more = R"(name = "more"
[plant]
domain = "continuous"
sample_time = 0.5
delay = 0.75
A = [[0, 1], [-0.5, -0.25]]
B = [[0, 3], [1, 4]]
C = [[1, 0.5], [0, 1]]
G = [[1], [2]]
H = [[0.5], [0.25]]
[lqr]
bryson = { outputs = [2, 4], inputs = [0.5, 8], rho = 3 }
settling_time = 2
horizon = 12
Q_final = [1, 2]
structure = [[1, 0], [0, 1]]
integral = { outputs = [1, 0], Q = [[2, 0.5], [0.5, 3]] }
track = [1]
anti_windup = "conditioning"
input_rate = [5, 6]
[kalman]
process_noise = [7]
measurement_noise = [0, 0]
process_correlation_time = [0.1]
measurement_correlation_time = [0.2, 0.3]
gain = "schedule"
horizon = 9
gate = 3
[limits]
u_rate = [10, inf]
[[stage]]
from = 4
A = [[0, 2], [-0.5, -0.25]]
R = [1, 2]
[[stage]]
from = 8
process_noise = [9]
[require]
gain_margin_dB = 6
phase_margin_deg = 30
disk_margin = 0.4
max_pole = 0.98
)";

const std::string placed = R"(name = "placed"
[plant]
domain = "discrete"
sample_time = 1
A = [[0, 1], [1, 0]]
B = [[0], [1]]
C = [[1, 0]]
[pole_placement]
continuous_poles = [[-1, -2], [-1, 2]]
[observer]
poles = [0.5, 0.25]
)";

const std::string least =
    "name = \"a\"\nplant = { domain = \"continuous\", sample_time = 1, A = [[0]], B = [[1]], C = [[1]] }\n";
const std::string lqr = "[lqr]\nQ = [1]\nR = [1]\n";
const std::string kalman = "[kalman]\nprocess_noise = [1]\nmeasurement_noise = [1]\n";

std::string lines(const input::DesignFile& file) {
  std::string text;
  for (const design::Finding& finding : file.findings)
    text += input::format("d.toml", input::locate(file, finding.key), finding) + "\n";
  return text;
}

Problem problem(const std::string& text) {
  const input::DesignFile file = input::parse_design(text);
  if (!file.problem) TEST_FAIL_MESSAGE(lines(file).c_str());
  return *file.problem;
}

void expect_lines(const char* expected, const std::string& text) {
  TEST_ASSERT_EQUAL_STRING(expected, lines(input::parse_design(text)).c_str());
}

void expect_matrix(std::initializer_list<double> row_by_row, const Eigen::MatrixXd& matrix) {
  TEST_ASSERT_EQUAL_INT(row_by_row.size(), matrix.size());
  const double* expected = row_by_row.begin();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j, ++expected) TEST_ASSERT_EQUAL_DOUBLE(*expected, matrix(i, j));
}

void expect_signal(const char* name, const char* unit, const design::Signal& signal) {
  TEST_ASSERT_EQUAL_STRING(name, signal.name.c_str());
  TEST_ASSERT_EQUAL_STRING(unit, signal.unit.c_str());
}

void test_plant_has_what_the_file_says() {
  const Problem p = problem(full);
  TEST_ASSERT_EQUAL_STRING("pair", p.name.c_str());
  TEST_ASSERT_EQUAL_STRING("two masses, µ and °", p.brief.c_str());
  TEST_ASSERT_TRUE(p.plant.domain == design::Domain::continuous);
  TEST_ASSERT_EQUAL_DOUBLE(0.5, p.plant.sample_time);
  expect_matrix({0, 1, -0.5, -0.25}, p.plant.A);
  expect_matrix({0, 3, 1, 4}, p.plant.B);
  expect_matrix({1, 0.5}, p.plant.C);
  expect_matrix({0.125, 2}, p.plant.D);
  expect_matrix({1, 2}, p.plant.G);
  expect_signal("dx", "m", p.plant.states[0]);
  expect_signal("v", "m/s", p.plant.states[1]);
  expect_signal("force", "", p.plant.inputs[0]);
  expect_signal("torque", "N m", p.plant.inputs[1]);
  expect_signal("angle", "°/s", p.plant.outputs[0]);
}

void test_regulator_and_limits_have_what_the_file_says() {
  const Problem p = problem(full);
  expect_matrix({2, 0.5, 0.5, 1}, p.regulator->Q);
  expect_matrix({3, 0, 0, 4}, p.regulator->R);
  expect_matrix({0.25, 0, 0, 0.5}, p.regulator->N);
  TEST_ASSERT_TRUE(p.regulator->cost == design::Cost::continuous);
  TEST_ASSERT_EQUAL_DOUBLE(-1, p.limits->u_min(0));
  TEST_ASSERT_TRUE(std::isinf(p.limits->u_min(1)) && p.limits->u_min(1) < 0);
  expect_matrix({1, 2}, p.limits->u_max);
}

void test_estimator_and_code_have_what_the_file_says() {
  const Problem p = problem(full);
  expect_matrix({7}, p.estimator->W);
  expect_matrix({8}, p.estimator->V);
  expect_matrix({0.0625}, p.estimator->Swv);
  TEST_ASSERT_TRUE(p.estimator->noise == design::Noise::discrete && p.estimator->gain == design::Gain::online);
  TEST_ASSERT_TRUE(p.estimator->form == design::Form::predictor);
  TEST_ASSERT_TRUE(p.estimator->covariance == design::Covariance::plain);
  expect_matrix({5, 6}, p.estimator->x0);
  expect_matrix({9, 0, 0, 10}, p.estimator->P0);
  TEST_ASSERT_TRUE(p.code.real == design::Scalar::float64 && p.code.arithmetic == design::Arithmetic::fused);
  TEST_ASSERT_TRUE(p.code.style == design::Style::compact);
  TEST_ASSERT_TRUE(p.code.realisation == design::Realisation::cheapest);
  TEST_ASSERT_EQUAL_INT(1024, p.code.flash);
}

void test_rarer_keys_of_plant_and_regulator_are_read() {
  const Problem p = problem(more);
  TEST_ASSERT_EQUAL_DOUBLE(0.75, p.plant.delay);
  expect_matrix({0.5, 0.25}, p.plant.H);
  const design::Regulator& regulator = *p.regulator;
  TEST_ASSERT_TRUE(regulator.Q.size() == 0 && regulator.R.size() == 0 && regulator.bryson->states.size() == 0 &&
                   !regulator.decay);
  expect_matrix({2, 4}, regulator.bryson->outputs);
  expect_matrix({0.5, 8}, regulator.bryson->inputs);
  TEST_ASSERT_EQUAL_DOUBLE(3, regulator.bryson->rho);
  TEST_ASSERT_EQUAL_DOUBLE(2, *regulator.settling_time);
  TEST_ASSERT_EQUAL_INT(12, regulator.horizon);
  expect_matrix({1, 0, 0, 2}, regulator.Q_final);
  expect_matrix({1, 0, 0, 1}, regulator.structure);
  TEST_ASSERT_TRUE(regulator.integral->outputs == std::vector<int>({1, 0}) && regulator.track == std::vector<int>({1}));
  expect_matrix({2, 0.5, 0.5, 3}, regulator.integral->Q);
  expect_matrix({5, 0, 0, 6}, regulator.input_rate);
  TEST_ASSERT_TRUE(regulator.anti_windup == design::AntiWindup::conditioning);
}

void test_rarer_keys_of_the_estimator_and_the_rest_are_read() {
  const Problem p = problem(more);
  const design::Estimator& estimator = *p.estimator;
  expect_matrix({0, 0, 0, 0}, estimator.V);
  expect_matrix({0.1}, estimator.process_correlation_time);
  expect_matrix({0.2, 0.3}, estimator.measurement_correlation_time);
  TEST_ASSERT_TRUE(estimator.gain == design::Gain::schedule && estimator.horizon == 9 && estimator.gate == 3);
  TEST_ASSERT_EQUAL_DOUBLE(10, p.limits->u_rate(0));
  TEST_ASSERT_TRUE(std::isinf(p.limits->u_rate(1)));
  TEST_ASSERT_EQUAL_INT(2, p.stages.size());
  TEST_ASSERT_TRUE(p.stages[0].from == 4 && p.stages[1].from == 8 && p.stages[1].A.size() == 0);
  expect_matrix({0, 2, -0.5, -0.25}, p.stages[0].A);
  expect_matrix({1, 0, 0, 2}, p.stages[0].R);
  expect_matrix({9}, p.stages[1].W);
  TEST_ASSERT_EQUAL_DOUBLE(6, *p.requirements.gain_margin_dB);
  TEST_ASSERT_EQUAL_DOUBLE(30, *p.requirements.phase_margin_deg);
  TEST_ASSERT_EQUAL_DOUBLE(0.4, *p.requirements.disk_margin);
  TEST_ASSERT_EQUAL_DOUBLE(0.98, *p.requirements.max_pole);
}

void test_wanted_poles_stand_beside_their_conjugates() {
  const Problem p = problem(placed);
  const design::WantedPoles& regulator = *p.regulator->poles;
  const design::WantedPoles& observer = *p.estimator->poles;
  TEST_ASSERT_TRUE(regulator.continuous && !observer.continuous && regulator.values.size() == 2);
  TEST_ASSERT_TRUE(regulator.values[0] == std::complex<double>(-1, 2));
  TEST_ASSERT_TRUE(regulator.values[1] == std::complex<double>(-1, -2));
  TEST_ASSERT_TRUE(observer.values[0] == 0.5 && observer.values[1] == 0.25);
  TEST_ASSERT_TRUE(p.estimator->form == design::Form::predictor && p.regulator->Q.size() == 0);
}

void test_what_is_left_out_has_its_default() {
  const Problem p = problem(least + lqr + kalman);
  expect_matrix({0}, p.plant.D);
  expect_matrix({1}, p.plant.G);
  expect_signal("x0", "", p.plant.states[0]);
  expect_signal("u0", "", p.plant.inputs[0]);
  expect_signal("y0", "", p.plant.outputs[0]);
  expect_matrix({0}, p.plant.H);
  TEST_ASSERT_TRUE(p.plant.delay == 0 && p.stages.empty() && !p.requirements.max_pole);
  TEST_ASSERT_TRUE(p.regulator->anti_windup == design::AntiWindup::model);
  TEST_ASSERT_TRUE(p.regulator->horizon == 0 && !p.regulator->integral && p.regulator->track.empty());
  expect_matrix({0}, p.regulator->N);
  expect_matrix({0}, p.estimator->Swv);
  expect_matrix({0}, p.estimator->x0);
  expect_matrix({1}, p.estimator->P0);
  TEST_ASSERT_TRUE(p.estimator->gain == design::Gain::steady && p.estimator->form == design::Form::filter);
  TEST_ASSERT_TRUE(p.estimator->covariance == design::Covariance::ud && !p.limits);
  TEST_ASSERT_TRUE(p.code.real == design::Scalar::float32 && p.code.arithmetic == design::Arithmetic::plain);
  TEST_ASSERT_TRUE(p.code.style == design::Style::automatic && p.code.realisation == design::Realisation::physical &&
                   p.code.flash == 16384 && p.brief.empty());
}

void test_cost_and_noise_follow_the_domain() {
  const Problem continuous = problem(least + lqr + kalman);
  TEST_ASSERT_TRUE(continuous.regulator->cost == design::Cost::sampled);
  TEST_ASSERT_TRUE(continuous.estimator->noise == design::Noise::continuous);
  std::string text = least + lqr + kalman;
  text.replace(text.find("continuous"), 10, "discrete");
  const Problem discrete = problem(text);
  TEST_ASSERT_TRUE(discrete.plant.domain == design::Domain::discrete);
  TEST_ASSERT_TRUE(discrete.regulator->cost == design::Cost::discrete);
  TEST_ASSERT_TRUE(discrete.estimator->noise == design::Noise::discrete);
}

void test_domain_that_is_left_out_is_said_to_be_continuous() {
  const std::string text = "name = \"a\"\n[plant]\nsample_time = 1\nA = [[0]]\nB = [[1]]\n" + lqr;
  TEST_ASSERT_TRUE(problem(text).plant.domain == design::Domain::continuous);
  expect_lines("d.toml:2:1: note: plant.domain: missing, taken for \"continuous\"\n", text);
}

void test_estimator_alone_needs_no_input() {
  const Problem p = problem(
      "name=\"a\"\nplant={domain=\"discrete\", sample_time=1, A=[[0, 1], [1, 0]], C=[[1, 0]]}\n[kalman]\n"
      "process_noise = [1, 2]\nmeasurement_noise = [1]\n");
  TEST_ASSERT_FALSE(p.regulator.has_value());
  TEST_ASSERT_EQUAL_INT(0, p.plant.B.cols());
  TEST_ASSERT_EQUAL_INT(2, p.plant.B.rows());
  TEST_ASSERT_EQUAL_INT(0, p.plant.D.cols());
  expect_matrix({1, 0, 0, 2}, p.estimator->W);
}

void test_regulator_alone_needs_no_output() {
  const Problem p = problem("name=\"a\"\nplant={domain=\"discrete\", sample_time=1, A=[[1]], B=[[1]]}\n" + lqr);
  TEST_ASSERT_FALSE(p.estimator.has_value());
  TEST_ASSERT_EQUAL_INT(0, p.plant.C.rows());
  TEST_ASSERT_EQUAL_INT(1, p.plant.C.cols());
}

void test_regulator_alone_says_what_it_does_not_use() {
  expect_lines("d.toml:2:77: note: plant.C: not used without [kalman]: u = −K x of the measured states\n", least + lqr);
}

void test_covariance_of_a_steady_gain_is_said_to_be_unused() {
  expect_lines("d.toml:9:14: note: kalman.covariance: not used without gain = \"online\" or \"extended\"\n",
               least + lqr + kalman + "covariance = \"plain\"\n");
}

void test_one_limit_alone_leaves_the_other_side_open() {
  const Problem low = problem(least + lqr + kalman + "[limits]\nu_min = [-2]\n");
  TEST_ASSERT_EQUAL_DOUBLE(-2, low.limits->u_min(0));
  TEST_ASSERT_TRUE(std::isinf(low.limits->u_max(0)) && low.limits->u_max(0) > 0);
  const Problem high = problem(least + lqr + kalman + "[limits]\nu_max = [2]\n");
  TEST_ASSERT_TRUE(std::isinf(high.limits->u_min(0)) && high.limits->u_min(0) < 0);
}

void test_dotted_and_inline_tables_mean_the_same() {
  const std::string dotted =
      "name = \"a\"\nplant.domain = \"continuous\"\nplant.sample_time = 1\nplant.A = [[0]]\nplant.B = [[1]]\n"
      "plant.C = [[1]]\nlqr.Q = [1]\nlqr.R = [1]\nkalman = { process_noise = [1], measurement_noise = [1] "
      "}\n";
  const Problem p = problem(dotted);
  const Problem q = problem(least + lqr + kalman);
  TEST_ASSERT_TRUE(p.plant.A == q.plant.A && p.regulator->Q == q.regulator->Q && p.estimator->V == q.estimator->V);
  expect_lines("d.toml:7:9: lqr.Q: expected 1 number (nx), found 2\n",
               std::string(dotted).replace(dotted.find("Q = [1]"), 7, "Q = [1, 2]"));
}

void test_file_of_another_editor_means_the_same() {
  std::string text = least + lqr;
  for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 2)) text.replace(at, 1, "\r\n");
  const Problem p = problem("\xEF\xBB\xBF" + text);
  TEST_ASSERT_EQUAL_STRING("a", p.name.c_str());
}

void test_slight_asymmetry_is_taken_out_with_a_note() {
  std::string text = full;
  text.replace(text.find("[0.5, 1]]"), 9, "[0.5000000001, 1]]");
  const input::DesignFile file = input::parse_design(text);
  TEST_ASSERT_EQUAL_STRING("d.toml:15:5: note: lqr.Q: symmetrised: found [0][1] = 0.5 and [1][0] = 0.5000000001\n",
                           lines(file).c_str());
  TEST_ASSERT_TRUE(file.problem->regulator->Q(0, 1) == file.problem->regulator->Q(1, 0));
}

// The same file with numbers and with names is the same problem.
void test_names_stand_for_indices() {
  std::string text = full;
  text.replace(text.find("[kalman]"), 0, "structure = [[\"v\"], []]\ntrack = [\"angle\"]\n");
  const input::DesignFile file = input::parse_design(text);
  TEST_ASSERT_TRUE(file.problem.has_value());
  TEST_ASSERT_TRUE(file.problem->regulator->track == std::vector<int>({0}));
  expect_matrix({0, 1, 0, 0}, file.problem->regulator->structure);
}

void test_everything_that_is_wrong_comes_in_the_order_of_the_file() {
  expect_lines(
      "d.toml:1:1: lqr: expected [lqr], [kalman] or both, found neither\n"
      "d.toml:1:8: name: expected lower case, found \"A\"; did you mean \"a\"?\n"
      "d.toml:2:9: plant.sample_time: missing\n"
      "d.toml:2:9: note: plant.domain: missing, taken for \"continuous\"\n"
      "d.toml:2:15: plant.A: expected a square matrix, found 1 row of 2 numbers\n"
      "d.toml:4:7: code.flash: expected a whole number from 1 to 2147483647, found 0.5\n",
      "name = \"A\"\nplant = { A = [[1, 2]] }\n[code]\nflash=0.5\n");
}

void test_nothing_is_said_about_what_follows_from_an_error() {
  expect_lines("d.toml:2:1: plnt: unknown key, did you mean `plant`?\n",
               "name = \"a\"\n[plnt]\nA = [[1]]\n" + lqr + kalman);
  expect_lines("d.toml:2:34: plant.sampletime: unknown key, did you mean `sample_time`?\n",
               std::string(least + lqr + kalman).replace(least.find("sample_time"), 11, "sampletime"));
}

void test_finding_of_the_engine_is_placed_at_the_nearest_key_above() {
  const input::DesignFile file = input::parse_design(full);
  const auto expect_place = [&](const char* key, int line, int column) {
    const input::Location where = input::locate(file, key);
    TEST_ASSERT_EQUAL_INT_MESSAGE(line, where.line, key);
    TEST_ASSERT_EQUAL_INT_MESSAGE(column, where.column, key);
  };
  expect_place("plant.B", 7, 5);
  expect_place("plant.B[1][0]", 7, 5);
  expect_place("kalman.gain", 24, 8);
  expect_place("kalman.gate", 19, 1);
  expect_place("lqr", 14, 1);
  expect_place("require.max_pole", 1, 1);
  expect_place("", 1, 1);
}

void test_formatted_finding_is_one_line() {
  const design::Finding finding{design::Severity::error, "plant.\"a\nb\"", "found \x1B[31m"};
  TEST_ASSERT_EQUAL_STRING("d\\u000A.toml:3:4: plant.\"a\\u000Ab\": found \\u001B[31m",
                           input::format("d\n.toml", {3, 4}, finding).c_str());
  const design::Finding note{design::Severity::note, "lqr", "so"};
  TEST_ASSERT_EQUAL_STRING("d.toml:1:1: note: lqr: so", input::format("d.toml", {1, 1}, note).c_str());
  TEST_ASSERT_EQUAL_STRING("d.toml: note: lqr: so", input::format("d.toml", {0, 0}, note).c_str());
}

void test_file_that_cannot_be_read_is_told_from_one_that_is_wrong() {
  const input::DesignFile folder = input::read_design_file(".");
  TEST_ASSERT_FALSE(folder.readable);
  TEST_ASSERT_EQUAL_STRING("d.toml: cannot be read: it is a folder\n", lines(folder).c_str());
  TEST_ASSERT_FALSE(input::read_design_file("/dev/null").readable);
  TEST_ASSERT_FALSE(input::read_design_file(__FILE__ "/such.toml").readable);
  TEST_ASSERT_FALSE(input::read_design_file("").readable);
  TEST_ASSERT_TRUE(input::parse_design("").readable);
}

void test_bytes_of_the_file_are_kept_for_its_hash() {
  const std::string text = "a = 1\r\n# end";
  std::FILE* stream = std::fopen("bytes.toml", "wb");
  TEST_ASSERT_NOT_NULL(stream);
  std::fwrite(text.data(), 1, text.size(), stream);
  std::fclose(stream);
  const input::DesignFile file = input::read_design_file("bytes.toml");
  std::remove("bytes.toml");
  TEST_ASSERT_TRUE(file.readable);
  TEST_ASSERT_TRUE(file.text == text);
}

void test_file_of_many_megabytes_is_refused() {
  const std::string large((4u << 20) + 1, '\n');
  expect_lines("d.toml: expected at most 4 MiB\n", large);
  TEST_ASSERT_TRUE(input::parse_design(large.substr(1)).findings.size() > 1);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_plant_has_what_the_file_says);
  RUN_TEST(test_regulator_and_limits_have_what_the_file_says);
  RUN_TEST(test_estimator_and_code_have_what_the_file_says);
  RUN_TEST(test_rarer_keys_of_plant_and_regulator_are_read);
  RUN_TEST(test_rarer_keys_of_the_estimator_and_the_rest_are_read);
  RUN_TEST(test_wanted_poles_stand_beside_their_conjugates);
  RUN_TEST(test_what_is_left_out_has_its_default);
  RUN_TEST(test_cost_and_noise_follow_the_domain);
  RUN_TEST(test_domain_that_is_left_out_is_said_to_be_continuous);
  RUN_TEST(test_estimator_alone_needs_no_input);
  RUN_TEST(test_regulator_alone_needs_no_output);
  RUN_TEST(test_regulator_alone_says_what_it_does_not_use);
  RUN_TEST(test_covariance_of_a_steady_gain_is_said_to_be_unused);
  RUN_TEST(test_one_limit_alone_leaves_the_other_side_open);
  RUN_TEST(test_dotted_and_inline_tables_mean_the_same);
  RUN_TEST(test_file_of_another_editor_means_the_same);
  RUN_TEST(test_slight_asymmetry_is_taken_out_with_a_note);
  RUN_TEST(test_everything_that_is_wrong_comes_in_the_order_of_the_file);
  RUN_TEST(test_nothing_is_said_about_what_follows_from_an_error);
  RUN_TEST(test_finding_of_the_engine_is_placed_at_the_nearest_key_above);
  RUN_TEST(test_formatted_finding_is_one_line);
  RUN_TEST(test_file_that_cannot_be_read_is_told_from_one_that_is_wrong);
  RUN_TEST(test_bytes_of_the_file_are_kept_for_its_hash);
  RUN_TEST(test_file_of_many_megabytes_is_refused);
  RUN_TEST(test_names_stand_for_indices);
  return UNITY_END();
}
