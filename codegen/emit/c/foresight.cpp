// SPDX-License-Identifier: MIT
#include "emit/c/foresight.hpp"

#include <cmath>

#include "controller/model_of.hpp"
#include "emit/c/compact_constants.hpp"
#include "emit/c/operating_point.hpp"
#include "emit/c/templates.hpp"
#include "emit/recorded/constants.hpp"
#include "emit/recorded/trace_listener.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

namespace {

using design::LimitedRows;

// " *   3  voltage, 2 samples ahead\n"
std::string list_of_rows(const LimitedRows& rows) {
  std::string out;
  const std::size_t digits = std::to_string(rows.names.size() - 1).size();
  for (std::size_t i = 0; i < rows.names.size(); ++i) {
    const std::string number = std::to_string(i), ahead = std::to_string(rows.sample[i]);
    out += " * " + std::string(digits - number.size(), ' ') + number + "  " + rows.names[i] +
           (rows.sample[i] == 0   ? ""
            : rows.sample[i] == 1 ? ", 1 sample ahead"
                                  : ", " + ahead + " samples ahead") +
           "\n";
  }
  return out;
}

// A limit of u by its name, the others as they are.
std::string limit(const Controller& controller, step::Quantity quantity, int row, double value) {
  if (std::isinf(value)) return value < 0 ? "-INFINITY" : "INFINITY";
  if (row < controller.size.nu) return upper(controller.problem.name) + "_" + constant_name(controller, quantity, row);
  return trace::literal(value, controller.target.is_double);
}

std::string limits_table(const Controller& controller, Tables& tables, step::Quantity quantity) {
  const auto law = controller::limited_law_of<double>(
      controller, [](const design::Real& value) { return design::to_double(value); });
  const step::Vector<double>& values = quantity == step::Quantity::u_min ? law.low : law.high;
  std::vector<std::string> texts;
  for (int i = 0; i < values.size(); ++i) texts.push_back(limit(controller, quantity, i, values(i)));
  return tables.add(quantity == step::Quantity::u_min ? "LOW" : "HIGH", texts);
}

std::string steps_table(const Controller& controller, Tables& tables) {
  if (!controller.has.rate_limit) return "NULL";
  std::vector<std::string> names;
  for (int i = 0; i < controller.size.nu; ++i)
    names.push_back(upper(controller.problem.name) + "_" + constant_name(controller, step::Quantity::u_step, i));
  return tables.add("U_STEP", names);
}

std::string constants_of_limits(const Controller& controller) {
  Tables tables(controller, "LIMITS");
  const LimitedRows& rows = *controller.solution.foreseen;
  const std::string F = tables.add("F", rows.F), G = tables.add("G", rows.G), scale = tables.add("SCALE", rows.scale);
  const std::string low = limits_table(controller, tables, step::Quantity::u_min);
  const std::string high = limits_table(controller, tables, step::Quantity::u_max);
  const std::string tolerance = tables.add("TOLERANCE", rows.tolerance), u_step = steps_table(controller, tables);
  return fill(
      R"(#define {NAME}_ROWS {rows}  /* limited quantities, of this sample and ahead */

/* What each row of the tables is:
{list} */
{tables}static const lqg_mpc_t {NAME}_LIMITS = {
    {ns}, {NAME}_NU, {NAME}_ROWS, {iterations}u,  /* length of what F multiplies, nu, rows, iterations */
    NULL, {F}, {G}, {scale},  /* K, F, G, scale */
    {low}, {high}, {tolerance}, {u_step}  /* low, high, tolerance, u_step */
};
)",
      {{"NAME", upper(controller.problem.name)},
       {"rows", std::to_string(rows.G.rows())},
       {"list", list_of_rows(rows)},
       {"tables", tables.text},
       {"ns", std::to_string(rows.F.cols())},
       {"iterations", std::to_string(controller.iterations.most)},
       {"F", F},
       {"G", G},
       {"scale", scale},
       {"low", low},
       {"high", high},
       {"tolerance", tolerance},
       {"u_step", u_step}});
}

// x̂, or the state as a deviation from the operating point.
std::string state_of_law_ahead(const Controller& controller) {
  return controller.has.filter ? "self->x" : deviations(controller, 'x');
}

// What F multiplies, entry by entry; empty where it is x̂ alone.
std::string extended_state(const Controller& controller) {
  const int last = controller.has.input_change ? controller.size.nu : 0;
  if (last + controller.size.nr == 0) return "";
  std::string out;
  const std::string x = state_of_law_ahead(controller);
  for (int i = 0; i < controller.size.nx; ++i) out += (i ? ", " : "") + element(x, i);
  for (int i = 0; i < last; ++i) out += ", " + element("self->u_applied", i);
  const std::string zero = trace::literal(0, controller.target.is_double);
  for (int i = 0; i < controller.size.nr; ++i) {
    const std::string r = deviation(controller, 'r', i, element("self->r", i));
    out += ", ((" + r + " - " + r + ") == " + zero + ") ? " + r + " : " + zero;
  }
  return "{" + out + "}";
}

}  // namespace

void add_foresight(const Controller& controller, FunctionBodies& bodies) {
  if (controller.style != design::Style::compact) {
    bodies.includes =
        "#include <math.h>\n#include <stdbool.h>\n#include <stddef.h>\n\n#include \"lqg/arithmetic.h\"\n"
        "#include \"lqg/mpc.h\"\n#include \"lqg/status.h\"\n#include \"lqg/version.h\"\n\n" +
        options_check(controller);
  } else if (bodies.includes.find("<math.h>") == std::string::npos) {
    bodies.includes = "#include <math.h>\n" + bodies.includes;
  }
  bodies.constants += constants_of_limits(controller);
  bodies.step.clear();
  bodies.resets = bodies.resets || can_set_input(controller);
}

bool keeps_input_in_control(const Controller& controller) {
  return controller.has.feedthrough || (!controller.has.filter && controller.keeps.input);
}

std::string law_function(const Controller& controller, const std::string& body) {
  return write_function(templates::law, controller,
                        {{"law", equation_of_law(controller)},
                         {"reference", controller.size.nr ? "LQG_REFERENCE_NOT_FINITE, " : ""},
                         {"body", body}},
                        {{"keeps_all", !controller.has.filter && controller.keeps.any}});
}

std::string foreseeing_control_body(const Controller& controller) {
  const std::string state = extended_state(controller);
  const std::string x = state_of_law_ahead(controller);
  return write_body(templates::foreseeing_control, controller,
                    {{"declare_deviations", declare_deviations(controller, 'x')},
                     {"own_units", inputs_in_own_units(controller)},
                     {"applied", controller.has.rate_limit ? "self->u_applied" : "NULL"},
                     {"arguments", controller.has.filter  ? "self, u"
                                   : controller.keeps.any ? "self, " + x + ", u"
                                                          : x + ", u"},
                     {"state", state},
                     {"ns", std::to_string(controller.solution.foreseen->F.cols())},
                     {"s", state.empty() ? x : "s"}},
                    {{"is_extended", !state.empty()},
                     {"is_told_x", !controller.has.filter && controller.point.x.size() > 0},
                     {"keeps_input", keeps_input_in_control(controller)}});
}

}  // namespace lqg::emit
