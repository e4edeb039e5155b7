// SPDX-License-Identifier: MIT
#include "design/order/flat_descent.hpp"

#include "design/numeric/factor.hpp"
#include "design/progress.hpp"

namespace lqg::design::order {

namespace {

// The Hessian with a curvature along the orbit, and its scale.
struct Curvature {
  RealMatrix whole;
  Real scale;
};

Curvature curvature_at(const LoopFamily<Real>& family, const LoopPoint<Real>& point) {
  Curvature result{hessian(family, point), 0};
  result.scale = largest_entry(result.whole);
  const RealMatrix tangents = orbit_tangents(family, point.Theta);
  if (tangents.cols() == 0) return result;
  const RealMatrix along = multiply_transpose(tangents, tangents);
  const Real size = largest_entry(along);
  if (size > 0) result.whole += result.scale / size * along;
  return result;
}

// −(H + shift)⁻¹ g where that is positive definite.
std::optional<RealMatrix> step_with(const Curvature& curvature, const RealMatrix& slope, const Real& shift) {
  const RealMatrix shifted = curvature.whole + shift * identity(curvature.whole.rows());
  if (!positive_definite(shifted)) return std::nullopt;
  return solve(shifted, RealMatrix(-slope));
}

}  // namespace

std::optional<RealMatrix> descend_flat(const LoopFamily<Real>& family, RealMatrix Theta) {
  const Index unknowns = family.size() * (family.size() + 1) / 2;
  const int most_steps = unknowns < 60 ? 200 : 30, most_shifts = 200;  // some seconds
  LoopPoint<Real> point = point_at(family, Theta);
  if (!point.is_stable) return std::nullopt;
  const Real least_shift = negligible(0.8), settled = negligible(0.4);
  Real share = 0;  // of the Hessian's scale, by which it is shifted
  for (int k = 0; k < most_steps; ++k) {
    report_progress("Compensator of that order, where the cost is flat,", k);
    const Curvature curvature = curvature_at(family, point);
    const RealMatrix slope = gradient(family, point);
    const std::optional<RealMatrix> whole = step_with(curvature, slope, 0);
    if (whole && largest_entry(*whole) <= settled * (1 + largest_entry(point.Theta))) return point.Theta;
    bool has_moved = false;
    for (int n = 0; n < most_shifts && !has_moved; ++n) {
      const std::optional<RealMatrix> step = step_with(curvature, slope, share * curvature.scale);
      if (step) {
        LoopPoint<Real> next = point_at(family, RealMatrix(point.Theta + unpacked<Real>(family, *step)));
        has_moved = next.is_stable && next.cost < point.cost;
        if (has_moved) point = std::move(next);
      }
      if (!has_moved) share = share == 0 ? least_shift : Real(share * 3);
      if (share > 1e6) return std::nullopt;
    }
    if (!has_moved) return std::nullopt;
    share = share <= least_shift ? Real(0) : Real(share / 30);
  }
  return std::nullopt;
}

}  // namespace lqg::design::order
