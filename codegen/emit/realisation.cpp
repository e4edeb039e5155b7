#include "emit/realisation.hpp"

#include "emit/figures.hpp"
#include "emit/linear_vectors.hpp"

namespace lqg::emit {

namespace {

using design::Realisation;

std::string obstacle(const Controller& controller) {
  if (controller.problem.code.style == design::Style::compact) return "the library's loops, style = \"compact\", are of x̂";
  return design::no_linear_form(controller.problem, controller.solution);
}

FormFigures figures_of(Controller& controller, const std::optional<design::LinearForm>& form) {
  controller.linear = form;
  const Figures figures = form ? linear_figures(controller) : unrolled_figures(controller);
  return {figures.multiply_adds, rounding_error(controller)};
}

// What comes first wins where two cost the same.
Realisation cheapest(const Realisations& among) {
  Realisation best = Realisation::physical;
  long least = among.physical.multiply_adds;
  for (const auto& [kind, figures] :
       {std::pair(Realisation::folded, &among.folded), std::pair(Realisation::modal, &among.modal)}) {
    if (!*figures || (*figures)->multiply_adds >= least) continue;
    if ((*figures)->rounding_error > most_loss * among.physical.rounding_error) continue;
    best = kind;
    least = (*figures)->multiply_adds;
  }
  return best;
}

bool refuse(const char* instead, const std::string& why, design::Findings& findings) {
  findings.push_back({design::Severity::error, "code.realisation", std::string("expected ") + instead + ": " + why});
  return false;
}

}  // namespace

std::string name_of(Realisation realisation) {
  switch (realisation) {
    case Realisation::folded: return "folded";
    case Realisation::modal: return "modal";
    default: return "physical";
  }
}

bool choose_realisation(Controller& controller, design::Findings& findings) {
  const Realisation wanted = controller.problem.code.realisation;
  if (wanted == Realisation::physical) return true;
  const std::string why = obstacle(controller);
  if (!why.empty() && wanted != Realisation::cheapest) return refuse("\"physical\"", why, findings);
  if (!why.empty()) {
    findings.push_back({design::Severity::note, "code.realisation", "physical: " + why});
    return true;
  }
  const auto folded = design::folded_form(controller.problem, controller.solution);
  const auto modal = design::modal_form(controller.problem, controller.solution);
  if (wanted == Realisation::folded && !folded.form) return refuse("\"physical\"", folded.obstacle, findings);
  if (wanted == Realisation::modal && !modal.form) return refuse("\"folded\" or \"physical\"", modal.obstacle, findings);

  Realisations found;
  found.physical = figures_of(controller, std::nullopt);
  if (folded.form) found.folded = figures_of(controller, folded.form);
  if (modal.form) found.modal = figures_of(controller, modal.form);
  found.chosen = wanted == Realisation::cheapest ? cheapest(found) : wanted;
  controller.realisations = found;
  controller.linear = found.chosen == Realisation::folded ? folded.form
                      : found.chosen == Realisation::modal ? modal.form
                                                           : std::nullopt;
  if (controller.linear) design::check_rounded_form(controller.problem, *controller.linear, controller.solution, findings);
  return !design::has_error(findings);
}

}  // namespace lqg::emit
