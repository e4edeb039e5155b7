// SPDX-License-Identifier: MIT
// Every matrix of a solution, one after the other.
#pragma once

#include "design/solution.hpp"

namespace lqg::design {

// Where a number of the solution ends up.
enum class Place { report, target };

namespace detail {

template <typename A, typename Visit>
void visit_plant(A& plant, Visit visit) {
  visit("plant.A", Place::target, plant.A);
  visit("plant.B", Place::target, plant.B);
  visit("plant.C", Place::target, plant.C);
  visit("plant.D", Place::target, plant.D);
  visit("plant.G", Place::report, plant.G);
}

template <typename A, typename Visit>
void visit_cost(A& cost, Visit visit) {
  visit("lqr.Q", Place::report, cost.Q);
  visit("lqr.R", Place::report, cost.R);
  visit("lqr.N", Place::report, cost.N);
}

template <typename A, typename Visit>
void visit_noise(A& noise, Visit visit) {
  visit("kalman.W", Place::report, noise.W);
  visit("kalman.V", Place::report, noise.V);
  visit("kalman.Swv", Place::report, noise.Swv);
}

template <typename A, typename Visit>
void visit_regulator(A& regulator, Visit visit) {
  visit_cost(regulator.cost, visit);
  visit("lqr.Q_final", Place::report, regulator.Q_final);
  visit("lqr.K", Place::target, regulator.K);
  visit("lqr.X", Place::report, regulator.X);
  if (regulator.structure) visit("lqr.structure", Place::report, regulator.structure->full);
  for (auto& K : regulator.K_schedule) visit("lqr.schedule", Place::target, K);
  visit("lqr.X0", Place::report, regulator.X0);
  visit("lqr.Nx", Place::target, regulator.Nx);
  visit("lqr.Nu", Place::target, regulator.Nu);
  visit("lqr.Nbar", Place::target, regulator.Nbar);
  visit("lqr.Gamma", Place::report, regulator.Gamma);
  visit("lqr.H", Place::target, regulator.H);
}

template <typename A, typename Visit>
void visit_estimator(A& estimator, Visit visit) {
  visit_noise(estimator.noise, visit);
  visit("kalman.L", Place::target, estimator.L);
  visit("kalman.M", Place::target, estimator.M);
  visit("kalman.L_predictor", Place::report, estimator.L_predictor);
  visit("kalman.P_prior", Place::report, estimator.P_prior);
  visit("kalman.P_posterior", Place::report, estimator.P_posterior);
  visit("kalman.S", Place::report, estimator.S);
  visit("kalman.recovery", Place::report, estimator.fictitious);
  visit("kalman.L_continuous", Place::report, estimator.L_continuous);
  visit("kalman.P_continuous", Place::report, estimator.P_continuous);
  if (estimator.structure) visit("kalman.structure", Place::report, estimator.structure->full);
  for (auto& L : estimator.L_schedule) visit("kalman.schedule", Place::target, L);
  for (auto& M : estimator.M_schedule) visit("kalman.schedule", Place::target, M);
}

template <typename A, typename Visit>
void visit_online(A& online, Visit visit) {
  visit("kalman.E", Place::target, online.E);
  visit("kalman.C", Place::target, online.C);
  visit("kalman.D", Place::target, online.D);
  visit("kalman.V", Place::target, online.V);
  visit("kalman.M", Place::target, online.M);
  visit("kalman.A_free", Place::target, online.A_free);
  visit("kalman.W", Place::target, online.W);
  visit("kalman.G", Place::target, online.G);
  visit("kalman.w", Place::target, online.w);
  visit("kalman.P0", Place::target, online.P0);
  visit("kalman.U0", Place::target, online.U0);
  visit("kalman.D0", Place::target, online.D0);
}

template <typename A, typename Visit>
void visit_stage(A& stage, Visit visit) {
  visit_plant(stage.plant, visit);
  if (stage.noise) visit_noise(*stage.noise, visit);
  if (stage.cost) visit_cost(*stage.cost, visit);
  if (stage.online) visit_online(*stage.online, visit);
}

template <typename A, typename Visit>
void visit_rows(A& rows, Visit visit) {
  visit("limits.F", Place::target, rows.F);
  visit("limits.G", Place::target, rows.G);
  visit("limits.scale", Place::target, rows.scale);
}

template <typename A, typename Visit>
void visit_compensator(A& compensator, Visit visit) {
  visit("compensator.A", Place::target, compensator.A);
  visit("compensator.B", Place::target, compensator.B);
  visit("compensator.C", Place::target, compensator.C);
  visit("compensator.D", Place::target, compensator.D);
  visit("compensator.T", Place::report, compensator.T);
  visit("compensator.P", Place::report, compensator.P);
  visit("compensator.expected", Place::target, compensator.expected);
  visit("compensator.estimate", Place::target, compensator.estimate);
  visit("compensator.heard", Place::target, compensator.heard);
  visit("compensator.of_state", Place::target, compensator.of_state);
  visit("compensator.keep", Place::target, compensator.keep);
  visit("compensator.A_continuous", Place::report, compensator.A_continuous);
  visit("compensator.B_continuous", Place::report, compensator.B_continuous);
  visit("compensator.C_continuous", Place::report, compensator.C_continuous);
}

}  // namespace detail

// visit(name, place, matrix or vector) for every one; `A` is Solution or const Solution.
template <typename A, typename Visit>
void for_each_matrix(A& solution, Visit visit) {
  detail::visit_plant(solution.plant, visit);
  if (solution.start) visit("kalman.initial_state", Place::report, solution.start->x0);
  if (solution.start) visit("kalman.initial_covariance", Place::report, solution.start->P0);
  if (solution.noise) detail::visit_noise(*solution.noise, visit);
  if (solution.regulator) detail::visit_regulator(*solution.regulator, visit);
  if (solution.estimator) detail::visit_estimator(*solution.estimator, visit);
  if (solution.online) detail::visit_online(*solution.online, visit);
  for (auto& stage : solution.stages) detail::visit_stage(stage, visit);
  if (solution.compensator) detail::visit_compensator(*solution.compensator, visit);
  if (solution.white) visit("uncertain.K_unaware", Place::report, solution.white->K_unaware);
  if (solution.foreseen) detail::visit_rows(*solution.foreseen, visit);
}

}  // namespace lqg::design
