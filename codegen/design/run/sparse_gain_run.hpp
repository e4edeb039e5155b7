// SPDX-License-Identifier: MIT
// The gains of a design that keeps only some of their entries.
#pragma once

#include "design/run/design_run.hpp"
#include "design/sampled/samples.hpp"

namespace lqg::design {

// Errors for what cannot have a structure: a gain that is a table, placed, continuous or carried on line; a structure
// that keeps nothing.
void check_structure(const Problem& problem, Findings& findings);

// In the place of the full gain in `result`, whose poles are there: the gain that keeps [lqr] structure, and of the
// inputs on their way, integrals and last inputs all entries. It is best for the covariance of the sampled process
// noise when that reaches every state of the full loop, else for E x₀x₀ᵀ = I.
void keep_regulator_structure(const Problem& problem, const Samples& samples, const DesignRun* coarser,
                              DesignRun& result);

// Filter form: the entries of L, best for the posterior covariance; predictor form: those of L_predictor (then L = 0
// and M = L_predictor), best for the prior one. In both the sum of the variances, each in units of the full filter's.
void keep_estimator_structure(const Problem& problem, const Samples& samples, const DesignRun* coarser,
                              DesignRun& result);

// The margins of the loop with the full gain in the place of the structured one; `run` is settled.
void add_full_margins(const Problem& problem, DesignRun& run);

}  // namespace lqg::design
