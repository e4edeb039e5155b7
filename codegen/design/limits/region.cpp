// SPDX-License-Identifier: MIT
#include "design/limits/region.hpp"

#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace lqg::design {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The smallest Σ y_i bound_i + Σ_j |Σ_i y_i slope_ij| with y ≥ 0 and Σ y = 1, by the simplex method with the inverse of
// its basis; |…| is the sum of two variables ≥ 0. Below 0, y proves that the region is empty. What belongs to Σ y = 1
// and to each j is, with its sign, the largest slack that all inequalities have, and the point that has it.
class Separation {
 public:
  Separation(const Region& region, Index first)
      : region_(region), count_(static_cast<Index>(region.size())), size_(region.dimension_ + 1),
        inverse_(MatrixXd::Identity(size_, size_)), basis_(static_cast<std::size_t>(size_)) {
    basis_[0] = first;
    for (Index j = 0; j + 1 < size_; ++j) {
      const double slope = row(first)[j];
      const bool is_positive = slope >= 0;
      basis_[static_cast<std::size_t>(j + 1)] = count_ + 2 * j + (is_positive ? 0 : 1);
      inverse_(j + 1, j + 1) = is_positive ? -1 : 1;
      inverse_(j + 1, 0) = std::abs(slope);
    }
  }

  bool proves_emptiness(VectorXd& witness) {
    const Index most = 20 * size_ + 200;
    int rebuilt = 0;
    for (Index step = 0; step < most; ++step) {
      if (value() < 0 && is_proof()) return true;
      const VectorXd prices = inverse_.transpose() * costs();
      const Index entering = find_entering(prices, step > most / 2);
      if (has_point_) witness = prices.tail(size_ - 1);
      if (has_point_) return false;
      if (entering >= 0 && exchange(entering)) continue;
      if (value() > 0 || rebuilt++ == 2) return false;
      rebuild();
    }
    return false;
  }

 private:
  static constexpr double negligible = 1e-14, smallest_pivot = 1e-11;

  const double* row(Index i) const { return region_.slopes_.data() + i * (size_ - 1); }
  double cost(Index variable) const {
    return variable < count_ ? region_.bounds_[static_cast<std::size_t>(variable)] : 1;
  }
  VectorXd costs() const {
    VectorXd result(size_);
    for (Index i = 0; i < size_; ++i) result(i) = cost(basis_[static_cast<std::size_t>(i)]);
    return result;
  }
  double value() const { return costs().dot(inverse_.col(0)); }

  // The variable that lowers the value most; when that goes on too long the first that does (Bland). −1: none.
  Index find_entering(const VectorXd& prices, bool takes_first) {
    Index best = -1;
    double lowest = -negligible, slack = std::numeric_limits<double>::infinity();
    const auto look = [&](Index variable, double reduced) {
      if (reduced < lowest && !(takes_first && best >= 0)) {
        lowest = reduced;
        best = variable;
      }
    };
    for (Index i = 0; i < count_; ++i) {
      double left = cost(i);
      for (Index j = 0; j + 1 < size_; ++j) left -= row(i)[j] * prices(j + 1);
      slack = std::min(slack, left);
      look(i, left - prices(0));
    }
    for (Index j = 0; j + 1 < size_; ++j) {
      slack = std::min(slack, 1 - std::abs(prices(j + 1)));
      look(count_ + 2 * j, 1 + prices(j + 1));
      look(count_ + 2 * j + 1, 1 - prices(j + 1));
    }
    has_point_ = slack >= 0;
    return best;
  }

  VectorXd column_of(Index variable) const {
    VectorXd column = VectorXd::Zero(size_);
    if (variable < count_) {
      column(0) = 1;
      for (Index j = 0; j + 1 < size_; ++j) column(j + 1) = row(variable)[j];
    } else {
      column((variable - count_) / 2 + 1) = (variable - count_) % 2 ? 1 : -1;
    }
    return column;
  }
  // Without the rounding of all exchanges.
  void rebuild() {
    MatrixXd columns(size_, size_);
    for (Index i = 0; i < size_; ++i) columns.col(i) = column_of(basis_[static_cast<std::size_t>(i)]);
    inverse_ = Eigen::PartialPivLU<MatrixXd>(columns).inverse();
  }
  bool exchange(Index entering) {
    const VectorXd column = inverse_ * column_of(entering);
    Index leaving = -1;
    for (Index i = 0; i < size_; ++i)
      if (column(i) > smallest_pivot && (leaving < 0 || is_before(column, i, leaving))) leaving = i;
    if (leaving < 0) return false;
    inverse_.row(leaving) /= column(leaving);
    for (Index i = 0; i < size_; ++i)
      if (i != leaving) inverse_.row(i) -= column(i) * inverse_.row(leaving);
    basis_[static_cast<std::size_t>(leaving)] = entering;
    return true;
  }
  bool is_before(const VectorXd& column, Index a, Index b) const {
    const double left = inverse_(a, 0) * column(b), right = inverse_(b, 0) * column(a);
    if (left != right) return left < right;
    return basis_[static_cast<std::size_t>(a)] < basis_[static_cast<std::size_t>(b)];
  }

  // The multipliers of the basis, made ≥ 0, with all that rounding may do to the sums.
  bool is_proof() const {
    VectorXd combined = VectorXd::Zero(size_ - 1);
    double value = 0, size = 0;
    for (Index i = 0; i < size_; ++i) {
      const Index variable = basis_[static_cast<std::size_t>(i)];
      const double y = inverse_(i, 0);
      if (variable >= count_ || !(y > 0)) continue;
      for (Index j = 0; j + 1 < size_; ++j) combined(j) += y * row(variable)[j];
      value += y * cost(variable);
      size += y * (std::abs(cost(variable)) + 1);
    }
    return value + combined.cwiseAbs().sum() + static_cast<double>(2 * size_ + 4) * 0x1p-52 * size < 0;
  }

  const Region& region_;
  Index count_, size_;
  MatrixXd inverse_;
  std::vector<Index> basis_;  // inequality i; behind them two variables of each j, for + and −
  bool has_point_ = false;
};

void Region::shorten(std::size_t size) {
  bounds_.resize(size);
  slopes_.resize(size * static_cast<std::size_t>(dimension_));
}

void Region::add(const VectorXd& slope, double bound, double tightening) {
  const double size = slope.cwiseAbs().sum();
  if (!std::isfinite(size) || !std::isfinite(bound) || !(size < 1e300) || bound >= size * (1 + tightening)) return;
  const double scale = size > 0 ? 1 / size : 1 / std::abs(bound);
  for (Index j = 0; j < dimension_; ++j) slopes_.push_back(slope(j) * scale);
  bounds_.push_back(bound * scale + 0x1p-50 * (1 + std::abs(bound * scale)) - tightening);
}

bool Region::is_empty(VectorXd& witness) const {
  double smallest = 0;
  Index worst = -1;
  for (std::size_t i = 0; i < size(); ++i) {
    double slack = bounds_[i];
    for (Index j = 0; j < dimension_; ++j)
      slack -= slopes_[i * static_cast<std::size_t>(dimension_) + static_cast<std::size_t>(j)] * witness(j);
    if (slack < smallest) {
      smallest = slack;
      worst = static_cast<Index>(i);
    }
  }
  return worst >= 0 && Separation(*this, worst).proves_emptiness(witness);
}

}  // namespace lqg::design
