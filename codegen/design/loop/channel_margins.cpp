// SPDX-License-Identifier: MIT
#include "design/loop/channel_margins.hpp"

#include <algorithm>
#include <limits>

#include "design/progress.hpp"

namespace lqg::design {

namespace {

using Value = Real (*)(const ComplexReal& t);
using Margin = Real (*)(const ComplexReal& t, const Real& angle);

const double none = std::numeric_limits<double>::infinity();

Real imaginary(const ComplexReal& t) { return t.im; }
Real from_half(const ComplexReal& t) { return Real(t.re - 0.5); }

// 20 log10(1 − 1/t): the factor that makes the loop oscillate. Infinite where a real t asks for no positive one.
Real gain_factor_dB(const ComplexReal& t) {
  const Real rounding = 1e-20;
  return t.re < -rounding || t.re > 1 + rounding ? Real(20 * log10(1 - 1 / t.re)) : Real(none);
}

Real gain_margin(const ComplexReal& t, const Real&) { return abs(gain_factor_dB(t)); }

Real gain_margin_up(const ComplexReal& t, const Real&) {
  const Real dB = gain_factor_dB(t);
  return dB > 0 ? dB : Real(none);
}

Real gain_margin_down(const ComplexReal& t, const Real&) {
  const Real dB = gain_factor_dB(t);
  return dB < 0 ? Real(-dB) : Real(none);
}

Real phase_margin(const ComplexReal& t, const Real&) { return 2 * atan2(Real(1), 2 * abs(t.im)) * 180 / pi(); }

// With t = 1/2 + j Im t, L = t/(1 − t) = e^(jα), α = 2 atan(2 Im t): a delay has to turn it back by α + π to −1.
Real delay_margin(const ComplexReal& t, const Real& angle) { return (2 * atan(2 * t.im) + pi()) / angle; }

// A cell of the grid with one root in it; where that is, roughly.
struct Place {
  Index channel;
  Real low, high, angle;
  ComplexReal t;
};

struct Point {
  Real angle;
  ComplexReal t;
};

ComplexReal entry(const Eigen::MatrixXcd& T, Index channel) {
  return {Real(T(channel, channel).real()), Real(T(channel, channel).imag())};
}

// Where `value` of a channel crosses zero: between neighbours of different sign, and on both sides of a dip that passes
// zero unseen.
void add_crossings(const Search& search, const Channel& t_at, Index channel, Value value, std::vector<Place>& places) {
  std::vector<Real> values;
  for (const Eigen::MatrixXcd& T : search.responses) values.push_back(value(entry(T, channel)));
  const Function f = [&](const Real& angle) { return value(t_at(angle)); };
  const auto add = [&](const Real& low, const Real& high) {
    const Real root = root_between(f, low, high, rough.end_of_root);
    places.push_back({channel, low, high, root, t_at(root)});
  };
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const Real &low = search.angles[i], &high = search.angles[i + 1];
    if ((values[i] < 0) != (values[i + 1] < 0)) {
      add(low, high);
      continue;
    }
    const bool dips = i > 0 && i + 2 < values.size() && abs(values[i]) < abs(values[i - 1]) &&
                      abs(values[i + 1]) < abs(values[i + 2]);
    const Function slope = slope_of(f, rough.step * (high - low));
    if (!dips || (slope(low) < 0) == (slope(high) < 0)) continue;
    const Real bottom = root_between(slope, low, high, rough.end_of_extremum);
    if ((f(bottom) < 0) == (values[i] < 0)) continue;
    add(low, bottom);
    add(bottom, high);
  }
}

// The root of f at a place, in all digits: first looked for next to where it was found roughly.
std::optional<Real> root_near(const Function& f, const Place& place, const Fineness& fineness) {
  for (const double share : {1e-5, 1.0}) {
    const Real reach = share * (place.high - place.low);
    const Real low = std::max<Real>(place.low, place.angle - reach),
               high = std::min<Real>(place.high, place.angle + reach);
    if ((f(low) < 0) != (f(high) < 0)) return root_between(f, low, high, fineness.end_of_root);
  }
  return std::nullopt;
}

struct Least {
  std::optional<Real> margin, angle;
  bool as_expected = true;
};

// All crossings of one value. Each is refined once, when a margin first asks for it.
class Crossings {
 public:
  Crossings(const Search& search, const Channels& roughly, const Channels& exactly, const Fineness& fineness,
            Value value)
      : exactly_(exactly), fineness_(fineness), value_(value) {
    for (Index channel = 0; channel < search.responses.front().rows(); ++channel)
      add_crossings(search, roughly(channel), channel, value, places_);
    refined_.resize(places_.size());
    is_refined_.resize(places_.size());
  }

  Least least(Margin margin) {
    Least result;
    std::vector<Real> rough_margins;
    for (const Place& place : places_) rough_margins.push_back(margin(place.t, place.angle));
    if (places_.empty()) return result;
    const Real bound = *std::min_element(rough_margins.begin(), rough_margins.end()) * 1.01;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      report_progress("margins, refinement", static_cast<long>(i), static_cast<long>(places_.size()));
      if (!isfinite(rough_margins[i]) || rough_margins[i] > bound) continue;
      const std::optional<Point>& point = refined(i);
      result.as_expected = result.as_expected && point;
      if (!point) continue;
      const Real found = margin(point->t, point->angle);
      result.as_expected = result.as_expected && abs(found - rough_margins[i]) <= 1e-3 * found;
      if (!isfinite(found) || (result.margin && !(found < *result.margin))) continue;
      result.margin = found;
      result.angle = point->angle;
    }
    return result;
  }

 private:
  const std::optional<Point>& refined(std::size_t i) {
    if (is_refined_[i]) return refined_[i];
    is_refined_[i] = true;
    const Channel t_at = exactly_(places_[i].channel);
    const std::optional<Real> root =
        root_near([&](const Real& angle) { return value_(t_at(angle)); }, places_[i], fineness_);
    if (root) refined_[i] = Point{*root, t_at(*root)};
    return refined_[i];
  }

  const Channels& exactly_;
  const Fineness& fineness_;
  Value value_;
  std::vector<Place> places_;
  std::vector<std::optional<Point>> refined_;
  std::vector<bool> is_refined_;
};

// T at z = 1 and z = −1, where it is real.
std::vector<ComplexReal> ends_of(const Channels& exactly, Index channels) {
  std::vector<ComplexReal> ends;
  for (Index channel = 0; channel < channels; ++channel) {
    const Channel t_at = exactly(channel);
    for (const Real& end : {Real(0), pi()}) ends.push_back(t_at(end));
  }
  return ends;
}

void take_ends(const std::vector<ComplexReal>& ends, Margin margin, Least& least) {
  for (const ComplexReal& t : ends) {
    const Real found = margin(t, Real(0));
    if (isfinite(found) && (!least.margin || found < *least.margin)) least.margin = found;
  }
}

}  // namespace

ChannelMargins channel_margins(const Search& search, const Channels& roughly, const Channels& exactly,
                               const Fineness& fineness) {
  Crossings real(search, roughly, exactly, fineness, imaginary), unit(search, roughly, exactly, fineness, from_half);
  const std::vector<ComplexReal> ends = ends_of(exactly, search.responses.front().rows());
  const auto gain_of = [&](Margin margin) {
    Least least = real.least(margin);
    take_ends(ends, margin, least);
    return least;
  };
  const Least gain = gain_of(gain_margin), phase = unit.least(phase_margin);
  return {gain.margin,
          gain_of(gain_margin_up).margin,
          gain_of(gain_margin_down).margin,
          phase.margin,
          unit.least(delay_margin).margin,
          phase.angle,
          gain.as_expected && phase.as_expected};
}

}  // namespace lqg::design
