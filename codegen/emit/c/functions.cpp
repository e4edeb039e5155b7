// SPDX-License-Identifier: MIT
#include "emit/c/functions.hpp"

#include "emit/c/foresight.hpp"
#include "emit/c/linear_functions.hpp"
#include "emit/c/straight_line.hpp"
#include "emit/c/templates.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

bool is_steady(const Controller& controller) { return controller.filter == step::Filter::steady; }

std::string init_function(const Controller& controller, const FunctionBodies& bodies) {
  std::string begin = controller.solution.compensator ? "z of x = x0"
                      : controller.linear             ? "z of x̂ = x0"
                      : !controller.has.filter        ? ""
                      : is_steady(controller)         ? "x̂ = x0"
                      : controller.modal              ? "z and P of x̂ = x0, its covariance P0"
                                                      : "x̂ = x0, its covariance P = P0";
  const auto add = [&](bool is_kept, const char* what) {
    if (is_kept) begin += (begin.empty() ? "" : ", ") + std::string(what);
  };
  add(controller.size.nxi > 0, "ξ = 0");
  add(controller.size.nr > 0, controller.point.r.size() ? "r = the outputs of the operating point" : "r = 0");
  add(controller.keeps.input,
      controller.point.u.size() ? "last input = that of the operating point" : "last input = 0");
  add(controller.keeps.sample, "sample 0");
  add(controller.has.filter, "counters = 0");
  return write_function(templates::init, controller, {{"begin", begin}, {"body", bodies.init}});
}

// What a reset keeps: ", keeps the counters and r".
std::string what_stays(const Controller& controller) {
  std::string out;
  for (const auto& [stays, what] :
       {std::pair(controller.has.filter, "the counters"), std::pair(controller.size.nr > 0, "r"),
        std::pair(controller.keeps.sample, "the sample number")})
    if (stays) out += std::string(out.empty() ? ", keeps " : " and ") + what;
  return out;
}

// Outside of the functions that call it, where it would cost every sample registers.
std::string reset_function(const Controller& controller) {
  const std::string but = what_stays(controller);
  return write_function(templates::reset, controller,
                        {{"but", but},
                         {"counts", controller.has.filter ? ", increments `resets`" : ""},
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

// The bits that an update may return. Its bounds check finds no fault of U and d: that is up to predict.
std::string statuses_of_update(const Controller& controller) {
  const bool is_plain = controller.filter == step::Filter::plain;
  return std::string(" LQG_OUTPUT_REJECTED,") + (controller.has.gate ? " LQG_OUTPUT_GATED," : "") +
         (is_plain ? " LQG_INNOVATION_NOT_POSITIVE, LQG_COVARIANCE_RESET," : "") + " LQG_STATE_RESET";
}

// Which values of an output are not used.
std::string unusable(const Controller& controller) {
  return std::string("that is not finite") + (controller.has.range ? ", out of its sensor's range" : "") +
         (controller.has.gate ? ", or further than " + decimal(controller.gate.sigma) + " σ from its expected value"
                              : " or so large that x̂ could leave its bounds");
}

// What an output is compared with.
std::string expected_output(const Controller& controller) {
  const bool hears_input = controller.has.feedthrough;
  if (controller::is_extended(controller)) return hears_input ? "h(x̂, u)" : "h(x̂)";
  return hears_input ? "C x̂ − D u" : "C x̂";
}

Words update_words(const Controller& controller) {
  const bool is_extended = controller::is_extended(controller);
  const std::string rest_of_law = controller.has.feedthrough ? "), u: the input that acts" : ")";
  return {{"unusable", unusable(controller)},
          {"left_out", is_steady(controller) ? "counts as equal to its expected value: its innovation is 0"
                                             : "is not used in this sample"},
          {"statuses", statuses_of_update(controller)},
          {"gain", is_steady(controller) ? ""
                   : is_extended         ? ",\n * L = P Cᵀ S⁻¹,  P ← P − L C P,  C: the Jacobian of h at x̂"
                                         : ",  L = P Cᵀ S⁻¹,  P ← P − L C P"},
          {"law", "x̂ ← x̂ + L (y − " + expected_output(controller) + rest_of_law}};
}

std::string update_function(const Controller& controller, const FunctionBodies& bodies) {
  Words words = update_words(controller);
  words["body"] = bodies.update;
  return write_function(templates::update, controller, words);
}

// How good an update by one output alone is.
std::string quality_alone(const Controller& controller) {
  if (controller.size.ny == 1) return "It is the only output: the same as update.";
  if (is_steady(controller)) return "An approximation: its gain is optimal only when all outputs are used together.";
  if (controller.keeps.innovation) return "At most one such call between two predictions: w and v are correlated.";
  return "Exact, in any order, and as often as there is a new value.";
}

std::string update_alone_functions(const Controller& controller, const FunctionBodies& bodies) {
  std::string out;
  std::size_t at = 0;
  for (int i = 0; i < controller.size.ny; ++i) {
    if (!has_update_alone(controller, i)) continue;
    const design::Signal& signal = controller.problem.plant.outputs[static_cast<std::size_t>(i)];
    Words words = update_words(controller);
    words["output"] = signal.name;
    words["unit"] = signal.unit.empty() ? "in its unit" : "in " + signal.unit;
    words["quality"] = quality_alone(controller);
    words["body"] = bodies.updates_alone[at++];
    out += write_function(templates::update_alone, controller, words);
  }
  return out;
}

std::string innovation_function(const Controller& controller) {
  if (controller.has.stages) return "";
  const std::string variance =
      is_steady(controller) ? " and their variances in the steady state" : " and their variances C P Cᵀ + V";
  return write_function(templates::innovation, controller,
                        {{"law", "y − " + expected_output(controller)},
                         {"variance", controller.has.variance ? variance : ""},
                         {"body", body(controller, trace_innovation(controller), {"self", "y"})}});
}

std::string why_partial(const Controller& controller) {
  if (is_steady(controller)) return "An approximation: the gains are optimal only when all outputs are used together.";
  if (controller.keeps.innovation)
    return "An approximation. At most one such call between two predictions: w and v are correlated.";
  return "Exact: as if the plant did not have the other outputs in this sample.";
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

std::string predicted_state(const Controller& controller) {
  if (!controller::is_extended(controller)) return controller.size.nu ? "A x̂ + B u" : "A x̂";
  const std::string f = controller.size.nu ? "f(x̂, u)" : "f(x̂)", jacobian = ", A: the Jacobian of that";
  if (controller.problem.plant.domain == design::Domain::discrete) return f + jacobian;
  return "x̂ + ∫ " + f + " dt over a period" + jacobian;
}

std::string predict_function(const Controller& controller, const FunctionBodies& bodies) {
  return write_function(
      templates::predict, controller,
      {{"state", predicted_state(controller)},
       {"covariance", is_steady(controller) ? "" : ",  P ← A P Aᵀ + G W Gᵀ"},
       {"covariance_reset", covariance_status(controller)},
       {"integral", controller.size.nxi ? ",\n *                              ξ ← ξ + H (u − demand) + T (r − y)" : ""},
       {"body", bodies.predict}});
}

std::string control_function(const Controller& controller, const FunctionBodies& bodies) {
  const bool has_filter = controller.has.filter, writes = control_changes_state(controller);
  const bool limits = controller.problem.limits.has_value(), foresees = controller.has.foresight;
  const Words common = common_words(controller);
  const std::string u_at_rest = common.at("u_at_rest"), r_at_rest = common.at("r_at_rest");
  return (foresees ? law_function(controller, bodies.control) : "") +
         write_function(
             templates::control, controller,
             {{"law", equation_of_law(controller)},
              {"within_limits", foresees ? ", or the u of least cost that keeps the limits from now to their horizon"
                                : limits ? ", limited"
                                         : ""},
              {"delayed", controller.size.delayed ? "; after them the delayed inputs, the oldest first" : ""},
              {"limits", limits ? " and within the limits" : ""},
              {"reference",
               controller.size.nr ? "LQG_REFERENCE_NOT_FINITE (such an r counts as " + r_at_rest + "), " : ""},
              {"limited", foresees
                              ? " (a limit holds an input, or it was not finite and set to " + u_at_rest +
                                    "), LQG_NOT_OPTIMAL (the limits contradict each other or took too many changes: "
                                    "the law is clipped)"
                          : limits ? " (at a limit, or not finite and set to " + u_at_rest + ")"
                                   : " (not finite and set to " + u_at_rest + ")"},
              {"reset", !has_filter && controller.has.servo && !foresees ? ", LQG_STATE_RESET" : ""},
              {"body", foresees ? foreseeing_control_body(controller) : bodies.control}},
             {{"writes_beside_filter", has_filter && writes},
              {"reads_beside_filter", has_filter && !writes},
              {"remembers", !has_filter && controller.keeps.any}});
}

std::string step_function(const Controller& controller, const FunctionBodies& bodies) {
  const bool acts = controller.has.regulator, is_predictor = controller.is_predictor;
  const std::string order = !acts          ? "update, predict"
                            : is_predictor ? "control, update, predict; assumes that the actuator applies u as it is"
                                           : "update, control, predict; assumes that the actuator applies u as it is";
  const bool is_one_text = !bodies.step.empty();
  const std::string body =
      is_one_text ? bodies.step
                  : write_body(templates::step_calls, controller, {},
                               {{"control_first", acts && is_predictor}, {"control_second", acts && !is_predictor}});
  return write_function(templates::step, controller, {{"order", order}, {"body", body}},
                        {{"is_told_u", !acts && controller.size.nu},
                         {"is_one_text", is_one_text},
                         {"acts_in_one_text", is_one_text && acts},
                         {"estimates_in_one_text", is_one_text && !acts}});
}

std::string covariance_function(const Controller& controller) {
  if (controller.filter != step::Filter::ud && !controller.modal) return "";
  Words words = {{"triangle", std::to_string(controller.size.nx * (controller.size.nx + 1) / 2)}};
  if (controller.style == design::Style::compact && controller.size.nx > 1)
    return write_function(templates::covariance_in_loops, controller, words);
  words["law"] = controller.modal ? "P of x̂ = T z, T P Tᵀ" : "P = U diag(d) Uᵀ";
  words["body"] = body(controller, trace_covariance(controller), {});
  return write_function(templates::covariance, controller, words);
}

// Only where what the filter keeps is not x̂ there is something to compute.
std::string estimate_function(const Controller& controller) {
  if (!has_estimate(controller)) return "";
  const char* const kept = controller.modal ? " z is what the filter keeps; only\n * who asks for x̂ pays for it."
                                            : "\n * The filter keeps its deviation from the operating point.";
  return write_function(templates::estimate, controller,
                        {{"what", controller.modal ? "x̂ = T z" : "x̂ in the plant's own units"},
                         {"kept", kept},
                         {"body", body(controller, trace_estimate_in_own_units(controller), {"self"})}});
}

std::string set_state_function(const Controller& controller) {
  return write_function(templates::set_state, controller,
                        {{"covariance", is_steady(controller) ? "" : "; its covariance does not change"},
                         {"what", controller.modal ? "z = T⁻¹ x" : "x"},
                         {"KEPT", upper(controller::kept_name(controller))},
                         {"body", body(controller, trace_set_state(controller), {"self", "x"})}},
                        {{"can_set_input", can_set_input(controller)}});
}

std::string set_input_function(const Controller& controller) {
  if (!can_set_input(controller)) return "";
  const TracedFunction traced = trace_set_input(controller);
  return write_function(
      templates::set_input, controller,
      {{"delayed", controller.size.delayed ? "; sets the delayed inputs, too" : ""},
       {"integral", controller.size.nxi ? " * ξ becomes such that the transfer to automatic is bumpless: "
                                          "the law demands u next.\n"
                                        : ""},
       {"when", controller.size.nxi && controller.has.filter ? " * Call it before control.\n" : ""},
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
  if (controller.has.filter)
    out += weigh_function(controller, bodies) + bodies.helpers + update_function(controller, bodies);
  if (controller.has.regulator) out += control_function(controller, bodies);
  if (controller.has.filter)
    out += predict_function(controller, bodies) + step_function(controller, bodies) + estimate_function(controller) +
           covariance_function(controller) + update_alone_functions(controller, bodies) +
           innovation_function(controller) + partial_update_function(controller) + set_state_function(controller);
  return out + set_input_function(controller);
}

}  // namespace lqg::emit
