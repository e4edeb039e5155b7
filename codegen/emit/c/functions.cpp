// SPDX-License-Identifier: MIT
#include "emit/c/functions.hpp"

#include "emit/c/linear_functions.hpp"
#include "emit/c/straight_line.hpp"
#include "emit/c/templates.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

bool is_steady(const Controller& controller) { return controller.filter == step::Filter::steady; }

std::string init_function(const Controller& controller, const FunctionBodies& bodies) {
  std::string begin = !controller.has.filter  ? "As at the start"
                      : is_steady(controller) ? "x̂ = x0"
                                              : "x̂ = x0, its covariance P0";
  if (controller.size.nxi) begin += ", ξ = 0";
  if (controller.size.nr) begin += ", r = 0";
  return write_function(templates::init, controller, {{"begin", begin}, {"body", bodies.init}});
}

// What stays after a reset.
std::string what_stays(const Controller& controller) {
  std::string out;
  for (const auto& [stays, what] :
       {std::pair(controller.size.nr > 0, "r"), std::pair(controller.keeps.sample, "the time"),
        std::pair(controller.has.filter, "what was counted")})
    if (stays) out += std::string(out.empty() ? ", but for " : " and ") + what;
  return out;
}

// Outside of the functions that call it, where it would cost every sample registers.
std::string reset_function(const Controller& controller) {
  const std::string but = what_stays(controller);
  return write_function(templates::reset, controller,
                        {{"but", but},
                         {"counts", controller.has.filter ? ", and counts it" : ""},
                         {"within", controller.bounds.x.empty() ? "finite" : "within its bounds"}},
                        {{"anything_stays", !but.empty()}});
}

std::string recover_function(const Controller& controller, const FunctionBodies& bodies) {
  if (!carries_covariance(controller)) return "";
  return write_function(templates::recover, controller,
                        {{"memory", controller.size.nxi ? ", ξ" : ""}, {"body", bodies.recover}});
}

std::string weigh_function(const Controller& controller, const FunctionBodies& bodies) {
  if (bodies.weigh.empty()) return "";
  return write_function(templates::weigh, controller,
                        {{"gate", decimal(controller.gate.sigma)}, {"body", bodies.weigh}});
}

// What an update or a prediction may say of P.
std::string covariance_status(const Controller& controller) {
  return carries_covariance(controller) ? " LQG_COVARIANCE_RESET," : "";
}

// What happens to an output that cannot be used, and what an update may say.
Words update_words(const Controller& controller) {
  const std::string sigma = decimal(controller.gate.sigma);
  return {{"unusable", controller.has.gate ? "that is not finite, absurd or more than " + sigma + " σ off"
                                           : "that is not finite or absurd"},
          {"left_out", is_steady(controller) ? "is taken as having come as expected" : "is left out of this sample"},
          {"gated", controller.has.gate ? " LQG_OUTPUT_GATED," : ""},
          {"not_positive", controller.filter == step::Filter::plain ? " LQG_INNOVATION_NOT_POSITIVE," : ""},
          {"covariance_reset", covariance_status(controller)},
          {"gain", is_steady(controller) ? "" : ",  L = P Cᵀ S⁻¹,  P ← P − L C P"},
          {"law",
           controller.has.feedthrough ? "x̂ ← x̂ + L (y − C x̂ − D u),  u the input that acts" : "x̂ ← x̂ + L (y − C x̂)"}};
}

std::string update_function(const Controller& controller, const FunctionBodies& bodies) {
  Words words = update_words(controller);
  words["body"] = bodies.update;
  return write_function(templates::update, controller, words);
}

// Why an update by one output alone is what it is.
std::string company(const Controller& controller) {
  if (controller.size.ny == 1) return "There is no other: it is the update.";
  if (is_steady(controller)) return "An approximation: its gain is the best in the company of the other outputs only.";
  if (controller.keeps.innovation) return "At most one such call between two predictions: w and v are correlated.";
  return "Exact, in any order, as often as there is something to hear.";
}

std::string update_alone_functions(const Controller& controller, const FunctionBodies& bodies) {
  std::string out;
  std::size_t at = 0;
  for (int i = 0; i < controller.size.ny; ++i) {
    if (!can_update_alone(controller, i)) continue;
    const design::Signal& signal = controller.problem.plant.outputs[static_cast<std::size_t>(i)];
    Words words = update_words(controller);
    words["output"] = signal.name;
    words["unit"] = signal.unit.empty() ? "in its unit" : "in " + signal.unit;
    words["company"] = company(controller);
    words["body"] = bodies.updates_alone[at++];
    out += write_function(templates::update_alone, controller, words);
  }
  return out;
}

std::string innovation_function(const Controller& controller) {
  if (controller.has.stages) return "";
  const std::string variance =
      is_steady(controller) ? " and the steady variance of each" : " and the variance of each, C P Cᵀ + V";
  return write_function(templates::innovation, controller,
                        {{"law", controller.has.feedthrough ? "y − C x̂ − D u" : "y − C x̂"},
                         {"variance", controller.has.variance ? variance : ""},
                         {"body", body(controller, trace_innovation(controller), {"self", "y"})}});
}

std::string why_partial(const Controller& controller) {
  if (is_steady(controller)) return "An approximation: the gains are the best in the company of all outputs.";
  if (controller.keeps.innovation)
    return "An approximation, and to be called once between two predictions: w and v are correlated.";
  return "Exact: as if the others were not there in this sample.";
}

// Where there is something to choose from, and a NAME_innovation to look at the outputs with.
std::string partial_update_function(const Controller& controller) {
  constexpr int bits_of_long = 32;  // at least
  if (controller.size.ny < 2 || controller.size.ny > bits_of_long || controller.has.stages) return "";
  Words words = update_words(controller);
  words["exact"] = why_partial(controller);
  words["FIRST"] = upper(controller.problem.plant.outputs.front().name);
  words["lost"] = collect_lost(trace_lost_outputs(controller));
  return write_function(templates::partial_update, controller, words);
}

std::string predict_function(const Controller& controller, const FunctionBodies& bodies) {
  return write_function(
      templates::predict, controller,
      {{"input", controller.size.nu ? " + B u" : ""},
       {"covariance", is_steady(controller) ? "" : ",  P ← A P Aᵀ + G W Gᵀ"},
       {"covariance_reset", covariance_status(controller)},
       {"integral", controller.size.nxi ? ",  ξ ← ξ + H (u − what control asked for) + T (r − y)" : ""},
       {"body", bodies.predict}});
}

std::string control_function(const Controller& controller, const FunctionBodies& bodies) {
  const bool has_filter = controller.has.filter, writes = control_changes_state(controller);
  return write_function(
      templates::control, controller,
      {{"law", equation_of_law(controller)},
       {"on_their_way", controller.size.delayed ? "; behind it the inputs on their way, the oldest first" : ""},
       {"limits", controller.problem.limits ? " and within the limits" : ""},
       {"reference", controller.size.nr ? "LQG_REFERENCE_NOT_FINITE (such an r counts as 0), " : ""},
       {"reset", !has_filter && controller.has.servo ? ", LQG_STATE_RESET" : ""},
       {"body", bodies.control}},
      {{"writes_beside_filter", has_filter && writes},
       {"reads_beside_filter", has_filter && !writes},
       {"remembers", !has_filter && controller.keeps.any}});
}

std::string step_function(const Controller& controller) {
  const bool acts = controller.has.regulator, is_predictor = controller.is_predictor;
  const std::string order = !acts          ? "update and predict"
                            : is_predictor ? "control, update and predict, for an actuator that applies u as it is"
                                           : "update, control and predict, for an actuator that applies u as it is";
  return write_function(templates::step, controller, {{"order", order}},
                        {{"is_told_u", !acts && controller.size.nu},
                         {"control_first", acts && is_predictor},
                         {"control_second", acts && !is_predictor}});
}

std::string covariance_function(const Controller& controller) {
  if (controller.filter != step::Filter::ud) return "";
  Words words = {{"triangle", std::to_string(controller.size.nx * (controller.size.nx + 1) / 2)}};
  if (controller.style == design::Style::compact && controller.size.nx > 1)
    return write_function(templates::covariance_in_loops, controller, words);
  words["body"] = body(controller, trace_covariance(controller), {});
  return write_function(templates::covariance, controller, words);
}

std::string set_state_function(const Controller& controller) {
  return write_function(templates::set_state, controller,
                        {{"covariance", is_steady(controller) ? "" : "; its covariance stays"},
                         {"body", body(controller, trace_set_state(controller), {"self", "x"})}},
                        {{"can_set_input", can_set_input(controller)}});
}

std::string set_input_function(const Controller& controller) {
  if (!can_set_input(controller)) return "";
  const TracedFunction traced = trace_set_input(controller);
  return write_function(templates::set_input, controller,
                        {{"delayed", controller.size.delayed ? ", and so are those on their way" : ""},
                         {"integral", controller.size.nxi ? ".\n * ξ becomes such that control goes on there" : ""},
                         {"when", controller.size.nxi && controller.has.filter ? ": to be called before control" : ""},
                         {"body", controller.has.filter ? body(controller, traced, {"self", "u"})
                                                        : body(controller, traced, {"self", "x", "u"})}});
}

}  // namespace

std::string functions(const Controller& controller, const FunctionBodies& bodies) {
  if (controller.linear)
    return init_function(controller, bodies) + reset_function(controller) + linear_functions(controller);
  std::string out;
  if (controller.keeps.any) out += init_function(controller, bodies);
  if (bodies.resets) out += reset_function(controller) + recover_function(controller, bodies);
  if (controller.has.filter) out += weigh_function(controller, bodies) + update_function(controller, bodies);
  if (controller.has.regulator) out += control_function(controller, bodies);
  if (controller.has.filter)
    out += predict_function(controller, bodies) + step_function(controller) + covariance_function(controller) +
           update_alone_functions(controller, bodies) + innovation_function(controller) +
           partial_update_function(controller) + set_state_function(controller);
  return out + set_input_function(controller);
}

}  // namespace lqg::emit
