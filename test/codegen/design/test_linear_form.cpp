// SPDX-License-Identifier: MIT
// The controller as one linear system: equal to update, control and predict for any outputs, and refused where it is
// not or where the target cannot bear it.
#include <Eigen/LU>
#include <cmath>
#include <string>

#include <unity.h>

#include "design/linear_form.hpp"
#include "design/numeric/modal_basis.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;

namespace {

constexpr int seeds = 40;
constexpr double equal = 1e-40;  // of numbers that were settled from 50 digits

Problem steady(Problem problem) {
  problem.estimator->gain = Gain::steady;
  return problem;
}

// u and x̂ of the physical form, and of a linear one, sample by sample for outputs by chance, beginning at x0.
struct Physical {
  const Problem& problem;
  const Solution& solution;
  RealMatrix x, u;  // x̂⁻, the last u
  RealMatrix estimate;

  void sample(const RealMatrix& y) {
    const SampledPlant& plant = solution.plant;
    const EstimatorSolution& filter = *solution.estimator;
    const bool predicts = problem.estimator->form == Form::predictor;
    if (predicts) {
      estimate = x;
      u = -multiply(solution.regulator->K, x);
    }
    const RealMatrix e = y - multiply(plant.C, x) - multiply(plant.D, u);
    const RealMatrix updated = x + multiply(filter.L, e);
    if (!predicts) {
      estimate = updated;
      u = -multiply(solution.regulator->K, updated);
    }
    x = multiply(plant.A, updated) + multiply(plant.B, u) + multiply(filter.M, e);
  }
};

RealMatrix random_outputs(Random& random, Index ny) { return real(random.matrix(ny, 1)); }

void expect_equal_to_the_physical_form(const Problem& problem, const Solution& solution, const LinearForm& form,
                                       std::uint64_t seed) {
  const Digits scope(solution.numerics.digits);
  const Index nx = solution.plant.A.rows(), nu = solution.plant.B.cols(), ny = solution.plant.C.rows();
  Random random(seed);
  Physical physical{problem, solution, padded(real(problem.estimator->x0), nx, 1), zeros(nu, 1), {}};
  RealMatrix z = form.z0;
  for (int k = 0; k < 40; ++k) {
    RealMatrix y = random_outputs(random, ny);
    if (k % 7 == 3) {  // all as expected: the innovation is 0
      y = multiply(form.expected, z);
      const bool predicts = problem.estimator->form == Form::predictor;
      const RealMatrix acts = predicts ? RealMatrix(-multiply(solution.regulator->K, physical.x)) : physical.u;
      const RealMatrix wanted = multiply(solution.plant.C, physical.x) + multiply(solution.plant.D, acts);
      expect_small(largest_entry(wanted - y), equal, "expected y");
    }
    physical.sample(y);
    expect_small(largest_entry(multiply(form.C, z) + multiply(form.D, y) - physical.u), equal, "error of u");
    expect_small(largest_entry(multiply(form.estimate, z) + multiply(form.heard, y) - physical.estimate), equal,
                 "error of x̂");
    z = multiply(form.A, z) + multiply(form.B, y);
    expect_small(largest_entry(multiply(form.T, z).topRows(nx) - physical.x), equal, "error of T z");
    if (k % 11 == 5) {  // by hand
      physical.x = real(random.matrix(nx, 1));
      RealMatrix set = multiply(form.of_state, physical.x);
      if (form.keep.size() > 0) set += multiply(form.keep, z);
      z = set;
    }
  }
}

template <class Make>
int count_equal_forms(Make make) {
  int forms = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Problem problem = steady(random_problem(seed));
    Random random(seed + 1000);
    problem.estimator->x0 = random.matrix(problem.plant.A.rows(), 1);
    if (seed % 5 == 0 && problem.plant.domain == Domain::discrete) problem.plant.delay = 2 * problem.plant.sample_time;
    const Solution solution = solved(problem);
    if (!no_linear_form(problem, solution).empty()) continue;
    const LinearFormResult result = make(problem, solution);
    TEST_ASSERT_TRUE_MESSAGE(result.form || result.obstacle.find("cancel") != std::string::npos ||
                                 result.obstacle.find("repeated") != std::string::npos,
                             (std::to_string(seed) + ": " + result.obstacle).c_str());
    if (!result.form) continue;
    ++forms;
    expect_equal_to_the_physical_form(problem, solution, *result.form, seed);
  }
  return forms;
}

void test_folded_form_equals_update_control_and_predict() {
  TEST_ASSERT_GREATER_THAN_INT(seeds / 4, count_equal_forms(folded_form));
}

void test_modal_form_equals_update_control_and_predict() {
  TEST_ASSERT_GREATER_THAN_INT(seeds / 5, count_equal_forms(modal_form));
}

// [σ], or [σ ω; −ω σ] with ω > 0; by falling |z|; u = z_0 + … of every block.
void test_modal_form_has_blocks_and_ones() {
  const Problem problem = two_mass();
  const Solution solution = solved(problem);
  const LinearForm form = *modal_form(problem, solution).form;
  const Digits scope(solution.numerics.digits);
  Real before = 1;
  for (Index i = 0; i < 4; i += 2) {
    const RealMatrix block = form.A.block(i, i, 2, 2);
    TEST_ASSERT_TRUE(block(0, 0) == block(1, 1) && block(0, 1) == -block(1, 0) && block(0, 1) > 0);
    const Real size = hypot(block(0, 0), block(0, 1));
    TEST_ASSERT_TRUE(size < before);
    before = size;
    TEST_ASSERT_TRUE(to_double(form.C(0, i)) == 1 && form.C(0, i + 1).is_zero());
  }
  TEST_ASSERT_TRUE(is_zero(form.A.topRightCorner(2, 2)) && is_zero(form.A.bottomLeftCorner(2, 2)));
  TEST_ASSERT_TRUE(form.condition >= 1 && form.condition < 2);
}

RealMatrix matrix_of(std::initializer_list<double> entries) {
  const Index n = entries.size() == 4 ? 2 : 3;
  RealMatrix a(n, n);
  Index at = 0;
  for (const double entry : entries) a(at / n, at % n) = entry, ++at;
  return a;
}

// Two inputs that are one: no row of C is the largest, and the first is taken whatever the digits are.
void test_inputs_that_share_a_mode_evenly() {
  Problem problem = double_integrator(0.1);
  problem = problem_of(Domain::continuous, 0.1, problem.plant.A, (Eigen::MatrixXd(2, 2) << 0, 0, 1, 1).finished(),
                       problem.plant.C);
  const LinearFormResult result = modal_form(problem, solved(problem));
  TEST_ASSERT_TRUE_MESSAGE(result.form.has_value(), result.obstacle.c_str());
  for (Index j = 0; j < 2; ++j) TEST_ASSERT_TRUE(to_double(result.form->C(0, j)) == to_double(result.form->C(1, j)));
  TEST_ASSERT_TRUE(to_double(result.form->C(0, 0)) == 1);
}

// The same matrix twice over: every eigenvalue is there twice, and each part has its own.
void test_parts_that_know_nothing_of_each_other_may_be_equal() {
  const Digits scope(50);
  const RealMatrix one = matrix_of({0.5, 0.25, -0.5, 0.75});
  RealMatrix both = zeros(4, 4);
  for (const Index at : {0, 1}) {  // interleaved
    for (Index i = 0; i < 2; ++i)
      for (Index j = 0; j < 2; ++j) both(2 * i + at, 2 * j + at) = one(i, j);
  }
  const std::optional<ModalBasis> basis = modal_basis(both);
  TEST_ASSERT_TRUE(basis.has_value());
  TEST_ASSERT_EQUAL_size_t(3, basis->starts.size());
  expect_small(largest_entry(multiply(both, basis->T) - multiply(basis->T, basis->blocks)), 1e-45, "A T − T Λ");
  expect_small(largest_entry(multiply(basis->inverse, basis->T) - identity(4)), 1e-45, "T⁻¹ T − I");
}

// The gain of an observer that gives the controller, not the observer, the poles p ± d.
Problem with_controller_poles(double p, double d) {
  Problem problem = double_integrator(0.1);
  const Solution start = solved(problem);
  const Eigen::MatrixXd A = start.plant.A.unaryExpr([](const Real& value) { return to_double(value); });
  const Eigen::MatrixXd B = start.plant.B.unaryExpr([](const Real& value) { return to_double(value); });
  const Eigen::MatrixXd K = start.regulator->K.unaryExpr([](const Real& value) { return to_double(value); });
  const Eigen::MatrixXd F = A - B * K;  // F − L C with C = [1 0] has the trace 2p and the determinant p² − d²
  const double l0 = F.trace() - 2 * p;
  const double l1 = ((F(0, 0) - l0) * F(1, 1) - (p * p - d * d)) / F(0, 1) - F(1, 0);
  const Eigen::Vector2d L(l0, -l1);
  const Eigen::Matrix2d left = A - L * Eigen::RowVector2d(1, 0);
  const std::complex<double> root =
      std::sqrt(std::complex<double>(left.trace() * left.trace() / 4 - left.determinant()));
  const std::complex<double> middle(left.trace() / 2, 0);
  problem.estimator->W.resize(0, 0), problem.estimator->V.resize(0, 0), problem.estimator->Swv.resize(0, 0);
  problem.estimator->form = Form::predictor;
  problem.estimator->poles = WantedPoles{{middle + root, middle - root}, false};
  return problem;
}

void test_poles_that_meet_are_refused_with_their_condition() {
  Problem problem = with_controller_poles(0.4, 1e-5);
  const Solution solution = solved(problem);
  TEST_ASSERT_EQUAL_STRING("", no_linear_form(problem, solution).c_str());
  TEST_ASSERT_TRUE(modal_form(problem, solution).form.has_value());  // in double
  problem.code.real = Scalar::float32;
  const LinearFormResult refused = modal_form(problem, solution);
  TEST_ASSERT_FALSE(refused.form.has_value());
  TEST_ASSERT_TRUE_MESSAGE(
      refused.obstacle.find("poles of the controller are so near each other that their modes cancel") == 0,
      refused.obstacle.c_str());
  TEST_ASSERT_TRUE_MESSAGE(refused.obstacle.find("in float at most 2896.31 will do") != std::string::npos,
                           refused.obstacle.c_str());
  TEST_ASSERT_TRUE(folded_form(problem, solution).form.has_value());
}

// 1/(p₁ − p₂) or so: a hundred times nearer, a hundred times more.
void test_condition_grows_as_poles_meet() {
  const auto condition = [](double d) {
    const Problem problem = with_controller_poles(0.4, d);
    return modal_form(problem, solved(problem)).form->condition;
  };
  TEST_ASSERT_DOUBLE_WITHIN(1, 100, condition(1e-5) / condition(1e-3));
}

void test_condition_does_not_depend_on_units() {
  Problem problem = two_mass();
  const double before = modal_form(problem, solved(problem)).form->condition;
  const Eigen::MatrixXd units = Eigen::Vector4d(1, 1024, 0x1p-10, 4).asDiagonal();
  problem.plant.A = units * problem.plant.A * units.inverse();
  problem.plant.B = units * problem.plant.B;
  problem.plant.G = units * problem.plant.G;
  problem.plant.C = problem.plant.C * units.inverse();
  problem.regulator->Q = units.inverse() * problem.regulator->Q * units.inverse();
  TEST_ASSERT_DOUBLE_WITHIN(1e-12, before, modal_form(problem, solved(problem)).form->condition);
}

void expect_obstacle(const Problem& problem, const char* why) {
  const Solution solution = solved(problem);
  const std::string found = no_linear_form(problem, solution);
  TEST_ASSERT_TRUE_MESSAGE(found.find(why) != std::string::npos, found.c_str());
}

void test_what_has_no_linear_form_says_why() {
  Problem problem = two_mass();
  problem.limits = limits_of_size(Eigen::VectorXd::Constant(1, -1), Eigen::VectorXd::Constant(1, 1));
  expect_obstacle(problem, "[limits]");
  problem = two_mass();
  problem.estimator->gate = 3;
  expect_obstacle(problem, "gate");
  problem = two_mass();
  problem.estimator->gain = Gain::online;
  expect_obstacle(problem, "not constant");
  problem = two_mass();
  problem.regulator->horizon = 5;
  expect_obstacle(problem, "not constant");
  problem = two_mass();
  problem.regulator->integral = Integral{{0}, Eigen::MatrixXd::Constant(1, 1, 1)};
  expect_obstacle(problem, "reference");
  problem = two_mass();
  problem.regulator->input_rate = Eigen::MatrixXd::Constant(1, 1, 1);
  expect_obstacle(problem, "the input that was applied");
  problem = two_mass();
  problem.estimator.reset();
  expect_obstacle(problem, "an estimator");
}

// (s − 5)/(s² − 100): a pole between two zeros outside of the stable region, 5 and infinity. No stable controller can
// have it. (D. C. Youla, J. J. Bongiorno, C. N. Lu, "Single-loop feedback-stabilization of linear multivariable
// dynamical plants", Automatica 10 (1974), 159–173.)
void test_controller_that_is_unstable_by_itself_is_refused() {
  Problem problem = problem_of(Domain::continuous, 0.05, (Eigen::MatrixXd(2, 2) << 0, 1, 100, 0).finished(),
                               Eigen::MatrixXd(Eigen::Vector2d(0, 1)), Eigen::MatrixXd(Eigen::RowVector2d(-5, 1)));
  expect_obstacle(problem, "the controller by itself has a pole at z = ");
}

// What the report says of the rounded loop is said of the form that is emitted.
void test_rounded_loop_is_that_of_the_form() {
  Problem problem = two_mass();
  problem.code.real = Scalar::float32;
  Solution solution = solved(problem);
  const Poles physical = solution.loop.rounded->poles;
  Findings findings;
  check_rounded_form(problem, *modal_form(problem, solution).form, solution, findings);
  TEST_ASSERT_TRUE(findings.empty());
  bool changed = false;
  for (std::size_t i = 0; i < physical.size(); ++i) {
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, std::abs(solution.loop.poles[i]), std::abs(solution.loop.rounded->poles[i]));
    changed = changed || physical[i] != solution.loop.rounded->poles[i];
  }
  TEST_ASSERT_TRUE(changed);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_folded_form_equals_update_control_and_predict);
  RUN_TEST(test_modal_form_equals_update_control_and_predict);
  RUN_TEST(test_modal_form_has_blocks_and_ones);
  RUN_TEST(test_inputs_that_share_a_mode_evenly);
  RUN_TEST(test_parts_that_know_nothing_of_each_other_may_be_equal);
  RUN_TEST(test_poles_that_meet_are_refused_with_their_condition);
  RUN_TEST(test_condition_grows_as_poles_meet);
  RUN_TEST(test_condition_does_not_depend_on_units);
  RUN_TEST(test_what_has_no_linear_form_says_why);
  RUN_TEST(test_controller_that_is_unstable_by_itself_is_refused);
  RUN_TEST(test_rounded_loop_is_that_of_the_form);
  return UNITY_END();
}
