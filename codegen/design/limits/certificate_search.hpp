// SPDX-License-Identifier: MIT
// The tree of decisions behind certificate.hpp. codegen/design/README.md has the method.
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "design/limits/active_rows.hpp"
#include "design/limits/certificate.hpp"
#include "design/limits/region.hpp"

namespace lqg::design::certificate {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Those of src/mpc.c: what of a pivot, and of a violation, counts as nothing, as a share of G_ii and of f_i.
struct Target {
  double unit, smallest, pivot, violation;
};
inline constexpr Target target_float{0x1p-24, FLT_MIN, 0x1p-20, 0x1p-20};
inline constexpr Target target_double{0x1p-53, DBL_MIN, 0x1p-46, 0x1p-49};

// middle + slope·ξ, within radius, for every ξ of the box at hand.
struct Affine {
  double middle = 0;
  VectorXd slope;
  double radius = 0;
};

inline Affine constant(double value, Index dimension) { return {value, VectorXd::Zero(dimension), 0}; }

inline void add(Affine& to, double factor, const Affine& a) {
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

// Goes through all decisions of the solver for the states of one box.
class Search {
 public:
  // The box's first coordinates are x, the others u[k−1].
  Search(const LimitNumbers& numbers, const CertificateEffort& effort, const VectorXd& centre,
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
  double overshoot(const Approach& way, const Multipliers& next) const;
  bool rises(const Approach& way, const Multipliers& next) const;
  bool cannot_leave(const Approach& way, int k, const Multipliers& next, const Ratios& ratios) const;
  std::optional<Approach> without(const Approach& way, int k, const Multipliers& next, const Ratios& ratios) const;

  void at_solution(const ActiveRows& active, const Multipliers& known, VectorXd point, int changes, int flat);
  void append(const Violation& worst, const ActiveRows& active, const Multipliers& known, const VectorXd& point,
              int changes, int flat);
  void approach(const Approach& way, VectorXd point, int changes);
  void reach_end(const Approach& way, const Multipliers& next, VectorXd& point, int changes);
  void meet_zeros(const Approach& way, const Multipliers& next, VectorXd& point, int changes);
  void check_last(const Approach& way, const Multipliers& next, VectorXd& point);
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

}  // namespace lqg::design::certificate
