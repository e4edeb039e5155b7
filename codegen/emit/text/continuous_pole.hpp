// SPDX-License-Identifier: MIT
// A pole of samples as people know it from the s plane.
#pragma once

#include <cmath>
#include <complex>
#include <optional>

namespace lqg::emit {

struct ContinuousPole {
  std::complex<double> s;  // rad/s
  double damping;          // −Re s / |s|
};

// s = ln(z)/T; empty at z = 0, which has none, and at z = 1, which has no damping.
inline std::optional<ContinuousPole> continuous_pole(const std::complex<double>& z, double sample_time) {
  if (std::abs(z) < 1e-12) return std::nullopt;
  const std::complex<double> s = std::log(z) / sample_time;
  if (std::abs(s) == 0) return std::nullopt;
  return ContinuousPole{s, -s.real() / std::abs(s)};
}

}  // namespace lqg::emit
