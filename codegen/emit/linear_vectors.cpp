#include "emit/linear_vectors.hpp"

#include "emit/linear_model_of.hpp"
#include "emit/plant_simulation.hpp"
#include "emit/reference_run.hpp"
#include "emit/rounding.hpp"
#include "step/loop.hpp"

namespace lqg::emit {

namespace {

using design::Real;
using step::Fused;
using step::Vector;

// u of each sample, and what the vectors show of it.
template <class S>
struct Run {
  std::vector<Sample> samples;
  std::vector<Vector<S>> u;
};

// One sample of the physical form that applies its u as it is. `measure` gives y once u is made (predictor form) or before.
template <class S, class Measure>
Vector<S> physical_sample(const step::Model<S>& model, step::State<S>& state, Sample& sample, Measure measure) {
  step::Listener listener;
  Vector<S> u;
  const auto act = [&] {
    sample.x = doubles(state.x);
    u = step::control(model, state, listener);
  };
  if (model.predictor_form) act();
  sample.y = measure(u);
  step::update(model, state, vector_of<S>(sample.y), listener);
  if (!model.predictor_form) act();
  step::predict(model, state, u, listener);
  sample.u = doubles(u);
  return u;
}

template <class S, class Round>
Run<S> simulate(const Controller& controller, Round round) {
  const step::Model<S> model = model_of<S>(controller, round);
  step::State<S> state = step::initial_state(model);
  PlantSimulation plant(controller, seed);
  Vector<double> applied = Vector<double>::Zero(controller.nu());
  Run<S> run;
  while (run.samples.size() < sample_count) {
    const auto apply = [&](const Vector<S>& u) {
      for (int i = 0; i < u.size(); ++i) applied(i) = to_target(as_double(u(i)), controller.is_double());
    };
    const auto measure = [&](const Vector<S>& u) {
      if (model.predictor_form) apply(u);
      std::vector<double> y = doubles(plant.measure(applied));
      for (double& value : y) value = to_target(value, controller.is_double());
      return y;
    };
    run.u.push_back(physical_sample(model, state, run.samples.emplace_back(), measure));
    apply(run.u.back());
    plant.advance(applied);
  }
  return run;
}

// u of each sample in the target's numbers S; `hear(k, u, x, z)` of a form that keeps z.
template <class S, class Hear>
std::vector<Vector<S>> run_linear(const Controller& controller, const std::vector<Sample>& samples, Hear hear) {
  const auto model = linear_model_of<S>(
      controller, [&](const Real& value) { return S(rounded_to_target(value, controller.is_double())); });
  step::LinearState<S> state = step::initial_state(model);
  step::Listener listener;
  std::vector<Vector<S>> all;
  for (const Sample& sample : samples) {
    Vector<S> u, x, z = state.z;
    step::run_sample(model, state, vector_of<S>(sample.y), u, [&](const step::LinearState<S>& now) {
      x = step::estimate(model, now, listener);
    });
    hear(all.size(), u, x, z);
    all.push_back(u);
  }
  return all;
}

template <class S>
std::vector<Vector<S>> run_physical(const Controller& controller, const std::vector<Sample>& samples) {
  const auto model =
      model_of<S>(controller, [&](const Real& value) { return S(rounded_to_target(value, controller.is_double())); });
  step::State<S> state = step::initial_state(model);
  std::vector<Vector<S>> all;
  for (const Sample& sample : samples) {
    Sample seen;
    all.push_back(physical_sample(model, state, seen, [&](const Vector<S>&) { return sample.y; }));
  }
  return all;
}

// Calls act(S()) with the scalar of the target.
template <class Act>
auto in_target(const Controller& controller, Act act) {
  if (controller.is_double()) return controller.is_fused() ? act(Fused<double>()) : act(double());
  return controller.is_fused() ? act(Fused<float>()) : act(float());
}

// Calls act(run) with the run of a reference of at least twice the target's digits.
template <class Act>
auto with_reference(const Controller& controller, Act act) {
  if (!controller.is_double()) return act(simulate<double>(controller, design::to_double));
  const design::Digits digits(reference_digits);
  return act(simulate<Real>(controller, [](const Real& value) { return Real(value, reference_digits); }));
}

template <class S>
void compare(const Controller& controller, Vectors& vectors) {
  Hash hash(controller.is_double());
  std::vector<double> largest_x, largest_u;
  run_linear<S>(controller, vectors.samples,
                [&](std::size_t k, const Vector<S>& u, const Vector<S>& x, const Vector<S>& z) {
                  const Sample& reference = vectors.samples[k];
                  widen(vectors.tolerance.x, doubles(x), reference.x);
                  widen(vectors.tolerance.u, doubles(u), reference.u);
                  widen(largest_x, reference.x, std::vector<double>(reference.x.size(), 0));
                  widen(largest_u, reference.u, std::vector<double>(reference.u.size(), 0));
                  for (const double value : doubles(z)) hash.add(value);
                  for (const double value : doubles(u)) hash.add(value);
                });
  finish(vectors.tolerance.x, largest_x, controller.is_double());
  finish(vectors.tolerance.u, largest_u, controller.is_double());
  vectors.hash = hash.value();
}

// The worst input's √(Σ (found − reference)² / Σ reference²).
template <class S, class Reference>
double relative_error(const std::vector<Vector<S>>& found, const std::vector<Vector<Reference>>& reference) {
  double worst = 0;
  for (int i = 0; i < reference.front().size(); ++i) {
    double errors = 0, sizes = 0;
    for (std::size_t k = 0; k < reference.size(); ++k) {
      const double size = as_double(reference[k](i));
      const double error = as_double(Reference(Reference(as_double(found[k](i))) - reference[k](i)));
      errors += error * error;
      sizes += size * size;
    }
    if (sizes > 0) worst = std::max(worst, std::sqrt(errors / sizes));
  }
  return worst;
}

}  // namespace

Vectors linear_vectors(const Controller& controller) {
  Vectors vectors;
  vectors.samples = with_reference(controller, [](const auto& run) { return run.samples; });
  in_target(controller, [&](auto zero) { compare<decltype(zero)>(controller, vectors); });
  return vectors;
}

double rounding_error(const Controller& controller) {
  return with_reference(controller, [&](const auto& run) {
    return in_target(controller, [&](auto zero) {
      using S = decltype(zero);
      if (!controller.linear) return relative_error(run_physical<S>(controller, run.samples), run.u);
      return relative_error(run_linear<S>(controller, run.samples, [](auto&&...) {}), run.u);
    });
  });
}

}  // namespace lqg::emit
