// SPDX-License-Identifier: MIT
// The emitted controller with limits that are foreseen: what it is worth, and what it is where no limit is in the way.
#include <cmath>

#include <unity.h>

#include "../emit/design_text.hpp"
#include "simulate/emitted_controller.hpp"
#include "simulate/foresight.hpp"
#include "simulate/numbers.hpp"

using namespace lqg;
using controller::Controller;
using Eigen::VectorXd;
using Origin = controller::Iterations::Origin;

namespace {

std::string text_of(const std::string& limits, const std::string& real = "float") {
  return R"(
name = "masses"
[plant]
domain = "continuous"
sample_time = 0.5
A = [[0, 1, 0, 0], [-0.1, -0.004, 0.1, 0.004], [0, 0, 0, 1], [0.5, 0.02, -0.5, -0.02]]
B = [[0], [1], [0], [0]]
C = [[1, 0, 0, 0], [0, 0, 1, 0]]
[lqr]
Q = [1, 0, 1, 0]
R = [0.1]
)" + limits +
         "[code]\nreal = \"" + real + "\"\n";
}

const char* const foreseen = "[limits]\nu_min = [-0.3]\nu_max = [0.3]\nhorizon = 20\n";

// Of three rows: all ways through the solver are seen at once.
const char* const mass = R"(
name = "mass"
[plant]
domain = "continuous"
sample_time = 0.1
A = [[0, 1], [0, 0]]
B = [[0], [1]]
[lqr]
Q = [1, 0.1]
R = [0.1]
[limits]
u_min = [-1]
u_max = [1]
horizon = 4
)";

VectorXd drawn(std::uint64_t& state, double size, Eigen::Index count = 4) {
  VectorXd x(count);
  for (double& entry : x) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    entry = size * (static_cast<double>(state >> 11) / 0x1p52 - 1);
  }
  return x;
}

template <class S>
void compare_with_the_law(const std::string& real) {
  const Controller with = lqg_test::controller_of(text_of(foreseen, real));
  const Controller without = lqg_test::controller_of(text_of("", real));
  simulate::EmittedController<S> limited(with, simulate::constants_of<S>(with.target));
  simulate::EmittedController<S> free(without, simulate::constants_of<S>(without.target));
  std::uint64_t seed = 1;
  int equal = 0;
  for (int n = 0; n < 20000; ++n) {
    const VectorXd x = drawn(seed, n % 2 ? 0.1 : 1);
    limited.state().x = free.state().x = simulate::numbers_of<S>(x);
    step::Vector<S> u, v;
    const unsigned events = limited.control(u);
    free.control(v);
    TEST_ASSERT_TRUE(std::abs(simulate::as_double(u(0))) <= 0.3);
    TEST_ASSERT_FALSE(events >> static_cast<unsigned>(step::Event::not_optimal) & 1u);
    if (events) continue;
    // A limit that will be in the way later says nothing, but moves u; where none is, all bits are the law's.
    if (std::abs(simulate::as_double(u(0)) - simulate::as_double(v(0))) < 1e-6) {
      TEST_ASSERT_TRUE(u(0) == v(0));
      ++equal;
    }
  }
  TEST_ASSERT_GREATER_THAN(5000, equal);
}

void test_u_is_the_law_bit_for_bit_where_no_limit_is_in_the_way() {
  compare_with_the_law<float>("float");
  compare_with_the_law<double>("double");
}

// Half of the mass alone moves u by 0.3 from 0.12 m on.
void test_a_plant_that_clipping_does_not_settle_is_worth_foresight() {
  const Controller controller = lqg_test::controller_of(text_of(foreseen));
  const controller::Worth worth = simulate::worth_of_foresight(controller);
  TEST_ASSERT_EQUAL(worth.starts, worth.optimal_settle);
  TEST_ASSERT_LESS_THAN(worth.starts * 9 / 10, worth.clipped_settle);
  TEST_ASSERT_TRUE(worth.high_ratio > 1.5);
  TEST_ASSERT_EQUAL(worth.shown.optimal_u.cols(), worth.shown.optimal_x.cols());
}

template <class S>
void expect_bits_of(const Controller& controller, const Eigen::MatrixXd& x, const Eigen::MatrixXd& u) {
  simulate::EmittedController<S> emitted(controller, simulate::constants_of<S>(controller.target));
  TEST_ASSERT_TRUE(u.cols() > 20 && u.cols() == x.cols());
  for (Eigen::Index k = 0; k < u.cols(); ++k) {
    step::Vector<S> v;
    emitted.state().x = simulate::numbers_of<S>(x.col(k));
    emitted.control(v);
    TEST_ASSERT_TRUE(simulate::as_double(v(0)) == u(0, k));
  }
}

template <class S>
void compare_the_shown_run(const std::string& real) {
  const Controller with = lqg_test::controller_of(text_of(foreseen, real));
  const Controller clipped = lqg_test::controller_of(text_of("[limits]\nu_min = [-0.3]\nu_max = [0.3]\n", real));
  const controller::WorthOfRun shown = simulate::worth_of_foresight(with).shown;
  expect_bits_of<S>(clipped, shown.clipped_x, shown.clipped_u);
  expect_bits_of<S>(with, shown.optimal_x, shown.optimal_u);
  TEST_ASSERT_TRUE(shown.clipped_x.col(0) == shown.x && shown.optimal_x.col(0) == shown.x);
  TEST_ASSERT_DOUBLE_WITHIN(1e-7, 0.3, shown.optimal_u.cwiseAbs().maxCoeff());
  TEST_ASSERT_TRUE(shown.optimal_x.rightCols(1).norm() < 1e-2 * shown.x.norm());
}

void test_the_run_that_is_shown_has_the_bits_of_both_emitted_laws() {
  compare_the_shown_run<float>("float");
  compare_the_shown_run<double>("double");
}

// A first-order lag that nothing but the input moves: the clipped law is optimal.
void test_a_lag_at_its_limit_is_worth_nothing() {
  const Controller controller = lqg_test::controller_of(
      "name = \"lag\"\n[plant]\ndomain = \"discrete\"\nsample_time = 1\nA = [[0.9]]\nB = [[0.1]]\n"
      "[lqr]\nQ = [1]\nR = [0.1]\n[limits]\nu_min = [-1]\nu_max = [1]\nhorizon = 8\n");
  const controller::Worth worth = simulate::worth_of_foresight(controller);
  TEST_ASSERT_EQUAL(worth.starts, worth.both_settle);
  TEST_ASSERT_DOUBLE_WITHIN(1e-3, 1, worth.high_ratio);
}

void test_a_state_that_begins_within_its_limit_stays_there() {
  const Controller controller = lqg_test::controller_of(
      "name = \"speeding\"\n[plant]\ndomain = \"continuous\"\nsample_time = 0.1\nA = [[0, 1], [0, 0]]\nB = [[0], [1]]\n"
      "states = [\"position\", \"speed\"]\n[lqr]\nQ = [1, 0.1]\nR = [0.1]\n"
      "[limits]\nu_min = [-1]\nu_max = [1]\nhorizon = 10\nstates = { speed = 0.5 }\n[code]\nreal = \"double\"\n");
  const controller::Worth worth = simulate::worth_of_foresight(controller);
  TEST_ASSERT_EQUAL(worth.starts, worth.optimal_settle);
  TEST_ASSERT_TRUE(worth.optimal_excess < 1e-3);
  TEST_ASSERT_TRUE(worth.clipped_excess > 10 * worth.optimal_excess);
}

void test_the_number_of_changes_says_where_it_is_from() {
  const std::string few = std::string(foreseen) + "iterations = 3\n", many = "[limits]\nu_min = [-1]\nhorizon = 30\n";
  const Controller given = lqg_test::controller_of(text_of(few));
  TEST_ASSERT_TRUE(given.iterations.origin == Origin::file);
  TEST_ASSERT_EQUAL(3, given.iterations.most);
  const Controller proved = lqg_test::controller_of(mass);
  TEST_ASSERT_TRUE(proved.iterations.origin == Origin::certified);
  TEST_ASSERT_LESS_THAN(30, proved.iterations.most);
  const std::string horizon = many + "blocks = [" + "1" + [] {
    std::string ones;
    for (int i = 1; i < 30; ++i) ones += ", 1";
    return ones;
  }() + "]\n";
  const Controller capped = lqg_test::controller_of(text_of(horizon));
  TEST_ASSERT_TRUE(capped.iterations.origin == Origin::cap);
}

// The certified bound, in states up to where it holds.
void test_the_certified_number_of_changes_is_never_exceeded() {
  const Controller controller = lqg_test::controller_of(mass);
  const auto model = controller::model_of<float>(controller, simulate::constants_of<float>(controller.target));
  auto law = model.foreseen;
  law.iterations = 1000;
  std::uint64_t seed = 7;
  unsigned most = 0;
  for (int n = 0; n < 100000; ++n) {
    const VectorXd x = drawn(seed, 1, 2).cwiseProduct(controller.worth->reach);
    const step::Vector<float> s = simulate::numbers_of<float>(x), u = -(model.K * s);
    const auto found = step::limited_input<float>(law, {}, s, u);
    TEST_ASSERT_TRUE(found.is_optimal);
    most = std::max(most, found.changes);
  }
  TEST_ASSERT_LESS_OR_EQUAL(controller.iterations.most, most);
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_u_is_the_law_bit_for_bit_where_no_limit_is_in_the_way);
  RUN_TEST(test_a_plant_that_clipping_does_not_settle_is_worth_foresight);
  RUN_TEST(test_the_run_that_is_shown_has_the_bits_of_both_emitted_laws);
  RUN_TEST(test_a_lag_at_its_limit_is_worth_nothing);
  RUN_TEST(test_a_state_that_begins_within_its_limit_stays_there);
  RUN_TEST(test_the_number_of_changes_says_where_it_is_from);
  RUN_TEST(test_the_certified_number_of_changes_is_never_exceeded);
  return UNITY_END();
}
