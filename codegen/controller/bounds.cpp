// SPDX-License-Identifier: MIT
#include "controller/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "controller/controller.hpp"
#include "controller/rounding.hpp"
#include "controller/stage_in_force.hpp"
#include "design/numeric/linear_algebra.hpp"

namespace lqg::controller {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What the target's numbers allow: a bound is 2^margin times the scale of what it bounds. A number of that size is
// rounded to 2⁸ times its scale: it no longer tells what the filter knows. b² and ν² have to be numbers, too.
struct Range {
  int margin, largest;
};
constexpr Range range_of_float = {24 + 8, 62}, range_of_double = {53 + 8, 510};
constexpr int step = 8;  // bounds are powers of 2⁸: most states then share one, and are not scaled in the sum

VectorXd deviations(const MatrixXd& covariance) { return covariance.diagonal().cwiseMax(0).cwiseSqrt(); }

// The smallest e with 2^e ≥ value, within the range; the largest for what is not finite.
int exponent_of(double value, const Range& range) {
  if (!std::isfinite(value)) return range.largest;
  return value > 0 ? std::clamp(static_cast<int>(std::ceil(std::log2(value))), 0, range.largest) : 0;
}

int bound_of(double scale, const Range& range) {
  const int exponent = exponent_of(std::ldexp(scale, range.margin), range);
  return std::min((exponent + step - 1) / step * step, range.largest);
}

// The scales of one design: how far things are from what is known, or go in one sample.
class Scales {
 public:
  Scales(const Controller& controller, Range range) : controller_(controller), range_(range) {
    start_ = start();
    inputs_ = inputs();
    states_ = VectorXd::Zero(controller.size.nx);
    for (const std::size_t at : controller.stage_starts) states_ = states_.cwiseMax(states_at(at));
  }

  const VectorXd& states() const { return states_; }

  VectorXd integrals() const {
    VectorXd scales = error_scales() * controller_.problem.plant.sample_time;
    for (const Gains& law : controller_.laws)  // by H, and by H_input as much as a load, or set_input, may need
      for (const design::RealMatrix* H : {&law[2], &law[3]})
        if (H->size() > 0)
          scales = scales.cwiseMax(VectorXd(design::to_doubles(*H).cwiseAbs() * (law_of_states(law) + inputs_)));
    return scales;
  }

  // Of outputs y = C x + D u + v with bounded states.
  VectorXd output_limits(const MatrixXd& C, const MatrixXd& D, const VectorXd& V, const std::vector<int>& x) const {
    const std::vector<double> bounds = powers_of_two(x);
    const VectorXd reach = C.cwiseAbs() * Eigen::Map<const VectorXd>(bounds.data(), C.cols());
    VectorXd others = V.cwiseMax(0).cwiseSqrt() + D.cwiseAbs() * inputs_;
    if (is_extended(controller_)) others = others.cwiseMax(1);
    VectorXd limits(C.rows());
    for (int i = 0; i < limits.size(); ++i)
      limits(i) = std::ldexp(1.0, exponent_of(reach(i) + std::ldexp(others(i), range_.margin), range_));
    return limits;
  }

 private:
  // At the start, and in the steady state: what is not known of x, and what x is taken to be.
  VectorXd start() const {
    VectorXd scales = deviations(
        design::to_doubles(controller_.modal ? controller_.modal->online.P0 : controller_.solution.start->P0));
    scales = scales.cwiseMax(design::to_doubles(kept_start(controller_)).cwiseAbs());
    if (controller_.solution.estimator && controller_.solution.estimator->P_prior.size())
      scales = scales.cwiseMax(deviations(kept_prior()));
    // Where an extended filter goes no matrix tells: at least one of each unit.
    return is_extended(controller_) ? VectorXd(scales.cwiseMax(1)) : scales;
  }

  // The covariance before an update, in the steady state.
  MatrixXd kept_prior() const {
    const design::RealMatrix& P = controller_.solution.estimator->P_prior;
    return design::to_doubles(controller_.modal ? design::congruence(controller_.modal->inverse, P) : P);
  }

  // |K_x| start: what the law asks for.
  VectorXd law_of(const Gains& law, const VectorXd& states) const {
    return design::to_doubles(law[0].leftCols(controller_.size.nx)).cwiseAbs() * states;
  }
  VectorXd law_of_states(const Gains& law) const { return law_of(law, states_); }

  // The limits of an input; without any what the law asks for at the start, and at least one of its unit.
  VectorXd inputs() const {
    VectorXd scales = VectorXd::Ones(controller_.size.nu);
    for (const Gains& law : controller_.laws) scales = scales.cwiseMax(law_of(law, start_));
    const auto& limits = controller_.problem.limits;
    for (int j = 0; limits && j < limits->u_min.size(); ++j) {
      const double limit = std::max(std::abs(limits->u_min(j)), std::abs(limits->u_max(j)));
      if (std::isfinite(limit)) scales(j) = limit;
    }
    return scales;
  }

  // Where the start, the inputs and the noise take the states within nx samples: further samples reach no other state.
  VectorXd states_at(std::size_t sample) const {
    const design::SampledPlant& plant = kept_plant_at(controller_, sample);
    const MatrixXd A = design::to_doubles(plant.A);
    VectorXd drive = design::to_doubles(plant.B).cwiseAbs() * inputs_;
    if (const design::SampledNoise* noise = noise_at(controller_, sample)) {
      const MatrixXd G = design::to_doubles(plant.G);
      drive += deviations(G * design::to_doubles(noise->W) * G.transpose());
    }
    MatrixXd power = MatrixXd::Identity(A.rows(), A.cols());
    VectorXd driven = VectorXd::Zero(A.rows()), scales = start_;
    for (int k = 0; k < A.rows(); ++k) {
      driven += power.cwiseAbs() * drive;
      power = A * power;
      scales = scales.cwiseMax(driven + power.cwiseAbs() * start_);
    }
    return scales;
  }

  // |C| x of the integrated outputs.
  VectorXd error_scales() const {
    const design::RealMatrix& outputs = controller_.modal ? controller_.modal->plant.C : controller_.solution.plant.C;
    const MatrixXd C = design::to_doubles(outputs).cwiseAbs();
    VectorXd scales(controller_.size.nxi);
    for (int i = 0; i < scales.size(); ++i)
      scales(i) = C.row(controller_.integrated[static_cast<std::size_t>(i)]).dot(states_);
    return scales;
  }

  const Controller& controller_;
  Range range_;
  VectorXd start_, inputs_, states_;
};

// What the filter is told of the outputs in a sample: their C and D, and the variances of their noise.
struct Outputs {
  MatrixXd C, D;
  VectorXd V;
};

Outputs outputs_as_they_are(const Controller& controller, std::size_t sample) {
  const design::SampledPlant& plant = kept_plant_at(controller, sample);
  VectorXd V = VectorXd::Zero(plant.C.rows());
  if (const design::SampledNoise* noise = noise_at(controller, sample)) V = design::to_doubles(noise->V).diagonal();
  return {design::to_doubles(plant.C), design::to_doubles(plant.D), V};
}

Outputs outputs_of_filter(const Controller& controller, std::size_t sample) {
  if (!controller.solution.online) return outputs_as_they_are(controller, sample);
  const design::OnlineSolution& online = kept_online_at(controller, sample);
  return {design::to_doubles(online.C), design::to_doubles(online.D), design::to_doubles(online.V)};
}

template <class OutputsAt>
VectorXd largest_limits(const Controller& controller, const Scales& scales, const std::vector<int>& x,
                        OutputsAt outputs_at) {
  VectorXd limits = VectorXd::Zero(controller.size.ny);
  for (const std::size_t at : controller.stage_starts) {
    const Outputs outputs = outputs_at(controller, at);
    limits = limits.cwiseMax(scales.output_limits(outputs.C, outputs.D, outputs.V, x));
  }
  return limits;
}

std::vector<int> bounds_of(const VectorXd& scales, const Range& range) {
  std::vector<int> bounds;
  for (const double scale : scales) bounds.push_back(bound_of(scale, range));
  return bounds;
}

}  // namespace

Bounds bounds_of(const Controller& controller) {
  Bounds bounds;
  if (!controller.has.filter) return bounds;
  const Range range = controller.target.is_double ? range_of_double : range_of_float;
  const Scales scales(controller, range);
  bounds.x = bounds_of(scales.states(), range);
  bounds.innovation = largest_limits(controller, scales, bounds.x, outputs_of_filter);
  if (!controller.size.nxi) return bounds;
  bounds.xi = bounds_of(scales.integrals(), range);
  const VectorXd limits = largest_limits(controller, scales, bounds.x, outputs_as_they_are);
  bounds.error.resize(controller.size.nxi);
  for (int i = 0; i < controller.size.nxi; ++i)
    bounds.error(i) = limits(controller.integrated[static_cast<std::size_t>(i)]);
  return bounds;
}

bool has_finite_law(const Controller& controller) {
  if (controller.bounds.x.empty() || controller.size.nxi || controller.has.input_change) return false;
  if (controller.target.is_fused) return false;  // its proof does not rely on fma()
  const double largest = controller.target.is_double ? std::numeric_limits<double>::max()
                                                     : static_cast<double>(std::numeric_limits<float>::max());
  constexpr double for_rounding = 0.5;  // of the sums on their way
  const std::vector<double> bounds = powers_of_two(controller.bounds.x);
  const VectorXd b = Eigen::Map<const VectorXd>(bounds.data(), controller.size.nx);
  if ((design::to_doubles(kept_start(controller)).cwiseAbs().array() >= b.array()).any()) return false;
  for (const Gains& law : controller.laws) {
    VectorXd reach = design::to_doubles(law[0]).cwiseAbs() * b / largest;
    if (law[1].size()) reach += design::to_doubles(law[1]).cwiseAbs().rowwise().sum();
    if (!(reach.array() < for_rounding).all()) return false;
  }
  return true;
}

std::vector<double> powers_of_two(const std::vector<int>& exponents) {
  std::vector<double> powers;
  for (const int exponent : exponents) powers.push_back(std::ldexp(1.0, exponent));
  return powers;
}

}  // namespace lqg::controller
