#include "emit/controller.hpp"

#include <algorithm>
#include <cmath>

#include "design/reference.hpp"
#include "emit/figures.hpp"
#include "emit/gains.hpp"
#include "emit/model_of.hpp"
#include "emit/realisation.hpp"
#include "emit/text.hpp"

namespace lqg::emit {

step::Filter Controller::filter() const {
  if (!problem.estimator) return step::Filter::none;
  if (problem.estimator->gain != design::Gain::online) return step::Filter::steady;
  return problem.estimator->covariance == design::Covariance::ud ? step::Filter::ud : step::Filter::plain;
}

bool Controller::has_feedthrough() const {
  const std::vector<std::size_t> starts = stage_starts();
  return has_filter() && std::any_of(starts.begin(), starts.end(), [&](std::size_t at) { return !is_zero(plant_at(at).D); });
}

bool Controller::gives_change() const { return has_regulator() && problem.regulator->input_rate.size() > 0; }

bool Controller::has_rate_limit() const {
  return has_regulator() && problem.limits && problem.limits->u_rate.size() > 0;
}

bool Controller::keeps_innovation() const {
  if (!has_filter()) return false;
  const std::vector<std::size_t> starts = stage_starts();
  if (solution.online)
    return std::any_of(starts.begin(), starts.end(), [&](std::size_t at) { return !is_zero(online_at(at).M); });
  return std::any_of(filters.begin(), filters.end(), [](const Gains& row) { return !is_zero(row[1]); });
}

namespace {

// The stage that is in force in `sample`; nullptr: the first.
const design::StageSolution* stage_at(const design::Solution& solution, std::size_t sample) {
  const design::StageSolution* found = nullptr;
  for (const design::StageSolution& stage : solution.stages)
    if (static_cast<std::size_t>(stage.from) <= sample) found = &stage;
  return found;
}

}  // namespace

const design::SampledPlant& Controller::plant_at(std::size_t sample) const {
  const design::StageSolution* stage = stage_at(solution, sample);
  return stage && has_stages() ? stage->plant : solution.plant;
}

const design::SampledNoise& Controller::noise_at(std::size_t sample) const {
  const design::StageSolution* stage = stage_at(solution, sample);
  return stage && stage->noise ? *stage->noise : solution.estimator->noise;
}

const design::OnlineSolution& Controller::online_at(std::size_t sample) const {
  const design::StageSolution* stage = stage_at(solution, sample);
  return stage && stage->online ? *stage->online : *solution.online;
}

std::vector<std::size_t> Controller::stage_starts() const {
  std::vector<std::size_t> starts = {0};
  if (has_stages())
    for (const design::StageSolution& stage : solution.stages) starts.push_back(static_cast<std::size_t>(stage.from));
  return starts;
}

std::size_t Controller::last_sample() const {
  return std::max(laws.empty() ? 0 : laws.size() - 1, stage_starts().back());
}

bool Controller::has_variance() const {
  return solution.online || (solution.estimator && solution.estimator->S.size() > 0);
}

bool Controller::can_update_alone(int output) const {
  const std::vector<std::size_t> starts = stage_starts();
  return !solution.online || std::all_of(starts.begin(), starts.end(), [&](std::size_t at) {
    return is_zero(online_at(at).E.row(output).head(output));
  });
}

const std::vector<int>& Controller::integral() const { return design::integrated_outputs(problem); }

std::vector<int> Controller::references() const { return design::reference_outputs(problem); }

Eigen::VectorXd Controller::x0() const {
  Eigen::VectorXd x0 = Eigen::VectorXd::Zero(nx());
  x0.head(problem.estimator->x0.size()) = problem.estimator->x0;
  return x0;
}

namespace {

// What the engine can design and the target cannot have.
void check_emittable(const Controller& controller, design::Findings& findings) {
  const auto refuse = [&](const char* key, const char* why) {
    findings.push_back({design::Severity::error, key, why});
  };
  if (controller.has_stages() && controller.problem.code.style == design::Style::unrolled)
    refuse("code.style", "expected \"compact\" or \"auto\": straight-line code is of one plant, the stages are of several");
  if (!controller.has_filter() && controller.nxi() && !controller.solution.stages.empty())
    refuse("lqr.integral", "expected a [kalman]: without one the outputs are made of the states, by one C for all stages");
  if (controller.gates() && controller.has_stages() && !controller.solution.online)
    refuse("kalman.gate", "expected 0, or gain = \"online\": tables of gains for several stages come without variances");
  if (controller.gates() && !controller.has_variance())
    refuse("kalman.gate", "expected 0: there is no variance of the innovations to compare with");
}

// A start that the bounds, which cannot be wider than the target's squares, would not let be.
void check_start(const Controller& controller, design::Findings& findings) {
  constexpr int bits_to_bound = 4;
  const auto check = [&](const char* key, const char* what, int i, double size) {
    const double most = std::ldexp(1.0, controller.bounds.x[static_cast<std::size_t>(i)] - bits_to_bound);
    if (size >= most)
      findings.push_back({design::Severity::error, key,
                          std::string("expected ") + what + " below " + rounded(most) + ", found " + rounded(size) + " for " +
                              controller.problem.plant.states[static_cast<std::size_t>(i)].name +
                              ": its square has to be a number of the target; choose a larger unit, or double"});
  };
  for (int i = 0; i < controller.problem.estimator->P0.rows(); ++i) {
    check("kalman.initial_state", "values", i, std::abs(controller.x0()(i)));
    check("kalman.initial_covariance", "standard deviations", i, std::sqrt(controller.problem.estimator->P0(i, i)));
  }
}

design::Style style_of(const Controller& controller, const Figures& unrolled, const Figures& compact) {
  const design::Code& code = controller.problem.code;
  if (code.style != design::Style::automatic) return code.style;
  if (controller.has_stages()) return design::Style::compact;
  return unrolled.flash <= code.flash || unrolled.flash <= compact.flash ? design::Style::unrolled
                                                                         : design::Style::compact;
}

void choose_style(Controller& controller) {
  if (controller.linear) {
    controller.style = design::Style::unrolled;
    controller.figures = linear_figures(controller);
    return;
  }
  const Figures unrolled = unrolled_figures(controller), compact = compact_figures(controller);
  controller.style = style_of(controller, unrolled, compact);
  controller.figures = controller.style == design::Style::unrolled ? unrolled : compact;
}

}  // namespace

std::optional<Controller> make_controller(design::Problem problem, design::Solution solution, Source source,
                                          design::Findings& findings) {
  Controller controller{std::move(problem), std::move(solution), std::move(source), {}, {}, {}, {}, {}, {}, {}};
  check_emittable(controller, findings);
  if (design::has_error(findings)) return std::nullopt;
  controller.laws = law_gains(controller);
  controller.filters = filter_gains(controller);
  controller.bounds = bounds_of(controller);
  if (controller.has_filter()) check_start(controller, findings);
  if (design::has_error(findings)) return std::nullopt;
  const design::Code& code = controller.problem.code;
  if (!choose_realisation(controller, findings)) return std::nullopt;
  if (controller.linear) controller.bounds = {};  // they are of x̂; z has to be finite
  choose_style(controller);
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
