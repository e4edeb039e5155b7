#include "design/samples.hpp"

#include "design/sampling.hpp"

namespace lqg::design {

namespace {

bool noise_is_sampled(const Problem& problem) {
  return has_noise(problem.estimator) && problem.estimator->noise == Noise::continuous;
}

bool cost_is_integral(const Problem& problem) {
  return has_cost(problem.regulator) && problem.regulator->cost != Cost::discrete;
}

// Does the integral see w as an input that is held: noise of that kind, or the part of it that v tells.
bool cost_sees_held_noise(const Problem& problem) {
  return has_noise(problem.estimator) && cost_is_integral(problem)
         && (!noise_is_sampled(problem) || !problem.estimator->Swv.isZero(0));
}

SampledCost weights_of(const Regulator& regulator) {
  return {real(regulator.Q), real(regulator.R), real(regulator.N)};
}

// [Q N 0; Nᵀ R 0; 0 0 0] over z = [x; held].
RealMatrix cost_density(const Regulator& regulator, Index held) {
  const Index nx = regulator.Q.rows(), nu = regulator.R.rows();
  RealMatrix cost = zeros(nx + held, nx + held);
  cost.topLeftCorner(nx, nx) = real(regulator.Q);
  cost.block(0, nx, nx, nu) = real(regulator.N);
  cost.block(nx, 0, nu, nx) = real(regulator.N.transpose());
  cost.block(nx, nx, nu, nu) = real(regulator.R);
  return cost;
}

SampledNoise sampled_noise(const Estimator& estimator, const RealMatrix& W, const RealMatrix& held_G,
                           const Real& sample_time) {
  const RealMatrix cross = multiply(held_G, real(estimator.Swv));
  return {W, real(estimator.V) / sample_time, cross / sample_time};
}

BetweenSamples between_samples(const Problem& problem, const SampledPeriod& period, bool held_noise) {
  const Index nx = problem.plant.A.rows(), nu = problem.plant.B.cols(), nw = problem.plant.G.cols();
  BetweenSamples between;
  between.cost = {period.cost.topLeftCorner(nx, nx), period.cost.block(nx, nx, nu, nu),
                  period.cost.block(0, nx, nx, nu)};
  between.noise_cost = period.noise_cost;
  if (!held_noise) return between;
  between.u_noise = period.cost.block(nx, nx + nu, nu, nw);
  if (noise_is_sampled(problem))
    between.u_noise /= Real(problem.plant.sample_time);
  else
    between.noise_cost += trace_of_product(period.cost.bottomRightCorner(nw, nw), real(problem.estimator->W));
  return between;
}

Samples continuous_samples(const Problem& problem) {
  const Plant& plant = problem.plant;
  const Index nu = plant.B.cols(), nw = plant.G.cols();
  const bool held_noise = cost_sees_held_noise(problem);
  const RealMatrix A = real(plant.A), B = real(plant.B), G = real(plant.G);

  HeldPlant held = {A, held_noise ? beside(B, G) : B, RealMatrix(), RealMatrix()};
  if (cost_is_integral(problem)) held.cost = cost_density(*problem.regulator, held.B.cols());
  if (noise_is_sampled(problem)) held.noise = congruence(G, real(problem.estimator->W));
  const SampledPeriod period = sample(held, plant.sample_time);
  RealMatrix held_G = period.B.rightCols(held_noise ? nw : 0);
  if (!held_noise && !(noise_is_sampled(problem) && problem.estimator->Swv.isZero(0)))
    held_G = sample(HeldPlant{A, G, RealMatrix(), RealMatrix()}, plant.sample_time).B;
  if (held_G.cols() == 0) held_G = zeros(G.rows(), nw);  // times a cross noise that is zero

  Samples samples;
  samples.plant = {period.A, period.B.leftCols(nu), real(plant.C), real(plant.D),
                   noise_is_sampled(problem) ? identity(A.rows()) : held_G};
  if (noise_is_sampled(problem))
    samples.noise = sampled_noise(*problem.estimator, period.noise, held_G, plant.sample_time);
  if (cost_is_integral(problem)) {
    samples.between = between_samples(problem, period, held_noise);
    if (problem.regulator->cost == Cost::sampled) samples.cost = samples.between->cost;
  }
  return samples;
}

}  // namespace

Samples sample(const Problem& problem) {
  const Plant& plant = problem.plant;
  Samples samples;
  if (plant.domain == Domain::continuous)
    samples = continuous_samples(problem);
  else
    samples.plant = {real(plant.A), real(plant.B), real(plant.C), real(plant.D), real(plant.G)};
  if (has_cost(problem.regulator) && !samples.cost) samples.cost = weights_of(*problem.regulator);
  if (has_noise(problem.estimator) && !samples.noise)
    samples.noise =
        SampledNoise{real(problem.estimator->W), real(problem.estimator->V), real(problem.estimator->Swv)};
  return samples;
}

}  // namespace lqg::design
