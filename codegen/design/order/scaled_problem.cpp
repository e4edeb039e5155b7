// SPDX-License-Identifier: MIT
#include "design/order/scaled_problem.hpp"

#include <cmath>

#include "design/equations/riccati.hpp"
#include "design/rounding.hpp"

namespace lqg::design::order {

namespace {

const unsigned few_digits = 40;

Eigen::VectorXd powers_of_two(const Eigen::VectorXd& sizes) {
  return sizes.unaryExpr(
      [](double size) { return size > 0 && std::isfinite(size) ? std::exp2(std::round(std::log2(size))) : 1.0; });
}

RealMatrix diagonal(const Eigen::VectorXd& entries) { return real(Eigen::MatrixXd(entries.asDiagonal())); }
RealMatrix inverse_diagonal(const Eigen::VectorXd& entries) { return diagonal(entries.cwiseInverse()); }

RealMatrix between(const RealMatrix& left, const RealMatrix& a, const RealMatrix& right) {
  return multiply(left, multiply(a, right));
}

OrderProblem in_other_units(const OrderProblem& problem, const Units& units) {
  const RealMatrix x = diagonal(units.x), u = diagonal(units.u), y = diagonal(units.y);
  const RealMatrix x_back = inverse_diagonal(units.x), y_back = inverse_diagonal(units.y);
  OrderProblem result = problem;
  result.A = between(x_back, problem.A, x);
  result.B = between(x_back, problem.B, u);
  result.C = between(y_back, problem.C, x);
  result.Q = between(x, problem.Q, x) / Real(units.cost);
  result.N = between(x, problem.N, u) / Real(units.cost);
  result.R = between(u, problem.R, u) / Real(units.cost);
  result.W = between(x_back, problem.W, x_back);
  result.Swv = between(x_back, problem.Swv, y_back);
  result.V = between(y_back, problem.V, y_back);
  for (WhiteParameter& white : result.white)
    white = {between(x_back, white.A, x), between(x_back, white.B, u), between(y_back, white.C, x)};
  return result;
}

// X, or that of weights lifted off the semidefinite limit.
RiccatiResult riccati_of(bool is_continuous, const RiccatiEquation& equation) {
  const auto solve_it = is_continuous ? solve_continuous_riccati : solve_discrete_riccati;
  RiccatiResult result = solve_it(equation, RealMatrix());
  if (result.failure == RiccatiFailure::none) return result;
  RiccatiEquation lifted = equation;
  const Real size = largest_entry(equation.Q) + largest_entry(equation.R);
  lifted.Q += size * Real(1e-6) * identity(equation.Q.rows());
  lifted.R += size * Real(1e-6) * identity(equation.R.rows());
  return solve_it(lifted, RealMatrix());
}

struct FullOrder {
  RiccatiResult control, filter;
  RealMatrix control_weight, innovation;  // R + BᵀXB, V + CPCᵀ
  RealMatrix Theta;
};

// u = −K z + D e, z⁺ = A z + B u + L e with the innovation e = y − C z. With feed-through D = −K PCᵀS⁻¹ −
// (R + BᵀXB)⁻¹BᵀX Swv S⁻¹: the part of w that e tells.
RealMatrix compensator_of(const OrderProblem& problem, const FullOrder& law) {
  const RealMatrix K = law.control.K, L = law.filter.K.transpose();
  RealMatrix D = zeros(problem.B.cols(), problem.C.rows());
  if (problem.has_feedthrough) {
    const RealMatrix known = *solve(law.innovation, beside(multiply(problem.C, law.filter.X), problem.Swv.transpose()));
    const Index nx = problem.A.rows();
    const RealMatrix force = multiply(law.control.X, known.rightCols(nx).transpose());
    D = -multiply(K, known.leftCols(nx).transpose()) - *solve(law.control_weight, transpose_multiply(problem.B, force));
  }
  const RealMatrix C = -K - multiply(D, problem.C);
  const RealMatrix A = problem.A - multiply(L, problem.C) + multiply(problem.B, C);
  return above(beside(D, C), beside(L + multiply(problem.B, D), A));
}

std::optional<FullOrder> full_order_of(const OrderProblem& problem) {
  FullOrder law;
  law.control = riccati_of(problem.is_continuous, {problem.A, problem.B, problem.Q, problem.R, problem.N});
  law.filter = riccati_of(problem.is_continuous,
                          {problem.A.transpose(), problem.C.transpose(), problem.W, problem.V, problem.Swv});
  if (law.control.failure != RiccatiFailure::none || law.filter.failure != RiccatiFailure::none) return std::nullopt;
  law.control_weight = problem.R;
  law.innovation = problem.V;
  if (!problem.is_continuous) {
    law.control_weight += transpose_congruence(problem.B, law.control.X);
    law.innovation += congruence(problem.C, law.filter.X);
  }
  law.Theta = compensator_of(problem, law);
  return law;
}

// Units in which the full-order loop has states of rms 1, innovations of rms 1 and costs 1, and in which u = 1 costs 1.
Units units_of(const OrderProblem& problem, const FullOrder& law) {
  const Family family = loop_family<double>(without_white(problem), problem.A.rows());
  const Point point = point_at(family, to_doubles(law.Theta));
  Units units;
  const double cost = point.is_stable && point.cost > 0 && std::isfinite(point.cost) ? point.cost : 1.0;
  units.cost = powers_of_two(Eigen::VectorXd::Constant(1, cost))(0);
  units.x = point.is_stable ? Eigen::VectorXd(point.P.diagonal().head(family.nx).cwiseSqrt())
                            : Eigen::VectorXd(Eigen::VectorXd::Ones(family.nx));
  units.x = powers_of_two(units.x);
  units.y = powers_of_two(to_doubles(law.innovation).diagonal().cwiseSqrt());
  units.u = powers_of_two((units.cost * to_doubles(law.control_weight).diagonal().cwiseInverse()).cwiseSqrt());
  return units;
}

Units no_units(const OrderProblem& problem) {
  return {Eigen::VectorXd::Ones(problem.A.rows()), Eigen::VectorXd::Ones(problem.B.cols()),
          Eigen::VectorXd::Ones(problem.C.rows()), 1};
}

// ū = [u; z⁺] and ȳ = [y; z]: Θ maps the one to the other.
RealMatrix with_scales(const Eigen::VectorXd& u, const Eigen::VectorXd& y, const RealMatrix& Theta) {
  RealMatrix result = Theta;
  for (Index i = 0; i < u.size(); ++i) result.row(i) *= Real(u(i));
  for (Index j = 0; j < y.size(); ++j) result.col(j) /= Real(y(j));
  return result;
}

}  // namespace

OrderProblem without_white(OrderProblem problem) {
  problem.white.clear();
  return problem;
}

OrderProblem in_present_digits(const OrderProblem& problem) {
  OrderProblem result = problem;
  for (RealMatrix* a :
       {&result.A, &result.B, &result.C, &result.Q, &result.N, &result.R, &result.W, &result.Swv, &result.V})
    *a = design::in_present_digits(*a);
  for (WhiteParameter& white : result.white)
    white = {design::in_present_digits(white.A), design::in_present_digits(white.B),
             design::in_present_digits(white.C)};
  return result;
}

std::optional<Matrix<double>> full_order_law(const OrderProblem& problem, double inputs, double outputs) {
  const Digits scope(few_digits);
  OrderProblem other = in_present_digits(problem);
  other.R *= Real(inputs);
  other.V *= Real(outputs);
  const std::optional<FullOrder> law = full_order_of(other);
  if (!law) return std::nullopt;
  const Family family = loop_family<double>(without_white(problem), problem.A.rows());
  const Point point = point_at(family, to_doubles(law->Theta));
  if (!point.is_stable) return std::nullopt;
  return balanced(family, point);
}

Matrix<double> truncated(const Family& family, const Matrix<double>& law, Index order) {
  Matrix<double> result(family.nu + order, family.ny + order);
  result.topLeftCorner(family.nu, family.ny) = law.topLeftCorner(family.nu, family.ny);
  result.topRightCorner(family.nu, order) = law.topRightCorner(family.nu, order);
  result.bottomLeftCorner(order, family.ny) = law.bottomLeftCorner(order, family.ny);
  result.bottomRightCorner(order, order) = law.bottomRightCorner(order, order);
  return result;
}

ScaledProblem scaled(const OrderProblem& problem) {
  ScaledProblem result;
  {
    const Digits scope(few_digits);
    const OrderProblem rough = in_present_digits(problem);
    const std::optional<FullOrder> law = full_order_of(rough);
    result.units = law ? units_of(rough, *law) : no_units(problem);
  }
  result.problem = in_other_units(problem, result.units);
  return result;
}

RealMatrix in_units(const Units& units, const RealMatrix& Theta) { return with_scales(units.u, units.y, Theta); }

RealMatrix from_units(const Units& units, const RealMatrix& Theta) {
  return with_scales(units.u.cwiseInverse(), units.y.cwiseInverse(), Theta);
}

}  // namespace lqg::design::order
