// SPDX-License-Identifier: MIT
#include "emit/text/description.hpp"
#include "emit/text/wording.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

// "  states   inflow = 0.3 l/s, level = 0.7 m\n", empty without signals.
std::string values_line(const char* what, const std::vector<design::Signal>& signals, const Eigen::VectorXd& values) {
  if (signals.empty()) return "";
  std::string list;
  for (std::size_t i = 0; i < signals.size(); ++i)
    list += (i ? ", " : "") + signals[i].name + " = " +
            number(design::Real(values(static_cast<Eigen::Index>(i))), true) +
            (signals[i].unit.empty() ? "" : " " + signals[i].unit);
  return trace::wrap("  " + std::string(what) + list, 8, 96) + "\n";
}

}  // namespace

std::string describe_point(const Controller& controller) {
  const auto& point = controller.problem.plant.operating_point;
  if (!point) return "";
  const design::Plant& plant = controller.problem.plant;
  return "\nOperating point: x, u and y of the matrices are deviations from it. All that is handed over and given "
         "back,\nand r, is in the plant's own units.\n\n" +
         values_line("states   ", plant.states, point->x) + values_line("inputs   ", plant.inputs, point->u) +
         values_line("outputs  ", plant.outputs, point->y);
}

}  // namespace lqg::emit
