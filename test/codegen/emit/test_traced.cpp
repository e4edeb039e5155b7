// SPDX-License-Identifier: MIT
// What tracing makes of a plant's structure, and what it costs.
#include <regex>

#include <unity.h>

#include "design_text.hpp"
#include "controller/model_of.hpp"
#include "controller/rounding.hpp"
#include "emit/c/header.hpp"
#include "emit/recorded/traced.hpp"
#include "step/loop.hpp"

using namespace lqg_test;
using lqg::emit::Controller;

namespace {

DesignText online(DesignText design, const char* covariance) {
  design.gain = "online";
  design.covariance = covariance;
  return design;
}

// States 2k and 2k + 1 are one axis.
bool same_axis(int i, int j) { return i / 2 == j / 2; }

void test_covariances_between_axes_that_know_nothing_of_each_other_are_never_touched() {
  const Controller controller = controller_of(online(double_integrators(3), "plain"));
  const std::vector<bool> pattern = lqg::emit::covariance_pattern(controller);
  TEST_ASSERT_EQUAL_size_t(21, pattern.size());
  const std::string text = lqg::emit::header(controller);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) {
      const int k = lqg::step::triangle(i, j);
      TEST_ASSERT_EQUAL_INT(same_axis(i, j), pattern[static_cast<std::size_t>(k)]);
      const bool is_used = text.find("self->P[" + std::to_string(k) + "]") != std::string::npos;
      TEST_ASSERT_EQUAL_INT(same_axis(i, j), is_used);
    }
}

void test_factors_between_axes_that_know_nothing_of_each_other_are_never_touched() {
  const Controller controller = controller_of(online(double_integrators(3), "ud"));
  const std::vector<bool> pattern = lqg::emit::covariance_pattern(controller);
  TEST_ASSERT_EQUAL_size_t(15 + 6, pattern.size());
  const std::string text = lqg::emit::header(controller);
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < j; ++i) {
      const int k = lqg::step::strict_triangle(i, j);
      TEST_ASSERT_EQUAL_INT(same_axis(i, j), pattern[static_cast<std::size_t>(k)]);
      const bool is_used = text.find("self->U[" + std::to_string(k) + "]") != std::string::npos;
      TEST_ASSERT_EQUAL_INT(same_axis(i, j), is_used);
    }
}

// Two more additions join the sums of the three axes in update and predict each, and two checks of a sum are saved.
void test_three_axes_cost_three_times_one() {
  for (const char* covariance : {"plain", "ud"}) {
    const long one = controller_of(online(double_integrators(1), covariance)).cost.multiply_adds;
    TEST_ASSERT_EQUAL_INT(3 * one, controller_of(online(double_integrators(3), covariance)).cost.multiply_adds);
  }
}

// P0 couples what nothing else does.
void test_an_entry_of_P0_is_carried_on() {
  DesignText design = online(double_integrators(2), "plain");
  design.P0 = Eigen::MatrixXd::Identity(4, 4);
  design.P0(0, 2) = design.P0(2, 0) = 0.5;
  const std::vector<bool> pattern = lqg::emit::covariance_pattern(controller_of(design));
  for (const bool is_used : pattern) TEST_ASSERT_TRUE(is_used);
}

// A zero times a number, or a product of two numbers that is rounded, is work for lqgen, not for the target.
void test_no_product_of_two_numbers_is_left_to_the_target() {
  const std::regex number_times_number(R"((^|[^_\w.])\d[\d.e+-]*f? \* \d)"), times_zero(R"((\* 0\.0f)|(\b0\.0f \*))");
  for (const char* covariance : {"plain", "ud"})
    for (int seed = 0; seed < 6; ++seed) {
      Random random(static_cast<std::uint64_t>(seed));
      DesignText design = online(random_design(random, 1 + seed), covariance);
      design.real = "float", design.arithmetic = "plain";
      const std::string text = lqg::emit::header(controller_of(design));
      const std::string code = text.substr(text.find("#ifndef"));
      std::smatch found;
      TEST_ASSERT_FALSE_MESSAGE(std::regex_search(code, found, times_zero), found.str().c_str());
      TEST_ASSERT_FALSE_MESSAGE(std::regex_search(code, found, number_times_number), found.str().c_str());
    }
}

// A number that counts what is done with it, as Figures does: a multiply-add, or a lone operation, is one.
struct Counted {
  Counted(double v = 0) : value(v) {}
  double value;
  static long operations;
};
long Counted::operations = 0;

Counted counted(double value) {
  ++Counted::operations;
  return value;
}
Counted operator+(Counted a, Counted b) { return counted(a.value + b.value); }
Counted operator-(Counted a, Counted b) { return counted(a.value - b.value); }
Counted operator*(Counted a, Counted b) { return counted(a.value * b.value); }
Counted operator/(Counted a, Counted b) { return counted(a.value / b.value); }
Counted multiply_add(const Counted& a, const Counted& b, const Counted& c) {
  return counted(a.value * b.value + c.value);
}
Counted multiply_subtract(const Counted& a, const Counted& b, const Counted& c) {
  return counted(c.value - a.value * b.value);
}
bool is_finite(const Counted& a) { return (a - a).value == 0; }
bool is_usable(const Counted& innovation, const Counted& variance) {
  return variance.value > 0 && std::isfinite(innovation.value);
}
Counted absolute(const Counted& a) { return counted(std::abs(a.value)); }
bool is_zero(const Counted& a) { return a.value == 0; }
bool is_less(const Counted& a, const Counted& b) { return a.value < b.value; }
// What formulas of an extended filter would ask for.
Counted sqrt(const Counted& a) { return counted(std::sqrt(a.value)); }
Counted sin(const Counted& a) { return counted(std::sin(a.value)); }
Counted cos(const Counted& a) { return counted(std::cos(a.value)); }
Counted tan(const Counted& a) { return counted(std::tan(a.value)); }
Counted asin(const Counted& a) { return counted(std::asin(a.value)); }
Counted acos(const Counted& a) { return counted(std::acos(a.value)); }
Counted atan(const Counted& a) { return counted(std::atan(a.value)); }
Counted exp(const Counted& a) { return counted(std::exp(a.value)); }
Counted log(const Counted& a) { return counted(std::log(a.value)); }
Counted tanh(const Counted& a) { return counted(std::tanh(a.value)); }
Counted floor(const Counted& a) { return counted(std::floor(a.value)); }
Counted atan2(const Counted& y, const Counted& x) { return counted(std::atan2(y.value, x.value)); }
Counted pow(const Counted& a, const Counted& b) { return counted(std::pow(a.value, b.value)); }
Counted abs(const Counted& a) { return counted(std::abs(a.value)); }

long operations_of_a_sample(const Controller& controller) {
  using namespace lqg::step;
  const auto model = lqg::controller::model_of<Counted>(
      controller, [](const lqg::design::Real& value) { return Counted(lqg::design::to_double(value)); });
  State<Counted> state = initial_state(model);
  const Vector<Counted> y = Vector<Counted>::Constant(model.ny, Counted(0.5));
  Vector<Counted> u = Vector<Counted>::Constant(model.nu, Counted(0.5));
  Counted::operations = 0;
  run_sample(model, state, y, u);
  return Counted::operations;
}

// The templates leave states of one bound as they are; the loops scale every x_i in both checks, and P_ii twice in one.
long scaling_of_a_sample(const Controller& controller) {
  constexpr long comparisons = 2 * 2;
  return (controller.solution.online ? 4 : 2) * controller.size.nx + comparisons;
}

// Of a plant whose A has no zeros, in a form that shares nothing.
void test_compact_counts_what_the_loops_do() {
  for (const char* gain : {"steady", "online"})
    for (const char* covariance : {"plain", "ud"})
      for (const bool has_everything : {false, true}) {
        DesignText design = double_integrators(2);
        design.gain = gain, design.covariance = covariance, design.style = "compact";
        if (design.covariance == "plain" && design.gain == "online" && !has_everything) continue;
        design.A.array() += 0.01;
        if (has_everything) {
          design.D = Eigen::MatrixXd::Constant(2, 2, 0.5);
          design.V << 0.01, 0.004, 0.004, 0.02;
          design.Swv = Eigen::MatrixXd::Constant(2, 2, 0.01);
        }
        const Controller controller = controller_of(design);
        TEST_ASSERT_EQUAL_INT(operations_of_a_sample(controller) + scaling_of_a_sample(controller),
                              controller.cost.multiply_adds);
      }
}

// Nothing is dearer than in the loops: the plant of the test is full of zeros.
void test_unrolled_does_less_than_the_loops() {
  for (const char* covariance : {"plain", "ud"}) {
    const Controller controller = controller_of(online(double_integrators(2), covariance));
    TEST_ASSERT_LESS_THAN(operations_of_a_sample(controller) / 2, controller.cost.multiply_adds);
  }
}

void test_auto_takes_the_loops_when_straight_line_code_does_not_fit() {
  Random random(5);
  DesignText design = online(random_design(random, 6), "ud");  // few zeros
  design.style = "auto", design.real = "float";
  std::string text = toml(design);
  TEST_ASSERT_TRUE(controller_of(text).style == lqg::design::Style::unrolled);
  text.replace(text.find("flash = 1000000"), 15, "flash = 6000");
  TEST_ASSERT_TRUE(controller_of(text).style == lqg::design::Style::compact);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_covariances_between_axes_that_know_nothing_of_each_other_are_never_touched);
  RUN_TEST(test_factors_between_axes_that_know_nothing_of_each_other_are_never_touched);
  RUN_TEST(test_three_axes_cost_three_times_one);
  RUN_TEST(test_an_entry_of_P0_is_carried_on);
  RUN_TEST(test_no_product_of_two_numbers_is_left_to_the_target);
  RUN_TEST(test_compact_counts_what_the_loops_do);
  RUN_TEST(test_unrolled_does_less_than_the_loops);
  RUN_TEST(test_auto_takes_the_loops_when_straight_line_code_does_not_fit);
  return UNITY_END();
}
