// SPDX-License-Identifier: MIT
#include "design/limits/certificate.hpp"

#include <cfloat>
#include <limits>

#include "design/limits/active_rows.hpp"
#include "design/limits/region.hpp"
#include "design/progress.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Those of src/mpc.c: what of a pivot, and of a violation, counts as nothing, as a share of G_ii and of f_i.
struct Target {
  double unit, smallest, pivot, violation;
};
constexpr Target target_float{0x1p-24, FLT_MIN, 0x1p-20, 0x1p-20};
constexpr Target target_double{0x1p-53, DBL_MIN, 0x1p-46, 0x1p-49};

// middle + slope·ξ, within radius, for every ξ of the box at hand.
struct Affine {
  double middle = 0;
  VectorXd slope;
  double radius = 0;
};

Affine constant(double value, Index dimension) { return {value, VectorXd::Zero(dimension), 0}; }

void add(Affine& to, double factor, const Affine& a) {
  to.middle += factor * a.middle;
  to.slope += factor * a.slope;
}

// The multipliers with which the active rows are at their limits. `radius` covers those of exact arithmetic and those
// of the target.
struct Multipliers {
  std::vector<Affine> m;
  VectorXd largest;   // of |m|
  VectorXd residual;  // by how much the rows may miss their limits
};

// How far a row is beyond one of its limits.
struct Violation {
  int row;
  LimitSide side;
  Affine size;
  double left_out;  // up to which it does not count
};

// A row has been appended, and its multiplier grows.
struct Approach {
  ActiveRows active;
  VectorXd deviation;  // of the multipliers before the last from those of the exact path, at most
  VectorXd largest;    // multipliers, at most
  double violation;    // of the last row at the beginning, at least: what rounding may take is subtracted
  double lost = 0;     // twice the cost of the dual that rounding may take
  int flat = -1;       // the last set of the path from which the cost of the dual may not have risen
  bool is_first = true;
};

// By how much the multipliers before the last fall while that grows: the place at which each is 0 is `position` ahead
// of the end.
struct Ratios {
  std::vector<double> rate, rate_error;
  std::vector<Affine> position;
  std::vector<double> margin;  // infinite where the multiplier may not fall
};

class Certificate {
 public:
  // The box's first coordinates are x, the others u[k−1].
  Certificate(const LimitNumbers& numbers, const CertificateEffort& effort, const VectorXd& centre,
              const VectorXd& half_width, CertifiedChanges& result)
      : numbers_(numbers), effort_(effort), result_(result),
        target_(numbers.real == Scalar::float32 ? target_float : target_double),
        rows_(static_cast<int>(numbers.G.rows())), sides_(static_cast<std::size_t>(rows_), LimitSide::none),
        region_(centre.size()), centre_(VectorXd::Zero(centre.size())), half_(VectorXd::Ones(centre.size())) {
    for (int i = 0; i < rows_; ++i) add_row(i, centre, half_width);
    is_symmetric_ = numbers.u_step.size() == 0 && centre.isZero(0) && numbers.low == -numbers.high;
  }
  void search() {
    at_solution(ActiveRows(numbers_.G, numbers_.real == Scalar::float32), {}, VectorXd::Zero(centre_.size()), 0, -1);
  }

 private:
  void add_row(int i, const VectorXd& centre, const VectorXd& half_width);
  Affine narrowed(int i, double limit, double other, double step, const VectorXd& centre,
                  const VectorXd& half_width) const;

  double largest(const Affine& a) const {
    return std::abs(a.middle + a.slope.dot(centre_)) + a.slope.cwiseAbs().dot(half_) + a.radius;
  }
  double smallest(const Affine& a) const {
    return a.middle + a.slope.dot(centre_) - a.slope.cwiseAbs().dot(half_) - a.radius;
  }
  // What its terms add up to: how much rounding there is.
  double size(const Affine& a) const {
    return std::abs(a.middle) + a.slope.cwiseAbs().dot(centre_.cwiseAbs() + half_) + a.radius;
  }

  bool is_over();
  void admit_rounding() {
    if (result_.gap == ProofGap::none) result_.gap = ProofGap::rounding;
  }
  void require(const VectorXd& slope, double bound) { region_.add(slope, bound, effort_.tie_distance); }
  bool came_before(int flat);
  void shrink(VectorXd& point);
  std::optional<Multipliers> multipliers(const ActiveRows& active) const;
  std::vector<Violation> violations(const ActiveRows& active, const Multipliers& known) const;
  void require_largest(const Violation& worst, const std::vector<Violation>& all);
  Ratios ratios(const Approach& way, const Multipliers& next) const;

  void at_solution(const ActiveRows& active, const Multipliers& known, VectorXd point, int changes, int flat);
  void append(const Violation& worst, const ActiveRows& active, const Multipliers& known, const VectorXd& point,
              int changes, int flat);
  void approach(const Approach& way, VectorXd point, int changes);
  void drop(const Approach& way, int k, const Multipliers& next, const Ratios& ratios, const VectorXd& point,
            int changes);

  const LimitNumbers& numbers_;
  const CertificateEffort& effort_;
  CertifiedChanges& result_;
  Target target_;
  int rows_;
  std::vector<Affine> f_, low_, high_;
  bool is_symmetric_ = false;
  std::vector<LimitSide> sides_;
  std::vector<std::vector<LimitSide>> path_;  // the sets at whose solution it has been
  Region region_;
  VectorXd centre_, half_;  // a box around the region
};

void Certificate::add_row(int i, const VectorXd& centre, const VectorXd& half_width) {
  const Index nu = numbers_.law.rows(), nx = numbers_.law.cols();
  const VectorXd row = i < nu ? numbers_.law.row(i) : numbers_.F.row(i - nu);
  Affine f = constant(row.dot(centre.head(nx)), centre.size());
  f.slope.head(nx) = row.cwiseProduct(half_width.head(nx));
  const double sum = row.cwiseAbs().dot((centre.head(nx).cwiseAbs() + half_width.head(nx)));
  f.radius = static_cast<double>(nx + 2) * ((target_.unit + double_unit) * sum + target_.smallest);
  f_.push_back(f);
  low_.push_back(constant(numbers_.low(i), centre.size()));
  high_.push_back(constant(numbers_.high(i), centre.size()));
  if (i >= numbers_.u_step.size()) return;
  const double step = numbers_.u_step(i);
  low_.back() = narrowed(i, numbers_.low(i), numbers_.high(i), -step, centre, half_width);
  high_.back() = narrowed(i, numbers_.high(i), numbers_.low(i), step, centre, half_width);
}

// u[k−1] + step where it is between both limits; the box is one in which it is on one side of each.
Affine Certificate::narrowed(int i, double limit, double other, double step, const VectorXd& centre,
                             const VectorXd& half_width) const {
  const Index at = numbers_.law.cols() + i;
  const double moved = centre(at) + step;
  if (step < 0 ? moved <= limit : moved >= limit) return constant(limit, centre.size());
  if (step < 0 ? moved >= other : moved <= other) return constant(other, centre.size());
  Affine result = constant(moved, centre.size());
  result.slope(at) = half_width(at);
  result.radius = 2 * ((target_.unit + double_unit) * (std::abs(centre(at)) + half_width(at) + std::abs(step)) +
                       target_.smallest);
  return result;
}

bool Certificate::is_over() {
  if (result_.gap == ProofGap::effort) return true;
  if (result_.pieces >= effort_.pieces || (effort_.is_time_up && effort_.is_time_up())) {
    result_.gap = ProofGap::effort;
    return true;
  }
  if (++result_.pieces % 1000 == 0) report_progress("certificate of the limits", result_.pieces);
  return false;
}

// The cost of the dual has risen since: then no state is here. Where rounding leaves that open, there is no proof.
bool Certificate::came_before(int flat) {
  for (std::size_t i = path_.size(); i-- > 0;)
    if (path_[i] == sides_) {
      if (flat >= static_cast<int>(i)) admit_rounding();
      return true;
    }
  return false;
}

// Halves of the box without a state of the region are cut off: smaller numbers round less.
void Certificate::shrink(VectorXd& point) {
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

std::optional<Multipliers> Certificate::multipliers(const ActiveRows& active) const {
  const int n = active.length();
  const MatrixXd& inverse = active.inverse();
  std::vector<Affine> right;
  Multipliers result;
  result.largest = result.residual = VectorXd::Zero(n);
  for (int k = 0; k < n; ++k) {
    const std::size_t row = static_cast<std::size_t>(active.row(k));
    Affine distance = active.sign(k) > 0 ? low_[row] : high_[row];
    distance.radius += f_[row].radius;
    add(distance, -1, f_[row]);
    result.residual(k) = distance.radius + target_.unit * largest(distance) + target_.smallest +
                         2 * double_unit * (size(distance) + 2 * size(f_[row]));
    right.push_back(distance);
  }
  for (int k = 0; k < n; ++k) {
    Affine m = constant(0, centre_.size());
    for (int l = 0; l < n; ++l) add(m, inverse(k, l), right[static_cast<std::size_t>(l)]);
    result.largest(k) = largest(m);
    result.m.push_back(m);
  }
  for (int k = 0; k < n; ++k) {
    Affine missed = constant(0, centre_.size());
    double sum = size(right[static_cast<std::size_t>(k)]);
    add(missed, -1, right[static_cast<std::size_t>(k)]);
    for (int l = 0; l < n; ++l) {
      const Affine& m = result.m[static_cast<std::size_t>(l)];
      const double g = numbers_.G(active.row(k), active.row(l));
      add(missed, g, m);
      sum += std::abs(g) * size(m);
    }
    result.residual(k) += largest(missed) + (n + 3) * double_unit * sum;
  }
  const MatrixXd sensitivity = inverse.cwiseAbs() + active.inverse_error();
  const VectorXd first = sensitivity * (result.residual + active.residual() * result.largest);
  const VectorXd feedback = sensitivity * (active.residual() * (2 * first).eval());
  if (!((feedback - first).array() <= 0).all()) return {};
  const VectorXd radius = 1.01 * (first + feedback);
  result.largest += radius;
  result.residual = 1.01 * (result.residual + active.residual() * result.largest);
  for (int k = 0; k < n; ++k) result.m[static_cast<std::size_t>(k)].radius = radius(k);
  return result;
}

std::vector<Violation> Certificate::violations(const ActiveRows& active, const Multipliers& known) const {
  std::vector<Violation> result;
  const int n = active.length();
  for (int i = 0; i < rows_; ++i) {
    const std::size_t at = static_cast<std::size_t>(i);
    if (sides_[at] != LimitSide::none) continue;
    Affine z = f_[at];
    double sum = largest(z), sum_here = size(z);
    for (int k = 0; k < n; ++k) {
      const double g = numbers_.G(i, active.row(k));
      const Affine& m = known.m[static_cast<std::size_t>(k)];
      add(z, g, m);
      sum += std::abs(g) * known.largest(k);
      sum_here += std::abs(g) * size(m);
    }
    z.radius += (n + 2) * (target_.unit * sum + double_unit * sum_here + target_.smallest);
    for (int l = 0; l < n; ++l) {
      double rate = 0, error = 0;
      for (int k = 0; k < n; ++k) {
        const double g = numbers_.G(i, active.row(k));
        rate += g * active.inverse()(k, l);
        error += std::abs(g) * (active.inverse_error()(k, l) + 0x1p-50 * std::abs(active.inverse()(k, l)));
      }
      z.radius += (std::abs(rate) + error) * known.residual(l);
    }
    const double left_out = 1.001 * std::max(numbers_.tolerance(i), target_.violation * largest(f_[at]));
    for (const LimitSide side : {LimitSide::low, LimitSide::high}) {
      Affine violation = side == LimitSide::low ? low_[at] : high_[at];
      if (!std::isfinite(violation.middle)) continue;
      violation.radius += z.radius;
      add(violation, -1, z);
      if (side == LimitSide::high) violation = {-violation.middle, -violation.slope, violation.radius};
      violation.radius += 2 * (target_.unit * largest(violation) + double_unit * (size(violation) + size(z)));
      result.push_back({i, side, violation, left_out});
    }
  }
  return result;
}

// Above its tolerance, and scale · violation the largest of those that count.
void Certificate::require_largest(const Violation& worst, const std::vector<Violation>& all) {
  const double scale = numbers_.scale(worst.row), tolerance = numbers_.tolerance(worst.row);
  require(-worst.size.slope, worst.size.middle + worst.size.radius - tolerance);
  for (const Violation& other : all) {
    if (other.row == worst.row) continue;
    const double its = numbers_.scale(other.row);
    const double rounding = 2 * target_.unit * (scale * largest(worst.size) + its * largest(other.size)) +
                            4 * double_unit * (scale * size(worst.size) + its * size(other.size));
    const double left_out = std::max(0.0, its * other.left_out - scale * tolerance);
    require(its * other.size.slope - scale * worst.size.slope,
                scale * (worst.size.middle + worst.size.radius) - its * (other.size.middle - other.size.radius) +
                    left_out + rounding);
  }
}

void Certificate::at_solution(const ActiveRows& active, const Multipliers& known, VectorXd point, int changes,
                              int flat) {
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

void Certificate::append(const Violation& worst, const ActiveRows& active, const Multipliers& known,
                         const VectorXd& point, int changes, int flat) {
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

Ratios Certificate::ratios(const Approach& way, const Multipliers& next) const {
  const ActiveRows& active = way.active;
  const int last = active.length() - 1;
  const MatrixXd &inverse = active.inverse(), &error = active.inverse_error();
  const double own = inverse(last, last), length = 8 * target_.unit * next.largest(last);
  Ratios result;
  for (int k = 0; k < last; ++k) {
    const double sign = active.sign(k) * active.sign(last), ratio = -sign * inverse(k, last) / own;
    const double rate_error = (error(k, last) + std::abs(ratio) * error(last, last)) / (own - error(last, last)) +
                              0x1p-50 * std::abs(ratio);
    const double slowest = ratio - rate_error;
    const Affine& m = next.m[static_cast<std::size_t>(k)];
    Affine position{active.sign(k) * m.middle / ratio, active.sign(k) * m.slope / ratio, 0};
    position.radius = (m.radius + next.largest(k) * rate_error / ratio) / slowest + 4 * double_unit * size(position);
    result.margin.push_back(slowest > 0 ? position.radius + length + 5 * std::max(way.deviation(k), m.radius) / slowest
                                        : std::numeric_limits<double>::infinity());
    result.rate.push_back(ratio);
    result.rate_error.push_back(rate_error);
    result.position.push_back(position);
  }
  return result;
}

void Certificate::approach(const Approach& way, VectorXd point, int changes) {
  if (is_over()) return;
  result_.changes = std::max(result_.changes, changes);
  const ActiveRows& active = way.active;
  const VectorXd centre = centre_, half = half_;
  shrink(point);
  const std::optional<Multipliers> next = active.is_regular(target_.pivot) ? multipliers(active) : std::nullopt;
  if (!next) {
    centre_ = centre;
    half_ = half;
    return admit_rounding();
  }
  const int last = active.length() - 1;
  const std::size_t before = region_.size();
  for (int k = 0; k <= last; ++k) {
    const Affine& m = next->m[static_cast<std::size_t>(k)];
    require(-active.sign(k) * m.slope, active.sign(k) * m.middle + m.radius);
  }
  const double own_g = numbers_.G(active.row(last), active.row(last)), schur = 1 / (active.inverse()(last, last) - active.inverse_error()(last, last));
  const double overshoot = next->m.back().radius + 8 * target_.unit * std::max(way.largest(last), next->largest(last));
  const double lost = way.lost + schur * overshoot * overshoot;
  const bool rises = way.violation > 0 && way.violation * way.violation > 1.01 * own_g * lost;
  if (!region_.is_empty(point))
    at_solution(active, *next, point, changes, rises ? way.flat : static_cast<int>(path_.size()) - 1);
  region_.shorten(before);

  const Ratios all = ratios(way, *next);
  for (int k = 0; k < last; ++k) {
    const std::size_t at = static_cast<std::size_t>(k);
    const Affine& m = next->m[at];
    if (way.is_first && all.rate[at] + all.rate_error[at] < 0 &&
        way.violation * active.inverse()(last, last) * -(all.rate[at] + all.rate_error[at]) >
            1.01 * (m.radius + way.deviation(k)))
      continue;
    require(active.sign(k) * m.slope, m.radius - active.sign(k) * m.middle);
    for (std::size_t j = 0; j < all.margin.size(); ++j)
      if (j != at && std::isfinite(all.margin[at] + all.margin[j]))
        require(all.position[at].slope - all.position[j].slope,
                    all.position[j].middle - all.position[at].middle + all.margin[at] + all.margin[j]);
    if (!region_.is_empty(point)) drop(way, k, *next, all, point, changes);
    region_.shorten(before);
  }

  const Affine& own = next->m.back();
  if (!way.is_first && !(way.violation > 1.01 * own_g * (own.radius + overshoot))) {
    require(active.sign(last) * own.slope, own.radius - active.sign(last) * own.middle);
    if (!region_.is_empty(point)) admit_rounding();
    region_.shorten(before);
  }
  centre_ = centre;
  half_ = half;
}

void Certificate::drop(const Approach& way, int k, const Multipliers& next, const Ratios& ratios,
                       const VectorXd& point, int changes) {
  const int last = way.active.length() - 1;
  const MatrixXd &inverse = way.active.inverse(), &error = way.active.inverse_error();
  const double rounding = 8 * target_.unit, own = inverse(last, last) - error(last, last);
  VectorXd deviation(last), share(last);
  const VectorXd largest = way.largest.cwiseMax(next.largest);
  for (int j = 0; j < last; ++j) {
    const std::size_t at = static_cast<std::size_t>(j);
    const double rate = std::abs(ratios.rate[at]) + ratios.rate_error[at];
    deviation(j) = std::max(way.deviation(j), next.m[at].radius + rate * next.m.back().radius) +
                   rounding * (largest(j) + rate * largest(last));
    // Of the inverse of G of the rows before the last.
    const double product = (std::abs(inverse(j, last)) + error(j, last)) * (std::abs(inverse(last, k)) + error(last, k));
    const double exact = inverse(j, k) - inverse(j, last) * inverse(last, k) / inverse(last, last);
    const double missed = error(j, k) + 0x1p-50 * std::abs(inverse(j, k)) +
                          (product - std::abs(inverse(j, last) * inverse(last, k))) / own +
                          product * (error(last, last) / own + 0x1p-50) / own;
    share(j) = j == k ? exact - missed : std::abs(exact) + missed;
  }
  if (!(share(k) > 0)) return admit_rounding();
  const double its = (deviation(k) + rounding * largest(k)) / share(k);
  Approach after = way;
  after.is_first = false;
  const double schur = 1 / (inverse(last, last) - error(last, last));
  const double overshoot = next.m.back().radius + rounding * largest(last);
  const double missed_k = deviation(k) + rounding * largest(k);
  after.lost += 1.01 * (missed_k * missed_k / share(k) + schur * overshoot * overshoot);
  after.violation -= 1.01 * missed_k * (std::abs(ratios.rate[static_cast<std::size_t>(k)]) + ratios.rate_error[static_cast<std::size_t>(k)]) / share(k);
  after.deviation.resize(last - 1);
  after.largest.resize(last);
  for (int j = 0, to = 0; j <= last; ++j) {
    if (j == k) continue;
    after.largest(to) = largest(j);
    if (j < last) after.deviation(to) = deviation(j) + share(j) * its;
    ++to;
  }
  after.active.drop(k);

  const std::size_t row = static_cast<std::size_t>(way.active.row(k));
  const LimitSide side = sides_[row];
  sides_[row] = LimitSide::none;
  approach(after, point, changes + 1);
  sides_[row] = side;
}

// In which of these parts of u[k−1] each narrowed limit is constant or moves with it.
std::vector<double> parts(const LimitNumbers& numbers, const CertifiedBox& box, Index i) {
  const double low = numbers.low(i), high = numbers.high(i), step = numbers.u_step(i);
  std::vector<double> ends{box.u_low(i), box.u_high(i)};
  for (const double end : {low - step, low + step, high - step, high + step})
    if (end > box.u_low(i) && end < box.u_high(i)) ends.push_back(end);
  std::sort(ends.begin(), ends.end());
  return ends;
}

void certify_part(const LimitNumbers& numbers, const CertificateEffort& effort, const VectorXd& low,
                  const VectorXd& high, CertifiedChanges& result) {
  const VectorXd centre = 0.5 * low + 0.5 * high;
  const VectorXd half_width = (1 + 0x1p-51) * (high - centre).cwiseMax(centre - low);
  Certificate(numbers, effort, centre, half_width, result).search();
}

// All parts of u_i[k−1] and of the inputs after it.
void certify_parts(const LimitNumbers& numbers, const CertifiedBox& box, const CertificateEffort& effort, Index i,
                   VectorXd& low, VectorXd& high, CertifiedChanges& result) {
  if (i == numbers.u_step.size()) return certify_part(numbers, effort, low, high, result);
  const std::vector<double> ends = parts(numbers, box, i);
  for (std::size_t part = 1; part < ends.size(); ++part) {
    low(numbers.law.cols() + i) = ends[part - 1];
    high(numbers.law.cols() + i) = ends[part];
    certify_parts(numbers, box, effort, i + 1, low, high, result);
  }
}

template <class Derived>
MatrixXd in_numbers_of(Scalar real, const Eigen::MatrixBase<Derived>& values) {
  if (real == Scalar::float64) return to_doubles(values);
  return to_floats(values).template cast<double>();
}

}  // namespace

LimitNumbers limit_numbers(const RealMatrix& law, const LimitedRows& rows, const RealVector& u_step, Scalar real) {
  LimitNumbers numbers;
  numbers.law = in_numbers_of(real, law);
  numbers.F = in_numbers_of(real, rows.F);
  numbers.G = in_numbers_of(real, rows.G);
  numbers.scale = in_numbers_of(real, rows.scale);
  numbers.low = in_numbers_of(real, rows.low);
  numbers.high = in_numbers_of(real, rows.high);
  numbers.tolerance = in_numbers_of(real, rows.tolerance);
  numbers.u_step = in_numbers_of(real, u_step);
  numbers.real = real;
  return numbers;
}

CertifiedChanges certify_changes(const LimitNumbers& numbers, const CertifiedBox& box,
                                 const CertificateEffort& effort) {
  const Index nx = numbers.law.cols(), moved = numbers.u_step.size();
  VectorXd low(nx + moved), high(nx + moved);
  low.head(nx) = box.low;
  high.head(nx) = box.high;
  CertifiedChanges result;
  certify_parts(numbers, box, effort, 0, low, high, result);
  return result;
}

}  // namespace lqg::design
