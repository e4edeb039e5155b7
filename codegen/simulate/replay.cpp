// SPDX-License-Identifier: MIT
#include "simulate/replay.hpp"

#include <cmath>

#include "simulate/filter_watch.hpp"

namespace lqg::simulate {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ReplayRun empty_replay(const Controller& controller, const Log& log) {
  const Index samples = log.times.size(), nx = controller.problem.plant.A.rows();
  ReplayRun run;
  run.times = log.times;
  run.y = log.y, run.u = log.u;
  if (controller.has.regulator) run.law = MatrixXd::Zero(controller.size.nu, samples);
  run.estimate = MatrixXd::Zero(nx, samples);
  run.innovation = MatrixXd::Zero(controller.size.ny, samples);
  run.left_out.assign(static_cast<std::size_t>(controller.size.ny), 0);
  if (controller::noise_at(controller, 0)) {
    run.sigma = MatrixXd::Zero(nx, samples);
    run.nis = VectorXd::Zero(samples);
  }
  return run;
}

template <class S>
void replay_sample(EmittedController<S>& emitted, FilterWatch& watch, const Controller& controller, const Log& log,
                   Index k, ReplayRun& run) {
  unsigned events = 0;
  Vector<S> law;
  const VectorXd y = in_target(controller.target, log.y.col(k)), u = in_target(controller.target, log.u.col(k));
  if (log.r.rows()) emitted.state().r = numbers_of<S>(in_target(controller.target, log.r.col(k)));
  const auto act = [&] {
    if (controller.has.regulator) events |= emitted.control(law);
  };
  const auto hear = [&] {
    watch.before_update(emitted, y);
    events |= emitted.update(numbers_of<S>(y));
    watch.after_update(emitted);
  };
  if (controller.is_predictor) {
    act();
    hear();
  } else {
    hear();
    act();
  }
  events |= emitted.predict(numbers_of<S>(u));
  run.y.col(k) = y, run.u.col(k) = u;
  if (controller.has.regulator) run.law.col(k) = as_doubles(law);
  run.innovation.col(k) = watch.innovation();
  run.estimate.col(k) = controller::in_own_units(watch.estimate().head(run.estimate.rows()), controller.point.x);
  if (watch.knows_its_error()) {
    run.sigma.col(k) = watch.P().diagonal().head(run.sigma.rows()).cwiseMax(0).cwiseSqrt();
    run.nis(k) = watch.nis();
  }
  for (std::size_t i = 0; i < run.left_out.size(); ++i) run.left_out[i] += emitted.left_out()[i];
  run.events.push_back(events);
  watch.end_sample(events);
}

}  // namespace

std::string no_replay(const Controller& controller) {
  if (!controller.has.filter) return "a log is replayed by a filter: the design has neither [kalman] nor [observer]";
  if (controller.linear)
    return "a controller with code.realisation = \"" + controller::name_of(controller.forms->chosen) +
           "\" keeps no estimate that a log could be held against: use \"physical\"";
  return "";
}

ReplayRun replay(const Controller& controller, const Log& log) {
  ReplayRun run = empty_replay(controller, log);
  with_scalar_of(controller.target, [&](auto zero) {
    using S = decltype(zero);
    EmittedController<S> emitted(controller, constants_of<S>(controller.target));
    FilterWatch watch(controller);
    for (Index k = 0; k < log.times.size(); ++k) replay_sample(emitted, watch, controller, log, k, run);
    run.resets = emitted.resets();
    run.covariance_resets = emitted.covariance_resets();
  });
  return run;
}

}  // namespace lqg::simulate
