// SPDX-License-Identifier: MIT
#include "design/limits/certificate_search.hpp"

#include "design/progress.hpp"

namespace lqg::design::certificate {

bool Search::is_over() {
  if (result_.gap == ProofGap::effort) return true;
  if (result_.pieces >= effort_.pieces || (effort_.is_time_up && effort_.is_time_up())) {
    result_.gap = ProofGap::effort;
    return true;
  }
  if (++result_.pieces % 1000 == 0) report_progress("certificate of the limits", result_.pieces);
  return false;
}

// The cost of the dual has risen since: then no state is here. Where rounding leaves that open, there is no proof.
bool Search::came_before(int flat) {
  for (std::size_t i = path_.size(); i-- > 0;)
    if (path_[i] == sides_) {
      if (flat >= static_cast<int>(i)) admit_rounding();
      return true;
    }
  return false;
}

// Halves of the box without a state of the region are cut off: smaller numbers round less.
void Search::shrink(VectorXd& point) {
  for (Index j = 0; j < centre_.size(); ++j)
    for (int attempt = 0; attempt < 3; ++attempt) {
      const double middle = centre_(j), half = half_(j);
      const double side = point(j) < middle ? 1 : -1;  // where no point is known
      const std::size_t before = region_.size();
      region_.add(VectorXd::Unit(centre_.size(), j) * -side, -side * middle, 0);
      const bool is_empty = region_.is_empty(point);
      region_.shorten(before);
      if (!is_empty) break;
      centre_(j) = middle - 0.5 * side * half;
      half_(j) = 0.5 * half * (1 + 0x1p-50);
    }
}

// Above its tolerance, and scale · violation the largest of those that count.
void Search::require_largest(const Violation& worst, const std::vector<Violation>& all) {
  const double scale = numbers_.scale(worst.row), tolerance = numbers_.tolerance(worst.row);
  require(-worst.size.slope, worst.size.middle + worst.size.radius - tolerance);
  for (const Violation& other : all) {
    if (other.row == worst.row) continue;
    const double its = numbers_.scale(other.row);
    const double rounding = 2 * target_.unit * (scale * largest(worst.size) + its * largest(other.size)) +
                            4 * double_unit * (scale * size(worst.size) + its * size(other.size));
    const double left_out = std::max(0.0, its * other.left_out - scale * tolerance);
    require(its * other.size.slope - scale * worst.size.slope, scale * (worst.size.middle + worst.size.radius) -
                                                                   its * (other.size.middle - other.size.radius) +
                                                                   left_out + rounding);
  }
}

void Search::at_solution(const ActiveRows& active, const Multipliers& known, VectorXd point, int changes, int flat) {
  if (came_before(flat) || is_over()) return;
  path_.push_back(sides_);
  const std::vector<Violation> all = violations(active, known);
  for (const Violation& worst : all) {
    if (is_symmetric_ && changes == 0 && worst.side == LimitSide::high) continue;
    const std::size_t before = region_.size();
    require_largest(worst, all);
    if (!region_.is_empty(point)) append(worst, active, known, point, changes, flat);
    region_.shorten(before);
  }
  path_.pop_back();
}

void Search::append(const Violation& worst, const ActiveRows& active, const Multipliers& known, const VectorXd& point,
                    int changes, int flat) {
  const double violation = numbers_.tolerance(worst.row) - worst.size.radius;
  Approach way{active, VectorXd(active.length()), VectorXd::Zero(active.length() + 1), violation, 0, flat, true};
  way.active.append(worst.row, worst.side);
  for (int k = 0; k < active.length(); ++k) {
    way.deviation(k) = known.m[static_cast<std::size_t>(k)].radius;
    way.largest(k) = known.largest(k);
  }
  sides_[static_cast<std::size_t>(worst.row)] = worst.side;
  approach(way, point, changes + 1);
  sides_[static_cast<std::size_t>(worst.row)] = LimitSide::none;
}

void Search::approach(const Approach& way, VectorXd point, int changes) {
  if (is_over()) return;
  result_.changes = std::max(result_.changes, changes);
  const VectorXd centre = centre_, half = half_;
  shrink(point);
  const std::optional<Multipliers> next = way.active.is_regular(target_.pivot) ? multipliers(way.active) : std::nullopt;
  if (next) {
    reach_end(way, *next, point, changes);
    meet_zeros(way, *next, point, changes);
    check_last(way, *next, point);
  } else {
    admit_rounding();
  }
  centre_ = centre;
  half_ = half;
}

// No multiplier changes its sign.
void Search::reach_end(const Approach& way, const Multipliers& next, VectorXd& point, int changes) {
  const std::size_t before = region_.size();
  for (int k = 0; k < way.active.length(); ++k) {
    const Affine& m = next.m[static_cast<std::size_t>(k)];
    require(-way.active.sign(k) * m.slope, way.active.sign(k) * m.middle + m.radius);
  }
  if (!region_.is_empty(point))
    at_solution(way.active, next, point, changes, rises(way, next) ? way.flat : static_cast<int>(path_.size()) - 1);
  region_.shorten(before);
}

// One of them does, and no other one before.
void Search::meet_zeros(const Approach& way, const Multipliers& next, VectorXd& point, int changes) {
  const Ratios all = ratios(way, next);
  const std::size_t before = region_.size();
  for (std::size_t at = 0; at < all.margin.size(); ++at) {
    const int k = static_cast<int>(at);
    if (cannot_leave(way, k, next, all)) continue;
    require(way.active.sign(k) * next.m[at].slope, next.m[at].radius - way.active.sign(k) * next.m[at].middle);
    for (std::size_t j = 0; j < all.margin.size(); ++j)
      if (j != at && std::isfinite(all.margin[at] + all.margin[j]))
        require(all.position[at].slope - all.position[j].slope,
                all.position[j].middle - all.position[at].middle + all.margin[at] + all.margin[j]);
    if (!region_.is_empty(point)) drop(way, k, next, all, point, changes);
    region_.shorten(before);
  }
}

// The last multiplier does not change its sign: at once, that ends the search; later there is no proof.
void Search::check_last(const Approach& way, const Multipliers& next, VectorXd& point) {
  const int last = way.active.length() - 1;
  const Affine& own = next.m.back();
  const double g = numbers_.G(way.active.row(last), way.active.row(last));
  if (way.is_first || way.violation > 1.01 * g * (own.radius + overshoot(way, next))) return;
  const std::size_t before = region_.size();
  require(way.active.sign(last) * own.slope, own.radius - way.active.sign(last) * own.middle);
  if (!region_.is_empty(point)) admit_rounding();
  region_.shorten(before);
}

void Search::drop(const Approach& way, int k, const Multipliers& next, const Ratios& ratios, const VectorXd& point,
                  int changes) {
  const std::optional<Approach> after = without(way, k, next, ratios);
  if (!after) return admit_rounding();
  const std::size_t row = static_cast<std::size_t>(way.active.row(k));
  const LimitSide side = sides_[row];
  sides_[row] = LimitSide::none;
  approach(*after, point, changes + 1);
  sides_[row] = side;
}

}  // namespace lqg::design::certificate
