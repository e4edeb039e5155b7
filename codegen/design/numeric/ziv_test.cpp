// SPDX-License-Identifier: MIT
#include "design/numeric/ziv_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "design/rounding.hpp"

namespace lqg::design {

namespace {

bool round_alike(const Real& a, const Real& b) { return to_double(a) == to_double(b) && to_float(a) == to_float(b); }

// The number midway between the roundings of low and high when these are two neighbours, else NaN.
template <typename Scalar>
Real middle_of(Scalar low, Scalar high) {
  const bool neighbours = low != high && std::nextafter(low, high) == high;
  return neighbours ? Real((Real(low) + Real(high)) / 2) : Real(std::numeric_limits<double>::quiet_NaN());
}

// Both numbers within their digits' rounding of the same middle.
bool is_tie(const Real& coarse, const Real& fine, const Real& middle, unsigned digits) {
  return isfinite(middle) && abs(coarse - middle) <= power_of_ten(-0.6 * digits) * abs(middle) &&
         abs(fine - middle) <= negligible(0.6) * abs(middle);
}

bool settle_span(const Real* coarse, Real* fine, Index count, unsigned coarse_digits) {
  Real scale;
  for (Index i = 0; i < count; ++i) scale = std::max<Real>(scale, abs(fine[i]));
  bool settled = true;
  for (Index i = 0; i < count; ++i) settled = passes_ziv_test(coarse[i], fine[i], scale, coarse_digits) && settled;
  return settled;
}

// Nothing but rounding: it shrinks as the digits grow, while a true number stays what it is.
bool is_rounding(const Real& coarse, const Real& fine, const Real& scale, unsigned coarse_digits) {
  const double more = Real::default_precision() - static_cast<double>(coarse_digits);
  return abs(coarse) <= power_of_ten(-0.6 * coarse_digits) * scale && abs(fine) <= negligible(0.6) * scale &&
         (coarse.is_zero() || abs(fine) <= power_of_ten(-0.6 * more) * abs(coarse));
}

// A pole at 0 that one run met exactly is only nearly there in the next.
bool settle_part(const Real& coarse, Real& fine) {
  if (!isfinite(fine) || !isfinite(coarse)) return false;
  const Real distance = abs(fine - coarse);
  if (round_alike(fine - distance, fine + distance)) return true;
  if (abs(fine) > 1e-20 || (!coarse.is_zero() && abs(fine) > 1e-5 * abs(coarse))) return false;
  fine = 0;
  return true;
}

}  // namespace

bool passes_ziv_test(const Real& coarse, Real& fine, const Real& scale, unsigned coarse_digits) {
  if (!isfinite(fine) || !isfinite(coarse)) return false;
  const Real distance = 2 * abs(fine - coarse), low = fine - distance, high = fine + distance;
  if (fine.is_zero()) fine = 0;  // without a sign
  if (round_alike(low, high)) return true;
  if (is_rounding(coarse, fine, scale, coarse_digits)) {
    fine = 0;
    return true;
  }
  for (const Real& middle : {middle_of(to_double(low), to_double(high)), middle_of(to_float(low), to_float(high))})
    if (is_tie(coarse, fine, middle, coarse_digits)) {
      fine = middle;
      return true;
    }
  return false;
}

bool passes_ziv_test(const RealMatrix& coarse, RealMatrix& fine, unsigned coarse_digits) {
  return coarse.rows() == fine.rows() && coarse.cols() == fine.cols() &&
         settle_span(coarse.data(), fine.data(), fine.size(), coarse_digits);
}

bool passes_ziv_test(const RealVector& coarse, RealVector& fine, unsigned coarse_digits) {
  return coarse.size() == fine.size() && settle_span(coarse.data(), fine.data(), fine.size(), coarse_digits);
}

bool passes_ziv_test(const std::vector<ComplexReal>& coarse, std::vector<ComplexReal>& fine) {
  std::vector<ComplexReal> left = coarse;
  bool settled = coarse.size() == fine.size();
  for (ComplexReal& pole : fine) {
    if (left.empty()) return false;
    const auto distance = [&](const ComplexReal& other) { return Real(hypot(other.re - pole.re, other.im - pole.im)); };
    const auto nearest = std::min_element(left.begin(), left.end(), [&](const ComplexReal& a, const ComplexReal& b) {
      return distance(a) < distance(b);
    });
    settled = settle_part(nearest->re, pole.re) && settled;
    settled = settle_part(nearest->im, pole.im) && settled;
    left.erase(nearest);
  }
  return settled;
}

}  // namespace lqg::design
