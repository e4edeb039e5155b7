// SPDX-License-Identifier: MIT
#include "controller/gains.hpp"

#include <algorithm>
#include <limits>

#include "controller/rounding.hpp"
#include "controller/stage_in_force.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/sampled/reference.hpp"

namespace lqg::controller {

namespace {

using design::Real;
using design::RealMatrix;

constexpr unsigned least_digits = 100;

bool is_same(const Real& a, const Real& b, bool is_double) {
  return rounded_to_target(a, is_double) == rounded_to_target(b, is_double);
}

bool is_same(const Gains& a, const Gains& b, bool is_double) {
  for (std::size_t k = 0; k < a.size(); ++k)
    for (Eigen::Index i = 0; i < a[k].size(); ++i)
      if (!is_same(a[k].data()[i], b[k].data()[i], is_double)) return false;
  return true;
}

void cut_off_what_is_held(std::vector<Gains>& rows, bool is_double) {
  while (rows.size() > 1 && is_same(rows[rows.size() - 2], rows.back(), is_double)) rows.pop_back();
}

// H_input = −Kξ⁺ = −(KξᵀKξ + ε)⁻¹Kξᵀ, ε → 0: of all δξ that bring −Kξ δξ as near as possible to u − v the smallest is
// H_input (u − v). 10⁻⁴⁰ is nothing beside a singular value that matters, and all beside one that is rounding.
RealMatrix conditioning(const Controller& controller, const RealMatrix& K) {
  const RealMatrix Kxi = K.middleCols(controller.size.nx, controller.size.nxi);
  RealMatrix gram = design::transpose_multiply(Kxi, Kxi);
  const Real largest = gram.size() ? design::largest_entry(gram) : Real(0);
  if (largest == 0) return RealMatrix::Zero(Kxi.cols(), Kxi.rows());
  gram += design::power_of_ten(-40) * largest * design::identity(gram.rows());
  return -*design::solve(gram, Kxi.transpose());
}

// Nbar of this K: with gains that change it changes, too.
RealMatrix feed_forward(const Controller& controller, const RealMatrix& K) {
  const design::RegulatorSolution& regulator = *controller.solution.regulator;
  if (regulator.Nbar.size() == 0 || regulator.K_schedule.empty()) return regulator.Nbar;
  return design::feed_forward(controller.problem, K, regulator.Gamma, {regulator.Nx, regulator.Nu});
}

// C L = I − V S⁻¹ of an optimal gain, hence S = (I − C L)⁻¹ V; infinite where V is nothing beside S in all digits.
RealMatrix innovation_variances(const Controller& controller, const RealMatrix& L, std::size_t sample) {
  const RealMatrix& C = plant_at(controller, sample).C;
  const RealMatrix left = design::identity(C.rows()) - design::multiply(C, L);
  const auto variances = design::solve(left, noise_at(controller, sample)->V);
  if (!variances) return RealMatrix::Constant(C.rows(), 1, Real(std::numeric_limits<double>::infinity()));
  return variances->diagonal();
}

}  // namespace

std::vector<Gains> law_gains(const Controller& controller) {
  if (!controller.has.regulator) return {};
  const design::Digits digits(std::max(controller.solution.numerics.digits, least_digits));
  const design::RegulatorSolution& regulator = *controller.solution.regulator;
  std::vector<Gains> rows;
  const auto add = [&](const RealMatrix& K) {
    const RealMatrix H_input = conditioning(controller, K);
    rows.push_back({K, feed_forward(controller, K), regulator.H.size() > 0 ? regulator.H : H_input, H_input});
  };
  for (const RealMatrix& K : regulator.K_schedule) add(K);
  add(regulator.K);
  cut_off_what_is_held(rows, controller.target.is_double);
  return rows;
}

std::vector<Gains> filter_gains(const Controller& controller) {
  if (controller.filter != step::Filter::steady) return {};
  const design::Digits digits(std::max(controller.solution.numerics.digits, least_digits));
  const design::EstimatorSolution& estimator = *controller.solution.estimator;
  std::vector<Gains> rows;
  for (std::size_t k = 0; k < estimator.L_schedule.size(); ++k) {
    rows.push_back({estimator.L_schedule[k], k < estimator.M_schedule.size() ? estimator.M_schedule[k] : estimator.M});
    if (controller.has.gate) rows.back().push_back(innovation_variances(controller, estimator.L_schedule[k], k));
  }
  rows.push_back({estimator.L, estimator.M});
  if (controller.has.gate) rows.back().emplace_back(estimator.S.diagonal());
  cut_off_what_is_held(rows, controller.target.is_double);
  return rows;
}

std::vector<Place> changing_places(const std::vector<Gains>& rows, bool is_double) {
  std::vector<Place> places;
  for (std::size_t k = 0; !rows.empty() && k < rows.front().size(); ++k)
    for (int i = 0; i < rows.front()[k].rows(); ++i)
      for (int j = 0; j < rows.front()[k].cols(); ++j)
        if (std::any_of(rows.begin(), rows.end(),
                        [&](const Gains& row) { return !is_same(row[k](i, j), rows.front()[k](i, j), is_double); }))
          places.push_back({k, i, j});
  return places;
}

}  // namespace lqg::controller
