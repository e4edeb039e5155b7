// SPDX-License-Identifier: MIT
#include "design/linearise.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "design/motion/derivative.hpp"
#include "design/motion/equilibrium.hpp"
#include "design/motion/starts.hpp"
#include "design/numeric/ziv_test.hpp"
#include "design/rounding.hpp"
#include "expression/evaluate.hpp"

namespace lqg::design {

namespace {

constexpr unsigned digits_of_search = 50, fewer_digits = 430, more_digits = 480;

// Of more numbers to be found other points at rest are not sought, and of many more none.
constexpr std::size_t most_for_others = 6, most_unknown = 40;

const char* const point_key = "plant.operating_point";

class Lineariser {
 public:
  Lineariser(const Plant& plant, const WantedPoint& wanted, Findings& findings)
      : plant_(plant), wanted_(wanted), findings_(findings), nx_(static_cast<Index>(plant.equations->f.size())),
        count_(static_cast<Index>(wanted.values.size())) {
    for (Index i = 0; i < count_; ++i)
      if (!wanted.values[static_cast<std::size_t>(i)]) unknown_.push_back(i);
  }

  std::optional<Linearisation> run() {
    const std::optional<RealVector> found = equilibrium();
    if (!found) return std::nullopt;
    const std::optional<Linearisation> coarse = linearised(*found, fewer_digits);
    if (!coarse) return std::nullopt;
    std::optional<Linearisation> fine = linearised(*found, more_digits);
    const Digits scope(more_digits);
    if (!fine || !settled(*coarse, *fine)) {
      add_error(findings_, point_key, std::to_string(more_digits) + " digits do not settle the slopes at this point");
      return std::nullopt;
    }
    if (!are_doubles(*fine)) return std::nullopt;
    note_moving(*found);
    return fine;
  }

 private:
  const std::string& name(Index i) const {
    return (i < nx_ ? plant_.states[static_cast<std::size_t>(i)] : plant_.inputs[static_cast<std::size_t>(i - nx_)])
        .name;
  }
  // "dθ/dt" of a state: what has to be 0.
  std::string rate(Index state) const {
    return plant_.domain == Domain::continuous ? "d" + name(state) + "/dt" : name(state) + "⁺ − " + name(state);
  }
  std::string listed(const RealVector& point) const {
    std::string list;
    for (const Index i : unknown_) list += (list.empty() ? "" : ", ") + name(i) + " = " + decimal(to_double(point(i)));
    return list;
  }
  std::string names_of(const std::vector<Index>& some) const {
    std::string list;
    for (const Index i : some) list += (list.empty() ? "" : ", ") + name(i);
    return list;
  }

  // The given numbers, and `found` where they are to be found.
  RealVector point_of(const std::optional<RealVector>& found) const {
    RealVector point(count_);
    for (Index i = 0; i < count_; ++i) {
      const WantedPoint::Formula& formula = wanted_.values[static_cast<std::size_t>(i)];
      point(i) = formula ? expression::Constants<Real>()(*formula) : Real(0);
      if (!formula && found) point(i) += (*found)(i);
    }
    return point;
  }

  Rest rest() const {
    std::vector<Index> states;
    for (Index i = 0; i < nx_; ++i)
      if (wanted_.is_steady[static_cast<std::size_t>(i)]) states.push_back(i);
    return Rest(plant_, states);
  }

  std::optional<RealVector> equilibrium() {
    const Digits scope(digits_of_search);
    const Rest equations = rest();
    const RealVector given = point_of({});
    for (Index i = 0; i < count_; ++i)
      if (!isfinite(given(i))) {
        add_error(findings_, point_key, "the value of " + name(i) + " is not a finite number");
        return std::nullopt;
      }
    if (unknown_.empty()) {
      RealMatrix over_x, over_u;
      RealVector f;
      if (!fill("f", plant_.equations->f, given, over_x, over_u, f)) return std::nullopt;
      if (is_at_rest(equations, given)) return given;
      report_rates(equations, given);
      return std::nullopt;
    }
    if (unknown_.size() > most_unknown) {
      add_error(
          findings_, point_key,
          "expected at most " + std::to_string(most_unknown) + " \"?\", found " + std::to_string(unknown_.size()));
      return std::nullopt;
    }
    return sought(equations, given);
  }

  std::optional<RealVector> sought(const Rest& equations, const RealVector& given) {
    std::vector<RealVector> good, loose;
    std::optional<RealVector> nearest;
    for (const RealVector& start : starts_of(wanted_, given, unknown_)) {
      const std::optional<RealVector> end = descended(equations, start, unknown_);
      if (!end) continue;
      if (!is_at_rest(equations, *end)) {
        if (!nearest) nearest = end;
        continue;
      }
      (undetermined(equations, *end, unknown_).empty() ? good : loose).push_back(*end);
      if (good.empty() && loose.size() >= 3) break;
      if (!good.empty() && unknown_.size() > most_for_others) break;
    }
    if (good.empty()) {
      report_none(equations, loose, nearest);
      return std::nullopt;
    }
    note_others(good);
    return good.front();
  }

  void report_none(const Rest& equations, const std::vector<RealVector>& loose,
                   const std::optional<RealVector>& nearest) {
    if (!loose.empty())
      return add_error(findings_, point_key,
                       "\"?\" of " + names_of(undetermined(equations, loose.front(), unknown_)) +
                           ": not determined by f = 0 (it holds at " + listed(loose.front()) +
                           ", and moving them changes nothing there); give a number");
    if (!nearest)
      return add_error(findings_, point_key,
                       "f has no finite value where the search for \"?\" begins; say where to begin: \"? 0.5\"");
    add_error(findings_, point_key,
              "nothing was found for \"?\" at which f is 0; nearest is " + listed(*nearest) + ", where " +
                  rates_at(equations, *nearest) +
                  "; give other numbers, say where to begin (\"? 0.5\"), or name in `steady` the states that have to "
                  "be at rest");
  }

  // Those that are not 0.
  std::string rates_at(const Rest& equations, const RealVector& point) const {
    const std::optional<Rest::At> at = equations.at(point);
    if (!at) return "f has no finite value";
    std::string list;
    for (std::size_t i = 0; i < equations.states().size(); ++i) {
      const Index state = equations.states()[i];
      if (is_at_rest(Rest(plant_, {state}), point)) continue;
      list += (list.empty() ? "" : ", ") + rate(state) + " = " + decimal(to_double(at->value(static_cast<Index>(i))));
    }
    return list;
  }

  void report_rates(const Rest& equations, const RealVector& point) {
    add_error(findings_, point_key,
              "expected a point at rest, found " + rates_at(equations, point) +
                  "; write \"?\" for what is to be found, or name in `steady` the states that have to be at rest");
  }

  void note_others(const std::vector<RealVector>& found) {
    const RealVector& first = found.front();
    for (const RealVector& other : found) {
      const bool is_other = std::any_of(unknown_.begin(), unknown_.end(), [&](Index i) {
        return abs(other(i) - first(i)) > 1e-6 * (abs(other(i)) + abs(first(i))) + negligible(0.3);
      });
      if (!is_other) continue;
      return add_note(findings_, point_key,
                      "f is 0 at " + listed(first) + ", which is taken, and also at " + listed(other) +
                          "; \"? 0.5\" says where the search begins");
    }
  }

  // What need not be at rest, and is not.
  void note_moving(const RealVector& found) {
    const Digits scope(digits_of_search);
    std::vector<Index> others;
    for (Index i = 0; i < nx_; ++i)
      if (!wanted_.is_steady[static_cast<std::size_t>(i)]) others.push_back(i);
    const Rest moving(plant_, others);
    if (is_at_rest(moving, found)) return;
    add_note(findings_, point_key,
             rates_at(moving, found) + " at this point: the linear plant, and a filter of it, do not know of that");
  }

  // One row of values and slopes of each formula.
  bool fill(const char* of, const std::vector<WantedPoint::Formula>& formulas, const RealVector& point,
            RealMatrix& over_x, RealMatrix& over_u, RealVector& values) {
    const Index rows = static_cast<Index>(formulas.size());
    over_x = zeros(rows, nx_), over_u = zeros(rows, count_ - nx_), values = RealVector(rows);
    for (Index i = 0; i < rows; ++i) {
      const auto found = slope_of(*formulas[static_cast<std::size_t>(i)], point, Kinks::refuse);
      if (const NoSlope* none = std::get_if<NoSlope>(&found)) {
        add_error(findings_, "plant." + std::string(of) + "[" + std::to_string(i) + "]",
                  "cannot be linearised at the operating point: " + none->reason + " (character " +
                      std::to_string(none->at + 1) + ")");
        return false;
      }
      const Slope& slope = std::get<Slope>(found);
      values(i) = slope.value;
      for (Index j = 0; j < nx_; ++j) over_x(i, j) = slope.slope(j);
      for (Index j = nx_; j < count_; ++j) over_u(i, j - nx_) = slope.slope(j);
    }
    return true;
  }

  std::optional<Linearisation> linearised(const RealVector& found, unsigned digits) {
    const Digits scope(digits);
    RealVector point = point_of(found);
    if (!unknown_.empty()) {
      const std::optional<RealVector> polished_point = polished(rest(), point, unknown_);
      if (!polished_point) {
        add_error(findings_, point_key,
                  "\"?\" of " + names_of(unknown_) + ": not determined by f = 0, which touches 0 at " + listed(point) +
                      " and does not pass through it; give a number");
        return std::nullopt;
      }
      point = *polished_point;
    }
    Linearisation result;
    RealVector f;
    if (!fill("f", plant_.equations->f, point, result.A, result.B, f)) return std::nullopt;
    if (!fill("h", plant_.equations->h, point, result.C, result.D, result.y)) return std::nullopt;
    result.x = point.head(nx_), result.u = point.tail(count_ - nx_);
    return result;
  }

  static bool settled(const Linearisation& coarse, Linearisation& fine) {
    bool good = true;
    const auto settle = [&](const auto& before, auto& after) {
      for (Index i = 0; i < after.size(); ++i) {
        Real& value = after.data()[i];
        good = passes_ziv_test(before.data()[i], value, Real(1), fewer_digits) && good;
        if (to_double(value) == 0) value = 0;  // nothing but what so many digits leave of 0
      }
    };
    for (const auto part : {&Linearisation::A, &Linearisation::B, &Linearisation::C, &Linearisation::D})
      settle(coarse.*part, fine.*part);
    for (const auto part : {&Linearisation::x, &Linearisation::u, &Linearisation::y}) settle(coarse.*part, fine.*part);
    return good;
  }

  bool are_doubles(const Linearisation& result) {
    for (const RealMatrix* part : {&result.A, &result.B, &result.C, &result.D})
      if (!to_doubles(*part).allFinite()) {
        add_error(findings_, point_key, "a slope at this point is beyond what a double can be");
        return false;
      }
    return true;
  }

  const Plant& plant_;
  const WantedPoint& wanted_;
  Findings& findings_;
  Index nx_, count_;
  std::vector<Index> unknown_;
};

}  // namespace

std::optional<Linearisation> linearise(const Plant& plant, const WantedPoint& point, Findings& findings) {
  return Lineariser(plant, point, findings).run();
}

}  // namespace lqg::design
