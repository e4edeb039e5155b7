// SPDX-License-Identifier: MIT
// The values of formulas without variables, in many digits.
#pragma once

#include <map>
#include <variant>

#include "design/real.hpp"
#include "expression/parse.hpp"

namespace lqg::input {

// Values in one number of digits. Each parameter is computed once.
class ValuesInDigits {
 public:
  explicit ValuesInDigits(unsigned digits) : digits_(digits) {}
  std::variant<design::Real, expression::Fault> operator()(const expression::Node& node);

 private:
  design::Real value(const expression::Node& node);
  design::Real parameter(const expression::Node& value_of_it);
  design::Real result(const expression::Node& node);

  unsigned digits_;
  std::map<const expression::Node*, design::Real> parameters_;
};

// The value over the doubles that the numbers of the texts are, with more digits than any design takes. What is below
// all of these digits, as sin(pi) and 1/3*3 − 1, is 0. Or what is no finite number, as 1/0 and sqrt(−1), and what no
// double could hold.
class ExactValues {
 public:
  std::variant<design::Real, expression::Fault> operator()(const expression::Node& node);

 private:
  ValuesInDigits few_, many_, most_;

 public:
  ExactValues();
};

}  // namespace lqg::input
