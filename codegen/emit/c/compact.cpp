// Calls of the library's loops over constant matrices.
#include <algorithm>

#include "controller/model_of.hpp"
#include "controller/state_fields.hpp"
#include "emit/c/compact_constants.hpp"
#include "emit/c/function_bodies.hpp"
#include "emit/c/straight_line.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

namespace {

// The library restores the filter alone after a fault; the rest, and counting, is up to us.
bool needs_reset(const Controller& controller) {
  return controller.has.filter || controller.size.nxi > 0 || controller.has.last_input || can_set_input(controller);
}

std::string multiply_add(const Controller& controller, const std::string& a, const std::string& b) {
  if (!controller.target.is_fused) return "y[i] + " + a + " * " + b;
  return std::string(controller.target.is_double ? "fma(" : "fmaf(") + a + ", " + b + ", y[i])";
}

// The words of a call of the filter: its description, its state, and how long its scratch is.
Words call_words(const Controller& controller) {
  Words words = common_words(controller);
  const std::string u_applied = controller.has.feedthrough ? "self->u_applied" : "NULL";
  const std::string innovation = controller.keeps.innovation ? "self->innovation" : "NULL";
  std::string covariance, nq;
  if (controller.filter == step::Filter::plain) covariance = "self->P, ";
  if (controller.filter == step::Filter::ud) {
    covariance = controller.size.nx > 1 ? "self->U, self->d, " : "NULL, self->d, ";
    Eigen::Index most = 0;
    for (const std::size_t start : controller.stage_starts) most = std::max(most, online_at(controller, start).G.cols());
    nq = ", " + std::to_string(most);
  }
  words["FILTER"] = upper(words["filter"]);
  words["nq"] = nq;
  words["state"] = "self->x, " + covariance + u_applied + ", " + innovation;
  words["u"] = controller.size.nu ? "u" : "NULL";
  words["plant"] = fill(controller.has.stages ? "{name}_kalman(self)" : "&{NAME}_KALMAN", words);
  words["first"] = fill(controller.has.stages ? "&{NAME}_KALMAN[0]" : "&{NAME}_KALMAN", words);
  words["kalman"] = controller.keeps.gain_row ? "&kalman" : words["plant"];
  words["servo"] = has_law_table(controller) ? "&servo" : fill("&{NAME}_SERVO", words);
  words["lqr"] = has_law_table(controller) ? "&lqr" : fill("&{NAME}_LQR", words);
  words["variances"] = controller.filter == step::Filter::steady ? fill(controller.keeps.gain_row ? "{NAME}_KALMAN_S + self->gain_row * {NAME}_NY, " : "{NAME}_KALMAN_S, ", words) : "";
  const bool integrates = controller.size.nxi > 0;
  words["r"] = controller.size.nr ? "self->r" : "NULL";
  words["memory"] = integrates ? "self->xi, self->error, self->demand, " : "NULL, NULL, NULL, ";
  words["memory"] += controller.has.last_input ? "self->u_applied" : "NULL";
  words["before"] = integrates ? "self->xi, self->demand, " : "NULL, NULL, ";
  words["before"] += controller.has.last_input ? "self->u_applied" : "NULL";
  words["x"] = controller.has.filter ? "self->x" : "x";
  return words;
}

// Copies of the descriptions that point to the gains of this sample.
std::string gains_of_sample(const Controller& controller) {
  if (!controller.keeps.gain_row) return "";
  return std::string("    lqg_kalman_steady_t kalman = *{plant};\n") +
         "    kalman.L += self->gain_row * ({NAME}_NX * {NAME}_NY);\n" +
         (controller.keeps.innovation ? "    kalman.M += self->gain_row * ({NAME}_NX * {NAME}_NY);\n" : "");
}

std::string law_of_sample(const Controller& controller) {
  if (!has_law_table(controller)) return "";
  const auto advance = [&](const char* law, const char* matrix, std::size_t at) {
    const design::RealMatrix& gain = controller.laws.front()[at];
    if (gain.size() == 0) return std::string();
    return "    " + std::string(law) + "." + matrix + " += " + row_of_law(controller) + " * " + std::to_string(gain.size()) + ";\n";
  };
  if (!controller.has.servo) return "    lqg_lqr_t lqr = {NAME}_LQR;\n" + advance("lqr", "K", 0);
  return "    lqg_servo_t servo = {NAME}_SERVO;\n" + advance("servo", "K", 0) + advance("servo", "Nbar", 1) +
         advance("servo", "H", 2);
}

// What a failed call leads to; nothing where the library has restored all there is.
std::string end(const Controller& controller) {
  return needs_reset(controller) ? "    return status & LQG_STATE_RESET ? {name}_reset(self, status) : status;\n"
                                 : "    return status;\n";
}

std::string init_body(const Controller& controller, const Words& words) {
  std::string out;
  if (controller.has.filter) out += "    lqg_kalman_{filter}_init({first}, {state});\n";
  if (controller.has.servo) out += "    lqg_servo_init(&{NAME}_SERVO, {memory});\n";
  if (controller.size.nr) out += "    for (int i = 0; i < {NAME}_NR; i++)\n        self->r[i] = 0;\n";
  for (const Field& field : state_fields(controller))
    if (field.kind == controller::Kind::counter || field.kind == controller::Kind::total) out += "    self->" + field.name + " = 0;\n";
  if (controller.has.gate) out += "    for (int i = 0; i < {NAME}_NY; i++)\n        self->gated[i] = 0;\n";
  return fill(out, words);
}

// What the library is told of the gate.
std::string watch(const Controller& controller) {
  if (!controller.has.gate) return "";
  return "    const lqg_watch_t watch = {NULL, " + trace::literal(controller.problem.estimator->gate, controller.target.is_double) +
         ", self->gated, NULL, NULL};\n";
}

std::string update_body(const Controller& controller, const Words& words) {
  const std::string work = "    lqg_real work[LQG_KALMAN_{FILTER}_WORK({NAME}_NX, {NAME}_NY{nq})];\n";
  const std::string call = controller.has.gate ? "lqg_kalman_{filter}_update_watched({kalman}, {state}, y, {variances}&watch, work);\n"
                                              : "lqg_kalman_{filter}_update({kalman}, {state}, y, work);\n";
  return fill(work + gains_of_sample(controller) + watch(controller) + "    const lqg_status status = " + call + "\n" +
                  (controller.size.nxi ? "    lqg_servo_observe(&{NAME}_SERVO, self->r, self->error, y);\n" : "") +
                  end(controller), words);
}

// The update by one output, and r − y of it where it is integrated.
std::string update_alone_body(const Controller& controller, Words words, int output) {
  const bool is_steady = controller.filter == step::Filter::steady;
  words["i"] = std::to_string(output);
  words["y"] = "y_" + controller.problem.plant.outputs[static_cast<std::size_t>(output)].name;
  words["watch"] = controller.has.gate ? "&watch" : "NULL";
  words["s"] = !is_steady ? "" : controller.has.gate ? words["variances"] : "NULL, ";
  words["scratch"] = is_steady ? "" : ", work";
  std::string out = is_steady ? "" : "    lqg_real work[LQG_KALMAN_{FILTER}_WORK({NAME}_NX, {NAME}_NY{nq})];\n";
  out += gains_of_sample(controller) + watch(controller) +
         "    const lqg_status status = lqg_kalman_{filter}_update_output({kalman}, {state}, {i}, {y}, {s}{watch}{scratch});\n\n";
  out += statements(trace_observation(controller, output));
  return fill("    LQG_STRICT_BODY\n" + out + end(controller), words);
}

std::string predict_body(const Controller& controller, const Words& words) {
  const std::string work = "    lqg_real work[LQG_KALMAN_{FILTER}_WORK({NAME}_NX, {NAME}_NY{nq})];\n";
  const std::string call = "lqg_kalman_{filter}_predict({kalman}, {state}, {u}, work)";
  const std::string counters = advance_counters(controller);
  const bool remembers = controller.size.nxi > 0 || controller.has.last_input;
  return fill(work + gains_of_sample(controller) + (remembers ? law_of_sample(controller) : "") +
                  "    lqg_status status = " + call + ";\n\n" +
                  (remembers ? "    status |= lqg_servo_advance({servo}, {memory}, u);\n" : "") + counters +
                  end(controller), words);
}

std::string control_call(const Controller& controller) {
  if (controller.has.servo) return "lqg_servo_control({servo}, {x}, {r}, {before}, u)";
  return "lqg_lqr_control({lqr}, {x}, u)";
}

std::string control_body(const Controller& controller, const Words& words) {
  const std::string call = control_call(controller), law = law_of_sample(controller);
  if (controller.has.feedthrough)
    return fill(law + "    const lqg_status status = " + call + R"(;

    for (int i = 0; i < {NAME}_NU; i++)
        self->u_applied[i] = u[i];
    return status;
)", words);
  return fill(law + (law.empty() ? "    return " : "\n    return ") + call + ";\n", words);
}

// y = C x + D u of the outputs that a regulator alone integrates; the others are not looked at.
std::string outputs_of_state(const Controller& controller, std::string& constants) {
  Tables tables(controller, "PLANT");
  const design::SampledPlant& plant = controller.solution.plant;
  const int ny = static_cast<int>(plant.C.rows());
  const std::string C = tables.add("C", plant.C), D = tables.add_unless_zero("D", plant.D);
  constants += tables.text;
  std::string out = "    lqg_real y[" + std::to_string(ny) + "];\n    for (int i = 0; i < " + std::to_string(ny) +
                    "; i++) {\n        y[i] = 0;\n        for (int j = 0; j < {NAME}_NX; j++)\n            y[i] = " +
                    multiply_add(controller, C + "[i * {NAME}_NX + j]", "x[j]") + ";\n";
  if (D != "NULL")
    out += "        for (int j = 0; j < {NAME}_NU; j++)\n            y[i] = " +
           multiply_add(controller, D + "[i * {NAME}_NU + j]", "u[j]") + ";\n";
  return out + "    }\n    lqg_servo_observe(&{NAME}_SERVO, self->r, self->error, y);\n";
}

// A regulator alone that has a state: law and memory in one call.
std::string act_body(const Controller& controller, const Words& words, std::string& constants) {
  const std::string counters = advance_counters(controller);
  std::string out = "    LQG_STRICT_BODY\n" + law_of_sample(controller) + "    lqg_status status = " +
                    control_call(controller) + ";\n\n";
  if (controller.size.nxi) out += outputs_of_state(controller, constants);
  if (controller.size.nxi || controller.has.last_input) out += "    status |= lqg_servo_advance({servo}, {memory}, u);\n";
  return fill(out + counters + end(controller), words);
}

std::string options_check(const Controller& controller) {
  const auto check = [&](const char* option, bool wanted, const char* what) {
    return std::string(wanted ? "#ifndef " : "#ifdef ") + option + "\n#error \"" + controller.problem.name + ".h " +
           what + ": " + (wanted ? "define " : "do not define ") + option +
           " for the library and for this file, or run lqgen with other options.\"\n#endif\n";
  };
  return check("LQG_REAL_DOUBLE", controller.target.is_double, controller.target.is_double ? "computes in double" : "computes in float") +
         check("LQG_FUSED", controller.target.is_fused,
               controller.target.is_fused ? "uses fused multiply-adds" : "uses plain arithmetic");
}

}  // namespace

FunctionBodies compact_bodies(const Controller& controller) {
  FunctionBodies bodies;
  bodies.includes = std::string(controller.target.is_fused || controller.size.ny > 1 ? "#include <math.h>\n" : "") +
                    "#include <stddef.h>\n\n#include \"lqg/lqg.h\"\n\n" + options_check(controller);
  const Words words = call_words(controller);
  bodies.resets = needs_reset(controller);
  if (controller.keeps.any) bodies.init = init_body(controller, words);
  if (controller.has.filter) {
    bodies.constants = kalman_constants(controller);
    bodies.update = update_body(controller, words);
    bodies.predict = predict_body(controller, words);
    for (int i = 0; i < controller.size.ny && controller.size.ny > 1; ++i)
      if (can_update_alone(controller, i)) bodies.updates_alone.push_back(update_alone_body(controller, words, i));
    if (controller.size.ny == 1) bodies.updates_alone = {only_update_body(controller)};
  }
  if (controller.has.regulator) {
    bodies.constants += controller.has.servo ? servo_constants(controller) : lqr_constants(controller);
    bodies.control = controller.has.filter || !controller.keeps.any ? control_body(controller, words)
                                                                        : act_body(controller, words, bodies.constants);
  }
  return bodies;
}

}  // namespace lqg::emit
