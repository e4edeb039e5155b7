// SPDX-License-Identifier: MIT
#include "design/loop/compensator.hpp"

#include "design/sampled/added_states.hpp"
#include "design/sampled/reference.hpp"

namespace lqg::design {

namespace {

bool has_filter_form(const Problem& problem) { return problem.estimator && problem.estimator->form == Form::filter; }

bool has_rate(const Problem& problem) { return problem.regulator->input_rate.size() > 0; }

// Signals of a sample as matrices over [x̂⁻; ξ; u[k−1]; y]: those four, then what follows from them.
struct Signals {
  RealMatrix estimate, integral, last, y;
  Index states;
};

Signals signals_of(Index nx, Index integrals, Index kept, Index ny) {
  const Index states = nx + integrals + kept;
  const RealMatrix all = identity(states + ny);
  return {all.topRows(nx), all.middleRows(nx, integrals), all.middleRows(nx + integrals, kept), all.bottomRows(ny),
          states};
}

// u = −K [x̂; ξ],  or  u[k−1] − K [x̂; ξ; u[k−1]].
RealMatrix law(const Problem& problem, const RealMatrix& K, const Signals& s, const RealMatrix& estimate) {
  const RealMatrix z = above(estimate, s.integral);
  if (!has_rate(problem)) return -multiply(K, z);
  return s.last - multiply(K, above(z, s.last));
}

Compensator system(const Signals& s, const RealMatrix& next, const RealMatrix& u) {
  const Index ny = s.y.rows();
  return {next.leftCols(s.states), next.rightCols(ny), u.leftCols(s.states),
          u.rightCols(ny),         s.estimate.rows(),  s.integral.rows()};
}

// ξ⁺ = ξ − T y of the integrated outputs, and u is kept where it is needed again.
RealMatrix next_memory(const Problem& problem, const Signals& s, const RealMatrix& outputs, const RealMatrix& u) {
  const RealMatrix moved = Real(problem.plant.sample_time) * rows_of(outputs, integrated_outputs(problem));
  return above(s.integral - moved, s.last.rows() > 0 ? u : s.last);
}

Compensator of_measured_state(const Problem& problem, const Solution& solution) {
  const SampledPlant& plant = final_plant(solution);
  const Index nx = plant.A.rows(), nu = plant.B.cols();
  const Signals s =
      signals_of(0, static_cast<Index>(integrated_outputs(problem).size()), has_rate(problem) ? nu : 0, nx);
  const RealMatrix u = law(problem, solution.regulator->K, s, s.y);
  const RealMatrix outputs = multiply(plant.C, s.y) + multiply(plant.D, u);
  return system(s, next_memory(problem, s, outputs, u), u);
}

}  // namespace

const SampledPlant& final_plant(const Solution& solution) {
  return solution.stages.empty() ? solution.plant : solution.stages.back().plant;
}

Compensator compensator(const Problem& problem, const Solution& solution) {
  if (const auto& own = solution.compensator) return {own->A, own->B, own->C, own->D, own->A.rows(), 0};
  if (!solution.estimator) return of_measured_state(problem, solution);
  const SampledPlant& plant = final_plant(solution);
  const EstimatorSolution& filter = *solution.estimator;
  const bool answers_at_once = has_filter_form(problem);
  const bool keeps = has_rate(problem) || (answers_at_once && !is_zero(plant.D));
  const Index nx = plant.A.rows(), nu = plant.B.cols();
  const Signals s =
      signals_of(nx, static_cast<Index>(integrated_outputs(problem).size()), keeps ? nu : 0, plant.C.rows());
  const RealMatrix e = s.y - multiply(plant.C, s.estimate);
  RealMatrix innovation = e, u;
  if (answers_at_once) {
    if (keeps) innovation -= multiply(plant.D, s.last);
    u = law(problem, solution.regulator->K, s, s.estimate + multiply(filter.L, innovation));
  } else {
    u = law(problem, solution.regulator->K, s, s.estimate);
    innovation -= multiply(plant.D, u);
  }
  const RealMatrix next = multiply(plant.A, s.estimate + multiply(filter.L, innovation)) + multiply(plant.B, u) +
                          multiply(filter.M, innovation);
  return system(s, above(next, next_memory(problem, s, s.y, u)), u);
}

bool is_separated(const Problem& problem, const SampledPlant& plant) {
  return !has_filter_form(problem) || is_zero(rows_of(plant.D, integrated_outputs(problem)));
}

MeasuredPlant measured_plant(const Problem& problem, const SampledPlant& plant) {
  const Index nx = plant.A.rows(), nu = plant.B.cols(), ny = plant.C.rows();
  if (!problem.estimator) return {plant.A, plant.B, identity(nx), zeros(nx, nu), plant.G};
  if (!has_filter_form(problem) || is_zero(plant.D)) return {plant.A, plant.B, plant.C, plant.D, plant.G};
  return {above(beside(plant.A, zeros(nx, nu)), zeros(nu, nx + nu)), above(plant.B, identity(nu)),
          beside(plant.C, plant.D), zeros(ny, nu), above(plant.G, zeros(nu, plant.G.cols()))};
}

MeasuredPlant measured_plant(const Problem& problem, const Solution& solution) {
  return measured_plant(problem, without_disturbances(problem, final_plant(solution)));
}

ClosedLoop closed_loop(const MeasuredPlant& plant, const Compensator& controller) {
  const Index nw = plant.G.cols(), ny = plant.C.rows();
  ClosedLoop loop;
  loop.C = beside(multiply(controller.D, plant.C), controller.C);
  loop.D = beside(zeros(controller.D.rows(), nw), controller.D);
  const RealMatrix y = beside(plant.C, multiply(plant.D, controller.C));
  loop.A = above(beside(plant.A, zeros(plant.A.rows(), controller.A.cols())) + multiply(plant.B, loop.C),
                 beside(zeros(controller.A.rows(), plant.A.cols()), controller.A) + multiply(controller.B, y));
  loop.B = above(beside(plant.G, zeros(plant.A.rows(), ny)) + multiply(plant.B, loop.D),
                 beside(zeros(controller.A.rows(), nw), controller.B));
  return loop;
}

}  // namespace lqg::design
