// SPDX-License-Identifier: MIT
#include "controller/gate.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "controller/controller.hpp"
#include "controller/stage_in_force.hpp"
#include "design/rounding.hpp"

namespace lqg::controller {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Wide, because no model is right: a push, a step of a reference or a wrong mass are tens of σ. A spike of this size
// moves x̂ by so many σ of its own error, which the loop takes as it takes its start.
constexpr double default_spike = 300, infinity = std::numeric_limits<double>::infinity();
// From P0 on, and after gaps, so many σ of the variance that is worked off are let in, too: more than any noise, and no
// more of a start than a wide gate has to open for.
constexpr double let_in_while_unsettled = 30;
// An output that is left out 137 times in a row is heard whatever it says: 1.5¹³⁷ is the widest gate, 2⁸⁰. A false
// alarm widens it by 22 % in σ for a few samples.
constexpr double least_widening = 1.5, most_widening = 0x1p20;
constexpr double narrowing_of_online = 0.75;
constexpr double slowest_narrowing = 1 - 0x1p-10, fastest_narrowing = 0.25;
constexpr double negligible = 1.1;  // an S that is larger than in the steady state by less: 5 % in σ
constexpr int longest_gap = 256, longest_settling = 1 << 14;
// Numbers that are emitted are rounded up to few bits: those of the host's mathematics are not everywhere the same.

// The error of the estimate before an update, e⁺ = F e + noise, of the filter with its constant gain.
class PriorError {
 public:
  explicit PriorError(const Controller& controller)
      : share_(std::pow(std::min(1.0, let_in_while_unsettled / controller.gate.sigma), 2)) {
    const design::SampledPlant& plant = plant_at(controller, 0);
    const design::SampledNoise& noise = *noise_at(controller, 0);
    const MatrixXd L = design::to_doubles(controller.filters.back()[0]), G = design::to_doubles(plant.G);
    A_ = design::to_doubles(plant.A), C_ = design::to_doubles(plant.C), V_ = design::to_doubles(noise.V);
    const MatrixXd Lp = A_ * L + design::to_doubles(controller.filters.back()[1]);
    const MatrixXd cross = noise.Swv.size() ? MatrixXd(G * design::to_doubles(noise.Swv) * Lp.transpose())
                                            : MatrixXd::Zero(A_.rows(), A_.rows());
    F_ = A_ - Lp * C_;
    unheard_ = G * design::to_doubles(noise.W) * G.transpose();
    heard_ = unheard_ + Lp * V_ * Lp.transpose() - cross - cross.transpose();
    steady_ = design::to_doubles(controller.filters.back()[2]);
  }

  double slowest_mode() const { return F_.eigenvalues().cwiseAbs().maxCoeff(); }
  MatrixXd without_outputs(const MatrixXd& P) const { return A_ * P * A_.transpose() + unheard_; }

  // From P on, all heard: the least w with w narrow^k ≥ S(k)/S of the steady state, or the share of it that is let in,
  // in each sample k where that matters.
  VectorXd widening_from(MatrixXd P, double narrow) const {
    VectorXd widening = VectorXd::Ones(steady_.size());
    double narrowed = 1;
    for (int k = 0; k < longest_settling; ++k, narrowed *= narrow) {
      const VectorXd ratio = ((C_ * P * C_.transpose() + V_).diagonal().array() / steady_.array() * share_).matrix();
      if (!ratio.allFinite() || (ratio.array() <= negligible).all()) break;
      for (int i = 0; i < ratio.size(); ++i)
        if (ratio(i) > negligible) widening(i) = std::max(widening(i), ratio(i) / narrowed);
      P = F_ * P * F_.transpose() + heard_;
    }
    return widening.cwiseMin(step::widest_gate);
  }

 private:
  double share_;
  MatrixXd A_, C_, V_, F_, unheard_, heard_;
  VectorXd steady_;
};

// The growth of a sample, so that after any number of them without outputs the gate is as wide as it has to be.
VectorXd widening_in_gaps(const PriorError& error, MatrixXd P, double narrow) {
  VectorXd widen;
  for (int k = 1; k <= longest_gap; ++k) {
    P = error.without_outputs(P);
    if ((k & (k - 1)) != 0) continue;  // 1, 2, 4, 8, …
    if (!P.allFinite()) break;
    const VectorXd of_a_sample = error.widening_from(P, narrow).array().pow(1.0 / k).matrix();
    widen = k == 1 ? of_a_sample : VectorXd(widen.cwiseMax(of_a_sample));
  }
  return widen;
}

double next_power_of_two(double value) { return std::exp2(std::ceil(std::log2(value))); }

Gate gate_of_online(double sigma, Eigen::Index ny) {
  return {sigma, VectorXd::Ones(ny), VectorXd::Constant(ny, least_widening),
          VectorXd::Constant(ny, narrowing_of_online)};
}

MatrixXd initial_covariance(const Controller& controller) { return design::to_doubles(controller.solution.start->P0); }

}  // namespace

bool is_default(const design::Estimator& estimator) { return !estimator.spike && estimator.gate == 0; }

double sigma_of(const design::Estimator& estimator) {
  const double gate = estimator.gate > 0 ? estimator.gate : infinity;
  const double sigma = std::min(gate, estimator.spike.value_or(is_default(estimator) ? default_spike : infinity));
  return std::isinf(sigma) ? 0 : sigma;
}

const char* key_of_sigma(const design::Estimator& estimator) {
  return estimator.gate == sigma_of(estimator) ? "kalman.gate" : "kalman.spike";
}

Gate gate_of(const Controller& controller) {
  if (!controller.has.gate) return {};
  if (controller.filter != step::Filter::steady) return gate_of_online(controller.gate.sigma, controller.size.ny);
  const PriorError error(controller);
  const double slowest = error.slowest_mode();
  const double narrow = std::clamp(std::ceil(slowest * slowest * 1024) / 1024, fastest_narrowing, slowest_narrowing);
  const VectorXd start = controller.filters.size() > 1
                             ? VectorXd(VectorXd::Ones(controller.size.ny))  // S of each sample is known
                             : error.widening_from(initial_covariance(controller), narrow);
  const MatrixXd P = design::to_doubles(controller.solution.estimator->P_prior);
  const VectorXd widen = widening_in_gaps(error, P, narrow).cwiseMax(least_widening).cwiseMin(most_widening);
  return {controller.gate.sigma, start.unaryExpr([](double value) { return next_power_of_two(value); }),
          (widen * 4).array().ceil().matrix() / 4, VectorXd::Constant(controller.size.ny, narrow)};
}

}  // namespace lqg::controller
