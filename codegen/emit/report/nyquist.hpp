// SPDX-License-Identifier: MIT
// One loop in the complex plane.
#pragma once

#include "emit/report/loop_response.hpp"
#include "emit/text/chart.hpp"

namespace lqg::emit {

// About −1, with the circle that the disk margin keeps free, and the whole of it where that is larger.
std::vector<Chart> nyquist(const LoopCurve& loop, double sample_time, const std::optional<double>& disk,
                           const std::string& id);

}  // namespace lqg::emit
