// SPDX-License-Identifier: MIT
// What a single absurd value costs the loop, and that no honest sample is taken for one.
//
//     spikes DESIGN.toml [samples]     default: 20000 honest samples
//
// The runs are the host's simulation, which has the bits of the compiled header. Exit status 1: a promise is not kept.
//
// Honest: starts drawn from P0, in runs of 5000 samples, with a silence of 10 s in each; of a plant that is unstable,
// one in which its errors grow tenfold. No output may be left out. Spikes: each output says, in one sample, what is off
// by from 10³ to 10³⁰ of its own standard deviations. It must be told, nothing may be reset, and the plant must stay
// within 8 of its standard deviations of what it does without the spike.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>

#include "design/rounding.hpp"
#include "design/solve.hpp"
#include "emit/plan/plan.hpp"
#include "input/design_file.hpp"
#include "simulate/noise.hpp"
#include "simulate/simulation.hpp"

namespace {

using namespace lqg;
using controller::Controller;
using simulate::SimulationOptions;
using simulate::Trajectory;
using step::Event;

constexpr int run_length = 5000, spike_at = 2500;
constexpr double allowed = 8;  // standard deviations of the plant's own state

[[noreturn]] void stop(const std::string& why) {
  std::cerr << why << "\n";
  std::exit(1);
}

Controller controller_of(const std::string& path) {
  const input::DesignFile file = input::read_design_file(path);
  if (!file.problem) stop(path + ": cannot be read");
  design::Findings findings;
  std::optional<design::Solution> solution = design::solve(*file.problem, findings);
  std::optional<Controller> controller;
  if (solution) controller = emit::make_controller(*file.problem, *solution, {}, findings);
  if (!controller) stop(path + ": " + findings.back().message);
  return *controller;
}

// The samples of a silence that the loop survives.
int silence_of(const Controller& controller) {
  const double longest = 10 / controller.problem.plant.sample_time;
  const double growth = design::to_doubles(controller.solution.plant.A).eigenvalues().cwiseAbs().maxCoeff();
  const double survived = growth > 1 + 1e-9 ? std::log(10.0) / std::log(growth) : longest;
  return static_cast<int>(std::min({longest, survived, run_length / 2.0}));
}

// x0 + a draw from P0.
Eigen::VectorXd start_of(const Controller& controller, simulate::Noise& noise) {
  const design::Estimator& estimator = *controller.problem.estimator;
  const Eigen::MatrixXd root = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(estimator.P0).operatorSqrt();
  Eigen::VectorXd drawn(root.cols());
  for (double& each : drawn) each = noise.normal();
  return estimator.x0 + root * drawn;
}

bool leaves_out(const Trajectory& run, int k) {
  return run.has(k, Event::output_gated) || run.has(k, Event::innovation_not_positive);
}

int count_false_alarms(const Controller& controller, long samples) {
  const int silence = silence_of(controller), from = run_length / 2;
  simulate::Noise starts(7);
  int alarms = 0;
  for (long done = 0; done < samples; done += run_length) {
    SimulationOptions options;
    options.samples = run_length;
    options.seed = static_cast<std::uint64_t>(done + 1);
    options.x0 = start_of(controller, starts);
    options.sensor = [&](int k, Eigen::VectorXd& y) {
      if (k >= from && k < from + silence) y.setConstant(std::numeric_limits<double>::quiet_NaN());
    };
    const Trajectory run = simulate::simulate(controller, options);
    for (int k = 0; k < run_length; ++k) alarms += leaves_out(run, k);
  }
  return alarms;
}

Eigen::VectorXd deviations(const Eigen::MatrixXd& columns) {
  const Eigen::VectorXd mean = columns.rowwise().mean();
  return ((columns.colwise() - mean).array().square().rowwise().mean()).sqrt();
}

// Empty: the spike costs nothing that matters.
std::string cost_of_spike(const Controller& controller, int output, double factor) {
  SimulationOptions options;
  options.samples = run_length;
  const Trajectory twin = simulate::simulate(controller, options);
  const Eigen::VectorXd of_outputs = deviations(twin.y.rightCols(run_length / 2)),
                        of_states = deviations(twin.x.rightCols(run_length / 2));
  const double spike = factor * of_outputs(output);
  options.sensor = [&](int k, Eigen::VectorXd& y) {
    if (k == spike_at) y(output) += spike;
  };
  const Trajectory run = simulate::simulate(controller, options);
  if (!run.has(spike_at, Event::output_gated) && !run.has(spike_at, Event::output_rejected)) return "is let in";
  if (run.resets || run.covariance_resets) return "begins anew";
  const Eigen::VectorXd moved = (run.x - twin.x).cwiseAbs().rowwise().maxCoeff();
  for (Eigen::Index i = 0; i < moved.size(); ++i)
    if (!(moved(i) <= allowed * of_states(i)))
      return "moves " + controller.problem.plant.states[static_cast<std::size_t>(i)].name;
  return "";
}

}  // namespace

int main(int count, char* arguments[]) {
  if (count < 2) stop("spikes DESIGN.toml [samples]");
  const long samples = count > 2 ? std::strtol(arguments[2], nullptr, 10) : 20000;
  const Controller controller = controller_of(arguments[1]);
  if (!controller.has.gate) {
    std::printf("%s has no threshold: %s\n", controller.problem.name.c_str(),
                controller.has.filter ? "no variance of the innovations is there" : "it has no filter");
    return 0;
  }
  int failures = 0;
  for (int output = 0; output < controller.size.ny; ++output)
    for (const double factor : {1e3, -1e3, 1e6, 1e9, 1e12, 1e20, 1e30}) {
      const std::string cost = cost_of_spike(controller, output, factor);
      if (cost.empty()) continue;
      ++failures;
      std::printf("a spike of %g σ in output %d %s\n", factor, output, cost.c_str());
    }
  const int alarms = count_false_alarms(controller, samples);
  std::printf("%s: %d outputs left out in %ld honest samples, %d spikes that cost\n", controller.problem.name.c_str(),
              alarms, samples, failures);
  return alarms || failures ? 1 : 0;
}
