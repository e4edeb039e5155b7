#include "emit/c/function_bodies.hpp"

namespace lqg::emit {

std::string advance_counters(const Controller& controller) {
  const auto advance = [](const std::string& counter, std::size_t last) {
    return "    if (self->" + counter + " < " + std::to_string(last) + ")\n        self->" + counter + "++;\n";
  };
  std::string out;
  if (controller.keeps.sample) out += advance("sample", controller.last_sample);
  if (controller.keeps.gain_row) out += advance("gain_row", controller.filters.size() - 1);
  return out;
}

std::string row_of_law(const Controller& controller) {
  const std::size_t last = controller.laws.size() - 1;
  const std::string number = std::to_string(last);
  return last == controller.last_sample ? "self->sample" : "(self->sample < " + number + " ? self->sample : " + number + ")";
}

std::string only_update_body(const Controller& controller) {
  return "    return " + controller.problem.name + "_update(self, &y_" + controller.problem.plant.outputs[0].name + ");\n";
}

}  // namespace lqg::emit
