// SPDX-License-Identifier: MIT
#include "design/sampled/samples.hpp"

#include "design/equations/sampling.hpp"
#include "design/sampled/noise.hpp"
#include "design/sampled/weights.hpp"

namespace lqg::design {

namespace {

bool noise_is_sampled(const Problem& problem) {
  return has_noise(problem.estimator) && problem.estimator->noise == Noise::continuous;
}

bool cost_is_integral(const Problem& problem) {
  return has_cost(problem.regulator) && problem.regulator->cost != Cost::discrete;
}

// Does the integral see w as an input that is held: noise of that kind, or the part of it that v tells.
bool cost_sees_held_noise(const Problem& problem, const SampledNoise& noise) {
  return has_noise(problem.estimator) && cost_is_integral(problem) &&
         (!noise_is_sampled(problem) || !noise.Swv.isZero(0));
}

// xᵀQx + uᵀRu + 2xᵀNu over z = [x; held] with u from row `at` on.
RealMatrix cost_density(const SampledCost& weights, Index held, Index at) {
  const Index nx = weights.Q.rows(), nu = weights.R.rows();
  RealMatrix cost = zeros(nx + held, nx + held);
  cost.topLeftCorner(nx, nx) = weights.Q;
  cost.block(0, at, nx, nu) = weights.N;
  cost.block(at, 0, nu, nx) = weights.N.transpose();
  cost.block(at, at, nu, nu) = weights.R;
  return cost;
}

// The continuous plant whose held inputs are [old; new; w], one of the first two acting.
struct Segments {
  RealMatrix A, B, G;  // G is empty where w is not followed through the period
  std::optional<SampledCost> cost;
  RealMatrix noise;

  SampledPeriod over(const Real& time, bool is_old) const {
    const Index nx = A.rows(), nu = B.cols(), held = 2 * nu + G.cols(), at = is_old ? 0 : nu;
    HeldPlant plant = {A, zeros(nx, held), RealMatrix(), noise};
    plant.B.middleCols(at, nu) = B;
    plant.B.rightCols(G.cols()) = G;
    if (cost) plant.cost = cost_density(*cost, held, nx + at);
    return sample(plant, time);
  }
};

SampledPeriod period_of(const Segments& segments, const Delay& delay, const Real& T) {
  if (delay.samples == 0) return segments.over(T, false);
  const SampledPeriod first = segments.over(delay.part, true);
  return delay.is_whole ? first : followed_by(first, segments.over(T - delay.part, false));
}

// `cost` over [x; old; new; w], as one over [z; u; w].
BetweenSamples between_samples(const Problem& problem, const SampledPeriod& period, const SampledNoise& noise,
                               Index samples, Index held_noises) {
  const Index nx = problem.plant.A.rows(), nu = problem.plant.B.cols(), nw = held_noises;
  const Index nz = nx + samples * nu;
  const RealMatrix select = acting_inputs(nx, nu, nw, samples);
  const RealMatrix cost = transpose_congruence(select, period.cost);
  BetweenSamples between;
  between.cost = {cost.topLeftCorner(nz, nz), cost.block(nz, nz, nu, nu), cost.block(0, nz, nz, nu)};
  between.noise_cost = period.noise_cost;
  if (nw == 0) return between;
  between.u_noise = cost.block(nz, nz + nu, nu, nw);
  if (noise_is_sampled(problem))
    between.u_noise /= Real(problem.plant.sample_time);
  else
    between.noise_cost += trace_of_product(cost.bottomRightCorner(nw, nw), noise.W);
  return between;
}

// The file's weights of the samples, over [z; u]: of u what was decided at the sample, of y what was measured then.
SampledCost weights_of_samples(const Problem& problem, Index samples) {
  if (samples == 0) return weights_of(problem);
  const SampledCost stated = stated_weights(problem), outputs = output_weights(problem);
  const Index nx = stated.Q.rows(), nu = stated.R.rows(), nz = nx + samples * nu;
  SampledCost cost = {zeros(nz, nz), stated.R, zeros(nz, nu)};
  cost.Q.topLeftCorner(nx, nx) = stated.Q + outputs.Q;
  cost.Q.block(0, nx, nx, nu) = outputs.N;
  cost.Q.block(nx, 0, nu, nx) = outputs.N.transpose();
  cost.Q.block(nx, nx, nu, nu) = outputs.R;
  cost.N.topRows(nx) = stated.N;
  return cost;
}

// C x as it is in the mean, where an output drops out.
RealMatrix mean_outputs(const Plant& plant) {
  RealMatrix C = real(plant.C);
  for (Index i = 0; i < plant.dropout.size(); ++i) C.row(i) *= 1 - Real(plant.dropout(i));
  return C;
}

// C and D of what is sampled: D u of the input that acts then.
void add_outputs(const Plant& plant, Index samples, SampledPlant& sampled) {
  const Index nx = plant.A.rows(), nu = plant.B.cols(), ny = plant.C.rows();
  sampled.C = zeros(ny, nx + samples * nu);
  sampled.C.leftCols(nx) = mean_outputs(plant);
  sampled.D = samples == 0 ? real(plant.D) : zeros(ny, nu);
  if (samples > 0) sampled.C.middleCols(nx, nu) = real(plant.D);
}

void take_moves(const RealMatrix& moves, Index nu, Index samples, SampledPlant& sampled) {
  const RealMatrix AB = with_inputs_on_their_way(moves, nu, samples);
  sampled.A = AB.leftCols(AB.rows());
  sampled.B = AB.rightCols(nu);
}

SampledNoise of_samples(const SampledNoise& density, const RealMatrix& W, const RealMatrix& held_G,
                        const Real& sample_time) {
  return {W, density.V / sample_time, multiply(held_G, density.Swv) / sample_time};
}

// The discrete noise of an extended filter: what a sample adds to the states, with the file's G.
bool comes_at_samples(const Problem& problem) { return problem.estimator && problem.estimator->extended; }

// G of noise that is held over a period, or zeros where nothing needs it.
RealMatrix held_noise_input(const Problem& problem, const SampledNoise& noise, const RealMatrix& A,
                            const RealMatrix& G) {
  if (noise_is_sampled(problem) && noise.Swv.isZero(0)) return zeros(G.rows(), G.cols());
  return sample(HeldPlant{A, G, RealMatrix(), RealMatrix()}, Real(problem.plant.sample_time)).B;
}

Samples continuous_samples(const Problem& problem, const Delay& delay) {
  const Plant& plant = problem.plant;
  const Index nx = plant.A.rows(), nu = plant.B.cols(), nw = plant.G.cols();
  const Real T = plant.sample_time;
  const SampledNoise noise = has_noise(problem.estimator) ? noise_of(problem) : SampledNoise();
  const bool held_noise = !comes_at_samples(problem) && cost_sees_held_noise(problem, noise);
  const RealMatrix G = real(plant.G);
  Segments segments = {real(plant.A), real(plant.B), held_noise ? G : zeros(nx, 0), std::nullopt, RealMatrix()};
  if (cost_is_integral(problem)) segments.cost = weights_of(problem);
  if (noise_is_sampled(problem)) segments.noise = congruence(G, noise.W);
  const SampledPeriod period = period_of(segments, delay, T);

  Samples samples;
  take_moves(beside(period.A, period.B.leftCols(2 * nu)), nu, delay.samples, samples.plant);
  const RealMatrix held_G =
      held_noise ? RealMatrix(period.B.rightCols(nw)) : held_noise_input(problem, noise, segments.A, G);
  const RealMatrix own_G = noise_is_sampled(problem) ? identity(nx) : comes_at_samples(problem) ? G : held_G;
  samples.plant.G = padded(own_G, samples.plant.A.rows(), own_G.cols());
  if (noise_is_sampled(problem)) samples.noise = of_samples(noise, period.noise, held_G, T);
  if (!cost_is_integral(problem)) return samples;
  samples.between = between_samples(problem, period, noise, delay.samples, held_noise ? nw : 0);
  if (problem.regulator->cost == Cost::sampled) samples.cost = samples.between->cost;
  return samples;
}

Samples discrete_samples(const Plant& plant, const Delay& delay) {
  const Index nx = plant.A.rows(), nu = plant.B.cols();
  const RealMatrix none = zeros(nx, nu), B = real(plant.B);
  Samples samples;
  const RealMatrix inputs = delay.samples == 0 ? beside(none, B) : beside(B, none);
  take_moves(beside(real(plant.A), inputs), nu, delay.samples, samples.plant);
  samples.plant.G = padded(real(plant.G), samples.plant.A.rows(), plant.G.cols());
  return samples;
}

// q B Bᵀ of recovery over all states, with B of the samples: the noise is held like the inputs, which a loop that is
// opened there needs; its variance is the density over a period. It is white, so that a delay changes nothing.
RealMatrix fictitious_noise(const Problem& problem, Index states) {
  const Plant& plant = problem.plant;
  const Real q = problem.estimator->recovery->q, T = plant.sample_time;
  const bool is_discrete = plant.domain == Domain::discrete;
  const RealMatrix B =
      is_discrete ? real(plant.B) : sample(HeldPlant{real(plant.A), real(plant.B), RealMatrix(), RealMatrix()}, T).B;
  return padded((is_discrete ? q : Real(q / T)) * multiply_transpose(B, B), states, states);
}

}  // namespace

Samples sample(const Problem& problem) { return sample(problem, delay_of(problem.plant)); }

Samples sample(const Problem& problem, const Delay& delay) {
  const Plant& plant = problem.plant;
  Samples samples =
      plant.domain == Domain::continuous ? continuous_samples(problem, delay) : discrete_samples(plant, delay);
  samples.own_states = plant.A.rows();
  add_outputs(plant, delay.samples, samples.plant);
  if (has_cost(problem.regulator) && !samples.cost) samples.cost = weights_of_samples(problem, delay.samples);
  if (has_noise(problem.estimator) && !samples.noise) samples.noise = noise_of(problem);
  if (has_noise(problem.estimator) && problem.estimator->recovery)
    samples.fictitious = fictitious_noise(problem, samples.plant.A.rows());
  return samples;
}

SampledPlant own_plant(const Samples& samples) {
  const Index nx = samples.own_states;
  const SampledPlant& plant = samples.plant;
  return {plant.A.topLeftCorner(nx, nx), RealMatrix(), plant.C.leftCols(nx), RealMatrix(), plant.G.topRows(nx)};
}

RealMatrix initial_state(const Estimator& estimator, const Samples& samples) {
  const RealMatrix own = real(estimator.x0);
  return padded(samples.start.size() > 0 ? multiply(samples.start, own) : own, samples.plant.A.rows(), 1);
}

RealMatrix initial_covariance(const Estimator& estimator, const Samples& samples) {
  const Index all = samples.plant.A.rows();
  const RealMatrix own = real(estimator.P0);
  return padded(samples.start.size() > 0 ? congruence(samples.start, own) : own, all, all);
}

}  // namespace lqg::design
