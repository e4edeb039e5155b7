// SPDX-License-Identifier: MIT
// The numbers of a design file that a person turns: parameters, weights, noises, gates, times, limits, placed poles.
#pragma once

#include <string>
#include <vector>

#include "input/design_file.hpp"

namespace lqg::view {

// A number of the file that follows a slider: it becomes `factor` times the slider's value.
struct Target {
  std::string key;  // "lqr.Q[1]"
  double factor = 1;
};

enum class Scale { linear, logarithmic, whole };

struct Tunable {
  std::string group;            // "Weights of the states, lqr.Q"
  std::string name, unit;       // "speed", "rad/s"; the unit may be empty
  std::vector<Target> targets;  // one; two for the real or the imaginary part of two conjugate poles
  double value = 0;             // as in the file
  double low = 0, high = 0;     // low ≤ value ≤ high; of a logarithmic one 0 < low
  Scale scale = Scale::linear;
  double step = 0;  // linear: of a multiple of it; 0: any value
};

// Those of a file that has a problem, in the order of the file: numbers that stand in it, on the diagonal of what is a
// matrix, and finite. First those that every design has, with their default where they do not stand there: the delay,
// the factor of R.
std::vector<Tunable> tunables(const input::DesignFile& file);

}  // namespace lqg::view
