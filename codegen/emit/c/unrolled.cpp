// Straight-line code of this plant's structure.
#include "controller/gains.hpp"
#include "emit/c/function_bodies.hpp"
#include "controller/state_fields.hpp"
#include "emit/c/straight_line.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

namespace {

std::string status(const Controller& controller, const TracedFunction& function, const trace::Printer& printer) {
  std::string raised;
  for (const int status : function.statuses) {
    const std::string bits = printer.operand(status);
    raised += raised.empty() ? bits : " | " + bits;
  }
  if (raised.empty()) raised = "LQG_OK";
  if (function.finite < 0 && function.is_void) return "";
  if (function.finite < 0) return "    return " + raised + ";\n";
  if (!function.recovery.empty())
    return "    if (!(" + printer.expression(function.finite) + "))\n        return " + function.recovery + ";\n    return " +
           raised + ";\n";
  return fill(R"({status}
    if (!({finite}))
        return {name}_reset(self, status);
    return status;
)", {{"status", trace::wrap("    const lqg_status status = " + raised + ";", 8)}, {"finite", printer.expression(function.finite)}, {"name", controller.problem.name}});
}

bool reads(const std::string& statements, const char* table) {
  return statements.find(std::string("= ") + table + "[") != std::string::npos;
}

// The rows of the tables that a body reads.
std::string rows(const Controller& controller, const std::string& statements) {
  std::string out;
  if (reads(statements, "law")) out += "    const {real} *const law = {NAME}_LAW[self->sample];\n";
  if (reads(statements, "gains")) out += "    const {real} *const gains = {NAME}_GAINS[self->gain_row];\n";
  return fill(out, common_words(controller));
}

template <class Values>
std::string initializer(const Values& values, bool is_double) {
  std::string out = "{";
  for (int i = 0; i < static_cast<int>(values.size()); ++i)
    out += (i ? ", " : "") + trace::literal(values[static_cast<std::size_t>(i)], is_double);
  return out + "}";
}

// Entries that change from sample to sample; the others are numbers in the code.
std::string table(const Controller& controller, const std::string& name, const std::vector<Gains>& gains) {
  const std::vector<controller::Place> places = controller::changing_places(gains, controller.target.is_double);
  if (places.empty()) return "";
  std::string values;
  for (const Gains& row : gains) {
    std::vector<double> numbers;
    for (const controller::Place& place : places)
      numbers.push_back(rounded_to_target(row[place.matrix](place.i, place.j), controller.target.is_double));
    values += trace::wrap("    " + initializer(numbers, controller.target.is_double), 5) + (&row == &gains.back() ? "\n" : ",\n");
  }
  return fill("static const {real} {NAME}_" + name + "[" + std::to_string(gains.size()) + "][" +
              std::to_string(places.size()) + "] = {\n" + values + "};\n", common_words(controller));
}

}  // namespace

std::string body(const Controller& controller, const TracedFunction& function,
                 std::initializer_list<const char*> parameters, const std::string& last) {
  const trace::Printer printer(*function.graph, function.results());
  std::string statements = printer.statements(function.stores);
  if (!function.gates.empty()) statements += "\n";
  for (const auto& [output, gated] : function.gates)
    statements += "    self->gated[" + std::to_string(output) + "] += " + printer.operand(gated) + " ? 1 : 0;\n";
  const std::string end = last + status(controller, function, printer);
  std::string unused;
  for (const std::string parameter : parameters)
    if ((statements + end).find(parameter == "self" ? "self" : " " + parameter + "[") == std::string::npos)
      unused += "    (void)" + parameter + ";\n";
  return "    LQG_STRICT_BODY\n" + unused + rows(controller, statements) + statements +
         (end.empty() ? "" : "\n") + end;
}

std::string initial_state(const Controller& controller) {
  const std::vector<Field> fields = state_fields(controller);
  std::string values;
  for (const Field& field : fields) {
    const std::vector<double> zeros(static_cast<std::size_t>(field.count), 0);
    const bool is_number = field.kind == controller::Kind::counter || field.kind == controller::Kind::total;
    const std::string value = is_number                      ? "0"
                              : field.kind == controller::Kind::counters ? "{0}"
                                                             : initializer(field.initial.empty() ? zeros : field.initial,
                                                                           controller.target.is_double);
    values += trace::wrap("        " + value, 9) + (&field == &fields.back() ? "\n" : ",\n");
  }
  return fill(R"(    static const {name}_t initial = {
{values}    };

    *self = initial;
)", {{"name", controller.problem.name}, {"values", values}});
}

FunctionBodies straight_line_bodies(const Controller& controller) {
  FunctionBodies bodies;
  bodies.includes = std::string(controller.target.is_fused || controller.has.filter ? "#include <math.h>\n\n" : "") +
                    "#include \"lqg/arithmetic.h\"\n#include \"lqg/status.h\"\n#include \"lqg/version.h\"\n";
  bodies.options = R"(#if defined __GNUC__ && !defined __clang__
#pragma GCC optimize ("no-schedule-insns", "no-tree-ter")  /* as written: few values wait in registers */
#endif
)";
  if (controller.keeps.any) bodies.init = initial_state(controller);
  return bodies;
}

FunctionBodies unrolled_bodies(const Controller& controller) {
  const TracedController traced = trace_controller(controller);
  FunctionBodies bodies = straight_line_bodies(controller);
  bodies.constants = table(controller, "LAW", controller.laws) + table(controller, "GAINS", controller.filters);
  const std::string advance = advance_counters(controller);
  bodies.resets = controller.has.filter || traced.control.finite >= 0;
  if (controller.has.filter) {
    bodies.update = body(controller, traced.update, {"self", "y"});
    bodies.predict = controller.size.nu ? body(controller, traced.predict, {"self", "u"}, advance)
                                     : body(controller, traced.predict, {"self"}, advance);
    if (controller.has.regulator) bodies.control = body(controller, traced.control, {"self"});
    for (const TracedFunction& update : traced.updates_alone) bodies.updates_alone.push_back(body(controller, update, {"self"}));
    if (controller.size.ny == 1) bodies.updates_alone = {only_update_body(controller)};
  } else if (controller.keeps.any) {
    bodies.control = body(controller, traced.control, {"self", "x"}, advance);
  } else {
    bodies.control = body(controller, traced.control, {"x"});
  }
  if (traced.set_input.graph)
    bodies.set_input = controller.has.filter ? body(controller, traced.set_input, {"self", "u"})
                                               : body(controller, traced.set_input, {"self", "x", "u"});
  return bodies;
}

std::string innovation_body(const Controller& controller) {
  return body(controller, trace_innovation(controller), {"self", "y"});
}

}  // namespace lqg::emit
