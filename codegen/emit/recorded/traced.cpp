#include "emit/recorded/traced.hpp"

#include "controller/gains.hpp"
#include "controller/model_of.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "emit/recorded/trace_listener.hpp"
#include "emit/text/wording.hpp"
#include "step/by_hand.hpp"
#include "step/covariance.hpp"
#include "step/innovation.hpp"
#include "step/loop.hpp"
#include "step/partial_update.hpp"
#include "trace/expr.hpp"

namespace lqg::emit {

namespace {

using trace::Expr;
using Model = step::Model<Expr>;
using State = step::State<Expr>;

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

// All that is neither the estimate nor its covariance.
void load_memory(const Model& model, State& state) {
  const State sizes = step::initial_state(model);
  const auto load_as = [&](const Symbols& like, const char* array, const char* name) {
    return load(trace::graph(), std::string("self->") + array, name, static_cast<int>(like.size()));
  };
  state.u = load_as(sizes.u, "u_applied", "u_applied");
  state.innovation = load_as(sizes.innovation, "innovation", "kept");
  state.r = load_as(sizes.r, "r", "r");
  state.xi = load_as(sizes.xi, "xi", "integral");
  state.error = load_as(sizes.error, "error", "error");
  state.demand = load_as(sizes.demand, "demand", "asked");
}

// With the entries of the covariance that are in `pattern`; no pattern: without it.
State load_state(const Model& model, const std::vector<bool>& pattern) {
  trace::Graph& graph = trace::graph();
  State state;
  state.x = load(graph, model.filter == step::Filter::none ? "x" : "self->x", "x", model.nx);
  if (!pattern.empty()) {
    state.P = load_pattern(graph, "self->P", "P", model.nx, model.P0, pattern, 0, place_in_triangle);
    state.U = load_pattern(graph, "self->U", "U", model.nx, model.U0, pattern, 0, place_in_strict_triangle);
    state.D = load_pattern(graph, "self->d", "d", model.nx, model.D0, pattern, model.U0.size(),
                           [](int k) { return std::pair(k, -1); });
  }
  load_memory(model, state);
  return state;
}

void store_state(TracedFunction& function, const State& state, const std::vector<bool>& pattern) {
  const auto store_vector = [&](const char* array, const Symbols& values) {
    for (int i = 0; i < values.size(); ++i) store(function, element(std::string("self->") + array, i), values(i));
  };
  const auto store_covariance = [&](const char* array, const std::vector<Expr>& values, std::size_t from) {
    for (std::size_t k = 0; k < values.size(); ++k)
      if (pattern[from + k]) store(function, element(array, static_cast<int>(k)), values[k]);
  };
  store_vector("x", state.x);
  store_covariance("self->P", state.P, 0);
  store_covariance("self->U", state.U, 0);
  store_covariance("self->d", state.D, state.U.size());
  store_vector("u_applied", state.u);
  store_vector("innovation", state.innovation);
  store_vector("xi", state.xi);
  store_vector("error", state.error);
  store_vector("demand", state.demand);
}

// Entries that change from sample to sample are read from a row of their table: of those entries alone in straight-line
// code, of all of K, Nbar or H where the library's loops run over it.
void read_row(const Controller& controller, const std::vector<Gains>& rows, const char* table,
              const std::vector<const char*>& names, const std::vector<step::Matrix<Expr>*>& matrices) {
  const bool compact = controller.style == design::Style::compact;
  int at = 0;
  for (const auto& [matrix, i, j] : controller::changing_places(rows, controller.target.is_double)) {
    step::Matrix<Expr>& gain = *matrices[matrix];
    const std::string entry = compact ? element(names[matrix], i * static_cast<int>(gain.cols()) + j) : element(table, at++);
    gain(i, j) = Expr::of(trace::graph().input(entry, names[matrix] + index_suffix(i, j, controller.size.nx)));
  }
}

Model symbolic_model(const Controller& controller) {
  const bool is_double = controller.target.is_double;
  Model model = controller::model_of<Expr>(controller, [&](const design::Real& value) {
    return Expr(rounded_to_target(value, is_double));
  });
  read_row(controller, controller.laws, "law", {"K", "Nbar", "H"}, {&model.K, &model.Nbar, &model.H});
  step::Matrix<Expr> variance = model.variance;
  read_row(controller, controller.filters, "gains", {"L", "M", "variance"}, {&model.L, &model.M, &variance});
  if (controller.has.gate) model.variance = variance;
  return model;
}

// Runs `step(model, state, listener)` on a fresh graph; what it returns is the condition that the state is finite.
template <class Step>
TracedFunction trace_step(const Controller& controller, const std::vector<bool>& pattern, Step step) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  State state = load_state(model, pattern);
  TraceListener listener(controller, function);
  function.finite = step(model, state, listener).node;
  store_state(function, state, pattern);
  return function;
}

TracedFunction trace_update(const Controller& controller, const std::vector<bool>& pattern) {
  return trace_step(controller, pattern, [](const Model& model, State& state, TraceListener& listener) {
    return step::update(model, state, load(trace::graph(), "y", "y", model.ny), listener);
  });
}

// y_OUTPUT
Expr load_output(const Controller& controller, int output) {
  return Expr::of(trace::graph().input("y_" + controller.problem.plant.outputs[static_cast<std::size_t>(output)].name, "y"));
}

TracedFunction trace_update_alone(const Controller& controller, const std::vector<bool>& pattern, int output) {
  return trace_step(controller, pattern, [&](const Model& model, State& state, TraceListener& listener) {
    return step::update_alone(model, state, load_output(controller, output), output, listener);
  });
}

TracedFunction trace_predict(const Controller& controller, const std::vector<bool>& pattern) {
  return trace_step(controller, pattern, [](const Model& model, State& state, TraceListener& listener) {
    return step::predict(model, state, load(trace::graph(), "u", "u", model.nu), listener);
  });
}

TracedFunction trace_control(const Controller& controller) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  State state = load_state(model, {});
  TraceListener listener(controller, function);
  Symbols u;
  if (controller.has.filter || !controller.has.servo) u = step::control(model, state, listener);
  else function.finite = step::act(model, state, u, listener).node;
  for (int i = 0; i < model.nu; ++i) store(function, element("u", i), u(i));
  state.x.resize(0);  // it is only read
  store_state(function, state, {});
  return function;
}

std::vector<bool> initial_pattern(const Controller& controller) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  std::vector<bool> pattern;
  for (const Expr& entry : model.P0) pattern.push_back(!trace::is_zero(entry));
  for (const Expr& entry : model.U0) pattern.push_back(!trace::is_zero(entry));
  pattern.resize(pattern.size() + model.D0.size(), true);
  return pattern;
}

// Adds to `pattern` what a step over its entries makes different from 0.
void grow(std::vector<bool>& pattern, const Controller& controller, bool predicts) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  State state = load_state(model, pattern);
  TraceListener listener(controller, function);
  if (predicts) step::predict(model, state, load(*function.graph, "u", "u", model.nu), listener);
  else step::update(model, state, load(*function.graph, "y", "y", model.ny), listener);
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    const Expr& entry = !state.P.empty() ? state.P[k] : k < state.U.size() ? state.U[k] : state.D[k - state.U.size()];
    if (!trace::is_zero(entry)) pattern[k] = true;
  }
}

}  // namespace

std::vector<int> TracedFunction::results() const {
  std::vector<int> nodes;
  for (const trace::Store& store : stores) nodes.push_back(store.node);
  nodes.insert(nodes.end(), statuses.begin(), statuses.end());
  if (finite >= 0) nodes.push_back(finite);
  for (const auto& [output, gated] : gates) nodes.push_back(gated);
  nodes.insert(nodes.end(), lost.begin(), lost.end());
  return nodes;
}

std::vector<bool> covariance_pattern(const Controller& controller) {
  std::vector<bool> pattern = initial_pattern(controller), before;
  while (pattern != before && !pattern.empty()) {  // it can only grow
    before = pattern;
    grow(pattern, controller, true);
    grow(pattern, controller, false);
  }
  return pattern;
}

// The outputs as they are, not made uncorrelated: V = E⁻¹ diag(V) E⁻ᵀ.
Model model_of_outputs(const Controller& controller) {
  Model model = symbolic_model(controller);
  const auto round = [&](const design::Real& value) { return Expr(rounded_to_target(value, controller.target.is_double)); };
  model.C = controller::convert<Expr>(controller.solution.plant.C, round);
  if (controller.has.feedthrough) model.D = controller::convert<Expr>(controller.solution.plant.D, round);
  if (!controller.solution.online) {
    if (controller.style == design::Style::compact && controller.has.gate && controller.keeps.gain_row)
      for (int i = 0; i < model.ny; ++i)  // as the library's loops find them
        model.variance(i) = Expr::of(trace::graph().input(
            fill("{NAME}_KALMAN_S[self->gain_row * {NAME}_NY + ", common_words(controller)) + std::to_string(i) + "]", "variance"));
    return model;
  }
  const design::Digits digits(std::max(controller.solution.numerics.digits, 50u));
  const design::OnlineSolution& online = *controller.solution.online;
  const design::RealMatrix inverse = *design::solve(online.E, design::identity(online.E.rows()));
  model.V = controller::convert<Expr>(design::congruence(inverse, online.V.asDiagonal()).diagonal(), round);
  return model;
}

TracedFunction trace_innovation(const Controller& controller) {
  TracedFunction function = new_function(controller);
  function.is_void = true;
  const trace::Recording recording(*function.graph);
  const Model model = model_of_outputs(controller);
  const State state = load_state(model, covariance_pattern(controller));
  TraceListener listener(controller, function);
  const Symbols nu = step::innovations(model, state, load(*function.graph, "y", "y", model.ny), listener);
  for (int i = 0; i < model.ny; ++i) store(function, element("nu", i), nu(i));
  if (!controller.has.variance) return function;
  for (int i = 0; i < model.ny; ++i) {
    listener.section("S = C P Cᵀ + V", i);
    store(function, element("S", i), step::innovation_variance(model, state, i, listener));
  }
  return function;
}

TracedFunction trace_set_state(const Controller& controller) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  State state;  // without an x̂: it is not read
  load_memory(model, state);
  TraceListener listener(controller, function);
  function.finite = step::set_state(model, state, load(*function.graph, "x", "x", model.nx), listener).node;
  store_state(function, state, {});
  return function;
}

TracedFunction trace_set_input(const Controller& controller) {
  return trace_step(controller, {}, [&](const Model& model, State& state, TraceListener& listener) {
    const trace::Condition within = step::set_input(model, state, load(trace::graph(), "u", "u", model.nu), listener);
    if (!controller.has.filter) state.x.resize(0);  // it is only read
    return within;
  });
}

TracedFunction trace_covariance(const Controller& controller) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  TraceListener listener(controller, function);
  const std::vector<Expr> P = step::covariance(model, load_state(model, covariance_pattern(controller)), listener);
  for (std::size_t k = 0; k < P.size(); ++k) store(function, element("P", static_cast<int>(k)), P[k]);
  function.is_void = true;
  return function;
}

TracedFunction trace_observation(const Controller& controller, int output) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  State state = load_state(model, {});
  TraceListener listener(controller, function);
  step::observe_alone(model, state, load_output(controller, output), output, listener);
  store_state(function, state, {});
  return function;
}

TracedFunction trace_lost_outputs(const Controller& controller) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  TraceListener listener(controller, function);
  for (const trace::Condition& lost : step::lost_outputs(model, load(*function.graph, "nu", "nu", model.ny), listener))
    function.lost.push_back(lost.node);
  return function;
}

TracedController trace_controller(const Controller& controller) {
  TracedController traced;
  if (controller.has.filter) {
    const std::vector<bool> pattern = covariance_pattern(controller);
    traced.update = trace_update(controller, pattern);
    traced.predict = trace_predict(controller, pattern);
    for (int i = 0; i < controller.size.ny && controller.size.ny > 1; ++i)
      if (can_update_alone(controller, i)) traced.updates_alone.push_back(trace_update_alone(controller, pattern, i));
  }
  if (controller.has.regulator) traced.control = trace_control(controller);
  return traced;
}

}  // namespace lqg::emit
