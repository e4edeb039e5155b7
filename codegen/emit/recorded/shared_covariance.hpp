// SPDX-License-Identifier: MIT
// The steps of a filter that carries P, recorded so that its outputs share the code that runs over P: what is done for
// each output, and for each column of P, is a function of its own.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "emit/recorded/traced.hpp"

namespace lqg::emit {

// The filter has this form: P as it is, noises that are uncorrelated, one plant.
bool can_share_covariance(const Controller& controller);

// A P Aᵀ is predicted column by column, in loops.
bool loops_over_columns(const Controller& controller);

// Output i is one of the states: which; else nothing.
std::optional<int> measured_state(const Controller& controller, int output);

// Rows of A that are multiplied in one function: from first to before end.
std::vector<std::pair<int, int>> blocks_of_rows(const Controller& controller);

// P Cᵀ of output i comes from the function for any c, or from that for any column of P; it does of some output.
bool is_projected(const Controller& controller, int output);
bool is_column(const Controller& controller, int output);
bool projects(const Controller& controller);
bool takes_columns(const Controller& controller);

// cov[] = P cᵀ of any c[].
TracedFunction trace_projection(const Controller& controller);

// What output i tells: *reciprocal of its S, *innovation, and cov[] = P Cᵀ, where that is not there already.
TracedFunction trace_use(const Controller& controller, int output);

// x̂ ← x̂ + L innovation, P ← P − L cov[]ᵀ, L = cov[] reciprocal
TracedFunction trace_correction(const Controller& controller);

// x̂ is within its bounds after an update.
TracedFunction trace_end_of_update(const Controller& controller);

// product[i stride] = start[i] + A_i v for the rows from `first` to before `end`, A freed of what the outputs tell of
// w.
TracedFunction trace_rows(const Controller& controller, int first, int end);

// x̂ ← A x̂ + B u, and the check of x̂ and of a P that has been predicted.
TracedFunction trace_end_of_predict(const Controller& controller);

}  // namespace lqg::emit
