// SPDX-License-Identifier: MIT
// Margins of the channels, one opened at a time with the others closed: where t = T_ii stands at a limit.
#pragma once

#include <functional>
#include <optional>

#include "design/loop/margin_search.hpp"

namespace lqg::design {

using Channel = std::function<ComplexReal(const Real&)>;  // t at an angle
using Channels = std::function<Channel(Index)>;           // makes that of channel i

// The least of all channels; empty where none has such a place.
struct ChannelMargins {
  std::optional<Real> gain_dB, gain_up_dB, gain_down_dB, phase_deg, delay_samples;
  std::optional<Real> crossover;  // the angle at which the least phase margin is
  bool as_expected = true;        // what the search saw of gain and phase is what the refined places have
};

// Searched in the grid and by `roughly`; places that may be the least ones are refined by `exactly`.
ChannelMargins channel_margins(const Search& search, const Channels& roughly, const Channels& exactly,
                               const Fineness& fineness);

}  // namespace lqg::design
