// SPDX-License-Identifier: MIT
#include "design/loop/margin_search.hpp"

#include <algorithm>

#include "design/progress.hpp"

namespace lqg::design {

Real pi() { return atan(Real(1)) * 4; }

std::vector<Real> search_angles(const std::vector<ComplexReal>& poles) {
  std::vector<Real> angles;
  const Real end = pi();
  Real slowest = Real(1) / 8, fastest = Real(1) / 8;
  for (const ComplexReal& pole : poles) {
    if (pole.im < 0) continue;
    const Real angle = atan2(pole.im, pole.re), width = 1 - hypot(pole.re, pole.im);
    for (const double step : {-8., -4., -2., -1., -0.5, -0.25, 0., 0.25, 0.5, 1., 2., 4., 8.})
      angles.push_back(angle + step * width);
    slowest = std::min<Real>(slowest, hypot(pole.re - 1, pole.im));
    fastest = std::min<Real>(fastest, hypot(pole.re + 1, pole.im));
  }
  const Real ratio = pow(Real(2), Real(1) / 8);
  for (Real angle = slowest / 4096; angle < end / 2; angle *= ratio) angles.push_back(angle);
  for (Real angle = fastest / 4096; angle < end / 2; angle *= ratio) angles.push_back(end - angle);
  angles.erase(std::remove_if(angles.begin(), angles.end(), [&](const Real& x) { return !(x > 0 && x < end); }),
               angles.end());
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());  // repeated poles
  return angles;
}

std::vector<Real> without_near_ones(std::vector<Real> angles) {
  const auto near = [](const Real& a, const Real& b) { return b - a < 1e-12 * b; };
  angles.erase(std::unique(angles.begin(), angles.end(), near), angles.end());
  return angles;
}

Search search_with(const Evaluate& evaluate, const std::vector<Real>& angles) {
  Search search = {evaluate, angles, {}};
  for (const Real& angle : angles) {
    report_progress("margins, search", static_cast<long>(search.responses.size()), static_cast<long>(angles.size()));
    search.responses.push_back(evaluate(angle));
  }
  return search;
}

Real root_between(const Function& f, Real low, Real high, const Real& fraction) {
  Real before = low, x = high, at_before = f(low), at_x = f(high);
  const bool low_is_negative = at_before < 0;
  const Real shortest = fraction * (high - low);
  for (int i = 0; i < 200 && abs(x - before) > shortest && !at_x.is_zero(); ++i) {
    Real next = x - at_x * (x - before) / (at_x - at_before);
    if (!(next > low && next < high)) next = (low + high) / 2;
    before = x;
    at_before = at_x;
    x = next;
    at_x = f(x);
    ((at_x < 0) == low_is_negative ? low : high) = x;
  }
  return x;
}

Function slope_of(const Function& f, const Real& step) {
  return [f, step](const Real& x) { return Real(f(x + step) - f(x - step)); };
}

}  // namespace lqg::design
