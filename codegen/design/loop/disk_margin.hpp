// SPDX-License-Identifier: MIT
// How far all channels at once may be disturbed.
#pragma once

#include "design/loop/channel_margins.hpp"
#include "design/loop/margin_search.hpp"

namespace lqg::design {

struct DiskMargin {
  Real least;               // 1/max μ(I/2 − T) over the circle
  bool as_expected = true;  // of one channel: where the search saw a minimum the refined evaluation has one
};

// Of one channel refined by `channel_of` in all digits of `fineness`. Of several searched in double, and taken from
// `evaluate` where it is least: with more than 8 the time is that of some hundred decompositions, and the margin may be
// 1 % less than it is.
DiskMargin disk_margin(const Search& search, const Channels& channel_of, const Evaluate& evaluate,
                       const Fineness& fineness);

}  // namespace lqg::design
