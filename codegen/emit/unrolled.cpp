// Straight-line code of this plant's structure.
#include <initializer_list>

#include "emit/bodies.hpp"
#include "emit/model_of.hpp"
#include "emit/rounding.hpp"
#include "emit/text.hpp"
#include "emit/traced.hpp"

namespace lqg::emit {

namespace {

std::string status(const Controller& controller, const TracedFunction& function, const trace::Printer& printer) {
  std::string raised;
  for (const int status : function.statuses) {
    const std::string bits = printer.operand(status);
    raised += raised.empty() ? bits : " | " + bits;
  }
  if (raised.empty()) raised = "LQG_OK";
  if (function.finite < 0) return "    return " + raised + ";\n";
  return fill(R"({status}
    if (!({finite}))
        return {name}_reset(self, status);
    return status;
)", {{"status", trace::wrap("    const lqg_status status = " + raised + ";", 8)}, {"finite", printer.expression(function.finite)}, {"name", controller.problem.name}});
}

// `parameters` that the body does not need are said to be unused.
std::string body(const Controller& controller, const TracedFunction& function, std::initializer_list<const char*> parameters) {
  const trace::Printer printer(*function.graph, function.results());
  const std::string statements = printer.statements(function.stores), end = status(controller, function, printer);
  std::string unused;
  for (const std::string parameter : parameters)
    if ((statements + end).find(parameter == "self" ? "self" : " " + parameter + "[") == std::string::npos)
      unused += "    (void)" + parameter + ";\n";
  return "    LQG_STRICT_BODY\n" + unused + statements + "\n" + end;
}

template <class Values>
std::string initializer(const Values& values, bool is_double) {
  std::string out = "{";
  for (int i = 0; i < static_cast<int>(values.size()); ++i)
    out += (i ? ", " : "") + trace::literal(values[static_cast<std::size_t>(i)], is_double);
  return out + "}";
}

// All fields of the state, in their order.
std::string initial_state(const Controller& controller) {
  const bool is_double = controller.is_double();
  const auto model =
      model_of<double>(controller, [&](const design::Real& value) { return rounded_to_target(value, is_double); });
  const auto zeros = [](int count) { return std::vector<double>(static_cast<std::size_t>(count), 0); };
  std::vector<std::string> fields = {
      initializer(std::vector<double>(model.x0.data(), model.x0.data() + model.nx), is_double)};
  for (const std::vector<double>* part : {&model.P0, &model.U0, &model.D0})
    if (!part->empty()) fields.push_back(initializer(*part, is_double));
  if (controller.keeps_input()) fields.push_back(initializer(zeros(controller.nu()), is_double));
  if (controller.keeps_innovation()) fields.push_back(initializer(zeros(controller.ny()), is_double));
  std::string values;
  for (const std::string& field : fields)
    values += trace::wrap("        " + field, 9) + (&field == &fields.back() ? "\n" : ",\n");
  return fill(R"(    static const {name}_t initial = {
{values}    };

    *self = initial;
)", {{"name", controller.problem.name}, {"values", values}});
}

// Outside of the functions that call it, where it would cost every sample registers.
std::string reset(const Controller& controller) {
  return fill(R"(
/* Begins anew: the state was not finite. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static lqg_status {name}_reset({name}_t *self, lqg_status status)
{
    {name}_init(self);
    return status | LQG_STATE_RESET;
}
)", {{"name", controller.problem.name}});
}

}  // namespace

Bodies unrolled_bodies(const Controller& controller) {
  const TracedController traced = trace_controller(controller);
  Bodies bodies;
  bodies.includes = std::string(controller.is_fused() ? "#include <math.h>\n\n" : "") +
                    "#include \"lqg/arithmetic.h\"\n#include \"lqg/status.h\"\n#include \"lqg/version.h\"\n";
  bodies.options = R"(#if defined __GNUC__ && !defined __clang__
#pragma GCC optimize ("no-schedule-insns", "no-tree-ter")  /* as written: few values wait in registers */
#endif
)";
  if (controller.has_filter()) {
    bodies.init = initial_state(controller);
    bodies.reset = reset(controller);
    bodies.update = body(controller, traced.update, {"self", "y"});
    bodies.predict = controller.nu() ? body(controller, traced.predict, {"self", "u"})
                                     : body(controller, traced.predict, {"self"});
  }
  if (controller.has_regulator()) bodies.control = body(controller, traced.control, {controller.has_filter() ? "self" : "x"});
  return bodies;
}

}  // namespace lqg::emit
