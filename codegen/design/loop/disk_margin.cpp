// SPDX-License-Identifier: MIT
#include "design/loop/disk_margin.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <optional>
#include <tuple>

#include "design/numeric/structured_singular_value.hpp"
#include "design/progress.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

Function at_angle(Real (*value)(const Eigen::MatrixXcd&), const Evaluate& evaluate) {
  return [value, evaluate](const Real& angle) { return value(evaluate(angle)); };
}

// I/2 − T
Eigen::MatrixXcd difference(const Eigen::MatrixXcd& T) {
  Eigen::MatrixXcd H = -T;
  H.diagonal().array() += 0.5;
  return H;
}

constexpr Index most_for_a_search = 8;  // channels whose structured norm is searched for in a whole cell

// 1/μ(I/2 − T)
Real rough_disk(const Eigen::MatrixXcd& T) { return 1 / Real(balanced_norm(difference(T))); }
Real disk_of_several(const Eigen::MatrixXcd& T) {
  const Eigen::MatrixXcd H = difference(T);
  return 1 / Real(H.rows() > most_for_a_search ? structured_norm_of_many(H) : structured_norm(H));
}
Real disk_of_one(const ComplexReal& t) { return 1 / hypot(t.re - 0.5, t.im); }

// A cell of the grid with one minimum in it; where that is, roughly, and the disk there.
struct DiskAt {
  Real low, high, angle, disk;
};

// The cells around the local minima of the rough disk on the grid, each with the grid's value. Where it is flat to the
// rounding of double, as without any feedback, there is nothing to refine: of these places the least one, an empty
// cell.
std::vector<DiskAt> disk_places(const Search& search) {
  std::vector<DiskAt> places;
  std::optional<DiskAt> flat;
  std::vector<Real> sizes;
  for (const Eigen::MatrixXcd& T : search.responses) sizes.push_back(rough_disk(T));
  for (std::size_t i = 1; i + 1 < sizes.size(); ++i) {
    const Real &here = sizes[i], &angle = search.angles[i];
    if (here > sizes[i - 1] || here > sizes[i + 1]) continue;
    if (std::max<Real>(sizes[i - 1], sizes[i + 1]) > here * (1 + 1e-9))
      places.push_back({search.angles[i - 1], search.angles[i + 1], angle, here});
    else if (!flat || here < flat->disk)
      flat = DiskAt{angle, angle, angle, here};
  }
  if (flat) places.push_back(*flat);
  return places;
}

// Where f is least in a cell, and how much. Its slope cannot be had of several channels: μ has kinks, and few digits.
std::pair<Real, Real> least_in(const DiskAt& place, const Function& f) {
  const Real width = place.high - place.low;
  const auto at = [&](double share) { return to_double(f(place.low + share * width)); };
  boost::uintmax_t most = 40;
  const auto [share, least] = boost::math::tools::brent_find_minima(at, 0.0, 1.0, 10, most);
  return {place.low + share * width, Real(least)};
}

// One channel: where the slope of f is 0, in all digits.
void refine_one(const std::vector<DiskAt>& places, const Function& f, const Fineness& fineness, DiskMargin& margin) {
  for (const DiskAt& place : places) {
    const Function slope = slope_of(f, fineness.step * (place.high - place.low));
    const bool has_minimum = slope(place.low) < 0 && slope(place.high) > 0;
    margin.as_expected = margin.as_expected && has_minimum;
    if (!has_minimum) continue;
    const Real angle = root_between(slope, place.low, place.high, fineness.end_of_extremum);
    margin.least = std::min<Real>(margin.least, f(angle));
  }
}

// The balanced disk is never more: a place where it is more than the least disk so far has nothing less.
void refine_many(std::vector<DiskAt> places, const Evaluate& evaluate, DiskMargin& margin) {
  const Function lower = at_angle(rough_disk, evaluate), f = at_angle(disk_of_several, evaluate);
  for (DiskAt& place : places) std::tie(place.angle, place.disk) = least_in(place, lower);
  std::sort(places.begin(), places.end(), [](const DiskAt& a, const DiskAt& b) { return a.disk < b.disk; });
  for (const DiskAt& place : places) {
    report_progress("disk margin", static_cast<long>(&place - places.data()), static_cast<long>(places.size()));
    if (place.disk < margin.least) margin.least = std::min<Real>(margin.least, f(place.angle));
  }
}

}  // namespace

DiskMargin disk_margin(const Search& search, const Channels& channel_of, const Evaluate& evaluate,
                       const Fineness& fineness) {
  const Index channels = search.responses.front().rows();
  const Evaluate& enough = channels > most_for_a_search ? search.evaluate : evaluate;
  const Function f = channels == 1
                         ? Function([t_at = channel_of(0)](const Real& angle) { return disk_of_one(t_at(angle)); })
                         : at_angle(disk_of_several, enough);
  DiskMargin margin = {std::min<Real>(f(Real(0)), f(pi()))};
  std::vector<DiskAt> places = disk_places(search);
  const auto by_disk = [](const DiskAt& a, const DiskAt& b) { return a.disk < b.disk; };
  if (places.empty()) return margin;
  const Real bound = std::min_element(places.begin(), places.end(), by_disk)->disk * 1.1;
  const auto is_far = [&](const DiskAt& place) { return place.disk > bound; };
  places.erase(std::remove_if(places.begin(), places.end(), is_far), places.end());
  if (places.back().low == places.back().high) {  // the flat one
    margin.least = std::min<Real>(margin.least, f(places.back().angle));
    places.pop_back();
  }
  if (channels == 1) {
    refine_one(places, f, fineness, margin);
  } else if (channels > most_for_a_search) {
    refine_many(places, enough, margin);
  } else {
    const Function roughly = at_angle(disk_of_several, search.evaluate);
    for (const DiskAt& place : places) margin.least = std::min<Real>(margin.least, f(least_in(place, roughly).first));
  }
  return margin;
}

}  // namespace lqg::design
