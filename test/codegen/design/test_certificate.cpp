// SPDX-License-Identifier: MIT
// How often the set of active limits changes at most, against the solver of the target.
#include <algorithm>
#include <limits>

#include <unity.h>

#include "design/limits/certificate.hpp"
#include "design/limits/region.hpp"
#include "design/limits/rounded_factor.hpp"
#include "design/equations/riccati.hpp"
#include "problems.hpp"
#include "step/mpc.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// A plant with one input, |u| ≤ limit, J = Σ xᵀ diag(Q) x + R u².
LimitedProblem limited(const Problem& plant, const VectorXd& Q, double R, const std::vector<int>& blocks,
                       double limit) {
  Problem alone = regulator_alone(plant);
  alone.regulator->cost = Cost::discrete;
  const SampledPlant sampled = solved(alone).plant;
  const RiccatiEquation equation{sampled.A, sampled.B, real(Q.asDiagonal()), real(MatrixXd::Constant(1, 1, R)),
                                 zeros(sampled.A.rows(), 1)};
  LimitedProblem problem = foreseeing_law(equation, blocks);
  problem.u_min = real(MatrixXd::Constant(1, 1, -limit));
  problem.u_max = real(MatrixXd::Constant(1, 1, limit));
  return problem;
}

LimitedProblem two_mass_in_blocks() {
  Problem plant = two_mass();
  plant.plant.sample_time = 0.5;
  return limited(plant, Eigen::Vector4d(1, 0, 1, 0), 0.1, default_blocks(20, false), 0.3);
}

LimitedProblem mass_in_three_blocks() {
  return limited(double_integrator(0.1), Eigen::Vector2d(1, 0), 0.1, {1, 1, 2}, 1);
}

LimitNumbers numbers_of(LimitedProblem problem, Scalar number) {
  if (number == Scalar::float32) problem.tolerance = 1e-4;
  return limit_numbers(-problem.K, *limited_rows(problem), problem.u_step, number);
}

CertifiedBox box_of(const LimitNumbers& numbers, double size) {
  const VectorXd half = VectorXd::Constant(numbers.law.cols(), size);
  CertifiedBox box{-half, half, {}, {}};
  if (numbers.u_step.size()) {
    box.u_low = numbers.low.head(numbers.u_step.size());
    box.u_high = numbers.high.head(numbers.u_step.size());
  }
  return box;
}

CertifiedChanges certified(const LimitNumbers& numbers, double size, double tie_distance, long pieces = 100000) {
  CertificateEffort effort;
  effort.tie_distance = tie_distance;
  effort.pieces = pieces;
  return certify_changes(numbers, box_of(numbers, size), effort);
}

// The most changes that the solver makes: in states of the box, on its faces, in its corners and as near to cuts as
// numbers lie, where each answer is an optimum with that cap; or a tie is nearer than its distance, so that it is an
// optimum on the other side.
template <class S>
int most_seen(const LimitNumbers& numbers, double size, int cap, int states = 100000, double tie_distance = 0) {
  using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
  const auto in_target = [](const auto& values) { return Matrix(values.template cast<S>()); };
  lqg::step::LimitedLaw<S> law;
  law.nu = static_cast<int>(numbers.law.rows());
  law.iterations = static_cast<unsigned>(cap);
  law.F = in_target(numbers.F);
  law.G = in_target(numbers.G);
  law.scale = in_target(numbers.scale);
  law.low = in_target(numbers.low);
  law.high = in_target(numbers.high);
  law.tolerance = in_target(numbers.tolerance);
  law.u_step = in_target(numbers.u_step);
  unsigned most = 0;
  const auto answer = [&](const VectorXd& x, const VectorXd& applied) {
    return lqg::step::limited_input<S>(law, Vector(in_target(applied)), Vector(in_target(x)),
                                       Vector(in_target(VectorXd(numbers.law * x))));
  };
  const auto is_near_a_tie = [&](const VectorXd& x, const VectorXd& applied) {
    for (int corner = 0; tie_distance > 0 && corner < 1 << x.size(); ++corner) {
      VectorXd beside = x;
      for (Index j = 0; j < x.size(); ++j) beside(j) += (corner >> j & 1 ? 1 : -1) * tie_distance * size;
      if (answer(beside, applied).is_optimal) return true;
    }
    return false;
  };
  const auto changes = [&](const VectorXd& x, const VectorXd& applied) {
    const auto found = answer(x, applied);
    TEST_ASSERT_TRUE(found.is_optimal || is_near_a_tie(x, applied));
    if (found.is_optimal) most = std::max(most, found.changes);
    return found.changes;
  };
  Random random(7);
  VectorXd before = VectorXd::Zero(numbers.law.cols());
  for (int n = 0; n < states; ++n) {
    VectorXd x = random.matrix(numbers.law.cols(), 1);
    if (n % 3 == 1) x /= x.cwiseAbs().maxCoeff();
    if (n % 3 == 2) x = x.cwiseSign();
    if (n % 6 == 5) x(n / 6 % x.size()) = random.uniform();
    x *= size;
    const VectorXd applied = random.matrix(numbers.law.rows(), 1) * numbers.high(0);
    const unsigned needed = changes(x, applied);
    VectorXd near = before, far = x;  // with another number of changes: a cut is between them
    for (int halving = 0; n % 10 == 0 && halving < 60; ++halving) {
      const VectorXd middle = 0.5 * (near + far);
      (changes(middle, applied) == needed ? far : near) = middle;
    }
    before = x;
  }
  return static_cast<int>(most);
}

void expect_never_exceeded(const LimitNumbers& numbers, double size, int changes) {
  if (numbers.real == Scalar::float32)
    TEST_ASSERT_LESS_OR_EQUAL(changes, most_seen<float>(numbers, size, changes));
  else
    TEST_ASSERT_LESS_OR_EQUAL(changes, most_seen<double>(numbers, size, changes));
}

// Of 6 rows, two masses: the tie's distance leaves out a billionth of the box.
void test_two_masses_need_as_many_changes_as_are_proved() {
  const Digits scope(50);
  const LimitNumbers numbers = numbers_of(two_mass_in_blocks(), Scalar::float64);
  const CertifiedChanges found = certified(numbers, 1, 1e-9);
  TEST_ASSERT_TRUE(found.is_proved());
  TEST_ASSERT_EQUAL(8, found.changes);
  TEST_ASSERT_EQUAL(found.changes, most_seen<double>(numbers, 1, found.changes));
}

void test_a_larger_box_needs_more() {
  const Digits scope(50);
  const LimitNumbers numbers = numbers_of(two_mass_in_blocks(), Scalar::float64);
  const CertifiedChanges found = certified(numbers, 4, 1e-9);
  TEST_ASSERT_TRUE(found.is_proved());
  TEST_ASSERT_EQUAL(12, found.changes);
  expect_never_exceeded(numbers, 4, found.changes);
}

// Float is nearer to its ties.
void test_two_masses_in_float_need_a_larger_distance_from_ties() {
  const Digits scope(50);
  const LimitNumbers numbers = numbers_of(two_mass_in_blocks(), Scalar::float32);
  TEST_ASSERT_TRUE(certified(numbers, 1, 1e-9).gap == ProofGap::rounding);
  const CertifiedChanges found = certified(numbers, 1, 1e-3);
  TEST_ASSERT_TRUE(found.is_proved());
  TEST_ASSERT_EQUAL(8, found.changes);
  expect_never_exceeded(numbers, 1, found.changes);
}

void test_every_state_of_a_small_problem_is_covered_in_float_and_double() {
  const Digits scope(50);
  for (const Scalar number : {Scalar::float64, Scalar::float32}) {
    const LimitNumbers numbers = numbers_of(mass_in_three_blocks(), number);
    const CertifiedChanges found = certified(numbers, 4, 0);
    TEST_ASSERT_TRUE(found.is_proved());
    TEST_ASSERT_LESS_OR_EQUAL(6, found.changes);
    expect_never_exceeded(numbers, 4, found.changes);
  }
}

void test_limits_that_the_input_before_narrows_are_covered() {
  const Digits scope(50);
  LimitedProblem problem = mass_in_three_blocks();
  problem.u_step = real(MatrixXd::Constant(1, 1, 0.25));
  problem.step_price = RealVector::Constant(1, Real(100));
  problem.blocks = {1, 1};
  const LimitNumbers numbers = numbers_of(problem, Scalar::float64);
  const CertifiedChanges found = certified(numbers, 4, 1e-9);
  TEST_ASSERT_TRUE(found.is_proved());
  TEST_ASSERT_GREATER_OR_EQUAL(2, found.changes);
  expect_never_exceeded(numbers, 4, found.changes);
}

void test_what_never_touches_a_limit_needs_no_change() {
  const Digits scope(50);
  const CertifiedChanges found = certified(numbers_of(mass_in_three_blocks(), Scalar::float64), 1e-3, 0);
  TEST_ASSERT_TRUE(found.is_proved());
  TEST_ASSERT_EQUAL(0, found.changes);
}

// The number is that of the pieces that were seen, and is not said to be a proof.
void test_without_effort_left_nothing_is_proved() {
  const Digits scope(50);
  const LimitNumbers numbers = numbers_of(two_mass_in_blocks(), Scalar::float64);
  const CertifiedChanges found = certified(numbers, 1, 1e-9, 50);
  TEST_ASSERT_FALSE(found.is_proved());
  TEST_ASSERT_TRUE(found.gap == ProofGap::effort);
  TEST_ASSERT_EQUAL(50, found.pieces);
  CertificateEffort effort;
  effort.is_time_up = [] { return true; };
  TEST_ASSERT_TRUE(certify_changes(numbers, box_of(numbers, 1), effort).gap == ProofGap::effort);
}

// A tolerance below what double rounds in this problem: sets might come twice.
void test_a_tolerance_below_rounding_is_no_proof() {
  const Digits scope(50);
  LimitedProblem problem = two_mass_in_blocks();
  problem.tolerance = 1e-16;
  TEST_ASSERT_TRUE(certified(numbers_of(problem, Scalar::float64), 1, 0, 20000).gap != ProofGap::none);
}

void test_the_same_box_gives_the_same_pieces() {
  const Digits scope(50);
  const LimitNumbers numbers = numbers_of(two_mass_in_blocks(), Scalar::float64);
  const CertifiedChanges first = certified(numbers, 1, 1e-9), second = certified(numbers, 1, 1e-9);
  TEST_ASSERT_EQUAL(first.pieces, second.pieces);
  TEST_ASSERT_EQUAL(first.changes, second.changes);
}

// Rows that no plant stands behind, some nearly dependent, some with a limit on one side only.
LimitNumbers random_numbers(Random& random, Scalar number) {
  const Index nx = 2 + static_cast<Index>(random.uniform() + 1), rows = 3 + static_cast<Index>(random.uniform() + 1);
  const bool is_float = number == Scalar::float32;
  const auto rounded = [&](const MatrixXd& values) {
    return is_float ? MatrixXd(values.cast<float>().cast<double>()) : values;
  };
  MatrixXd M = random.matrix(rows, rows + 1);
  if (random.uniform() > 0.5) M.row(rows - 1) = M.row(0) + 0.1 * M.row(rows - 1);
  LimitNumbers numbers;
  numbers.real = number;
  numbers.law = rounded(3 * random.matrix(1, nx));
  numbers.F = rounded(3 * random.matrix(rows - 1, nx));
  numbers.G = rounded(M * M.transpose());
  numbers.G = numbers.G.selfadjointView<Eigen::Lower>();
  numbers.scale = rounded(numbers.G.diagonal().cwiseSqrt().cwiseInverse());
  numbers.high = VectorXd::Ones(rows);
  numbers.low = -numbers.high;
  if (random.uniform() > 0) numbers.low(rows - 1) = -std::numeric_limits<double>::infinity();
  numbers.tolerance = VectorXd::Constant(rows, is_float ? 2e-4 : 2e-12);
  return numbers;
}

void expect_random_proofs_to_hold(Scalar number, double tie_distance, int least) {
  Random random(number == Scalar::float32 ? 21 : 22);
  int proved = 0;
  for (int n = 0; n < 60; ++n) {
    const LimitNumbers numbers = random_numbers(random, number);
    const CertifiedChanges found = certified(numbers, 1, tie_distance, 3000);
    if (!found.is_proved()) continue;
    ++proved;
    const int seen = number == Scalar::float32 ? most_seen<float>(numbers, 1, found.changes, 2000, tie_distance)
                                               : most_seen<double>(numbers, 1, found.changes, 2000, tie_distance);
    TEST_ASSERT_LESS_OR_EQUAL(found.changes, seen);
  }
  TEST_ASSERT_GREATER_OR_EQUAL(least, proved);
}

void test_proofs_for_random_rows_hold_for_every_state() {
  expect_random_proofs_to_hold(Scalar::float32, 0, 30);
  expect_random_proofs_to_hold(Scalar::float64, 0, 30);
}

void test_proofs_for_random_rows_hold_away_from_ties() {
  expect_random_proofs_to_hold(Scalar::float32, 1e-3, 45);
  expect_random_proofs_to_hold(Scalar::float64, 1e-9, 45);
}

// x + y ≥ 1.5 and x − y ≥ bound: empty from bound > 0.5 on, as x ≤ 1.
void test_a_region_is_empty_only_when_it_is() {
  for (const double bound : {0.4, 0.5 - 1e-12, 0.5 + 1e-12, 0.6}) {
    Region region(2);
    region.add(Eigen::Vector2d(-1, -1), -1.5, 0);
    region.add(Eigen::Vector2d(-1, 1), -bound, 0);
    VectorXd point = VectorXd::Zero(2);
    TEST_ASSERT_EQUAL(bound > 0.5, region.is_empty(point));
    if (bound < 0.45) TEST_ASSERT_TRUE(point(0) + point(1) >= 1.5 - 1e-9 && point(0) - point(1) >= bound - 1e-9);
  }
}

// G⁻¹ G = 1 after rows have come and gone, as exactly as the target's numbers let it.
void test_the_factors_are_those_of_the_rows_that_are_left() {
  Random random(3);
  const MatrixXd G = random.semidefinite(6, 6) + 0.1 * MatrixXd::Identity(6, 6);
  const int left[] = {0, 2, 3, 5};
  const struct {
    TargetArithmetic target;
    double largest;
  } kinds[] = {{{false, false}, 1e-12}, {{false, true}, 1e-12}, {{true, false}, 1e-4}, {{true, true}, 1e-4}};
  for (const auto& kind : kinds) {
    RoundedFactor factor(kind.target);
    for (int i = 0; i < 6; ++i) {
      std::vector<double> column;
      for (int j = 0; j <= i; ++j) column.push_back(kind.target.round(G(i, j)));
      factor.append(column);
    }
    factor.drop(1);
    factor.drop(3);
    for (int j = 0; j < 4; ++j) {
      VectorXd right(4);
      for (int i = 0; i < 4; ++i) right(i) = kind.target.round(G(left[i], left[j]));
      expect_small((factor.solution(right) - VectorXd::Unit(4, j)).cwiseAbs().maxCoeff(), kind.largest, "G⁻¹ G");
    }
  }
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_two_masses_need_as_many_changes_as_are_proved);
  RUN_TEST(test_a_larger_box_needs_more);
  RUN_TEST(test_two_masses_in_float_need_a_larger_distance_from_ties);
  RUN_TEST(test_every_state_of_a_small_problem_is_covered_in_float_and_double);
  RUN_TEST(test_limits_that_the_input_before_narrows_are_covered);
  RUN_TEST(test_what_never_touches_a_limit_needs_no_change);
  RUN_TEST(test_without_effort_left_nothing_is_proved);
  RUN_TEST(test_a_tolerance_below_rounding_is_no_proof);
  RUN_TEST(test_the_same_box_gives_the_same_pieces);
  RUN_TEST(test_proofs_for_random_rows_hold_for_every_state);
  RUN_TEST(test_proofs_for_random_rows_hold_away_from_ties);
  RUN_TEST(test_a_region_is_empty_only_when_it_is);
  RUN_TEST(test_the_factors_are_those_of_the_rows_that_are_left);
  return UNITY_END();
}
