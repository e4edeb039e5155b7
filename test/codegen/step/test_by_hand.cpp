// SPDX-License-Identifier: MIT
// What a caller sets and looks at between two samples: the state, its covariance, the outputs that an update leaves
// out.
#include <cmath>
#include <limits>

#include <unity.h>

#include "random_model.hpp"
#include "step/by_hand.hpp"
#include "step/covariance.hpp"
#include "step/partial_update.hpp"

using namespace lqg_test;
using lqg::step::Listener;

namespace {

constexpr int controllers = 200;

Shape shape_of(Random& random, Filter filter) {
  Shape shape;
  shape.filter = filter;
  shape.nx = random.between(1, 6), shape.nu = random.between(1, 3), shape.ny = random.between(1, 4);
  shape.nq = random.between(1, 3);
  shape.has_D = random.one_in(2), shape.has_M = random.one_in(2), shape.has_E = random.one_in(2);
  shape.is_sparse = random.one_in(2);
  return shape;
}

std::vector<int> random_bounds(Random& random, int size) {
  std::vector<int> bounds;
  for (int i = 0; i < size; ++i) bounds.push_back(random.between(-6, 6));
  return bounds;
}

// ---- set_state

// Σ (x_i / 2^b_i)², in more digits than S has.
template <class S>
long double distance(const Vector<S>& x, const std::vector<int>& bounds) {
  long double sum = 0;
  for (int i = 0; i < x.size(); ++i) {
    const long double part =
        std::ldexp(static_cast<long double>(to_double(x(i))), -bounds[static_cast<std::size_t>(i)]);
    sum += part * part;
  }
  return sum;
}

template <class S>
void set_random_states() {
  Random random(1);
  int accepted = 0, refused = 0;
  for (int k = 0; k < controllers; ++k) {
    const Model<double> exact = random_model(random, shape_of(random, Filter::steady));
    Model<S> model = convert<S>(exact);
    model.x_bound = random_bounds(random, model.nx);
    State<S> state = lqg::step::initial_state(model);
    state.innovation = random_vector<S>(random, static_cast<int>(state.innovation.size()));
    const State<S> before = state;
    Vector<S> x = random_vector<S>(random, model.nx);
    for (int i = 0; i < model.nx; ++i)
      x(i) = x(i) * rounded<S>(std::ldexp(0.6, model.x_bound[static_cast<std::size_t>(i)]));
    const long double of_x = distance(x, model.x_bound);
    if (std::abs(of_x - 1) < 1e-5L) continue;  // nearer to 1 than rounding may tell
    Listener listener;
    const bool within = lqg::step::set_state(model, state, x, listener);
    TEST_ASSERT_EQUAL_INT(of_x < 1, within);
    (within ? accepted : refused)++;
    for (int i = 0; i < model.nx; ++i) TEST_ASSERT_TRUE(to_double(state.x(i)) == to_double(x(i)));
    for (int i = 0; i < state.innovation.size(); ++i) TEST_ASSERT_TRUE(to_double(state.innovation(i)) == 0);
    for (int i = 0; i < state.u.size(); ++i) TEST_ASSERT_TRUE(to_double(state.u(i)) == to_double(before.u(i)));
  }
  TEST_ASSERT_GREATER_THAN_INT(controllers / 10, accepted);
  TEST_ASSERT_GREATER_THAN_INT(controllers / 10, refused);
}

void test_a_state_is_accepted_within_its_bounds_only() {
  set_random_states<float>();
  set_random_states<double>();
  set_random_states<Fused<float>>();
}

void test_a_state_with_one_part_that_is_not_finite_is_refused() {
  Random random(2);
  for (const double hostile : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (int k = 0; k < controllers; ++k) {
      Model<double> model = random_model(random, shape_of(random, Filter::ud));
      if (random.one_in(2)) model.x_bound = std::vector<int>(static_cast<std::size_t>(model.nx), 8);
      State<double> state = lqg::step::initial_state(model);
      Vector<double> x = Vector<double>::Zero(model.nx);
      Listener listener;
      TEST_ASSERT_TRUE(lqg::step::set_state(model, state, x, listener));
      x(random.between(0, model.nx - 1)) = hostile;
      TEST_ASSERT_FALSE(lqg::step::set_state(model, state, x, listener));
    }
}

// ---- covariance

// |U| |D| |U|ᵀ: each of its entries bounds the sum of the sizes of the terms.
template <class S>
Matrix<double> sizes(const Model<S>& model, State<S> state) {
  for (S& entry : state.U) entry = S(rounded<S>(std::abs(to_double(entry))));
  return lqg_test::covariance(model, state);
}

template <class S>
void multiply_out_random_factors() {
  Random random(3);
  for (int k = 0; k < controllers; ++k) {
    const Model<S> model = convert<S>(random_model(random, shape_of(random, Filter::ud)));
    const State<S> state = lqg::step::initial_state(model);
    const std::vector<S> P = lqg::step::covariance(model, state);
    const Matrix<double> expected = lqg_test::covariance(model, state), size = sizes(model, state);
    const double roundings = (model.nx + 2) * static_cast<double>(std::numeric_limits<real_of<S>>::epsilon());
    TEST_ASSERT_EQUAL_size_t(static_cast<std::size_t>(model.nx * (model.nx + 1) / 2), P.size());
    std::size_t at = 0;
    for (int i = 0; i < model.nx; ++i)
      for (int j = 0; j <= i; ++j)
        TEST_ASSERT_DOUBLE_WITHIN(roundings * size(i, j), expected(i, j), to_double(P[at++]));
  }
}

void test_covariance_is_the_product_of_its_factors() {
  multiply_out_random_factors<float>();
  multiply_out_random_factors<double>();
  multiply_out_random_factors<Fused<float>>();
}

// 3 states, by hand. In plain and in fused numbers the same bits: no product is fused with a sum.
template <class S>
std::vector<double> covariance_of_thirds() {
  Model<S> model;
  model.filter = Filter::ud, model.nx = 3;
  State<S> state;
  for (const double value : {1.0 / 3, -1.0 / 7, 1.0 / 11}) state.U.push_back(rounded<S>(value));
  for (const double value : {0.1, 0.2, 0.3}) state.D.push_back(rounded<S>(value));
  std::vector<double> out;
  for (const S& entry : lqg::step::covariance(model, state)) out.push_back(to_double(entry));
  return out;
}

void test_no_product_of_a_covariance_is_fused() {
  const float U01 = 1.0f / 3, U02 = static_cast<float>(-1.0 / 7), U12 = static_cast<float>(1.0 / 11);
  const float d[] = {0.1f, 0.2f, 0.3f};
  const float a = U01 * d[1], b = a * U01, c = U02 * d[2], e = c * U02, f = c * U12, g = U12 * d[2], h = g * U12;
  const float first = d[0] + b;
  const float expected[] = {first + e, a + f, d[1] + h, c, g, d[2]};
  const std::vector<double> plain = covariance_of_thirds<float>(), fused = covariance_of_thirds<Fused<float>>();
  for (std::size_t k = 0; k < 6; ++k) {
    TEST_ASSERT_TRUE(plain[k] == static_cast<double>(expected[k]));
    TEST_ASSERT_TRUE(fused[k] == static_cast<double>(expected[k]));
  }
}

void test_covariance_of_the_other_filters_is_what_they_carry() {
  Random random(4);
  const Model<double> plain = random_model(random, shape_of(random, Filter::plain));
  TEST_ASSERT_TRUE(lqg::step::covariance(plain, lqg::step::initial_state(plain)) == plain.P0);
  const Model<double> steady = random_model(random, shape_of(random, Filter::steady));
  TEST_ASSERT_TRUE(lqg::step::covariance(steady, lqg::step::initial_state(steady)).empty());
}

// ---- lost_outputs

// Lost: one that it needs is not there, or ν_i + Σ E_ij ν_j is not below its limit. −1 where that is too near to tell.
int is_lost(const Model<double>& model, const Vector<double>& nu, const std::vector<bool>& used, int i) {
  if (!used[static_cast<std::size_t>(i)]) return 1;
  long double sum = static_cast<long double>(nu(i));
  for (int j = 0; j < i && model.E.size(); ++j) {
    if (model.E(i, j) == 0) continue;
    if (!used[static_cast<std::size_t>(j)]) return 1;
    sum += static_cast<long double>(model.E(i, j)) * static_cast<long double>(nu(j));
  }
  const long double left = std::abs(sum) - static_cast<long double>(model.nu_limit(i));
  return std::abs(left) < 1e-12L ? -1 : left >= 0;
}

template <class S>
void lose_random_outputs(Filter filter) {
  Random random(5);
  int lost_ones = 0, kept_ones = 0;
  for (int k = 0; k < controllers; ++k) {
    Model<double> exact = random_model(random, shape_of(random, filter));
    exact.nu_limit = Vector<double>::Constant(exact.ny, 1.5);
    Model<S> model = convert<S>(exact);
    model.nu_limit = convert<S>(exact.nu_limit);
    const Vector<double> there = random_vector<double>(random, model.ny);
    std::vector<bool> used;
    Vector<S> nu(model.ny);
    for (int i = 0; i < model.ny; ++i) {
      used.push_back(!random.one_in(4));
      nu(i) = used.back() ? S(there(i)) : S(std::numeric_limits<double>::infinity());
    }
    Listener listener;
    const std::vector<bool> lost = lqg::step::lost_outputs(model, nu, nu, listener);
    for (int i = 0; i < model.ny; ++i) {
      const int expected = is_lost(exact, there, used, i);
      if (expected >= 0) TEST_ASSERT_EQUAL_INT(expected, lost[static_cast<std::size_t>(i)]);
      (lost[static_cast<std::size_t>(i)] ? lost_ones : kept_ones)++;
    }
  }
  TEST_ASSERT_GREATER_THAN_INT(controllers / 2, lost_ones);
  TEST_ASSERT_GREATER_THAN_INT(controllers / 2, kept_ones);
}

void test_outputs_are_lost_that_are_absurd_or_lack_their_company() {
  for (const Filter filter : {Filter::steady, Filter::plain, Filter::ud}) {
    lose_random_outputs<double>(filter);
    lose_random_outputs<Fused<double>>(filter);
  }
}

void test_an_output_that_is_no_number_is_lost_with_those_that_need_it() {
  Model<double> model;
  model.ny = 3;
  model.E = Matrix<double>::Identity(3, 3);
  model.E(2, 0) = 0.5;
  model.nu_limit = Vector<double>::Constant(3, 8);
  Vector<double> nu = Vector<double>::Zero(3);
  nu(0) = std::numeric_limits<double>::quiet_NaN();
  Listener listener;
  const std::vector<bool> lost = lqg::step::lost_outputs(model, nu, nu, listener), expected = {true, false, true};
  TEST_ASSERT_TRUE(lost == expected);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_state_is_accepted_within_its_bounds_only);
  RUN_TEST(test_a_state_with_one_part_that_is_not_finite_is_refused);
  RUN_TEST(test_covariance_is_the_product_of_its_factors);
  RUN_TEST(test_no_product_of_a_covariance_is_fused);
  RUN_TEST(test_covariance_of_the_other_filters_is_what_they_carry);
  RUN_TEST(test_outputs_are_lost_that_are_absurd_or_lack_their_company);
  RUN_TEST(test_an_output_that_is_no_number_is_lost_with_those_that_need_it);
  return UNITY_END();
}
