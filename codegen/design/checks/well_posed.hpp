// SPDX-License-Identifier: MIT
// Is the problem well posed? Each finding names the key and, for a mode, its eigenvalue and the states that
// take part.
#pragma once

#include "design/equations/riccati.hpp"
#include "design/finding.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/problem.hpp"
#include "design/sampled/samples.hpp"

namespace lqg::design {

// Is the design one that the plant's domain allows; are weights and covariances symmetric, and
// (semi)definite?
void check_kinds(const Problem& problem, Findings& findings);
void check_symmetry(const Problem& problem, Findings& findings);
void check_definiteness(const Problem& problem, Findings& findings);

// Stabilisable and detectable? Of a continuous plant that is asked of the continuous plant, whose numbers are
// exact, and then whether sampling has lost it. `sampled` is the plant without a delay. With a decay the modes must be
// as fast as that asks for. False when the digits in force do not tell how many modes are reached or seen.
bool check_stabilisable(const Problem& problem, const SampledPlant& sampled, Findings& findings);
bool check_detectable(const Problem& problem, const SampledPlant& sampled, Findings& findings);

// Are the disturbances of the filter's problem told from each other and from the plant's modes? The plant without them
// is detectable. False as above.
bool check_disturbances(const Problem& filtered, Findings& findings);

// The same of every mode, stable or not: poles are to be placed. `seen` is what of the state an observer's error
// shows: C, or CA in filter form.
bool check_reachable(const Problem& problem, const SampledPlant& sampled, Findings& findings);
bool check_observable(const Problem& problem, const SampledPlant& sampled, const RealMatrix& seen, Findings& findings);

// A mode on the stability limit that carries no weight, or that no process noise drives, has no stabilising
// solution. `equation` is the one that the gain solves.
void check_weights_on_limit(const Problem& problem, const RiccatiEquation& equation, Findings& findings);
void check_noise_on_limit(const Problem& problem, const Samples& samples, Findings& findings);

// An unstable mode that no process noise drives is uncertain for ever only when it is so at the start: with P0 = 0 of
// it the gains tend to others than the steady ones.
void check_start(const Problem& problem, const Samples& samples, Findings& findings);

}  // namespace lqg::design
