// SPDX-License-Identifier: MIT
#include "emit/plan/plan.hpp"

#include "emit/plan/code_cost.hpp"
#include "emit/plan/realisation.hpp"
#include "simulate/drop_outs.hpp"
#include "simulate/scenario_requirements.hpp"

namespace lqg::emit {

namespace {

design::Style style_of(const Controller& controller, const CodeCost& unrolled, const CodeCost& compact) {
  const design::Code& code = controller.problem.code;
  if (code.style != design::Style::automatic) return code.style;
  if (controller.has.stages) return design::Style::compact;
  return unrolled.flash <= code.flash || unrolled.flash <= compact.flash ? design::Style::unrolled
                                                                         : design::Style::compact;
}

void choose_style(Controller& controller) {
  if (controller.linear) {
    controller.style = design::Style::unrolled;
    controller.cost = cost_of_linear_form(controller);
    return;
  }
  const CodeCost unrolled = cost_of_unrolled(controller), compact = cost_of_compact(controller);
  controller.style = style_of(controller, unrolled, compact);
  controller.cost = controller.style == design::Style::unrolled ? unrolled : compact;
}

// An error where lqgen may choose and still finds nothing that fits, else a note.
void check_flash(const Controller& controller, design::Findings& findings) {
  const design::Code& code = controller.problem.code;
  if (controller.cost.flash <= code.flash) return;
  findings.push_back({code.style == design::Style::automatic ? design::Severity::error : design::Severity::note,
                      "code.flash",
                      "expected at least " + std::to_string(controller.cost.flash) +
                          " bytes, which the controller takes, found " + std::to_string(code.flash)});
}

}  // namespace

std::optional<Controller> make_controller(design::Problem problem, design::Solution solution, controller::Source source,
                                          design::Findings& findings) {
  std::optional<Controller> physical =
      controller::controller_of(std::move(problem), std::move(solution), std::move(source), findings);
  if (!physical) return std::nullopt;
  std::optional<Controller> chosen = in_chosen_form(*std::move(physical), findings);
  if (!chosen) return std::nullopt;
  choose_style(*chosen);
  check_flash(*chosen, findings);
  simulate::check_drop_outs(*chosen, findings);
  simulate::check_scenario_requirements(*chosen, findings);
  if (design::has_error(findings)) return std::nullopt;
  return chosen;
}

}  // namespace lqg::emit
