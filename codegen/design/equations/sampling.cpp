// SPDX-License-Identifier: MIT
#include "design/equations/sampling.hpp"

#include <algorithm>
#include <cmath>

#include "design/progress.hpp"

namespace lqg::design {

namespace {

// F = [A B; 0 0]:  ż = F z.
RealMatrix extended(const HeldPlant& plant) {
  const Index nz = plant.A.rows() + plant.B.cols();
  RealMatrix F = zeros(nz, nz);
  F.topLeftCorner(plant.A.rows(), plant.A.cols()) = plant.A;
  F.topRightCorner(plant.B.rows(), plant.B.cols()) = plant.B;
  return F;
}

// The length of the longest of all shortest paths i → j over the nonzero entries of F: powers of F up to this
// one can bring an entry that is zero in all lower ones.
Index longest_reach(const RealMatrix& F) {
  const Index n = F.rows();
  Index longest = 1;
  for (Index start = 0; start < n; ++start) {
    std::vector<Index> distance(static_cast<std::size_t>(n), -1), queue = {start};
    distance[static_cast<std::size_t>(start)] = 0;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const Index i = queue[head];
      longest = std::max(longest, distance[static_cast<std::size_t>(i)]);
      for (Index j = 0; j < n; ++j)
        if (!F(i, j).is_zero() && distance[static_cast<std::size_t>(j)] < 0) {
          distance[static_cast<std::size_t>(j)] = distance[static_cast<std::size_t>(i)] + 1;
          queue.push_back(j);
        }
    }
  }
  return longest;
}

// The least count with (norm)^count / count! below the rounding.
Index orders_until_negligible(const Real& norm) {
  Real term = 1;
  Index count = 0;
  for (const Real rounding = negligible(1) / 1000; term > rounding; term *= norm / count) ++count;
  return count;
}

// Adds `term` to `sum`; true when it changed an entry.
bool add_and_tell(RealMatrix& sum, const RealMatrix& term, const Real& rounding) {
  bool changed = false;
  for (Index i = 0; i < sum.size(); ++i) {
    const Real& part = term.data()[i];
    if (part.is_zero()) continue;
    Real& whole = sum.data()[i];
    changed = changed || abs(part) > rounding * abs(whole);
    whole += part;
  }
  return changed;
}

// Everything that is doubled: Φ(t) = e^(Ft), M(t) = ∫ΦᵀQΦ, W(t) = ∫e^(Aτ) W e^(Aᵀτ), q(t) = ∫tr(Q_xx W).
struct Period {
  RealMatrix transition, cost, noise;
  Real noise_cost;
};

// The Taylor series of all four at time h. Each order follows from the one before:
// Φ' = FΦ,  M' = FᵀM + MF,  W' = AW + WAᵀ,  q' = tr(Q_xx W).
Period short_period(const HeldPlant& plant, const RealMatrix& F, const Real& h) {
  const Index nx = plant.A.rows();
  const bool has_cost = plant.cost.size() > 0, has_noise = plant.noise.size() > 0;
  RealMatrix transition = h * F;
  RealMatrix cost = h * plant.cost, noise = h * plant.noise;
  Period sum = {identity(F.rows()) + transition, cost, noise, Real(0)};
  const Real rounding = negligible(1) / 1000;
  const Index least = 2 * longest_reach(F) + orders_until_negligible(2 * h * norm(plant.A));
  const Index most = 8 * least + 100;  // an entry that cancels to nothing but rounding never settles
  const RealMatrix cost_xx = has_cost && has_noise ? RealMatrix(plant.cost.topLeftCorner(nx, nx)) : RealMatrix();
  for (Index order = 2; order <= most; ++order) {
    const Real step = h / order;
    if (has_cost && has_noise) sum.noise_cost += step * trace_of_product(cost_xx, noise);
    transition = step * multiply(F, transition);
    bool changed = add_and_tell(sum.transition, transition, rounding);
    if (has_cost) {
      const RealMatrix half = multiply(cost, F);
      cost = step * (half + half.transpose());
      changed = add_and_tell(sum.cost, cost, rounding) || changed;
    }
    if (has_noise) {
      const RealMatrix half = multiply(plant.A, noise);
      noise = step * (half + half.transpose());
      changed = add_and_tell(sum.noise, noise, rounding) || changed;
    }
    if (order >= least && !changed) break;
  }
  return sum;
}

// From t to 2t:  q ← 2q + tr(M_xx W),  M ← M + ΦᵀMΦ,  W ← ΦWΦᵀ + W,  Φ ← Φ².
void double_period(Period& period, Index nx) {
  const RealMatrix phi = period.transition.topLeftCorner(nx, nx);
  if (period.cost.size() > 0) {
    if (period.noise.size() > 0)
      period.noise_cost = 2 * period.noise_cost + trace_of_product(period.cost.topLeftCorner(nx, nx), period.noise);
    period.cost += transpose_congruence(period.transition, period.cost);
  }
  if (period.noise.size() > 0) period.noise += congruence(phi, period.noise);
  period.transition = multiply(period.transition, period.transition);
}

}  // namespace

SampledPeriod sample(const HeldPlant& plant, const Real& sample_time) {
  const Index nx = plant.A.rows(), held = plant.B.cols();
  const RealMatrix F = extended(plant);
  // ‖A‖ h ≤ 1/1024: a doubling less costs more than the orders it saves.
  const Real size = norm(plant.A) * sample_time * 1024;
  int doublings = 0;
  for (Real reach = 1; reach < size; reach *= 2) ++doublings;
  const Real h = ldexp(sample_time, -doublings);
  Period period = short_period(plant, F, h);
  for (int i = 0; i < doublings; ++i) {
    report_progress("sampling", i, doublings);
    double_period(period, nx);
  }
  return {period.transition.topLeftCorner(nx, nx), period.transition.topRightCorner(nx, held), period.cost,
          period.noise_cost, period.noise};
}

SampledPeriod followed_by(const SampledPeriod& first, const SampledPeriod& second) {
  const Index nx = first.A.rows(), held = first.B.cols();
  SampledPeriod both = {multiply(second.A, first.A), multiply(second.A, first.B) + second.B, RealMatrix(),
                        first.noise_cost + second.noise_cost, RealMatrix()};
  if (first.noise.size() > 0) both.noise = congruence(second.A, first.noise) + second.noise;
  if (first.cost.size() == 0) return both;
  const RealMatrix moves = above(beside(first.A, first.B), beside(zeros(held, nx), identity(held)));
  both.cost = first.cost + transpose_congruence(moves, second.cost);
  if (first.noise.size() > 0) both.noise_cost += trace_of_product(second.cost.topLeftCorner(nx, nx), first.noise);
  return both;
}

}  // namespace lqg::design
