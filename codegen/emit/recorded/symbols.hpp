// SPDX-License-Identifier: MIT
// The model and the state of a controller as symbols: numbers of the target, members of self, entries of tables.
#pragma once

#include "emit/recorded/trace_listener.hpp"

namespace lqg::emit {

using SymbolicModel = step::Model<trace::Expr>;
using SymbolicState = step::State<trace::Expr>;

// Something of the operating point is not 0.
bool has_point(const Controller& controller);

// The operating point in the graph in force, its numbers with names.
step::OperatingPoint<trace::Expr> symbolic_point(const Controller& controller);

// In the graph in force. Gains that change from sample to sample are inputs, the rest are numbers.
SymbolicModel symbolic_model(const Controller& controller);

// The same of the outputs as they are, not made uncorrelated: V = E⁻¹ diag(V) E⁻ᵀ.
SymbolicModel model_of_outputs(const Controller& controller);

// With the entries of the covariance that are in `pattern`; no pattern: without it.
SymbolicState load_state(const Controller& controller, const SymbolicModel& model, const std::vector<bool>& pattern);

// All of a state that is neither the estimate nor its covariance.
void load_memory(const Controller& controller, const SymbolicModel& model, SymbolicState& state);

// What the rest of a function has of a state after a recovery that may have written to it.
SymbolicState resume_state(const Controller& controller, const SymbolicState& state, const std::vector<bool>& pattern);

// `pattern` is empty: without the covariance.
void store_state(const Controller& controller, TracedFunction& function, const SymbolicState& state,
                 const std::vector<bool>& pattern);

}  // namespace lqg::emit
