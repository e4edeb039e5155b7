// SPDX-License-Identifier: MIT
#include "simulate/scenario_run.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "controller/operating_point.hpp"
#include "simulate/filter_watch.hpp"
#include "simulate/prepared_scenario.hpp"
#include "simulate/scenario_numbers.hpp"
#include "simulate/take_sample.hpp"
#include "simulate/truth.hpp"

namespace lqg::simulate {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using controller::as_deviations;
using controller::in_own_units;

constexpr double far_away = 1e18;  // a plant that nobody holds is shown until it is there

// The plant of the scenario, and what is seen of the filter.
struct ScenarioSurroundings {
  ScenarioSurroundings(const PreparedScenario& of, const TruthModel& model, const VectorXd& x0, std::uint64_t seed,
                       ScenarioRun& to)
      : prepared(of), controller(of.controller), point(controller::stated_point(of.controller)), noise(seed),
        truth(model, x0, noise), applied(in_own_units(VectorXd::Zero(of.controller.size.nu), point.u)), run(to) {
    if (keeps_estimate(controller)) watch.emplace(controller);
  }

  static bool keeps_estimate(const Controller& controller) { return controller.has.filter && !controller.linear; }

  VectorXd measure(const VectorXd& u) {
    if (controller.is_predictor || !controller.has.filter) ask(u);
    VectorXd y = in_own_units(truth.measure(), point.y);
    run.outputs.col(k) = in_own_units(truth.outputs(), point.y);
    fail(y);
    return in_target(controller.target, y);
  }
  VectorXd given_input() const {
    return in_target(controller.target, in_own_units(prepared.courses.input.col(k), point.u));
  }
  VectorXd state() const { return in_own_units(truth.designed_state(), point.x); }
  void ask(const VectorXd& u) { truth.ask(as_deviations(u, point.u)); }

  template <class S>
  void before_update(const EmittedController<S>& emitted, const VectorXd& y) {
    watch->before_update(emitted, y);
  }
  template <class S>
  void after_update(const EmittedController<S>& emitted) {
    watch->after_update(emitted);
    const std::vector<bool>& left_out = emitted.left_out();
    for (std::size_t i = 0; i < left_out.size(); ++i) run.left_out(static_cast<Index>(i), k) = left_out[i];
    run.innovation.col(k) = watch->innovation();
    if (!watch->knows_its_error()) return;
    run.nis(k) = watch->nis();
    const Index nx = run.sigma.rows();
    run.sigma.col(k) = watch->P().diagonal().head(nx).cwiseMax(0).cwiseSqrt();
    const NormalisedSquare square =
        normalised_square(watch->P().topLeftCorner(nx, nx), truth.state() - watch->estimate().head(nx));
    run.nees(k) = square.value;
    run.nees_degrees = square.degrees;
  }
  void end_sample(unsigned events) {
    if (watch) watch->end_sample(events);
  }

  // Drop-outs and outliers.
  void fail(VectorXd& y) const {
    const double T = prepared.truth.T;
    const int now = static_cast<int>(k);
    const auto is_between = [&](double from, double until) {
      return first_sample(from, T, now + 1) <= now && first_sample(until, T, now + 1) > now;
    };
    for (const design::Outlier& outlier : prepared.scenario.outlier)
      if (is_between(outlier.at, outlier.until.value_or(outlier.at + T))) y(outlier.output) = outlier.value;
    for (const design::DropOut& gap : prepared.scenario.dropout)
      if (is_between(gap.from, gap.until)) y(gap.output) = std::nan("");
  }

  const PreparedScenario& prepared;
  const Controller& controller;
  const controller::Point point;
  Noise noise;
  Truth truth;
  VectorXd applied;
  ScenarioRun& run;
  Index k = 0;
  std::optional<FilterWatch> watch;
};

ScenarioRun empty_run(const PreparedScenario& prepared, const TruthModel& truth) {
  const Controller& controller = prepared.controller;
  const Index samples = prepared.courses.load.cols();
  ScenarioRun run;
  run.name = prepared.scenario.name;
  run.times.resize(samples);
  for (Index k = 0; k < samples; ++k) run.times(k) = static_cast<double>(k) * truth.T;
  run.x = MatrixXd::Zero(truth.nx, samples);
  run.estimate = MatrixXd::Zero(controller.size.nx, samples);
  run.y = run.outputs = MatrixXd::Zero(truth.ny, samples);
  run.u = MatrixXd::Zero(truth.nu, samples);
  run.r = prepared.courses.reference;
  if (const VectorXd r = controller::stated_point(controller).r; r.size()) run.r.colwise() += r;
  run.events.assign(static_cast<std::size_t>(samples), 0);
  run.left_out = Eigen::ArrayXX<bool>::Constant(truth.ny, samples, false);
  if (ScenarioSurroundings::keeps_estimate(controller)) run.innovation = MatrixXd::Zero(truth.ny, samples);
  if (run.innovation.size() && controller::noise_at(controller, 0)) {
    run.sigma = MatrixXd::Zero(truth.nx, samples);
    run.nis = run.nees = VectorXd::Zero(samples);
  }
  const Index instants = static_cast<Index>(truth.instants.size()) + 1;
  if (instants == 1) return run;
  run.fine_times.resize(samples * instants);
  run.fine_x = MatrixXd::Zero(truth.nx, samples * instants);
  run.fine_outputs = MatrixXd::Zero(truth.ny, samples * instants);
  return run;
}

// Keeps the first samples.
void cut(ScenarioRun& run, Index samples) {
  const Index instants = run.times.size() ? run.fine_times.size() / run.times.size() : 0;
  run.times.conservativeResize(samples);
  for (MatrixXd* values : {&run.x, &run.estimate, &run.sigma, &run.y, &run.outputs, &run.u, &run.r, &run.innovation})
    if (values->size()) values->conservativeResize(Eigen::NoChange, samples);
  for (VectorXd* values : {&run.nis, &run.nees})
    if (values->size()) values->conservativeResize(samples);
  run.events.resize(static_cast<std::size_t>(samples));
  run.left_out.conservativeResize(Eigen::NoChange, samples);
  run.fine_times.conservativeResize(samples * instants);
  for (MatrixXd* values : {&run.fine_x, &run.fine_outputs})
    if (values->size()) values->conservativeResize(Eigen::NoChange, samples * instants);
}

void keep_instants(const ScenarioSurroundings& around, ScenarioRun& run) {
  if (run.fine_times.size() == 0) return;
  const TruthModel& model = around.prepared.truth;
  Index column = around.k * static_cast<Index>(model.instants.size() + 1);
  run.fine_times(column) = run.times(around.k);
  run.fine_x.col(column) = run.x.col(around.k);
  run.fine_outputs.col(column) = run.outputs.col(around.k);
  for (const double time : model.instants) {
    ++column;
    run.fine_times(column) = run.times(around.k) + time;
    run.fine_x.col(column) = in_own_units(around.truth.state_after(time), around.point.x);
    run.fine_outputs.col(column) = in_own_units(around.truth.outputs_after(time), around.point.y);
  }
}

// What is shown of the sample before `k` is not all there.
bool ends_within_sample(const ScenarioRun& run, Index k) {
  const Index instants = run.fine_times.size() / run.times.size();
  return k > 0 && instants > 0 && !run.fine_x.middleCols((k - 1) * instants, instants).allFinite();
}

bool is_lost(const VectorXd& x) { return !(x.cwiseAbs().maxCoeff() < far_away); }

template <class TakeSample>
void run_samples(ScenarioSurroundings& around, ScenarioRun& run, TakeSample take_sample_of) {
  const Index samples = run.times.size();
  for (; around.k < samples; ++around.k) {
    run.x.col(around.k) = in_own_units(around.truth.state(), around.point.x);
    if (is_lost(around.truth.state())) {
      run.numbers.has_diverged = true;
      return cut(run, around.k - (ends_within_sample(run, around.k) ? 1 : 0));
    }
    const Sample sample = take_sample_of();
    if (!around.controller.is_predictor && around.controller.has.filter) around.ask(sample.u);
    run.estimate.col(around.k) = sample.estimate;
    run.u.col(around.k) = sample.u;
    run.y.col(around.k) = sample.y;
    run.events[static_cast<std::size_t>(around.k)] = sample.events;
    run.numbers.cost += around.truth.cost();
    around.applied = sample.u;
    around.end_sample(sample.events);
    keep_instants(around, run);
    around.truth.advance();
  }
}

template <class S>
void run_emitted(EmittedController<S>& emitted, ScenarioSurroundings& around, ScenarioRun& run) {
  const Controller& controller = around.controller;
  run_samples(around, run, [&] {
    emitted.state().r = numbers_of<S>(in_target(controller.target, run.r.col(around.k)));
    return controller.has.filter ? take_sample(emitted, around) : take_sample_of_state(emitted, around);
  });
  run.numbers.covariance_resets = emitted.covariance_resets();
}

template <class S>
void run_emitted(EmittedForm<S>& emitted, ScenarioSurroundings& around, ScenarioRun& run) {
  run_samples(around, run, [&] {
    const Sample sample = take_sample(emitted, around);
    run.left_out.col(around.k) = !sample.y.array().isFinite();
    return sample;
  });
}

// Enough for a curve, and no more than a page can hold.
int instants_of(const Controller& controller, const design::Scenario& scenario) {
  constexpr int most_points = 20000, most_in_a_period = 8;
  return std::clamp(most_points / samples_of(controller, scenario), 1, most_in_a_period);
}

}  // namespace

PreparedScenario::PreparedScenario(const Controller& of, design::Scenario what, int instants)
    : controller(of), scenario(std::move(what)), courses(courses_of(of, scenario)),
      truth(truth_model(of, scenario, courses, instants)) {}

ScenarioRunner::ScenarioRunner(const PreparedScenario& prepared) : prepared_(prepared) {
  const auto runs_with = [this](auto emitted) {
    run_ = [this, emitted](const TruthModel& truth, const VectorXd& x0, std::uint64_t seed, ScenarioRun& run) {
      ScenarioSurroundings around(prepared_, truth, x0, seed, run);
      emitted->init();
      run_emitted(*emitted, around, run);
      run.numbers.resets = emitted->resets();
    };
  };
  with_scalar_of(prepared.controller.target, [&](auto zero) {
    using S = decltype(zero);
    const auto constants = constants_of<S>(prepared.controller.target);
    if (prepared.controller.linear)
      runs_with(std::make_shared<EmittedForm<S>>(prepared.controller, constants));
    else
      runs_with(std::make_shared<EmittedController<S>>(prepared.controller, constants));
  });
}

ScenarioRun ScenarioRunner::run(const TruthModel& truth, const VectorXd& x0, std::uint64_t seed) {
  ScenarioRun run = empty_run(prepared_, truth);
  run_(truth, x0, seed, run);
  count_numbers(prepared_, run);
  return run;
}

ScenarioRun run_scenario(const Controller& controller, const design::Scenario& scenario, std::uint64_t seed) {
  const PreparedScenario prepared(controller, scenario, instants_of(controller, scenario));
  return ScenarioRunner(prepared).run(prepared.truth, prepared.scenario.x0, seed);
}

}  // namespace lqg::simulate
