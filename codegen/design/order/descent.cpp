// SPDX-License-Identifier: MIT
#include "design/order/descent.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "design/progress.hpp"

namespace lqg::design::order {

namespace {

using Column = Eigen::VectorXd;

// P + a little of its mean, so that it is definite.
Matrix<double> lifted(const Matrix<double>& P) {
  const double share = 1e-3, least = 1e-12;
  const double lift = share * P.trace() / static_cast<double>(P.rows()) + least;
  return P + lift * Matrix<double>::Identity(P.rows(), P.cols());
}

// The quadratic model of the cost around a point, in the coordinates of its eigenvectors.
struct Model {
  Matrix<double> directions;
  Column curvatures, slopes;
};

// The model across the orbit; along it a curvature as large as the largest one, so that no step goes there.
Model model_of(const Family& family, const Point& point) {
  Matrix<double> H = hessian(family, point);
  Column g = gradient(family, point);
  const Matrix<double> basis = orbit_basis(family, point.Theta);
  const Matrix<double> across = Matrix<double>::Identity(H.rows(), H.cols()) - basis * basis.transpose();
  H = across * H * across;
  H += H.cwiseAbs().maxCoeff() * basis * basis.transpose();
  g = across * g;
  const Eigen::SelfAdjointEigenSolver<Matrix<double>> solver((H + H.transpose()) / 2);
  return {solver.eigenvectors(), solver.eigenvalues(), solver.eigenvectors().transpose() * g};
}

Column step_with(const Model& model, double shift) {
  Column step(model.slopes.size());
  for (Index k = 0; k < step.size(); ++k) {
    const double curvature = model.curvatures(k) + shift;
    step(k) = curvature > 0 ? -model.slopes(k) / curvature : 0;
  }
  return step;
}

// The least of the model within the radius. The curvature (H + shift) is positive; where even its limit gives a
// shorter step, the step is lengthened along the direction of the least curvature.
Column best_step(const Model& model, double radius) {
  const double least = model.curvatures(0), largest = model.curvatures.cwiseAbs().maxCoeff();
  const double floor = 1e-13 * largest;
  if (least > floor) {
    const Column newton = step_with(model, 0);
    if (newton.norm() <= radius) return newton;
  }
  double low = std::max(0.0, floor - least), high = low + model.slopes.norm() / radius + floor;
  Column step = step_with(model, low);
  if (step.norm() < radius) {
    const double missing = std::sqrt(radius * radius - step.squaredNorm());
    if (least < -floor) step(0) += model.slopes(0) > 0 ? -missing : missing;
    return step;
  }
  for (int k = 0; k < 100 && high - low > 1e-12 * high; ++k) {
    const double middle = low > 0 && high / low > 4 ? std::sqrt(low * high) : (low + high) / 2;
    (step_with(model, middle).norm() > radius ? low : high) = middle;
  }
  return step_with(model, high);
}

double gain_of_step(const Model& model, const Column& step) {
  return -(model.slopes.dot(step) + step.cwiseAbs2().dot(model.curvatures) / 2);
}

enum class Outcome {
  moved,
  settled,  // moved, by so little that the cost no longer tells
  stuck,
};

// One step down, within a radius that shrinks until there is one.
Outcome moved_down(const Family& family, double least_gain, double& radius, Point& point) {
  const Model model = model_of(family, point);
  while (radius > 1e-12) {
    const Column change = best_step(model, radius);
    const double promised = gain_of_step(model, change), length = change.norm();
    if (!(promised > 0)) return Outcome::stuck;
    const Matrix<double> Theta = point.Theta + unpacked<double>(family, model.directions * change);
    const Point next = point_at(family, Theta);
    if (promised <= least_gain * point.cost) {
      if (!next.is_stable || gradient(family, next).norm() >= model.slopes.norm()) return Outcome::stuck;
      point = next;
      return Outcome::settled;
    }
    const double gained = next.is_stable ? point.cost - next.cost : -1;
    if (gained < 0.25 * promised)
      radius = length / 4;
    else if (gained > 0.75 * promised && length > 0.9 * radius)
      radius = std::min(2 * radius, 1e3);
    if (gained <= 1e-4 * promised) continue;
    point = next;
    return Outcome::moved;
  }
  return Outcome::stuck;
}

// The first stable one of the problems that are easier by less and less of `ease`, from 0 on.
Point less_eased(const Family& family, const Matrix<double>& Theta, double ease, double& reached) {
  for (const double share : {0.0, 0.03, 0.1, 0.25, 0.5, 0.7, 0.85, 0.93, 0.97, 0.99, 0.997}) {
    Point point = point_at(eased(family, share * ease), Theta);
    if (!point.is_stable) continue;
    reached = share * ease;
    return point;
  }
  return Point();
}

}  // namespace

Matrix<double> orbit_basis(const Family& family, const Matrix<double>& Theta) {
  const Matrix<double> tangents = orbit_tangents<double>(family, Theta);
  if (tangents.cols() == 0) return Matrix<double>::Zero(family.free_entries(), 0);
  Eigen::ColPivHouseholderQR<Matrix<double>> factors(tangents);
  factors.setThreshold(1e-10);
  return factors.householderQ() * Matrix<double>::Identity(tangents.rows(), factors.rank());
}

Matrix<double> balanced(const Family& family, const Point& point) {
  const Index order = family.order;
  if (order == 0) return point.Theta;
  const Matrix<double> P = lifted(point.P.bottomRightCorner(order, order));
  const Matrix<double> S = lifted(point.S.bottomRightCorner(order, order));
  // P = F Fᵀ, FᵀSF = U σ² Uᵀ: z ← σ^(1/2) Uᵀ F⁻¹ z.
  const Matrix<double> F = P.llt().matrixL();
  const Eigen::SelfAdjointEigenSolver<Matrix<double>> solver(F.transpose() * S * F);
  if (!(solver.eigenvalues()(0) > 0)) return point.Theta;
  const Column root = solver.eigenvalues().array().pow(0.25);
  const Matrix<double> back = F * solver.eigenvectors() * root.cwiseInverse().asDiagonal();
  const Matrix<double> there = root.asDiagonal() * solver.eigenvectors().transpose() * F.inverse();
  Matrix<double> Theta = point.Theta;
  Theta.bottomRows(order) = (there * Theta.bottomRows(order)).eval();
  Theta.rightCols(order) = (Theta.rightCols(order) * back).eval();
  return Theta;
}

Point descend(const Family& family, Point point, int most, double least_gain) {
  if (family.free_entries() == 0) return point;
  double radius = 1;
  bool has_settled = false;
  for (int step = 0; step < most; ++step) {
    report_progress("Compensator of that order, Newton's method,", step);
    if (step % 8 == 0) {
      const Point again = point_at(family, balanced(family, point));
      if (again.is_stable) point = again;
    }
    const Outcome outcome = moved_down(family, least_gain, radius, point);
    if (outcome == Outcome::stuck || (outcome == Outcome::settled && has_settled)) return point;
    has_settled = outcome == Outcome::settled;
  }
  return point;
}

Continued continued(const Family& family, const Matrix<double>& start) {
  const int most_steps = 300, few_steps = 12, many_steps = 100, most_stages = 60;
  const double settled = 1e-14, rough = 1e-5, fine = 1e-10;
  Continued result;
  result.Theta = start;
  const double unit =
      family.is_continuous ? 1e-3 * std::max(1e-12, family.terms.front().fixed.cwiseAbs().maxCoeff()) : 1e-3;
  double ease = 0;
  Point point = point_at(family, start);
  for (int k = 0; !point.is_stable && k < most_stages; ++k) {
    ease = ease > 0 ? 1.5 * ease : unit;
    point = point_at(eased(family, ease), start);
  }
  result.ease = ease;
  const double least = 1e-9 * unit;  // an ease that shrinks beyond it has 0 as its limit, not as its end
  for (int stage = 0; point.is_stable && ease > least && stage < most_stages; ++stage) {
    const Family easier = eased(family, ease);
    const Point near = descend(easier, point, few_steps, rough);
    const double reached = ease;
    point = less_eased(family, near.Theta, reached, ease);
    if (!point.is_stable) point = less_eased(family, descend(easier, near, many_steps, fine).Theta, reached, ease);
    result.ease = reached;
    result.Theta = near.Theta;
  }
  if (!point.is_stable || ease > 0) return result;
  result.point = descend(family, point, most_steps, settled);
  result.Theta = result.point.Theta;
  result.ease = 0;
  return result;
}

}  // namespace lqg::design::order
