// SPDX-License-Identifier: MIT
#include "simulate/simulation.hpp"

#include <algorithm>
#include <stdexcept>

#include "simulate/emitted_controller.hpp"
#include "simulate/emitted_form.hpp"
#include "simulate/numbers.hpp"
#include "simulate/plant.hpp"

namespace lqg::simulate {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd padded(const VectorXd& x, Index size) {
  VectorXd result = VectorXd::Zero(size);
  result.head(std::min(size, x.size())) = x.head(std::min(size, x.size()));
  return result;
}

// What one sample shows.
struct Sample {
  VectorXd y, u, estimate;
  unsigned events = 0;
};

// Around a controller: what it is told, and what it is given to apply.
struct Surroundings {
  const Controller& controller;
  const SimulationOptions& options;
  Plant plant;
  VectorXd applied;  // the last u
  int k = 0;

  // y with the u that acts while it is sampled, as the controller is told of it.
  VectorXd measure(const VectorXd& u) {
    VectorXd y = plant.measure(u);
    if (options.sensor) options.sensor(k, y);
    return in_target(controller.target, y);
  }
  // Of an estimator alone.
  VectorXd given_input() const {
    return in_target(controller.target,
                     options.input ? options.input(k) : VectorXd(VectorXd::Zero(controller.size.nu)));
  }
};

// Each samples `around` in the order of its form, as firmware does.
template <class S>
Sample take_sample(EmittedController<S>& emitted, Surroundings& around) {
  const Controller& controller = around.controller;
  Sample sample;
  Vector<S> u;
  const auto act = [&] {
    sample.estimate = as_doubles(emitted.state().x);
    if (controller.has.regulator)
      sample.events |= emitted.control(u);
    else
      u = numbers_of<S>(around.given_input());
  };
  const auto hear = [&](const VectorXd& acting) {
    sample.y = around.measure(acting);
    sample.events |= emitted.update(numbers_of<S>(sample.y));
  };
  if (controller.is_predictor) {
    act();
    hear(as_doubles(u));
  } else {
    hear(around.applied);
    act();
  }
  sample.events |= emitted.predict(u);
  sample.u = as_doubles(u);
  return sample;
}

// A regulator alone, of the state itself.
template <class S>
Sample take_sample_of_state(EmittedController<S>& emitted, Surroundings& around) {
  Sample sample;
  Vector<S> u;
  sample.estimate = in_target(around.controller.target, around.plant.state());
  sample.events = emitted.control(numbers_of<S>(sample.estimate), u);
  sample.u = as_doubles(u);
  sample.y = around.measure(sample.u);
  return sample;
}

template <class S>
Sample take_sample(EmittedForm<S>& emitted, Surroundings& around) {
  Sample sample;
  Vector<S> u;
  if (!around.controller.is_predictor) sample.y = around.measure(around.applied);
  sample.events = emitted.control(numbers_of<S>(sample.y), u);
  sample.estimate = as_doubles(emitted.estimate());
  sample.u = as_doubles(u);
  if (around.controller.is_predictor) sample.y = around.measure(sample.u);
  sample.events |= emitted.advance(numbers_of<S>(sample.y));
  return sample;
}

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
  emitted.state().r = numbers_of<S>(in_target(controller.target, padded(around.options.r, controller.size.nr)));
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
  Surroundings around = {controller, options,
                         Plant(controller, padded(options.x0, controller.size.nx), noise, options.seed),
                         VectorXd::Zero(controller.size.nu)};
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
  if (wanted != Realisation::folded && wanted != Realisation::modal) return simulate::simulate(*physical, options);
  const std::string obstacle = no_linear_form(problem, solution);
  if (!obstacle.empty()) stop_on("code.realisation: " + obstacle);
  const LinearFormResult found =
      wanted == Realisation::folded ? folded_form(problem, solution) : modal_form(problem, solution);
  if (!found.form) stop_on("code.realisation: " + found.obstacle);
  return simulate::simulate(controller::with_form(*std::move(physical), *found.form), options);
}

}  // namespace lqg::design
