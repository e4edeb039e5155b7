// SPDX-License-Identifier: MIT
// NAME_proof.h: NAME.h for a prover that computes with intervals, and what else it has to know.
#pragma once

#include <string>

#include "emit/controller.hpp"

namespace lqg::emit {

// The text of NAME.h, to the letter once RESTATED(test, facts) is read as `test`: facts are what follows from a test
// that passed for each value by itself. Behind the stores of u the prover may forget how they were reached.
std::string proof(const Controller& controller);

}  // namespace lqg::emit
