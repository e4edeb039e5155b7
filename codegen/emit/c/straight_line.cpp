// SPDX-License-Identifier: MIT
#include "emit/c/straight_line.hpp"

#include <algorithm>

#include "controller/state_fields.hpp"
#include "emit/c/function_bodies.hpp"
#include "emit/c/templates.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

namespace {

// A function's graph with what C has to know of it.
struct Printed {
  const TracedFunction& function;
  const trace::Printer printer;

  explicit Printed(const TracedFunction& traced) : function(traced), printer(*traced.graph, traced.results()) {}

  // Whether an input is read whose expression begins like this.
  bool reads(const std::string& beginning) const {
    const std::vector<trace::Node>& nodes = function.graph->nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i].op == trace::Op::input && printer.needs(static_cast<int>(i)) &&
          nodes[i].text.rfind(beginning, 0) == 0)
        return true;
    return false;
  }
  bool writes(const std::string& beginning) const {
    return std::any_of(function.stores.begin(), function.stores.end(),
                       [&](const trace::Store& store) { return store.target.rfind(beginning, 0) == 0; });
  }
};

// "    if (!(sum < 1.0f))", with what makes the state unsound besides.
std::string unless_sound(const Controller& controller, const Printed& printed) {
  const TracedFunction& function = printed.function;
  const std::string faults = function.faults.empty() ? "" : " || status & " + function.faults;
  const std::string line = "    if (!(" + printed.printer.test(function.finite, function.stores) + ")" + faults + ")";
  return controller.target.is_prover ? line : trace::wrap(line, 8);
}

// The status is there already.
std::string status_of_weighed(const Controller& controller, const Printed& printed) {
  return unless_sound(controller, printed) + "\n        return " + controller.problem.name +
         (printed.function.checks_covariance ? "_recover" : "_reset") + "(self, status);\n    return status;\n";
}

std::string status(const Controller& controller, const Printed& printed) {
  const TracedFunction& function = printed.function;
  const trace::Printer& printer = printed.printer;
  std::string raised;
  for (const int status : function.statuses) {
    const std::string bits = printer.operand(status);
    raised += raised.empty() ? bits : " | " + bits;
  }
  if (!function.asked.empty()) return status_of_weighed(controller, printed);
  if (raised.empty()) raised = "LQG_OK";
  if (function.finite < 0 && function.is_void) return "";
  if (function.finite < 0) return "    return " + raised + ";\n";
  if (!function.recovery.empty())
    return "    if (!(" + printer.test(function.finite, function.stores) + "))\n        return " + function.recovery +
           ";\n    return " + raised + ";\n";
  return fill(R"({status}
{unless_sound}
        return {name}_{recover}(self, status);
    return status;
)",
              {{"status", trace::wrap("    const lqg_status_t status = " + raised + ";", 8)},
               {"unless_sound", unless_sound(controller, printed)},
               {"recover", function.checks_covariance ? "recover" : "reset"},
               {"name", controller.problem.name}});
}

// The rows of the tables that a body reads.
std::string rows(const Controller& controller, const Printed& printed) {
  std::string out;
  if (printed.reads("law[")) out += "    const {real} *const law = {NAME}_LAW[{law_row}];\n";
  if (printed.reads("gains[")) out += "    const {real} *const gains = {NAME}_GAINS[{filter_row}];\n";
  const char* const names[] = {"K", "Nbar", "H", "H_input"};
  for (std::size_t k = 0; k < std::size(names) && controller.style == design::Style::compact; ++k)
    if (printed.reads(std::string(names[k]) + "["))
      out += fill("    const {real} *const {matrix} = {NAME}_SERVO_{MATRIX} + {law_row} * {size};\n",
                  {{"matrix", names[k]},
                   {"MATRIX", upper(names[k])},
                   {"size", std::to_string(controller.laws.front()[k].size())}});
  return fill(out, common_words(controller));
}

bool needs_self(const Printed& printed, const std::string& rows, const std::string& last) {
  const TracedFunction& function = printed.function;
  return printed.reads("self->") || printed.writes("self->") || !rows.empty() || !last.empty() ||
         function.finite >= 0;  // then it calls a function of its own
}

}  // namespace

std::string body(const Controller& controller, const TracedFunction& function,
                 std::initializer_list<const char*> parameters, const std::string& last) {
  const Printed printed(function);
  const std::string tables = rows(controller, printed), end = last + status(controller, printed);
  std::string unused;
  for (const std::string parameter : parameters) {
    const bool is_used = parameter == "self" ? needs_self(printed, tables, last) : printed.reads(parameter + "[");
    if (!is_used) unused += "    (void)" + parameter + ";\n";
  }
  return "    LQG_STRICT_BODY\n" + unused + tables +
         (!function.asked.empty() ? "    lqg_status_t status = LQG_OK;\n" : "") +
         printed.printer.statements(function.stores) + (end.empty() ? "" : "\n") + end;
}

std::string recover_body(const Controller& controller) {
  const TracedFunction traced = trace_begin_covariance(controller);
  const Printed printed(traced);
  return write_body(templates::recover_body, controller,
                    {{"statements", printed.printer.statements(traced.stores)},
                     {"within", printed.printer.test(traced.finite, traced.stores)}});
}

std::string weigh_body(const Controller& controller) {
  const TracedFunction traced = trace_weigh(controller);
  const Printed printed(traced);
  std::string raised;
  for (const int status : traced.statuses) raised += (raised.empty() ? "" : " | ") + printed.printer.operand(status);
  const auto table = [&](const Eigen::VectorXd& values) {
    return initializer({values.data(), values.data() + values.size()}, controller.target.is_double);
  };
  return write_body(templates::weigh_body, controller,
                    {{"limits", table(controller.bounds.innovation)},
                     {"widen", table(controller.gate.widen)},
                     {"narrow", table(controller.gate.narrow)},
                     {"statements", printed.printer.statements(traced.stores)},
                     {"gated", printed.printer.operand(traced.gates.front())},
                     {"raised", raised},
                     {"answer", printed.printer.expression(traced.answer)}},
                    {{"has_limits", !is_same_for_all(controller.bounds.innovation)},
                     {"has_widen", !is_same_for_all(controller.gate.widen)},
                     {"has_narrow", !is_same_for_all(controller.gate.narrow)}});
}

std::string statements(const TracedFunction& function) { return Printed(function).printer.statements(function.stores); }

std::string collect_lost(const TracedFunction& function) {
  const Printed printed(function);
  std::string out = printed.printer.statements({});
  for (int i = 0; i < static_cast<int>(function.lost.size()); ++i)
    out += "    if ((used & " + std::to_string(1ul << i) + "ul) != 0ul && " +
           printed.printer.expression(function.lost[static_cast<std::size_t>(i)]) +
           ")\n        rejected |= " + rejection(i) + ";\n";
  return out;
}

std::string initializer(const std::vector<double>& values, bool is_double) {
  std::string out = "{";
  for (const double& value : values) out += (&value == &values.front() ? "" : ", ") + trace::literal(value, is_double);
  return out + "}";
}

std::string initial_state(const Controller& controller) {
  const std::vector<Field> fields = state_fields(controller);
  std::string values;
  for (const Field& field : fields) {
    const std::vector<double> zeros(static_cast<std::size_t>(field.count), 0);
    const bool is_number = field.kind == controller::Kind::counter || field.kind == controller::Kind::total;
    const std::string value =
        is_number ? "0"
        : field.kind == controller::Kind::counters
            ? "{0}"
            : initializer(field.initial.empty() ? zeros : field.initial, controller.target.is_double);
    values += trace::wrap("        " + value, 9) + (&field == &fields.back() ? "\n" : ",\n");
  }
  return write_body(templates::initial_state, controller, {{"values", values}});
}

FunctionBodies straight_line_bodies(const Controller& controller) {
  FunctionBodies bodies;
  bodies.includes = std::string(controller.target.is_fused || controller.has.filter ? "#include <math.h>\n\n" : "") +
                    "#include \"lqg/arithmetic.h\"\n#include \"lqg/status.h\"\n#include \"lqg/version.h\"\n";
  bodies.options = R"(#if defined __GNUC__ && !defined __clang__
#pragma GCC optimize ("no-schedule-insns", "no-tree-ter", "no-tree-pre")  /* as written: few values wait in registers */
#endif
)";
  if (controller.keeps.any) bodies.init = initial_state(controller);
  return bodies;
}

}  // namespace lqg::emit
