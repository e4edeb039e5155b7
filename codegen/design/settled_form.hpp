// SPDX-License-Identifier: MIT
// A form of a solution in other coordinates, whose numbers round correctly: what all such forms share.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "design/numeric/poles.hpp"
#include "design/numeric/ziv_test.hpp"
#include "design/problem.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

constexpr unsigned least_digits_of_form = 100;  // of which half have to settle what is emitted

// What may be lost in such a form: half of the digits of the target's numbers.
inline double largest_condition(Scalar scalar) {
  return scalar == Scalar::float32 ? std::sqrt(1 / static_cast<double>(std::numeric_limits<float>::epsilon()))
                                   : std::sqrt(1 / std::numeric_limits<double>::epsilon());
}

// A form, or why there is none: the flags tell of obstacles that want words of their own.
template <class Form>
struct Settled {
  std::optional<Form> form;
  std::string obstacle;             // of an ill-conditioned form: "5e+03, in float at most 2.9e+03 will do"
  bool is_singular = false;         // it could not be made
  bool is_ill_conditioned = false;  // its `condition` is beyond largest_condition()
};

// Made twice by `make()`: with these digits, and with half of them, which stands in for a coarser run of the design.
// visit_both(a, b, visit) visits each matrix of two forms beside each other.
template <class Form, class Make, class VisitBoth>
Settled<Form> settled_form(unsigned digits_of_solution, Scalar scalar, Make make, VisitBoth visit_both) {
  const unsigned digits = std::max(digits_of_solution, least_digits_of_form);
  const std::string name = scalar == Scalar::float32 ? "float" : "double";
  std::optional<Form> coarse;
  {
    const Digits half(digits / 2);
    coarse = make();
  }
  const Digits scope(digits);
  Settled<Form> result;
  std::optional<Form> fine = make();
  result.is_singular = !coarse || !fine;
  if (result.is_singular) return result;
  const double most = largest_condition(scalar);
  result.is_ill_conditioned = !(fine->condition <= most);
  if (result.is_ill_conditioned) {
    result.obstacle = short_number(fine->condition) + ", in " + name + " at most " + short_number(most) + " will do";
    return result;
  }
  bool is_settled = true, fits = true;
  visit_both(*coarse, *fine, [&](const auto& before, auto& after) {
    is_settled = passes_ziv_test(before, after, digits / 2) && is_settled;
    for (Index i = 0; i < after.size(); ++i)
      fits = fits && std::isfinite(scalar == Scalar::float32 ? static_cast<double>(to_float(after.data()[i]))
                                                             : to_double(after.data()[i]));
  });
  if (!is_settled) result.obstacle = std::to_string(digits / 2) + " digits do not settle its numbers";
  if (is_settled && !fits) result.obstacle = "a number of it is too large for " + name;
  if (is_settled && fits) result.form = std::move(fine);
  return result;
}

}  // namespace lqg::design
