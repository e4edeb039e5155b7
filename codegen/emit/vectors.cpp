#include "emit/vectors.hpp"

#include <algorithm>
#include <cmath>

#include "emit/linear_vectors.hpp"
#include "emit/model_of.hpp"
#include "emit/plant_simulation.hpp"
#include "emit/reference_run.hpp"
#include "emit/rounding.hpp"
#include "step/loop.hpp"

namespace lqg::emit {

namespace {

using design::Real;
using step::Fused;
using step::Vector;

constexpr int bits_to_bound = 8;  // a plant that nobody stabilises leaves: the vectors end 2⁸ before a bound

// P, lower triangle, of either covariance form; empty with a steady gain.
template <class S>
std::vector<double> covariance(const step::Model<S>& model, const step::State<S>& state) {
  std::vector<double> out;
  for (const S& entry : state.P) out.push_back(as_double(entry));
  if (model.filter != step::Filter::ud) return out;
  for (int i = 0; i < model.nx; ++i)
    for (int j = 0; j <= i; ++j) {
      S sum = i == j ? state.D[i] : S(state.U[step::strict_triangle(j, i)] * state.D[i]);
      for (int k = i + 1; k < model.nx; ++k)
        sum = sum + state.U[step::strict_triangle(j, k)] * state.D[k] * state.U[step::strict_triangle(i, k)];
      out.push_back(as_double(sum));
    }
  return out;
}

// The constants of each sample.
template <class S>
class Timeline {
 public:
  template <class Round>
  Timeline(const Controller& controller, Round round) {
    const std::size_t rows = std::max(controller.last_sample() + 1, controller.filters.size());
    for (std::size_t k = 0; k < std::min(rows, sample_count); ++k) models_.push_back(model_of<S>(controller, round, k));
  }
  const step::Model<S>& at(std::size_t sample) const { return models_[std::min(sample, models_.size() - 1)]; }

 private:
  std::vector<step::Model<S>> models_;
};

// Feeds recorded outputs and inputs to the step; what it answers goes to `hear`.
template <class S, class Hear>
void replay(const Timeline<S>& models, const std::vector<Sample>& inputs, Hear hear) {
  step::State<S> state = step::initial_state(models.at(0));
  step::Listener listener;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const step::Model<S>& model = models.at(k);
    Vector<S> u(0);
    state.r = vector_of<S>(inputs[k].r);
    if (model.filter == step::Filter::none) {
      state.x = vector_of<S>(inputs[k].y);
      step::act(model, state, u, listener);
      hear(state, u);
      continue;
    }
    const auto act = [&] {
      if (model.K.rows()) u = step::control(model, state, listener);
    };
    if (model.predictor_form) act();
    // These outputs are those of the recorded u. With a D they would drive away an estimate that thinks of its own.
    if (model.predictor_form && step::has_feedthrough(model)) state.u = vector_of<S>(inputs[k].u);
    step::update(model, state, vector_of<S>(inputs[k].y), listener);
    if (!model.predictor_form) act();
    hear(state, u);
    step::predict(model, state, vector_of<S>(inputs[k].u), listener);
  }
}

// References that jump from time to time.
std::vector<double> references(const Controller& controller, std::size_t sample) {
  constexpr std::size_t samples_between_jumps = 40;
  Noise noise(seed + 2 + sample / samples_between_jumps);
  std::vector<double> r;
  for (int i = 0; i < controller.nr(); ++i) r.push_back(to_target(2 * noise.uniform(), controller.is_double()));
  return r;
}

// Now and then something far off, for the gate.
void add_outlier(std::size_t sample, std::vector<double>& y) {
  constexpr std::size_t every = 17;
  if (sample % every == 0) y[sample / every % y.size()] = 1024;
}

bool is_near(const Controller& controller, const Eigen::VectorXd& x) {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (!(std::abs(x(i)) < std::ldexp(1.0, controller.bounds.x[static_cast<std::size_t>(i)] - bits_to_bound))) return false;
  return true;
}

// The closed loop of simulated plant and reference: fills in y and the applied u, as numbers of the target.
template <class S>
std::vector<Sample> simulate(const Controller& controller, const Timeline<S>& models) {
  PlantSimulation plant(controller, seed);
  Noise excitation(seed + 1);
  step::State<S> state = step::initial_state(models.at(0));
  Vector<double> applied = Vector<double>::Zero(controller.nu());
  std::vector<Sample> samples;
  while (samples.size() < sample_count && is_near(controller, plant.state())) {
    const step::Model<S>& model = models.at(samples.size());
    step::Listener listener;
    Sample& sample = samples.emplace_back();
    sample.r = references(controller, samples.size() - 1);
    state.r = vector_of<S>(sample.r);
    const auto act = [&] {
      for (int i = 0; i < model.nu; ++i) applied(i) = excitation.uniform();
      if (!model.K.rows()) return;
      const Vector<S> u = step::control(model, state, listener);
      for (int i = 0; i < model.nu; ++i) applied(i) = as_double(u(i));
    };
    if (model.predictor_form) act();
    for (const double y : doubles(plant.measure(applied))) sample.y.push_back(to_target(y, controller.is_double()));
    if (controller.gates()) add_outlier(samples.size(), sample.y);
    step::update(model, state, vector_of<S>(sample.y), listener);
    if (!model.predictor_form) act();
    for (int i = 0; i < model.nu; ++i) applied(i) = to_target(applied(i), controller.is_double());
    sample.u = doubles(applied);
    step::predict(model, state, vector_of<S>(sample.u), listener);
    plant.advance(applied);
  }
  return samples;
}

template <class S>
void record_reference(const Timeline<S>& models, std::vector<Sample>& samples, std::vector<std::vector<double>>& u) {
  std::size_t k = 0;
  replay(models, std::vector<Sample>(samples), [&](const step::State<S>& state, const Vector<S>& control) {
    samples[k].x = doubles(state.x);
    samples[k].P = covariance(models.at(k), state);
    if (models.at(k).filter == step::Filter::none) samples[k].u = doubles(control);
    u.push_back(doubles(control));
    ++k;
  });
}

// Every bit of a sample in the order of the emitted test.
template <class S>
void add_sample(bool has_filter, const step::State<S>& state, const Vector<S>& control, Hash& hash) {
  const auto add_all = [&](const auto& values) {
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(values.size()); ++i)
      hash.add(as_double(values[static_cast<std::size_t>(i)]));
  };
  if (has_filter) add_all(doubles(state.x));
  add_all(state.P);
  add_all(state.U);
  add_all(state.D);
  add_all(doubles(state.xi));
  add_all(doubles(control));
}

// Runs the target's precision S beside the reference; fills in tolerances and the hash.
template <class S>
void compare(const Controller& controller, Vectors& vectors, const std::vector<std::vector<double>>& u) {
  const bool is_double = controller.is_double();
  const Timeline<S> models(controller, [&](const Real& value) { return S(rounded_to_target(value, is_double)); });
  Hash hash(is_double);
  std::vector<double> largest_x, largest_u, largest_P;
  std::size_t k = 0;
  replay(models, vectors.samples, [&](const step::State<S>& state, const Vector<S>& control) {
    const Sample& reference = vectors.samples[k];
    const std::vector<double> P = covariance(models.at(k), state);
    widen(vectors.tolerance.x, doubles(state.x), reference.x);
    widen(vectors.tolerance.u, doubles(control), u[k]);
    widen(vectors.tolerance.P, P, reference.P);
    widen(largest_x, reference.x, std::vector<double>(reference.x.size(), 0));
    widen(largest_u, u[k], std::vector<double>(u[k].size(), 0));
    widen(largest_P, reference.P, std::vector<double>(reference.P.size(), 0));
    add_sample(controller.has_filter(), state, control, hash);
    ++k;
  });
  finish(vectors.tolerance.x, largest_x, is_double);
  finish(vectors.tolerance.u, largest_u, is_double);
  finish(vectors.tolerance.P, largest_P, is_double);
  vectors.hash = hash.value();
}

// States that a regulator alone may meet.
std::vector<Sample> random_states(const Controller& controller) {
  Noise noise(seed);
  std::vector<Sample> samples(sample_count);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k].r = references(controller, k);
    for (int i = 0; i < controller.nx(); ++i)
      samples[k].y.push_back(to_target(noise.normal(), controller.is_double()));
  }
  return samples;
}

template <class Reference, class Round>
void fill_in(const Controller& controller, Round round, Vectors& vectors) {
  const Timeline<Reference> models(controller, round);
  vectors.samples = controller.has_filter() ? simulate(controller, models) : random_states(controller);
  std::vector<std::vector<double>> u;
  record_reference(models, vectors.samples, u);
  if (controller.is_double()) {
    if (controller.is_fused()) compare<Fused<double>>(controller, vectors, u);
    else compare<double>(controller, vectors, u);
  } else {
    if (controller.is_fused()) compare<Fused<float>>(controller, vectors, u);
    else compare<float>(controller, vectors, u);
  }
}

}  // namespace

Vectors make_vectors(const Controller& controller) {
  if (controller.linear) return linear_vectors(controller);
  Vectors vectors;
  if (controller.is_double()) {
    const design::Digits digits(reference_digits);
    fill_in<Real>(controller, [](const Real& value) { return Real(value, reference_digits); }, vectors);
  } else {
    fill_in<double>(controller, design::to_double, vectors);
  }
  return vectors;
}

}  // namespace lqg::emit
