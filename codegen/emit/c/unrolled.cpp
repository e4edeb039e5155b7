// SPDX-License-Identifier: MIT
// Straight-line code of this plant's structure.
#include "controller/gains.hpp"
#include "emit/c/function_bodies.hpp"
#include "emit/c/straight_line.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

// Entries that change from sample to sample; the others are numbers in the code.
std::string table(const Controller& controller, const std::string& name, const std::vector<Gains>& gains) {
  const std::vector<controller::Place> places = controller::changing_places(gains, controller.target.is_double);
  if (places.empty()) return "";
  std::string values;
  for (const Gains& row : gains) {
    std::vector<double> numbers;
    for (const controller::Place& place : places)
      numbers.push_back(rounded_to_target(row[place.matrix](place.i, place.j), controller.target.is_double));
    values += trace::wrap("    " + initializer(numbers, controller.target.is_double), 5) +
              (&row == &gains.back() ? "\n" : ",\n");
  }
  return fill("static const {real} {NAME}_" + name + "[" + std::to_string(gains.size()) + "][" +
                  std::to_string(places.size()) + "] = {\n" + values + "};\n",
              common_words(controller));
}

}  // namespace

std::string gain_tables(const Controller& controller) {
  return table(controller, "LAW", controller.laws) + table(controller, "GAINS", controller.filters);
}

FunctionBodies unrolled_bodies(const Controller& controller) {
  const TracedController traced = trace_controller(controller);
  FunctionBodies bodies = straight_line_bodies(controller);
  bodies.constants = gain_tables(controller);
  const std::string advance = advance_counters(controller);
  bodies.resets = controller.has.filter || traced.control.finite >= 0;
  if (carries_covariance(controller)) bodies.recover = recover_body(controller);
  if (controller.has.gate) bodies.weigh = weigh_body(controller);
  if (controller.has.filter) {
    bodies.update = body(controller, traced.update, {"self", "y"});
    bodies.predict = controller.size.nu ? body(controller, traced.predict, {"self", "u"}, advance)
                                        : body(controller, traced.predict, {"self"}, advance);
    if (controller.has.regulator) bodies.control = body(controller, traced.control, {"self"});
    bodies.step = controller.size.nu ? body(controller, traced.step, {"self", "y", "u"}, advance)
                                     : body(controller, traced.step, {"self", "y"}, advance);
    for (const TracedFunction& update : traced.updates_alone)
      bodies.updates_alone.push_back(body(controller, update, {"self"}));
    if (controller.size.ny == 1) bodies.updates_alone = {only_update_body(controller)};
  } else if (controller.keeps.any) {
    bodies.control = body(controller, traced.control, {"self", "x"}, advance);
  } else {
    bodies.control = body(controller, traced.control, {"x"});
  }
  return bodies;
}

}  // namespace lqg::emit
