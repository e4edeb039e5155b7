// SPDX-License-Identifier: MIT
#include "emit/text/equations.hpp"

#include "emit/text/wording.hpp"
#include "trace/print.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

void add_values(const std::vector<design::Signal>& signals, const Eigen::VectorXd& values,
                std::vector<std::string>& out) {
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const design::Signal& signal = signals[static_cast<std::size_t>(i)];
    out.push_back(signal.name + " = " + trace::literal(values(i), true) +
                  (signal.unit.empty() ? "" : " " + signal.unit));
  }
}

// Broken between words, what follows further to the right.
std::string wrapped(const std::string& line) {
  std::string out;
  for (const char c : trace::wrap(line, 4, 96)) out += c == '\n' ? "\n  " : std::string(1, c);
  return "  " + out + "\n";
}

}  // namespace

std::vector<EquationLine> equation_lines(const Controller& controller) {
  const design::Plant& plant = controller.problem.plant;
  std::vector<EquationLine> out;
  if (!plant.equations) return out;
  const bool is_continuous = plant.domain == design::Domain::continuous;
  for (std::size_t i = 0; i < plant.equations->f_text.size(); ++i)
    out.push_back(
        {is_continuous ? "d" + plant.states[i].name + "/dt" : plant.states[i].name + "⁺", plant.equations->f_text[i]});
  for (std::size_t i = 0; i < plant.equations->h_text.size(); ++i)
    out.push_back({plant.outputs[i].name, plant.equations->h_text[i]});
  return out;
}

std::vector<std::string> operating_point_in_words(const Controller& controller) {
  const design::Plant& plant = controller.problem.plant;
  std::vector<std::string> out;
  if (!plant.operating_point) return out;
  add_values(plant.states, plant.operating_point->x, out);
  add_values(plant.inputs, plant.operating_point->u, out);
  add_values(plant.outputs, plant.operating_point->y, out);
  return out;
}

std::string describe_equations(const Controller& controller) {
  const std::vector<EquationLine> lines = equation_lines(controller);
  if (lines.empty()) return "";
  const std::vector<std::string> point = operating_point_in_words(controller);
  std::string out =
      point.empty() ? "\nEquations of the plant\n\n" : "\nEquations of the plant, of which it is the linearisation\n\n";
  for (const EquationLine& line : lines) out += wrapped(line.left + " = " + line.right);
  if (point.empty()) return out;
  std::string list;
  for (const std::string& one : point) list += (list.empty() ? "at " : ", ") + one;
  return out + "\n" + wrapped(list);
}

}  // namespace lqg::emit
