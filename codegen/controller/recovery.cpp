// SPDX-License-Identifier: MIT
#include "controller/recovery.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "controller/controller.hpp"
#include "controller/stage_in_force.hpp"
#include "design/loop/compensator.hpp"
#include "design/numeric/modes.hpp"
#include "design/rounding.hpp"
#include "design/sampled/added_states.hpp"

namespace lqg::controller {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr unsigned digits = 50;
constexpr int longest_recovery_exponent = 24;  // 2²⁴ samples: what dies out more slowly is called lasting
constexpr int settling_samples = 4096;         // of a Riccati recursion whose fixed point nobody has asked for

// A bound is 2³² to 2⁴⁰ times the scale of its state, in double 2⁶¹ to 2⁶⁹ times: a 2⁻¹²th of the scale, or less.
constexpr int bound_to_negligible_of_float = 52, bound_to_negligible_of_double = 81;
// What z of a linear form can be: any number.
constexpr int largest_exponent_of_float = 128, largest_exponent_of_double = 1000;

// ---- how long a linear recursion takes -----------------------------------------------------------------------------

// Rows whose target is infinite are not asked.
bool is_within(const MatrixXd& power, const VectorXd& start, const VectorXd& target) {
  const VectorXd reached = power.cwiseAbs() * start;
  for (Index i = 0; i < reached.size(); ++i)
    if (!(reached(i) <= target(i)) && std::isfinite(target(i))) return false;
  return true;
}

// The least n with |Mⁿ| start ≤ target, by squaring M and then by bisection; empty where there is none.
std::optional<long> samples_until(const MatrixXd& M, const VectorXd& start, const VectorXd& target) {
  std::vector<MatrixXd> squares = {M};  // M^(2^j)
  while (!is_within(squares.back(), start, target)) {
    if (static_cast<int>(squares.size()) > longest_recovery_exponent || !squares.back().allFinite())
      return std::nullopt;
    MatrixXd square = squares.back() * squares.back();
    squares.push_back(std::move(square));
  }
  long outside = 0;
  MatrixXd power = MatrixXd::Identity(M.rows(), M.cols());
  for (std::size_t j = squares.size() - 1; j-- > 0;) {
    const MatrixXd further = power * squares[j];
    if (is_within(further, start, target)) continue;
    power = further;
    outside += 1L << j;
  }
  return outside + 1;
}

long rounded_up_to_two_digits(long samples) {
  long unit = 1;
  while (samples > 100 * unit) unit *= 10;
  return (samples + unit - 1) / unit * unit;
}

// ---- the states that no noise reaches ------------------------------------------------------------------------------

// Modes of the plant itself: inputs on their way die out.
std::vector<int> lasting_states(const Controller& controller) {
  const design::SampledNoise* noise = noise_at(controller, controller.last_sample);
  if (!noise || !controller.solution.online) return {};
  const design::Digits in_force(digits);
  const design::OnlineSolution& online = online_at(controller, controller.last_sample);
  const Index own = controller.size.nx - controller.size.delayed;
  const design::RealMatrix A = design::in_present_digits(online.A_free.topLeftCorner(own, own));
  const design::RealMatrix W = design::in_present_digits(online.W.topLeftCorner(own, own));
  std::vector<int> found;
  for (const design::Mode& mode : design::unreached_sampled_modes(A, W).modes)
    if (design::on_or_outside_circle(mode.value))
      for (const Index state : mode.states) found.push_back(static_cast<int>(state));
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

// ---- the recursions ------------------------------------------------------------------------------------------------

// The states as far as what the filter keeps is at its bounds, times 2^exponent.
VectorXd states_at_bounds(const Controller& controller, int exponent) {
  VectorXd far(controller.size.nx);
  for (int i = 0; i < far.size(); ++i)
    far(i) = std::ldexp(1.0, controller.bounds.x[static_cast<std::size_t>(i)] + exponent);
  return controller.modal ? VectorXd(design::to_doubles(controller.modal->T).cwiseAbs() * far) : far;
}

// What is unknown of a state in the long run, and what is rounding beside its scale.
VectorXd standard_deviations(const Controller& controller, const MatrixXd& P) {
  VectorXd within = states_at_bounds(
      controller, controller.target.is_double ? -bound_to_negligible_of_double : -bound_to_negligible_of_float);
  for (int i = 0; P.size() && i < within.size(); ++i)
    within(i) = std::max(within(i), std::sqrt(std::max(P(i, i), 0.0)));
  return within;
}

// The steady state of the filter: its error e⁺ = F e before an update, and its covariance where there is one.
struct Steady {
  MatrixXd F, P;
};

// P⁺ = A_free (P − P Cᵀ S⁻¹ C P) A_freeᵀ + W from P0 on, one output after the other, without the lasting states.
Steady steady_of_online(const Controller& controller, const std::vector<int>& lasting) {
  const design::OnlineSolution& online = online_at(controller, controller.last_sample);
  MatrixXd A = design::to_doubles(online.A_free), P = design::to_doubles(online.P0), C = design::to_doubles(online.C);
  const MatrixXd W = design::to_doubles(online.W);
  const VectorXd V = design::to_doubles(online.V);
  for (const int i : lasting) A.row(i).setZero(), A.col(i).setZero(), C.col(i).setZero();
  MatrixXd F;
  for (int k = 0; k < settling_samples; ++k) {
    F = A;
    for (Index i = 0; i < C.rows(); ++i) {
      const VectorXd PC = P * C.row(i).transpose();
      const VectorXd gain = PC / (C.row(i).dot(PC) + V(i));
      P -= gain * PC.transpose();
      F -= (F * gain) * C.row(i);
    }
    P = A * P * A.transpose() + W;
    P = ((P + P.transpose()) / 2).eval();
  }
  return {F, P};
}

Steady steady_of(const Controller& controller, const std::vector<int>& lasting) {
  if (!controller.solution.estimator) return steady_of_online(controller, lasting);
  if (const auto& own = controller.solution.compensator) return {MatrixXd(), design::to_doubles(own->P)};
  const design::EstimatorSolution& estimator = *controller.solution.estimator;
  const design::SampledPlant& plant = design::final_plant(controller.solution);
  const MatrixXd A = design::to_doubles(plant.A), C = design::to_doubles(plant.C);
  MatrixXd F = A - (A * design::to_doubles(estimator.L) + design::to_doubles(estimator.M)) * C;
  for (const int i : lasting) F.row(i).setZero(), F.col(i).setZero();
  return {F, design::to_doubles(estimator.P_prior)};
}

// Plant and controller, [x; s]⁺ = M [x; s].
struct Loop {
  MatrixXd M;
  Index plant = 0;              // states of it, the inputs that it keeps for D among them
  std::vector<Index> modelled;  // where the first of these are in the filter's model, which has disturbances, too
};

std::vector<Index> undisturbed_states(const design::Problem& problem, Index nx) {
  const Index first = problem.plant.A.rows(), count = design::disturbance_count(problem);
  std::vector<Index> states;
  for (Index i = 0; i < nx; ++i)
    if (i < first || i >= first + count) states.push_back(i);
  return states;
}

// Beside a filter without a steady state the law alone, as if the states were measured.
Loop loop_of(const Controller& controller) {
  const design::Digits in_force(digits);
  design::Problem problem = controller.problem;
  if (!controller.solution.estimator) problem.estimator.reset();
  const design::SampledPlant& plant = design::final_plant(controller.solution);
  const design::ClosedLoop loop = design::closed_loop(design::measured_plant(problem, controller.solution),
                                                      design::compensator(problem, controller.solution));
  const Index kept = problem.estimator && problem.estimator->form == design::Form::filter && !design::is_zero(plant.D)
                         ? controller.size.nu
                         : 0;
  const std::vector<Index> modelled = undisturbed_states(problem, controller.size.nx);
  return {design::to_doubles(loop.A), static_cast<Index>(modelled.size()) + kept, modelled};
}

// Of which states the controller's first numbers are estimates.
std::vector<Index> estimated_states(const Controller& controller) {
  if (const auto& own = controller.solution.compensator) return {own->estimates.begin(), own->estimates.end()};
  std::vector<Index> all(controller.solution.estimator ? static_cast<std::size_t>(controller.size.nx) : 0);
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

// From what `far` has of each state on, in plant and estimate, until both are `within`. ξ begins at its bound, and is
// not asked; neither is an input that is kept.
std::optional<long> samples_of_loop(const Controller& controller, const VectorXd& far, const Recovery& recovery) {
  Loop loop = loop_of(controller);
  const std::vector<Index> estimated = estimated_states(controller);
  const Index all = loop.M.rows(), estimates = static_cast<Index>(estimated.size());
  const double infinite = std::numeric_limits<double>::infinity();
  VectorXd start = VectorXd::Constant(all, far.maxCoeff()), target = VectorXd::Constant(all, infinite);
  for (std::size_t i = 0; i < loop.modelled.size(); ++i) {
    start(static_cast<Index>(i)) = far(loop.modelled[i]);
    target(static_cast<Index>(i)) = recovery.within(loop.modelled[i]);
  }
  for (Index i = 0; i < estimates; ++i) {
    const Index state = estimated[static_cast<std::size_t>(i)];
    if (state >= controller.size.nx) continue;  // an input that it remembers
    start(loop.plant + i) = far(state);
    target(loop.plant + i) = recovery.within(state);
  }
  for (int i = 0; i < controller.size.nxi; ++i)
    start(loop.plant + estimates + i) = std::ldexp(1.0, controller.bounds.xi[static_cast<std::size_t>(i)]);
  for (const int i : recovery.lasting) {
    const auto own = std::find(loop.modelled.begin(), loop.modelled.end(), i);
    const Index at = own - loop.modelled.begin();
    if (own != loop.modelled.end()) loop.M.row(at).setZero(), loop.M.col(at).setZero();
    if (estimates) loop.M.row(loop.plant + i).setZero(), loop.M.col(loop.plant + i).setZero();
  }
  return samples_until(loop.M, start, target);
}

// Samples in which an output is left out before the widest gate lets in all that is believable.
long samples_of_gate(const Controller& controller) {
  if (!controller.has.gate) return 1;  // a reset
  long most = 0;
  for (const double widen : controller.gate.widen) {
    long samples = 0;
    for (double wide = 1; wide < step::widest_gate; wide *= widen) ++samples;
    most = std::max(most, samples);
  }
  return most;
}

bool has_limits(const Controller& controller) {
  const auto& limits = controller.problem.limits;
  return controller.has.regulator && limits &&
         (limits->u_min.array().isFinite().any() || limits->u_max.array().isFinite().any());
}

// What the states can be before all begins anew.
VectorXd farthest(const Controller& controller) {
  if (!controller.linear) return states_at_bounds(controller, 0);
  const int largest = controller.target.is_double ? largest_exponent_of_double : largest_exponent_of_float;
  return VectorXd::Constant(controller.size.nx, std::ldexp(1.0, largest));
}

}  // namespace

Recovery recovery_of(const Controller& controller) {
  if (!controller.has.filter || is_extended(controller)) return {};  // what is said of it is said of matrices
  Recovery recovery;
  recovery.lasting = lasting_states(controller);
  const Steady steady = steady_of(controller, recovery.lasting);
  recovery.within = standard_deviations(controller, steady.P);
  const VectorXd far = farthest(controller);
  const std::optional<long> filter =
      steady.F.size() ? samples_until(steady.F, far, recovery.within) : std::optional<long>(0);
  const std::optional<long> loop =
      controller.has.regulator ? samples_of_loop(controller, far, recovery) : std::optional<long>(0);
  if (!filter || !loop) return recovery;
  const long schedule =
      controller.filters.empty() ? 0 : static_cast<long>(controller.filters.size()) - 1;  // a reset begins it anew
  const long deceived = samples_of_gate(controller) + *filter;
  const long settling = schedule + (controller.solution.online ? *filter : 0);
  const long way_back = has_limits(controller) ? deceived : 0;
  recovery.samples = rounded_up_to_two_digits(deceived + settling + way_back + *loop);
  return recovery;
}

}  // namespace lqg::controller
