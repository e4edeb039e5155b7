// SPDX-License-Identifier: MIT
// All calls of a sample as one function: the state stays in registers between them, and each is loaded and stored once.
#include "controller/bounds.hpp"
#include "emit/recorded/symbols.hpp"
#include "step/loop.hpp"
#include "step/operating_point.hpp"

namespace lqg::emit {

namespace {

using trace::Expr;
using Model = SymbolicModel;
using State = SymbolicState;

class Sample {
 public:
  Sample(const Controller& controller, const std::vector<bool>& pattern)
      : controller_(controller), pattern_(pattern), function_(new_function(controller)),
        listener_(controller, function_) {}

  TracedFunction trace() {
    const trace::Recording recording(*function_.graph);
    Model model = symbolic_model(controller_);
    State state = load_state(controller_, model, pattern_);
    const Symbols y = step::output_deviations(model.point, load(controller_, "y", "y", model.ny, at_output), listener_);
    const bool acts = controller_.has.regulator;
    Symbols u;
    if (acts && controller_.is_predictor) u = control(model, state);
    const int sound = step::update(model, state, y, listener_).node;
    recover_unless(sound, state);
    // Gains of tables, too, may be others after a reset.
    model = symbolic_model(controller_);
    state = resume_state(controller_, state, pattern_);
    if (acts && !controller_.is_predictor) {
      model.has_finite_law = has_finite_law(controller_);
      u = control(model, state);
    }
    if (!acts) u = load(controller_, "u", "u", model.nu, at_input);
    u = step::input_deviations(model.point, u, listener_);
    function_.finite = step::predict(model, state, u, listener_).node;
    function_.checks_covariance = !pattern_.empty();
    store_state(controller_, function_, state, pattern_);
    return std::move(function_);
  }

 private:
  Symbols control(const Model& model, State& state) {
    const Symbols u = step::own_input(model.point, step::control(model, state, listener_), listener_);
    for (int i = 0; i < model.nu; ++i) store(function_, element("u", i), u(i));
    return u;
  }

  // What was found so far belongs to the part before the recovery. A reset needs nothing of it: it begins anew.
  void recover_unless(int sound, State& state) {
    TracedRecovery before;
    before.stores = std::move(function_.stores);
    before.statuses = std::move(function_.statuses);
    before.finite = sound;
    before.faults = std::move(function_.faults);
    function_.stores.clear(), function_.statuses.clear(), function_.faults.clear();
    if (!pattern_.empty()) {
      store_state(controller_, function_, state, {});
      before.recovers = std::move(function_.stores);
      function_.stores.clear();
    }
    function_.before = std::move(before);
    function_.graph->begin_rest();
  }

  const Controller& controller_;
  const std::vector<bool>& pattern_;
  TracedFunction function_;
  TraceListener listener_;
};

}  // namespace

TracedFunction trace_sample(const Controller& controller, const std::vector<bool>& pattern) {
  return Sample(controller, pattern).trace();
}

}  // namespace lqg::emit
