// SPDX-License-Identifier: MIT
#include "emit/c/function_bodies.hpp"

#include "emit/c/templates.hpp"

namespace lqg::emit {

std::string advance_counters(const Controller& controller) { return write_body(templates::counters, controller, {}); }

std::string only_update_body(const Controller& controller) {
  return "    return " + controller.problem.name + "_update(self, &y_" + controller.problem.plant.outputs[0].name +
         ");\n";
}

}  // namespace lqg::emit
