// SPDX-License-Identifier: MIT
#include "design/order/polish.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "design/order/refined_moments.hpp"
#include "design/order/scaled_problem.hpp"
#include "design/progress.hpp"
#include "design/rounding.hpp"

namespace lqg::design::order {

namespace {

const unsigned more_digits = 40;
const double least_curvature = 1e-13;

// What is orthogonal to the orbit, an orthonormal column each.
Matrix<double> across_orbit(const Family& family, const Matrix<double>& Theta) {
  const Matrix<double> basis = orbit_basis(family, Theta);
  const Index count = family.free_entries();
  if (basis.cols() == 0) return Matrix<double>::Identity(count, count);
  const Eigen::HouseholderQR<Matrix<double>> factors(basis);
  const Matrix<double> all = factors.householderQ() * Matrix<double>::Identity(count, count);
  return all.rightCols(count - basis.cols());
}

double relative_curvature(const Matrix<double>& reduced) {
  if (reduced.size() == 0) return 1;
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Matrix<double>>(reduced).eigenvalues();
  return values(0) / values.cwiseAbs().maxCoeff();
}

// Map and H⁺ at one Θ, in doubles.
struct Chart {
  bool is_usable = false;
  Matrix<double> across;
  MomentMap<double> map;
  RealMatrix inverse;
  double curvature = 0;
  double cost = 0;
};

void set_inverse(const Matrix<double>& across, const RealMatrix& reduced, Chart& chart) {
  chart.curvature = relative_curvature(to_doubles(reduced));
  const std::optional<RealMatrix> inverse = solve(reduced, identity(reduced.rows()));
  chart.is_usable = chart.curvature > least_curvature && (inverse || reduced.size() == 0);
  if (chart.is_usable && inverse) chart.inverse = multiply(real(across), multiply_transpose(*inverse, real(across)));
}

Chart chart_in_doubles(const Family& family, const Matrix<double>& across, const Matrix<double>& Theta) {
  Chart chart;
  const Point point = point_at(family, Theta);
  if (!point.is_stable) return chart;
  chart.map = point.map;
  chart.cost = point.cost;
  const Digits scope(more_digits);
  set_inverse(across, real(across.transpose() * hessian(family, point) * across), chart);
  return chart;
}

Chart chart_in_more_digits(const OrderProblem& problem, const Matrix<double>& across, const RealMatrix& Theta,
                           Chart chart) {
  const Digits scope(more_digits);
  const LoopFamily<Real> family = loop_family<Real>(in_present_digits(problem), Theta.rows() - problem.B.cols());
  const LoopPoint<Real> point = point_at(family, design::in_present_digits(Theta));
  chart.is_usable = false;
  if (!point.is_stable) return chart;
  const RealMatrix basis = real(across);
  set_inverse(across, transpose_multiply(basis, multiply(hessian(family, point), basis)), chart);
  return chart;
}

class Polishing {
 public:
  Polishing(const OrderProblem& problem, Index order, const RealMatrix& Theta)
      : problem_(problem), rough_(loop_family<double>(problem, order)), fine_(loop_family<Real>(problem, order)),
        across_(across_orbit(rough_, to_doubles(Theta))) {
    result_.Theta = Theta;
  }

  Polished result() {
    if (!run(false) && result_.failure != OrderFailure::none) run(true);
    return result_;
  }

 private:
  // True when it has settled.
  bool run(bool in_more_digits);
  bool take_chart(bool in_more_digits);
  std::optional<Real> step();

  const OrderProblem& problem_;
  Family rough_;
  LoopFamily<Real> fine_;
  Matrix<double> across_;
  Chart chart_;
  RealMatrix P_, S_;
  Polished result_;
};

bool Polishing::take_chart(bool in_more_digits) {
  chart_ = chart_in_doubles(rough_, across_, to_doubles(result_.Theta));
  if (in_more_digits) chart_ = chart_in_more_digits(problem_, across_, result_.Theta, chart_);
  result_.curvature = chart_.curvature;
  result_.cost = chart_.cost;  // until a step has a better one
  return chart_.is_usable;
}

// The largest change of an entry; empty where the moments cannot be solved for.
std::optional<Real> Polishing::step() {
  const LoopTerms<Real> terms = terms_at(fine_, result_.Theta);
  const std::optional<RealMatrix> P =
      refined_moments(chart_.map, terms.Phi, fine_.is_continuous, Side::moments, moments_added(fine_, terms), P_);
  const std::optional<RealMatrix> S =
      refined_moments(chart_.map, terms.Phi, fine_.is_continuous, Side::duals, duals_added(fine_, terms), S_);
  if (!P || !S) return std::nullopt;
  P_ = *P;
  S_ = *S;
  result_.cost = cost_of(fine_, terms, P_);
  if (chart_.inverse.size() == 0) return Real(0);
  const RealMatrix change = multiply(chart_.inverse, gradient_of(fine_, terms, P_, S_));
  result_.Theta -= unpacked<Real>(fine_, change);
  return largest_entry(change);
}

bool Polishing::run(bool in_more_digits) {
  const int most_steps = 60, charts = 4;
  result_.failure = OrderFailure::not_strict;
  if (!take_chart(in_more_digits)) return false;
  result_.failure = OrderFailure::not_converged;
  Real before = 1;
  for (int k = 0; k < most_steps; ++k) {
    report_progress("Compensator of that order, polish,", k);
    if (k > 0 && k < charts && !take_chart(in_more_digits)) return false;
    const std::optional<Real> change = step();
    if (!change || !(*change < 1)) return false;
    const Real size = 1 + largest_entry(result_.Theta);
    if (*change <= negligible(0.85) * size || (*change <= negligible(0.7) * size && *change > before / 2)) {
      result_.failure = OrderFailure::none;
      return true;
    }
    if (k > charts && *change > before / 2) return false;
    before = *change;
  }
  return false;
}

}  // namespace

Polished polished(const OrderProblem& problem, Index order, const RealMatrix& Theta) {
  return Polishing(problem, order, Theta).result();
}

}  // namespace lqg::design::order
