// SPDX-License-Identifier: MIT
// The step of a controller that keeps z, recorded.
#pragma once

#include "emit/recorded/traced.hpp"

namespace lqg::emit {

struct TracedLinear {
  TracedFunction control;        // of a sample in which all is finite …
  TracedFunction control_fault;  // … and of any; in filter form of the y that the other one has stored
  TracedFunction advance;        // with outputs that are finite
  TracedFunction hear;           // predictor form: heard[] of y[]
  TracedFunction step;           // of a sample in which all is finite: control and advance
  TracedFunction estimate, set_state;
};

TracedLinear trace_linear(const Controller& controller);

}  // namespace lqg::emit
