// SPDX-License-Identifier: MIT
#include "emit/c/compact_constants.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "controller/gains.hpp"
#include "controller/model_of.hpp"
#include "emit/recorded/constants.hpp"
#include "emit/recorded/row_pattern.hpp"
#include "emit/recorded/traced.hpp"
#include "emit/text/wording.hpp"
#include "trace/print.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

using design::Real;
using design::RealMatrix;

// One row: the lower triangle, row by row.
RealMatrix lower_triangle(const RealMatrix& matrix) {
  const int n = static_cast<int>(matrix.rows());
  RealMatrix row(1, n * (n + 1) / 2);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j) row(0, step::triangle(i, j)) = matrix(i, j);
  return row;
}

// One row: the strict upper triangle, column by column.
RealMatrix strict_upper_triangle(const RealMatrix& matrix) {
  const int n = static_cast<int>(matrix.rows());
  RealMatrix row(1, n * (n - 1) / 2);
  for (int j = 1; j < n; ++j)
    for (int k = 0; k < j; ++k) row(0, step::strict_triangle(k, j)) = matrix(k, j);
  return row;
}

RealMatrix as_row(const design::RealVector& vector) { return vector.transpose(); }

// The values of a quantity by their names, a line each; `largest` stands for a limit that there is none of.
std::vector<std::string> names_of(const Controller& controller, step::Quantity quantity, const Eigen::VectorXd& given) {
  const bool is_double = controller.target.is_double;
  const double largest = is_double ? std::numeric_limits<double>::max() : std::numeric_limits<float>::max();
  std::vector<std::string> out;
  for (int i = 0; i < given.size(); ++i)
    out.push_back(std::isinf(given(i)) ? trace::literal(std::copysign(largest, given(i)), is_double)
                                       : upper(controller.problem.name) + "_" + constant_name(controller, quantity, i));
  return out;
}

// The same of factors that all outputs may share.
std::vector<std::string> factor_names(const Controller& controller, step::Quantity quantity,
                                      const Eigen::VectorXd& given) {
  std::vector<std::string> out = names_of(controller, quantity, given);
  if (is_same_for_all(given))
    for (std::string& name : out) name = upper(controller.problem.name) + "_" + constant_name(controller, quantity, -1);
  return out;
}

// Fields of an initializer, in the order in which they were defined (a braced list is evaluated from left to right).
std::string fields(std::initializer_list<std::string> values) {
  std::string out;
  for (const std::string& value : values) out += (out.empty() ? "" : ", ") + value;
  return out;
}

// Where the rows of A are not zero; a line each.
std::string pattern_values(const RowPattern& pattern) {
  std::string lines;
  for (const std::vector<int>& row : pattern) {
    std::string line = "    " + std::to_string(row.size());
    for (const int column : row) line += ", " + std::to_string(column);
    lines += trace::wrap(line, 4) + (&row == &pattern.back() ? "\n" : ",\n");
  }
  return lines;
}

// A matrix with the pattern of A, or all of it.
std::string add_rows(const std::string& suffix, const RowPattern& pattern, const RealMatrix& matrix, Tables& tables) {
  return tables.add(suffix, pattern.empty() ? matrix : entries_in(pattern, matrix));
}

std::string plant_fields(const Controller& controller, const design::SampledPlant& plant, const RowPattern& pattern,
                         const RealMatrix& C, const RealMatrix& D, Tables& tables) {
  const std::string NAME = upper(controller.problem.name), A = add_rows("A", pattern, plant.A, tables);
  return "    {" +
         fields({NAME + "_NX", std::to_string(controller.size.nu), NAME + "_NY", A, tables.add("B", plant.B),
                 tables.add("C", C), tables.add_unless_zero("D", D),
                 tables.define("PATTERN", pattern_values(pattern), size_of(pattern), "unsigned char")}) +
         "},  /* nx, nu, ny, A, B, C, D, pattern */\n";
}

// Numbers that are in no matrix of the design.
std::string numbers(const std::string& suffix, const std::vector<double>& values, Tables& tables) {
  RealMatrix row(1, static_cast<Eigen::Index>(values.size()));
  for (Eigen::Index i = 0; i < row.size(); ++i) row(0, i) = values[static_cast<std::size_t>(i)];
  return tables.add(suffix, row);
}

// 1/b of bounds b = 2^exponents.
std::vector<std::string> inverse_powers(const Controller& controller, const std::vector<int>& exponents) {
  std::vector<std::string> out;
  for (const int exponent : exponents) out.push_back(upper(controller.problem.name) + "_" + name_of_power(-exponent));
  return out;
}

// What the sensors can say.
void add_range(const Controller& controller, Tables& tables) {
  if (!controller.has.range) return;
  const design::Estimator& estimator = *controller.problem.estimator;
  tables.add("Y_MIN", names_of(controller, step::Quantity::y_min, estimator.output_min));
  tables.add("Y_MAX", names_of(controller, step::Quantity::y_max, estimator.output_max));
}

std::string gate_name(const Controller& controller) {
  return controller.has.gate ? "&" + upper(controller.problem.name) + "_KALMAN_GATE" : "NULL";
}

// The bounds and the gate, with which a description ends; `variances` are those that a constant gain has behind it.
std::string last_fields(const Controller& controller, Tables& tables, const std::string& variances = "") {
  const Eigen::VectorXd& limits = controller.bounds.innovation;
  return "    " +
         fields({tables.add("X_SCALE", inverse_powers(controller, controller.bounds.x)),
                 tables.add("LIMIT", names_of(controller, step::Quantity::innovation_limit, limits)),
                 gate_name(controller)}) +
         (variances.empty() ? "" : ", " + variances) + "  /* x_scale, innovation_limit, gate" +
         (variances.empty() ? "" : ", S") + " */\n";
}

std::string initial_state(const Controller& controller, Tables& tables) {
  const Eigen::VectorXd x0 = controller.x0;
  RealMatrix row(1, x0.size());
  for (int i = 0; i < x0.size(); ++i) row(0, i) = x0(i);
  return tables.add_unless_zero("X0", row);
}

// The same matrix of all rows of gains, one under the other; the description points to the first.
RealMatrix stacked(const std::vector<Gains>& rows, std::size_t matrix) {
  const RealMatrix& first = rows.front()[matrix];
  RealMatrix all(first.rows() * static_cast<Eigen::Index>(rows.size()), first.cols());
  for (std::size_t k = 0; k < rows.size(); ++k)
    all.middleRows(static_cast<Eigen::Index>(k) * first.rows(), first.rows()) = rows[k][matrix];
  return all;
}

std::string steady_fields(const Controller& controller, std::size_t start, Tables& tables) {
  const design::SampledPlant& plant = plant_at(controller, start);
  std::string out = plant_fields(controller, plant, row_pattern(controller, start), plant.C, plant.D, tables);
  const std::string S = controller.has.gate ? tables.add("S", stacked(controller.filters, 2)) : "NULL";
  return out + "    " +
         fields({tables.add("L", stacked(controller.filters, 0)),
                 controller.keeps.innovation ? tables.add("M", stacked(controller.filters, 1)) : "NULL",
                 initial_state(controller, tables)}) +
         ",  /* L, M, x0 */\n" + last_fields(controller, tables, S);
}

std::string online_fields(const Controller& controller, std::size_t start, Tables& tables) {
  const design::OnlineSolution& online = online_at(controller, start);
  const RowPattern pattern = row_pattern(controller, start);
  const design::OnlineSolution& first = *controller.solution.online;
  const bool has_M = controller.keeps.innovation;
  std::string out = plant_fields(controller, plant_at(controller, start), pattern, online.C, online.D, tables);
  out += "    " +
         fields({online.E.isIdentity(0) ? "NULL" : tables.add("E", online.E), tables.add("V", as_row(online.V))}) +
         ",  /* E, V */\n";
  const auto add_rest = [&] {
    out += "    " +
           fields({has_M ? tables.add("M", online.M) : "NULL",
                   has_M ? add_rows("A_FREE", pattern, online.A_free, tables) : "NULL"}) +
           ",  /* M, A_free */\n";
  };
  if (controller.filter == step::Filter::plain) {
    out += "    " + tables.add("W", lower_triangle(online.W)) + ",  /* W */\n";
    add_rest();
    return out + "    " + fields({initial_state(controller, tables), tables.add("P0", lower_triangle(first.P0))}) +
           ",  /* x0, P0 */\n" + last_fields(controller, tables);
  }
  out += "    " +
         fields({std::to_string(online.G.cols()), tables.add("G", online.G), tables.add("W", as_row(online.w))}) +
         ",  /* nw, G, W */\n";
  add_rest();
  return out + "    " +
         fields({initial_state(controller, tables), tables.add("U0", strict_upper_triangle(first.U0)),
                 tables.add("D0", as_row(first.D0))}) +
         ",  /* x0, U0, d0 */\n" + last_fields(controller, tables);
}

// The limits of the file; nothing is defined for those that no input has, or that are foreseen.
std::pair<std::string, std::string> limits_fields(const Controller& controller, Tables& tables) {
  const auto& limits = controller.problem.limits;
  if (!limits || limits->u_min.size() == 0 || controller.has.foresight) return {"NULL", "NULL"};
  const std::string low = tables.add("U_MIN", names_of(controller, step::Quantity::u_min, limits->u_min));
  return {low, tables.add("U_MAX", names_of(controller, step::Quantity::u_max, limits->u_max))};
}

// Defines an array of indices; "NULL" when there is nothing in it.
std::string index_array(const std::string& name, const std::vector<int>& values, std::string& text) {
  if (values.empty()) return "NULL";
  text += "static const unsigned " + name + "[" + std::to_string(values.size()) + "] = {";
  for (std::size_t i = 0; i < values.size(); ++i) text += (i ? ", " : "") + std::to_string(values[i]);
  text += "};\n";
  return name;
}

// Which of the descriptions is in force.
std::string stage_function(const Controller& controller) {
  std::string index;
  int stage = 0;
  for (const std::size_t start : controller.stage_starts)
    if (start > 0)
      index += (index.empty() ? "" : " + ") + std::string("((self->sample >= {NAME}_STAGE_") + std::to_string(++stage) +
               ") ? 1u : 0u)";
  return fill(R"(
/* The plant of this sample. */
static inline const lqg_kalman_{filter}_t *{name}_kalman(const {name}_t *self)
{
    return &{NAME}_KALMAN[{index}];
}
)",
              [&] {
                Words words = common_words(controller);
                words["index"] = fill(index, words);
                return words;
              }());
}

void add_gate(const Controller& controller, Tables& tables) {
  const controller::Gate& gate = controller.gate;
  numbers("WIDENING", {gate.start.data(), gate.start.data() + gate.start.size()}, tables);
  tables.add("WIDEN", factor_names(controller, step::Quantity::gate_widen, gate.widen));
  tables.add("NARROW", factor_names(controller, step::Quantity::gate_narrow, gate.narrow));
  tables.text += fill(R"(static const lqg_gate_t {NAME}_KALMAN_GATE = {
    {NAME}_GATE, {NAME}_KALMAN_WIDENING, {NAME}_KALMAN_WIDEN, {NAME}_KALMAN_NARROW  /* sigma, start, widen, narrow */
};
)",
                      common_words(controller));
}

}  // namespace

Tables::Tables(const Controller& controller, const char* owner)
    : controller_(controller), name_(upper(controller.problem.name) + "_" + owner) {}

std::string Tables::add(const std::string& suffix, const RealMatrix& matrix) {
  return define(suffix, array_values(matrix, controller_.target.is_double), matrix.size());
}

std::string Tables::add(const std::string& suffix, const std::vector<std::string>& values) {
  std::string lines;
  for (const std::string& value : values) lines += "    " + value + (&value == &values.back() ? "\n" : ",\n");
  return define(suffix, lines, static_cast<Eigen::Index>(values.size()));
}

std::string Tables::define(const std::string& suffix, const std::string& values, Eigen::Index size,
                           const std::string& type) {
  if (size == 0) return "NULL";
  auto& same_suffix = defined_[suffix];
  const std::string number = same_suffix.empty() ? "" : "_" + std::to_string(same_suffix.size());
  const auto [at, is_new] = same_suffix.try_emplace(values, name_ + "_" + suffix + number);
  if (is_new)
    text += "static const " + type + " " + at->second + "[" + std::to_string(size) + "] = {\n" + values + "};\n";
  return at->second;
}

std::string Tables::add_unless_zero(const std::string& suffix, const RealMatrix& matrix) {
  return is_zero(matrix) ? "NULL" : add(suffix, matrix);
}

std::string kalman_constants(const Controller& controller) {
  Tables tables(controller, "KALMAN");
  if (controller.has.gate) add_gate(controller, tables);
  add_range(controller, tables);
  std::vector<std::string> descriptions;
  for (const std::size_t start : controller.stage_starts)
    descriptions.push_back(controller.solution.online ? online_fields(controller, start, tables)
                                                      : steady_fields(controller, start, tables));
  const Words words = common_words(controller);
  if (descriptions.size() == 1)
    return tables.text + fill("static const lqg_kalman_{filter}_t {NAME}_KALMAN = {\n", words) + descriptions[0] +
           "};\n";
  std::string all;
  for (const std::string& description : descriptions)
    all += "    {\n" + description + (&description == &descriptions.back() ? "    }\n" : "    },\n");
  return tables.text +
         fill("static const lqg_kalman_{filter}_t {NAME}_KALMAN[" + std::to_string(descriptions.size()) + "] = {\n",
              words) +
         all + "};\n" + stage_function(controller);
}

std::string lqr_constants(const Controller& controller) {
  Tables tables(controller, "LQR");
  const std::string NAME = upper(controller.problem.name), K = tables.add("K", stacked(controller.laws, 0));
  const auto [u_min, u_max] = limits_fields(controller, tables);
  return tables.text + "static const lqg_lqr_t " + NAME + "_LQR = {\n    " +
         fields({NAME + "_NX", NAME + "_NU", K, u_min, u_max}) + "  /* nx, nu, K, u_min, u_max */\n};\n";
}

std::string servo_constants(const Controller& controller) {
  Tables tables(controller, "SERVO");
  const bool is_double = controller.target.is_double;
  const std::string NAME = upper(controller.problem.name), SERVO = NAME + "_SERVO";
  const std::string K = tables.add("K", stacked(controller.laws, 0)),
                    Nbar = tables.add("NBAR", stacked(controller.laws, 1));
  const std::string H = tables.add("H", stacked(controller.laws, 2));
  const std::vector<controller::Place> places = controller::changing_places(controller.laws, is_double);
  if (std::any_of(places.begin(), places.end(), [](const controller::Place& place) { return place.matrix == 3; }))
    tables.add("H_INPUT", stacked(controller.laws, 3));  // set_input, which is no call of the library, reads it
  const auto model =
      controller::model_of<double>(controller, [](const Real& value) { return design::to_double(value); });
  const std::string output = index_array(SERVO + "_OUTPUT", model.integral, tables.text);
  const std::string wanted = index_array(SERVO + "_REFERENCE", model.wanted, tables.text);
  const auto [u_min, u_max] = limits_fields(controller, tables);
  const Eigen::VectorXd& error = controller.bounds.error;
  const std::string xi_scale = tables.add("XI_SCALE", inverse_powers(controller, controller.bounds.xi));
  const std::string error_limit = tables.add("ERROR_LIMIT", names_of(controller, step::Quantity::error_limit, error));
  const std::string u_step =
      controller.has.rate_limit && !controller.has.foresight
          ? tables.add("U_STEP", names_of(controller, step::Quantity::u_step, controller::rate_steps(controller)))
          : "NULL";
  return tables.text + "static const lqg_servo_t " + SERVO + " = {\n    " +
         fields({NAME + "_NX", NAME + "_NU", std::to_string(controller.size.nr), std::to_string(controller.size.nxi),
                 controller.has.input_change ? "1" : "0", NAME + "_SAMPLE_TIME"}) +
         ",  /* nx, nu, nr, nxi, gives_change, T */\n    " + fields({K, Nbar, H, "NULL", output, wanted}) +
         ",  /* K, Nbar, H, H_input, output, reference */\n    " +
         fields({u_min, u_max, u_step, xi_scale, error_limit}) +
         "  /* u_min, u_max, u_step, xi_scale, error_limit */\n};\n";
}

}  // namespace lqg::emit
