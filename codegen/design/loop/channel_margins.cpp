#include "design/loop/channel_margins.hpp"

#include <algorithm>
#include <limits>

#include "design/progress.hpp"

namespace lqg::design {

namespace {

using Value = Real (*)(const ComplexReal& t);

const double none = std::numeric_limits<double>::infinity();

Real imaginary(const ComplexReal& t) { return t.im; }
Real from_half(const ComplexReal& t) { return Real(t.re - 0.5); }

// |20 log10(1 − 1/t)|; infinite where a real t asks for no finite factor.
Real gain_margin(const ComplexReal& t) {
  const Real rounding = 1e-20;
  return t.re < -rounding || t.re > 1 + rounding ? Real(abs(20 * log10(1 - 1 / t.re))) : Real(none);
}

Real phase_margin(const ComplexReal& t) { return 2 * atan2(Real(1), 2 * abs(t.im)) * 180 / pi(); }

// A cell of the grid with one root in it; where that is, roughly.
struct Place {
  Index channel;
  Real low, high, angle;
  ComplexReal t;
};

ComplexReal entry(const ComplexMatrix& T, Index channel) { return {T.re(channel, channel), T.im(channel, channel)}; }

// Where `value` of a channel crosses zero: between neighbours of different sign, and on both sides of a dip that passes
// zero unseen.
void add_crossings(const Search& search, const Channel& t_at, Index channel, Value value, std::vector<Place>& places) {
  std::vector<Real> values;
  for (const ComplexMatrix& T : search.responses) values.push_back(value(entry(T, channel)));
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
    const bool dips = i > 0 && i + 2 < values.size() && abs(values[i]) < abs(values[i - 1])
                      && abs(values[i + 1]) < abs(values[i + 2]);
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
  std::optional<Real> margin;
  bool as_expected = true;
};

// The least margin where `value` is 0: those of the rough places that may be it are refined.
Least least_margin(const Search& search, const Channels& roughly, const Channels& exactly, const Fineness& fineness,
                   Value value, Value margin) {
  std::vector<Place> places;
  for (Index channel = 0; channel < search.responses.front().re.rows(); ++channel)
    add_crossings(search, roughly(channel), channel, value, places);
  Real bound = none;
  for (const Place& place : places) bound = std::min<Real>(bound, margin(place.t) * 1.01);
  Least least;
  for (const Place& place : places) {
    report_progress("margins, refinement", static_cast<long>(&place - places.data()), static_cast<long>(places.size()));
    const Real roughly_found = margin(place.t);
    if (!isfinite(roughly_found) || roughly_found > bound) continue;
    const Channel t_at = exactly(place.channel);
    const Function f = [&](const Real& angle) { return value(t_at(angle)); };
    const std::optional<Real> root = root_near(f, place, fineness);
    least.as_expected = least.as_expected && root;
    if (!root) continue;
    const Real found = margin(t_at(*root));
    least.as_expected = least.as_expected && abs(found - roughly_found) <= 1e-3 * found;
    if (!least.margin || found < *least.margin) least.margin = found;
  }
  return least;
}

// t is real at z = 1 and z = −1.
void take_ends(const Channels& exactly, Index channels, Least& least) {
  for (Index channel = 0; channel < channels; ++channel) {
    const Channel t_at = exactly(channel);
    for (const Real& end : {Real(0), pi()}) {
      const Real found = gain_margin(t_at(end));
      if (isfinite(found) && (!least.margin || found < *least.margin)) least.margin = found;
    }
  }
}

}  // namespace

ChannelMargins channel_margins(const Search& search, const Channels& roughly, const Channels& exactly,
                               const Fineness& fineness) {
  Least gain = least_margin(search, roughly, exactly, fineness, imaginary, gain_margin);
  take_ends(exactly, search.responses.front().re.rows(), gain);
  const Least phase = least_margin(search, roughly, exactly, fineness, from_half, phase_margin);
  return {gain.margin, phase.margin, gain.as_expected && phase.as_expected};
}

}  // namespace lqg::design
