// SPDX-License-Identifier: MIT
#include "emit/text/wording.hpp"

#include <algorithm>
#include <cmath>

#include "emit/text/html.hpp"
#include "lqg/version.h"
#include "trace/print.hpp"

namespace lqg::emit {

std::vector<design::Signal> state_signals(const Controller& controller) {
  std::vector<design::Signal> signals = controller.problem.plant.states;
  const auto is_taken = [&](const std::string& name) {
    return std::any_of(signals.begin(), signals.end(),
                       [&](const design::Signal& signal) { return upper(signal.name) == upper(name); });
  };
  for (int left = controller.size.delayed, nu = controller.size.nu; left > 0; --left) {
    const design::Signal& input =
        controller.problem.plant.inputs[static_cast<std::size_t>((controller.size.delayed - left) % nu)];
    std::string name = input.name + "_delayed_" + std::to_string((left + nu - 1) / nu);
    while (is_taken(name)) name += "_samples";
    signals.push_back({name, input.unit});
  }
  return signals;
}

std::vector<design::Signal> reference_signals(const Controller& controller) {
  std::vector<design::Signal> signals;
  for (const int output : controller.references)
    signals.push_back(controller.problem.plant.outputs[static_cast<std::size_t>(output)]);
  return signals;
}

std::string name_with_unit(const design::Signal& signal) {
  return signal.unit.empty() ? signal.name : signal.name + " [" + signal.unit + "]";
}

std::string equation_of_law(const Controller& controller) {
  const std::string x = controller.has.filter ? "x̂" : "x", xi = controller.size.nxi ? "; ξ" : "";
  const std::string last = controller.has.input_change ? "; u[k−1]" : "";
  return (controller.has.input_change ? "u[k−1] − K " : "−K ") + (xi + last == "" ? x : "[" + x + xi + last + "]") +
         (controller.laws.front()[1].size() ? " + Nbar r" : "");
}

std::string filter_name(step::Filter filter) {
  switch (filter) {
    case step::Filter::steady: return "steady";
    case step::Filter::plain: return "plain";
    case step::Filter::ud: return "ud";
    default: return "";
  }
}

namespace {

// A counter as the index of a table with so many rows: it may have been damaged, or never begun, and is not taken as it is.
// Empty without a table.
std::string row(const std::string& counter, std::size_t rows) {
  if (rows < 2) return "";
  const std::string last = std::to_string(rows - 1);
  return "(" + counter + " < " + last + " ? " + counter + " : " + last + ")";
}

}  // namespace

Words common_words(const Controller& controller) {
  const std::string& name = controller.problem.name;
  return {{"name", name},
          {"NAME", upper(name)},
          {"real", controller.target.is_double ? "double" : "float"},
          {"zero", controller.target.is_double ? "0.0" : "0.0f"},
          {"nx", std::to_string(controller.size.nx)},
          {"nu", std::to_string(controller.size.nu)},
          {"ny", std::to_string(controller.size.ny)},
          {"nr", std::to_string(controller.size.nr)},
          {"nz", std::to_string(controller.size.nz)},
          {"file", controller.source.file},
          {"filter", filter_name(controller.filter)},
          {"law_row", row("self->sample", controller.laws.size())},
          {"filter_row", row("self->gain_row", controller.filters.size())}};
}

std::string number(const design::Real& value, bool is_double) {
  const double rounded = rounded_to_target(value, is_double);
  if (!std::isfinite(rounded)) return trace::literal(design::to_double(value), true);
  std::string text = trace::literal(rounded, is_double);
  if (!is_double) text.pop_back();
  return text;
}

std::string matrix_lines(const std::string& name, const design::RealMatrix& matrix, bool is_double) {
  std::vector<std::size_t> width(static_cast<std::size_t>(matrix.cols()), 0);
  for (int j = 0; j < matrix.cols(); ++j)
    for (int i = 0; i < matrix.rows(); ++i)
      width[static_cast<std::size_t>(j)] =
          std::max(width[static_cast<std::size_t>(j)], number(matrix(i, j), is_double).size());
  std::string out;
  for (int i = 0; i < matrix.rows(); ++i) {
    const std::string head = i == 0 ? name + " = " : std::string(letters(name) + 3, ' ');
    out += "  " + head + "[";
    for (int j = 0; j < matrix.cols(); ++j) {
      const std::string text = number(matrix(i, j), is_double);
      out += std::string(width[static_cast<std::size_t>(j)] - text.size() + (j ? 2 : 1), ' ') + text;
    }
    out += " ]\n";
  }
  return out;
}

std::string array_values(const design::RealMatrix& matrix, bool is_double) {
  std::string out;
  for (int i = 0; i < matrix.rows(); ++i) {
    std::string row = "   ";
    for (int j = 0; j < matrix.cols(); ++j)
      row += " " + trace::literal(rounded_to_target(matrix(i, j), is_double), is_double) + ",";
    if (i + 1 == matrix.rows()) row.pop_back();
    out += trace::wrap(row, 4) + "\n";
  }
  return out;
}

std::string version() {
  return std::to_string(LQG_VERSION_MAJOR) + "." + std::to_string(LQG_VERSION_MINOR) + "." +
         std::to_string(LQG_VERSION_PATCH);
}

std::string header_format() { return std::to_string(LQG_HEADER_FORMAT); }

std::string provenance(const Controller& controller) {
  return " * Made by lqgen " + version() + " from " + controller.source.file + " with the SHA-256\n * " +
         controller.source.sha256 +
         ".\n * Do not edit: change the design and run lqgen again. This file is yours: use it under any licence.\n";
}

}  // namespace lqg::emit
