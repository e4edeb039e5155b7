// SPDX-License-Identifier: MIT
// Does a design hang on the rounding of the file's numbers? Exactly taken, a plant that was sampled or turned in
// floating point has no unreachable mode and no zero at z = 1: both are a rounding away, and a gain of 1e15 is what
// comes of it.
//
// A property counts as an artefact where it is gone when every number of the file moves by a few hundred units in its
// last place: what a program's own roundings come to. That does not depend on units, and a 0 of the file stays 0. Each
// of these asks what its exact counterpart in well_posed.hpp or augmentation.hpp asks, of the numbers of the file, and
// adds an error that says how far the numbers have to move.
#pragma once

#include "design/finding.hpp"
#include "design/problem.hpp"

namespace lqg::design {

// Modes that have to be stabilised, made as fast as the decay asks for, or detected.
void check_reach_is_no_artefact(const Problem& problem, Findings& findings);
void check_sight_is_no_artefact(const Problem& problem, Findings& findings);

// Every mode: poles are to be placed. With a filter form of a discrete plant they are seen through CA.
void check_placement_is_no_artefact(const Problem& problem, Findings& findings);
void check_observer_is_no_artefact(const Problem& problem, Findings& findings);

// Constant inputs that hold the outputs anywhere.
void check_set_points_are_no_artefact(const Problem& problem, const std::vector<int>& outputs, const std::string& key,
                                      Findings& findings);

// A mode that is on the stability limit, or beside it by rounding, and carries no weight or noise, or only by rounding.
// With N or shared noise that is asked where file and equation are of one time: a discrete plant's samples, or a
// continuous plant with the continuous cost. Elsewhere the exact checks stand alone.
void check_weights_are_no_artefact(const Problem& problem, Findings& findings);
void check_noise_is_no_artefact(const Problem& problem, Findings& findings);

}  // namespace lqg::design
