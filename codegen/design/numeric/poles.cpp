// SPDX-License-Identifier: MIT
#include "design/numeric/poles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "design/rounding.hpp"

namespace lqg::design {

Poles sorted_poles(const std::vector<ComplexReal>& values) {
  Poles poles;
  for (const ComplexReal& value : values)  // + 0: no −0
    poles.emplace_back(to_double(value.re) + 0.0, to_double(value.im) + 0.0);
  const auto size = [](const std::complex<double>& z) { return z.real() * z.real() + z.imag() * z.imag(); };
  std::stable_sort(poles.begin(), poles.end(), [&](const std::complex<double>& a, const std::complex<double>& b) {
    if (size(a) != size(b)) return size(a) > size(b);
    return a.imag() != b.imag() ? a.imag() > b.imag() : a.real() > b.real();
  });
  return poles;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string short_complex(const ComplexReal& value, const Real& scale) {
  const Real size = std::max<Real>(hypot(value.re, value.im), scale) * 1e-14;
  const double re = abs(value.re) <= size ? 0 : to_double(value.re);
  const double im = abs(value.im) <= size ? 0 : std::abs(to_double(value.im));  // ± says both signs
  if (im == 0) return short_number(re);
  return (re == 0 ? "±" : short_number(re) + " ± ") + short_number(im) + "j";
}

}  // namespace lqg::design
