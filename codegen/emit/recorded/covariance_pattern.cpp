// SPDX-License-Identifier: MIT
// Which entries of a covariance are ever different from 0.
#include "emit/recorded/symbols.hpp"
#include "step/loop.hpp"

namespace lqg::emit {

namespace {

using trace::Expr;

std::vector<bool> initial_pattern(const Controller& controller) {
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  const SymbolicModel model = symbolic_model(controller);
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
  const SymbolicModel model = symbolic_model(controller);
  SymbolicState state = load_state(controller, model, pattern);
  TraceListener listener(controller, function);
  if (predicts)
    step::predict(model, state, load(controller, "u", "u", model.nu, at_input), listener);
  else
    step::update(model, state, load(controller, "y", "y", model.ny, at_output), listener);
  for (std::size_t k = 0; k < pattern.size(); ++k) {
    const Expr& entry = !state.P.empty() ? state.P[k] : k < state.U.size() ? state.U[k] : state.D[k - state.U.size()];
    if (!trace::is_zero(entry)) pattern[k] = true;
  }
}

}  // namespace

std::vector<bool> covariance_pattern(const Controller& controller) {
  std::vector<bool> pattern = initial_pattern(controller), before;
  while (pattern != before && !pattern.empty()) {  // it can only grow
    before = pattern;
    grow(pattern, controller, true);
    grow(pattern, controller, false);
  }
  return pattern;
}

}  // namespace lqg::emit
