// SPDX-License-Identifier: MIT
// By the nearest of 65 angles k π/64, whose cosine and sine are in a table, and series for the small rest of the angle;
// with sums of two doubles: T. J. Dekker, "A floating-point technique for extending the available precision",
// Numerische Mathematik 18 (1971), 224–242.
#include "design/numeric/on_circle.hpp"

#include <cmath>
#include <vector>

#include "design/numeric/digits.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

// high + low, |low| at most half of a last place of high.
struct Sum {
  double high, low;
};

// a + b where |a| ≥ |b|, or a = 0.
Sum sum_of_ordered(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

Sum operator+(const Sum& a, const Sum& b) {
  const double high = a.high + b.high, part = high - a.high;
  const double low = (a.high - (high - part)) + (b.high - part);
  return sum_of_ordered(high, low + (a.low + b.low));
}

Sum operator-(const Sum& a) { return {-a.high, -a.low}; }

// a in two halves, whose products are exact.
Sum halves(double a) {
  const double c = 134217729 * a;  // 2^27 + 1
  const double high = c - (c - a);
  return {high, a - high};
}

Sum operator*(const Sum& a, const Sum& b) {
  const double high = a.high * b.high;
  const Sum x = halves(a.high), y = halves(b.high);
  const double low = ((x.high * y.high - high) + x.high * y.low + x.low * y.high) + x.low * y.low;
  return sum_of_ordered(high, low + (a.high * b.low + a.low * b.high));
}

Sum as_sum(const Real& value) {
  const double high = to_double(value);
  return {high, to_double(value - high)};
}

// 1/3!, 1/5!, … and 1/2!, 1/4!, …; from the fourth on a double is enough beside the sum.
constexpr Sum third = {0x1.5555555555555p-3, 0x1.5555555555555p-57},
              fifth = {0x1.1111111111111p-7, 0x1.1111111111111p-63},
              seventh = {0x1.a01a01a01a01ap-13, 0x1.a01a01a01a01ap-73}, second = {0.5, 0},
              fourth = {0x1.5555555555555p-5, 0x1.5555555555555p-59},
              sixth = {0x1.6c16c16c16c17p-10, -0x1.f49f49f49f49fp-65};

struct Point {
  Sum cosine, sine;
};

// Of |angle| ≤ π/128.
Point by_series(const Sum& angle) {
  const Sum s = -(angle * angle);
  const double t = s.high;
  const double end_of_sine = t * (1 / 362880. + t * (1 / 39916800. + t * (1 / 6227020800. + t / 1307674368000.)));
  const double end_of_cosine = t * (1 / 40320. + t * (1 / 3628800. + t * (1 / 479001600. + t / 87178291200.)));
  const Sum sine = third + s * (fifth + s * (seventh + Sum{end_of_sine, 0}));
  const Sum cosine = second + s * (fourth + s * (sixth + Sum{end_of_cosine, 0}));
  return {Sum{1, 0} + s * cosine, angle + angle * (s * sine)};
}

struct Node {
  Real angle;
  Point point;
};

constexpr int parts = 64;

std::vector<Node> made_nodes() {
  const Digits enough(60);
  const Real step = atan(Real(1)) * 4 / parts;
  std::vector<Node> nodes;
  for (int k = 0; k <= parts; ++k) {
    const Real angle = k * step;
    nodes.push_back({angle, {as_sum(cos(angle)), as_sum(sin(angle))}});
  }
  return nodes;
}

}  // namespace

std::complex<double> on_circle(const Real& angle) {
  static const std::vector<Node> nodes = made_nodes();
  const double place = to_double(angle) * (parts / 3.14159265358979323846);
  if (!(place >= 0 && place <= parts)) return {to_double(cos(angle)), to_double(sin(angle))};
  const Node& node = nodes[static_cast<std::size_t>(std::lround(place))];
  const Point rest = by_series(as_sum(angle - node.angle));
  const Sum cosine = node.point.cosine * rest.cosine + -(node.point.sine * rest.sine);
  const Sum sine = node.point.sine * rest.cosine + node.point.cosine * rest.sine;
  return {cosine.high + cosine.low, sine.high + sine.low};
}

}  // namespace lqg::design
