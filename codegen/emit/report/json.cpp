// SPDX-License-Identifier: MIT
#include "emit/report/json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "design/numeric/digits.hpp"
#include "design/sampled/added_states.hpp"
#include "design/sampled/reference.hpp"
#include "emit/text/order_description.hpp"
#include "emit/text/wording.hpp"
#include "emit/plan/realisation.hpp"

namespace lqg::emit {

namespace {

using Json = nlohmann::ordered_json;

Json rows(const design::RealMatrix& matrix) {
  Json out = Json::array();
  for (int i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (int j = 0; j < matrix.cols(); ++j) row.push_back(design::to_double(matrix(i, j)));
    out.push_back(std::move(row));
  }
  return out;
}

std::vector<double> numbers(const Eigen::VectorXd& vector) { return {vector.begin(), vector.end()}; }

Json poles(const design::Poles& poles) {
  Json out = Json::array();
  for (const std::complex<double>& pole : poles) out.push_back({pole.real(), pole.imag()});
  return out;
}

Json names(const std::vector<design::Signal>& signals) {
  Json out = Json::array();
  for (const design::Signal& signal : signals) out.push_back(name_with_unit(signal));
  return out;
}

Json rows_of_doubles(const Eigen::MatrixXd& matrix) {
  Json out = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const Eigen::VectorXd row = matrix.row(i);
    out.push_back(numbers(row));
  }
  return out;
}

// The equations as they are written, and their linearisation before it is sampled.
void add_equations(const design::Plant& plant, Json& out) {
  out["f"] = plant.equations->f_text;
  out["h"] = plant.equations->h_text;
  if (plant.domain != design::Domain::continuous || !plant.operating_point) return;
  out["continuous"] = {{"A", rows_of_doubles(plant.A)},
                       {"B", rows_of_doubles(plant.B)},
                       {"C", rows_of_doubles(plant.C)},
                       {"D", rows_of_doubles(plant.D)}};
}

Json plant(const Controller& controller) {
  const design::SampledPlant& sampled = controller.solution.plant;
  const design::Plant& stated = controller.problem.plant;
  Json out = {{"domain", stated.domain == design::Domain::continuous ? "continuous" : "discrete"},
              {"sample_time", stated.sample_time},
              {"A", rows(sampled.A)},
              {"B", rows(sampled.B)},
              {"C", rows(sampled.C)},
              {"D", rows(sampled.D)},
              {"G", rows(sampled.G)},
              {"states", names(stated.states)},
              {"inputs", names(stated.inputs)},
              {"outputs", names(stated.outputs)}};
  if (stated.equations) add_equations(stated, out);
  if (!design::has_added_states(controller.problem)) return out;
  const std::vector<design::Signal> all = state_signals(controller);
  const auto first = all.begin() + stated.A.rows();
  out["added_states"] = names({first, first + design::added_states(controller.problem)});
  return out;
}

Json operating_point(const design::OperatingPoint& point) {
  return {{"states", numbers(point.x)}, {"inputs", numbers(point.u)}, {"outputs", numbers(point.y)}};
}

Json parameters(const std::vector<design::Parameter>& all) {
  Json out = Json::object();
  for (const design::Parameter& parameter : all) {
    Json& one = out[parameter.name] = {{"value", parameter.value}};
    if (!parameter.unit.empty()) one["unit"] = parameter.unit;
    if (!parameter.formula.empty()) one["expression"] = parameter.formula;
    if (parameter.is_set) one["is_set"] = true;
  }
  return out;
}

Json expressions(const std::vector<design::Formula>& all) {
  Json out = Json::object();
  for (const design::Formula& formula : all)
    out[formula.key] = {{"value", formula.value}, {"expression", formula.text}};
  return out;
}

Json schedule(const std::vector<design::RealMatrix>& gains) {
  Json out = Json::array();
  for (const design::RealMatrix& gain : gains) out.push_back(rows(gain));
  return out;
}

// What does not exist in a design is left out.
void add(Json& out, const char* key, const design::RealMatrix& matrix) {
  if (matrix.size() > 0) out[key] = rows(matrix);
}
void add(Json& out, const char* key, const std::vector<design::RealMatrix>& gains) {
  if (!gains.empty()) out[key] = schedule(gains);
}
void add(Json& out, const char* key, const std::vector<int>& outputs) {
  if (!outputs.empty()) out[key] = outputs;
}
void add(Json& out, const char* key, const std::optional<double>& value) {
  if (value) out[key] = *value;
}

void add_margins(Json& out, const design::Margins& margins, double sample_time) {
  add(out, "gain_margin_dB", margins.gain_dB);
  add(out, "gain_margin_up_dB", margins.gain_up_dB);
  add(out, "gain_margin_down_dB", margins.gain_down_dB);
  add(out, "phase_margin_deg", margins.phase_deg);
  add(out, "delay_margin_samples", margins.delay_samples);
  if (margins.delay_samples) out["delay_margin_s"] = *margins.delay_samples * sample_time;
  if (margins.crossover) out["crossover"] = *margins.crossover / sample_time;
  add(out, "disk_margin", margins.disk);
}

Json structure(const design::StructureReport& report, double sample_time) {
  Json out = {{"full", rows(report.full)}, {"full_poles", poles(report.full_poles)}, {"cost_ratio", report.cost_ratio}};
  add_margins(out, report.full_margins, sample_time);
  return out;
}

Json noise(const design::SampledNoise& noise) {
  return {{"W", rows(noise.W)}, {"V", rows(noise.V)}, {"cross", rows(noise.Swv)}};
}

Json cost(const design::SampledCost& cost) { return {{"Q", rows(cost.Q)}, {"R", rows(cost.R)}, {"N", rows(cost.N)}}; }

Json lqr(const Controller& controller) {
  const design::RegulatorSolution& regulator = *controller.solution.regulator;
  Json out = {{"K", rows(regulator.K)}};
  add(out, "X", regulator.X);
  out["poles"] = poles(regulator.poles);
  add(out, "schedule", regulator.K_schedule);
  add(out, "cost_to_go", regulator.X0);
  add(out, "Nx", regulator.Nx);
  add(out, "Nu", regulator.Nu);
  add(out, "Nbar", regulator.Nbar);
  add(out, "Gamma", regulator.Gamma);
  add(out, "H", regulator.H);
  add(out, "integral", design::integrated_outputs(controller.problem));
  add(out, "references", design::reference_outputs(controller.problem));
  if (regulator.structure) out["structure"] = structure(*regulator.structure, controller.problem.plant.sample_time);
  return out;
}

Json worth(const controller::Worth& worth) {
  return {{"starts", worth.starts},
          {"clipped_settle", worth.clipped_settle},
          {"optimal_settle", worth.optimal_settle},
          {"both_settle", worth.both_settle},
          {"median_ratio", worth.median_ratio},
          {"high_ratio", worth.high_ratio},
          {"clipped_excess", worth.clipped_excess},
          {"optimal_excess", worth.optimal_excess}};
}

Json foreseen_limits(const Controller& controller) {
  const design::LimitedRows& rows = *controller.solution.foreseen;
  Json quantities = Json::array();
  for (std::size_t i = 0; i < rows.names.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    Json quantity = {{"name", rows.names[i]}, {"sample", rows.sample[i]}};
    if (isfinite(rows.low(at))) quantity["low"] = design::to_double(rows.low(at));
    if (isfinite(rows.high(at))) quantity["high"] = design::to_double(rows.high(at));
    if (rows.price[i]) quantity["price"] = design::to_double(*rows.price[i]);
    quantities.push_back(std::move(quantity));
  }
  return {{"horizon", controller.problem.limits->horizon},
          {"quantities", quantities},
          {"F", lqg::emit::rows(rows.F)},
          {"G", lqg::emit::rows(rows.G)},
          {"iterations", controller.iterations.most},
          {"are_iterations_proved", controller.iterations.origin == controller::Iterations::Origin::certified},
          {"worth", worth(*controller.worth)}};
}

// The steady filter as a system of its own, from [u; y − D u] to x̂: x⁺ = A x + B […], x̂ = C x + D […].
Json observer(const Controller& controller) {
  const design::EstimatorSolution& estimator = *controller.solution.estimator;
  const design::SampledPlant& plant = controller.solution.plant;
  const design::Digits scope(std::max(50u, controller.solution.numerics.digits));
  const design::Index nx = plant.A.rows(), nu = plant.B.cols(), ny = plant.C.rows();
  const design::RealMatrix told = controller.is_predictor ? design::zeros(nx, ny) : estimator.L;
  return {{"A", rows(plant.A - design::multiply(estimator.L_predictor, plant.C))},
          {"B", rows(design::beside(plant.B, estimator.L_predictor))},
          {"C", rows(design::identity(nx) - design::multiply(told, plant.C))},
          {"D", rows(design::beside(design::zeros(nx, nu), told))}};
}

// Over the equations of the plant.
Json extended(const Controller& controller) {
  const design::Plant& plant = controller.problem.plant;
  const design::Extended& filter = *controller.problem.estimator->extended;
  Json wraps = Json::array();
  for (const int output : filter.wraps) wraps.push_back(plant.outputs[static_cast<std::size_t>(output)].name);
  Json out = {{"wraps", wraps}};
  if (plant.domain == design::Domain::continuous)
    out["integrator"] = filter.integrator == design::Integrator::euler ? "euler" : "rk4";
  return out;
}

// A filter that never becomes steady has its form alone.
Json kalman(const Controller& controller) {
  Json out = {{"form", controller.is_predictor ? "predictor" : "filter"}};
  if (controller::is_extended(controller)) out["extended"] = extended(controller);
  if (!controller.solution.estimator || controller.solution.compensator) return out;
  const design::EstimatorSolution& estimator = *controller.solution.estimator;
  out["L"] = rows(estimator.L);
  out["L_predictor"] = rows(estimator.L_predictor);
  add(out, "fictitious_noise", estimator.fictitious);
  add(out, "P_prior", estimator.P_prior);
  add(out, "P_posterior", estimator.P_posterior);
  add(out, "S", estimator.S);
  add(out, "L_continuous", estimator.L_continuous);
  add(out, "P_continuous", estimator.P_continuous);
  out["observer"] = observer(controller);
  out["poles"] = poles(estimator.poles);
  add(out, "schedule", estimator.L_schedule);
  if (estimator.structure) out["structure"] = structure(*estimator.structure, controller.problem.plant.sample_time);
  return out;
}

// Of the loop as it is designed, or as it is rounded.
template <class Loop>
Json poles_margins_and_cost(const Loop& loop, double sample_time) {
  Json out = {{"poles", poles(loop.poles)}};
  add_margins(out, loop.at_input, sample_time);
  Json at_output = Json::object();
  add_margins(at_output, loop.at_output, sample_time);
  if (!at_output.empty()) out["at_output"] = at_output;
  add(out, "cost_per_sample", loop.cost_per_sample);
  return out;
}

// Margin against cost.
Json transfer_recovery(const design::RecoveryReport& report, double sample_time) {
  Json points = Json::array();
  const std::optional<double>& without = report.points.front().cost_per_sample;
  for (const design::RecoveryPoint& point : report.points) {
    Json one = {{"q", point.q}};
    add_margins(one, point.at_input, sample_time);
    add(one, "cost_per_sample", point.cost_per_sample);
    if (without && *without > 0 && point.cost_per_sample) one["cost_ratio"] = *point.cost_per_sample / *without;
    points.push_back(one);
  }
  return {{"q", report.q}, {"points", points}};
}

Json loop(const design::LoopSolution& solution, double sample_time) {
  Json out = poles_margins_and_cost(solution, sample_time);
  add(out, "cost_per_second", solution.cost_per_second);
  if (solution.rms) out["rms"] = {{"x", solution.rms->x}, {"u", solution.rms->u}, {"y", solution.rms->y}};
  if (solution.rounded) out["rounded"] = poles_margins_and_cost(*solution.rounded, sample_time);
  if (solution.recovery) out["transfer_recovery"] = transfer_recovery(*solution.recovery, sample_time);
  return out;
}

Json stages(const std::vector<design::StageSolution>& stages) {
  Json out = Json::array();
  for (const design::StageSolution& stage : stages) {
    Json one = {{"from", stage.from},
                {"plant",
                 {{"A", rows(stage.plant.A)},
                  {"B", rows(stage.plant.B)},
                  {"C", rows(stage.plant.C)},
                  {"D", rows(stage.plant.D)},
                  {"G", rows(stage.plant.G)}}}};
    if (stage.noise) one["noise"] = noise(*stage.noise);
    if (stage.cost) one["cost"] = cost(*stage.cost);
    out.push_back(one);
  }
  return out;
}

// Of each form that was looked at: "multiply_adds": {"physical": …}.
template <class Value>
Json of_each_form(const FormChoice& forms, Value value) {
  Json out = {{"physical", value(forms.physical)}};
  if (forms.folded) out["folded"] = value(*forms.folded);
  if (forms.modal) out["modal"] = value(*forms.modal);
  return out;
}

Json realisation(const Controller& controller) {
  const FormChoice& forms = *controller.forms;
  Json out = {{"kind", controller::name_of(forms.chosen)},
              {"multiply_adds", of_each_form(forms, [](const FormCost& of) { return of.multiply_adds; })},
              {"rounding_error", of_each_form(forms, [](const FormCost& of) { return of.rounding_error; })}};
  if (forms.physical.share_of_deviation)
    out["share_of_deviation"] = of_each_form(forms, [](const FormCost& of) { return *of.share_of_deviation; });
  if (controller.linear || controller.modal) {
    out["condition"] = controller.linear ? controller.linear->condition : controller.modal->condition;
    out["agreement_digits"] = std::floor(chosen_form(*controller.forms).agreement);
  }
  return out;
}

Json compensator(const design::LinearForm& form) {
  Json out = {{"A", rows(form.A)},
              {"B", rows(form.B)},
              {"C", rows(form.C)},
              {"D", rows(form.D)},
              {"T", rows(form.T)},
              {"expected", rows(form.expected)},
              {"estimate", rows(form.estimate)},
              {"heard", rows(form.heard)},
              {"of_state", rows(form.of_state)}};
  add(out, "keep", form.keep);
  out["z0"] = rows(form.z0);
  return out;
}

// What is known of a compensator of a given order, beside its form.
void add_optimum(const Controller& controller, Json& out) {
  const design::CompensatorSolution& own = *controller.solution.compensator;
  out["order"] = own.A.rows();
  out["estimates"] = own.estimates;
  out["poles"] = poles(own.poles);
  out["P"] = rows(own.P);
  if (own.A_continuous.size() > 0) {
    out["continuous"] = {{"A", rows(own.A_continuous)}, {"B", rows(own.B_continuous)}, {"C", rows(own.C_continuous)}};
    add(out, "held_cost_per_second", own.held_cost_per_second);
  }
  out["starts"] = own.starts;
  out["reached"] = own.reached;
  out["curvature"] = own.curvature;
  add(out, "cost_of_full_order", own.full_cost);
  add(out, "gap_percent", gap_percent(own));
}

Json white_parameters(const Controller& controller) {
  const design::WhiteReport& white = *controller.solution.white;
  const double sample_time = controller.problem.plant.sample_time;
  Json unaware = Json::object();
  add(unaware, "K", white.K_unaware);
  unaware["growth"] = white.growth_unaware;
  add(unaware, "cost_per_sample", white.cost_unaware);
  add_margins(unaware, white.margins_unaware, sample_time);
  Json out = {{"growth", white.growth}};
  add(out, "nominal_cost_per_sample", white.cost_nominal);
  out["unaware"] = unaware;
  return out;
}

Json modes(const design::ModalPlant& modal) {
  Json out = {{"T", rows(modal.T)},       {"inverse", rows(modal.inverse)}, {"A", rows(modal.plant.A)},
              {"B", rows(modal.plant.B)}, {"C", rows(modal.plant.C)},       {"D", rows(modal.plant.D)},
              {"G", rows(modal.plant.G)}, {"z0", rows(modal.z0)},           {"P0", rows(modal.online.P0)}};
  add(out, "K", modal.K);
  return out;
}

Json bounds(const Controller& controller) {
  const controller::Bounds& bounds = controller.bounds;
  Json out = {{controller::kept_name(controller), controller::powers_of_two(bounds.x)},
              {"innovation", numbers(bounds.innovation)}};
  if (!bounds.xi.empty()) out["xi"] = controller::powers_of_two(bounds.xi), out["error"] = numbers(bounds.error);
  return out;
}

Json recovery(const controller::Recovery& recovery) {
  Json out = Json::object();
  if (recovery.samples) out["samples"] = recovery.samples;
  out["within"] = numbers(recovery.within);
  add(out, "lasting", recovery.lasting);
  return out;
}

Json code(const Controller& controller) {
  Json out = {{"real", controller.target.is_double ? "double" : "float"},
              {"arithmetic", controller.target.is_fused ? "fused" : "plain"},
              {"style", style_of(controller)},
              {"flash", controller.cost.flash},
              {"ram", controller.cost.ram},
              {"stack", controller.cost.stack},
              {"multiply_adds", controller.cost.multiply_adds}};
  for (const auto& [core, instructions] : controller.cost.instructions) out["instructions"][core] = instructions;
  if (controller.forms) out["realisation"] = realisation(controller);
  return out;
}

}  // namespace

std::string json(const Controller& controller) {
  const design::Solution& solution = controller.solution;
  Json out = {{"name", controller.problem.name},
              {"brief", controller.problem.brief},
              {"lqgen", version()},
              {"design_file", {{"name", controller.source.file}, {"sha256", controller.source.sha256}}},
              {"plant", plant(controller)}};
  if (const auto& point = controller.problem.plant.operating_point) out["operating_point"] = operating_point(*point);
  if (!controller.problem.parameters.empty()) out["parameters"] = parameters(controller.problem.parameters);
  if (!controller.problem.formulas.empty()) out["expressions"] = expressions(controller.problem.formulas);
  if (solution.estimator && solution.estimator->noise.V.size() > 0)
    out["noise"] = noise(solution.estimator->noise);
  else if (solution.noise)
    out["noise"] = noise(*solution.noise);
  if (solution.regulator) {
    const design::RegulatorSolution& regulator = *solution.regulator;
    if (regulator.cost.R.size() > 0) {
      out["cost"] = cost(regulator.cost);
      add(out["cost"], "Q_final", regulator.Q_final);
    }
    if (!solution.compensator) out["lqr"] = lqr(controller);
    if (controller.has.foresight) out["limits"] = foreseen_limits(controller);
  }
  if (controller.has.filter) out["kalman"] = kalman(controller);
  if (!solution.stages.empty()) out["stages"] = stages(solution.stages);
  if (controller.linear) out["compensator"] = compensator(*controller.linear);
  if (solution.compensator) add_optimum(controller, out["compensator"]);
  if (solution.white) out["uncertain"] = white_parameters(controller);
  if (controller.modal) out["modes"] = modes(*controller.modal);
  out["loop"] = loop(solution.loop, controller.problem.plant.sample_time);
  out["numerics"] = {{"digits", solution.numerics.digits}, {"condition", solution.numerics.condition}};
  if (!controller.bounds.x.empty()) out["numerics"]["bounds"] = bounds(controller);
  if (controller.has.filter && !controller::is_extended(controller)) out["recovery"] = recovery(controller.recovery);
  out["code"] = code(controller);
  return out.dump(2) + "\n";
}

}  // namespace lqg::emit
