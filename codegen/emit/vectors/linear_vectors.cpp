// SPDX-License-Identifier: MIT
#include "emit/vectors/linear_vectors.hpp"

#include <algorithm>
#include <cmath>

#include "controller/operating_point.hpp"
#include "design/numeric/digits.hpp"
#include "emit/vectors/comparison.hpp"
#include "simulate/emitted_controller.hpp"
#include "simulate/emitted_form.hpp"
#include "simulate/plant.hpp"

namespace lqg::emit {

namespace {

using design::Real;
using simulate::as_double;
using simulate::EmittedController;
using simulate::EmittedForm;
using simulate::in_target;
using step::Vector;

// u of each sample, and what the vectors show of it.
template <class S>
struct Run {
  std::vector<Sample> samples;
  std::vector<Vector<S>> u;
};

// One sample of the physical form that applies its u as it is. `measure` gives y once u is made (predictor form) or
// before.
template <class S, class Measure>
Vector<S> physical_sample(EmittedController<S>& emitted, Sample& sample, Measure measure) {
  Vector<S> u;
  const auto act = [&] {
    sample.x = list_of(emitted.estimate());
    emitted.control(u);
  };
  const bool predicts = emitted.model().predictor_form;
  if (predicts) act();
  sample.y = measure(u);
  emitted.update(numbers_of<S>(sample.y));
  if (!predicts) act();
  emitted.predict(u);
  sample.u = list_of(u);
  return u;
}

// The same of a compensator of a given order, which has no other form than its own.
template <class S, class Measure>
Vector<S> physical_sample(EmittedForm<S>& emitted, Sample& sample, Measure measure) {
  Vector<S> u;
  const bool predicts = emitted.model().predictor_form;
  const auto act = [&](const Vector<S>& y) {
    emitted.control(y, u);
    sample.x = list_of(emitted.estimate());
  };
  if (predicts) act({});
  sample.y = measure(u);
  const Vector<S> y = numbers_of<S>(sample.y);
  if (!predicts) act(y);
  emitted.advance(y);
  sample.u = list_of(u);
  return u;
}

// Of a compensator that is unstable by itself few: it is played the outputs of another run, from which it parts. What a
// rounding error has grown to then is at most a 256th of what it was added to.
std::size_t samples_of(const Controller& controller) {
  if (!controller.solution.compensator) return sample_count;
  double growth = 1;
  for (const std::complex<double>& pole : controller.solution.compensator->poles)
    growth = std::max(growth, std::abs(pole));
  const double bits = controller.target.is_double ? 53 - 8 : 24 - 8;
  const double most = growth > 1 ? bits * std::log(2.0) / std::log(growth) : static_cast<double>(sample_count);
  return static_cast<std::size_t>(std::clamp(most, 4.0, static_cast<double>(sample_count)));
}

template <class S, template <class> class Emitted>
Run<S> closed_loop(const Controller& controller, Emitted<S> emitted) {
  simulate::Plant plant(controller, controller.x0, simulate::PlantNoise::assumed, seed);
  Eigen::VectorXd applied =
      controller::in_own_units(Eigen::VectorXd::Zero(controller.size.nu), controller::stated_point(controller).u);
  Run<S> run;
  const std::size_t count = samples_of(controller);
  while (run.samples.size() < count) {
    const auto apply = [&](const Vector<S>& u) { applied = in_target(controller.target, simulate::as_doubles(u)); };
    const auto measure = [&](const Vector<S>& u) {
      if (controller.is_predictor) apply(u);
      return list_of(in_target(controller.target, plant.measure(applied)));
    };
    run.u.push_back(physical_sample(emitted, run.samples.emplace_back(), measure));
    apply(run.u.back());
    plant.advance(applied);
  }
  return run;
}

// u of each sample in the target's numbers S; `hear(k, u, x, z)` of a form that keeps z.
template <class S, class Hear>
std::vector<Vector<S>> run_linear(const Controller& controller, const std::vector<Sample>& samples, Hear hear) {
  EmittedForm<S> emitted(controller, simulate::constants_of<S>(controller.target));
  std::vector<Vector<S>> all;
  for (const Sample& sample : samples) {
    const Vector<S> y = numbers_of<S>(sample.y), z = emitted.state().z;
    Vector<S> u;
    emitted.control(y, u);
    const Vector<S> x = emitted.estimate();
    emitted.advance(y);
    hear(all.size(), u, x, z);
    all.push_back(u);
  }
  return all;
}

template <class S>
std::vector<Vector<S>> run_physical(const Controller& controller, const std::vector<Sample>& samples) {
  EmittedController<S> emitted(controller, simulate::constants_of<S>(controller.target));
  std::vector<Vector<S>> all;
  for (const Sample& sample : samples) {
    Sample seen;
    all.push_back(physical_sample(emitted, seen, [&](const Vector<S>&) { return sample.y; }));
  }
  return all;
}

template <class S, class Round>
Run<S> reference_run(const Controller& controller, Round round) {
  if (controller.solution.compensator) return closed_loop(controller, EmittedForm<S>(controller, round));
  return closed_loop(controller, EmittedController<S>(controller, round));
}

// Calls act(run) with the run of a reference of at least twice the target's digits.
template <class Act>
auto with_reference(const Controller& controller, Act act) {
  if (!controller.target.is_double)
    return act(reference_run<double>(controller, [](const Real& value) { return design::to_double(value); }));
  const design::Digits digits(reference_digits);
  return act(reference_run<Real>(controller, [](const Real& value) { return Real(value, reference_digits); }));
}

template <class S>
void compare(const Controller& controller, Vectors& vectors) {
  const bool is_double = controller.target.is_double;
  Hash hash(is_double);
  Errors of_x, of_u;
  run_linear<S>(controller, vectors.samples,
                [&](std::size_t k, const Vector<S>& u, const Vector<S>& x, const Vector<S>& z) {
                  of_x.add(list_of(x), vectors.samples[k].x);
                  of_u.add(list_of(u), vectors.samples[k].u);
                  hash.add_all(list_of(z));
                  hash.add_all(list_of(u));
                });
  vectors.tolerance = {of_x.tolerances(is_double), of_u.tolerances(is_double), {}};
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
  simulate::with_scalar_of(controller.target, [&](auto zero) { compare<decltype(zero)>(controller, vectors); });
  return vectors;
}

double rounding_error(const Controller& controller) {
  return with_reference(controller, [&](const auto& run) {
    return simulate::with_scalar_of(controller.target, [&](auto zero) {
      using S = decltype(zero);
      if (!controller.linear) return relative_error(run_physical<S>(controller, run.samples), run.u);
      return relative_error(run_linear<S>(controller, run.samples, [](auto&&...) {}), run.u);
    });
  });
}

}  // namespace lqg::emit
