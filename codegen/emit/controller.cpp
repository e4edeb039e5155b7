#include "emit/controller.hpp"

#include <algorithm>

#include "emit/figures.hpp"
#include "emit/gains.hpp"
#include "emit/model_of.hpp"

namespace lqg::emit {

step::Filter Controller::filter() const {
  if (!problem.estimator) return step::Filter::none;
  if (problem.estimator->gain != design::Gain::online) return step::Filter::steady;
  return problem.estimator->covariance == design::Covariance::ud ? step::Filter::ud : step::Filter::plain;
}

bool Controller::has_feedthrough() const { return has_filter() && !is_zero(solution.plant.D); }

bool Controller::gives_change() const { return has_regulator() && problem.regulator->input_rate.size() > 0; }

bool Controller::has_rate_limit() const {
  return has_regulator() && problem.limits && problem.limits->u_rate.size() > 0;
}

bool Controller::keeps_innovation() const {
  if (!has_filter()) return false;
  if (solution.online) return !is_zero(solution.online->M);
  return std::any_of(filters.begin(), filters.end(), [](const Gains& row) { return !is_zero(row[1]); });
}

bool Controller::keeps_sample() const { return laws.size() > 1; }

bool Controller::has_variance() const {
  return solution.online || (solution.estimator && solution.estimator->S.size() > 0);
}

bool Controller::can_update_alone(int output) const {
  return !solution.online || is_zero(solution.online->E.row(output).head(output));
}

const std::vector<int>& Controller::integral() const {
  static const std::vector<int> none;
  return has_regulator() && problem.regulator->integral ? problem.regulator->integral->outputs : none;
}

std::vector<int> Controller::references() const {
  std::vector<int> outputs = integral();
  if (has_regulator())
    outputs.insert(outputs.end(), problem.regulator->track.begin(), problem.regulator->track.end());
  std::sort(outputs.begin(), outputs.end());
  outputs.erase(std::unique(outputs.begin(), outputs.end()), outputs.end());
  return outputs;
}

Eigen::VectorXd Controller::x0() const {
  Eigen::VectorXd x0 = Eigen::VectorXd::Zero(nx());
  x0.head(problem.estimator->x0.size()) = problem.estimator->x0;
  return x0;
}

std::optional<Controller> make_controller(design::Problem problem, design::Solution solution, Source source,
                                          design::Findings& findings) {
  Controller controller{std::move(problem), std::move(solution), std::move(source), {}, {}, {}, {}};
  controller.laws = law_gains(controller);
  controller.filters = filter_gains(controller);
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
