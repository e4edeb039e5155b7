// SPDX-License-Identifier: MIT
// The equations of an extended filter, with constants that are rounded once.
#pragma once

#include <algorithm>
#include <memory>

#include "controller/controller.hpp"
#include "design/numeric/digits.hpp"
#include "expression/evaluate.hpp"
#include "step/model.hpp"

namespace lqg::controller {

// Adds the largest parts without a variable, made with many digits.
template <class S, class Round>
void add_constants(const expression::Node& formula, expression::Constants<design::Real>& value_of, Round round,
                   std::map<const expression::Node*, S>& out) {
  if (formula.is_constant) out.insert({&formula, round(value_of(formula))});
  for (const expression::Tree& operand : formula.operands)
    if (!formula.is_constant) add_constants(*operand, value_of, round, out);
}

// The equations with their constants.
template <class S, class Round>
std::shared_ptr<const step::Equations<S>> equations_of(const Controller& controller, Round round) {
  const design::Plant& plant = controller.problem.plant;
  const design::Extended& extended = *controller.problem.estimator->extended;
  const design::Digits digits(std::max(controller.solution.numerics.digits, 50u));
  step::Equations<S> out;
  out.f = plant.equations->f;
  out.h = plant.equations->h;
  expression::Constants<design::Real> value_of;
  for (const auto* formulas : {&out.f, &out.h})
    for (const auto& formula : *formulas) add_constants(*formula, value_of, round, out.constants);
  out.integration = plant.domain == design::Domain::discrete           ? step::Integration::none
                    : extended.integrator == design::Integrator::euler ? step::Integration::euler
                                                                       : step::Integration::rk4;
  const design::Real T = plant.sample_time;
  out.T = round(T);
  out.T_half = round(T / 2);
  out.T_third = round(T / 3);
  out.T_sixth = round(T / 6);
  out.wraps.assign(out.h.size(), false);
  for (const int output : extended.wraps) out.wraps[static_cast<std::size_t>(output)] = true;
  return std::make_shared<const step::Equations<S>>(std::move(out));
}

}  // namespace lqg::controller
