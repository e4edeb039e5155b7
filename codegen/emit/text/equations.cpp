// SPDX-License-Identifier: MIT
#include "emit/text/equations.hpp"

#include "emit/text/wording.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

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

std::string describe_equations(const Controller& controller) {
  const std::vector<EquationLine> lines = equation_lines(controller);
  if (lines.empty()) return "";
  std::string out = controller.problem.plant.operating_point
                        ? "\nEquations of the plant, of which it is the linearisation\n\n"
                        : "\nEquations of the plant\n\n";
  for (const EquationLine& line : lines) out += wrapped(line.left + " = " + line.right);
  return out;
}

}  // namespace lqg::emit
