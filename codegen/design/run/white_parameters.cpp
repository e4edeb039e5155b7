// SPDX-License-Identifier: MIT
#include "design/run/white_parameters.hpp"

#include "design/equations/refined_stein.hpp"
#include "design/order/refined_moments.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

RealMatrix padded_or_zero(const Eigen::MatrixXd& a, Index rows, Index columns) {
  return a.size() > 0 ? padded(real(a), rows, columns) : zeros(rows, columns);
}

WhiteParameter dropout_of(const Plant& plant, Index output, const SampledPlant& sampled) {
  const Index nx = sampled.A.rows(), nu = sampled.B.cols(), ny = sampled.C.rows();
  const Real p = plant.dropout(output);
  WhiteParameter white = {zeros(nx, nx), zeros(nx, nu), zeros(ny, nx)};
  white.C.row(output).head(plant.C.cols()) = sqrt(Real(p * (1 - p))) * real(plant.C).row(output);
  return white;
}

WhiteParameter jitter_of(const Plant& plant, const SampledPlant& sampled) {
  const Real sigma = plant.jitter;
  return {sigma * multiply(real(plant.A), sampled.A), sigma * multiply(sampled.A, real(plant.B)),
          zeros(sampled.C.rows(), sampled.A.rows())};
}

std::vector<Eigen::MatrixXd> rounded(const std::vector<RealMatrix>& Phi) {
  std::vector<Eigen::MatrixXd> result;
  for (const RealMatrix& F : Phi) result.push_back(to_doubles(F));
  return result;
}

}  // namespace

std::vector<WhiteParameter> white_parameters(const Problem& problem, const Samples& samples) {
  const SampledPlant& plant = samples.plant;
  const Index nx = plant.A.rows(), nu = plant.B.cols(), ny = plant.C.rows();
  std::vector<WhiteParameter> all;
  for (const Uncertain& of : problem.uncertain)
    all.push_back({padded_or_zero(of.A, nx, nx), padded_or_zero(of.B, nx, nu), padded_or_zero(of.C, ny, nx)});
  for (Index i = 0; i < problem.plant.dropout.size(); ++i)
    if (problem.plant.dropout(i) > 0) all.push_back(dropout_of(problem.plant, i, plant));
  if (problem.plant.jitter > 0) all.push_back(jitter_of(problem.plant, plant));
  return all;
}

OrderProblem order_problem(const Problem& problem, const Samples& samples) {
  const MeasuredPlant plant = measured_plant(problem, samples.plant);
  const SampledCost& cost = samples.between ? samples.between->cost : *samples.cost;
  const SampledNoise& noise = *samples.noise;
  const Index nx = plant.A.rows(), nu = plant.B.cols(), ny = plant.C.rows();
  OrderProblem result;
  result.has_feedthrough = problem.estimator->form == Form::filter;
  result.A = plant.A, result.B = plant.B, result.C = plant.C;
  result.Q = padded(cost.Q, nx, nx), result.N = padded(cost.N, nx, nu), result.R = cost.R;
  result.W = congruence(plant.G, noise.W), result.Swv = multiply(plant.G, noise.Swv), result.V = noise.V;
  for (const WhiteParameter& white : white_parameters(problem, samples))
    result.white.push_back({padded(white.A, nx, nx), padded(white.B, nx, nu), padded(white.C, ny, nx)});
  return result;
}

std::optional<RealMatrix> steady_second_moments(const std::vector<RealMatrix>& Phi, const RealMatrix& V) {
  if (Phi.size() == 1) return refined_stein(Phi.front().transpose(), V);
  if (!(growth_of(Phi) < 1)) return std::nullopt;
  return order::refined_moments(order::MomentMap<double>(rounded(Phi), false), Phi, false, order::Side::moments, V, {});
}

WhiteLoop white_loop(const OrderProblem& problem, const MeasuredPlant& plant, const Compensator& controller) {
  const Index nx = plant.A.rows(), ns = controller.A.rows();
  const ClosedLoop loop = closed_loop({plant.A, plant.B, plant.C, plant.D, identity(nx)}, controller);
  WhiteLoop result = {{loop.A}, congruence(loop.B, joint(problem.W, problem.Swv, problem.V))};
  for (const WhiteParameter& white : problem.white) {
    const RealMatrix of_B = multiply(white.B, beside(multiply(controller.D, plant.C), controller.C));
    const RealMatrix of_C = multiply(plant.B, multiply(controller.D, white.C));
    result.Phi.push_back(
        above(beside(white.A + of_C, zeros(nx, ns)) + of_B, beside(multiply(controller.B, white.C), zeros(ns, ns))));
    result.V += padded(congruence(multiply(white.B, controller.D), problem.V), nx + ns, nx + ns);
  }
  return result;
}

std::optional<Real> white_cost(const OrderProblem& problem, const MeasuredPlant& plant, const Compensator& controller) {
  const WhiteLoop white = white_loop(problem, plant, controller);
  const std::optional<RealMatrix> P = steady_second_moments(white.Phi, white.V);
  if (!P) return std::nullopt;
  const Index nx = plant.A.rows(), ns = controller.A.rows();
  RealMatrix of_states = above(identity(nx + ns).topRows(nx), closed_loop(plant, controller).C);
  // u = C [x; z] + D v, in which a parameter of C counts, too.
  Real cost = trace_of_product(joint(problem.Q, problem.N, problem.R), congruence(of_states, *P));
  RealMatrix noise = congruence(controller.D, problem.V);
  for (const WhiteParameter& parameter : problem.white)
    noise += congruence(multiply(controller.D, parameter.C), P->topLeftCorner(nx, nx));
  cost += trace_of_product(problem.R, noise);
  return cost;
}

double growth_of(const std::vector<RealMatrix>& Phi) { return order::growth_of(rounded(Phi), false); }

}  // namespace lqg::design
