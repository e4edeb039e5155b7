// SPDX-License-Identifier: MIT
#include "emit/recorded/shared_covariance.hpp"

#include <algorithm>

#include "emit/recorded/symbols.hpp"
#include "step/loop.hpp"
#include "step/operating_point.hpp"

namespace lqg::emit {

namespace {

using trace::Expr;

// Runs `step(model, state, listener, function)` on a fresh graph.
template <class Step>
TracedFunction trace_part(const Controller& controller, Step step) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const SymbolicModel model = symbolic_model(controller);
  SymbolicState state = load_state(controller, model, covariance_pattern(controller));
  TraceListener listener(controller, function);
  step(model, state, listener, function);
  return function;
}

void store_all(TracedFunction& function, const char* array, const Symbols& values) {
  for (int i = 0; i < values.size(); ++i) store(function, element(array, i), values(i));
}

// What the state has besides P.
void store_rest(const Controller& controller, TracedFunction& function, SymbolicState state) {
  state.P.clear();
  store_state(controller, function, state, covariance_pattern(controller));
}

Symbols load_covariance(const Controller& controller, int nx) { return load(controller, "cov", "cov", nx, at_state); }

}  // namespace

bool can_share_covariance(const Controller& controller) {
  return controller.filter == step::Filter::plain && !controller.has.stages && !controller.keeps.innovation &&
         controller.solution.online->E.isIdentity(0) && !controller::is_extended(controller);
}

std::vector<std::pair<int, int>> blocks_of_rows(const Controller& controller) {
  constexpr int rows = 4;  // few registers, and few rows that a row of P does not need
  std::vector<std::pair<int, int>> blocks;
  for (int first = 0; first < controller.size.nx; first += rows)
    blocks.emplace_back(first, std::min(first + rows, controller.size.nx));
  return blocks;
}

bool loops_over_columns(const Controller& controller) {
  return controller.sharing == controller::Sharing::columns || controller.sharing == controller::Sharing::entries;
}

std::optional<int> measured_state(const Controller& controller, int output) {
  const design::RealMatrix& C = controller.solution.online->C;
  std::optional<int> state;
  for (Eigen::Index k = 0; k < C.cols(); ++k) {
    if (C(output, k) == 0) continue;
    if (state || C(output, k) != 1) return std::nullopt;
    state = static_cast<int>(k);
  }
  return state;
}

bool is_column(const Controller& controller, int output) {
  return controller.sharing == controller::Sharing::entries && measured_state(controller, output);
}

bool takes_columns(const Controller& controller) {
  for (int i = 0; i < controller.size.ny; ++i)
    if (is_column(controller, i)) return true;
  return false;
}

bool is_projected(const Controller& controller, int output) {
  const design::RealMatrix& C = controller.solution.online->C;
  return controller.size.ny > 1 && 2 * (C.row(output).array() != 0).count() > C.cols();
}

bool projects(const Controller& controller) {
  for (int i = 0; i < controller.size.ny; ++i)
    if (is_projected(controller, i)) return true;
  return false;
}

TracedFunction trace_projection(const Controller& controller) {
  TracedFunction function = trace_part(controller, [&](SymbolicModel model, const SymbolicState& state,
                                                       TraceListener& listener, TracedFunction& traced) {
    model.C = load(controller, "c", "c", model.nx, at_state).transpose();
    store_all(traced, "cov", step::covariance_with_output(model, state, 0, listener));
  });
  function.is_void = true;
  return function;
}

TracedFunction trace_use(const Controller& controller, int output) {
  return trace_part(controller, [&](const SymbolicModel& model, SymbolicState& state, TraceListener& listener,
                                    TracedFunction& function) {
    const std::string parameter = "y_" + controller.problem.plant.outputs[static_cast<std::size_t>(output)].name;
    const Expr given =
        step::output_deviation(model.point, Expr::of(trace::graph().input(parameter, parameter)), output, listener);
    const Expr y = step::in_range_or_nan(model, given, output, listener);
    const bool is_there = is_projected(controller, output) || is_column(controller, output);
    const Symbols f =
        is_there ? load_covariance(controller, model.nx) : step::covariance_with_output(model, state, output, listener);
    const step::PlainCorrection<Expr> correction = step::plain_correction(model, state, f, y, output, listener);
    store(function, "*reciprocal", correction.reciprocal);
    store(function, "*innovation", correction.innovation);
    store_all(function, "cov", f);
    store_rest(controller, function, state);
  });
}

TracedFunction trace_correction(const Controller& controller) {
  TracedFunction function = trace_part(controller, [&](const SymbolicModel& model, SymbolicState& state,
                                                       TraceListener& listener, TracedFunction& traced) {
    listener.section("L = cov / S,  x̂ ← x̂ + L innovation,  P ← P − L covᵀ");
    const Symbols f = load_covariance(controller, model.nx);
    const Expr reciprocal = Expr::of(trace::graph().input("reciprocal", "reciprocal")),
               innovation = Expr::of(trace::graph().input("innovation", "innovation"));
    for (int j = model.nx - 1; j >= 0; --j) step::correct_plain_row(state, f, reciprocal, innovation, j, listener);
    SymbolicState corrected;
    corrected.x = state.x;
    corrected.P = state.P;
    store_state(controller, traced, corrected, covariance_pattern(controller));
  });
  function.is_void = true;
  return function;
}

TracedFunction trace_end_of_update(const Controller& controller) {
  return trace_part(controller, [&](const SymbolicModel& model, const SymbolicState& state, TraceListener& listener,
                                    TracedFunction& function) {
    function.finite = step::has_sound_state(model, state, listener).node;
    function.checks_covariance = true;
  });
}

TracedFunction trace_rows(const Controller& controller, int first, int end) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const SymbolicModel model = symbolic_model(controller);
  TraceListener listener(controller, function);
  listener.section("rows of start + A v");
  const Symbols start = load(controller, "start", "start", model.nx, at_state),
                v = load(controller, "v", "v", model.nx, at_state);
  for (int i = first; i < end; ++i) {
    Expr sum = start(i);
    for (int k = 0; k < model.nx; ++k) sum = trace::multiply_add(v(k), model.A_free(i, k), sum);
    listener.name(sum, "product", step::of_state(i));
    store(function, "product[" + (i ? std::to_string(i) + " * stride" : "0") + "]", sum);
  }
  function.is_void = true;
  return function;
}

TracedFunction trace_end_of_predict(const Controller& controller) {
  return trace_part(controller, [&](const SymbolicModel& model, SymbolicState& state, TraceListener& listener,
                                    TracedFunction& function) {
    const Symbols u = step::input_deviations(model.point, load(controller, "u", "u", model.nu, at_input), listener);
    function.finite = step::predict_plain_state(model, state, u, listener).node;
    function.checks_covariance = true;
    store_rest(controller, function, state);
  });
}

}  // namespace lqg::emit
