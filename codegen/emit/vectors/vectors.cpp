// SPDX-License-Identifier: MIT
#include "emit/vectors/vectors.hpp"

#include <algorithm>
#include <cmath>

#include "controller/operating_point.hpp"
#include "design/numeric/digits.hpp"
#include "emit/vectors/comparison.hpp"
#include "emit/vectors/extended_plant.hpp"
#include "emit/vectors/linear_vectors.hpp"
#include "simulate/emitted_controller.hpp"
#include "simulate/plant.hpp"
#include "step/covariance.hpp"

namespace lqg::emit {

namespace {

using design::Real;
using simulate::as_double;
using simulate::EmittedController;
using simulate::in_target;
using simulate::Noise;
using step::Vector;

constexpr int bits_to_bound = 8;  // a plant that nobody stabilises leaves: the vectors end 2⁸ before a bound

// P, lower triangle; empty with a steady gain.
template <class S>
std::vector<double> covariance(const EmittedController<S>& emitted) {
  std::vector<double> out;
  for (const S& entry : step::covariance(emitted.model(), emitted.state())) out.push_back(as_double(entry));
  return out;
}

// What is applied: what the law gave; of an estimator alone what is given. Returns the events of control.
template <class S>
unsigned act(EmittedController<S>& emitted, Vector<S>& u) {
  return emitted.model().K.rows() ? emitted.control(u) : 0;
}

// Feeds recorded outputs and inputs to the emitted controller; what it answers goes to `hear`, with the events of
// control.
template <class S, class Hear>
void replay(EmittedController<S>& emitted, const std::vector<Sample>& inputs, Hear hear) {
  for (const Sample& input : inputs) {
    const step::Model<S>& model = emitted.model();
    step::State<S>& state = emitted.state();
    Vector<S> u(0);
    state.r = numbers_of<S>(input.r);
    if (model.filter == step::Filter::none) {
      const unsigned events = emitted.control(numbers_of<S>(input.y), u);
      hear(emitted, u, events);
      continue;
    }
    unsigned events = 0;
    if (model.predictor_form) events = act(emitted, u);
    // These outputs are those of the recorded u. With a D they would drive away an estimate that thinks of its own.
    if (model.predictor_form && step::has_feedthrough(model)) {
      step::Listener listener;
      state.u = step::input_deviations(model.point, numbers_of<S>(input.u), listener);
    }
    emitted.update(numbers_of<S>(input.y));
    if (!model.predictor_form) events = act(emitted, u);
    hear(emitted, u, events);
    emitted.predict(numbers_of<S>(input.u));
  }
}

// References that jump from time to time.
std::vector<double> references(const Controller& controller, std::size_t sample) {
  constexpr std::size_t samples_between_jumps = 40;
  Noise noise(seed + 2 + sample / samples_between_jumps);
  Eigen::VectorXd r(controller.size.nr);
  for (double& each : r) each = 2 * noise.uniform();
  return list_of(in_target(controller.target, controller::in_own_units(r, controller.point.r)));
}

// Now and then something far off, for the gate.
void add_outlier(std::size_t sample, std::vector<double>& y) {
  constexpr std::size_t every = 17;
  if (sample % every == 0) y[sample / every % y.size()] = 1024;
}

// What sensors with ranges would deliver. Without a range the limits of an output are empty.
void keep_in_range(const Controller& controller, std::vector<double>& y) {
  const Eigen::VectorXd least = in_target(controller.target, controller::own_output_range(controller, +1)),
                        most = in_target(controller.target, controller::own_output_range(controller, -1));
  for (Eigen::Index i = 0; i < least.size(); ++i) {
    double& each = y[static_cast<std::size_t>(i)];
    each = std::clamp(each, least(i), most(i));
  }
}

bool is_near(const Controller& controller, const Eigen::VectorXd& x) {
  if (controller.physical && !is_near(*controller.physical, x)) return false;
  const Eigen::VectorXd kept =
      controller.modal ? Eigen::VectorXd(design::to_doubles(controller.modal->inverse) * x) : x;
  for (Eigen::Index i = 0; i < kept.size(); ++i)
    if (!(std::abs(kept(i)) < std::ldexp(1.0, controller.bounds.x[static_cast<std::size_t>(i)] - bits_to_bound)))
      return false;
  return true;
}

// The closed loop of simulated plant and reference: fills in y and the applied u, as numbers of the target.
template <class S, class AnyPlant>
std::vector<Sample> closed_loop(const Controller& controller, EmittedController<S> emitted, AnyPlant plant) {
  Noise excitation(seed + 1);
  const Eigen::VectorXd at_rest =
      controller::in_own_units(Eigen::VectorXd::Zero(controller.size.nu), controller.point.u);
  Eigen::VectorXd applied = at_rest;
  std::vector<Sample> samples;
  while (samples.size() < sample_count && is_near(controller, plant.deviation())) {
    Sample& sample = samples.emplace_back();
    sample.r = references(controller, samples.size() - 1);
    emitted.state().r = numbers_of<S>(sample.r);
    const auto apply = [&] {
      applied = at_rest;
      for (double& each : applied) each += excitation.uniform();
      Vector<S> u;
      act(emitted, u);
      if (u.size()) applied = simulate::as_doubles(u);
    };
    if (controller.is_predictor) apply();
    sample.y = list_of(in_target(controller.target, plant.measure(applied)));
    if (controller.has.filter && controller.problem.estimator->gate > 0) add_outlier(samples.size(), sample.y);
    if (controller.has.filter) keep_in_range(controller, sample.y);
    emitted.update(numbers_of<S>(sample.y));
    if (!controller.is_predictor) apply();
    applied = in_target(controller.target, applied);
    sample.u = list_of(applied);
    emitted.predict(numbers_of<S>(sample.u));
    plant.advance(applied);
  }
  return samples;
}

template <class S>
std::vector<Sample> samples_of_filter(const Controller& controller, const EmittedController<S>& emitted) {
  if (controller::is_extended(controller)) return closed_loop(controller, emitted, ExtendedPlant(controller, seed));
  return closed_loop(controller, emitted,
                     simulate::Plant(controller, controller.x0, simulate::PlantNoise::assumed, seed));
}

template <class S>
void record_reference(EmittedController<S> emitted, std::vector<Sample>& samples, std::vector<std::vector<double>>& u) {
  std::size_t k = 0;
  replay(emitted, std::vector<Sample>(samples),
         [&](const EmittedController<S>& now, const Vector<S>& control, unsigned) {
           samples[k].x = list_of(now.estimate());
           samples[k].P = covariance(now);
           if (now.model().filter == step::Filter::none) samples[k].u = list_of(control);
           u.push_back(list_of(control));
           ++k;
         });
}

// Every bit of a sample in the order of the emitted test.
template <class S>
void add_sample(bool has_filter, const step::State<S>& state, const Vector<S>& control, Hash& hash) {
  if (has_filter) hash.add_all(list_of(state.x));
  hash.add_all(state.P);
  hash.add_all(state.U);
  hash.add_all(state.D);
  hash.add_all(list_of(state.xi));
  hash.add_all(list_of(control));
}

// Runs the target's precision S beside the reference; fills in tolerances, the hash and the samples at a limit.
template <class S>
void compare(const Controller& controller, Vectors& vectors, const std::vector<std::vector<double>>& u) {
  EmittedController<S> emitted(controller, simulate::constants_of<S>(controller.target));
  Hash hash(controller.target.is_double);
  Errors of_x, of_u, of_P;
  std::size_t k = 0;
  replay(emitted, vectors.samples, [&](const EmittedController<S>& now, const Vector<S>& control, unsigned events) {
    const Sample& reference = vectors.samples[k];
    of_x.add(list_of(now.estimate()), reference.x);
    of_u.add(list_of(control), u[k]);
    of_P.add(covariance(now), reference.P);
    add_sample(controller.has.filter, now.state(), control, hash);
    vectors.limited += static_cast<int>(events >> static_cast<unsigned>(step::Event::input_limited) & 1u);
    ++k;
  });
  const bool is_double = controller.target.is_double;
  vectors.tolerance = {of_x.tolerances(is_double), of_u.tolerances(is_double), of_P.tolerances(is_double)};
  vectors.hash = hash.value();
}

// States that a regulator alone may meet.
std::vector<Sample> random_states(const Controller& controller) {
  Noise noise(seed);
  std::vector<Sample> samples(sample_count);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k].r = references(controller, k);
    Eigen::VectorXd x(controller.size.nx);
    for (double& each : x) each = noise.normal();
    samples[k].y = list_of(in_target(controller.target, controller::in_own_units(x, controller.point.x)));
  }
  return samples;
}

// What the reference records: samples, and u of each.
struct Recorded {
  std::vector<Sample> samples;
  std::vector<std::vector<double>> u;
};

template <class Reference>
Recorded recorded_by(const Controller& controller, const EmittedController<Reference>& reference) {
  Recorded recorded;
  recorded.samples = controller.has.filter ? samples_of_filter(controller, reference) : random_states(controller);
  record_reference(reference, recorded.samples, recorded.u);
  return recorded;
}

// By the controller that keeps x̂, whatever this one keeps.
Recorded recorded(const Controller& controller) {
  const Controller& of = controller.physical ? *controller.physical : controller;
  if (!controller.target.is_double)
    return recorded_by(controller,
                       EmittedController<double>(of, [](const Real& value) { return design::to_double(value); }));
  const design::Digits digits(reference_digits);
  return recorded_by(controller,
                     EmittedController<Real>(of, [](const Real& value) { return Real(value, reference_digits); }));
}

Vectors samples_of(const Controller& controller) {
  if (controller.linear) return linear_vectors(controller);
  Recorded all = recorded(controller);
  Vectors vectors;
  vectors.samples = std::move(all.samples);
  simulate::with_scalar_of(controller.target, [&](auto zero) { compare<decltype(zero)>(controller, vectors, all.u); });
  return vectors;
}

// Of each entry √(Σ error² / Σ reference²), the worst.
class RelativeErrors {
 public:
  void add(const std::vector<double>& found, const std::vector<double>& reference) {
    errors_.resize(found.size(), 0), sizes_.resize(found.size(), 0);
    for (std::size_t i = 0; i < found.size(); ++i) {
      errors_[i] += (found[i] - reference[i]) * (found[i] - reference[i]);
      sizes_[i] += reference[i] * reference[i];
    }
  }
  double worst() const {
    double most = 0;
    for (std::size_t i = 0; i < errors_.size(); ++i)
      if (sizes_[i] > 0) most = std::max(most, std::sqrt(errors_[i] / sizes_[i]));
    return most;
  }
  // Of the root mean squares over so many samples, in parts of √P_ii.
  double worst_beside(const std::vector<double>& P, std::size_t samples) const {
    double most = 0;
    for (std::size_t i = 0; i < errors_.size(); ++i) {
      const double variance = P[static_cast<std::size_t>(step::triangle(static_cast<int>(i), static_cast<int>(i)))];
      const double square = errors_[i] / static_cast<double>(samples);
      if (square > 0) most = std::max(most, std::sqrt(square / std::max(variance, 0.0)));
    }
    return most;
  }

 private:
  std::vector<double> errors_, sizes_;
};

}  // namespace

RoundingOfFilter rounding_of_filter(const Controller& controller) {
  const Recorded all = recorded(controller);
  return simulate::with_scalar_of(controller.target, [&](auto zero) {
    using S = decltype(zero);
    EmittedController<S> emitted(controller, simulate::constants_of<S>(controller.target));
    RelativeErrors of_x, of_u;
    std::size_t k = 0;
    replay(emitted, all.samples, [&](const EmittedController<S>& now, const Vector<S>& control, unsigned) {
      of_x.add(list_of(now.estimate()), all.samples[k].x);
      of_u.add(list_of(control), all.u[k]);
      ++k;
    });
    return RoundingOfFilter{std::max(of_x.worst(), of_u.worst()),
                            of_x.worst_beside(all.samples.back().P, all.samples.size())};
  });
}

Vectors make_vectors(const Controller& controller) {
  Vectors vectors = samples_of(controller);
  vectors.calls = make_calls(controller, vectors.samples);
  return vectors;
}

}  // namespace lqg::emit
