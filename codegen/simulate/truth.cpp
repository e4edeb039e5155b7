// SPDX-License-Identifier: MIT
#include "simulate/truth.hpp"

#include <algorithm>
#include <cmath>

namespace lqg::simulate {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// How many samples back anything still needs: late inputs, late sensors, the cost of the design.
Index samples_kept(const TruthModel& model) {
  double most = std::max(model.late + 1, model.designed_delay);
  for (Index i = 0; i < model.ny; ++i) most = std::max(most, std::ceil(model.output_delay(i) / model.T));
  return static_cast<Index>(most) + model.late + 3;
}

double limited(const design::Actuator& actuator, double before, double u, double sample_time) {
  const double step = actuator.rate * sample_time;
  double can = std::min(std::max(u, actuator.min), actuator.max);
  can = std::min(std::max(can, before - step), before + step);
  return can;
}

double sensed(const design::Sensor& sensor, double y) {
  y = sensor.gain * y + sensor.bias;
  if (sensor.quantum > 0) y = std::nearbyint(y / sensor.quantum) * sensor.quantum;
  return std::min(std::max(y, sensor.min), sensor.max);
}

// Of a point, of which nothing is there where all of it is 0.
double entry(const VectorXd& point, int i) { return point.size() ? point(i) : 0; }

}  // namespace

Truth::Truth(const TruthModel& model, const VectorXd& x0, Noise& noise)
    : model_(model), noise_(noise), point_(controller::stated_point(*model.controller)) {
  x0_ = VectorXd::Zero(model.nx + static_cast<Index>(model.lagged.size()));
  x0_.head(x0.size()) = x0;
  x_ = x0_;
  states_ = MatrixXd::Zero(x_.size(), samples_kept(model));
  commands_ = inputs_ = MatrixXd::Zero(model.nu, states_.cols());
  states_.col(0) = x_;
}

double Truth::asked_for(int input, int sample) const { return sample < 0 ? 0 : commands_(input, place(sample)); }

void Truth::ask(const VectorXd& u) {
  has_asked_ = true;
  inputs_.col(place(k_)) = u;
  commands_.col(place(k_)) = u;
  for (const design::Actuator& actuator : model_.scenario->actuator) {
    // What it was asked for before, without its gain.
    const double at_rest = entry(point_.u, actuator.input);
    const double before = k_ == 0              ? at_rest
                          : actuator.gain == 0 ? 0
                                               : (at_rest + asked_for(actuator.input, k_ - 1)) / actuator.gain;
    double& command = commands_(actuator.input, place(k_));
    command = actuator.gain * limited(actuator, before, at_rest + command, model_.T) - at_rest;
  }
}

Held Truth::held_of(int asked, int period) const {
  Held held;
  held.command = VectorXd(model_.nu);
  for (Index i = 0; i < model_.nu; ++i) held.command(i) = asked_for(static_cast<int>(i), asked);
  if (!model_.has_loads) return held;
  held.load = model_.courses->load.col(period);
  held.state_load = model_.courses->state_load.col(period);
  return held;
}

// x ← x `time` s later, while the actuators do what sample `asked` wanted and the loads are those of `period`.
void Truth::move(const TruthModel::Stage& stage, int asked, int period, double time, VectorXd& x) const {
  if (model_.motion) return model_.motion->move(held_of(asked, period), time, x);
  const auto found = std::find_if(stage.moves.begin(), stage.moves.end(),
                                  [time](const TruthModel::Move& move) { return move.time == time; });
  VectorXd held = VectorXd::Zero(found->period.B.cols());
  for (Index i = 0; i < model_.nu; ++i) held(i) = asked_for(static_cast<int>(i), asked);
  if (model_.has_loads) {
    held.segment(model_.nu, model_.nu) = model_.courses->load.col(period);
    held.tail(model_.nx) = model_.courses->state_load.col(period);
  }
  VectorXd next = VectorXd::Zero(x.size());
  add_product(found->period.A, x, next);
  add_product(found->period.B, held, next);
  x = next;
}

VectorXd Truth::moved(int period, double time) const {
  VectorXd x = states_.col(place(period));
  const TruthModel::Stage& stage = model_.stage_at(period);
  if (model_.part <= 0) {
    move(stage, period - model_.late, period, time, x);
    return x;
  }
  move(stage, period - model_.late - 1, period, std::min(time, model_.part), x);
  if (time > model_.part) move(stage, period - model_.late, period, time - model_.part, x);
  return x;
}

// C x + D (what acts), which of the actuators is what sample `asked` wanted of them.
VectorXd Truth::outputs_of(const VectorXd& x, int asked, int period) const {
  const TruthModel::Stage& stage = model_.stage_at(period);
  VectorXd acting(model_.nu);
  for (Index i = 0; i < model_.nu; ++i) acting(i) = asked_for(static_cast<int>(i), asked);
  for (std::size_t i = 0; i < model_.lagged.size(); ++i)
    acting(model_.lagged[i]) = x(model_.nx + static_cast<Index>(i));
  if (model_.has_loads) acting += model_.courses->load.col(period);
  if (model_.motion) return model_.motion->outputs(x, acting);
  VectorXd y = ordered_image(stage.C, x.head(model_.nx));
  add_product(stage.D, acting, y);
  return y;
}

VectorXd Truth::outputs_in(int period, double time) const {
  const int asked = period - model_.late - (time < model_.part ? 1 : 0);
  return outputs_of(moved(period, time), asked, period);
}

// What acts at a sample is u of that sample where nothing is late and it was asked for already, as in predictor form.
VectorXd Truth::outputs_at(int sample) const {
  const int late = model_.late + (model_.part > 0 ? 1 : 0);
  const bool is_new = sample < k_ ? model_.controller->is_predictor : has_asked_;
  return outputs_of(states_.col(place(sample)), sample - std::max(late, is_new ? 0 : 1), sample);
}

double Truth::late_output(Index output) const {
  const double delay = model_.output_delay(output), periods = delay / model_.T;
  const int whole = static_cast<int>(std::ceil(periods - 1e-9));
  if (k_ < whole) return outputs_of(x0_, -1, 0)(output);
  const double part = within_period(delay, model_.T);
  return (part > 0 ? outputs_in(k_ - whole, model_.T - part) : outputs_at(k_ - whole))(output);
}

VectorXd Truth::measure() {
  const TruthModel::Stage& stage = model_.stage_at(k_);
  VectorXd white(stage.noise_factor.cols());
  for (Index i = 0; i < white.size(); ++i) white(i) = noise_.normal();
  drawn_ = ordered_image(stage.noise_factor, white);
  outputs_ = outputs_at(k_);
  VectorXd y = outputs_;
  for (Index i = 0; i < model_.ny; ++i)
    if (model_.output_delay(i) > 0) y(i) = late_output(i);
  y += drawn_.tail(model_.ny);
  for (const design::Sensor& sensor : model_.scenario->sensor) {
    const double at_rest = entry(point_.y, sensor.output);
    y(sensor.output) = sensed(sensor, at_rest + y(sensor.output)) - at_rest;
  }
  return y;
}

VectorXd Truth::designed_state() const {
  const Index inputs = model_.nx + model_.added;  // what the filter adds costs nothing
  VectorXd x = VectorXd::Zero(inputs + model_.designed_delay * model_.nu);
  x.head(model_.nx) = x_.head(model_.nx);
  for (int i = 0; i < model_.designed_delay; ++i) {
    const int sample = k_ - model_.designed_delay + i;
    x.segment(inputs + i * model_.nu, model_.nu) =
        sample < 0 ? VectorXd(VectorXd::Zero(model_.nu)) : VectorXd(inputs_.col(place(sample)));
  }
  return x;
}

double Truth::cost() const {
  const TruthModel::Stage& stage = model_.stage_at(k_);
  if (stage.Q.size() == 0) return 0;
  const VectorXd x = designed_state(), u = inputs_.col(place(k_));
  return ordered_dot(x, ordered_image(stage.Q, x) + 2 * ordered_image(stage.N, u)) +
         ordered_dot(u, ordered_image(stage.R, u));
}

void Truth::advance() {
  x_ = moved(k_, model_.T);
  x_.head(model_.nx) += drawn_.head(model_.nx);
  ++k_;
  has_asked_ = false;
  states_.col(place(k_)) = x_;
}

}  // namespace lqg::simulate
