// SPDX-License-Identifier: MIT
// What the host's simulation shows of a controller, for replay.h, which holds it against the compiled header.
//
//     record_runs DESIGN.toml STYLE REAL FILE
//
// FILE holds doubles, which hold the target's numbers exactly: how many runs there are; of each run its samples and,
// sample by sample: r, y (of a regulator alone x), u, x̂ that u was made of, the status, how often the controller has
// begun anew.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <limits>

#include "design/solve.hpp"
#include "emit/plan/plan.hpp"
#include "input/design_file.hpp"
#include "lqg/status.h"
#include "simulate/scenario_run.hpp"
#include "simulate/simulation.hpp"

namespace {

using namespace lqg;
using controller::Controller;
using step::Event;

[[noreturn]] void stop(const std::string& why) {
  std::cerr << why << "\n";
  std::exit(1);
}

Controller controller_of(const std::string& path, const std::string& style, const std::string& real) {
  const input::DesignFile file = input::read_design_file(path);
  if (!file.problem) stop(path + ": cannot be read");
  design::Problem problem = *file.problem;
  problem.code.style = style == "compact" ? design::Style::compact : design::Style::unrolled;
  problem.code.real = real == "double" ? design::Scalar::float64 : design::Scalar::float32;
  design::Findings findings;
  std::optional<design::Solution> solution = design::solve(problem, findings);
  std::optional<Controller> controller;
  if (solution) controller = emit::make_controller(problem, *solution, {}, findings);
  if (!controller) stop(path + ": " + findings.back().message);
  return *controller;
}

lqg_status_t status_of(unsigned events) {
  lqg_status_t status = LQG_OK;
  const auto add = [&](Event event, lqg_status_t bit) {
    if (events >> static_cast<unsigned>(event) & 1u) status |= bit;
  };
  add(Event::output_rejected, LQG_OUTPUT_REJECTED);
  add(Event::output_gated, LQG_OUTPUT_GATED);
  add(Event::innovation_not_positive, LQG_INNOVATION_NOT_POSITIVE);
  add(Event::input_limited, LQG_INPUT_LIMITED);
  add(Event::state_reset, LQG_STATE_RESET);
  add(Event::reference_not_finite, LQG_REFERENCE_NOT_FINITE);
  add(Event::covariance_reset, LQG_COVARIANCE_RESET);
  add(Event::not_optimal, LQG_NOT_OPTIMAL);
  for (int i = 0; i < step::told_rejections; ++i) add(step::rejection_of(i), LQG_OUTPUT_REJECTED_BIT(i));
  return status;
}

// Outputs that are missing, infinite, absurd, far off or stuck, now and then.
void fail_some(int k, Eigen::VectorXd& y) {
  const double inf = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < y.size(); ++i) switch ((k * 31 + static_cast<int>(i) * 7) % 97) {
      case 3: y(i) = std::nan(""); break;
      case 11: y(i) = -inf; break;
      case 29: y(i) = 1e30; break;
      case 47: y(i) += 1000; break;
      case 48: y(i) -= 10; break;
      case 71: y(i) = 0; break;
      default: break;
    }
}

// Noise and references; the same with failing sensors; far from the set point, where limits and gates act.
std::vector<simulate::SimulationOptions> runs_of(const Controller& controller) {
  simulate::SimulationOptions fair, failing, far;
  fair.samples = failing.samples = far.samples = 400;
  fair.r = failing.r = far.r = Eigen::VectorXd::Constant(controller.size.nr, 1);
  fair.input = failing.input =
      far.input = [&](int k) { return Eigen::VectorXd::Constant(controller.size.nu, std::sin(0.1 * k)); };
  failing.seed = 2;
  failing.sensor = fail_some;
  far.seed = 3;
  far.x0 = Eigen::VectorXd::Constant(controller.size.nx, 5);
  far.r = Eigen::VectorXd::Constant(controller.size.nr, -40);
  return {fair, failing, far};
}

void write(std::FILE* file, double value) { std::fwrite(&value, sizeof value, 1, file); }

void write(std::FILE* file, const Eigen::VectorXd& values) {
  for (const double value : values) write(file, value);
}

template <class Run>
void record(const Controller& controller, const Run& run, const Eigen::MatrixXd& r, unsigned long resets,
            std::FILE* file) {
  write(file, static_cast<double>(r.cols()));
  for (Eigen::Index k = 0; k < r.cols(); ++k) {
    write(file, Eigen::VectorXd(r.col(k)));
    write(file, controller.has.filter ? Eigen::VectorXd(run.y.col(k)) : Eigen::VectorXd(run.estimate.col(k)));
    write(file, Eigen::VectorXd(run.u.col(k)));
    write(file, Eigen::VectorXd(run.estimate.col(k)));
    write(file, status_of(run.events[static_cast<std::size_t>(k)]));
  }
  write(file, static_cast<double>(resets));
}

void record(const Controller& controller, const simulate::SimulationOptions& options, std::FILE* file) {
  const simulate::Trajectory run = simulate::simulate(controller, options);
  record(controller, run, options.r.replicate(1, options.samples), run.resets, file);
}

// The scenarios of the design, or those that are shown without any.
void record(const Controller& controller, const design::Scenario& scenario, std::FILE* file) {
  const simulate::ScenarioRun run = simulate::run_scenario(controller, scenario);
  record(controller, run, run.r, run.numbers.resets, file);
}

}  // namespace

int main(int count, char* arguments[]) {
  if (count != 5) stop("record_runs DESIGN.toml STYLE REAL FILE");
  const Controller controller = controller_of(arguments[1], arguments[2], arguments[3]);
  std::FILE* file = std::fopen(arguments[4], "wb");
  if (!file) stop(std::string(arguments[4]) + ": cannot be written");
  const std::vector<simulate::SimulationOptions> runs = runs_of(controller);
  const std::vector<design::Scenario> scenarios = simulate::scenarios_to_show(controller);
  write(file, static_cast<double>(runs.size() + scenarios.size()));
  for (const simulate::SimulationOptions& options : runs) record(controller, options, file);
  for (const design::Scenario& scenario : scenarios) record(controller, scenario, file);
  return std::fclose(file) == 0 ? 0 : 1;
}
