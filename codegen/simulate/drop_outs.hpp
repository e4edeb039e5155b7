// SPDX-License-Identifier: MIT
// Does a plain P stay a covariance when sensors fail and come back?
#pragma once

#include <vector>

#include "controller/controller.hpp"
#include "design/finding.hpp"

namespace lqg::simulate {

// The lengths of drop-outs that are tried, in samples.
const std::vector<int>& tried_drop_outs();

// Runs the covariance of a filter with a plain P, in the target's numbers, from the start, and through drop-outs of all
// outputs: an error where it loses its definiteness while all outputs are there, a note where it does when they come
// back after a drop-out. P needs no y: what is found holds for any. Nothing to say of other filters, whose P cannot be
// lost.
void check_drop_outs(const controller::Controller& controller, design::Findings& findings);

}  // namespace lqg::simulate
