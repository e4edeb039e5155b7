// SPDX-License-Identifier: MIT
// Which code is written: the first that fits in the flash, and what `style = "compact"` means for a constant gain.
#include <string>
#include <vector>

#include <unity.h>

#include "design_text.hpp"

using namespace lqg_test;
using lqg::controller::Sharing;
using lqg::design::Style;
using lqg::emit::Controller;

namespace {

// Stable, without any zero; every second state is measured.
DesignText dense_design(int nx, const char* gain) {
  DesignText design;
  design.A = 0.1 * Eigen::MatrixXd::Identity(nx, nx) + Eigen::MatrixXd::Constant(nx, nx, 0.5 / nx);
  for (int i = 0; i < nx; ++i) design.A(i, (i + 1) % nx) += 0.01 * (i + 1);
  design.B = Eigen::MatrixXd::Constant(nx, 2, 0.5);
  design.B(0, 1) = -1;
  design.C = Eigen::MatrixXd::Constant(nx / 2, nx, 0.1);
  for (int i = 0; i < nx / 2; ++i) design.C(i, 2 * i) = 1;
  design.Q = Eigen::MatrixXd::Identity(nx, nx);
  design.R = Eigen::MatrixXd::Identity(2, 2);
  design.W = Eigen::MatrixXd::Identity(nx, nx);
  design.V = Eigen::MatrixXd::Identity(nx / 2, nx / 2);
  design.noise = "discrete";
  design.gain = gain;
  if (std::string(gain) == "online") design.covariance = "plain";
  return design;
}

Controller within(DesignText design, long flash) {
  design.style = "auto";
  std::string text = toml(design);
  const std::string given = "flash = 1000000";
  return controller_of(text.replace(text.find(given), given.size(), "flash = " + std::to_string(flash)));
}

// With a little less flash than each takes, until there is the last one.
void expect_ways(const DesignText& design, const std::vector<Sharing>& expected) {
  long flash = 1000000;
  for (const Sharing sharing : expected) {
    const Controller controller = within(design, flash);
    TEST_ASSERT_TRUE(controller.style == Style::unrolled);
    TEST_ASSERT_EQUAL_INT(static_cast<int>(sharing), static_cast<int>(controller.sharing));
    TEST_ASSERT_LESS_OR_EQUAL(flash, controller.cost.flash);
    flash = controller.cost.flash - 1;
  }
}

void test_less_flash_brings_loops_of_a_constant_gain() {
  expect_ways(dense_design(12, "steady"), {Sharing::nothing, Sharing::products});
}

void test_less_flash_brings_shared_code_of_a_carried_covariance() {
  expect_ways(dense_design(8, "online"), {Sharing::nothing, Sharing::outputs, Sharing::columns});
}

void test_compact_is_loops_of_a_dense_plant() {
  DesignText design = dense_design(12, "steady");
  design.style = "compact";
  TEST_ASSERT_TRUE(controller_of(design).sharing == Sharing::products);
}

// Loops would save little of it.
void test_compact_is_straight_lines_of_a_sparse_plant() {
  DesignText design = double_integrators(4);
  design.style = "compact";
  const Controller controller = controller_of(design);
  TEST_ASSERT_TRUE(controller.style == Style::unrolled && controller.sharing == Sharing::nothing);
}

// Fewer states keep the library's loops.
void test_compact_is_the_library_of_a_small_plant() {
  DesignText design = double_integrators(2);
  design.style = "compact";
  TEST_ASSERT_TRUE(controller_of(design).style == Style::compact);
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_less_flash_brings_loops_of_a_constant_gain);
  RUN_TEST(test_less_flash_brings_shared_code_of_a_carried_covariance);
  RUN_TEST(test_compact_is_loops_of_a_dense_plant);
  RUN_TEST(test_compact_is_straight_lines_of_a_sparse_plant);
  RUN_TEST(test_compact_is_the_library_of_a_small_plant);
  return UNITY_END();
}
