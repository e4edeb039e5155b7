// SPDX-License-Identifier: MIT
// How far the closed loop is from instability, at the plant's inputs or outputs.
#pragma once

#include "design/loop/open_loop.hpp"
#include "design/solution.hpp"

namespace lqg::design {

// With T = L(I + L)⁻¹, which has the closed loop's poles, and t = T_ii (the other channels' loops closed):
//   gain   where t is real and < 0 or > 1: the factor 1 − 1/t makes the loop oscillate
//   phase  where Re t = 1/2, the loop's gain is 1: the angle 2 atan(1/|2 Im t|) makes it oscillate
//   delay  likewise: what turns the loop back to −1 there, over the angle that a sample is there
//   disk   1/max μ((S − T)/2) = 1/max μ(I/2 − T), all channels disturbed at once, each in its own way
// The least of all channels; searched on a grid that follows the poles, refined to the exact place in many
// digits; the disk of several channels has six. Empty where there is no such place.
Margins margins(const OpenLoop& loop, const std::vector<ComplexReal>& closed_loop_poles);

// The same in double, to six digits: a tenth of the time.
Margins rough_margins(const OpenLoop& loop, const std::vector<ComplexReal>& closed_loop_poles);

}  // namespace lqg::design
