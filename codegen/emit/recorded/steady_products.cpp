// SPDX-License-Identifier: MIT
#include "emit/recorded/steady_products.hpp"

#include <algorithm>

#include "controller/gains.hpp"
#include "emit/recorded/symbols.hpp"
#include "step/loop.hpp"
#include "step/operating_point.hpp"

namespace lqg::emit {

namespace {

using trace::Expr;

// Straight lines take 16 bytes and 4 instructions for an entry that is not zero, a loop 4 bytes and 4 for any entry.
bool is_worth_loop(const design::RealMatrix& matrix) {
  constexpr Eigen::Index least_entries = 12;
  return matrix.size() >= least_entries && 2 * (matrix.array() != 0).count() > matrix.size();
}

Product product_of(const char* name, const char* meaning, const design::RealMatrix& matrix) {
  return {name, meaning, is_worth_loop(matrix) ? matrix : design::RealMatrix()};
}

void clear(step::Matrix<Expr>& matrix, Eigen::Index columns) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < columns; ++j) matrix(i, j) = Expr(0);
}

// Runs `step(model, state, listener, function)` on a fresh graph, with the model without what is in loops.
template <class Step>
TracedFunction trace_without(const Controller& controller, const SteadyProducts& products, Step step) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  SymbolicModel model = symbolic_model(controller);
  if (is_in_loop(products.C)) clear(model.C, model.C.cols());
  if (is_in_loop(products.L)) clear(model.L, model.L.cols());
  if (is_in_loop(products.K)) clear(model.K, model.nx);
  if (is_in_loop(products.A)) clear(model.A, model.A.cols());
  if (is_in_loop(products.B)) clear(model.B, model.B.cols());
  SymbolicState state = load_state(controller, model, {});
  TraceListener listener(controller, function);
  step(model, state, listener, function);
  return function;
}

}  // namespace

SteadyProducts steady_products(const Controller& controller) {
  const design::SampledPlant& plant = controller.solution.plant;
  SteadyProducts products = {product_of("MINUS_C", "−C", -plant.C),
                             product_of("L", "L", controller.filters.front()[0]),
                             {"MINUS_K", "−K", {}},
                             product_of("A", "A", plant.A),
                             {"B", "B", {}}};
  if (controller.has.regulator)
    products.K = product_of("MINUS_K", "−K", -controller.laws.front()[0].leftCols(controller.size.nx));
  if (is_in_loop(products.A)) products.B = product_of("B", "B", plant.B);
  return products;
}

bool can_loop_products(const Controller& controller) {
  if (controller.filter != step::Filter::steady || controller.linear || controller.has.stages) return false;
  const bool is_double = controller.target.is_double;
  if (!controller::changing_places(controller.filters, is_double).empty() || controller.keeps.gain_row ||
      controller.keeps.sample)
    return false;
  const SteadyProducts products = steady_products(controller);
  return is_in_loop(products.C) || is_in_loop(products.L) || is_in_loop(products.K) || is_in_loop(products.A);
}

std::vector<int> heights_of_blocks(const Product& product) {
  constexpr int most = 6;  // sums, and twice as many entries and products, in registers
  std::vector<int> heights;
  const int rows = static_cast<int>(product.matrix.rows());
  const int blocks = std::max(1, (rows + most - 1) / most), height = (rows + blocks - 1) / blocks;
  for (int left = rows; left > 0; left -= heights.back()) heights.push_back(std::min(left, height));
  return heights;
}

design::RealMatrix in_blocks(const Product& product) {
  design::RealMatrix row(1, product.matrix.size());
  Eigen::Index at = 0, first = 0;
  for (const int height : heights_of_blocks(product)) {
    for (Eigen::Index j = 0; j < product.matrix.cols(); ++j)
      for (Eigen::Index i = first; i < first + height; ++i) row(0, at++) = product.matrix(i, j);
    first += height;
  }
  return row;
}

TracedFunction trace_innovate(const Controller& controller, const SteadyProducts& products) {
  return trace_without(
      controller, products,
      [&](const SymbolicModel& model, SymbolicState& state, TraceListener& listener, TracedFunction& function) {
        const bool is_begun = is_in_loop(products.C), has_range = model.y_min.size() > 0;
        const Symbols begun = load(controller, "innovation", "begun", is_begun ? model.ny : 0, at_output);
        const Symbols given =
            step::output_deviations(model.point, load(controller, "y", "y", model.ny, at_output), listener);
        const Symbols y = step::in_range_or_nan(model, given, listener);
        Symbols innovation(model.ny);
        std::vector<trace::Condition> used;
        for (int i = 0; i < model.ny; ++i) {
          const Expr heard = y(i), from = is_begun ? begun(i) : heard;
          const bool may_be_out = is_begun && has_range;
          const Expr told = may_be_out ? trace::select(trace::is_finite(heard), from, trace::not_a_number(from)) : from;
          const step::Innovation<Expr> found = step::innovate(model, state, told, i, listener);
          innovation(i) = found.value;
          used.push_back(found.is_used);
        }
        step::observe(model, state, y, used, listener);
        if (model.M.cols()) state.innovation = innovation;
        for (int i = 0; i < model.ny; ++i) store(function, element("innovation", i), innovation(i));
        store_state(controller, function, state, {});
      });
}

TracedFunction trace_end_of_steady_update(const Controller& controller, const SteadyProducts& products) {
  return trace_without(
      controller, products,
      [&](const SymbolicModel& model, SymbolicState& state, TraceListener& listener, TracedFunction& function) {
        const Symbols innovation = load(controller, "innovation", "innovation", model.ny, at_output);
        function.finite = step::correct_steady(model, state, innovation, 0, listener).node;
        store_state(controller, function, state, {});
      });
}

TracedFunction trace_law(const Controller& controller, const SteadyProducts& products) {
  return trace_without(
      controller, products,
      [&](SymbolicModel model, SymbolicState& state, TraceListener& listener, TracedFunction& function) {
        if (is_in_loop(products.K)) model.law_begun = load(controller, "sums", "begun", model.nu, at_input);
        const Symbols u = step::own_input(model.point, step::control(model, state, listener), listener);
        for (int i = 0; i < model.nu; ++i) store(function, element("u", i), u(i));
        store_state(controller, function, state, {});
      });
}

TracedFunction trace_steady_predict(const Controller& controller, const SteadyProducts& products) {
  return trace_without(
      controller, products,
      [&](SymbolicModel model, SymbolicState& state, TraceListener& listener, TracedFunction& function) {
        if (is_in_loop(products.A)) model.prediction_begun = load(controller, "sums", "begun", model.nx, at_state);
        const Symbols u = step::input_deviations(model.point, load(controller, "u", "u", model.nu, at_input), listener);
        function.finite = step::predict(model, state, u, listener).node;
        store_state(controller, function, state, {});
      });
}

}  // namespace lqg::emit
