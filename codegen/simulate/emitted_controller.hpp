// SPDX-License-Identifier: MIT
// The emitted controller at work: the calls of its header for any scalar, with what they keep, count and say.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "controller/model_of_outputs.hpp"
#include "step/by_hand.hpp"
#include "step/innovation.hpp"
#include "step/loop.hpp"
#include "step/operating_point.hpp"
#include "step/partial_update.hpp"

namespace lqg::simulate {

using controller::Controller;
using step::Vector;

// A listener that counts what a gate leaves out, as the header does, and keeps which outputs were left out at all.
struct CountingListener : step::Listener {
  CountingListener(std::vector<unsigned long>& count, std::vector<bool>& out) : gated(count), left_out(out) {
    left_out.assign(left_out.size(), false);
  }
  bool accept(bool usable, int output) {
    left_out[static_cast<std::size_t>(output)] = !usable;
    return step::Listener::accept(usable, output);
  }
  bool accept(bool usable, bool believable, int output) {
    left_out[static_cast<std::size_t>(output)] = !usable;
    return step::Listener::accept(usable, believable, output);
  }
  void gate(bool is_gated, int output) {
    step::Listener::gate(is_gated, output);
    gated[static_cast<std::size_t>(output)] += is_gated;
    if (is_gated) left_out[static_cast<std::size_t>(output)] = true;
  }
  std::vector<unsigned long>& gated;
  std::vector<bool>& left_out;
};

// A controller that keeps x̂, or z of it. Each call is the one of that name in the header, limits, gate, faults and
// resets included, and returns the events that its status would tell: y, u, x and r are in the plant's own units.
// `constants` turns a number of the design into an S.
template <class S>
class EmittedController {
 public:
  using Constants = std::function<S(const design::Real&)>;

  EmittedController(const Controller& controller, Constants constants)
      : controller_(controller), constants_(std::move(constants)),
        gated_(static_cast<std::size_t>(controller.size.ny), 0), left_out_(gated_.size(), false) {
    init();
  }

  void init() {
    sample_ = gain_row_ = 0;
    resets_ = covariance_resets_ = 0;
    gated_.assign(gated_.size(), 0);
    load();
    state_ = step::initial_state(model_);
  }
  unsigned update(const Vector<S>& y) { return update_by(output_deviations(y)); }
  unsigned update_alone(int output, const S& y) {
    CountingListener listener(gated_, left_out_);
    const S deviation = step::output_deviation(model_.point, y, output, listener);
    return end(step::update_alone(model_, state_, deviation, output, listener), listener);
  }
  // `used` has a bit for each output.
  unsigned partial_update(const Vector<S>& y, unsigned long used) {
    const auto is_used = [used](Eigen::Index i) { return (used >> i & 1ul) != 0; };
    Vector<S> there = y;
    for (Eigen::Index i = 0; i < there.size(); ++i)
      if (!is_used(i)) there(i) = S(std::numeric_limits<double>::infinity());
    there = output_deviations(there);
    step::Listener listener;
    step::Model<S> as_they_are = outputs();
    const auto lost =
        step::lost_outputs(model_, step::innovations(as_they_are, state_, there, listener), there, listener);
    const unsigned events = update_by(there) & ~step::all_rejections();
    for (Eigen::Index i = 0; i < there.size(); ++i)
      listener.reject(static_cast<int>(i), is_used(i) && lost[static_cast<std::size_t>(i)]);
    return events | listener.events;
  }
  // The variances are empty where the header has none.
  void innovation(const Vector<S>& y, Vector<S>& nu, Vector<S>& variances) const {
    step::Model<S> as_they_are = outputs();
    step::Listener listener;
    nu = step::innovations(as_they_are, state_, output_deviations(y), listener);
    variances.resize(controller_.has.variance ? nu.size() : 0);
    for (Eigen::Index i = 0; i < variances.size(); ++i)
      variances(i) = step::innovation_variance(as_they_are, state_, static_cast<int>(i), listener);
  }
  // x̂
  Vector<S> estimate() const {
    step::Listener listener;
    return step::own_state(model_.point, step::estimate(model_, state_, listener), listener);
  }
  // The same from the operating point.
  Vector<S> estimated_deviation() const {
    step::Listener listener;
    Vector<S> x = step::estimate(model_, state_, listener);
    const Eigen::VectorXd point =
        controller::is_extended(controller_) ? controller::stated_point(controller_).x : Eigen::VectorXd();
    for (Eigen::Index i = 0; i < point.size(); ++i) x(i) = x(i) - S(point(i));
    return x;
  }
  unsigned set_state(const Vector<S>& x) {
    step::Listener listener;
    const Vector<S> deviations = step::state_deviations(model_.point, x, listener);
    return begin_anew_unless(step::set_state(model_, state_, deviations, listener), listener);
  }
  unsigned set_input(const Vector<S>& u) {
    step::Listener listener;
    const Vector<S> deviations = step::input_deviations(model_.point, u, listener);
    return begin_anew_unless(step::set_input(model_, state_, deviations, listener), listener);
  }
  // Of a regulator alone at the state x.
  unsigned set_input(const Vector<S>& x, const Vector<S>& u) {
    step::Listener listener;
    state_.x = step::state_deviations(model_.point, x, listener);
    return set_input(u);
  }
  // Beside a filter.
  unsigned control(Vector<S>& u) {
    step::Listener listener;
    u = step::own_input(model_.point, step::control(model_, state_, listener), listener);
    return listener.events;
  }
  unsigned predict(const Vector<S>& u) {
    step::Listener listener;
    const Vector<S> deviations = step::input_deviations(model_.point, u, listener);
    const bool within = step::predict(model_, state_, deviations, listener);
    advance_counters();
    return end(within, listener);
  }
  // A regulator alone, of the state x.
  unsigned control(const Vector<S>& x, Vector<S>& u) {
    step::Listener listener;
    state_.x = step::state_deviations(model_.point, x, listener);
    const bool within = step::act(model_, state_, u, listener);
    u = step::own_input(model_.point, u, listener);
    advance_counters();
    return end(within, listener);
  }

  const step::Model<S>& model() const { return model_; }  // of the sample that is to come
  step::State<S>& state() { return state_; }
  const step::State<S>& state() const { return state_; }
  unsigned long resets() const { return resets_; }
  unsigned long covariance_resets() const { return covariance_resets_; }
  const std::vector<unsigned long>& gated() const { return gated_; }
  const std::vector<bool>& left_out() const { return left_out_; }  // which outputs the last update did not use
  std::size_t sample() const { return sample_; }                   // the one that is to come; the last one that changes
  std::size_t gain_row() const { return gain_row_; }

 private:
  step::Model<S> outputs() const {
    step::Model<S> model = model_;
    controller::take_outputs_as_they_are(controller_, constants_, model);
    return model;
  }

  Vector<S> output_deviations(const Vector<S>& y) const {
    step::Listener listener;
    return step::output_deviations(model_.point, y, listener);
  }
  unsigned update_by(const Vector<S>& deviations) {
    CountingListener listener(gated_, left_out_);
    return end(step::update(model_, state_, deviations, listener), listener);
  }

  // The constants of this sample.
  void load() { model_ = controller::model_of<S>(controller_, constants_, sample_, gain_row_); }

  void advance_counters() {
    const std::size_t sample = std::min(sample_ + 1, controller_.last_sample);
    const std::size_t gain_row =
        controller_.keeps.gain_row ? std::min(gain_row_ + 1, controller_.filters.size() - 1) : 0;
    go_to(sample, gain_row);
  }
  void go_to(std::size_t sample, std::size_t gain_row) {
    if (sample == sample_ && gain_row == gain_row_) return;
    sample_ = sample;
    gain_row_ = gain_row;
    load();
  }

  // What NAME_recover does: P begins anew, or all.
  unsigned end(bool is_within, step::Listener& listener) {
    if (is_within || !step::carries_covariance(model_)) return begin_anew_unless(is_within, listener);
    const bool keeps_estimate = step::begin_covariance_anew(model_, state_, listener);
    covariance_resets_ += keeps_estimate;
    listener.raise(step::Event::covariance_reset, keeps_estimate);
    return begin_anew_unless(keeps_estimate, listener);
  }
  // What NAME_reset does: the time, the references and the counters stay.
  unsigned begin_anew_unless(bool is_within, step::Listener& listener) {
    if (is_within) return listener.events;
    step::begin_anew(model_, state_);
    go_to(sample_, 0);
    ++resets_;
    listener.raise(step::Event::state_reset, true);
    return listener.events;
  }

  const Controller& controller_;
  Constants constants_;
  step::Model<S> model_;
  step::State<S> state_;
  std::size_t sample_ = 0, gain_row_ = 0;
  unsigned long resets_ = 0, covariance_resets_ = 0;
  std::vector<unsigned long> gated_;
  std::vector<bool> left_out_;
};

}  // namespace lqg::simulate
