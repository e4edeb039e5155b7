// SPDX-License-Identifier: MIT
#include "design/run/compensator_form.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "design/rounding.hpp"

namespace lqg::design {

namespace {

// b a⁻¹
std::optional<RealMatrix> divided(const RealMatrix& b, const RealMatrix& a) {
  const std::optional<RealMatrix> quotient = solve(RealMatrix(a.transpose()), RealMatrix(b.transpose()));
  if (!quotient) return std::nullopt;
  return RealMatrix(quotient->transpose());
}

RealMatrix rows_at(const RealMatrix& from, const std::vector<int>& rows) {
  RealMatrix result(static_cast<Index>(rows.size()), from.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) result.row(static_cast<Index>(i)) = from.row(rows[i]);
  return result;
}

// Rows of T in parts of each state's standard deviation, over z of unit covariance.
Eigen::MatrixXd correlations(const RealMatrix& T, const RealMatrix& Px, const RealMatrix& Pz) {
  const Index n = Pz.rows();
  RealMatrix scaled = Pz;  // to a unit diagonal: what double holds of it does not depend on units
  RealVector roots(n);
  for (Index i = 0; i < n; ++i) roots(i) = sqrt(Pz(i, i));
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) scaled(i, j) = Pz(i, j) / (roots(i) * roots(j));
  const Eigen::LLT<RealMatrix> factor(scaled);
  RealMatrix lower = factor.matrixL();
  for (Index i = 0; i < n; ++i) lower.row(i) *= roots(i);
  RealMatrix result = multiply(T, lower);
  for (Index i = 0; i < result.rows(); ++i)
    if (Px(i, i) > 0) result.row(i) /= sqrt(Px(i, i));
  return to_doubles(result);
}

std::vector<int> states_told(Eigen::MatrixXd rows, Index count) {
  constexpr double equal = 1e-6;
  std::vector<int> chosen;
  while (static_cast<Index>(chosen.size()) < count) {
    const Eigen::VectorXd sizes = rows.rowwise().norm();
    Index best = 0;
    for (Index i = 1; i < sizes.size(); ++i)
      if (sizes(i) > sizes(best) * (1 + equal)) best = i;
    chosen.push_back(static_cast<int>(best));
    const Eigen::RowVectorXd direction = rows.row(best) / sizes(best);
    rows -= (rows * direction.transpose()) * direction;
    rows.row(best).setZero();
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

// Second moments of [x; z], and what the loop costs from any [x; z] on.
struct Moments {
  RealMatrix P, S;
};

std::optional<Moments> moments_of(const OrderProblem& problem, const MeasuredPlant& plant,
                                  const Compensator& controller) {
  const WhiteLoop white = white_loop(problem, plant, controller);
  const Index nx = plant.A.rows(), all = white.V.rows();
  const RealMatrix u = beside(multiply(controller.D, plant.C), controller.C);
  RealMatrix cost = transpose_congruence(above(identity(all).topRows(nx), u), joint(problem.Q, problem.N, problem.R));
  std::vector<RealMatrix> back;
  for (const RealMatrix& Phi : white.Phi) back.push_back(Phi.transpose());
  for (const WhiteParameter& parameter : problem.white)
    cost += padded(transpose_congruence(multiply(controller.D, parameter.C), problem.R), all, all);
  std::optional<RealMatrix> P = steady_second_moments(white.Phi, white.V), S = steady_second_moments(back, cost);
  if (!P || !S) return std::nullopt;
  return Moments{std::move(*P), std::move(*S)};
}

// z of x: −S_zz⁻¹ S_zx, scaled.
std::optional<RealMatrix> from_state(const RealMatrix& S, const RealMatrix& T, Index nx) {
  const Index n = T.cols();
  const std::optional<RealMatrix> least =
      solve(RealMatrix(S.bottomRightCorner(n, n)), RealMatrix(-S.bottomLeftCorner(n, nx)));
  if (!least) return std::nullopt;
  return solve(multiply(*least, T), *least);
}

// The gain from y − `expected` z to x̂; `error` is the covariance of x − T z.
std::optional<RealMatrix> correction(const OrderProblem& problem, const RealMatrix& Px, const RealMatrix& error) {
  RealMatrix of_y = problem.V + congruence(problem.C, error);
  for (const WhiteParameter& white : problem.white) of_y += congruence(white.C, Px);
  return divided(multiply_transpose(error, problem.C), of_y);
}

// In the new coordinates, exact where it is known.
RealMatrix estimated_states(const RealMatrix& T, const std::vector<int>& estimates) {
  RealMatrix result = T;
  for (std::size_t i = 0; i < estimates.size(); ++i)
    result.row(estimates[i]) = identity(T.cols()).row(static_cast<Index>(i));
  return result;
}

}  // namespace

std::optional<CompensatorForm> in_estimates(const OrderProblem& problem, const MeasuredPlant& plant, Index own,
                                            const Compensator& controller) {
  const std::optional<Moments> moments = moments_of(problem, plant, controller);
  if (!moments) return std::nullopt;
  const Index nx = plant.A.rows(), n = controller.A.rows();
  const RealMatrix& P = moments->P;
  const std::optional<RealMatrix> T = divided(P.topRightCorner(nx, n), P.bottomRightCorner(n, n));
  if (!T) return std::nullopt;
  CompensatorForm form;
  form.estimates = states_told(correlations(*T, P.topLeftCorner(nx, nx), P.bottomRightCorner(n, n)), n);
  form.to = rows_at(*T, form.estimates);
  const RealMatrix Px = P.topLeftCorner(nx, nx);
  const RealMatrix error = symmetric_part(Px - congruence(*T, P.bottomRightCorner(n, n)));
  const auto A = divided(multiply(form.to, controller.A), form.to), C = divided(controller.C, form.to),
             told = divided(*T, form.to), of_state = from_state(moments->S, *T, nx), L = correction(problem, Px, error);
  if (!A || !C || !told || !of_state || !L) return std::nullopt;
  form.controller = {*A, multiply(form.to, controller.B), *C, controller.D, n, 0};
  form.T = estimated_states(*told, form.estimates);
  form.P = error.topLeftCorner(own, own);
  form.expected = multiply(plant.C, form.T);
  if (!is_zero(plant.D)) form.expected += multiply(plant.D, form.controller.C);
  form.heard = problem.has_feedthrough ? RealMatrix(L->topRows(own)) : zeros(own, plant.C.rows());
  form.estimate = form.T.topRows(own) - multiply(form.heard, form.expected);
  const RealMatrix from = multiply(form.to, *of_state);
  form.of_state = from.leftCols(own);
  if (nx > own) form.keep = multiply(from.rightCols(nx - own), form.T.bottomRows(nx - own));
  return form;
}

void take_form(const CompensatorForm& form, CompensatorSolution& solution) {
  solution.A = form.controller.A, solution.B = form.controller.B;
  solution.C = form.controller.C, solution.D = form.controller.D;
  solution.T = form.T, solution.P = form.P, solution.expected = form.expected;
  solution.estimate = form.estimate, solution.heard = form.heard;
  solution.of_state = form.of_state, solution.keep = form.keep;
  solution.estimates = form.estimates;
}

}  // namespace lqg::design
