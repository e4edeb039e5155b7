// SPDX-License-Identifier: MIT
// The loop, opened at the plant's inputs, over frequency.
#pragma once

#include <complex>
#include <functional>
#include <optional>
#include <vector>

#include "emit/controller.hpp"

namespace lqg::emit {

using Complex = std::complex<double>;

// One loop: L at rising angles in rad a sample, up to π. Of several inputs that of one of them, the others closed.
struct LoopCurve {
  std::vector<double> angles;
  std::vector<Complex> L;
  std::function<Complex(double)> at;  // between them
};

struct LoopResponse {
  double sample_time = 0;
  std::vector<LoopCurve> loops;                       // input by input
  std::vector<double> angles;                         // of what follows
  std::vector<std::vector<double>> of_L, of_S, of_T;  // singular values, falling, at each angle; with several inputs
};

// Empty for designs without a regulator, and where the loop has no steady margins because its gains change to the end.
std::optional<LoopResponse> loop_response(const Controller& controller);

// Where a real function of the angle changes its sign, between neighbouring angles.
std::vector<double> places(const LoopCurve& loop, const std::function<double(Complex)>& function);

inline double decibels(double gain) { return 20 * std::log10(gain); }
inline double hertz(double angle, double sample_time) { return angle / (2 * std::acos(-1.0) * sample_time); }

}  // namespace lqg::emit
