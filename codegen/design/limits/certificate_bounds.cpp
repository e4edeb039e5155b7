// SPDX-License-Identifier: MIT
// How far the target's numbers may be from the exact ones, on a path of the solver.
#include "design/limits/certificate_search.hpp"

namespace lqg::design::certificate {

void Search::add_row(int i, const VectorXd& centre, const VectorXd& half_width) {
  const Index nu = numbers_.law.rows(), nx = numbers_.law.cols();
  const VectorXd row = i < nu ? numbers_.law.row(i) : numbers_.F.row(i - nu);
  Affine f = constant(row.dot(centre.head(nx)), centre.size());
  f.slope.head(nx) = row.cwiseProduct(half_width.head(nx));
  const double sum = row.cwiseAbs().dot((centre.head(nx).cwiseAbs() + half_width.head(nx)));
  f.radius = static_cast<double>(nx + 2) * ((target_.unit + double_unit) * sum + target_.smallest);
  f_.push_back(f);
  low_.push_back(constant(numbers_.low(i), centre.size()));
  high_.push_back(constant(numbers_.high(i), centre.size()));
  if (i >= numbers_.u_step.size()) return;
  const double step = numbers_.u_step(i);
  low_.back() = narrowed(i, numbers_.low(i), numbers_.high(i), -step, centre, half_width);
  high_.back() = narrowed(i, numbers_.high(i), numbers_.low(i), step, centre, half_width);
}

// u[k−1] + step where it is between both limits; the box is one in which it is on one side of each.
Affine Search::narrowed(int i, double limit, double other, double step, const VectorXd& centre,
                        const VectorXd& half_width) const {
  const Index at = numbers_.law.cols() + i;
  const double moved = centre(at) + step;
  if (step < 0 ? moved <= limit : moved >= limit) return constant(limit, centre.size());
  if (step < 0 ? moved >= other : moved <= other) return constant(other, centre.size());
  Affine result = constant(moved, centre.size());
  result.slope(at) = half_width(at);
  result.radius =
      2 * ((target_.unit + double_unit) * (std::abs(centre(at)) + half_width(at) + std::abs(step)) + target_.smallest);
  return result;
}

std::optional<Multipliers> Search::multipliers(const ActiveRows& active) const {
  const int n = active.length();
  const MatrixXd& inverse = active.inverse();
  std::vector<Affine> right;
  Multipliers result;
  result.largest = result.residual = VectorXd::Zero(n);
  for (int k = 0; k < n; ++k) {
    const std::size_t row = static_cast<std::size_t>(active.row(k));
    Affine distance = active.sign(k) > 0 ? low_[row] : high_[row];
    distance.radius += f_[row].radius;
    add(distance, -1, f_[row]);
    result.residual(k) = distance.radius + target_.unit * largest(distance) + target_.smallest +
                         2 * double_unit * (size(distance) + 2 * size(f_[row]));
    right.push_back(distance);
  }
  for (int k = 0; k < n; ++k) {
    Affine m = constant(0, centre_.size());
    for (int l = 0; l < n; ++l) add(m, inverse(k, l), right[static_cast<std::size_t>(l)]);
    result.largest(k) = largest(m);
    result.m.push_back(m);
  }
  for (int k = 0; k < n; ++k) {
    Affine missed = constant(0, centre_.size());
    double sum = size(right[static_cast<std::size_t>(k)]);
    add(missed, -1, right[static_cast<std::size_t>(k)]);
    for (int l = 0; l < n; ++l) {
      const Affine& m = result.m[static_cast<std::size_t>(l)];
      const double g = numbers_.G(active.row(k), active.row(l));
      add(missed, g, m);
      sum += std::abs(g) * size(m);
    }
    result.residual(k) += largest(missed) + (n + 3) * double_unit * sum;
  }
  const MatrixXd sensitivity = inverse.cwiseAbs() + active.inverse_error();
  const VectorXd first = sensitivity * (result.residual + active.residual() * result.largest);
  const VectorXd feedback = sensitivity * (active.residual() * (2 * first).eval());
  if (!((feedback - first).array() <= 0).all()) return {};
  const VectorXd radius = 1.01 * (first + feedback);
  result.largest += radius;
  result.residual = 1.01 * (result.residual + active.residual() * result.largest);
  for (int k = 0; k < n; ++k) result.m[static_cast<std::size_t>(k)].radius = radius(k);
  return result;
}

std::vector<Violation> Search::violations(const ActiveRows& active, const Multipliers& known) const {
  std::vector<Violation> result;
  const int n = active.length();
  for (int i = 0; i < rows_; ++i) {
    const std::size_t at = static_cast<std::size_t>(i);
    if (sides_[at] != LimitSide::none) continue;
    Affine z = f_[at];
    double sum = largest(z), sum_here = size(z);
    for (int k = 0; k < n; ++k) {
      const double g = numbers_.G(i, active.row(k));
      const Affine& m = known.m[static_cast<std::size_t>(k)];
      add(z, g, m);
      sum += std::abs(g) * known.largest(k);
      sum_here += std::abs(g) * size(m);
    }
    z.radius += (n + 2) * (target_.unit * sum + double_unit * sum_here + target_.smallest);
    for (int l = 0; l < n; ++l) {
      double rate = 0, error = 0;
      for (int k = 0; k < n; ++k) {
        const double g = numbers_.G(i, active.row(k));
        rate += g * active.inverse()(k, l);
        error += std::abs(g) * (active.inverse_error()(k, l) + 0x1p-50 * std::abs(active.inverse()(k, l)));
      }
      z.radius += (std::abs(rate) + error) * known.residual(l);
    }
    const double left_out = 1.001 * std::max(numbers_.tolerance(i), target_.violation * largest(f_[at]));
    for (const LimitSide side : {LimitSide::low, LimitSide::high}) {
      Affine violation = side == LimitSide::low ? low_[at] : high_[at];
      if (!std::isfinite(violation.middle)) continue;
      violation.radius += z.radius;
      add(violation, -1, z);
      if (side == LimitSide::high) violation = {-violation.middle, -violation.slope, violation.radius};
      violation.radius += 2 * (target_.unit * largest(violation) + double_unit * (size(violation) + size(z)));
      result.push_back({i, side, violation, left_out});
    }
  }
  return result;
}

Ratios Search::ratios(const Approach& way, const Multipliers& next) const {
  const ActiveRows& active = way.active;
  const int last = active.length() - 1;
  const MatrixXd &inverse = active.inverse(), &error = active.inverse_error();
  const double own = inverse(last, last), length = 8 * target_.unit * next.largest(last);
  Ratios result;
  for (int k = 0; k < last; ++k) {
    const double sign = active.sign(k) * active.sign(last), ratio = -sign * inverse(k, last) / own;
    const double rate_error =
        (error(k, last) + std::abs(ratio) * error(last, last)) / (own - error(last, last)) + 0x1p-50 * std::abs(ratio);
    const double slowest = ratio - rate_error;
    const Affine& m = next.m[static_cast<std::size_t>(k)];
    Affine position{active.sign(k) * m.middle / ratio, active.sign(k) * m.slope / ratio, 0};
    position.radius = (m.radius + next.largest(k) * rate_error / ratio) / slowest + 4 * double_unit * size(position);
    result.margin.push_back(slowest > 0 ? position.radius + length + 5 * std::max(way.deviation(k), m.radius) / slowest
                                        : std::numeric_limits<double>::infinity());
    result.rate.push_back(ratio);
    result.rate_error.push_back(rate_error);
    result.position.push_back(position);
  }
  return result;
}

// By how much the last multiplier may go beyond its end.
double Search::overshoot(const Approach& way, const Multipliers& next) const {
  const int last = way.active.length() - 1;
  return next.m.back().radius + 8 * target_.unit * std::max(way.largest(last), next.largest(last));
}

// Whether the cost of the dual is certainly larger than before the last row came: violation²/G_ii at least, twice, less
// what rounding takes.
bool Search::rises(const Approach& way, const Multipliers& next) const {
  const int last = way.active.length() - 1;
  const double far = overshoot(way, next),
               own = way.active.inverse()(last, last) - way.active.inverse_error()(last, last);
  const double lost = way.lost + far * far / own;
  return way.violation > 0 &&
         way.violation * way.violation > 1.01 * numbers_.G(way.active.row(last), way.active.row(last)) * lost;
}

// A multiplier that grows, from 0 at least: after the first step it is certainly not beyond 0.
bool Search::cannot_leave(const Approach& way, int k, const Multipliers& next, const Ratios& ratios) const {
  const int last = way.active.length() - 1;
  const std::size_t at = static_cast<std::size_t>(k);
  const double growth = -(ratios.rate[at] + ratios.rate_error[at]);
  return way.is_first && growth > 0 &&
         way.violation * (way.active.inverse()(last, last) - way.active.inverse_error()(last, last)) * growth >
             1.01 * (next.m[at].radius + way.deviation(k));
}

// On the way without row k. Empty where rounding has no bound.
std::optional<Approach> Search::without(const Approach& way, int k, const Multipliers& next,
                                        const Ratios& ratios) const {
  const int last = way.active.length() - 1;
  const MatrixXd &inverse = way.active.inverse(), &error = way.active.inverse_error();
  const double rounding = 8 * target_.unit, own = inverse(last, last) - error(last, last);
  VectorXd deviation(last), share(last);
  const VectorXd largest = way.largest.cwiseMax(next.largest);
  for (int j = 0; j < last; ++j) {
    const std::size_t at = static_cast<std::size_t>(j);
    const double rate = std::abs(ratios.rate[at]) + ratios.rate_error[at];
    deviation(j) = std::max(way.deviation(j), next.m[at].radius + rate * next.m.back().radius) +
                   rounding * (largest(j) + rate * largest(last));
    // Of the inverse of G of the rows before the last.
    const double product =
        (std::abs(inverse(j, last)) + error(j, last)) * (std::abs(inverse(last, k)) + error(last, k));
    const double exact = inverse(j, k) - inverse(j, last) * inverse(last, k) / inverse(last, last);
    const double missed = error(j, k) + 0x1p-50 * std::abs(inverse(j, k)) +
                          (product - std::abs(inverse(j, last) * inverse(last, k))) / own +
                          product * (error(last, last) / own + 0x1p-50) / own;
    share(j) = j == k ? exact - missed : std::abs(exact) + missed;
  }
  if (!(share(k) > 0)) return {};
  const double its = (deviation(k) + rounding * largest(k)) / share(k);
  Approach after = way;
  after.is_first = false;
  const double schur = 1 / (inverse(last, last) - error(last, last));
  const double far = overshoot(way, next);
  const double missed_k = deviation(k) + rounding * largest(k);
  after.lost += 1.01 * (missed_k * missed_k / share(k) + schur * far * far);
  after.violation -=
      1.01 * missed_k *
      (std::abs(ratios.rate[static_cast<std::size_t>(k)]) + ratios.rate_error[static_cast<std::size_t>(k)]) / share(k);
  after.deviation.resize(last - 1);
  after.largest.resize(last);
  for (int j = 0, to = 0; j <= last; ++j) {
    if (j == k) continue;
    after.largest(to) = largest(j);
    if (j < last) after.deviation(to) = deviation(j) + share(j) * its;
    ++to;
  }
  after.active.drop(k);
  return after;
}

}  // namespace lqg::design::certificate
