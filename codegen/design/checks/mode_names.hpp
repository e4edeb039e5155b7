// SPDX-License-Identifier: MIT
// How messages speak of a mode: its eigenvalue and the states that take part.
#pragma once

#include <string>
#include <vector>

#include "design/numeric/modes.hpp"
#include "design/problem.hpp"

namespace lqg::design {

// "state angle", "states angle, rate"; at most eight of them.
std::string name_states(const Plant& plant, const std::vector<Index>& states);

// "the mode at s = 0.5 (z = 1.05127; states angle, rate)"; `value` is an s or a z.
std::string name_mode(const Plant& plant, const Mode& mode, bool is_continuous);

// z = e^(sT)
ComplexReal sampled_pole(const ComplexReal& s, double sample_time);

// How fast the modes have to be: |z| < 1/alpha, Re s < −rate.
struct Decay {
  Real alpha = 1, rate = 0;
};

Decay decay_per_mode(const Problem& problem);

}  // namespace lqg::design
