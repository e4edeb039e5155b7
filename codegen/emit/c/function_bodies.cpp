// SPDX-License-Identifier: MIT
#include "emit/c/function_bodies.hpp"

#include "emit/c/templates.hpp"

namespace lqg::emit {

std::string advance_counters(const Controller& controller) {
  const std::size_t last_gain_row = controller.filters.empty() ? 0 : controller.filters.size() - 1;
  return write_body(
      templates::counters, controller,
      {{"last_sample", std::to_string(controller.last_sample)}, {"last_gain_row", std::to_string(last_gain_row)}});
}

std::string only_update_body(const Controller& controller) {
  return "    return " + controller.problem.name + "_update(self, &y_" + controller.problem.plant.outputs[0].name +
         ");\n";
}

}  // namespace lqg::emit
