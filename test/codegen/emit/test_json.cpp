// SPDX-License-Identifier: MIT
// NAME.json: every number of the design, so that it reads back exactly.
#include <cmath>
#include <nlohmann/json.hpp>

#include <unity.h>

#include "design_text.hpp"
#include "design/rounding.hpp"
#include "emit/c/preamble.hpp"
#include "emit/report/json.hpp"
#include "emit/text/wording.hpp"

using namespace lqg_test;
using lqg::design::RealMatrix;
using lqg::emit::Controller;
using nlohmann::json;

namespace {

constexpr int designs = 12;

double nearest_double(const lqg::design::Real& value) { return mpfr_get_d(value.backend().data(), MPFR_RNDN); }

void expect_matrix(const json& found, const RealMatrix& expected, const char* what) {
  TEST_ASSERT_EQUAL_size_t_MESSAGE(expected.rows(), found.size(), what);
  for (int i = 0; i < expected.rows(); ++i) {
    TEST_ASSERT_EQUAL_size_t_MESSAGE(expected.cols(), found[static_cast<std::size_t>(i)].size(), what);
    for (int j = 0; j < expected.cols(); ++j)
      TEST_ASSERT_TRUE_MESSAGE(found[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].get<double>() ==
                                   nearest_double(expected(i, j)),
                               what);
  }
}

void expect_poles(const json& found, const lqg::design::Poles& expected, const char* what) {
  TEST_ASSERT_EQUAL_size_t_MESSAGE(expected.size(), found.size(), what);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    TEST_ASSERT_TRUE_MESSAGE(found[i][0].get<double>() == expected[i].real(), what);
    TEST_ASSERT_TRUE_MESSAGE(found[i][1].get<double>() == expected[i].imag(), what);
  }
}

void expect_number(const json& table, const char* key, const std::optional<double>& expected) {
  TEST_ASSERT_EQUAL_INT_MESSAGE(expected.has_value(), table.contains(key), key);
  if (expected) TEST_ASSERT_TRUE_MESSAGE(table[key].is_number() && table[key].get<double>() == *expected, key);
}

void expect_plant(const json& found, const lqg::design::SampledPlant& plant) {
  expect_matrix(found["A"], plant.A, "plant.A");
  expect_matrix(found["B"], plant.B, "plant.B");
  expect_matrix(found["C"], plant.C, "plant.C");
  expect_matrix(found["D"], plant.D, "plant.D");
  expect_matrix(found["G"], plant.G, "plant.G");
}

void expect_estimator(const json& found, const lqg::design::EstimatorSolution& estimator) {
  expect_matrix(found["noise"]["W"], estimator.noise.W, "noise.W");
  expect_matrix(found["noise"]["V"], estimator.noise.V, "noise.V");
  expect_matrix(found["noise"]["cross"], estimator.noise.Swv, "noise.cross");
  const json& kalman = found["kalman"];
  expect_matrix(kalman["L"], estimator.L, "kalman.L");
  expect_matrix(kalman["L_predictor"], estimator.L_predictor, "kalman.L_predictor");
  expect_matrix(kalman["P_prior"], estimator.P_prior, "kalman.P_prior");
  expect_matrix(kalman["P_posterior"], estimator.P_posterior, "kalman.P_posterior");
  expect_matrix(kalman["S"], estimator.S, "kalman.S");
  expect_poles(kalman["poles"], estimator.poles, "kalman.poles");
}

void expect_regulator(const json& found, const lqg::design::RegulatorSolution& regulator) {
  expect_matrix(found["cost"]["Q"], regulator.cost.Q, "cost.Q");
  expect_matrix(found["cost"]["R"], regulator.cost.R, "cost.R");
  expect_matrix(found["cost"]["N"], regulator.cost.N, "cost.N");
  expect_matrix(found["lqr"]["K"], regulator.K, "lqr.K");
  expect_matrix(found["lqr"]["X"], regulator.X, "lqr.X");
  expect_poles(found["lqr"]["poles"], regulator.poles, "lqr.poles");
}

// The observer's x̂ is that of the filter's own equations, over a few samples of any u and y.
void expect_observer(const json& found, const Controller& controller) {
  const auto matrix = [&](const char* key) {
    const json& rows = found["kalman"]["observer"][key];
    Eigen::MatrixXd out(rows.size(), rows[0].size());
    for (int i = 0; i < out.rows(); ++i)
      for (int j = 0; j < out.cols(); ++j)
        out(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].get<double>();
    return out;
  };
  const lqg::design::EstimatorSolution& filter = *controller.solution.estimator;
  const auto doubles = [](const RealMatrix& of) { return lqg::design::to_doubles(of); };
  const Eigen::MatrixXd A = doubles(controller.solution.plant.A), B = doubles(controller.solution.plant.B),
                        C = doubles(controller.solution.plant.C), L = doubles(filter.L), M = doubles(filter.M);
  Eigen::VectorXd state = Eigen::VectorXd::Zero(A.rows()), x = state;
  lqg_test::Random random(1);
  for (int k = 0; k < 5; ++k) {
    Eigen::VectorXd u(B.cols()), y(C.rows());
    for (double& each : u) each = random.uniform();
    for (double& each : y) each = random.uniform();
    const Eigen::VectorXd innovation = y - C * x,
                          heard = controller.is_predictor ? x : Eigen::VectorXd(x + L * innovation);
    const Eigen::VectorXd both = (Eigen::VectorXd(u.size() + y.size()) << u, y).finished();
    const double size = 1e-9 * (1 + x.norm() + state.norm());
    TEST_ASSERT_DOUBLE_WITHIN(size, 0, (matrix("C") * state + matrix("D") * both - heard).norm());
    x = A * (x + L * innovation) + B * u + M * innovation;
    state = matrix("A") * state + matrix("B") * both;
  }
}

void expect_new_margins(const json& found, const lqg::design::LoopSolution& loop, double sample_time) {
  const lqg::design::Margins& margins = loop.at_input;
  const auto times = [](const std::optional<double>& value, double factor) {
    return value ? std::optional(*value * factor) : value;
  };
  expect_number(found, "gain_margin_up_dB", margins.gain_up_dB);
  expect_number(found, "gain_margin_down_dB", margins.gain_down_dB);
  expect_number(found, "delay_margin_samples", margins.delay_samples);
  expect_number(found, "delay_margin_s", times(margins.delay_samples, sample_time));
  TEST_ASSERT_EQUAL_INT(margins.crossover.has_value(), found.contains("crossover"));
  if (margins.crossover) {
    const double rad_per_sample = found["crossover"].get<double>() * sample_time;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12 * *margins.crossover, *margins.crossover, rad_per_sample);
  }
  TEST_ASSERT_EQUAL_INT(loop.rms.has_value(), found.contains("rms"));
  if (!loop.rms) return;
  TEST_ASSERT_TRUE(found["rms"]["x"] == json(loop.rms->x) && found["rms"]["u"] == json(loop.rms->u) &&
                   found["rms"]["y"] == json(loop.rms->y));
}

void expect_all(const json& found, const Controller& controller) {
  const lqg::design::Solution& solution = controller.solution;
  TEST_ASSERT_EQUAL_STRING(controller.problem.name.c_str(), found["name"].get<std::string>().c_str());
  TEST_ASSERT_EQUAL_STRING(controller.source.sha256.c_str(), found["design_file"]["sha256"].get<std::string>().c_str());
  TEST_ASSERT_EQUAL_STRING(lqg::emit::version().c_str(), found["lqgen"].get<std::string>().c_str());
  expect_plant(found["plant"], solution.plant);
  TEST_ASSERT_TRUE(found["plant"]["sample_time"].get<double>() == controller.problem.plant.sample_time);
  if (solution.estimator) expect_estimator(found, *solution.estimator);
  if (solution.regulator) expect_regulator(found, *solution.regulator);
  expect_poles(found["loop"]["poles"], solution.loop.poles, "loop.poles");
  expect_number(found["loop"], "gain_margin_dB", solution.loop.at_input.gain_dB);
  expect_number(found["loop"], "phase_margin_deg", solution.loop.at_input.phase_deg);
  expect_number(found["loop"], "disk_margin", solution.loop.at_input.disk);
  if (solution.estimator) expect_observer(found, controller);
  expect_new_margins(found["loop"], solution.loop, controller.problem.plant.sample_time);
  expect_number(found["loop"], "cost_per_sample", solution.loop.cost_per_sample);
  expect_number(found["loop"], "cost_per_second", solution.loop.cost_per_second);
  expect_number(found["numerics"], "condition", solution.numerics.condition);
  TEST_ASSERT_EQUAL_UINT(solution.numerics.digits, found["numerics"]["digits"].get<unsigned>());
  for (std::size_t i = 0; i < controller.bounds.x.size(); ++i)
    TEST_ASSERT_TRUE(found["numerics"]["bounds"]["x"][i].get<double>() == std::ldexp(1.0, controller.bounds.x[i]));
  for (Eigen::Index i = 0; i < controller.bounds.innovation.size(); ++i)
    TEST_ASSERT_TRUE(found["numerics"]["bounds"]["innovation"][static_cast<std::size_t>(i)].get<double>() ==
                     controller.bounds.innovation(i));
  TEST_ASSERT_EQUAL_INT(controller.cost.flash, found["code"]["flash"].get<long>());
  TEST_ASSERT_EQUAL_INT(controller.cost.ram, found["code"]["ram"].get<long>());
  TEST_ASSERT_EQUAL_INT(controller.cost.stack, found["code"]["stack"].get<long>());
  TEST_ASSERT_EQUAL_INT(controller.cost.multiply_adds, found["code"]["multiply_adds"].get<long>());
}

void test_every_number_of_random_designs_reads_back_to_the_same_double() {
  for (int seed = 0; seed < designs; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const Controller controller = controller_of(random_design(random, 1 + seed % 5));
    expect_all(json::parse(lqg::emit::json(controller)), controller);
  }
}

// nlohmann writes what is not finite as null.
void expect_no_null(const json& value) {
  TEST_ASSERT_FALSE(value.is_null());
  if (!value.is_structured()) return;
  for (const json& part : value) expect_no_null(part);
}

void test_nothing_is_null() {
  for (int seed = 0; seed < designs; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    expect_no_null(json::parse(lqg::emit::json(controller_of(random_design(random, 1 + seed % 5)))));
  }
}

void test_what_a_design_does_not_have_is_left_out() {
  DesignText design = double_integrator();
  design.Q.resize(0, 0);
  const json estimator = json::parse(lqg::emit::json(controller_of(design)));
  TEST_ASSERT_TRUE(estimator.contains("kalman") && estimator.contains("noise"));
  TEST_ASSERT_FALSE(estimator.contains("lqr") || estimator.contains("cost"));
  design = double_integrator();
  design.W.resize(0, 0), design.C.resize(0, 0), design.G.resize(0, 0), design.outputs = "";
  const json regulator = json::parse(lqg::emit::json(controller_of(design)));
  TEST_ASSERT_TRUE(regulator.contains("lqr") && regulator.contains("cost"));
  TEST_ASSERT_FALSE(regulator.contains("kalman") || regulator.contains("noise"));
}

void test_integrals_and_references_say_which_outputs_they_belong_to() {
  std::string text = toml(double_integrator());
  text.replace(text.find("[lqr]\n"), 6, "[lqr]\nintegral = { outputs = [0], Q = [1] }\n");
  const json servo = json::parse(lqg::emit::json(controller_of(text)));
  TEST_ASSERT_TRUE(servo["lqr"]["integral"] == json({0}) && servo["lqr"]["references"] == json({0}));
  const json regulator = json::parse(lqg::emit::json(controller_of(double_integrator())));
  TEST_ASSERT_FALSE(regulator["lqr"].contains("integral") || regulator["lqr"].contains("references"));
}

void test_words_of_the_design_file_survive_whatever_their_letters() {
  DesignText design = double_integrator();
  design.brief = "Größe \\\"ψ\\\" of a mass";
  const Controller controller = controller_of(design);
  const json found = json::parse(lqg::emit::json(controller));
  TEST_ASSERT_EQUAL_STRING("Größe \"ψ\" of a mass", found["brief"].get<std::string>().c_str());
  TEST_ASSERT_EQUAL_STRING("speed [m/s]", found["plant"]["states"][1].get<std::string>().c_str());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_every_number_of_random_designs_reads_back_to_the_same_double);
  RUN_TEST(test_nothing_is_null);
  RUN_TEST(test_what_a_design_does_not_have_is_left_out);
  RUN_TEST(test_integrals_and_references_say_which_outputs_they_belong_to);
  RUN_TEST(test_words_of_the_design_file_survive_whatever_their_letters);
  return UNITY_END();
}
