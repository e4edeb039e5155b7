// SPDX-License-Identifier: MIT
// Regulators and observers whose poles are given: what is asked for, and whether it can be had.
#pragma once

#include "design/equations/placement.hpp"
#include "design/finding.hpp"
#include "design/sampled/samples.hpp"

namespace lqg::design {

struct PlacedGain {
  RealMatrix gain;                 // K, or L in the observer's form: L or L_predictor
  std::vector<ComplexReal> poles;  // all that were wanted, in the z plane
  PlacementChoice choice;
  bool may_want_digits = false;  // of an error
};

// Are there as many poles as states, conjugates in pairs, all stable? Under "pole_placement.poles",
// "observer.continuous_poles" … `of_which` completes "one for each state".
void check_wanted_poles(const WantedPoles& wanted, const std::string& section, Eigen::Index states,
                        const std::string& of_which, Findings& findings);

// K with the poles of A − BK. `choice`, when not null, was made in fewer digits.
PlacedGain place_regulator(const Problem& problem, const SampledPlant& plant, const PlacementChoice* choice,
                           Findings& findings);

// By duality. Filter form: L with the poles of A − LCA, which are those of A − ALC; predictor form: L_predictor
// with the poles of A − L_predictor C. The inputs on their way are known: the gain is one for the plant's own states,
// and the other poles are 0.
PlacedGain place_observer(const Problem& problem, const Samples& samples, const PlacementChoice* choice,
                          Findings& findings);

// The steady filter of such a gain: L and M = 0, or L = 0 and M = L_predictor. It has no covariances.
EstimatorSolution observer_of(const SampledPlant& plant, Form form, const RealMatrix& own_gain);

}  // namespace lqg::design
