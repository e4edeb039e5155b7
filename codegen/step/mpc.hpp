// SPDX-License-Identifier: MIT
// The law with limits that are foreseen, as lqg/mpc.h has it: the same operations in the same order, so the same bits.
//
// For scalars that compute with numbers: how often it loops depends on them.
#pragma once

#include <limits>
#include <type_traits>
#include <vector>

#include "step/model.hpp"
#include "step/scalar.hpp"

namespace lqg::step {

template <class S>
struct LimitedInput {
  Vector<S> u;
  bool is_optimal = false, is_limited = false;
  unsigned changes = 0;             // of the set of active limits
  std::vector<int> active = {};     // rows, in the order in which they were taken
  std::vector<S> multipliers = {};  // theirs
};

namespace detail {

// What of a pivot, and of a violation, is nothing but rounding: a share of G_ii and of f_i.
template <class S>
struct Negligible {
  static constexpr double pivot = 0x1p-46, violation = 0x1p-49;
};
template <>
struct Negligible<float> {
  static constexpr double pivot = 0x1p-20, violation = 0x1p-20;
};
template <>
struct Negligible<Fused<float>> : Negligible<float> {};

template <class S>
class Optimum {
 public:
  Optimum(const LimitedLaw<S>& law, const Vector<S>& u_applied, const Vector<S>& x, const Vector<S>& u)
      : law_(law), rows_(static_cast<int>(law.G.rows())), low_(law.low), high_(law.high), f_(rows_),
        side_(static_cast<std::size_t>(rows_), Side::none) {
    for (int i = 0; i < law.nu && law.u_step.size(); ++i) narrow(i, u_applied(i));
    for (int i = 0; i < rows_; ++i) f_(i) = i < law.nu ? S(u(i)) : product(i - law.nu, x);
  }
  LimitedInput<S> find() {
    LimitedInput<S> found;
    const bool is_found = search(found.changes);
    found.is_optimal = is_found;
    found.u.resize(law_.nu);
    for (int i = 0; i < law_.nu; ++i) take(i, is_found, found);
    found.active = active_;
    found.multipliers = m_;
    return found;
  }

 private:
  enum class Side { none, low, high };
  static constexpr int contradiction = -1;
  static constexpr double farthest = 0x1p120;  // no multiplier goes farther along a direction

  Side side(int row) const { return side_[static_cast<std::size_t>(row)]; }
  int length() const { return static_cast<int>(active_.size()); }
  int row(int k) const { return active_[static_cast<std::size_t>(k)]; }
  S& L(int i, int j) { return L_[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]; }
  static S& at(std::vector<S>& values, int k) { return values[static_cast<std::size_t>(k)]; }
  static const S& at(const std::vector<S>& values, int k) { return values[static_cast<std::size_t>(k)]; }
  S limit(int row) const { return side(row) == Side::low ? low_(row) : high_(row); }

  void narrow(int i, const S& applied) {
    const S low = low_(i), high = high_(i), lowest = applied - law_.u_step(i), highest = applied + law_.u_step(i);
    if (is_less(low, lowest)) low_(i) = is_less(lowest, high) ? lowest : high;
    if (is_less(highest, high)) high_(i) = is_less(low, highest) ? highest : low;
  }
  S product(int row, const Vector<S>& x) const {
    S sum(0);
    for (int j = 0; j < x.size(); ++j) sum = multiply_add(S(law_.F(row, j)), S(x(j)), sum);
    return sum;
  }
  S foreseen(int row) const {
    S z = f_(row);
    for (int k = 0; k < length(); ++k) z = multiply_add(S(law_.G(row, this->row(k))), at(m_, k), z);
    return z;
  }

  int most_violated() {
    int worst = rows_;
    Side side = Side::none;
    S largest(0);
    for (int i = 0; i < rows_ && length() < rows_; ++i) {
      if (this->side(i) != Side::none) continue;
      const S z = foreseen(i), below = low_(i) - z, above = z - high_(i);
      const bool is_below = is_less(above, below);
      const S violation = is_below ? below : above, scaled = violation * law_.scale(i);
      const S rounding = S(Negligible<S>::violation) * absolute(S(f_(i)));
      if (!is_less(law_.tolerance(i), violation) || !is_less(largest, scaled) || !is_less(rounding, violation))
        continue;
      largest = scaled;
      worst = i;
      side = is_below ? Side::low : Side::high;
    }
    if (worst < rows_) side_[static_cast<std::size_t>(worst)] = side;
    return worst;
  }

  void substitute(int k) {
    S sum = limit(row(k)) - f_(row(k));
    for (int j = 0; j < k; ++j) sum = multiply_subtract(L(k, j), at(y_, j), sum);
    at(y_, k) = sum;
  }
  void append(int row) {
    const int n = length();
    std::vector<S> product, last;
    S d = law_.G(row, row);
    for (int j = 0; j < n; ++j) {
      S g = law_.G(row, this->row(j));
      for (int i = 0; i < j; ++i) g = multiply_subtract(L(j, i), at(product, i), g);
      product.push_back(g);
      last.push_back(g / at(d_, j));
      d = multiply_subtract(last.back(), g, d);
    }
    L_.push_back(last);
    d_.push_back(is_less(S(S(Negligible<S>::pivot) * law_.G(row, row)), d) ? d : S(0));
    m_.push_back(S(0));
    y_.push_back(S(0));
    active_.push_back(row);
    substitute(n);
  }
  void drop(int k) {
    const int n = length();
    std::vector<S> p(active_.size()), beta(active_.size());
    S alpha = at(d_, k);
    side_[static_cast<std::size_t>(row(k))] = Side::none;
    for (int i = k + 1; i < n; ++i) {
      S rest = L(i, k);
      for (int j = k + 1; j < i; ++j) {
        rest = multiply_subtract(at(p, j), L(i, j), rest);
        L(i, j) = multiply_add(at(beta, j), rest, L(i, j));
      }
      const S part = alpha * rest, d = multiply_add(part, rest, at(d_, i));
      const bool is_positive = is_less(S(0), d);
      at(p, i) = rest;
      at(beta, i) = is_positive ? part / d : S(0);
      if (is_positive) alpha = alpha * at(d_, i) / d;
      at(d_, i) = d;
      L_[static_cast<std::size_t>(i)].erase(L_[static_cast<std::size_t>(i)].begin() + k);
    }
    for (auto* values : {&d_, &m_, &y_}) values->erase(values->begin() + k);
    L_.erase(L_.begin() + k);
    active_.erase(active_.begin() + k);
    for (int j = k; j < length(); ++j) substitute(j);
  }

  // The slot whose multiplier changes its sign first, or length(), or that limits contradict each other.
  int advance() {
    const int n = length();
    if (n == 0) return 0;
    const S pivot = S(Negligible<S>::pivot) * law_.G(row(n - 1), row(n - 1));
    const bool is_singular = !is_less(pivot, at(d_, n - 1));
    std::vector<S> next(active_.size());
    for (int j = 0; j < n; ++j) at(next, j) = is_singular ? S(0) : S(at(y_, j) / at(d_, j));
    if (is_singular) at(next, n - 1) = S(side(row(n - 1)) == Side::low ? 1 : -1);
    for (int j = n; j-- > 1;)
      for (int i = 0; i < j; ++i) at(next, i) = multiply_subtract(L(j, i), at(next, j), at(next, i));
    int blocking = n;
    S share(is_singular ? farthest : 1);
    for (int k = 0; k < n; ++k) {
      const S& wanted = at(next, k);
      if (side(row(k)) == Side::low ? !is_less(wanted, S(0)) : !is_less(S(0), wanted)) continue;
      const S possible = at(m_, k) / (is_singular ? S(S(0) - wanted) : S(at(m_, k) - wanted));
      if (is_less(possible, share))
        share = possible;
      else if (blocking != n)
        continue;
      blocking = k;
    }
    if (!is_less(S(0), share)) share = S(0);
    if (blocking == n && is_singular) return contradiction;
    for (int k = 0; k < n; ++k) {
      const S step = is_singular ? at(next, k) : S(at(next, k) - at(m_, k));
      at(m_, k) = blocking == n ? at(next, k) : multiply_add(share, step, at(m_, k));
    }
    return blocking;
  }

  bool search(unsigned& changes) {
    int blocking = 0;
    for (changes = 0; changes <= law_.iterations && blocking != contradiction; ++changes) {
      const bool is_solved = blocking == length();
      const bool is_rounding = !is_solved && blocking == length() - 1 && is_zero(at(m_, blocking));
      const int row = is_solved ? most_violated() : rows_;
      if (!is_solved) drop(blocking);
      if (is_rounding || (is_solved && row == rows_)) return true;
      if (changes == law_.iterations) break;
      if (is_solved) append(row);
      blocking = advance();
    }
    return false;
  }

  void take(int i, bool is_found, LimitedInput<S>& found) const {
    const bool is_active = is_found && side(i) != Side::none;
    const S wanted = is_active ? limit(i) : is_found ? foreseen(i) : S(f_(i));
    const bool has_number = is_finite(wanted);
    const S given = has_number ? wanted : S(0);
    const bool is_low = is_less(given, S(low_(i))), is_high = !is_low && is_less(S(high_(i)), given);
    found.u(i) = is_low ? S(low_(i)) : is_high ? S(high_(i)) : given;
    found.is_optimal = found.is_optimal && has_number;
    found.is_limited = found.is_limited || is_active || is_low || is_high || !has_number;
  }

  const LimitedLaw<S>& law_;
  int rows_;
  Vector<S> low_, high_, f_;
  std::vector<Side> side_;
  std::vector<int> active_;
  std::vector<S> d_, y_, m_;
  std::vector<std::vector<S>> L_;
};

}  // namespace detail

// The u nearest to optimal of a law's u without limits: lqg_mpc_limit. `u_applied` is u[k−1]; MAY be empty without
// u_step.
template <class S>
LimitedInput<S> limited_input(const LimitedLaw<S>& law, const Vector<S>& u_applied, const Vector<S>& x,
                              const Vector<S>& u) {
  return detail::Optimum<S>(law, u_applied, x, u).find();
}

}  // namespace lqg::step
