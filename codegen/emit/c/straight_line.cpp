// SPDX-License-Identifier: MIT
#include "emit/c/straight_line.hpp"

#include <algorithm>

#include "controller/state_fields.hpp"
#include "emit/c/function_bodies.hpp"
#include "emit/c/templates.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

// A function's graph with what C has to know of it.
struct Printed {
  const TracedFunction& function;
  const trace::Printer printer;

  explicit Printed(const TracedFunction& traced) : function(traced), printer(printer_of(traced)) {}

  // Whether an input is read whose expression begins like this.
  bool reads(const std::string& beginning) const {
    const std::vector<trace::Node>& nodes = function.graph->nodes();
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if ((nodes[i].op == trace::Op::input || nodes[i].op == trace::Op::resumed) &&
          printer.needs(static_cast<int>(i)) && nodes[i].text.rfind(beginning, 0) == 0)
        return true;
    return false;
  }
  // Whether the rest reads one.
  bool resumes(const std::string& beginning) const {
    const std::vector<trace::Node>& nodes = function.graph->nodes();
    for (std::size_t i = static_cast<std::size_t>(function.graph->rest()); i < nodes.size(); ++i)
      if (nodes[i].op == trace::Op::input && printer.needs(static_cast<int>(i)) &&
          nodes[i].text.rfind(beginning, 0) == 0)
        return true;
    return false;
  }
  bool writes(const std::string& beginning) const {
    return writes(function.stores, beginning) || (function.before && writes(function.before->stores, beginning));
  }

 private:
  static bool writes(const std::vector<trace::Store>& stores, const std::string& beginning) {
    return std::any_of(stores.begin(), stores.end(),
                       [&](const trace::Store& store) { return store.target.rfind(beginning, 0) == 0; });
  }
};

// What the check at the end of a function says, as an equation.
std::string equation_of_bounds(const Controller& controller, const std::string& test, bool has_x, bool has_xi) {
  if (test.find("TWO_TO_") == std::string::npos) return "all finite: s − s = 0";
  const bool has_variances = test.find("!(") != std::string::npos;
  const std::string NAME = upper(controller.problem.name);
  std::string terms, bounds;
  const auto add = [&](const std::string& term, const std::string& bound) {
    terms += (terms.empty() ? "" : " + ") + term;
    if (!bound.empty()) bounds += (bounds.empty() ? "" : ", ") + bound;
  };
  const std::string kept = controller::kept_name(controller);
  if (has_x) add("(" + kept + "_i/b_i)²", "b = " + NAME + "_" + upper(kept) + "_BOUNDS");
  if (has_variances) add("P_ii/b_i²", "");
  if (has_xi) add("(ξ_i/c_i)²", "c: limits of ξ");
  return "Σ " + terms + " < 1 in units of a power of two, " + bounds + (has_variances ? "; no P_ii < 0" : "") +
         (test.find(" - ") != std::string::npos ? "; the rest is finite" : "");
}

// "    if (!(sum < 1.0f)) {", with what makes the state unsound besides.
std::string if_unsound(const Controller& controller, const std::string& test, const std::string& faults) {
  const std::string line =
      "    if (!(" + test + ")" + (faults.empty() ? "" : " || ((status & " + faults + ") != 0u)") + ") {";
  return (controller.target.is_prover ? line : trace::wrap(line, 8)) + "\n";
}

// "        self->x[0] = next_position;"
std::string stored(const Printed& printed, const std::vector<trace::Store>& stores) {
  std::string out;
  for (const trace::Store& store : stores)
    out += trace::wrap("        " + store.target + " = " + printed.printer.expression(store.node) + ";", 12) + "\n";
  return out;
}

// Then `answer` is the status.
std::string unless_sound(const Controller& controller, const Printed& printed, const std::string& answer) {
  const TracedFunction& function = printed.function;
  const std::string answered = "        status = " + answer + ";\n    }\n    return status;\n";
  if (!function.stores_if_sound.empty()) {
    const std::string test = printed.printer.test_by_names(function.finite);
    return "    /* " + equation_of_bounds(controller, test, false, false) + " */\n    if (" + test + ") {\n" +
           stored(printed, function.stores_if_sound) + "    } else {\n" + answered;
  }
  const std::string test = printed.printer.test(function.finite, function.stores);
  const bool has_x = printed.writes(std::string("self->") + controller::kept_name(controller) + "["),
             has_xi = printed.writes("self->xi[");
  return "    /* " + equation_of_bounds(controller, test, has_x, has_xi) + " */\n" +
         if_unsound(controller, test, function.faults) + answered;
}

// The call that answers where the state is not sound.
std::string recovery_of(const Controller& controller, const TracedFunction& function) {
  if (!function.recovery.empty()) return function.recovery;
  return controller.problem.name + (function.checks_covariance ? "_recover" : "_reset") + "(self, status)";
}

// One statement for each cause.
std::string raised(const Printed& printed, const std::vector<int>& statuses) {
  std::string out;
  for (const int status : statuses) out += printed.printer.raise(status);
  return out;
}

// Where no call is told of the status before.
bool declares_status_late(const TracedFunction& function) { return function.asked.empty() && !function.before; }

std::string status(const Controller& controller, const Printed& printed) {
  const TracedFunction& function = printed.function;
  const bool is_checked = function.finite >= 0;
  if (!is_checked && function.is_void) return "";
  if (!is_checked && declares_status_late(function) && function.statuses.empty()) return "    return LQG_OK;\n";
  return (declares_status_late(function) ? "    lqg_status_t status = LQG_OK;\n" : "") +
         (declares_status_late(function) || function.before ? raised(printed, function.statuses) : "") +
         (is_checked ? unless_sound(controller, printed, recovery_of(controller, function)) : "    return status;\n");
}

// The rows of the tables that a body reads.
std::string rows(const Controller& controller, const Printed& printed) {
  std::string out;
  if (printed.reads("law[")) out += "    const {real} *const law = {NAME}_LAW[{law_row}];\n";
  if (printed.reads("gains["))
    out += std::string("    const {real} *") + (printed.resumes("gains[") ? "" : "const ") +
           "gains = {NAME}_GAINS[{filter_row}];\n";
  const char* const names[] = {"K", "Nbar", "H", "H_input"};
  for (std::size_t k = 0; k < std::size(names) && controller.style == design::Style::compact; ++k)
    if (printed.reads(std::string(names[k]) + "["))
      out += fill("    const {real} *const {matrix} = {NAME}_SERVO_{MATRIX} + {law_row} * {size};\n",
                  {{"matrix", names[k]},
                   {"MATRIX", upper(names[k])},
                   {"size", std::to_string(controller.laws.front()[k].size())}});
  return fill(out, common_words(controller));
}

// Up to the rest: what comes before it, and the recovery where that finds the state not sound.
std::string up_to_rest(const Controller& controller, const Printed& printed) {
  const TracedRecovery& before = *printed.function.before;
  const std::string test = printed.printer.test_by_names(before.finite);
  std::string out = printed.printer.statements_before_rest(before.stores) + "\n" + raised(printed, before.statuses);
  out += "    /* " + equation_of_bounds(controller, test, true, false) + " */\n" +
         if_unsound(controller, test, before.faults);
  out += stored(printed, before.recovers);
  out += "        status = " + recovery_of(controller, printed.function) + ";\n" + printed.printer.read_again(8);
  if (printed.resumes("gains[")) out += fill("        gains = {NAME}_GAINS[{filter_row}];\n", common_words(controller));
  return out + "    }\n" + (controller.target.is_prover ? "    /*@ slevel merge; */ ;\n" : "");
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
    const bool is_used = parameter == "self" ? needs_self(printed, tables, last)
                                             : printed.reads(parameter + "[") || printed.writes(parameter + "[");
    if (!is_used) unused += "    (void)" + parameter + ";\n";
  }
  return "    LQG_STRICT_BODY\n" + unused + tables +
         (declares_status_late(function) ? "" : "    lqg_status_t status = LQG_OK;\n") +
         (function.before ? up_to_rest(controller, printed) + printed.printer.statements_of_rest(function.stores)
                          : printed.printer.statements(function.stores)) +
         (end.empty() ? "" : "\n") + end;
}

std::string end_of_body(const Controller& controller, const TracedFunction& function) {
  const Printed printed(function);
  return printed.printer.statements(function.stores) + "\n" +
         unless_sound(controller, printed, recovery_of(controller, function));
}

std::string recover_body(const Controller& controller) {
  const TracedFunction traced = trace_begin_covariance(controller);
  const Printed printed(traced);
  const std::string within = printed.printer.test(traced.finite, traced.stores);
  return write_body(templates::recover_body, controller,
                    {{"statements", printed.printer.statements(traced.stores)},
                     {"equation", equation_of_bounds(controller, within, true, controller.size.nxi > 0)},
                     {"within", within}});
}

std::string weigh_body(const Controller& controller) {
  const TracedFunction traced = trace_weigh(controller);
  const Printed printed(traced);
  const auto table = [&](step::Quantity quantity) {
    std::string names;
    for (int i = 0; i < controller.size.ny; ++i)
      names += (i ? ", {NAME}_" : "{NAME}_") + constant_name(controller, quantity, i);
    return trace::wrap(fill("{" + names + "};", common_words(controller)), 8);
  };
  return write_body(templates::weigh_body, controller,
                    {{"limits", table(step::Quantity::innovation_limit)},
                     {"widen", table(step::Quantity::gate_widen)},
                     {"narrow", table(step::Quantity::gate_narrow)},
                     {"statements", printed.printer.statements(traced.stores)},
                     {"gated", printed.printer.operand(traced.gates.front())},
                     {"raised", raised(printed, traced.statuses)}},
                    {{"has_limits", !is_same_for_all(controller.bounds.innovation)},
                     {"has_widen", !is_same_for_all(controller.gate.widen)},
                     {"has_narrow", !is_same_for_all(controller.gate.narrow)}});
}

std::string statements(const TracedFunction& function) { return Printed(function).printer.statements(function.stores); }

std::string collect_lost(const TracedFunction& function) {
  const Printed printed(function);
  std::string out = printed.printer.statements({});
  for (int i = 0; i < static_cast<int>(function.lost.size()); ++i) {
    const std::string question = "((used & " + std::to_string(1ul << i) + "uL) != 0uL) && (" +
                                 printed.printer.expression(function.lost[static_cast<std::size_t>(i)]) + ")";
    out += trace::wrap("    if (" + question + ") {", 8) + "\n        rejected |= " + rejection(i) + ";\n    }\n";
  }
  return out;
}

std::string initializer(const std::vector<double>& values, bool is_double) {
  std::string out = "{";
  for (const double& value : values) out += (&value == &values.front() ? "" : ", ") + trace::literal(value, is_double);
  return out + "}";
}

namespace {

// Where an initial value comes from.
std::string origin_of_initial(const std::string& field) {
  if (field == "x") return "x: the initial state x0";
  if (field == "P") return "P: the initial covariance P0";
  if (field == "U" || field == "d") return field + ": of the initial covariance P0 = U diag(d) Uᵀ";
  if (field == "widening") return "widening: of the variance of the first innovation, from P0, relative to S";
  if (field == "z") return "z: of the initial state x0";
  return field;
}

}  // namespace

std::string initial_state(const Controller& controller) {
  const std::vector<Field> fields = state_fields(controller);
  std::string values;
  for (const Field& field : fields) {
    const std::vector<double> zeros(static_cast<std::size_t>(field.count), 0);
    const bool is_number = field.kind == controller::Kind::counter || field.kind == controller::Kind::total;
    const std::string value =
        is_number ? (field.kind == controller::Kind::total ? "0uL" : "0u")
        : field.kind == controller::Kind::counters
            ? "{0}"
            : initializer(field.initial.empty() ? zeros : field.initial, controller.target.is_double);
    values += trace::wrap("        " + value, 9) + (&field == &fields.back() ? "" : ",") + "  /* " +
              origin_of_initial(field.name) + " */\n";
  }
  return write_body(templates::initial_state, controller, {{"values", values}});
}

namespace {

// A compiler that moves statements has even more values at once, which it spills where there are more than registers.
// Where there are not, moved statements wait less for the results of others.
bool keeps_order(const Controller& controller) {
  const long registers = controller.target.is_double ? 16 : 32;  // of an FPU
  return controller.cost.values_at_once >= registers;            // one is for the result
}

}  // namespace

FunctionBodies straight_line_bodies(const Controller& controller) {
  FunctionBodies bodies;
  bodies.includes = std::string(controller.target.is_fused || controller.has.filter ? "#include <math.h>\n" : "") +
                    "#include <stdbool.h>\n\n#include \"lqg/arithmetic.h\"\n" +
                    (controller::is_extended(controller) ? "#include \"lqg/functions.h\"\n" : "") +
                    "#include \"lqg/status.h\"\n#include \"lqg/version.h\"\n";
  bodies.options =
      keeps_order(controller)
          ? R"(#if defined __GNUC__ && !defined __clang__  /* keeps the order of statements: less register pressure */
#pragma GCC optimize ("no-schedule-insns", "no-tree-ter", "no-tree-pre")
#endif
)"
          : R"(#if defined __GNUC__ && !defined __clang__  /* loads numbers where they are needed */
#pragma GCC optimize ("no-tree-ter", "no-tree-pre")
#endif
)";
  if (controller.keeps.any) bodies.init = initial_state(controller);
  return bodies;
}

}  // namespace lqg::emit
