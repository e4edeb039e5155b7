// SPDX-License-Identifier: MIT
#include "emit/c/operating_point.hpp"

#include "emit/recorded/trace_listener.hpp"
#include "emit/text/wording.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

const Eigen::VectorXd& offsets(const Controller& controller, char of) {
  switch (of) {
    case 'x': return controller.point.x;
    case 'u': return controller.point.u;
    case 'r': return controller.point.r;
    default: return controller.point.y;
  }
}

int count_of(const Controller& controller, char of) {
  return of == 'x' ? controller.size.nx : of == 'u' ? controller.size.nu : controller.size.ny;
}

bool has_offset(const Controller& controller, char of, int i) {
  const Eigen::VectorXd& all = offsets(controller, of);
  return all.size() > 0 && all(i) != 0;
}

std::string offset_name(const Controller& controller, char of, int i) {
  const step::Quantity quantity = of == 'x'   ? step::Quantity::point_x
                                  : of == 'u' ? step::Quantity::point_u
                                              : step::Quantity::point_y;
  const int signal = of == 'r' ? controller.references[static_cast<std::size_t>(i)] : i;
  return upper(controller.problem.name) + "_" + constant_name(controller, quantity, signal);
}

}  // namespace

std::string deviation(const Controller& controller, char of, int i, const std::string& text) {
  return has_offset(controller, of, i) ? "(" + text + " - " + offset_name(controller, of, i) + ")" : text;
}

std::string declare_deviations(const Controller& controller, char of) {
  if (offsets(controller, of).size() == 0) return "";
  std::string entries;
  for (int i = 0; i < count_of(controller, of); ++i) {
    const std::string own = element(std::string(1, of), i);
    entries += (i ? ", " : "") + own + (has_offset(controller, of, i) ? " - " + offset_name(controller, of, i) : "");
  }
  const std::string size = std::string("[{NAME}_N") + upper(std::string(1, of)) + "] = {";
  return trace::wrap(fill("    const {real} deviations" + size + entries + "};", common_words(controller)), 8);
}

std::string deviations(const Controller& controller, char of) {
  return offsets(controller, of).size() ? "deviations" : std::string(1, of);
}

std::string inputs_in_own_units(const Controller& controller) {
  std::string out;
  for (int i = 0; i < controller.size.nu; ++i)
    if (has_offset(controller, 'u', i))
      out += (out.empty() ? "    " : "\n    ") + element("u", i) + " = " + offset_name(controller, 'u', i) + " + " +
             element("u", i) + ";";
  return out;
}

std::string references_of_point(const Controller& controller) {
  std::string out;
  for (int i = 0; i < controller.size.nr; ++i)
    if (has_offset(controller, 'r', i))
      out += (out.empty() ? "    " : "\n    ") + element("self->r", i) + " = " + offset_name(controller, 'r', i) + ";";
  return out;
}

}  // namespace lqg::emit
