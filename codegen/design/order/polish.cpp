// SPDX-License-Identifier: MIT
#include "design/order/polish.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "design/numeric/factor.hpp"
#include "design/order/flat_descent.hpp"
#include "design/order/refined_moments.hpp"
#include "design/order/scaled_problem.hpp"
#include "design/progress.hpp"
#include "design/rounding.hpp"

namespace lqg::design::order {

namespace {

const unsigned more_digits = 40;
const double least_curvature = 1e-13, least_curvature_in_more_digits = 1e-26;

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

void set_inverse(const Matrix<double>& across, const RealMatrix& reduced, bool in_more_digits, Chart& chart) {
  chart.curvature = relative_curvature(to_doubles(reduced));
  const std::optional<RealMatrix> inverse = solve(reduced, identity(reduced.rows()));
  // Below what doubles tell the least one is the inverse of the largest of the inverse.
  const bool is_definite = in_more_digits && inverse && positive_definite(reduced);
  if (is_definite && chart.curvature <= least_curvature)
    chart.curvature = to_double(Real(1 / (largest_entry(reduced) * largest_entry(*inverse))));
  const double least = is_definite ? least_curvature_in_more_digits : least_curvature;
  chart.is_usable = chart.curvature > least && (inverse || reduced.size() == 0);
  if (chart.is_usable && inverse) chart.inverse = multiply(real(across), multiply_transpose(*inverse, real(across)));
}

Chart chart_in_doubles(const Family& family, const Matrix<double>& across, const Matrix<double>& Theta) {
  Chart chart;
  const Point point = point_at(family, Theta);
  if (!point.is_stable) return chart;
  chart.map = point.map;
  chart.cost = point.cost;
  const Digits scope(more_digits);
  set_inverse(across, real(across.transpose() * hessian(family, point) * across), false, chart);
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
  set_inverse(across, transpose_multiply(basis, multiply(hessian(family, point), basis)), true, chart);
  return chart;
}

class Polishing {
 public:
  Polishing(const OrderProblem& problem, Index order, const RealMatrix& Theta)
      : problem_(problem), rough_(loop_family<double>(problem, order)), fine_(loop_family<Real>(problem, order)),
        across_(across_orbit(rough_, to_doubles(Theta))) {
    result_.Theta = Theta;
    start_ = Theta;
  }

  Polished result() {
    if (run(false)) return result_;
    const Polished rough = result_;
    result_.Theta = start_;
    if (run(true) || !go_down_flat()) return result_;
    if (!run(true)) result_ = rough;
    return result_;
  }

 private:
  // True when it has settled.
  bool run(bool in_more_digits);
  bool take_chart(bool in_more_digits);
  bool go_down_flat();
  std::optional<Real> step();

  const OrderProblem& problem_;
  Family rough_;
  LoopFamily<Real> fine_;
  Matrix<double> across_;
  Chart chart_;
  RealMatrix start_, P_, S_;
  Polished result_;
};

bool Polishing::take_chart(bool in_more_digits) {
  chart_ = chart_in_doubles(rough_, across_, to_doubles(result_.Theta));
  if (in_more_digits) chart_ = chart_in_more_digits(problem_, across_, result_.Theta, chart_);
  result_.curvature = chart_.curvature;
  result_.cost = chart_.cost;  // until a step has a better one
  return chart_.is_usable;
}

// To a minimum in more digits from which the others are found.
bool Polishing::go_down_flat() {
  const Index n = rough_.size();
  if (n * (n + 1) / 2 > most_flat_unknowns) return false;
  std::optional<RealMatrix> end;
  {
    const Digits scope(more_digits);
    const LoopFamily<Real> family = loop_family<Real>(in_present_digits(problem_), rough_.order);
    end = descend_flat(family, design::in_present_digits(start_));
  }
  if (!end) return false;
  result_.Theta = design::in_present_digits(*end);
  across_ = across_orbit(rough_, to_doubles(result_.Theta));
  P_ = S_ = RealMatrix();
  return true;
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
