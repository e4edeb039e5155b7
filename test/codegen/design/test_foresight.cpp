// SPDX-License-Identifier: MIT
// Limits that are foreseen of whole designs: what becomes of delays, references, the last input and decay.
//
// Nothing is known here of how the rows are made: a design is run, sample by sample, with its law and with an input
// beside it, and what is seen has to be what F and G say.
#include <cmath>

#include "design/rounding.hpp"
#include "design/sampled/augmentation.hpp"
#include "design/sampled/stages.hpp"
#include "problems.hpp"
#include "unity.h"

using namespace lqg::design;
using design_test::Random;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd doubles(const RealMatrix& values) { return to_doubles(values); }

Problem base() {
  Problem problem = design_test::regulator_alone(design_test::two_mass());
  Limits limits;
  limits.u_min = VectorXd::Constant(1, -0.3);
  limits.u_max = VectorXd::Constant(1, 0.4);
  limits.horizon = 9;
  limits.u_rate_price = VectorXd::Constant(1, 50);
  problem.limits = limits;
  problem.code.real = Scalar::float64;
  return problem;
}

SoftLimits soft(Index count, Index which, double low, double high, double price) {
  SoftLimits limits;
  limits.range = MatrixXd::Constant(count, 2, std::numeric_limits<double>::infinity());
  limits.range.col(0) *= -1;
  limits.range(which, 0) = low;
  limits.range(which, 1) = high;
  limits.price = VectorXd::Constant(count, price);
  return limits;
}

// What happens to the limited quantities from x, u[k−1] and r on when v is added to the law, one entry an input and a
// block.
class Course {
 public:
  Course(const Problem& problem, const Solution& solution, std::vector<int> blocks)
      : problem_(problem), A_(doubles(solution.plant.A)), B_(doubles(solution.plant.B)), C_(doubles(solution.plant.C)),
        K_(doubles(solution.regulator->K)), Nbar_(doubles(solution.regulator->Nbar)), blocks_(std::move(blocks)) {}

  // In the order of the rows: u, the change of u, states, outputs, changes of outputs.
  VectorXd rows(VectorXd x, VectorXd last, const VectorXd& r, const MatrixXd& v) const {
    std::vector<double> out;
    VectorXd y_before, u_before;
    for (std::size_t block = 0; block < blocks_.size(); ++block)
      for (int k = 0; k < blocks_[block]; ++k) {
        const VectorXd u = law(x, last, r) + v.col(static_cast<Index>(block)), y = C_ * x;
        if (k == 0) add(x, u, u_before, y, y_before, block == 0, out);
        x = A_ * x + B_ * u;
        y_before = y;
        last = u_before = u;
      }
    return Eigen::Map<VectorXd>(out.data(), static_cast<Index>(out.size()));
  }

 private:
  VectorXd law(const VectorXd& x, const VectorXd& last, const VectorXd& r) const {
    VectorXd u = -(K_.leftCols(x.size()) * x);
    if (problem_.regulator->input_rate.size()) u += last - K_.rightCols(last.size()) * last;
    if (Nbar_.size()) u += Nbar_ * r;
    return u;
  }
  void add(const VectorXd& x, const VectorXd& u, const VectorXd& u_before, const VectorXd& y, const VectorXd& y_before,
           bool is_first, std::vector<double>& out) const {
    const Limits& limits = *problem_.limits;
    out.push_back(u(0));
    if (!is_first && limits.u_rate.size()) out.push_back(u(0) - u_before(0));
    for (Index i = 0; i < limits.states.range.rows(); ++i)
      if (!is_first && std::isfinite(limits.states.range(i, 1))) out.push_back(x(i));
    for (Index i = 0; i < limits.outputs.range.rows(); ++i)
      if (!is_first && std::isfinite(limits.outputs.range(i, 1))) out.push_back(y(i));
    for (Index i = 0; i < limits.output_rates.range.rows(); ++i)
      if (!is_first && std::isfinite(limits.output_rates.range(i, 1))) out.push_back(y(i) - y_before(i));
  }

  const Problem& problem_;
  const MatrixXd A_, B_, C_, K_, Nbar_;
  const std::vector<int> blocks_;
};

// R + BᵀXB of the equation that K solves.
double weight_of(const Problem& problem, const Solution& solution) {
  const Samples samples = sample_stages(problem).back().samples;
  const RiccatiEquation equation = regulator_equation(problem, samples);
  return to_double((equation.R + transpose_congruence(equation.B, solution.regulator->X))(0, 0));
}

void expect_rows(const Problem& problem, const std::vector<int>& blocks, double decay = 1) {
  const Solution solution = design_test::solved(problem);
  const Digits scope(solution.numerics.digits);
  const LimitedRows& rows = *solution.foreseen;
  const Course course(problem, solution, blocks);
  const Index nx = solution.plant.A.rows(), last = problem.regulator->input_rate.size() ? 1 : 0,
              nr = solution.regulator->Nbar.cols(), count = static_cast<Index>(blocks.size());
  Random random(3);
  const MatrixXd none = MatrixXd::Zero(1, count);
  for (int n = 0; n < 5; ++n) {
    const VectorXd x = random.matrix(nx, 1), before = random.matrix(1, 1), r = random.matrix(nr, 1);
    VectorXd s(nx + last + nr);
    s << x, before.head(last), r;
    const VectorXd seen = course.rows(x, before, r, none);
    TEST_ASSERT_EQUAL(seen.size(), rows.G.rows());
    const VectorXd said = doubles(rows.F) * s;
    for (Index i = 1; i < seen.size(); ++i) TEST_ASSERT_DOUBLE_WITHIN(1e-11, seen(i), said(i - 1));
  }
  // G = Σ n nᵀ/(what v costs), n: what v of a block does, seen alone.
  const VectorXd x = VectorXd::Zero(nx), zero = VectorXd::Zero(1), r = VectorXd::Zero(nr);
  MatrixXd G = MatrixXd::Zero(rows.G.rows(), rows.G.rows());
  int sample = 0;
  for (Index block = 0; block < count; ++block) {
    MatrixXd v = none;
    v(0, block) = 1;
    const VectorXd n = course.rows(x, zero, r, v);
    double cost = 0;
    for (int k = 0; k < blocks[static_cast<std::size_t>(block)]; ++k) cost += std::pow(decay, 2 * sample++);
    G += n * n.transpose() / (cost * weight_of(problem, solution));
  }
  for (Index i = 0; i < G.rows(); ++i) {
    if (const auto& price = rows.price[static_cast<std::size_t>(i)]) G(i, i) += 1 / to_double(*price);
    for (Index j = 0; j < G.cols(); ++j)
      TEST_ASSERT_DOUBLE_WITHIN(1e-11 * G.cwiseAbs().maxCoeff(), G(i, j), to_double(rows.G(i, j)));
  }
}

void test_blocks_of_limits_of_the_input_alone_grow() { expect_rows(base(), {1, 1, 2, 4, 1}); }

void test_inputs_on_their_way_are_foreseen() {
  Problem problem = base();
  problem.plant.delay = 0.8;  // one period, and a part of the next
  expect_rows(problem, {1, 1, 2, 4, 1});
}

void test_a_reference_is_held_over_the_horizon() {
  Problem problem = base();
  problem.regulator->track = {1};
  problem.limits->outputs = soft(2, 0, -1, 2, 1e4);
  problem.limits->output_rates = soft(2, 1, -0.5, 0.5, 1e3);
  problem.limits->horizon = 4;
  expect_rows(problem, {1, 1, 1, 1});
}

void test_changes_of_the_input_go_on_from_the_last_one() {
  Problem problem = base();
  problem.regulator->input_rate = MatrixXd::Constant(1, 1, 0.7);
  problem.limits->u_rate = VectorXd::Constant(1, 0.2);
  problem.limits->states = soft(4, 1, -0.2, 0.3, 1e5);
  problem.limits->blocks = {1, 2, 1};
  problem.limits->horizon = 4;
  expect_rows(problem, {1, 2, 1});
}

void test_what_comes_later_is_dearer_with_a_decay() {
  Problem problem = base();
  problem.regulator->decay = 1.05;
  problem.limits->blocks = {1, 3, 2};
  problem.limits->horizon = 6;
  expect_rows(problem, {1, 3, 2}, 1.05);
}

// In float 1/price has to be seen beside G_ii.
void test_a_price_beyond_the_numbers_of_the_target_is_lowered_and_said() {
  Problem problem = base();
  problem.limits->states = soft(4, 1, -0.2, 0.3, 1e9);
  problem.code.real = Scalar::float32;
  Findings findings;
  const Solution solution = *solve(problem, findings);
  bool is_said = false;
  for (const Finding& finding : findings) is_said = is_said || finding.key == "limits.price";
  TEST_ASSERT_TRUE(is_said);
  for (std::size_t i = 0; i < solution.foreseen->names.size(); ++i)
    if (const auto& price = solution.foreseen->price[i]) TEST_ASSERT_TRUE(*price < 1e8 && *price > 1e3);
  problem.code.real = Scalar::float64;
  findings.clear();
  const Solution in_double = *solve(problem, findings);
  for (const auto& price : in_double.foreseen->price) TEST_ASSERT_TRUE(!price || to_double(*price) == 1e9);
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_blocks_of_limits_of_the_input_alone_grow);
  RUN_TEST(test_inputs_on_their_way_are_foreseen);
  RUN_TEST(test_a_reference_is_held_over_the_horizon);
  RUN_TEST(test_changes_of_the_input_go_on_from_the_last_one);
  RUN_TEST(test_what_comes_later_is_dearer_with_a_decay);
  RUN_TEST(test_a_price_beyond_the_numbers_of_the_target_is_lowered_and_said);
  return UNITY_END();
}
