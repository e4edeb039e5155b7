// SPDX-License-Identifier: MIT
// Calls of the library's loops over constant matrices.
#include <algorithm>

#include "emit/c/compact_constants.hpp"
#include "emit/c/function_bodies.hpp"
#include "emit/c/operating_point.hpp"
#include "emit/c/straight_line.hpp"
#include "emit/c/templates.hpp"
#include "emit/recorded/trace_listener.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

namespace {

// The library restores the filter alone after a fault; the rest, and counting, is up to us.
bool needs_reset(const Controller& controller) {
  return controller.has.filter || controller.size.nxi > 0 || controller.has.last_input || can_set_input(controller);
}

// A body, the last line without its end, for a line of another.
std::string lines(const char* text, const Controller& controller, const Words& words,
                  const Conditions& conditions = {}) {
  std::string out = write_body(text, controller, words, conditions);
  out.pop_back();
  return out;
}

// How long the scratch of a filter with factors is: for the stage with the most noises.
std::string noises(const Controller& controller) {
  if (controller.filter != step::Filter::ud) return "";
  Eigen::Index most = 0;
  for (const std::size_t start : controller.stage_starts) most = std::max(most, online_at(controller, start).G.cols());
  return ", " + std::to_string(most);
}

// The library's state of the filter over the members of NAME_t; `work` is its scratch.
std::string state_of_filter(const Controller& controller, const std::string& work) {
  const bool has_U = controller.size.nx > 1;
  const std::string covariance = controller.filter == step::Filter::plain ? "self->P, "
                                 : controller.filter != step::Filter::ud  ? ""
                                 : has_U                                  ? "self->U, self->d, "
                                                                          : "NULL, self->d, ";
  return "{self->x, " + covariance + (controller.has.feedthrough ? "self->u_applied, " : "NULL, ") +
         (controller.keeps.innovation ? "self->innovation, " : "NULL, ") +
         (controller.has.gate ? "{self->widening, self->gated}, " : "{NULL, NULL}, ") + work + "}";
}

// The arguments of the filter's calls: its description, its state, and how long its scratch is.
Words filter_words(const Controller& controller) {
  const Words common = common_words(controller);
  const bool is_steady = controller.filter == step::Filter::steady;
  const std::string plant = fill(controller.has.stages ? "{name}_kalman(self)" : "&{NAME}_KALMAN", common);
  Words words = {{"FILTER", upper(filter_name(controller.filter))},
                 {"plant", plant},
                 {"first_stage", fill(controller.has.stages ? "&{NAME}_KALMAN[0]" : "&{NAME}_KALMAN", common)},
                 {"kalman", controller.keeps.gain_row ? "&kalman" : plant},
                 {"state", state_of_filter(controller, "work")},
                 {"state_without_work", state_of_filter(controller, "NULL")},
                 {"state_alone", state_of_filter(controller, is_steady ? "NULL" : "work")},
                 {"u", controller.size.nu ? deviations(controller, 'u') : "NULL"},
                 {"nw", noises(controller)}};
  if (controller.keeps.gain_row)
    words["filter_of_sample"] = lines(templates::compact_filter_of_sample, controller, words);
  return words;
}

// A copy of the law's description that points to the gains of this sample.
std::string law_of_sample(const Controller& controller) {
  const Gains& gains = controller.laws.front();
  const auto size = [&](std::size_t matrix) { return std::to_string(gains[matrix].size()); };
  return lines(templates::compact_law_of_sample, controller,
               {{"K_size", size(0)}, {"Nbar_size", size(1)}, {"H_size", size(2)}},
               {{"has_Nbar", controller.has.servo && gains[1].size() > 0},
                {"has_H", controller.has.servo && gains[2].size() > 0}});
}

// A law that changes nothing takes copies of what it reads: its NAME_t is const.
bool copies_memory(const Controller& controller) {
  return controller.has.filter && controller.has.servo && !controller::control_changes_state(controller);
}

// What reads r takes a copy where it changes nothing, and where r is no deviation from the operating point yet.
bool copies_references(const Controller& controller, bool copies) {
  return controller.size.nr > 0 && (copies || controller.point.r.size() > 0);
}

// "{self->r[0], self->r[1] - TWO_OPERATING_Y_B}"
std::string references(const Controller& controller) {
  std::string out;
  for (int i = 0; i < controller.size.nr; ++i)
    out += (i ? ", " : "") + deviation(controller, 'r', i, element("self->r", i));
  return "{" + out + "}";
}

// The library's state of the law over the members of NAME_t, or over copies of what is only read.
std::string state_of_law(const Controller& controller, bool copies, bool copies_r) {
  const bool integrates = controller.size.nxi > 0;
  return std::string("{") +
         (!controller.size.nr ? "NULL"
          : copies_r          ? "r"
                              : "self->r") +
         (integrates ? ", self->xi, self->error, self->demand, " : ", NULL, NULL, NULL, ") +
         (!controller.has.last_input ? "NULL}"
          : copies                   ? "last}"
                                     : "self->u_applied}");
}

// Of what does not read r.
std::string state_without_references(const Controller& controller) { return state_of_law(controller, false, false); }

// Of what reads all of it.
std::string whole_state(const Controller& controller) {
  return state_of_law(controller, false, copies_references(controller, false));
}

// The call of the law, and the state that it shares with what keeps its memory.
Words law_words(const Controller& controller) {
  const bool has_table = has_law_table(controller);
  Words words = common_words(controller);
  words["servo"] = has_table ? "&servo" : fill("&{NAME}_SERVO", words);
  words["lqr"] = has_table ? "&lqr" : fill("&{NAME}_LQR", words);
  words["memory"] = state_without_references(controller);
  const bool is_told_deviations = controller.has.filter || controller.has.foresight;
  words["x"] = controller.has.filter ? "self->x" : is_told_deviations ? "x" : deviations(controller, 'x');
  words["law"] = fill(
      controller.has.servo ? "lqg_servo_control({servo}, &memory, {x}, u)" : "lqg_lqr_control({lqr}, {x}, u)", words);
  if (has_table) words["law_of_sample"] = law_of_sample(controller);
  return words;
}

bool remembers(const Controller& controller) { return controller.size.nxi > 0 || controller.has.last_input; }

std::string init_body(const Controller& controller) {
  Words words = filter_words(controller);
  words.merge(law_words(controller));
  words["references"] = references_of_point(controller);
  return write_body(templates::compact_init, controller, words);
}

std::string update_body(const Controller& controller) {
  Words words = filter_words(controller);
  words["memory"] = whole_state(controller);
  words["references"] = references(controller);
  words["declare_deviations"] = declare_deviations(controller, 'y');
  words["given"] = deviations(controller, 'y');
  words["y"] = controller.has.range ? "said" : words["given"];
  words["is_out_of_range"] = fill("({given}[i] < {NAME}_KALMAN_Y_MIN[i]) || ({NAME}_KALMAN_Y_MAX[i] < {given}[i])",
                                  {{"given", words["given"]}, {"NAME", upper(controller.problem.name)}});
  return write_body(templates::compact_update, controller, words,
                    {{"copies_r", controller.size.nxi && copies_references(controller, false)}});
}

// The update by one output, and r − y of it where it is integrated.
std::string update_alone_body(const Controller& controller, int output) {
  Words words = filter_words(controller);
  words["i"] = std::to_string(output);
  const std::string own = "y_" + controller.problem.plant.outputs[static_cast<std::size_t>(output)].name;
  const std::string difference = deviation(controller, 'y', output, own);
  const bool has_offset = difference != own;
  words["deviation"] = difference;
  words["given"] = has_offset ? "deviation" : own;
  words["y"] = controller.has.range ? "said" : words["given"];
  words["own"] = has_offset ? own : words["y"];
  const TracedFunction observation = trace_observation(controller, output);
  words["observation"] = statements(observation);
  return write_body(templates::compact_update_alone, controller, words,
                    {{"observes", !observation.stores.empty()}, {"has_offset", has_offset}});
}

std::string predict_body(const Controller& controller) {
  Words words = filter_words(controller);
  if (controller.has.regulator) words.merge(law_words(controller));
  words["counters"] = advance_counters(controller);
  words["declare_deviations"] = declare_deviations(controller, 'u');
  return write_body(templates::compact_predict, controller, words,
                    {{"remembers", remembers(controller)},
                     {"remembers_by_table", remembers(controller) && has_law_table(controller)}});
}

std::string control_body(const Controller& controller) {
  Words words = law_words(controller);
  const bool copies = controller.has.foresight || copies_memory(controller);
  const auto entries = [](const char* array, int count) {
    std::string out;
    for (int i = 0; i < count; ++i) out += (i ? ", " : "") + element(array, i);
    return "{" + out + "}";
  };
  words["memory"] = state_of_law(controller, copies, copies_references(controller, copies));
  words["references"] = references(controller);
  words["last_input"] = entries("self->u_applied", controller.size.nu);
  words["declare_deviations"] = declare_deviations(controller, 'x');
  words["own_units"] = inputs_in_own_units(controller);
  const bool names_status = controller.has.feedthrough || controller.point.u.size() > 0;
  return write_body(controller.has.foresight ? templates::compact_law : templates::compact_control, controller, words,
                    {{"copies_r", copies_references(controller, copies)},
                     {"copies_u", copies && controller.has.last_input},
                     {"is_told_x", !controller.has.filter && controller.point.x.size() > 0},
                     {"names_status", names_status},
                     {"needs_empty_line", names_status || has_law_table(controller) || controller.has.servo}});
}

// a b added to y[i], in C.
std::string add_product(const Controller& controller, const std::string& a, const std::string& b) {
  if (!controller.target.is_fused) return "y[i] + (" + a + " * " + b + ")";
  return std::string(controller.target.is_double ? "fma(" : "fmaf(") + a + ", " + b + ", y[i])";
}

// A regulator alone that has a state: law and memory in one call, and y = C x + D u of the outputs that it integrates.
std::string act_body(const Controller& controller, std::string& constants) {
  Words words = law_words(controller);
  words["counters"] = advance_counters(controller);
  words["memory"] = whole_state(controller);
  words["references"] = references(controller);
  words["declare_deviations"] = declare_deviations(controller, 'x');
  words["own_units"] = inputs_in_own_units(controller);
  Conditions conditions = {{"remembers", remembers(controller)},
                           {"resets", needs_reset(controller)},
                           {"has_D", false},
                           {"copies_r", copies_references(controller, false)}};
  if (controller.size.nxi) {
    Tables tables(controller, "PLANT");
    const design::SampledPlant& plant = controller.solution.plant;
    const std::string C = tables.add("C", plant.C), D = tables.add_unless_zero("D", plant.D);
    words["rows"] = std::to_string(plant.C.rows());
    words["add_Cx"] = add_product(controller, C + "[(i * " + words["NAME"] + "_NX) + j]", words["x"] + "[j]");
    words["add_Du"] = add_product(controller, D + "[(i * " + words["NAME"] + "_NU) + j]", "u[j]");
    conditions["has_D"] = D != "NULL";
    constants += tables.text;
  }
  return write_body(templates::compact_act, controller, words, conditions);
}

}  // namespace

std::string options_check(const Controller& controller) {
  const auto check = [&](const char* option, bool wanted, const char* what) {
    return std::string(wanted ? "#ifndef " : "#ifdef ") + option + "\n#error \"This file " + what + ": " +
           (wanted ? "define " : "do not define ") + option + " for it and the library, or regenerate it.\"\n#endif\n";
  };
  return check("LQG_REAL_DOUBLE", controller.target.is_double,
               controller.target.is_double ? "computes in double" : "computes in float") +
         check("LQG_FUSED", controller.target.is_fused,
               controller.target.is_fused ? "uses fused multiply-adds" : "uses plain arithmetic");
}

FunctionBodies compact_bodies(const Controller& controller) {
  FunctionBodies bodies;
  bodies.includes =
      std::string(controller.target.is_fused || controller.size.ny > 1 || controller.size.nxi || controller.has.range
                      ? "#include <math.h>\n"
                      : "") +
      "#include <stdbool.h>\n#include <stddef.h>\n\n#include \"lqg/lqg.h\"\n\n" + options_check(controller);
  bodies.resets = needs_reset(controller);
  if (controller.keeps.any) bodies.init = init_body(controller);
  if (carries_covariance(controller))
    bodies.recover = write_body(templates::compact_recover, controller, {}, {{"remembers", remembers(controller)}});
  if (controller.has.filter) {
    bodies.constants = kalman_constants(controller);
    bodies.update = update_body(controller);
    bodies.predict = predict_body(controller);
    for (int i = 0; i < controller.size.ny && controller.size.ny > 1; ++i)
      if (has_update_alone(controller, i)) bodies.updates_alone.push_back(update_alone_body(controller, i));
    if (controller.size.ny == 1) bodies.updates_alone = {only_update_body(controller)};
  }
  if (controller.has.regulator) {
    bodies.constants += controller.has.servo ? servo_constants(controller) : lqr_constants(controller);
    bodies.control = controller.has.filter || !controller.keeps.any || controller.has.foresight
                         ? control_body(controller)
                         : act_body(controller, bodies.constants);
  }
  return bodies;
}

}  // namespace lqg::emit
