// SPDX-License-Identifier: MIT
#include "simulate/simulation.hpp"

#include <algorithm>
#include <stdexcept>

#include "simulate/emitted_controller.hpp"
#include "simulate/emitted_form.hpp"
#include "simulate/numbers.hpp"
#include "simulate/plant.hpp"
#include "simulate/take_sample.hpp"

namespace lqg::simulate {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// What is given, else the operating point.
VectorXd given_or(const VectorXd& given, const VectorXd& point, Index size) {
  VectorXd result = controller::in_own_units(VectorXd::Zero(size), point);
  const Index count = std::min(size, given.size());
  result.head(count) = given.head(count);
  return result;
}

struct Surroundings : Unwatched {
  Surroundings(const Controller& of, const SimulationOptions& how, Plant around)
      : controller(of), options(how), plant(std::move(around)), point(controller::stated_point(of)),
        applied(controller::in_own_units(VectorXd::Zero(of.size.nu), point.u)) {}

  const Controller& controller;
  const SimulationOptions& options;
  Plant plant;
  controller::Point point;
  VectorXd applied;  // the last u
  int k = 0;

  VectorXd measure(const VectorXd& u) {
    VectorXd y = plant.measure(u);
    if (options.sensor) options.sensor(k, y);
    return in_target(controller.target, y);
  }
  VectorXd given_input() const {
    return in_target(controller.target, options.input
                                            ? options.input(k)
                                            : controller::in_own_units(VectorXd::Zero(controller.size.nu), point.u));
  }
  VectorXd state() const { return plant.state(); }
};

Trajectory empty_trajectory(const design::SampledPlant& plant, int samples) {
  Trajectory result;
  result.x = MatrixXd::Zero(plant.A.rows(), samples + 1);
  result.estimate = MatrixXd::Zero(plant.A.rows(), samples);
  result.u = MatrixXd::Zero(plant.B.cols(), samples);
  result.y = MatrixXd::Zero(plant.C.rows(), samples);
  result.cost = VectorXd::Zero(samples);
  result.events.resize(static_cast<std::size_t>(samples));
  return result;
}

template <class TakeSample>
Trajectory run(Surroundings around, TakeSample take_sample_of) {
  Trajectory result = empty_trajectory(around.controller.solution.plant, around.options.samples);
  result.x.col(0) = around.plant.state();
  for (; around.k < around.options.samples; ++around.k) {
    const Sample sample = take_sample_of(around);
    result.estimate.col(around.k) = sample.estimate;
    result.u.col(around.k) = sample.u;
    result.y.col(around.k) = sample.y;
    result.events[static_cast<std::size_t>(around.k)] = sample.events;
    result.cost(around.k) = around.plant.cost(sample.u);
    around.applied = sample.u;
    around.plant.advance(sample.u);
    result.x.col(around.k + 1) = around.plant.state();
  }
  return result;
}

template <class S>
Trajectory run_controller(const Controller& controller, Surroundings around) {
  EmittedController<S> emitted(controller, constants_of<S>(controller.target));
  const VectorXd r = given_or(around.options.r, around.point.r, controller.size.nr);
  emitted.state().r = numbers_of<S>(in_target(controller.target, r));
  Trajectory result = run(std::move(around), [&](Surroundings& now) {
    return controller.has.filter ? take_sample(emitted, now) : take_sample_of_state(emitted, now);
  });
  result.resets = emitted.resets();
  result.covariance_resets = emitted.covariance_resets();
  return result;
}

template <class S>
Trajectory run_form(const Controller& controller, Surroundings around) {
  EmittedForm<S> emitted(controller, constants_of<S>(controller.target));
  Trajectory result = run(std::move(around), [&](Surroundings& now) { return take_sample(emitted, now); });
  result.resets = emitted.resets();
  return result;
}

}  // namespace

Trajectory simulate(const Controller& controller, const SimulationOptions& options) {
  const PlantNoise noise = options.noise ? PlantNoise::designed : PlantNoise::none;
  const VectorXd point = controller::stated_point(controller).x;
  const VectorXd x0 = controller::as_deviations(given_or(options.x0, point, controller.size.nx), point);
  Surroundings around(controller, options, Plant(controller, x0, noise, options.seed));
  return with_scalar_of(controller.target, [&](auto zero) {
    using S = decltype(zero);
    return controller.linear ? run_form<S>(controller, std::move(around))
                             : run_controller<S>(controller, std::move(around));
  });
}

}  // namespace lqg::simulate

namespace lqg::design {

Trajectory simulate(const Problem& problem, const Solution& solution, const SimulationOptions& options) {
  Findings findings;
  std::optional<controller::Controller> physical = controller::controller_of(problem, solution, {}, findings);
  const auto stop_on = [](const std::string& why) { throw std::invalid_argument("simulate: " + why); };
  if (!physical) stop_on(findings.back().key + ": " + findings.back().message);
  const Realisation wanted = problem.code.realisation;
  const bool keeps_z = wanted == Realisation::folded || wanted == Realisation::modal || solution.compensator;
  if (!keeps_z) return simulate::simulate(*physical, options);
  if (wanted == Realisation::modal && controller::carries_covariance(*physical)) {
    const std::string why = no_modal_plant(problem);
    if (!why.empty()) stop_on("code.realisation: " + why);
    const ModalPlantResult found = modal_plant(problem, solution);
    if (!found.modal) stop_on("code.realisation: " + found.obstacle);
    physical = controller::with_modes(*std::move(physical), *found.modal, findings);
    if (!physical) stop_on(findings.back().key + ": " + findings.back().message);
    return simulate::simulate(*physical, options);
  }
  const std::string obstacle = no_linear_form(problem, solution);
  if (!obstacle.empty() && (wanted == Realisation::modal || !solution.compensator))
    stop_on("code.realisation: " + obstacle);
  const LinearFormResult found =
      wanted == Realisation::modal ? modal_form(problem, solution) : folded_form(problem, solution);
  if (!found.form) stop_on("code.realisation: " + found.obstacle);
  return simulate::simulate(controller::with_form(*std::move(physical), *found.form), options);
}

}  // namespace lqg::design
