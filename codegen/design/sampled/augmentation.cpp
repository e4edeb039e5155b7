// SPDX-License-Identifier: MIT
#include "design/sampled/augmentation.hpp"

#include "design/numeric/elimination.hpp"

namespace lqg::design {

namespace {

Index integrals_of(const Problem& problem) {
  return problem.regulator->integral ? static_cast<Index>(problem.regulator->integral->outputs.size()) : 0;
}

// [x; ξ]⁺ with ξ⁺ = hold ξ − step (C_i x + D_i u).
RegulatedPlant with_integrals(const Problem& problem, const RegulatedPlant& plant, const RealMatrix& C,
                              const RealMatrix& D, const Real& hold, const Real& step) {
  const Index integrals = integrals_of(problem);
  if (integrals == 0) return plant;
  const std::vector<int>& outputs = problem.regulator->integral->outputs;
  return {above(beside(plant.A, zeros(plant.A.rows(), integrals)),
                beside(-step * rows_of(C, outputs), hold * identity(integrals))),
          above(plant.B, -step * rows_of(D, outputs))};
}

SampledCost with_integral_weight(const SampledCost& cost, const RealMatrix& Q) {
  return {joint(cost.Q, zeros(cost.Q.rows(), Q.rows()), Q), cost.R, above(cost.N, zeros(Q.rows(), cost.R.rows()))};
}

// u = p + Δu:  [Q N; Nᵀ R] over [x; p],  [N; R] across,  R + S of Δu.
SampledCost with_rate_weight(const SampledCost& cost, const RealMatrix& S) {
  return {joint(cost.Q, cost.N, cost.R), cost.R + S, above(cost.N, cost.R)};
}

RiccatiEquation continuous_equation(const Problem& problem, const SampledCost& weights) {
  const Plant& plant = problem.plant;
  const RegulatedPlant dynamics =
      with_integrals(problem, {real(plant.A), real(plant.B)}, real(plant.C), real(plant.D), Real(0), Real(1));
  const SampledCost cost =
      integrals_of(problem) > 0 ? with_integral_weight(weights, real(problem.regulator->integral->Q)) : weights;
  const RealMatrix shifted = dynamics.A + decay_of(problem) * identity(dynamics.A.rows());
  return {shifted, dynamics.B, cost.Q, cost.R, cost.N};
}

}  // namespace

RealMatrix rows_of(const RealMatrix& from, const std::vector<int>& rows) {
  RealMatrix chosen(static_cast<Index>(rows.size()), from.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) chosen.row(static_cast<Index>(i)) = from.row(rows[i]);
  return chosen;
}

RegulatedPlant regulated_plant(const Problem& problem, const SampledPlant& plant) {
  const RegulatedPlant base =
      with_integrals(problem, {plant.A, plant.B}, plant.C, plant.D, Real(1), Real(problem.plant.sample_time));
  if (problem.regulator->input_rate.size() == 0) return base;
  const Index nz = base.A.rows(), nu = base.B.cols();
  return {above(beside(base.A, base.B), beside(zeros(nu, nz), identity(nu))), above(base.B, identity(nu))};
}

SampledCost regulated_cost(const Problem& problem, const SampledCost& cost) {
  const Regulator& lqr = *problem.regulator;
  SampledCost result = cost;
  if (lqr.integral) {
    const Real period = lqr.cost == Cost::discrete ? Real(1) : Real(problem.plant.sample_time);
    result = with_integral_weight(result, period * real(lqr.integral->Q));
  }
  return lqr.input_rate.size() > 0 ? with_rate_weight(result, real(lqr.input_rate)) : result;
}

Real decay_of(const Problem& problem) {
  const Regulator& lqr = *problem.regulator;
  const bool is_continuous = lqr.cost == Cost::continuous;
  if (lqr.decay) return Real(*lqr.decay);
  if (!lqr.settling_time) return is_continuous ? Real(0) : Real(1);
  const Real rate = log(Real(100)) / Real(*lqr.settling_time);
  return is_continuous ? rate : exp(rate * Real(problem.plant.sample_time));
}

RiccatiEquation regulator_equation(const Problem& problem, const Samples& samples) {
  if (problem.regulator->cost == Cost::continuous) return continuous_equation(problem, *samples.cost);
  const RegulatedPlant plant = regulated_plant(problem, samples.plant);
  const SampledCost cost = regulated_cost(problem, *samples.cost);
  const Real alpha = decay_of(problem);
  return {alpha * plant.A, alpha * plant.B, cost.Q, cost.R, cost.N};
}

void check_set_points(const SampledPlant& plant, const std::vector<int>& outputs, const std::string& key,
                      Findings& findings) {
  const Index nx = plant.A.rows(), nu = plant.B.cols(), held = static_cast<Index>(outputs.size());
  if (held > nu)
    return add_error(findings, key,
                     std::to_string(nu) + (nu == 1 ? " input" : " inputs") + " cannot hold " + std::to_string(held) +
                         " outputs: at most as many as there are inputs");
  const RealMatrix CD = beside(rows_of(plant.C, outputs), rows_of(plant.D, outputs));
  if (eliminated(CD).rank < held)
    return add_error(findings, key, "these outputs depend on each other: they have no set points of their own");
  const auto rank_at = [&](const Real& z) {
    return eliminated(above(beside(plant.A - z * identity(nx), plant.B), CD)).rank;
  };
  if (rank_at(Real(1)) == nx + held) return;
  if (rank_at(sqrt(Real(3))) < nx + held)  // no zero is there but by chance
    add_error(findings, key,
              "the inputs do not move these outputs independently: no constant input holds them at a set point");
  else
    add_error(findings, key,
              "the plant has a zero at z = 1 (s = 0) from its inputs to these outputs: no constant input holds "
              "them at a set point");
}

}  // namespace lqg::design
