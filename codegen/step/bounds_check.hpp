// SPDX-License-Identifier: MIT
// The check that all of a state is within its bounds, and that its P can be a covariance.
#pragma once

#include <vector>

#include "step/model.hpp"

namespace lqg::step {

// What stands beside the equation of a block in which x̂ is checked, too.
inline const char* and_check(const std::vector<int>& bounds) {
  return bounds.empty() ? ";  sum_to_x_k = Σ x̂_i, i ≤ k, is finite where each x̂_i is"
                        : ";  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b";
}

// Σ (x_i/b_i)² + Σ P_ii/b_i² < 1 with bounds b that are powers of two, no P_ii negative, and all that has no bound
// finite. No term is negative and rounding is monotone, so each |x_i| is below b_i and each P_ii below b_i²; a NaN is
// not below anything.
//
// The sum is kept in units of the last b²: scaling by a power of two is exact, and states of one bound are not scaled
// at all. What has no bound is added up by itself: the sum is finite if and only if each term is, short of an overflow
// that no honest state comes near. Each part is added as it is found, and each sum has a name, so that none has to wait
// for the last. A variance that is negative is none: its sign is looked at by itself.
template <class S>
class BoundsCheck {
 public:
  using Condition = decltype(is_less(S(), S()));

  // Part place.i of a vector whose bounds are 2^bounds; an empty one: it has to be finite.
  template <class Listener>
  void add(const S& part, const std::vector<int>& bounds, const Place& place, Listener& listener) {
    if (bounds.empty()) return add(part, place, listener);
    sum_ = multiply_add(part, part, in_units_of(bounds[static_cast<std::size_t>(place.i)]));
    listener.name(sum_, "squares_to", place);
  }
  // Likewise P_ii of part i, or what stands for it.
  template <class Listener>
  void add_variance(const S& variance, const std::vector<int>& bounds, const Place& place, Listener& listener) {
    require(negation(is_less(variance, S(0))));
    if (bounds.empty()) return add(variance, place, listener);
    sum_ = in_units_of(bounds[static_cast<std::size_t>(place.i)]) + variance;
    listener.name(sum_, "squares_to", place);
  }
  // What has to be finite.
  template <class Listener>
  void add(const S& part, const Place& place, Listener& listener) {
    others_ = has_others_ ? S(others_ + part) : part;
    has_others_ = true;
    listener.name(others_, "sum_to", place);
  }

  // What has to be true besides.
  void require(const Condition& condition) { conditions_.push_back(condition); }

  Condition is_within() const {
    Condition all = is_bounded();
    for (const Condition& condition : conditions_) all = both(all, condition);
    return all;
  }

 private:
  Condition is_bounded() const {
    const S limit = PowerOfTwo<S>::of(2 * unit_);
    if (!has_others_) return is_less(sum_, limit);
    return has_sum_ ? is_usable(others_, S(limit - sum_)) : is_finite(others_);
  }
  S in_units_of(int bound) {
    const S scaled = has_sum_ && bound != unit_ ? S(PowerOfTwo<S>::of(2 * (bound - unit_)) * sum_) : sum_;
    has_sum_ = true;
    unit_ = bound;
    return scaled;
  }

  S sum_ = S(0), others_ = S(0);
  std::vector<Condition> conditions_;
  bool has_sum_ = false, has_others_ = false;
  int unit_ = 0;  // the sum counts in units of 2^(2 unit)
};

}  // namespace lqg::step
