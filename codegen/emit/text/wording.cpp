// SPDX-License-Identifier: MIT
#include "emit/text/wording.hpp"

#include <algorithm>
#include <cmath>

#include "design/sampled/added_states.hpp"
#include "emit/text/html.hpp"
#include "lqg/version.h"
#include "trace/print.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

std::vector<design::Signal> state_signals(const Controller& controller) {
  std::vector<design::Signal> signals = controller.problem.plant.states;
  const auto is_taken = [&](const std::string& name) {
    return std::any_of(signals.begin(), signals.end(),
                       [&](const design::Signal& signal) { return upper(signal.name) == upper(name); });
  };
  const auto add = [&](std::string name, const std::string& unit) {
    while (is_taken(name)) name += "_samples";
    signals.push_back({name, unit});
  };
  const design::Plant& plant = controller.problem.plant;
  if (controller.problem.estimator)
    for (const design::InputDisturbance& disturbance : controller.problem.estimator->disturbance) {
      const design::Signal& input = plant.inputs[static_cast<std::size_t>(disturbance.input)];
      add(input.name + "_disturbance", input.unit);
    }
  const std::vector<design::Index> periods = design::periods_of_outputs(plant);
  for (std::size_t i = 0; i < periods.size() && controller.problem.estimator; ++i)
    for (design::Index k = 1; k <= periods[i]; ++k)
      add(plant.outputs[i].name + "_late_" + std::to_string(k), plant.outputs[i].unit);
  for (int left = controller.size.delayed, nu = controller.size.nu; left > 0; --left) {
    const design::Signal& input = plant.inputs[static_cast<std::size_t>((controller.size.delayed - left) % nu)];
    add(input.name + "_delayed_" + std::to_string((left + nu - 1) / nu), input.unit);
  }
  return signals;
}

std::vector<design::Signal> kept_signals(const Controller& controller) {
  std::vector<design::Signal> signals = state_signals(controller);
  for (int i = 0; controller.modal && i < controller.size.nx - controller.size.delayed; ++i)
    signals[static_cast<std::size_t>(i)] = {"mode_" + std::to_string(i), ""};
  return signals;
}

std::vector<design::Signal> reference_signals(const Controller& controller) {
  std::vector<design::Signal> signals;
  for (const int output : controller.references)
    signals.push_back(controller.problem.plant.outputs[static_cast<std::size_t>(output)]);
  return signals;
}

std::string in_percent(double share) { return decimal(100 * share) + " %"; }

std::string style_of(const Controller& controller) {
  const bool has_loops =
      controller.style == design::Style::compact || controller.sharing == controller::Sharing::columns ||
      controller.sharing == controller::Sharing::entries || controller.sharing == controller::Sharing::products;
  return has_loops ? "compact" : "unrolled";
}

std::string name_with_unit(const design::Signal& signal) {
  return signal.unit.empty() ? signal.name : signal.name + " [" + signal.unit + "]";
}

std::string equation_of_law(const Controller& controller) {
  if (controller::is_extended(controller)) return "(u + K x of the operating point) − K x̂";
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

// A counter as the index of a table with so many rows: it may have been damaged, or never begun, and is not taken as it
// is. Empty without a table. `last` is the name of the last row in C.
std::string row(const std::string& counter, std::size_t rows, const std::string& last) {
  if (rows < 2) return "";
  return "((" + counter + " < " + last + ") ? " + counter + " : " + last + ")";
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
          {"u_at_rest", controller.point.u.size() ? "that of the operating point" : "0"},
          {"r_at_rest", controller.point.r.size() ? "that of the operating point" : "0"},
          {"filter", filter_name(controller.filter)},
          {"law_row", row("self->sample", controller.laws.size(), upper(name) + "_LAST_LAW_ROW")},
          {"filter_row", row("self->gain_row", controller.filters.size(), upper(name) + "_LAST_GAIN_ROW")}};
}

std::string number(const design::Real& value, bool is_double) {
  const double rounded = rounded_to_target(value, is_double);
  if (!std::isfinite(rounded)) return trace::literal(design::to_double(value), true);
  std::string text = trace::literal(rounded, is_double);
  if (!is_double) text.pop_back();
  return text;
}

namespace {

// Columns `from` to `to` of the matrix, under the head "  A = ".
std::string block_lines(const std::string& name, const std::vector<std::vector<std::string>>& rows,
                        const std::vector<std::size_t>& widths, std::size_t from, std::size_t to) {
  std::string out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string head = i == 0 ? name + " = " : std::string(letters(name) + 3, ' ');
    out += "  " + head + "[";
    for (std::size_t j = from; j < to; ++j)
      out += std::string(widths[j] - rows[i][j].size() + (j > from ? 2 : 1), ' ') + rows[i][j];
    out += " ]\n";
  }
  return out;
}

}  // namespace

std::string matrix_lines(const std::string& name, const design::RealMatrix& matrix, bool is_double) {
  constexpr std::size_t widest = 106;  // of a line, in a comment of a file with 120 columns
  const auto columns = static_cast<std::size_t>(matrix.cols());
  std::vector<std::size_t> width(columns, 0);
  std::vector<std::vector<std::string>> rows(static_cast<std::size_t>(matrix.rows()));
  for (int i = 0; i < matrix.rows(); ++i)
    for (int j = 0; j < matrix.cols(); ++j) {
      rows[static_cast<std::size_t>(i)].push_back(number(matrix(i, j), is_double));
      std::size_t& most = width[static_cast<std::size_t>(j)];
      most = std::max(most, rows[static_cast<std::size_t>(i)].back().size());
    }
  std::size_t total = letters(name) + 8;
  for (const std::size_t one : width) total += one + 2;
  std::string out;
  for (std::size_t from = 0; from < columns;) {
    const std::size_t label = total <= widest ? letters(name) : letters(name) + 22;  // "A, columns 10 to 19"
    std::size_t to = from, taken = label + 8;
    while (to < columns && (to == from || taken + width[to] + 2 <= widest)) taken += width[to++] + 2;
    const bool is_whole = from == 0 && to == columns;
    const std::string part =
        name + (is_whole ? "" : ", columns " + std::to_string(from) + " to " + std::to_string(to - 1));
    out += block_lines(part, rows, width, from, to);
    from = to;
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
