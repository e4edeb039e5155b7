// SPDX-License-Identifier: MIT
#include "emit/recorded/symbols.hpp"

#include "controller/gains.hpp"
#include "controller/model_of_outputs.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "emit/text/wording.hpp"
#include "step/operating_point.hpp"

namespace lqg::emit {

namespace {

using trace::Expr;

// Symbols for the entries of the pattern, zeros elsewhere. `place` tells row and column of an entry.
template <class Place>
std::vector<Expr> load_pattern(trace::Graph& graph, const std::string& array, const std::string& name, int size,
                               const std::vector<Expr>& initial, const std::vector<bool>& pattern, std::size_t from,
                               Place place) {
  std::vector<Expr> symbols;
  for (std::size_t k = 0; k < initial.size(); ++k) {
    if (!pattern[from + k]) {
      symbols.push_back(Expr(0));
      continue;
    }
    const auto [i, j] = place(static_cast<int>(k));
    symbols.push_back(Expr::of(graph.input(element(array, static_cast<int>(k)), name + index_suffix(i, j, size))));
  }
  return symbols;
}

std::pair<int, int> place_in_triangle(int k) {
  int i = 0;
  while ((i + 1) * (i + 2) / 2 <= k) ++i;
  return {i, k - i * (i + 1) / 2};
}

std::pair<int, int> place_in_strict_triangle(int k) {
  int j = 1;
  while ((j + 1) * j / 2 <= k) ++j;
  return {k - j * (j - 1) / 2, j};
}

// Entries that change from sample to sample are read from a row of their table: of those entries alone in straight-line
// code, of all of K, Nbar, H or H_input where the library's loops run over it.
void read_row(const Controller& controller, const std::vector<Gains>& rows, const char* table,
              const std::vector<const char*>& names, const std::vector<step::Matrix<Expr>*>& matrices) {
  const bool compact = controller.style == design::Style::compact;
  int at = 0;
  for (const auto& [matrix, i, j] : controller::changing_places(rows, controller.target.is_double)) {
    step::Matrix<Expr>& gain = *matrices[matrix];
    const std::string entry =
        compact ? element(names[matrix], i * static_cast<int>(gain.cols()) + j) : element(table, at++);
    const bool is_of_output = std::string(names[matrix]) == "variance";
    gain(i, j) = Expr::of(trace::graph().input(
        entry, names[matrix] + suffix_of(controller, is_of_output ? step::of_output(i) : step::of_entry(i, j))));
  }
}

// Names for the numbers that are no gains. A factor of the gate that all outputs share has one name.
void name_constants(const Controller& controller, SymbolicModel& model) {
  const auto name = [&](step::Vector<Expr>& values, step::Quantity quantity) {
    for (int i = 0; i < values.size(); ++i) values(i) = named(controller, values(i), quantity, i);
  };
  const auto name_factors = [&](step::Vector<Expr>& values, const Eigen::VectorXd& given, step::Quantity quantity) {
    for (int i = 0; i < values.size(); ++i)
      values(i) = named(controller, values(i), quantity, is_same_for_all(given) ? -1 : i);
  };
  name(model.u_min, step::Quantity::u_min);
  name(model.u_max, step::Quantity::u_max);
  name(model.u_step, step::Quantity::u_step);
  name(model.foreseen.u_step, step::Quantity::u_step);
  for (int i = 0; i < model.nu && controller.has.foresight; ++i) {
    model.foreseen.low(i) = named(controller, model.foreseen.low(i), step::Quantity::u_min, i);
    model.foreseen.high(i) = named(controller, model.foreseen.high(i), step::Quantity::u_max, i);
  }
  name(model.y_min, step::Quantity::y_min);
  name(model.y_max, step::Quantity::y_max);
  name(model.nu_limit, step::Quantity::innovation_limit);
  name(model.error_limit, step::Quantity::error_limit);
  name(model.variance, step::Quantity::innovation_variance);
  name_factors(model.gate_widen, controller.gate.widen, step::Quantity::gate_widen);
  name_factors(model.gate_narrow, controller.gate.narrow, step::Quantity::gate_narrow);
  if (controller.has.gate) model.gate = named(controller, model.gate, step::Quantity::gate);
  model.T = named(controller, model.T, step::Quantity::sample_time);
  model.point = symbolic_point(controller);
}

}  // namespace

bool has_point(const Controller& controller) {
  const controller::Point& point = controller.point;
  return point.x.size() + point.u.size() + point.y.size() + point.r.size() > 0;
}

step::OperatingPoint<Expr> symbolic_point(const Controller& controller) {
  step::OperatingPoint<Expr> point = controller::convert_point<Expr>(controller.point);
  const auto name = [&](step::Vector<Expr>& values, step::Quantity quantity) {
    for (int i = 0; i < values.size(); ++i)
      if (!step::is_at_zero(values, i)) values(i) = named(controller, values(i), quantity, i);
  };
  name(point.x, step::Quantity::point_x);
  name(point.u, step::Quantity::point_u);
  name(point.y, step::Quantity::point_y);
  for (int i = 0; i < point.r.size(); ++i)
    if (!step::is_at_zero(point.r, i))
      point.r(i) =
          named(controller, point.r(i), step::Quantity::point_y, controller.references[static_cast<std::size_t>(i)]);
  return point;
}

SymbolicModel symbolic_model(const Controller& controller) {
  const bool is_double = controller.target.is_double;
  SymbolicModel model = controller::model_of<Expr>(
      controller, [&](const design::Real& value) { return Expr(rounded_to_target(value, is_double)); });
  read_row(controller, controller.laws, "law", {"K", "Nbar", "H", "H_input"},
           {&model.K, &model.Nbar, &model.H, &model.H_input});
  step::Matrix<Expr> variance = model.variance;
  read_row(controller, controller.filters, "gains", {"L", "M", "variance"}, {&model.L, &model.M, &variance});
  if (controller.has.gate) model.variance = variance;
  name_constants(controller, model);
  return model;
}

SymbolicModel model_of_outputs(const Controller& controller) {
  SymbolicModel model = symbolic_model(controller);
  controller::take_outputs_as_they_are(
      controller,
      [&](const design::Real& value) { return Expr(rounded_to_target(value, controller.target.is_double)); }, model);
  if (!controller.solution.online && controller.style == design::Style::compact && controller.has.gate &&
      controller.keeps.gain_row)
    for (int i = 0; i < model.ny; ++i)  // as the library's loops find them
      model.variance(i) = Expr::of(trace::graph().input(
          fill("{NAME}_KALMAN_S[{filter_row} * {NAME}_NY + ", common_words(controller)) + std::to_string(i) + "]",
          "variance" + suffix_of(controller, step::of_output(i))));
  return model;
}

void load_memory(const Controller& controller, const SymbolicModel& model, SymbolicState& state) {
  const SymbolicState sizes = step::initial_state(model);
  const auto load_as = [&](const Symbols& like, const char* array, const char* name, step::Place (*place)(int)) {
    return load(controller, std::string("self->") + array, name, static_cast<int>(like.size()), place);
  };
  state.u = load_as(sizes.u, "u_applied", "u_applied", at_input);
  state.widening = load_as(sizes.widening, "widening", "widening", at_output);
  state.innovation = load_as(sizes.innovation, "innovation", "last_innovation", at_output);
  state.r = load_as(sizes.r, "r", "r", at_reference);
  state.xi = load_as(sizes.xi, "xi", "xi", at_integral);
  state.error = load_as(sizes.error, "error", "error", at_integral);
  state.demand = load_as(sizes.demand, "demand", "demand", at_input);
}

SymbolicState load_state(const Controller& controller, const SymbolicModel& model, const std::vector<bool>& pattern) {
  trace::Graph& graph = trace::graph();
  SymbolicState state;
  const std::string kept = controller::kept_name(controller);
  state.x = load(controller, (model.filter == step::Filter::none ? "" : "self->") + kept, kept, model.nx, at_state);
  if (!pattern.empty()) {
    state.P = load_pattern(graph, "self->P", "P", model.nx, model.P0, pattern, 0, place_in_triangle);
    state.U = load_pattern(graph, "self->U", "U", model.nx, model.U0, pattern, 0, place_in_strict_triangle);
    state.D = load_pattern(graph, "self->d", "d", model.nx, model.D0, pattern, model.U0.size(),
                           [](int k) { return std::pair(k, -1); });
  }
  load_memory(controller, model, state);
  return state;
}

SymbolicState resume_state(const Controller& controller, const SymbolicState& state, const std::vector<bool>& pattern) {
  SymbolicState resumed = state;
  const auto resume = [&](Expr& value, const char* array, int i, const std::string& name) {
    value = Expr::of(trace::graph().resume(value.node, element(array, i), name));
  };
  const auto resume_vector = [&](Symbols& values, const char* array, const char* name, step::Place (*place)(int)) {
    for (int i = 0; i < values.size(); ++i) resume(values(i), array, i, name + suffix_of(controller, place(i)));
  };
  const auto resume_covariance = [&](std::vector<Expr>& values, const char* array, const char* name, std::size_t from,
                                     std::pair<int, int> (*place)(int)) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const auto [i, j] = place(static_cast<int>(k));
      const std::string suffix = index_suffix(i, j, controller.size.nx);
      if (pattern[from + k]) resume(values[k], array, static_cast<int>(k), name + suffix);
    }
  };
  const std::string kept = controller::kept_name(controller);
  resume_vector(resumed.x, ("self->" + kept).c_str(), kept.c_str(), at_state);
  resume_covariance(resumed.P, "self->P", "P", 0, place_in_triangle);
  resume_covariance(resumed.U, "self->U", "U", 0, place_in_strict_triangle);
  resume_covariance(resumed.D, "self->d", "d", state.U.size(), [](int k) { return std::pair(k, -1); });
  resume_vector(resumed.u, "self->u_applied", "u_applied", at_input);
  resume_vector(resumed.innovation, "self->innovation", "last_innovation", at_output);
  resume_vector(resumed.r, "self->r", "r", at_reference);
  resume_vector(resumed.xi, "self->xi", "xi", at_integral);
  resume_vector(resumed.error, "self->error", "error", at_integral);
  resume_vector(resumed.demand, "self->demand", "demand", at_input);
  return resumed;
}

void store_state(const Controller& controller, TracedFunction& function, const SymbolicState& state,
                 const std::vector<bool>& pattern) {
  const auto store_vector = [&](const char* array, const Symbols& values) {
    for (int i = 0; i < values.size(); ++i) store(function, element(std::string("self->") + array, i), values(i));
  };
  const auto store_covariance = [&](const char* array, const std::vector<Expr>& values, std::size_t from) {
    for (std::size_t k = 0; k < values.size(); ++k)
      if (pattern[from + k]) store(function, element(array, static_cast<int>(k)), values[k]);
  };
  store_vector(controller::kept_name(controller), state.x);
  if (!pattern.empty()) {
    store_covariance("self->P", state.P, 0);
    store_covariance("self->U", state.U, 0);
    store_covariance("self->d", state.D, state.U.size());
  }
  store_vector("u_applied", state.u);
  store_vector("widening", state.widening);
  store_vector("innovation", state.innovation);
  store_vector("xi", state.xi);
  store_vector("error", state.error);
  store_vector("demand", state.demand);
}

}  // namespace lqg::emit
