// SPDX-License-Identifier: MIT
// From the solution in many digits to the constants of a step, rounded once.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "controller/controller.hpp"
#include "controller/equations_of.hpp"
#include "controller/limit_of_target.hpp"
#include "controller/operating_point.hpp"
#include "controller/stage_in_force.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/rounding.hpp"
#include "step/model.hpp"

namespace lqg::controller {

template <class S, class Round>
step::Matrix<S> convert(const design::RealMatrix& from, Round round) {
  step::Matrix<S> to(from.rows(), from.cols());
  for (int i = 0; i < from.rows(); ++i)
    for (int j = 0; j < from.cols(); ++j) to(i, j) = round(from(i, j));
  return to;
}

template <class S, class Round>
void convert_online(const Controller& controller, Round round, std::size_t sample, step::Model<S>& model) {
  const design::OnlineSolution& online = kept_online_at(controller, sample);
  const design::OnlineSolution& first = controller.modal ? online : *controller.solution.online;
  model.E = convert<S>(online.E, round);
  model.C = convert<S>(online.C, round);
  if (controller.has.feedthrough) model.D = convert<S>(online.D, round);
  if (controller.problem.estimator->extended) model.equations = equations_of<S>(controller, round);
  if (controller.keeps.innovation) model.M = convert<S>(online.M, round);
  model.V = convert<S>(online.V, round);
  model.A_free = convert<S>(online.A_free, round);
  model.W = convert<S>(online.W, round);
  model.G = convert<S>(online.G, round);
  model.w = convert<S>(online.w, round);
  for (int i = 0; i < model.nx; ++i) {
    for (int j = 0; j <= i; ++j)
      if (model.filter == step::Filter::plain) model.P0.push_back(round(first.P0(i, j)));
    if (model.filter == step::Filter::ud) model.D0.push_back(round(first.D0(i)));
  }
  if (model.filter != step::Filter::ud) return;
  for (int j = 0; j < model.nx; ++j)
    for (int k = 0; k < j; ++k) model.U0.push_back(round(first.U0(k, j)));
}

// The gains of a sample; the last ones are held.
inline const Gains& row_of(const std::vector<Gains>& rows, std::size_t sample) {
  return rows[std::min(sample, rows.size() - 1)];
}

template <class S, class Round>
void convert_steady(const Controller& controller, Round round, std::size_t sample, std::size_t gain_row,
                    step::Model<S>& model) {
  const Gains& gains = row_of(controller.filters, gain_row);
  const design::SampledPlant& plant = plant_at(controller, sample);
  model.C = convert<S>(plant.C, round);
  if (controller.has.feedthrough) model.D = convert<S>(plant.D, round);
  model.L = convert<S>(gains[0], round);
  if (controller.keeps.innovation) model.M = convert<S>(gains[1], round);
  if (controller.has.gate)
    model.variance = convert<S>(gains[2], round);
  else if (controller.has.variance)
    model.variance = convert<S>(controller.solution.estimator->S.diagonal(), round);
}

template <class S>
step::Vector<S> convert_limits(const Eigen::VectorXd& from, int inward, bool is_double) {
  step::Vector<S> to(from.size());
  for (int i = 0; i < from.size(); ++i) to(i) = S(limit_of_target(from(i), inward, is_double));
  return to;
}

// u_rate T, rounded down; the largest number where there is no limit.
inline Eigen::VectorXd rate_steps(const Controller& controller) {
  const double largest = controller.target.is_double ? std::numeric_limits<double>::max()
                                                     : static_cast<double>(std::numeric_limits<float>::max());
  return (controller.problem.limits->u_rate * controller.problem.plant.sample_time).cwiseMin(largest);
}

template <class S, class Round>
step::LimitedLaw<S> limited_law_of(const Controller& controller, Round round) {
  const design::LimitedRows& rows = *controller.solution.foreseen;
  const bool is_double = controller.target.is_double;
  step::LimitedLaw<S> law;
  law.nu = controller.size.nu;
  law.iterations = controller.iterations.most;
  law.F = convert<S>(rows.F, round);
  law.G = convert<S>(rows.G, round);
  law.scale = convert<S>(rows.scale, round);
  law.low = convert_limits<S>(design::to_doubles(rows.low), +1, is_double);
  law.high = convert_limits<S>(design::to_doubles(rows.high), -1, is_double);
  if (controller.point.u.size()) {
    law.low.head(law.nu) = input_limits(controller, +1).template cast<S>();
    law.high.head(law.nu) = input_limits(controller, -1).template cast<S>();
  }
  law.tolerance = convert<S>(rows.tolerance, round);
  if (controller.has.rate_limit) law.u_step = convert_limits<S>(rate_steps(controller), -1, is_double);
  return law;
}

// u + K x of the operating point: the law of an extended filter is u − K (x̂ − x).
template <class S, class Round>
step::Vector<S> begin_law(const Controller& controller, Round round) {
  const Point point = stated_point(controller);
  const design::Digits digits(std::max(controller.solution.numerics.digits, 50u));
  const design::RealMatrix& K = controller.solution.regulator->K;
  step::Vector<S> begun(controller.size.nu);
  for (Eigen::Index i = 0; i < begun.size(); ++i) {
    design::Real sum = point.u.size() ? point.u(i) : 0.0;
    for (Eigen::Index j = 0; j < point.x.size(); ++j) sum += K(i, j) * design::Real(point.x(j));
    begun(i) = round(sum);
  }
  return begun;
}

// The input at the operating point of an extended filter, where it is not 0.
template <class S, class Round>
step::Vector<S> start_of_input(const Controller& controller, Round round) {
  const Eigen::VectorXd u = stated_point(controller).u;
  step::Vector<S> start(u.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) start(i) = round(design::Real(u(i)));
  return start;
}

template <class S, class Round>
void convert_regulator(const Controller& controller, Round round, std::size_t sample, step::Model<S>& model) {
  const Gains& gains = row_of(controller.laws, sample);
  model.K = convert<S>(gains[0], round);
  if (controller.has.foresight) model.foreseen = limited_law_of<S>(controller, round);
  const auto& limits = controller.problem.limits;
  if (limits && limits->u_min.size() && !controller.has.foresight) {
    model.u_min = input_limits(controller, +1).template cast<S>();
    model.u_max = input_limits(controller, -1).template cast<S>();
  }
  if (controller.has.rate_limit && !controller.has.foresight)
    model.u_step = convert_limits<S>(rate_steps(controller), -1, controller.target.is_double);
  model.gives_change = controller.has.input_change;
  const std::vector<int> references = controller.references;
  model.nr = controller.size.nr;
  model.Nbar = convert<S>(gains[1], round);
  model.H = convert<S>(gains[2], round);
  model.H_input = convert<S>(gains[3], round);
  model.integral = controller.integrated;
  for (const int output : model.integral)
    model.wanted.push_back(
        static_cast<int>(std::find(references.begin(), references.end(), output) - references.begin()));
  model.T = round(design::Real(controller.problem.plant.sample_time));
  if (is_extended(controller)) model.law_begun = begin_law<S>(controller, round);
  model.xi_bound = controller.bounds.xi;
  model.error_limit = controller.bounds.error.template cast<S>();
  if (controller.has.filter || model.integral.empty()) return;
  model.C = convert<S>(controller.solution.plant.C, round);
  if (!design::is_zero(controller.solution.plant.D)) model.D = convert<S>(controller.solution.plant.D, round);
}

// The constants of a sample, with the filter's gains of that row: after a reset they begin anew, and the time does not.
// `round` turns a Real into an S.
template <class S, class Round>
step::Model<S> model_of(const Controller& controller, Round round, std::size_t sample = 0, std::size_t gain_row = 0) {
  const design::Solution& solution = controller.solution;
  step::Model<S> model;
  model.filter = controller.filter;
  model.predictor_form = controller.is_predictor;
  model.nx = controller.size.nx;
  model.nu = controller.size.nu;
  model.ny = controller.size.ny;
  model.delayed = controller.size.delayed;
  model.A = convert<S>(kept_plant_at(controller, sample).A, round);
  model.B = convert<S>(kept_plant_at(controller, sample).B, round);
  model.D.resize(model.ny, 0);
  model.M.resize(model.nx, 0);
  model.point = convert_point<S>(controller.point);
  if (controller.has.filter) {
    model.x0 = convert<S>(kept_start(controller), round);
    if (is_extended(controller)) model.u0 = start_of_input<S>(controller, round);
    if (controller.modal) {
      model.to_estimate = convert<S>(controller.modal->T, round);
      model.of_estimate = convert<S>(controller.modal->inverse, round);
    }
    model.x_bound = controller.bounds.x;
    model.nu_limit = controller.bounds.innovation.template cast<S>();
    if (controller.has.range) {
      model.y_min = output_range(controller, +1).template cast<S>();
      model.y_max = output_range(controller, -1).template cast<S>();
    }
    if (controller.has.gate) {
      model.gate = round(design::Real(controller.gate.sigma));
      const auto in_target = [&](const Eigen::VectorXd& values) {
        step::Vector<S> out(values.size());
        for (Eigen::Index i = 0; i < values.size(); ++i) out(i) = round(design::Real(values(i)));
        return out;
      };
      model.gate_start = in_target(controller.gate.start);
      model.gate_widen = in_target(controller.gate.widen);
      model.gate_narrow = in_target(controller.gate.narrow);
    }
    if (solution.online)
      convert_online(controller, round, sample, model);
    else
      convert_steady(controller, round, sample, gain_row, model);
  }
  if (controller.has.regulator) convert_regulator(controller, round, sample, model);
  return model;
}

}  // namespace lqg::controller
