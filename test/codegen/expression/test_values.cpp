// SPDX-License-Identifier: MIT
// Values and slopes of formulas, beside mpmath's; the parameters of a formula.
#include <unity.h>

#include "design/numeric/digits.hpp"
#include "design/rounding.hpp"
#include "expression/bind.hpp"
#include "expression/dual.hpp"
#include "expression/evaluate.hpp"
#include "reference.hpp"

using namespace lqg::expression;
using lqg::design::Digits;
using lqg::design::Real;

namespace {

Tree bound_over_x_and_y(const std::string& text) {
  const auto parsed = parse(text);
  TEST_ASSERT_TRUE_MESSAGE(std::holds_alternative<Tree>(parsed), text.c_str());
  const auto bound = lqg::expression::bind(std::get<Tree>(parsed), [](const std::string& name, std::size_t at) -> Tree {
    return name == "x" ? variable(name, 0, at) : name == "y" ? variable(name, 1, at) : nullptr;
  });
  TEST_ASSERT_TRUE_MESSAGE(std::holds_alternative<Tree>(bound), text.c_str());
  return std::get<Tree>(bound);
}

template <class S, class Variable>
S value(const Tree& tree, const Variable& of) {
  Constants<Real> constants;
  return evaluate<S>(*tree, of, [&](const Node& node) { return S(constants(node)); });
}

void expect_digits(const char* text, const char* expected, const Real& found, double tolerance) {
  const Real wanted(expected);
  const Real error = abs(found - wanted) / (1 + abs(wanted));
  if (error < tolerance) return;
  TEST_FAIL_MESSAGE((std::string(text) + ": expected " + expected + ", found " + found.str(70)).c_str());
}

void test_values_and_slopes_are_those_of_mpmath_in_60_digits() {
  const Digits scope(70);
  const Real at[] = {Real(reference::x), Real(reference::y)};
  for (const reference::Formula& formula : reference::formulas) {
    const Tree tree = bound_over_x_and_y(formula.text);
    expect_digits(formula.text, formula.value, value<Real>(tree, [&](int i) { return at[i]; }), 1e-60);
    const Dual<Real> dual = value<Dual<Real>>(tree, [&](int i) { return Dual<Real>::variable(at[i], i, 2); });
    expect_digits(formula.text, formula.value, dual.value, 1e-60);
    expect_digits(formula.text, formula.by_x, dual.slope(0), 1e-60);
    expect_digits(formula.text, formula.by_y, dual.slope(1), 1e-60);
  }
}

void test_the_same_formula_over_doubles_is_right_to_their_rounding() {
  const double at[] = {reference::x, reference::y};
  Constants<double> constants;
  for (const reference::Formula& formula : reference::formulas) {
    const double found = evaluate<double>(*bound_over_x_and_y(formula.text), [&](int i) { return at[i]; }, constants);
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-14 * (1 + std::abs(found)), std::stod(formula.value), found, formula.text);
  }
}

// (0.1 + 0.2)(3 a − b) with a, b that cancel all but 2⁻⁵²: rounding on the way would leave nothing right.
void test_a_constant_is_exact_over_the_doubles_of_the_text() {
  const Digits scope(100);
  Constants<Real> constants;
  const Real found = constants(*std::get<Tree>(parse("(0.1 + 0.2) - 0.3")));
  TEST_ASSERT_EQUAL_DOUBLE(2.7755575615628914e-17, lqg::design::to_double(found));  // 2⁻⁵⁵, by fractions in Python
}

void test_a_parameter_is_computed_once_however_often_it_is_named() {
  Tree doubled = number(1);
  for (int i = 0; i < 200; ++i) {
    const Tree before = parameter("p" + std::to_string(i), doubled);
    doubled = operation(Operation::add, {before, before});
  }
  Constants<double> constants;
  TEST_ASSERT_EQUAL_DOUBLE(std::ldexp(1.0, 200), constants(*doubled));  // 2²⁰⁰ additions otherwise
}

void test_a_whole_exponent_is_made_of_products_also_of_a_parameter() {
  TEST_ASSERT_EQUAL_INT(-3, *whole_exponent(*std::get<Tree>(parse("-3"))));
  TEST_ASSERT_EQUAL_INT(4, *whole_exponent(*parameter("n", number(4))));
  TEST_ASSERT_FALSE(whole_exponent(*number(2.5)).has_value());
  TEST_ASSERT_FALSE(whole_exponent(*number(1000)).has_value());
  TEST_ASSERT_EQUAL_DOUBLE(-27.0, whole_power(-3.0, 3));  // e^(3 ln(−3)) would be NaN
  TEST_ASSERT_EQUAL_DOUBLE(1.0, whole_power(0.0, 0));
}

void test_a_slope_at_a_kink_is_that_of_one_side() {
  const auto slope_of_abs = [](double at) { return abs(Dual<double>::variable(at, 0, 1)).slope(0); };
  TEST_ASSERT_EQUAL_DOUBLE(-1, slope_of_abs(-2));
  TEST_ASSERT_EQUAL_DOUBLE(1, slope_of_abs(2));
  const Dual<double> x = Dual<double>::variable(1, 0, 2), y = Dual<double>::variable(1, 1, 2);
  TEST_ASSERT_EQUAL_DOUBLE(1, minimum(x, y).slope(0));
  TEST_ASSERT_EQUAL_DOUBLE(0, minimum(x, y).slope(1));
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_values_and_slopes_are_those_of_mpmath_in_60_digits);
  RUN_TEST(test_the_same_formula_over_doubles_is_right_to_their_rounding);
  RUN_TEST(test_a_constant_is_exact_over_the_doubles_of_the_text);
  RUN_TEST(test_a_parameter_is_computed_once_however_often_it_is_named);
  RUN_TEST(test_a_whole_exponent_is_made_of_products_also_of_a_parameter);
  RUN_TEST(test_a_slope_at_a_kink_is_that_of_one_side);
  return UNITY_END();
}
