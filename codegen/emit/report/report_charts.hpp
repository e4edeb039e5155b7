// SPDX-License-Identifier: MIT
// What the report draws of a design.
#pragma once

#include <vector>

#include "emit/controller.hpp"
#include "emit/text/chart.hpp"

namespace lqg::emit {

// Whose poles a person wants to see: regulator and estimator, whose poles are those of the loop, else the loop itself.
struct NamedPoles {
  const char* owner;
  const design::Poles* poles;
};
std::vector<NamedPoles> poles_to_show(const Controller& controller);

// These in the z plane.
Chart pole_chart(const Controller& controller);

// The loop opened at its one input, on the unit circle, and the circle about −1 that it leaves free. None for loops of
// several inputs, or that change with time.
std::vector<Chart> nyquist_charts(const Controller& controller);

// The sampled plant in double with the controller's gains, from the state that one sample of a small input leaves; no
// noise.
struct Kick {
  std::string words;  // "u = 0.1 N for one sample"
  std::vector<Chart> charts;
};
Kick kick_charts(const Controller& controller);

// The same with the noises of the design and, where outputs follow a reference, r = 1.
std::vector<Chart> noisy_charts(const Controller& controller);

}  // namespace lqg::emit
