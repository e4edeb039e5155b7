// SPDX-License-Identifier: MIT
// A part of a box that linear inequalities cut out, and a proof that nothing is left of it.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace lqg::design {

// {ξ: |ξ_j| ≤ 1, slope_i·ξ ≤ bound_i}
class Region {
 public:
  explicit Region(Eigen::Index dimension) : dimension_(dimension) {}

  std::size_t size() const { return bounds_.size(); }
  void shorten(std::size_t size);
  // What holds in the whole box, and what is not a number, is left out. slope·ξ ≤ bound − tightening Σ_j |slope_j|.
  void add(const Eigen::VectorXd& slope, double bound, double tightening);

  // Whether no ξ is in it. A linear program in doubles proposes multipliers y ≥ 0; they count only if Σ y_i (slope_i·ξ
  // − bound_i) > 0 in the whole box is certain in spite of rounding (Farkas). So `true` is a proof, `false` is none of
  // the opposite. `witness`: a point to begin with; where there is one in the region, that.
  bool is_empty(Eigen::VectorXd& witness) const;

 private:
  friend class Separation;

  Eigen::Index dimension_;
  std::vector<double> slopes_;  // one row after the other, each with Σ_j |slope_j| = 1
  std::vector<double> bounds_;
};

}  // namespace lqg::design
