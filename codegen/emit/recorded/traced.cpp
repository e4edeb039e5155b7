// SPDX-License-Identifier: MIT
#include "emit/recorded/traced.hpp"

#include "emit/recorded/symbols.hpp"
#include "emit/text/wording.hpp"
#include "step/by_hand.hpp"
#include "step/covariance.hpp"
#include "step/innovation.hpp"
#include "step/loop.hpp"
#include "step/operating_point.hpp"
#include "step/partial_update.hpp"

namespace lqg::emit {

namespace {

using trace::Expr;
using Model = SymbolicModel;
using State = SymbolicState;

// y, u and x that are handed over, as deviations from the operating point.
Symbols load_outputs(const Controller& controller, const Model& model, const char* array, TraceListener& listener) {
  return step::output_deviations(model.point, load(controller, array, "y", model.ny, at_output), listener);
}
Symbols load_input(const Controller& controller, const Model& model, TraceListener& listener) {
  return step::input_deviations(model.point, load(controller, "u", "u", model.nu, at_input), listener);
}

// Runs `step(model, state, listener)` on a fresh graph; what it returns is the condition that the state is finite.
template <class Step>
TracedFunction trace_step(const Controller& controller, const std::vector<bool>& pattern, Step step) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  State state = load_state(controller, model, pattern);
  TraceListener listener(controller, function);
  function.finite = step(model, state, listener).node;
  function.checks_covariance = !pattern.empty();
  store_state(controller, function, state, pattern);
  return function;
}

TracedFunction trace_update(const Controller& controller, const std::vector<bool>& pattern) {
  return trace_step(controller, pattern, [&](const Model& model, State& state, TraceListener& listener) {
    return step::update(model, state, load_outputs(controller, model, "y", listener), listener);
  });
}

// x[], of which a function is told.
Symbols load_state_by_hand(const Controller& controller) {
  const std::vector<design::Signal> states = state_signals(controller);
  Symbols x(controller.size.nx);
  for (int i = 0; i < controller.size.nx; ++i)
    x(i) = Expr::of(trace::graph().input(element("x", i), "x_" + states[static_cast<std::size_t>(i)].name));
  return x;
}

// y_OUTPUT
Expr load_output(const Controller& controller, int output) {
  const std::string parameter = "y_" + controller.problem.plant.outputs[static_cast<std::size_t>(output)].name;
  return Expr::of(trace::graph().input(parameter, parameter));
}

TracedFunction trace_update_alone(const Controller& controller, const std::vector<bool>& pattern, int output) {
  return trace_step(controller, pattern, [&](const Model& model, State& state, TraceListener& listener) {
    const Expr y = step::output_deviation(model.point, load_output(controller, output), output, listener);
    return step::update_alone(model, state, y, output, listener);
  });
}

TracedFunction trace_predict(const Controller& controller, const std::vector<bool>& pattern) {
  return trace_step(controller, pattern, [&](const Model& model, State& state, TraceListener& listener) {
    return step::predict(model, state, load_input(controller, model, listener), listener);
  });
}

}  // namespace

TracedFunction trace_regulator(const Controller& controller) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  State state = load_state(controller, model, {});
  TraceListener listener(controller, function);
  // The law within limits that are foreseen is called with deviations, and what it gives is one.
  const bool converts = !controller.has.foresight;
  if (!controller.has.filter && converts) state.x = step::state_deviations(model.point, state.x, listener);
  Symbols u;
  if (controller.has.foresight)
    u = step::clipped_law(model, state, step::reference(model, state, listener), listener);
  else if (controller.has.filter || !controller.has.servo)
    u = step::control(model, state, listener);
  else
    function.finite = step::act(model, state, u, listener).node;
  if (converts) u = step::own_input(model.point, u, listener);
  for (int i = 0; i < model.nu; ++i) store(function, element("u", i), u(i));
  state.x.resize(0);  // it is only read
  if (!controller.has.foresight) store_state(controller, function, state, {});
  return function;
}

TracedFunction trace_prediction(const Controller& controller) {
  return trace_predict(controller, covariance_pattern(controller));
}

std::vector<int> TracedFunction::results() const {
  std::vector<int> nodes;
  for (const std::vector<trace::Store>* kind : {&stores, &stores_if_sound})
    for (const trace::Store& store : *kind) nodes.push_back(store.node);
  nodes.insert(nodes.end(), statuses.begin(), statuses.end());
  if (finite >= 0) nodes.push_back(finite);
  nodes.insert(nodes.end(), gates.begin(), gates.end());
  nodes.insert(nodes.end(), asked.begin(), asked.end());
  nodes.insert(nodes.end(), lost.begin(), lost.end());
  return nodes;
}

std::vector<int> TracedFunction::results_before() const {
  std::vector<int> nodes;
  if (!before) return nodes;
  for (const std::vector<trace::Store>* parts : {&before->stores, &before->recovers})
    for (const trace::Store& store : *parts) nodes.push_back(store.node);
  nodes.insert(nodes.end(), before->statuses.begin(), before->statuses.end());
  if (before->finite >= 0) nodes.push_back(before->finite);
  return nodes;
}

trace::Printer printer_of(const TracedFunction& function) {
  return function.before ? trace::Printer(*function.graph, function.results_before(), function.results())
                         : trace::Printer(*function.graph, function.results());
}

bool is_same_for_all(const Eigen::VectorXd& values) { return (values.array() == values(0)).all(); }

TracedFunction trace_weigh(const Controller& controller) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  TraceListener listener(controller, function);
  const auto input = [&](const char* text, const char* name) { return Expr::of(function.graph->input(text, name)); };
  step::Weighing<Expr> weighing = step::weighing_of(model, 0);
  weighing.square = named(controller, weighing.square, step::Quantity::gate_squared);
  weighing.limit = named(controller, weighing.limit, step::Quantity::innovation_limit);
  const auto of_output = [&](Expr& constant, const Eigen::VectorXd& values, const char* text, const char* name) {
    if (!is_same_for_all(values)) constant = input(text, name);
  };
  of_output(weighing.limit, controller.bounds.innovation, "limits[i]", "limit");
  of_output(weighing.widen, controller.gate.widen, "widen[i]", "wider");
  of_output(weighing.narrow, controller.gate.narrow, "narrow[i]", "narrower");
  Expr widening = input("self->widening[i]", "widening");
  const Expr innovation = input("innovation", "innovation"), variance = input("S", "variance");
  step::weigh_unexpected(weighing, widening, innovation, variance, -1, listener);
  store(function, "self->widening[i]", widening);
  return function;
}

TracedFunction trace_innovation(const Controller& controller) {
  TracedFunction function = new_function(controller);
  function.is_void = true;
  const trace::Recording recording(*function.graph);
  Model model = model_of_outputs(controller);
  const State state = load_state(controller, model, covariance_pattern(controller));
  TraceListener listener(controller, function);
  const Symbols innovations = step::innovations(model, state, load_outputs(controller, model, "y", listener), listener);
  for (int i = 0; i < model.ny; ++i) store(function, element("innovation", i), innovations(i));
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
  load_memory(controller, model, state);
  TraceListener listener(controller, function);
  const Symbols x = step::state_deviations(model.point, load_state_by_hand(controller), listener);
  function.finite = step::set_state(model, state, x, listener).node;
  store_state(controller, function, state, {});
  return function;
}

TracedFunction trace_set_input(const Controller& controller) {
  return trace_step(controller, {}, [&](const Model& model, State& state, TraceListener& listener) {
    if (!controller.has.filter) state.x = step::state_deviations(model.point, state.x, listener);
    const trace::Condition within = step::set_input(model, state, load_input(controller, model, listener), listener);
    if (!controller.has.filter) state.x.resize(0);  // it is only read
    return within;
  });
}

TracedFunction trace_estimate_in_own_units(const Controller& controller) {
  TracedFunction function = new_function(controller);
  function.is_void = true;
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  TraceListener listener(controller, function);
  const Symbols x =
      step::own_state(model.point, step::estimate(model, load_state(controller, model, {}), listener), listener);
  for (int i = 0; i < model.nx; ++i) store(function, element("x", i), x(i));
  return function;
}

TracedFunction trace_covariance(const Controller& controller) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  TraceListener listener(controller, function);
  const std::vector<Expr> P =
      step::covariance(model, load_state(controller, model, covariance_pattern(controller)), listener);
  for (std::size_t k = 0; k < P.size(); ++k) store(function, element("P", static_cast<int>(k)), P[k]);
  function.is_void = true;
  return function;
}

TracedFunction trace_begin_covariance(const Controller& controller) {
  return trace_step(controller, covariance_pattern(controller),
                    [](const Model& model, State& state, TraceListener& listener) {
                      return step::begin_covariance_anew(model, state, listener);
                    });
}

TracedFunction trace_observation(const Controller& controller, int output) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  State state = load_state(controller, model, {});
  TraceListener listener(controller, function);
  const Expr y =
      step::output_deviation(model.point, Expr::of(trace::graph().input("heard", "heard")), output, listener);
  step::observe_alone(model, state, y, trace::is_less(Expr(0), Expr(1)), output, listener);
  store_state(controller, function, state, {});
  return function;
}

TracedFunction trace_lost_outputs(const Controller& controller) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const Model model = symbolic_model(controller);
  TraceListener listener(controller, function);
  for (const trace::Condition& lost :
       step::lost_outputs(model, load(controller, "innovation", "innovation", model.ny, at_output),
                          load_outputs(controller, model, "there", listener), listener))
    function.lost.push_back(lost.node);
  return function;
}

std::vector<TracedFunction> trace_updates_alone(const Controller& controller) {
  const std::vector<bool> pattern = covariance_pattern(controller);
  std::vector<TracedFunction> updates;
  for (int i = 0; i < controller.size.ny && controller.size.ny > 1; ++i)
    if (has_update_alone(controller, i)) updates.push_back(trace_update_alone(controller, pattern, i));
  return updates;
}

TracedController trace_controller(const Controller& controller) {
  TracedController traced;
  if (controller.has.filter) {
    const std::vector<bool> pattern = covariance_pattern(controller);
    traced.update = trace_update(controller, pattern);
    traced.predict = trace_predict(controller, pattern);
    traced.step = trace_sample(controller, pattern);
    traced.updates_alone = trace_updates_alone(controller);
  }
  if (controller.has.regulator) traced.control = trace_regulator(controller);
  return traced;
}

}  // namespace lqg::emit
