// SPDX-License-Identifier: MIT
#include "design/motion/equilibrium.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <limits>

#include "design/motion/derivative.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

// Residuals in units of their sizes, and their slopes over the unknown numbers.
struct Scaled {
  RealMatrix residual;  // n × 1
  RealMatrix slopes;
  Real squares;
};

std::optional<Scaled> scaled_at(const Rest& rest, const RealVector& point, const RealVector& sizes,
                                const std::vector<Index>& unknown) {
  const std::optional<Rest::At> at = rest.at(point);
  if (!at) return std::nullopt;
  Scaled scaled = {RealMatrix(at->value.size(), 1), zeros(at->value.size(), static_cast<Index>(unknown.size())),
                   Real(0)};
  for (Index i = 0; i < at->value.size(); ++i) {
    scaled.residual(i, 0) = at->value(i) / sizes(i);
    scaled.squares += scaled.residual(i, 0) * scaled.residual(i, 0);
    for (std::size_t j = 0; j < unknown.size(); ++j)
      scaled.slopes(i, static_cast<Index>(j)) = at->slopes(i, unknown[j]) / sizes(i);
  }
  return scaled;
}

// (JᵀJ + λ diag(JᵀJ)) step = −Jᵀ r; what moves nothing is not moved.
std::optional<RealMatrix> step_of(const Scaled& scaled, const Real& damping) {
  RealMatrix normal = transpose_multiply(scaled.slopes, scaled.slopes);
  for (Index i = 0; i < normal.rows(); ++i)
    normal(i, i) = normal(i, i).is_zero() ? Real(1) : Real(normal(i, i) * (1 + damping));
  std::optional<RealMatrix> step = solve(normal, transpose_multiply(scaled.slopes, scaled.residual));
  if (step) *step = -*step;
  return step;
}

RealVector moved(RealVector point, const RealMatrix& step, const std::vector<Index>& unknown) {
  for (std::size_t j = 0; j < unknown.size(); ++j) point(unknown[j]) += step(static_cast<Index>(j), 0);
  return point;
}

}  // namespace

std::optional<Rest::At> Rest::at(const RealVector& point) const {
  const Index count = static_cast<Index>(states_.size());
  At result = {RealVector(count), zeros(count, point.size())};
  for (Index i = 0; i < count; ++i) {
    const Index state = states_[static_cast<std::size_t>(i)];
    const auto found = slope_of(*plant_.equations->f[static_cast<std::size_t>(state)], point, Kinks::take_a_side);
    const Slope* slope = std::get_if<Slope>(&found);
    if (slope == nullptr) return std::nullopt;
    result.value(i) = slope->value;
    for (Index j = 0; j < point.size(); ++j) result.slopes(i, j) = slope->slope(j);
    if (plant_.domain == Domain::continuous) continue;
    result.value(i) -= point(state);
    result.slopes(i, state) -= 1;
  }
  return result;
}

RealVector Rest::sizes(const RealVector& point) const {
  RealVector result(static_cast<Index>(states_.size()));
  for (Index i = 0; i < result.size(); ++i) {
    const Index state = states_[static_cast<std::size_t>(i)];
    result(i) = size_of_terms(*plant_.equations->f[static_cast<std::size_t>(state)], point);
    if (plant_.domain == Domain::discrete) result(i) += abs(point(state));
    if (result(i).is_zero()) result(i) = 1;
  }
  return result;
}

std::optional<RealVector> descended(const Rest& rest, RealVector point, const std::vector<Index>& unknown) {
  constexpr int most_descents = 150;
  const Real nothing = negligible(1.6), small_step = negligible(0.8);
  Real damping = 1e-3;
  if (!rest.at(point)) return std::nullopt;
  for (int k = 0; k < most_descents; ++k) {
    const RealVector sizes = rest.sizes(point);
    const std::optional<Scaled> here = scaled_at(rest, point, sizes, unknown);
    if (!here || here->squares < nothing) return point;
    bool has_moved = false;
    while (!has_moved && damping < 1e20) {
      const std::optional<RealMatrix> step = step_of(*here, damping);
      if (!step) return point;
      const RealVector next = moved(point, *step, unknown);
      const std::optional<Scaled> there = scaled_at(rest, next, sizes, unknown);
      has_moved = there && there->squares < here->squares;
      damping = has_moved ? Real(damping / 30) : Real(damping * 10);
      if (!has_moved) continue;
      const bool is_done = largest_entry(next - point) <= small_step * largest_entry(next);
      point = next;
      if (is_done) return point;
    }
    if (!has_moved) return point;
  }
  return point;
}

std::optional<RealVector> polished(const Rest& rest, RealVector point, const std::vector<Index>& unknown) {
  constexpr int most_corrections = 60;
  const RealVector sizes = rest.sizes(point);
  for (int k = 0; k < most_corrections; ++k) {
    const std::optional<Scaled> here = scaled_at(rest, point, sizes, unknown);
    const std::optional<RealMatrix> step = here ? step_of(*here, Real(0)) : std::nullopt;
    if (!step) return std::nullopt;
    point = moved(point, *step, unknown);
    if (largest_entry(*step) <= negligible(0.9) * largest_entry(point)) return point;
  }
  return std::nullopt;
}

bool is_at_rest(const Rest& rest, const RealVector& point) {
  const std::optional<Rest::At> at = rest.at(point);
  if (!at) return false;
  const RealVector sizes = rest.sizes(point);
  const double rounding = 4 * std::numeric_limits<double>::epsilon();
  for (Index i = 0; i < sizes.size(); ++i)
    if (abs(at->value(i)) > rounding * sizes(i)) return false;
  return true;
}

std::vector<Index> undetermined(const Rest& rest, const RealVector& point, const std::vector<Index>& unknown) {
  const std::optional<Scaled> here = scaled_at(rest, point, rest.sizes(point), unknown);
  if (!here || unknown.empty()) return {};
  std::vector<Index> result;
  RealMatrix slopes =
      padded(here->slopes, std::max<Index>(here->slopes.rows(), here->slopes.cols()), here->slopes.cols());
  for (Index j = 0; j < slopes.cols(); ++j)
    if (const Real largest = largest_entry(slopes.col(j)); !largest.is_zero()) slopes.col(j) /= largest;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(to_doubles(slopes), Eigen::ComputeFullV);
  const double least = 1e-9 * std::max(1.0, svd.singularValues()(0));
  for (Index k = 0; k < svd.singularValues().size(); ++k)
    for (Index j = 0; j < slopes.cols() && svd.singularValues()(k) <= least; ++j)
      if (std::abs(svd.matrixV()(j, k)) > 1e-3) result.push_back(unknown[static_cast<std::size_t>(j)]);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

}  // namespace lqg::design
