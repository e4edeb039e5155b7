// SPDX-License-Identifier: MIT
// Operating points and slopes of equations: beside mpmath, and what is refused.
#include <algorithm>
#include <cmath>
#include <string>

#include <unity.h>

#include "../plant_of_equations.hpp"
#include "design/linearise.hpp"
#include "design/rounding.hpp"
#include "linearisation_reference.hpp"

using namespace lqg::design;
using lqg_test::Texts;

namespace {

struct Case {
  Case(Domain domain, const Texts& states, const Texts& inputs, const Texts& f, const Texts& h, const Texts& values,
       const Texts& steady)
      : plant(lqg_test::plant_of(domain, states, inputs, f, h)) {
    using lqg_test::tree_of;
    for (const std::string& value : values) {
      const bool is_open = value[0] == '?';
      point.values.push_back(is_open ? nullptr : tree_of(value, plant));
      point.starts.push_back(is_open && value.size() > 1 ? tree_of(value.substr(1), plant) : nullptr);
    }
    for (const std::string& state : states)
      point.is_steady.push_back(std::find(steady.begin(), steady.end(), state) != steady.end());
  }
  Plant plant;
  WantedPoint point;
};

// Of ẋ = f with one output, all at rest.
Case continuous(const Texts& states, const Texts& inputs, const Texts& f, const Texts& values) {
  return {Domain::continuous, states, inputs, f, {states[0]}, values, states};
}

std::string findings_of(const Case& one) {
  Findings findings;
  const bool is_good = linearise(one.plant, one.point, findings).has_value();
  TEST_ASSERT_EQUAL(is_good, !has_error(findings));
  std::string out;
  for (const Finding& finding : findings) out += finding.key + ": " + finding.message + "\n";
  return out;
}

void expect_refusal(const Case& one, const std::string& expected) {
  const std::string found = findings_of(one);
  TEST_ASSERT_TRUE_MESSAGE(found.rfind(expected, 0) == 0, found.c_str());
}

Linearisation linearised(const Case& one) {
  Findings findings;
  const auto result = linearise(one.plant, one.point, findings);
  TEST_ASSERT_TRUE_MESSAGE(result.has_value(), findings.empty() ? "" : findings[0].message.c_str());
  return *result;
}

void expect_same(double expected, const Real& found, const std::string& what) {
  TEST_ASSERT_TRUE_MESSAGE(expected == to_double(found),
                           (what + ": " + std::to_string(expected) + ", found " + found.str(20)).c_str());
}

void test_points_and_slopes_are_those_of_mpmath_correctly_rounded() {
  for (const LinearisationReference& reference : linearisation_references) {
    const Domain domain = reference.is_continuous ? Domain::continuous : Domain::discrete;
    const Linearisation found = linearised(
        {domain, reference.states, reference.inputs, reference.f, reference.h, reference.values, reference.steady});
    const Eigen::Index nx = found.x.size(), nu = found.u.size();
    for (Eigen::Index i = 0; i < nx + nu; ++i)
      expect_same(reference.point[static_cast<std::size_t>(i)], i < nx ? found.x(i) : found.u(i - nx), reference.name);
    for (Eigen::Index i = 0; i < found.y.size(); ++i)
      expect_same(reference.y[static_cast<std::size_t>(i)], found.y(i), reference.name + ", y");
    for (Eigen::Index i = 0; i < nx + found.y.size(); ++i)
      for (Eigen::Index j = 0; j < nx + nu; ++j) {
        const bool is_f = i < nx, is_x = j < nx;
        const RealMatrix& part = is_f ? (is_x ? found.A : found.B) : (is_x ? found.C : found.D);
        expect_same(reference.slopes[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)],
                    part(is_f ? i : i - nx, is_x ? j : j - nx), reference.name + ", slope");
      }
  }
}

// u = mg sin θ l of a pendulum that is held, θ = arcsin(u/(mgl)) of one that hangs in it.
void test_what_is_found_is_the_closed_form() {
  const Texts pendulum = {"om", "u - 2*sin(th)"};
  expect_same(2 * std::sin(0.5), linearised(continuous({"th", "om"}, {"u"}, pendulum, {"0.5", "0", "?"})).u(0), "u");
  expect_same(std::asin(0.25), linearised(continuous({"th", "om"}, {"u"}, pendulum, {"?", "?", "0.5"})).x(0), "th");
}

void test_a_slope_that_is_zero_is_exactly_zero() {
  const Linearisation found =
      linearised(continuous({"th", "om"}, {"u"}, {"om", "u - sin(th)^2 - cos(th)^2"}, {"0.7", "0", "?"}));
  TEST_ASSERT_TRUE(found.A(1, 0).is_zero());
  const Linearisation upright = linearised(continuous({"th", "om"}, {"u"}, {"om", "u - sin(th)"}, {"pi", "0", "?"}));
  TEST_ASSERT_TRUE(upright.u(0).is_zero());
  expect_same(1, upright.A(1, 0), "upright");
}

void test_another_point_at_rest_is_noted_and_a_start_chooses() {
  const Texts f = {"2 - i^2"};
  const std::string note = findings_of(continuous({"i"}, {}, f, {"?"}));
  TEST_ASSERT_EQUAL_STRING(
      "plant.operating_point: f is 0 at i = 1.414, which is taken, and also at i = -1.414; \"? 0.5\" says where the "
      "search begins\n",
      note.c_str());
  expect_same(-std::sqrt(2), linearised(continuous({"i"}, {}, f, {"?-1"})).x(0), "i");
  TEST_ASSERT_EQUAL_STRING("", findings_of(continuous({"i"}, {}, f, {"?-1"})).c_str());
}

void test_numbers_that_are_rounded_are_at_rest_and_others_are_not() {
  const auto held = [](const std::string& u) {
    return continuous({"z", "v"}, {"u"}, {"v", "9.81 - 3*u/(1 + z)"}, {"0.1", "0", u});
  };
  TEST_ASSERT_EQUAL_STRING("", findings_of(held("3.597")).c_str());
  expect_refusal(held("3.6"), "plant.operating_point: expected a point at rest, found dv/dt = -0.008182; write \"?\"");
}

void test_only_named_states_have_to_be_at_rest() {
  Case driving = continuous({"p", "v"}, {"u"}, {"v", "u - 0.3*v"}, {"0", "2", "?"});
  expect_refusal(driving,
                 "plant.operating_point: nothing was found for \"?\" at which f is 0; nearest is u = 0.6, "
                 "where dp/dt = 2;");
  driving.point.is_steady = {false, true};
  TEST_ASSERT_EQUAL_STRING(
      "plant.operating_point: dp/dt = 2 at this point: the linear plant, and a filter of it, do not know of that\n",
      findings_of(driving).c_str());
  Case standing = continuous({"p", "v"}, {"u"}, {"v", "u - 0.3*v"}, {"0", "0", "?"});
  standing.point.is_steady = {false, true};
  TEST_ASSERT_EQUAL_STRING("", findings_of(standing).c_str());
}

void test_no_point_at_rest_is_refused_with_the_residual() {
  expect_refusal(continuous({"th", "om"}, {"u"}, {"om", "u - sin(th)"}, {"?", "0", "1.5"}),
                 "plant.operating_point: nothing was found for \"?\" at which f is 0; nearest is th = 1.571, where "
                 "dom/dt = 0.5;");
}

void test_what_does_not_matter_is_not_determined() {
  expect_refusal(continuous({"p", "v"}, {"u"}, {"v", "u - v"}, {"?", "0", "?"}),
                 "plant.operating_point: \"?\" of p: not determined by f = 0");
  expect_refusal(continuous({"v"}, {"a", "b"}, {"a + 2*b - v"}, {"1", "?", "?"}),
                 "plant.operating_point: \"?\" of a, b: not determined by f = 0");
  expect_refusal(continuous({"v"}, {"u"}, {"(v - 1)^2"}, {"?", "0"}),
                 "plant.operating_point: \"?\" of v: not determined by f = 0, which touches 0 at v = 1");
}

void test_a_point_without_a_slope_is_refused_with_its_place() {
  const auto refused = [](const std::string& f, const std::string& x, const std::string& reason) {
    expect_refusal(continuous({"x", "v"}, {}, {"v", f}, {x, "0"}),
                   "plant.f[1]: cannot be linearised at the operating point: " + reason);
  };
  refused("0.1*abs(v)", "0", "abs has a kink there (character 5)");
  refused("max(x, 2*x)", "0", "max has a kink there (character 1)");
  refused("min(v, x)", "0", "min has a kink there (character 1)");
  refused("sqrt(x)", "0", "sqrt has no slope at 0 (character 1)");
  refused("sqrt(x)", "-1", "sqrt of a negative number (character 1)");
  refused("v/x", "0", "division by 0 (character 2)");
  refused("x^-2", "0", "division by 0 (character 2)");
  refused("log(x)", "0", "log of a number that is not positive (character 1)");
  refused("asin(x) - asin(1)", "1", "asin has no slope at ±1 (character 1)");
  refused("v*acos(x)", "2", "acos of a number beyond ±1 (character 3)");
  refused("v*tan(x)", "pi/2", "tan is infinite (character 3)");
  refused("v*atan2(v, x)", "0", "atan2(0, 0) (character 3)");
  refused("v*atan2(v, x)", "-1", "atan2 jumps at π (character 3)");
  refused("x^0.5", "0", "a power that is no whole number, of one ≤ 0 (character 2)");
  refused("v*sin(exp(exp(x)))", "20", "a value beyond what a double can be (character 7)");
}

// v|v| is smooth at 0, so is max(v, 0)².
void test_a_kink_that_does_not_matter_is_none() {
  const Linearisation found =
      linearised(continuous({"x", "v"}, {"u"}, {"v", "u - v*abs(v) - max(v, 0)^2 - x"}, {"0", "0", "?"}));
  TEST_ASSERT_TRUE(found.A(1, 1).is_zero());
  expect_same(-1, found.A(1, 0), "x");
}

void test_a_fixed_point_of_a_sampled_plant() {
  const Linearisation found = linearised({Domain::discrete, {"x"}, {"u"}, {"x/2 + u"}, {"x"}, {"3", "?"}, {"x"}});
  expect_same(1.5, found.u(0), "u");
  expect_same(0.5, found.A(0, 0), "A");
  Case grows(Domain::discrete, {"x"}, {}, {"2*x"}, {"x"}, {"1"}, {"x"});
  expect_refusal(grows, "plant.operating_point: expected a point at rest, found x⁺ − x = 1;");
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_points_and_slopes_are_those_of_mpmath_correctly_rounded);
  RUN_TEST(test_what_is_found_is_the_closed_form);
  RUN_TEST(test_a_slope_that_is_zero_is_exactly_zero);
  RUN_TEST(test_another_point_at_rest_is_noted_and_a_start_chooses);
  RUN_TEST(test_numbers_that_are_rounded_are_at_rest_and_others_are_not);
  RUN_TEST(test_only_named_states_have_to_be_at_rest);
  RUN_TEST(test_no_point_at_rest_is_refused_with_the_residual);
  RUN_TEST(test_what_does_not_matter_is_not_determined);
  RUN_TEST(test_a_point_without_a_slope_is_refused_with_its_place);
  RUN_TEST(test_a_kink_that_does_not_matter_is_none);
  RUN_TEST(test_a_fixed_point_of_a_sampled_plant);
  return UNITY_END();
}
