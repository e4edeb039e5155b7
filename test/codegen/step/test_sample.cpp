// SPDX-License-Identifier: MIT
// One sample as a whole: scalars, the control law, the order of the calls, the reset.
#include <limits>

#include <unity.h>

#include "random_model.hpp"

using namespace lqg_test;
using lqg::step::Event;
using lqg::step::Listener;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

unsigned bit(Event event) { return 1u << static_cast<unsigned>(event); }

// (1 + ε)(1 − ε) = 1 − ε² is 1 when the product is rounded.
template <class T>
void expect_one_rounding() {
  using namespace lqg::step;
  const T epsilon = std::numeric_limits<T>::epsilon(), a = 1 + epsilon, b = 1 - epsilon;
  TEST_ASSERT_TRUE(multiply_add(a, b, T(-1)) == 0);
  TEST_ASSERT_TRUE(multiply_subtract(a, b, T(1)) == 0);
  TEST_ASSERT_TRUE(multiply_add(Fused<T>(a), Fused<T>(b), Fused<T>(-1)).value == -epsilon * epsilon);
  TEST_ASSERT_TRUE(multiply_subtract(Fused<T>(a), Fused<T>(b), Fused<T>(1)).value == epsilon * epsilon);
}

void test_multiply_add_rounds_once_when_fused_and_twice_when_not() {
  expect_one_rounding<float>();
  expect_one_rounding<double>();
}

void test_finite_is_neither_infinite_nor_NaN() {
  using lqg::step::is_finite;
  TEST_ASSERT_TRUE(is_finite(0.0) && is_finite(-std::numeric_limits<double>::max()));
  TEST_ASSERT_FALSE(is_finite(infinity) || is_finite(-infinity) || is_finite(not_a_number));
  TEST_ASSERT_TRUE(is_finite(Fused<double>(1)));
  TEST_ASSERT_FALSE(is_finite(Fused<double>(infinity)) || is_finite(Fused<double>(not_a_number)));
}

void test_usable_is_a_finite_innovation_of_positive_variance() {
  using lqg::step::is_usable;
  TEST_ASSERT_TRUE(is_usable(-3.0, 1e-300) && is_usable(0.0, infinity));
  for (const double variance : {0.0, -1.0, -infinity, not_a_number}) TEST_ASSERT_FALSE(is_usable(1.0, variance));
  for (const double innovation : {infinity, -infinity, not_a_number}) TEST_ASSERT_FALSE(is_usable(innovation, 1.0));
  TEST_ASSERT_FALSE(is_usable(Fused<double>(1), Fused<double>(not_a_number)));
}

// u = −x within [low, high].
Model<double> regulator(double low, double high) {
  Model<double> model;
  model.nx = model.nu = 1;
  model.K = Matrix<double>::Constant(1, 1, 1);
  model.u_min = Vector<double>::Constant(1, low);
  model.u_max = Vector<double>::Constant(1, high);
  return model;
}

void expect_control(const Model<double>& model, double x, double u, bool is_limited) {
  Listener listener;
  const Vector<double> found = lqg::step::control(model, Vector<double>(Vector<double>::Constant(1, x)), listener);
  TEST_ASSERT_TRUE(found(0) == u);
  TEST_ASSERT_EQUAL_UINT(is_limited ? bit(Event::input_limited) : 0, listener.events);
}

void test_control_keeps_its_limits_and_says_so() {
  const Model<double> model = regulator(-1, 2);
  expect_control(model, 0.5, -0.5, false);
  expect_control(model, 1.5, -1, true);
  expect_control(model, -2.5, 2, true);
}

void test_an_input_exactly_at_its_limit_is_not_limited() {
  expect_control(regulator(-1, 2), 1, -1, false);
  expect_control(regulator(-1, 2), -2, 2, false);
}

void test_control_of_a_state_that_is_no_number_is_zero_or_the_limit_nearest_to_it() {
  for (const double x : {not_a_number, infinity, -infinity}) {
    expect_control(regulator(-1, 2), x, 0, true);
    expect_control(regulator(1, 2), x, 1, true);
    expect_control(regulator(-2, -1), x, -1, true);
  }
}

void test_an_infinite_limit_is_none() {
  expect_control(regulator(-infinity, 2), 1e300, -1e300, false);
  expect_control(regulator(-1, infinity), -1e300, 1e300, false);
}

void test_control_without_limits_is_zero_where_it_overflows() {
  Model<double> model = regulator(0, 0);
  model.u_min.resize(0), model.u_max.resize(0);
  expect_control(model, -1e308, 1e308, false);
  model.K(0, 0) = 10;
  expect_control(model, 1e308, 0, true);
}

Shape shape_with_D(Filter filter, bool predictor_form) {
  Shape shape;
  shape.filter = filter;
  shape.predictor_form = predictor_form;
  shape.nx = 3, shape.nu = 2, shape.ny = 2, shape.nq = 3;
  shape.has_D = shape.has_K = shape.has_M = shape.has_E = true;
  return shape;
}

// One sample, call by call.
void run_by_hand(const Model<double>& model, State<double>& state, const Vector<double>& y, Vector<double>& u) {
  Listener listener;
  const auto control = [&] { state.u = u = lqg::step::control(model, state.x, listener); };
  if (model.predictor_form) control();
  TEST_ASSERT_TRUE(lqg::step::update(model, state, y, listener));
  if (!model.predictor_form) control();
  TEST_ASSERT_TRUE(lqg::step::predict(model, state, u, listener));
}

void test_a_sample_makes_its_calls_in_the_order_of_the_form() {
  for (const Filter filter : {Filter::steady, Filter::plain, Filter::ud})
    for (const bool predictor_form : {false, true}) {
      Random random(7);
      const Model<double> model = random_model(random, shape_with_D(filter, predictor_form));
      State<double> a = lqg::step::initial_state(model), b = a;
      for (int k = 0; k < 20; ++k) {
        const Vector<double> y = random_vector<double>(random, model.ny);
        Vector<double> u_of_a, u_of_b;
        TEST_ASSERT_EQUAL_UINT(0, lqg::step::run_sample(model, a, y, u_of_a));
        run_by_hand(model, b, y, u_of_b);
        TEST_ASSERT_TRUE(u_of_a == u_of_b);
        TEST_ASSERT_TRUE(numbers(a) == numbers(b));
      }
    }
}

// The same outputs, the other order: other inputs. So the test above can tell them apart.
void test_the_form_makes_a_difference() {
  Random random(7);
  Model<double> filter = random_model(random, shape_with_D(Filter::steady, false)), predictor = filter;
  predictor.predictor_form = true;
  State<double> a = lqg::step::initial_state(filter), b = a;
  Vector<double> u_of_a, u_of_b;
  const Vector<double> y = random_vector<double>(random, filter.ny);
  lqg::step::run_sample(filter, a, y, u_of_a);
  lqg::step::run_sample(predictor, b, y, u_of_b);
  TEST_ASSERT_FALSE(u_of_a == u_of_b);
}

// x = 0, D = 1, L = 1: after update x is y minus the input that acts.
void test_the_input_that_acts_is_that_of_the_last_predict_or_control() {
  Model<double> model = regulator(0, 0);
  model.u_min.resize(0), model.u_max.resize(0);
  model.filter = Filter::steady;
  model.ny = 1;
  model.A = model.B = Matrix<double>::Zero(1, 1);
  model.C = Matrix<double>::Zero(1, 1);
  model.D = model.L = Matrix<double>::Constant(1, 1, 1);
  model.M.resize(1, 0);
  model.x0 = Vector<double>::Constant(1, 3);
  Listener listener;
  const Vector<double> y = Vector<double>::Constant(1, 10), applied = Vector<double>::Constant(1, 4);

  State<double> state = lqg::step::initial_state(model);
  lqg::step::update(model, state, y, listener);
  TEST_ASSERT_TRUE(state.x(0) == 3 + 10);  // nothing applied yet
  lqg::step::predict(model, state, applied, listener);
  lqg::step::update(model, state, y, listener);
  TEST_ASSERT_TRUE(state.x(0) == 10 - 4);

  model.predictor_form = true;  // u = −3 is asked for before y comes
  state = lqg::step::initial_state(model);
  Vector<double> u;
  model.A(0, 0) = 1;
  lqg::step::run_sample(model, state, y, u);
  TEST_ASSERT_TRUE(u(0) == -3 && state.x(0) == 3 + (10 + 3) && state.u(0) == -3);
}

void test_what_the_outputs_told_of_w_is_used_once() {
  for (const Filter filter : {Filter::steady, Filter::plain, Filter::ud}) {
    Random random(7);
    const Model<double> model = random_model(random, shape_with_D(filter, false));
    State<double> state = lqg::step::initial_state(model);
    Listener listener;
    lqg::step::update(model, state, random_vector<double>(random, model.ny), listener);
    TEST_ASSERT_FALSE(state.innovation.isZero(0));
    lqg::step::predict(model, state, random_vector<double>(random, model.nu), listener);
    TEST_ASSERT_TRUE(state.innovation.isZero(0));
  }
}

void test_a_state_that_is_not_finite_begins_anew() {
  for (const Filter filter : {Filter::steady, Filter::plain, Filter::ud}) {
    Random random(7);
    Shape shape = shape_with_D(filter, false);
    shape.has_K = false;
    const Model<double> model = random_model(random, shape);
    const State<double> initial = lqg::step::initial_state(model);
    State<double> state = initial;
    Vector<double> u = random_vector<double>(random, model.nu);
    const Vector<double> y = random_vector<double>(random, model.ny);
    TEST_ASSERT_EQUAL_UINT(0, lqg::step::run_sample(model, state, y, u));
    TEST_ASSERT_FALSE(numbers(initial) == numbers(state));
    u(1) = infinity;
    TEST_ASSERT_EQUAL_UINT(bit(Event::state_reset), lqg::step::run_sample(model, state, y, u));
    TEST_ASSERT_TRUE(numbers(initial) == numbers(state));
  }
}

void test_a_reset_in_update_is_seen_by_control() {
  Random random(7);
  const Model<double> model = random_model(random, shape_with_D(Filter::steady, false));
  State<double> state = lqg::step::initial_state(model);
  state.x(0) = not_a_number;
  const Vector<double> y = random_vector<double>(random, model.ny);
  Vector<double> u;
  Listener listener;
  const unsigned events = lqg::step::run_sample(model, state, y, u);
  unsigned expected = bit(Event::state_reset) | bit(Event::output_rejected);
  for (int i = 0; i < model.ny; ++i) expected |= bit(lqg::step::rejection_of(i));
  TEST_ASSERT_EQUAL_UINT(expected, events);
  TEST_ASSERT_TRUE(u == lqg::step::control(model, model.x0, listener));
}

// Without a regulator `u` is what was applied, and stays it.
void test_an_estimator_alone_takes_the_input_as_it_is() {
  Random random(7);
  Shape shape = shape_with_D(Filter::plain, false);
  shape.has_K = false;
  const Model<double> model = random_model(random, shape);
  State<double> a = lqg::step::initial_state(model), b = a;
  const Vector<double> y = random_vector<double>(random, model.ny), applied = random_vector<double>(random, model.nu);
  Vector<double> u = applied;
  Listener listener;
  lqg::step::run_sample(model, a, y, u);
  lqg::step::update(model, b, y, listener);
  lqg::step::predict(model, b, applied, listener);
  TEST_ASSERT_TRUE(u == applied && a.u == applied && numbers(a) == numbers(b));
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_multiply_add_rounds_once_when_fused_and_twice_when_not);
  RUN_TEST(test_finite_is_neither_infinite_nor_NaN);
  RUN_TEST(test_usable_is_a_finite_innovation_of_positive_variance);
  RUN_TEST(test_control_keeps_its_limits_and_says_so);
  RUN_TEST(test_an_input_exactly_at_its_limit_is_not_limited);
  RUN_TEST(test_control_of_a_state_that_is_no_number_is_zero_or_the_limit_nearest_to_it);
  RUN_TEST(test_an_infinite_limit_is_none);
  RUN_TEST(test_control_without_limits_is_zero_where_it_overflows);
  RUN_TEST(test_a_sample_makes_its_calls_in_the_order_of_the_form);
  RUN_TEST(test_the_form_makes_a_difference);
  RUN_TEST(test_the_input_that_acts_is_that_of_the_last_predict_or_control);
  RUN_TEST(test_what_the_outputs_told_of_w_is_used_once);
  RUN_TEST(test_a_state_that_is_not_finite_begins_anew);
  RUN_TEST(test_a_reset_in_update_is_seen_by_control);
  RUN_TEST(test_an_estimator_alone_takes_the_input_as_it_is);
  return UNITY_END();
}
