// Straight-line code of this plant's structure.
#include "emit/bodies.hpp"
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
    if (!({finite})) {
        {name}_init(self);
        status |= LQG_STATE_RESET;
    }
    return status;
)", {{"status", trace::wrap("    lqg_status status = " + raised + ";", 8)}, {"finite", printer.expression(function.finite)}, {"name", controller.problem.name}});
}

std::string body(const Controller& controller, const TracedFunction& function) {
  const trace::Printer printer(*function.graph, function.results());
  return "    LQG_STRICT_BODY\n" + printer.statements(function.stores) + "\n" + status(controller, function, printer);
}

}  // namespace

Bodies unrolled_bodies(const Controller& controller) {
  const TracedController traced = trace_controller(controller);
  Bodies bodies;
  bodies.includes = std::string(controller.is_fused() ? "#include <math.h>\n\n" : "") +
                    "#include \"lqg/arithmetic.h\"\n#include \"lqg/status.h\"\n#include \"lqg/version.h\"\n";
  bodies.options = R"(#if defined __GNUC__ && !defined __clang__
#pragma GCC optimize ("no-schedule-insns")  /* in the order as written, few values wait in registers */
#endif
)";
  if (controller.has_filter()) {
    bodies.update = body(controller, traced.update);
    bodies.predict = body(controller, traced.predict);
  }
  if (controller.has_regulator()) bodies.control = body(controller, traced.control);
  return bodies;
}

}  // namespace lqg::emit
