// SPDX-License-Identifier: MIT
// What a law needs to foresee limits, against the optimum over all inputs of the horizon.
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include <unity.h>

#include "design/limits/limited_rows.hpp"
#include "design/equations/riccati.hpp"
#include "design/rounding.hpp"
#include "limits_reference.hpp"
#include "problems.hpp"
#include "step/mpc.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

RealVector reals(const std::vector<double>& values) {
  RealVector result(static_cast<Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) result(static_cast<Index>(i)) = values[i];
  return result;
}

RealMatrix row(const std::vector<double>& values) { return reals(values).transpose(); }

RiccatiEquation sampled(const MatrixXd& A, const MatrixXd& B, double T, const VectorXd& Q, double R) {
  Problem problem = regulator_alone(design_test::problem_of(Domain::continuous, T, A, B, MatrixXd(0, A.rows())));
  problem.regulator->cost = Cost::discrete;
  const SampledPlant plant = solved(problem).plant;
  return {plant.A, plant.B, real(Q.asDiagonal()), real(MatrixXd::Constant(1, 1, R)), zeros(A.rows(), 1)};
}

RiccatiEquation two_mass_equation() {
  const Plant plant = two_mass().plant;
  return sampled(plant.A, plant.B, 0.5, Eigen::Vector4d(1, 0, 1, 0), 0.1);
}

// Those of limits_reference.py.
LimitedProblem two_mass_in_blocks() {
  LimitedProblem problem = foreseeing_law(two_mass_equation(), default_blocks(20, false));
  problem.u_min = reals({-0.3});
  problem.u_max = reals({0.3});
  return problem;
}

LimitedProblem two_mass_with_a_cross_weight() {
  RiccatiEquation equation = two_mass_equation();
  equation.N = reals({0.05, 0, 0, 0.02});
  LimitedProblem problem = foreseeing_law(equation, default_blocks(10, true));
  problem.u_min = reals({-0.3});
  problem.u_max = reals({0.3});
  return problem;
}

LimitedProblem servo_with_limits_of_rate_and_speed() {
  const MatrixXd A = (MatrixXd(2, 2) << 0, 1, 0, -59.2236711684).finished();
  LimitedProblem problem =
      foreseeing_law(sampled(A, Eigen::Vector2d(0, 2121.79407756), 0.001, Eigen::Vector2d(400, 1 / 1024.0), 1 / 128.0),
                     default_blocks(10, true));
  problem.u_min = reals({-12});
  problem.u_max = reals({12});
  problem.u_step = reals({2});
  problem.step_price = RealVector::Constant(1, Real(10000));
  problem.quantities = {{row({0, 1}), row({0}), false, -20, 20, Real(1000)}};
  return problem;
}

LimitedProblem two_mass_with_limits_of_an_output() {
  LimitedProblem problem = foreseeing_law(two_mass_equation(), default_blocks(8, true));
  problem.u_min = reals({-0.5});
  problem.u_max = reals({0.5});
  problem.quantities = {{row({0, 0, 1, 0}), row({0.125}), false, -1, 0.75, Real(1000)},
                        {row({0, 0, 1, 0}), row({0.125}), true, -0.25, 0.25, Real(64)}};
  return problem;
}

LimitedProblem two_inputs_in_blocks() {
  const MatrixXd A = (MatrixXd(3, 3) << 1, 0.125, 0, 0, 1, 0.25, 0.125, 0, 0.75).finished();
  const MatrixXd B = (MatrixXd(3, 2) << 0.5, 0, 0, 1, 0.25, -0.5).finished();
  const MatrixXd R = (MatrixXd(2, 2) << 0.5, 0.125, 0.125, 1).finished();
  LimitedProblem problem = foreseeing_law(
      {real(A), real(B), real(Eigen::Vector3d(1, 2, 0.5).asDiagonal()), real(R), zeros(3, 2)}, {1, 2, 3});
  problem.u_min = reals({-0.25, -1});
  problem.u_max = reals({0.5, infinity});
  problem.quantities = {{row({1, 0, 1}), row({0, 0}), false, -0.5, 0.5, Real(8)}};
  return problem;
}

using Make = LimitedProblem (*)();
const struct {
  const char* name;
  Make make;
  std::vector<double> scale;
} cases[] = {{"two_mass in blocks", two_mass_in_blocks, {1, 1, 1, 1}},
             {"two_mass with a cross weight", two_mass_with_a_cross_weight, {1, 1, 1, 1}},
             {"servo", servo_with_limits_of_rate_and_speed, {1 / 16.0, 16}},
             {"two_mass, an output", two_mass_with_limits_of_an_output, {1, 1, 1, 1}},
             {"two inputs", two_inputs_in_blocks, {1, 1, 1}}};

// The target's law in double.
lqg::step::LimitedLaw<double> target_law(const LimitedProblem& problem, const LimitedRows& rows) {
  lqg::step::LimitedLaw<double> law;
  law.nu = static_cast<int>(problem.B.cols());
  law.iterations = 200;
  law.F = to_doubles(rows.F);
  law.G = to_doubles(rows.G);
  law.scale = to_doubles(rows.scale);
  law.low = to_doubles(rows.low);
  law.high = to_doubles(rows.high);
  law.tolerance = to_doubles(rows.tolerance);
  law.u_step = to_doubles(problem.u_step);
  return law;
}

// Knuth's MMIX generator, as in limits_reference.py.
struct Draws {
  std::uint64_t state;
  int draw(int most) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<int>((state >> 33) % static_cast<std::uint64_t>(most + 1));
  }
  double number(double scale) { return (draw(2048) - 1024) / 1024.0 * scale; }
};

void test_u_is_that_of_the_optimum_over_all_inputs() {
  const Digits scope(50);
  for (std::size_t at = 0; at < std::size(cases); ++at) {
    const LimitedProblem problem = cases[at].make();
    const auto law = target_law(problem, *limited_rows(problem));
    const MatrixXd K = to_doubles(problem.K);
    Draws draws{at};
    draws.draw(1);
    for (int n = 0; n < reference_states; ++n) {
      VectorXd x(K.cols()), last(K.rows());
      for (Index i = 0; i < x.size(); ++i)
        x(i) = draws.number(cases[at].scale[static_cast<std::size_t>(i)]) / (1 << n % 4);
      for (double& u : last) u = draws.number(8);
      const auto found = lqg::step::limited_input<double>(law, last, x, -K * x);
      TEST_ASSERT_TRUE(found.is_optimal);
      for (Index i = 0; i < K.rows(); ++i)
        expect_small(std::abs(found.u(i) - reference_inputs[at][n].u[i]), 1e-9, cases[at].name);
    }
  }
}

// The state after a while in a loop with the optimum, or with the law clipped.
double distance_left(const LimitedProblem& problem, const lqg::step::LimitedLaw<double>& law, VectorXd x, bool clips) {
  const MatrixXd A = to_doubles(problem.A), B = to_doubles(problem.B), K = to_doubles(problem.K);
  const VectorXd low = law.low.head(law.nu), high = law.high.head(law.nu);
  for (int k = 0; k < 400; ++k) {
    const VectorXd u = -K * x;
    const auto found = lqg::step::limited_input<double>(law, {}, x, u);
    TEST_ASSERT_TRUE(found.is_optimal);
    x = A * x + B * (clips ? VectorXd(u.cwiseMax(low).cwiseMin(high)) : VectorXd(found.u));
  }
  return x.cwiseAbs().maxCoeff();
}

// Clipped, the loop of two masses ends in a limit cycle.
void test_a_loop_that_clipping_destroys_settles_from_every_start() {
  const Digits scope(50);
  const LimitedProblem problem = two_mass_in_blocks();
  const auto law = target_law(problem, *limited_rows(problem));
  Random random(5);
  const int starts = 1000;
  int clipped = 0, optimal = 0;
  for (int n = 0; n < starts; ++n) {
    const VectorXd x = random.matrix(4, 1);
    clipped += distance_left(problem, law, x, true) < 0.01;
    optimal += distance_left(problem, law, x, false) < 0.01;
  }
  TEST_ASSERT_EQUAL(starts, optimal);
  TEST_ASSERT_INT_WITHIN(100, 250, clipped);
}

void test_a_law_without_limits_has_a_row_an_input_now_and_no_more() {
  const Digits scope(50);
  LimitedProblem problem = two_inputs_in_blocks();
  problem.u_min = reals({-infinity, -infinity});
  problem.u_max = -problem.u_min;
  problem.quantities.clear();
  const LimitedRows rows = *limited_rows(problem);
  TEST_ASSERT_EQUAL(0, rows.F.rows());
  TEST_ASSERT_EQUAL(2, rows.G.rows());
  expect_small(distance(multiply(rows.G, problem.weight), identity(2)), 1e-45, "G (R + BᵀXB)");
}

// A state of now is what it is; a chain of two delays is not moved for two samples.
void test_what_no_input_can_move_has_no_row() {
  const Digits scope(50);
  const MatrixXd A = (MatrixXd(3, 3) << 0.5, 1, 0, 0, 0, 1, 0, 0, 0).finished();
  LimitedProblem problem = foreseeing_law(
      {real(A), real(Eigen::Vector3d(0, 0, 1)), identity(3), identity(1), zeros(3, 1)}, default_blocks(5, true));
  problem.quantities = {{row({1, 0, 0}), row({0}), false, -1, 1, Real(10)}};
  const LimitedRows rows = *limited_rows(problem);
  TEST_ASSERT_EQUAL(3, rows.G.rows());
  TEST_ASSERT_EQUAL(0, rows.sample[0]);
  TEST_ASSERT_EQUAL(3, rows.sample[1]);
  TEST_ASSERT_EQUAL(4, rows.sample[2]);
}

void test_a_soft_row_has_the_inverse_of_its_price_on_the_diagonal() {
  const Digits scope(50);
  LimitedProblem soft = servo_with_limits_of_rate_and_speed(), softer = soft;
  softer.quantities[0].price = Real(8);
  const LimitedRows rows = *limited_rows(soft), others = *limited_rows(softer);
  RealMatrix difference = others.G - rows.G;
  for (Index i = 0; i < difference.rows(); ++i) {
    const bool is_speed = !difference(i, i).is_zero();
    expect_small(abs(difference(i, i) - (is_speed ? Real(1) / 8 - Real(1) / 1000 : Real(0))), 1e-40, "1/p");
    expect_small(abs(rows.scale(i) * rows.scale(i) * rows.G(i, i) - 1), 1e-45, "scale");
    difference(i, i) = 0;
  }
  TEST_ASSERT_TRUE(is_zero(difference));
}

void test_default_blocks_fill_the_horizon() {
  TEST_ASSERT_TRUE(default_blocks(0, false).empty());
  TEST_ASSERT_TRUE((default_blocks(20, false) == std::vector<int>{1, 1, 2, 4, 4, 8}));
  TEST_ASSERT_TRUE((default_blocks(31, false) == std::vector<int>{1, 1, 2, 4, 4, 8, 8, 3}));
  TEST_ASSERT_TRUE((default_blocks(3, true) == std::vector<int>{1, 1, 1}));
}

void test_more_digits_settle_every_number() {
  LimitedRows coarse, fine;
  {
    const Digits scope(50);
    coarse = *limited_rows(two_mass_with_limits_of_an_output());
  }
  const Digits scope(75);
  fine = *limited_rows(two_mass_with_limits_of_an_output());
  TEST_ASSERT_TRUE(passes_ziv_test(coarse, fine, 50));
  coarse.G(1, 0) *= 1 + Real(1e-14);
  TEST_ASSERT_FALSE(passes_ziv_test(coarse, fine, 50));
}

void test_a_weight_that_is_not_definite_has_no_rows() {
  const Digits scope(50);
  LimitedProblem problem = two_mass_in_blocks();
  problem.weight(0, 0) = -1;
  TEST_ASSERT_FALSE(limited_rows(problem).has_value());
}

void print_array(const char* name, const Eigen::MatrixXf& values) {
  std::printf("static const lqg_real %s[] = {", name);
  for (Index i = 0; i < values.rows(); ++i)
    for (Index j = 0; j < values.cols(); ++j) std::printf("%s%.9ef", i + j ? ", " : "", double(values(i, j)));
  std::printf("};\n");
}

// For test/bench/limits.sh: two_mass in blocks, in float.
int print_tables() {
  const Digits scope(50);
  LimitedProblem problem = two_mass_in_blocks();
  problem.tolerance = 1e-4;
  const LimitedRows rows = *limited_rows(problem);
  print_array("K", to_floats(problem.K));
  print_array("F", to_floats(rows.F));
  print_array("G", to_floats(rows.G));
  print_array("scale", to_floats(rows.scale));
  print_array("low", to_floats(rows.low));
  print_array("high", to_floats(rows.high));
  print_array("tolerance", to_floats(rows.tolerance));
  std::printf("enum { NX = %d, NU = %d, ROWS = %d };\n", int(problem.K.cols()), int(problem.K.rows()),
              int(rows.G.rows()));
  return 0;
}

}  // namespace

void setUp() {}
void tearDown() {}

int main(int count, char** words) {
  if (count > 1 && std::string(words[1]) == "tables") return print_tables();
  UNITY_BEGIN();
  RUN_TEST(test_u_is_that_of_the_optimum_over_all_inputs);
  RUN_TEST(test_a_loop_that_clipping_destroys_settles_from_every_start);
  RUN_TEST(test_a_law_without_limits_has_a_row_an_input_now_and_no_more);
  RUN_TEST(test_what_no_input_can_move_has_no_row);
  RUN_TEST(test_a_soft_row_has_the_inverse_of_its_price_on_the_diagonal);
  RUN_TEST(test_default_blocks_fill_the_horizon);
  RUN_TEST(test_more_digits_settle_every_number);
  RUN_TEST(test_a_weight_that_is_not_definite_has_no_rows);
  return UNITY_END();
}
