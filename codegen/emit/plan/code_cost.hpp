// SPDX-License-Identifier: MIT
// What the emitted code costs the target.
#pragma once

#include "emit/controller.hpp"

namespace lqg::emit {

CodeCost cost_of_unrolled(const Controller& controller);
CodeCost cost_of_linear_form(const Controller& controller);  // of controller.linear
// Straight-line code that shares what `controller.sharing` says.
CodeCost cost_of_shared(const Controller& controller);
// With a constant gain whose products with dense matrices are loops.
CodeCost cost_of_products(const Controller& controller);
CodeCost cost_of_compact(const Controller& controller);

}  // namespace lqg::emit
