// SPDX-License-Identifier: MIT
#include "emit/recorded/linear_traced.hpp"

#include <utility>

#include "controller/linear_model_of.hpp"
#include "emit/recorded/symbols.hpp"
#include "step/operating_point.hpp"

namespace lqg::emit {

namespace {

using trace::Expr;
using Function = TracedFunction;
using Model = step::LinearModel<Expr>;
using State = step::LinearState<Expr>;

void store_all(TracedFunction& function, const std::string& array, const Symbols& values) {
  for (int i = 0; i < values.size(); ++i) store(function, element(array, i), values(i));
}

// Runs `step(function, model, state, listener)` on a fresh graph. state.y is what self->y holds, where that `hears` it.
template <class Step>
TracedFunction trace_step(const Controller& controller, bool hears, Step step) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  Model model = controller::linear_model_of<Expr>(controller, [&](const design::Real& value) {
    return Expr(rounded_to_target(value, controller.target.is_double));
  });
  model.point = symbolic_point(controller);
  State state{load(controller, "self->z", "z", controller.size.nz, at_entry),
              load(controller, "self->y", "y", hears ? controller.size.ny : 0, at_output)};
  TraceListener listener(controller, function);
  step(function, model, state, listener);
  return function;
}

// In filter form control keeps y for advance.
bool keeps_outputs(const Controller& controller) { return !controller.is_predictor; }

// y of the caller as a deviation from the operating point.
Symbols load_outputs(const Controller& controller, const Model& model, TraceListener& listener) {
  return step::output_deviations(model.point, load(controller, "y", "y", controller.size.ny, at_output), listener);
}

TracedFunction trace_control(const Controller& controller) {
  const auto step = [&](Function& into, const Model& model, State& state, TraceListener& listener) {
    const Symbols y = controller.is_predictor ? Symbols() : load_outputs(controller, model, listener);
    Symbols u;
    into.finite = step::control_expected(model, state, y, u, listener).node;
    store_all(into, "u", step::own_input(model.point, u, listener));
    store_all(into, "self->y", state.y);
  };
  TracedFunction function = trace_step(controller, false, step);
  function.recovery = controller.problem.name + "_control_fault(self, u)";
  return function;
}

TracedFunction trace_control_fault(const Controller& controller) {
  return trace_step(controller, keeps_outputs(controller),
                    [](Function& into, const Model& model, State& state, TraceListener& listener) {
                      const Symbols u = step::control(model, state, state.y, listener);
                      store_all(into, "self->y", state.y);
                      store_all(into, "u", step::own_input(model.point, u, listener));
                    });
}

TracedFunction trace_advance(const Controller& controller) {
  return trace_step(controller, keeps_outputs(controller),
                    [&](Function& into, const Model& model, State& state, TraceListener& listener) {
                      // NAME_move is called with deviations.
                      const Symbols y =
                          controller.is_predictor ? load(controller, "y", "y", controller.size.ny, at_output) : state.y;
                      into.finite = step::advance(model, state, y, listener).node;
                      store_all(into, "self->z", state.z);
                    });
}

// Control and advance as one, where all is finite.
TracedFunction trace_linear_sample(const Controller& controller) {
  TracedFunction function =
      trace_step(controller, false, [&](Function& into, const Model& model, State& state, TraceListener& listener) {
        Symbols u;
        const Symbols y = load_outputs(controller, model, listener);
        into.finite = step::sample_expected(model, state, y, u, listener).node;
        store_all(into, "u", step::own_input(model.point, u, listener));
        store_all(into, "self->y", state.y);
        std::vector<trace::Store> stores = std::move(into.stores);
        into.stores.clear();
        store_all(into, "self->z", state.z);
        into.stores_if_sound = std::exchange(into.stores, std::move(stores));
      });
  function.recovery =
      controller.problem.name + (keeps_outputs(controller) ? "_step_fault(self, u)" : "_step_fault(self, y, u)");
  return function;
}

TracedFunction trace_hear(const Controller& controller) {
  return trace_step(controller, false, [&](Function& into, const Model& model, State& state, TraceListener& listener) {
    const Symbols y = load_outputs(controller, model, listener);
    store_all(into, "heard", step::heard_outputs(model, state, y, listener));
  });
}

TracedFunction trace_estimate(const Controller& controller) {
  return trace_step(controller, keeps_outputs(controller),
                    [](Function& into, const Model& model, State& state, TraceListener& listener) {
                      into.is_void = true;
                      const Symbols x = step::estimate(model, state, listener);
                      store_all(into, "x", step::own_state(model.point, x, listener));
                    });
}

TracedFunction trace_set_z(const Controller& controller) {
  return trace_step(controller, false, [&](Function& into, const Model& model, State& state, TraceListener& listener) {
    const Symbols x =
        step::state_deviations(model.point, load(controller, "x", "x", controller.size.nx, at_state), listener);
    into.finite = step::set_state(model, state, x, listener).node;
    store_all(into, "self->z", state.z);
  });
}

}  // namespace

TracedLinear trace_linear(const Controller& controller) {
  TracedLinear traced;
  traced.control = trace_control(controller);
  traced.control_fault = trace_control_fault(controller);
  traced.advance = trace_advance(controller);
  traced.step = trace_linear_sample(controller);
  if (controller.is_predictor) traced.hear = trace_hear(controller);
  traced.estimate = trace_estimate(controller);
  traced.set_state = trace_set_z(controller);
  return traced;
}

}  // namespace lqg::emit
