#include "emit/controller.hpp"

#include "emit/figures.hpp"
#include "emit/model_of.hpp"

namespace lqg::emit {

step::Filter Controller::filter() const {
  if (!problem.estimator) return step::Filter::none;
  if (problem.estimator->gain == design::Gain::steady) return step::Filter::steady;
  return problem.estimator->covariance == design::Covariance::ud ? step::Filter::ud : step::Filter::plain;
}

bool Controller::keeps_input() const { return has_filter() && !is_zero(solution.plant.D); }

bool Controller::keeps_innovation() const {
  return has_filter() && !is_zero(solution.online ? solution.online->M : solution.estimator->M);
}

std::optional<Controller> make_controller(design::Problem problem, design::Solution solution, Source source,
                                          design::Findings& findings) {
  Controller controller{std::move(problem), std::move(solution), std::move(source), {}, {}};
  const design::Code& code = controller.problem.code;
  const Figures unrolled = unrolled_figures(controller), compact = compact_figures(controller);
  const bool prefers_unrolled = unrolled.flash <= code.flash || unrolled.flash <= compact.flash;
  controller.style = code.style != design::Style::automatic ? code.style
                     : prefers_unrolled                      ? design::Style::unrolled
                                                             : design::Style::compact;
  controller.figures = controller.style == design::Style::unrolled ? unrolled : compact;
  if (controller.figures.flash > code.flash) {
    findings.push_back({code.style == design::Style::automatic ? design::Severity::error : design::Severity::note,
                        "code.flash",
                        "expected at least " + std::to_string(controller.figures.flash) +
                            " bytes, which the controller takes, found " + std::to_string(code.flash)});
    if (code.style == design::Style::automatic) return std::nullopt;
  }
  return controller;
}

}  // namespace lqg::emit
