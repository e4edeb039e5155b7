// SPDX-License-Identifier: MIT
#include "emit/plan/realisation.hpp"

#include "controller/numbers.hpp"
#include "emit/plan/code_cost.hpp"
#include "emit/vectors/linear_vectors.hpp"
#include "emit/vectors/vectors.hpp"
#include "simulate/agreement.hpp"

namespace lqg::emit {

namespace {

using design::Realisation;

std::string obstacle(const Controller& controller) {
  if (controller.problem.code.style == design::Style::compact)
    return "the library's loops, style = \"compact\", are of x̂";
  return design::no_linear_form(controller.problem, controller.solution);
}

FormCost cost_of_physical(const Controller& controller) {
  return {cost_of_unrolled(controller).multiply_adds, rounding_error(controller)};
}

// None, with its obstacle in `found`, where there is no such form.
std::optional<FormCost> cost_of(const Controller& physical, design::LinearFormResult& found) {
  if (!found.form) return std::nullopt;
  const double agreement = simulate::agreement(physical, *found.form);
  if (agreement < simulate::digits_of_agreement(physical.solution) / 2.0) {
    found = {std::nullopt, "it is not equal to the physical form in half of the digits"};
    return std::nullopt;
  }
  const Controller controller = controller::with_form(physical, *found.form);
  return FormCost{cost_of_linear_form(controller).multiply_adds, rounding_error(controller), std::nullopt, agreement};
}

bool loses_much(const FormCost& cost, const FormCost& physical) {
  if (cost.share_of_deviation && *cost.share_of_deviation < negligible_share) return false;
  return cost.rounding_error > most_loss * physical.rounding_error;
}

// What comes first wins where two cost the same.
Realisation cheapest(const FormChoice& among) {
  Realisation best = Realisation::physical;
  long least = among.physical.multiply_adds;
  for (const auto& [kind, cost] :
       {std::pair(Realisation::folded, &among.folded), std::pair(Realisation::modal, &among.modal)}) {
    if (!*cost || (*cost)->multiply_adds >= least) continue;
    if (loses_much(**cost, among.physical)) continue;
    best = kind;
    least = (*cost)->multiply_adds;
  }
  return best;
}

// A filter that carries P has other coordinates of its states, not another form: it stays the filter that it is.
std::string obstacle_of_modes(const Controller& controller) {
  if (controller.problem.code.style == design::Style::compact)
    return "the library's loops, style = \"compact\", are of x̂";
  if (controller::is_extended(controller)) return "the states are those of plant.f";
  return design::no_modal_plant(controller.problem);
}

FormCost cost_of_filter(const Controller& controller, double agreement) {
  const RoundingOfFilter rounding = rounding_of_filter(controller);
  return {cost_of_unrolled(controller).multiply_adds, rounding.error, rounding.share_of_deviation, agreement};
}

// Where lqgen may choose the style straight-line code that is too large is no choice: that of x̂ may be in loops.
bool fits_flash(const Controller& controller) {
  return controller.problem.code.style != design::Style::automatic ||
         cost_of_unrolled(controller).flash <= controller.problem.code.flash;
}

std::optional<Controller> refuse(const char* instead, const std::string& why, design::Findings& findings) {
  findings.push_back({design::Severity::error, "code.realisation", std::string("expected ") + instead + ": " + why});
  return std::nullopt;
}

std::optional<Controller> stays_physical(Controller controller, const std::string& why, design::Findings& findings) {
  if (controller.problem.code.realisation != Realisation::cheapest) return refuse("\"physical\"", why, findings);
  findings.push_back({design::Severity::note, "code.realisation", "physical: " + why});
  return controller;
}

std::optional<Controller> in_chosen_coordinates(Controller controller, design::Findings& findings) {
  const Realisation wanted = controller.problem.code.realisation;
  if (wanted == Realisation::folded)
    return refuse("\"physical\"", design::no_linear_form(controller.problem, controller.solution), findings);
  const std::string why = obstacle_of_modes(controller);
  if (!why.empty()) return stays_physical(std::move(controller), why, findings);
  const design::ModalPlantResult found = design::modal_plant(controller.problem, controller.solution);
  if (!found.modal) return stays_physical(std::move(controller), found.obstacle, findings);
  design::Findings of_start;
  std::optional<Controller> modal = controller::with_modes(controller, *found.modal, of_start);
  if (!modal) return stays_physical(std::move(controller), of_start.front().message, findings);

  FormChoice forms;
  forms.physical = cost_of_filter(controller, 0);
  forms.modal = cost_of_filter(*modal, found.modal->agreement);
  forms.chosen = wanted != Realisation::cheapest ? wanted
                 : fits_flash(*modal)            ? cheapest(forms)
                                                 : Realisation::physical;
  controller.forms = modal->forms = forms;
  if (forms.chosen == Realisation::physical) return controller;
  design::check_rounded_modes(modal->problem, *found.modal, modal->solution, findings);
  if (design::has_error(findings)) return std::nullopt;
  return modal;
}

std::optional<Controller> keeping(const design::LinearForm& form, Controller controller, design::Findings& findings) {
  controller::check_numbers(form, controller.target.is_double, findings);
  if (design::has_error(findings)) return std::nullopt;
  design::check_rounded_form(controller.problem, form, controller.solution, findings);
  if (design::has_error(findings)) return std::nullopt;
  return controller::with_form(std::move(controller), form);
}

// The modes take fewer multiply-adds and lose no more than they may.
bool is_cheaper(const Controller& controller, const design::LinearForm& modal, const design::LinearForm& estimates) {
  const Controller in_modes = controller::with_form(controller, modal),
                   in_estimates = controller::with_form(controller, estimates);
  return cost_of_linear_form(in_modes).multiply_adds < cost_of_linear_form(in_estimates).multiply_adds &&
         rounding_error(in_modes) <= most_loss * rounding_error(in_estimates);
}

// A compensator of a given order keeps its estimates of some states, or its modes.
std::optional<Controller> of_given_order(Controller controller, design::Findings& findings) {
  const Realisation wanted = controller.problem.code.realisation;
  const design::LinearFormResult estimates = design::folded_form(controller.problem, controller.solution);
  if (!estimates.form) {
    findings.push_back({design::Severity::error, "design", estimates.obstacle});
    return std::nullopt;
  }
  const bool wants_modes = wanted == Realisation::modal || wanted == Realisation::cheapest;
  if (!wants_modes) return keeping(*estimates.form, std::move(controller), findings);
  const std::string why = obstacle(controller);
  if (!why.empty()) {
    if (wanted == Realisation::modal) return refuse("\"physical\"", why, findings);
    findings.push_back({design::Severity::note, "code.realisation", "physical: " + why});
    return keeping(*estimates.form, std::move(controller), findings);
  }
  const design::LinearFormResult modal = design::modal_form(controller.problem, controller.solution);
  if (!modal.form && wanted == Realisation::modal) return refuse("\"physical\"", modal.obstacle, findings);
  const bool takes_modes =
      modal.form && (wanted == Realisation::modal || is_cheaper(controller, *modal.form, *estimates.form));
  return keeping(takes_modes ? *modal.form : *estimates.form, std::move(controller), findings);
}

}  // namespace

std::optional<Controller> in_chosen_form(Controller controller, design::Findings& findings) {
  if (controller.solution.compensator) return of_given_order(std::move(controller), findings);
  const Realisation wanted = controller.problem.code.realisation;
  if (wanted == Realisation::physical) return controller;
  if (carries_covariance(controller)) return in_chosen_coordinates(std::move(controller), findings);
  const std::string why = obstacle(controller);
  if (!why.empty()) return stays_physical(std::move(controller), why, findings);
  design::LinearFormResult folded = design::folded_form(controller.problem, controller.solution);
  design::LinearFormResult modal = design::modal_form(controller.problem, controller.solution);
  FormChoice forms;
  forms.folded = cost_of(controller, folded);
  forms.modal = cost_of(controller, modal);
  if (wanted == Realisation::folded && !folded.form) return refuse("\"physical\"", folded.obstacle, findings);
  if (wanted == Realisation::modal && !modal.form)
    return refuse("\"folded\" or \"physical\"", modal.obstacle, findings);

  forms.physical = cost_of_physical(controller);
  forms.chosen = wanted == Realisation::cheapest ? cheapest(forms) : wanted;
  controller.forms = forms;
  if (forms.chosen == Realisation::physical) return controller;
  const design::LinearForm& form = forms.chosen == Realisation::folded ? *folded.form : *modal.form;
  controller::check_numbers(form, controller.target.is_double, findings);
  if (design::has_error(findings)) return std::nullopt;
  design::check_rounded_form(controller.problem, form, controller.solution, findings);
  if (design::has_error(findings)) return std::nullopt;
  if (!controller.problem.estimator->spike)
    design::add_note(findings, "code.realisation",
                     "this form keeps no x̂ to compare outputs with, so a spike is let in whatever its size; "
                     "\"physical\" leaves it out, kalman.spike = inf says that none comes");
  return controller::with_form(std::move(controller), form);
}

}  // namespace lqg::emit
