#include "design/loop/margins.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>

#include "design/numeric/response.hpp"
#include "design/numeric/structured_singular_value.hpp"
#include "design/progress.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

using Evaluate = std::function<ComplexMatrix(const Real&)>;           // T at an angle
using Value = std::function<Real(const ComplexMatrix&)>;              // of T
using InputValue = std::function<Real(const ComplexMatrix&, Index)>;  // of T and an input
using Function = std::function<Real(const Real&)>;                    // of an angle

Real pi() { return atan(Real(1)) * 4; }

// Angles in (0, π): as dense around every pole as it is close to the circle, 8 to an octave from both ends. These
// begin far inside of the pole that is nearest to ±1, for zeros may be nearer.
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
  angles.erase(
      std::remove_if(angles.begin(), angles.end(), [&](const Real& x) { return !(x > 0 && x < end); }),
      angles.end());
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());  // repeated poles
  return angles;
}

// A root of f between low and high, where its signs differ: secant steps, halving where they would leave the
// bracket. The last step is shorter than `fraction` of the bracket.
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

// The difference quotient of f without its denominator.
Function slope_of(const Function& f, const Real& step) {
  return [f, step](const Real& x) { return Real(f(x + step) - f(x - step)); };
}

// How a margin is searched: roughly first, then exactly. Steps and ends as fractions of the cell.
struct Fineness {
  double step, end_of_root, end_of_extremum;
};
const Fineness rough = {1e-4, 1e-7, 1e-3}, as_far_as_double_goes = {1e-4, 1e-10, 1e-6},
               exact = {1e-14, 1e-14, 1e-10};

// How the places of the search are refined.
struct Refining {
  Evaluate evaluate;
  Fineness fineness;
};

struct Search {
  Evaluate evaluate;
  std::vector<Real> angles;
  std::vector<ComplexMatrix> responses;
};

Search search_with(const Evaluate& evaluate, const std::vector<Real>& angles) {
  Search search = {evaluate, angles, {}};
  for (const Real& angle : angles) {
    report_progress("margins, search", static_cast<long>(search.responses.size()), static_cast<long>(angles.size()));
    search.responses.push_back(evaluate(angle));
  }
  return search;
}

// A cell of the grid with one root or one extremum in it; where that is, roughly, and the margin there.
struct Place {
  Real low, high, angle, margin;
  Index input = 0;
};

Function at_angle(const Value& value, const Evaluate& evaluate) {
  return [value, evaluate](const Real& angle) { return value(evaluate(angle)); };
}

// Where `value` crosses zero: between neighbours of different sign, and on both sides of a dip that passes
// zero unseen.
std::vector<Place> crossings(const Search& search, const Value& value, const Value& margin) {
  std::vector<Place> places;
  std::vector<Real> values;
  for (const ComplexMatrix& T : search.responses) values.push_back(value(T));
  const Function f = at_angle(value, search.evaluate);
  const auto add = [&](const Real& low, const Real& high) {
    const Real root = root_between(f, low, high, rough.end_of_root);
    places.push_back({low, high, root, margin(search.evaluate(root))});
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
  return places;
}

bool by_margin(const Place& a, const Place& b) { return a.margin < b.margin; }

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

struct Outcome {
  std::optional<Real> least;
  bool as_expected = true;  // the rough search saw what the exact evaluation found
};

// The least margin of all inputs: the roots of `value`, the rough search's best ones refined, and what `ends`
// has already.
Outcome least_margin(const Search& search, const Refining& refining, const InputValue& value,
                     const InputValue& margin, const std::optional<Real>& ends) {
  Outcome outcome;
  outcome.least = ends;
  std::vector<Place> places;
  for (Index input = 0; input < search.responses.front().re.rows(); ++input) {
    const auto value_here = [&, input](const ComplexMatrix& T) { return value(T, input); };
    const auto margin_here = [&, input](const ComplexMatrix& T) { return margin(T, input); };
    for (Place& place : crossings(search, value_here, margin_here)) {
      place.input = input;
      if (isfinite(place.margin)) places.push_back(place);
    }
  }
  if (places.empty()) return outcome;
  const Real bound = std::min_element(places.begin(), places.end(), by_margin)->margin * 1.01;
  for (const Place& place : places) {
    report_progress("margins, refinement", static_cast<long>(&place - places.data()), static_cast<long>(places.size()));
    if (place.margin > bound) continue;
    const Index input = place.input;
    const Function f = [&, input](const Real& angle) { return value(refining.evaluate(angle), input); };
    const std::optional<Real> root = root_near(f, place, refining.fineness);
    outcome.as_expected = outcome.as_expected && root;
    if (!root) continue;
    const Real found = margin(refining.evaluate(*root), input);
    outcome.as_expected = outcome.as_expected && abs(found - place.margin) <= 1e-3 * found;
    if (!outcome.least || found < *outcome.least) outcome.least = found;
  }
  return outcome;
}

// |20 log10(1 − 1/t)|; infinite when a real t asks for no finite factor.
Real gain_margin(const ComplexMatrix& T, Index input) {
  const Real &t = T.re(input, input), rounding = 1e-20;
  if (t < -rounding || t > 1 + rounding) return abs(20 * log10(1 - 1 / t));
  return Real(std::numeric_limits<double>::infinity());
}

Real phase_margin(const ComplexMatrix& T, Index input) {
  return 2 * atan2(Real(1), 2 * abs(T.im(input, input))) * 180 / pi();
}

// T is real at z = 1 and z = −1.
std::optional<Real> gain_margin_at_ends(const Evaluate& evaluate) {
  std::optional<Real> least;
  for (const Real& end : {Real(0), pi()}) {
    const ComplexMatrix T = evaluate(end);
    for (Index input = 0; input < T.re.rows(); ++input) {
      const Real found = gain_margin(T, input);
      if (isfinite(found) && (!least || found < *least)) least = found;
    }
  }
  return least;
}

Outcome least_gain(const Search& search, const Refining& refining) {
  const auto imaginary = [](const ComplexMatrix& T, Index input) { return T.im(input, input); };
  return least_margin(search, refining, imaginary, gain_margin, gain_margin_at_ends(refining.evaluate));
}

Outcome least_phase(const Search& search, const Refining& refining) {
  const auto from_half = [](const ComplexMatrix& T, Index input) { return Real(T.re(input, input) - 0.5); };
  return least_margin(search, refining, from_half, phase_margin, std::nullopt);
}

// I/2 − T in double.
Eigen::MatrixXcd rough_difference(const ComplexMatrix& T) {
  Eigen::MatrixXcd H(T.re.rows(), T.re.cols());
  for (Index i = 0; i < H.size(); ++i) H.data()[i] = {-to_double(T.re.data()[i]), -to_double(T.im.data()[i])};
  H.diagonal().array() += 0.5;
  return H;
}

// 1/μ(I/2 − T): of one channel in all digits, of several in those of double.
Real rough_disk(const ComplexMatrix& T) { return 1 / Real(balanced_norm(rough_difference(T))); }
Real exact_disk(const ComplexMatrix& T) {
  if (T.re.size() > 1) return 1 / Real(structured_norm(rough_difference(T)));
  return 1 / hypot(T.re(0, 0) - 0.5, T.im(0, 0));
}

// The cells around the local minima of the rough disk on the grid, each with the grid's value. Where it is flat to the
// rounding of double, as without any feedback, there is nothing to refine: of these places the least one, an empty cell.
std::vector<Place> disk_places(const Search& search) {
  std::vector<Place> places;
  std::optional<Place> flat;
  std::vector<Real> sizes;
  for (const ComplexMatrix& T : search.responses) sizes.push_back(rough_disk(T));
  for (std::size_t i = 1; i + 1 < sizes.size(); ++i) {
    const Real &here = sizes[i], &angle = search.angles[i];
    if (here > sizes[i - 1] || here > sizes[i + 1]) continue;
    if (std::max<Real>(sizes[i - 1], sizes[i + 1]) > here * (1 + 1e-9))
      places.push_back({search.angles[i - 1], search.angles[i + 1], angle, here});
    else if (!flat || here < flat->margin)
      flat = Place{angle, angle, angle, here};
  }
  if (flat) places.push_back(*flat);
  return places;
}

// The least of f in a cell. Its slope cannot be had of several channels: μ has kinks, and few digits.
Real least_in(const Place& place, const Function& f) {
  const auto at = [&](double share) { return to_double(f(place.low + share * (place.high - place.low))); };
  boost::uintmax_t most = 40;
  return Real(boost::math::tools::brent_find_minima(at, 0.0, 1.0, 10, most).second);
}

Outcome least_disk(const Search& search, const Refining& refining) {
  Outcome outcome;
  const Function f = at_angle(exact_disk, refining.evaluate);
  outcome.least = std::min<Real>(f(Real(0)), f(pi()));
  const bool has_channels = search.responses.front().re.rows() > 1;
  const std::vector<Place> places = disk_places(search);
  if (places.empty()) return outcome;
  const Real bound = std::min_element(places.begin(), places.end(), by_margin)->margin * 1.1;
  for (const Place& place : places) {
    if (place.margin > bound) continue;
    if (place.low == place.high) {
      outcome.least = std::min<Real>(*outcome.least, f(place.angle));
      continue;
    }
    if (has_channels) {
      outcome.least = std::min<Real>(*outcome.least, least_in(place, f));
      continue;
    }
    const Function slope = slope_of(f, refining.fineness.step * (place.high - place.low));
    const bool has_minimum = slope(place.low) < 0 && slope(place.high) > 0;
    outcome.as_expected = outcome.as_expected && has_minimum;
    if (!has_minimum) continue;
    outcome.least =
        std::min<Real>(*outcome.least, f(root_between(slope, place.low, place.high, refining.fineness.end_of_extremum)));
  }
  return outcome;
}

// The margins, and whether the search saw all that the refined places show.
std::pair<Margins, bool> least_margins(const Search& search, const Refining& refining) {
  const Outcome gain = least_gain(search, refining), phase = least_phase(search, refining);
  const Outcome disk = least_disk(search, refining);
  Margins result;
  if (gain.least) result.gain_dB = to_double(*gain.least);
  if (phase.least) result.phase_deg = to_double(*phase.least);
  result.disk = to_double(*disk.least);
  return {result, gain.as_expected && phase.as_expected && disk.as_expected};
}

Evaluate roughly(const Response& response) {
  return [&response](const Real& angle) {
    const Digits few(20);
    return response.roughly_at(angle);
  };
}

Response closed_response(const OpenLoop& loop) {
  return Response(loop.A - multiply(loop.B, loop.C), loop.B, loop.C);
}

void keep_six_digits(std::optional<double>& value) {
  if (!value) return;
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", *value);
  value = std::strtod(text, nullptr);
}

}  // namespace

Margins margins(const OpenLoop& loop, const std::vector<ComplexReal>& closed_loop_poles) {
  const Response response = closed_response(loop);
  const Digits enough(38);  // two limbs
  const Response in_few_digits = response.in_present_digits();
  const std::vector<Real> angles = search_angles(closed_loop_poles);
  const Refining exactly = {[&](const Real& angle) { return in_few_digits.at(angle); }, exact};
  auto [result, is_certain] = least_margins(search_with(roughly(response), angles), exactly);
  if (!is_certain) result = least_margins(search_with(exactly.evaluate, angles), exactly).first;
  if (loop.B.cols() > 1) keep_six_digits(result.disk);  // of a search in double
  return result;
}

Margins rough_margins(const OpenLoop& loop, const std::vector<ComplexReal>& closed_loop_poles) {
  const Digits enough(38);
  const Response response = closed_response(loop);
  const Evaluate evaluate = roughly(response);
  const Search search = search_with(evaluate, search_angles(closed_loop_poles));
  Margins result = least_margins(search, {evaluate, as_far_as_double_goes}).first;
  for (std::optional<double>* value : {&result.gain_dB, &result.phase_deg, &result.disk}) keep_six_digits(*value);
  return result;
}

}  // namespace lqg::design
