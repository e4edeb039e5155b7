// SPDX-License-Identifier: MIT
// Extended filters against a reference of 60 digits, their Jacobians against differences, linear equations against the
// linear filter, and what must not happen.
#include <cmath>
#include <limits>

#include <unity.h>

#include "extended_model.hpp"
#include "extended_reference.hpp"

using namespace lqg_test;
using lqg::step::Event;
using lqg::step::Filter;
using lqg::step::Integration;
using lqg::step::Listener;

namespace reference = extended_reference;

namespace {

using Long =
    boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<50>, boost::multiprecision::et_off>;

const Texts cart = {{"p", "v", "th", "om"},
                    {"F"},
                    {"v", "(F - 0.1*v + 0.2*sin(th)*(0.3*om^2 - 9.81*cos(th)))/(0.5 + 0.2*sin(th)^2)", "om",
                     "(9.81*0.7*sin(th) - cos(th)*(F - 0.1*v + 0.2*0.3*om^2*sin(th)))/(0.3*(0.5 + 0.2*sin(th)^2))"},
                    {"p", "th"},
                    {false, true}};
const Texts ship = {
    {"px", "py", "heading", "speed"},
    {"turn"},
    {"px + 0.5*speed*cos(heading)", "py + 0.5*speed*sin(heading)", "heading + 0.5*turn", "speed*exp(-0.5/64)"},
    {"sqrt(px^2 + py^2)", "atan2(py, px)"},
    {false, true}};

template <class S>
Model<S> cart_model(Filter filter) {
  Noises noises;
  noises.W = {1e-6, 1e-4, 1e-6, 1e-3};
  noises.P0 = {0.01, 1, 0.25, 1};
  noises.V = {0.0004, 0.0025};
  noises.V_01 = 0.0002;
  Model<S> model = extended_model<S>(cart, Integration::rk4, 0.01, filter, noises);
  model.x0(2) = S(0.25);
  return model;
}

template <class S>
Model<S> ship_model(Filter filter) {
  Noises noises;
  noises.W = {0.01, 0.01, 1e-4, 0.01};
  noises.P0 = {25, 25, 0.25, 4};
  noises.V = {0.25, 0.0004};
  Model<S> model = extended_model<S>(ship, Integration::none, 0.5, filter, noises);
  const double start[] = {-38, 22, -1.25, 5};
  for (int i = 0; i < 4; ++i) model.x0(i) = S(start[i]);
  return model;
}

void expect_near(double expected, double found, double accepted, const char* what, int sample) {
  if (std::abs(expected - found) <= accepted) return;
  char message[160];
  std::snprintf(message, sizeof message, "%s of sample %d: expected %.17g, found %.17g", what, sample, expected, found);
  TEST_FAIL_MESSAGE(message);
}

// x̂ and P after each prediction, relative to the largest of that sample.
template <class S, std::size_t nx, std::size_t np>
void expect_reference(const Model<S>& model, const double (&y)[reference::samples][2],
                      const double (&u)[reference::samples][1], const double (&x)[reference::samples][nx],
                      const double (&P)[reference::samples][np], double accepted) {
  auto state = lqg::step::initial_state(model);
  for (int k = 0; k < reference::samples; ++k) {
    Vector<S> outputs(2), input(1);
    for (int i = 0; i < 2; ++i) outputs(i) = S(y[k][i]);
    input(0) = S(u[k][0]);
    const unsigned events = run_sample(model, state, outputs, input);
    const bool misses = std::isnan(y[k][0]) || std::isnan(y[k][1]);
    TEST_ASSERT_EQUAL(misses, events != 0);
    const std::vector<S> found = lqg::step::covariance(model, state);
    double largest = 0;
    for (const double entry : P[k]) largest = std::max(largest, std::abs(entry));
    for (std::size_t i = 0; i < nx; ++i)
      expect_near(x[k][i], number(state.x(static_cast<int>(i))), accepted * std::max(1.0, std::abs(x[k][i])), "x", k);
    for (std::size_t i = 0; i < np; ++i) expect_near(P[k][i], number(found[i]), accepted * largest, "P", k);
  }
}

void test_a_cart_with_a_pole_by_runge_and_kutta_with_correlated_outputs() {
  for (const Filter filter : {Filter::ud, Filter::plain}) {
    expect_reference(cart_model<double>(filter), reference::cart_y, reference::cart_u, reference::cart_x,
                     reference::cart_P, 1e-12);
    expect_reference(cart_model<lqg::step::Fused<double>>(filter), reference::cart_y, reference::cart_u,
                     reference::cart_x, reference::cart_P, 1e-12);
    expect_reference(cart_model<float>(filter), reference::cart_y, reference::cart_u, reference::cart_x,
                     reference::cart_P, 2e-4);
    expect_reference(cart_model<Long>(filter), reference::cart_y, reference::cart_u, reference::cart_x,
                     reference::cart_P, 1e-15);
  }
}

void test_a_ship_whose_bearing_jumps() {
  for (const Filter filter : {Filter::ud, Filter::plain}) {
    expect_reference(ship_model<double>(filter), reference::ship_y, reference::ship_u, reference::ship_x,
                     reference::ship_P, 1e-12);
    expect_reference(ship_model<float>(filter), reference::ship_y, reference::ship_u, reference::ship_x,
                     reference::ship_P, 2e-4);
  }
  bool jumps = false;
  for (int k = 1; k < reference::samples; ++k)
    jumps = jumps || std::abs(reference::ship_y[k][1] - reference::ship_y[k - 1][1]) > 3;
  TEST_ASSERT_TRUE(jumps);
}

// (step(x + h) − step(x − h))/2h with 50 digits.
void test_the_jacobian_is_that_of_the_step() {
  for (const Integration integration : {Integration::rk4, Integration::euler}) {
    const Model<Long> model = extended_model<Long>(cart, integration, 0.01, Filter::plain, Noises());
    Vector<Long> x(4), u = Vector<Long>::Constant(1, Long(0.75));
    x << Long(0.5), Long(-1.25), Long(0.7), Long(2.5);
    Listener listener;
    const auto step_from = [&](const Vector<Long>& from) {
      return lqg::step::next_state(*model.equations, lqg::step::variables(from), u, listener);
    };
    const auto exact = step_from(x);
    const Long h = pow(Long(10), -16);
    for (int j = 0; j < 4; ++j) {
      Vector<Long> up = x, down = x;
      up(j) += h, down(j) -= h;
      const auto above = step_from(up), below = step_from(down);
      for (std::size_t i = 0; i < 4; ++i) {
        const Long difference = (above[i].value - below[i].value) / (2 * h) - exact[i].slope(j);
        TEST_ASSERT_TRUE(abs(difference) < pow(Long(10), -28));
      }
    }
  }
}

// x⁺ = A x + B u, y = C x + D u written as formulas.
template <class S>
void expect_linear_filter(Filter filter, double accepted) {
  const Texts texts = {{"a", "b"},
                       {"w"},
                       {"0.75*a + 0.25*b + 0.5*w", "-0.125*a + 0.875*b + w"},
                       {"a + 0.5*b + 0.25*w", "b"},
                       {false, false}};
  Noises noises;
  noises.W = {0.25, 0.5};
  noises.P0 = {1, 2};
  noises.V = {0.5, 0.25};
  noises.V_01 = 0.125;
  const Model<S> extended = extended_model<S>(texts, Integration::none, 1, filter, noises);
  Model<S> linear = extended;
  linear.equations = nullptr;
  linear.A << S(0.75), S(0.25), S(-0.125), S(0.875);
  linear.A_free = linear.A;
  linear.B << S(0.5), S(1.0);
  Matrix<S> C(2, 2), D(2, 1);
  C << S(1), S(0.5), S(0), S(1);
  D << S(0.25), S(0);
  linear.C = linear.E * C;
  linear.D = linear.E * D;
  auto one = lqg::step::initial_state(extended), other = lqg::step::initial_state(linear);
  for (int k = 0; k < 30; ++k) {
    Vector<S> y(2), u(1);
    y << S(std::sin(k)), S(k % 5 == 2 ? std::numeric_limits<double>::quiet_NaN() : std::cos(3 * k));
    u << S(0.5 * std::sin(0.3 * k));
    Vector<S> again = u;
    TEST_ASSERT_EQUAL(run_sample(linear, other, y, again), run_sample(extended, one, y, u));
    const std::vector<S> P = lqg::step::covariance(extended, one), expected = lqg::step::covariance(linear, other);
    for (int i = 0; i < 2; ++i) expect_near(number(other.x(i)), number(one.x(i)), accepted, "x", k);
    for (std::size_t i = 0; i < P.size(); ++i) expect_near(number(expected[i]), number(P[i]), accepted, "P", k);
  }
}

void test_linear_equations_give_the_linear_filter() {
  for (const Filter filter : {Filter::ud, Filter::plain}) {
    expect_linear_filter<double>(filter, 1e-14);
    expect_linear_filter<float>(filter, 1e-5);
  }
}

// ln is finite and has slopes for what is positive, √ has no slope at 0.
void test_an_output_that_h_cannot_expect_is_left_out() {
  const Texts texts = {{"a", "b"}, {}, {"a", "b"}, {"log(a)", "sqrt(b)", "b"}, {false, false, false}};
  Noises noises;
  noises.W = {0.5, 0.5};
  noises.P0 = {1, 1};
  noises.V = {1, 1, 1};
  for (const Filter filter : {Filter::ud, Filter::plain}) {
    const Model<double> model = extended_model<double>(texts, Integration::none, 1, filter, noises);
    for (const double a : {-1.0, 0.0}) {
      auto state = lqg::step::initial_state(model);
      state.x(0) = a;
      const auto before = state;
      Listener listener;
      Vector<double> y(3);
      y << 1, 1, 2;
      TEST_ASSERT_TRUE(update(model, state, y, listener));
      TEST_ASSERT_TRUE(listener.events == (1u << static_cast<unsigned>(Event::output_rejected) |
                                           1u << static_cast<unsigned>(lqg::step::rejection_of(0)) |
                                           1u << static_cast<unsigned>(lqg::step::rejection_of(1))));
      TEST_ASSERT_TRUE(state.x(0) == before.x(0));
      TEST_ASSERT_TRUE(state.x(1) == 1);  // half of the third output's innovation
    }
  }
}

void test_a_prediction_that_is_not_finite_begins_anew() {
  const Texts texts = {{"a"}, {}, {"1/a"}, {"a"}, {false}};
  Noises noises;
  noises.W = {1};
  noises.P0 = {1};
  noises.V = {1};
  for (const Filter filter : {Filter::ud, Filter::plain}) {
    Model<double> model = extended_model<double>(texts, Integration::none, 1, filter, noises);
    model.x0(0) = 2;
    auto state = lqg::step::initial_state(model);
    state.x(0) = 0;
    Vector<double> u(0), y = Vector<double>::Constant(1, std::numeric_limits<double>::quiet_NaN());
    const unsigned events = run_sample(model, state, y, u);
    TEST_ASSERT_TRUE((events & 1u << static_cast<unsigned>(Event::state_reset)) != 0);
    TEST_ASSERT_TRUE(state.x(0) == 2);
  }
}

// What h says of an input is of the one applied last: that of predict.
void test_an_output_hears_the_input_applied_last() {
  const Texts texts = {{"a"}, {"w"}, {"a"}, {"a + w^2"}, {false}};
  Noises noises;
  noises.W = {0.5};
  noises.P0 = {1};
  noises.V = {1};
  const Model<double> model = extended_model<double>(texts, Integration::none, 1, Filter::ud, noises);
  auto state = lqg::step::initial_state(model);
  Listener listener;
  predict(model, state, Vector<double>(Vector<double>::Constant(1, 3.0)), listener);
  const Vector<double> y = Vector<double>::Constant(1, 9.0);
  update(model, state, y, listener);
  TEST_ASSERT_TRUE(state.x(0) == 0);
}

// One output alone is the update of a sample in which the others are missing.
void test_an_update_alone_is_that_without_the_others() {
  const Model<double> model = ship_model<double>(Filter::ud);
  auto alone = lqg::step::initial_state(model), without = alone;
  Listener listener;
  Vector<double> y(2);
  y << std::numeric_limits<double>::quiet_NaN(), 2.5;
  update(model, without, y, listener);
  update_alone(model, alone, 2.5, 1, listener);
  TEST_ASSERT_TRUE(alone.x == without.x && alone.U == without.U && alone.D == without.D);
}

}  // namespace

void setUp(void) {}
void tearDown(void) {}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_a_cart_with_a_pole_by_runge_and_kutta_with_correlated_outputs);
  RUN_TEST(test_a_ship_whose_bearing_jumps);
  RUN_TEST(test_the_jacobian_is_that_of_the_step);
  RUN_TEST(test_linear_equations_give_the_linear_filter);
  RUN_TEST(test_an_output_that_h_cannot_expect_is_left_out);
  RUN_TEST(test_a_prediction_that_is_not_finite_begins_anew);
  RUN_TEST(test_an_output_hears_the_input_applied_last);
  RUN_TEST(test_an_update_alone_is_that_without_the_others);
  return UNITY_END();
}
