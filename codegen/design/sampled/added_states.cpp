// SPDX-License-Identifier: MIT
#include "design/sampled/added_states.hpp"

#include <cmath>
#include <numeric>

namespace lqg::design {

namespace {

// `count` rows of zeros before row `at`.
RealMatrix with_rows(const RealMatrix& a, Index at, Index count) {
  return above(above(a.topRows(at), zeros(count, a.cols())), a.bottomRows(a.rows() - at));
}

RealMatrix with_columns(const RealMatrix& a, Index at, Index count) {
  return beside(beside(a.leftCols(at), zeros(a.rows(), count)), a.rightCols(a.cols() - at));
}

RealMatrix with_both(const RealMatrix& a, Index at, Index count) {
  return with_columns(with_rows(a, at, count), at, count);
}

SampledCost with_states(const SampledCost& cost, Index at, Index count) {
  return {with_both(cost.Q, at, count), cost.R, with_rows(cost.N, at, count)};
}

RealMatrix without_rows(const RealMatrix& a, Index at, Index count) {
  return above(a.topRows(at), a.bottomRows(a.rows() - at - count));
}

RealMatrix without_columns(const RealMatrix& a, Index at, Index count) {
  return beside(a.leftCols(at), a.rightCols(a.cols() - at - count));
}

// [a 0; 0 corner]
RealMatrix with_corner(const RealMatrix& a, const RealMatrix& corner) {
  return above(beside(a, zeros(a.rows(), corner.cols())), beside(zeros(corner.rows(), a.cols()), corner));
}

// W of a walk whose G is its size: 1 of a density; of samples what gathers to as much in a second.
double variance_of_walk(const Problem& problem) {
  const double T = problem.plant.sample_time;
  if (problem.plant.domain == Domain::discrete) return T;
  return problem.estimator->noise == Noise::discrete ? 1 / T : 1;
}

void add_to_plant(const std::vector<InputDisturbance>& disturbances, Plant& plant) {
  const Digits scope(exact_digits);
  const Index count = static_cast<Index>(disturbances.size());
  const RealMatrix all_B = real(plant.B), all_D = real(plant.D);
  RealMatrix B(all_B.rows(), count), D(all_D.rows(), count), sizes = zeros(count, count);
  for (Index i = 0; i < count; ++i) {
    const InputDisturbance& disturbance = disturbances[static_cast<std::size_t>(i)];
    B.col(i) = all_B.col(disturbance.input);
    D.col(i) = all_D.col(disturbance.input);
    sizes(i, i) = disturbance.size;
    const std::size_t input = static_cast<std::size_t>(disturbance.input);
    if (input < plant.inputs.size())
      plant.states.push_back({plant.inputs[input].name + "_disturbance", plant.inputs[input].unit});
  }
  const bool is_discrete = plant.domain == Domain::discrete;
  const RealMatrix held = is_discrete ? identity(count) : zeros(count, count);
  plant.A = ExactMatrix::of(above(beside(real(plant.A), B), beside(zeros(count, all_B.rows()), held)));
  plant.B = ExactMatrix::of(above(all_B, zeros(count, all_B.cols())));
  plant.C = ExactMatrix::of(beside(real(plant.C), D));
  plant.G = ExactMatrix::of(with_corner(real(plant.G), sizes));
  plant.H = ExactMatrix::of(beside(real(plant.H), zeros(plant.H.rows(), count)));
}

// P0 is what a disturbance gathers in 10,000 samples: ten times its size in a sample, squared, with the default size a
// tenth of the input.
void add_to_estimator(const Problem& problem, Estimator& kalman) {
  constexpr double samples = 1e4, time_of_density = 0.5;  // s: a variance of 1 is a density of 1 then
  const Digits scope(exact_digits);
  const Index count = static_cast<Index>(kalman.disturbance.size());
  RealMatrix P0 = zeros(count, count);
  for (Index i = 0; i < count; ++i) {
    const double size = kalman.disturbance[static_cast<std::size_t>(i)].size;
    P0(i, i) = samples * problem.plant.sample_time * size * size;
  }
  kalman.W = ExactMatrix::of(with_corner(real(kalman.W), Real(variance_of_walk(problem)) * identity(count)));
  kalman.Swv = ExactMatrix::of(above(real(kalman.Swv), zeros(count, kalman.Swv.cols())));
  kalman.P0 = ExactMatrix::of(with_corner(real(kalman.P0), P0));
  kalman.x0.conservativeResizeLike(Eigen::VectorXd::Zero(kalman.x0.size() + count));
  Eigen::VectorXd& times = kalman.process_correlation_time;
  if (times.size() == 0) return;
  const Eigen::VectorXd given = times;
  times = Eigen::VectorXd::Constant(given.size() + count, time_of_density);
  times.head(given.size()) = given;
}

// [x; d] at rest and what it makes the late outputs: the plant stood at x0 before.
RealMatrix start_of(const std::vector<Index>& periods, Index late, const RealMatrix& C) {
  RealMatrix start = above(identity(C.cols()), zeros(late, C.cols()));
  Index row = C.cols();
  for (std::size_t i = 0; i < periods.size(); ++i)
    for (Index k = 0; k < periods[i]; ++k) start.row(row++) = C.row(static_cast<Index>(i));
  return start;
}

}  // namespace

std::vector<Index> periods_of_outputs(const Plant& plant) {
  std::vector<Index> periods(static_cast<std::size_t>(plant.C.rows()), 0);
  for (Index i = 0; i < plant.output_delay.size(); ++i)
    periods[static_cast<std::size_t>(i)] = static_cast<Index>(std::llround(plant.output_delay(i) / plant.sample_time));
  return periods;
}

Index disturbance_count(const Problem& problem) {
  return has_noise(problem.estimator) ? static_cast<Index>(problem.estimator->disturbance.size()) : 0;
}

Index late_output_count(const Problem& problem) {
  if (!problem.estimator) return 0;
  const std::vector<Index> periods = periods_of_outputs(problem.plant);
  return std::accumulate(periods.begin(), periods.end(), Index(0));
}

Index added_states(const Problem& problem) { return disturbance_count(problem) + late_output_count(problem); }

bool has_added_states(const Problem& problem) { return added_states(problem) > 0; }

Problem with_disturbances(const Problem& problem) {
  Problem filtered = problem;
  filtered.regulator.reset();
  if (disturbance_count(problem) == 0) return filtered;
  add_to_plant(problem.estimator->disturbance, filtered.plant);
  add_to_estimator(problem, *filtered.estimator);
  return filtered;
}

Samples with_late_outputs(const Problem& problem, const Samples& samples) {
  const Index late = late_output_count(problem), nx = samples.own_states;
  if (late == 0) return samples;
  const std::vector<Index> periods = periods_of_outputs(problem.plant);
  const SampledPlant& plant = samples.plant;
  Samples result = samples;
  result.own_states += late;
  result.start = start_of(periods, late, plant.C.leftCols(nx));
  result.plant.A = with_both(plant.A, nx, late);
  result.plant.B = with_rows(plant.B, nx, late);
  result.plant.C = with_columns(plant.C, nx, late);
  result.plant.G = with_rows(plant.G, nx, late);
  Index state = nx;
  for (Index i = 0; i < plant.C.rows(); ++i) {
    const Index count = periods[static_cast<std::size_t>(i)];
    if (count == 0) continue;
    result.plant.A.row(state) = with_columns(plant.C.row(i), nx, late);
    result.plant.B.row(state) = plant.D.row(i);
    for (Index k = 1; k < count; ++k) result.plant.A(state + k, state + k - 1) = 1;
    result.plant.C.row(i).setZero();
    result.plant.C(i, state + count - 1) = 1;
    result.plant.D.row(i).setZero();
    state += count;
  }
  if (samples.fictitious.size() > 0) result.fictitious = with_both(samples.fictitious, nx, late);
  if (samples.cost) result.cost = with_states(*samples.cost, nx, late);
  if (samples.between) result.between->cost = with_states(samples.between->cost, nx, late);
  return result;
}

Samples filter_model(const Problem& problem, const Problem& filtered, const Samples& own) {
  Samples model = with_late_outputs(problem, sample(filtered));
  const Index added = added_states(problem);
  if (own.cost) model.cost = with_states(*own.cost, own.own_states, added);
  return model;
}

namespace {

// −d is where u and the inputs on their way rest: u = −K z − d̂ + K [of d in z] (−d̂), or Δu alike without the d̂.
RealMatrix gain_of_disturbances(const Problem& problem, const RealMatrix& K) {
  const Index nx = problem.plant.A.rows(), nu = K.rows(), count = disturbance_count(problem);
  const bool is_change = problem.regulator->input_rate.size() > 0;
  const Index on_their_way = delay_of(problem.plant).samples;
  RealMatrix gain = zeros(nu, count);
  for (Index j = 0; j < count; ++j) {
    const Index input = problem.estimator->disturbance[static_cast<std::size_t>(j)].input;
    for (Index k = 0; k < on_their_way; ++k) gain.col(j) += K.col(nx + k * nu + input);
    if (is_change)
      gain.col(j) += K.col(K.cols() - nu + input);
    else
      gain(input, j) += 1;
  }
  return gain;
}

RealMatrix extended_gain(const Problem& problem, const RealMatrix& K) {
  const Index nx = problem.plant.A.rows();
  const RealMatrix added = beside(gain_of_disturbances(problem, K), zeros(K.rows(), late_output_count(problem)));
  return beside(beside(K.leftCols(nx), added), K.rightCols(K.cols() - nx));
}

}  // namespace

void add_states_to(const Problem& problem, RegulatorSolution& regulator) {
  const Index nx = problem.plant.A.rows(), added = added_states(problem);
  if (added == 0) return;
  regulator.K = extended_gain(problem, regulator.K);
  for (RealMatrix& K : regulator.K_schedule) K = extended_gain(problem, K);
  if (regulator.structure) regulator.structure->full = extended_gain(problem, regulator.structure->full);
  for (RealMatrix* X : {&regulator.X, &regulator.X0})
    if (X->size() > 0) *X = with_both(*X, nx, added);
  if (regulator.cost.R.size() > 0) regulator.cost = with_states(regulator.cost, nx, added);
  if (regulator.Nx.size() > 0) regulator.Nx = with_rows(regulator.Nx, nx, added);
  if (regulator.Gamma.size() > 0) regulator.Gamma = with_columns(regulator.Gamma, nx, added);
}

namespace {

SampledPlant without_states(const SampledPlant& plant, Index at, Index count) {
  return {without_columns(without_rows(plant.A, at, count), at, count), without_rows(plant.B, at, count),
          without_columns(plant.C, at, count), plant.D, without_rows(plant.G, at, count)};
}

}  // namespace

SampledPlant without_disturbances(const Problem& problem, const SampledPlant& plant) {
  return without_states(plant, problem.plant.A.rows(), disturbance_count(problem));
}

SampledPlant without_added_states(const Problem& problem, const SampledPlant& plant) {
  return without_states(plant, problem.plant.A.rows(), added_states(problem));
}

SampledCost without_added_states(const Problem& problem, const SampledCost& cost) {
  const Index at = problem.plant.A.rows(), count = added_states(problem);
  return {without_columns(without_rows(cost.Q, at, count), at, count), cost.R, without_rows(cost.N, at, count)};
}

}  // namespace lqg::design
