// SPDX-License-Identifier: MIT
#include "controller/controller.hpp"

#include <algorithm>
#include <cmath>

#include "controller/gains.hpp"
#include "controller/gate.hpp"
#include "controller/numbers.hpp"
#include "controller/operating_point.hpp"
#include "controller/recovery.hpp"
#include "controller/stage_in_force.hpp"
#include "design/finding.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/rounding.hpp"
#include "design/sampled/added_states.hpp"
#include "design/sampled/reference.hpp"
#include "expression/bind.hpp"

namespace lqg::controller {

namespace {

using design::is_zero;

step::Filter filter_of(const design::Problem& problem) {
  if (!problem.estimator) return step::Filter::none;
  if (problem.estimator->gain != design::Gain::online) return step::Filter::steady;
  return problem.estimator->covariance == design::Covariance::ud ? step::Filter::ud : step::Filter::plain;
}

Dimensions dimensions_of(const design::Problem& problem, const design::Solution& solution) {
  Dimensions size;
  size.nx = static_cast<int>(solution.plant.A.rows());
  size.nu = static_cast<int>(problem.plant.B.cols());
  size.ny = problem.estimator ? static_cast<int>(problem.plant.C.rows()) : 0;
  size.nr = static_cast<int>(design::reference_outputs(problem).size());
  size.nxi = static_cast<int>(design::integrated_outputs(problem).size());
  size.delayed = size.nx - static_cast<int>(problem.plant.A.rows() + design::added_states(problem));
  return size;
}

template <class Holds>
bool in_any_stage(const Controller& controller, Holds holds) {
  return std::any_of(controller.stage_starts.begin(), controller.stage_starts.end(), holds);
}

Terms terms_of(const Controller& controller) {
  const design::Problem& problem = controller.problem;
  const design::Solution& solution = controller.solution;
  Terms has;
  has.filter = problem.estimator.has_value();
  has.regulator = problem.regulator.has_value();
  has.stages = has.filter && !solution.stages.empty();
  has.gate = controller.gate.sigma > 0;
  has.range = has.filter && problem.estimator->output_min.size() > 0;
  has.variance = solution.online || (solution.estimator && solution.estimator->S.size() > 0);
  has.input_change = has.regulator && problem.regulator->input_rate.size() > 0;
  has.foresight = solution.foreseen.has_value();
  has.rate_limit = has.regulator && problem.limits && problem.limits->u_rate.size() > 0;
  has.last_input = has.input_change || has.rate_limit;
  has.servo = controller.size.nr > 0 || controller.size.nxi > 0 || has.last_input;
  return has;
}

std::vector<std::size_t> stage_starts_of(const Controller& controller) {
  std::vector<std::size_t> starts = {0};
  if (controller.has.stages)
    for (const design::StageSolution& stage : controller.solution.stages)
      starts.push_back(static_cast<std::size_t>(stage.from));
  return starts;
}

// h has an input in it.
bool has_input_in_outputs(const Controller& controller) {
  const auto& formulas = controller.problem.plant.equations->h;
  return std::any_of(formulas.begin(), formulas.end(), [&](const expression::Tree& formula) {
    const std::vector<int> variables = expression::variables_in(formula);
    return !variables.empty() && variables.back() >= controller.size.nx;
  });
}

bool has_feedthrough(const Controller& controller) {
  if (is_extended(controller)) return has_input_in_outputs(controller);
  return controller.has.filter &&
         in_any_stage(controller, [&](std::size_t at) { return !is_zero(plant_at(controller, at).D); });
}

// In the numbers of the controller.
Eigen::VectorXd start_of(const Controller& controller) {
  if (!controller.has.filter) return {};
  if (is_extended(controller) && controller.problem.estimator->extended->own_x0.size())
    return controller.problem.estimator->extended->own_x0;
  return design::to_doubles(controller.solution.start->x0).col(0);
}

// Of the innovations of each sample, those of tables of gains included.
bool has_variances(const Controller& controller) {
  return controller.has.variance && (controller.solution.online || !controller.has.stages);
}

// What follows from problem and solution alone.
Controller described(design::Problem problem, design::Solution solution, Source source) {
  Controller controller;
  controller.target = {problem.code.real == design::Scalar::float64,
                       problem.code.arithmetic == design::Arithmetic::fused};
  controller.filter = filter_of(problem);
  controller.is_predictor = problem.estimator && problem.estimator->form == design::Form::predictor;
  controller.size = dimensions_of(problem, solution);
  controller.integrated = design::integrated_outputs(problem);
  controller.references = design::reference_outputs(problem);
  controller.problem = std::move(problem);
  controller.solution = std::move(solution);
  controller.source = std::move(source);
  if (controller.problem.estimator) controller.gate.sigma = sigma_of(*controller.problem.estimator);
  controller.has = terms_of(controller);
  if (controller.has.gate && is_default(*controller.problem.estimator) && !has_variances(controller)) {
    controller.gate = {};
    controller.has.gate = false;
  }
  controller.stage_starts = stage_starts_of(controller);
  controller.has.feedthrough = has_feedthrough(controller);
  controller.x0 = start_of(controller);
  controller.point = point_of(controller);
  return controller;
}

bool keeps_innovation(const Controller& controller) {
  if (!controller.has.filter) return false;
  if (controller.solution.online)
    return in_any_stage(controller, [&](std::size_t at) { return !is_zero(online_at(controller, at).M); });
  return std::any_of(controller.filters.begin(), controller.filters.end(),
                     [](const Gains& row) { return !is_zero(row[1]); });
}

// What is kept follows from the gains, too.
Memory memory_of(const Controller& controller) {
  Memory keeps;
  keeps.input = controller.has.feedthrough || controller.has.last_input;
  keeps.innovation = keeps_innovation(controller);
  keeps.sample = controller.last_sample > 0;
  keeps.gain_row = controller.filters.size() > 1;
  keeps.any = controller.has.filter || controller.has.servo || keeps.sample;
  return keeps;
}

// What the engine can design and the target cannot have.
void check_emittable(const Controller& controller, design::Findings& findings) {
  const auto refuse = [&](const std::string& key, const std::string& why) {
    findings.push_back({design::Severity::error, key, why});
  };
  if (controller.has.stages && controller.problem.code.style == design::Style::unrolled)
    refuse("code.style",
           "expected \"compact\" or \"auto\": straight-line code is of one plant, the stages are of several");
  if (!controller.has.filter && controller.size.nxi && !controller.solution.stages.empty())
    refuse("lqr.integral",
           "expected a [kalman]: without one the outputs are made of the states, by one C for all stages");
  if (!controller.has.gate || has_variances(controller)) return;
  const std::string key = key_of_sigma(*controller.problem.estimator), none = key == "kalman.gate" ? "0" : "inf";
  refuse(key,
         controller.has.variance
             ? "expected " + none + ", or gain = \"online\": tables of gains for several stages come without variances"
             : "expected " + none + ": there is no variance of the innovations to compare with");
}

// Until more is known: what few designs come near to.
Iterations iterations_of(const Controller& controller) {
  constexpr unsigned changes_a_row = 10;
  const int given = controller.problem.limits->iterations;
  if (given > 0) return {Iterations::Origin::file, static_cast<unsigned>(given)};
  return {Iterations::Origin::cap, changes_a_row * static_cast<unsigned>(controller.solution.foreseen->G.rows())};
}

constexpr int bits_to_bound = 4;  // from a start

// A start that the bounds, which cannot be wider than the target's squares, would not let be.
void check_start(const Controller& controller, design::Findings& findings) {
  const auto check = [&](const char* key, const char* what, int i, double size) {
    const double most = std::ldexp(1.0, controller.bounds.x[static_cast<std::size_t>(i)] - bits_to_bound);
    if (size >= most)
      findings.push_back({design::Severity::error, key,
                          std::string("expected ") + what + " below " + design::decimal(most) + ", found " +
                              design::decimal(size) + " for " +
                              controller.problem.plant.states[static_cast<std::size_t>(i)].name +
                              ": its square has to be a number of the target; choose a larger unit" +
                              (controller.target.is_double ? "" : ", or real = \"double\"")});
  };
  for (int i = 0; i < controller.problem.estimator->P0.rows(); ++i) {
    check("kalman.initial_state", "values", i, std::abs(controller.x0(i)));
    check("kalman.initial_covariance", "standard deviations", i, std::sqrt(controller.problem.estimator->P0(i, i)));
  }
}

}  // namespace

std::optional<Controller> controller_of(design::Problem problem, design::Solution solution, Source source,
                                        design::Findings& findings) {
  Controller controller = described(std::move(problem), std::move(solution), std::move(source));
  check_emittable(controller, findings);
  check_point(controller, findings);
  if (design::has_error(findings)) return std::nullopt;
  controller.laws = law_gains(controller);
  controller.filters = filter_gains(controller);
  if (controller.has.gate && is_default(*controller.problem.estimator) && !fit_variances(controller)) {
    controller.has.gate = false;
    controller.filters = filter_gains(controller);
  }
  check_numbers(controller, findings);
  if (design::has_error(findings)) return std::nullopt;
  controller.last_sample =
      std::max(controller.laws.empty() ? 0 : controller.laws.size() - 1, controller.stage_starts.back());
  controller.keeps = memory_of(controller);
  if (controller.has.foresight) controller.iterations = iterations_of(controller);
  controller.bounds = bounds_of(controller);
  controller.gate = gate_of(controller);
  controller.recovery = recovery_of(controller);
  if (controller.has.filter) check_start(controller, findings);
  if (design::has_error(findings)) return std::nullopt;
  return controller;
}

Controller with_form(Controller controller, const design::LinearForm& form) {
  controller.linear = form;
  controller.gate = {};
  controller.has.gate = false;
  controller.size.nz = static_cast<int>(form.A.rows());
  controller.recovery = recovery_of(controller);
  controller.bounds = {};
  return controller;
}

namespace {

// Row k is K of sample k, the last one that which is held.
void take_laws_of_modes(const design::ModalPlant& modal, std::vector<Gains>& laws) {
  for (std::size_t k = 0; k < laws.size(); ++k) laws[k][0] = k + 1 < laws.size() ? modal.K_schedule[k] : modal.K;
}

}  // namespace

std::optional<Controller> with_modes(Controller controller, const design::ModalPlant& modal,
                                     design::Findings& findings) {
  controller.physical = std::make_shared<const Controller>(controller);
  controller.modal = modal;
  take_laws_of_modes(modal, controller.laws);
  controller.bounds = bounds_of(controller);
  controller.recovery = recovery_of(controller);
  const Eigen::VectorXd z0 = design::to_doubles(kept_start(controller)).cwiseAbs(),
                        P0 = design::to_doubles(modal.online.P0).diagonal();
  for (int i = 0; i < controller.size.nx; ++i)
    if (std::max(z0(i), std::sqrt(P0(i))) >=
        std::ldexp(1.0, controller.bounds.x[static_cast<std::size_t>(i)] - bits_to_bound)) {
      design::add_error(findings, "code.realisation",
                        std::string("the square of the start of a mode is too large for ") +
                            (controller.target.is_double ? "double" : "float"));
      return std::nullopt;
    }
  return controller;
}

const FormCost& chosen_form(const FormChoice& forms) {
  switch (forms.chosen) {
    case design::Realisation::folded: return *forms.folded;
    case design::Realisation::modal: return *forms.modal;
    default: return forms.physical;
  }
}

std::string name_of(design::Realisation realisation) {
  switch (realisation) {
    case design::Realisation::folded: return "folded";
    case design::Realisation::modal: return "modal";
    default: return "physical";
  }
}

bool has_estimate(const Controller& controller) {
  return controller.linear || controller.modal || (controller.has.filter && controller.point.x.size() > 0);
}

bool can_set_input(const Controller& controller) {
  return controller.size.nu > 0 && (controller.has.filter || controller.has.servo) &&
         (controller.size.delayed || controller.keeps.input || controller.size.nxi);
}

bool can_update_alone(const Controller& controller, int output) {
  return !controller.solution.online || !in_any_stage(controller, [&](std::size_t at) {
    return !is_zero(online_at(controller, at).E.row(output).head(output));
  });
}

bool has_update_alone(const Controller& controller, int output) {
  return controller.problem.code.updates == design::Updates::each && can_update_alone(controller, output);
}

}  // namespace lqg::controller
