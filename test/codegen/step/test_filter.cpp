// SPDX-License-Identifier: MIT
// The three filters against the textbook, against each other, and against what must not happen.
#include <limits>

#include <unity.h>

#include "textbook.hpp"

using namespace lqg_test;
using lqg::step::Event;
using lqg::step::Listener;

namespace {

using Long = Textbook::Number;

constexpr int controllers = 40, samples = 150;

// The largest error of a filter in the precision S, relative to the largest entry: a sample makes at most 8 nx (nx +
// ny) roundings of half an ε that count, about the square root of that many add up, S⁻¹ amplifies them by its
// condition, and poles within 0.9 forget them in 1/(1 − 0.9) samples.
template <class S>
double tolerance(const Model<S>& model, const Textbook& textbook) {
  const double roundings = std::sqrt(8.0 * model.nx * (model.nx + model.ny)), memory = 1 / (1 - 0.9);
  const double unit = static_cast<double>(std::numeric_limits<real_of<S>>::epsilon()) / 2;
  return unit * roundings * memory * textbook.worst_condition();
}

Shape random_shape(Random& random, Filter filter) {
  Shape shape;
  shape.filter = filter;
  shape.nx = random.between(1, 12);
  shape.nu = random.between(1, 3);
  shape.ny = random.between(1, 4);
  shape.nq = random.between(0, shape.nx);
  shape.has_D = random.one_in(2);
  shape.has_M = random.one_in(2);
  shape.has_E = random.one_in(2);
  return shape;
}

template <class Derived>
double largest(const Eigen::MatrixBase<Derived>& values) {
  return values.size() ? static_cast<double>(values.cwiseAbs().maxCoeff()) : 0;
}

template <class S>
Vector<Long> long_numbers(const Vector<S>& values) {
  Vector<Long> out(values.size());
  for (int i = 0; i < values.size(); ++i) out(i) = static_cast<Long>(to_double(values(i)));
  return out;
}

void expect_near(double largest_error, double tolerance, double scale, int seed, const char* what) {
  if (largest_error <= tolerance * scale) return;
  char message[160];
  std::snprintf(message, sizeof message, "seed %d: %s is off by %g of %g, accepted %g", seed, what, largest_error,
                scale, tolerance * scale);
  TEST_FAIL_MESSAGE(message);
}

// Outputs that need not come from the plant: whatever they are, the same estimate must come out.
template <class S>
void run_beside_textbook(Filter filter, int seed) {
  Random random(static_cast<std::uint64_t>(seed));
  const Model<double> exact = random_model(random, random_shape(random, filter));
  const Model<S> model = convert<S>(exact);
  Textbook textbook(exact);
  State<S> state = lqg::step::initial_state(model);
  Vector<S> u = Vector<S>::Constant(model.nu, S(0));
  double scale_x = 1, scale_P = largest(textbook.P());
  for (int k = 0; k < samples; ++k) {
    Listener listener;
    const Vector<S> y = random_vector<S>(random, model.ny);
    textbook.update(long_numbers(y), long_numbers(u));
    TEST_ASSERT_TRUE(lqg::step::update(model, state, y, listener));
    scale_x = std::max(scale_x, largest(textbook.x()));
    const double accepted = tolerance(model, textbook);
    expect_near(largest(long_numbers(state.x) - textbook.x()), accepted, scale_x * (1 + scale_P), seed, "x");
    expect_near(largest(covariance(model, state) - textbook.P().cast<double>()), accepted, scale_P, seed, "P");
    u = random_vector<S>(random, model.nu);
    textbook.predict(long_numbers(u));
    TEST_ASSERT_TRUE(lqg::step::predict(model, state, u, listener));
    scale_P = std::max(scale_P, largest(textbook.P()));
    TEST_ASSERT_EQUAL_UINT(0, listener.events);
  }
}

template <class S>
void run_all_beside_textbook(Filter filter) {
  for (int seed = 0; seed < controllers; ++seed) run_beside_textbook<S>(filter, seed);
}

void test_plain_filter_is_that_of_the_textbook_in_double() { run_all_beside_textbook<double>(Filter::plain); }
void test_plain_filter_is_that_of_the_textbook_in_float() { run_all_beside_textbook<float>(Filter::plain); }
void test_plain_filter_is_that_of_the_textbook_in_fused_float() {
  run_all_beside_textbook<Fused<float>>(Filter::plain);
}
void test_ud_filter_is_that_of_the_textbook_in_double() { run_all_beside_textbook<double>(Filter::ud); }
void test_ud_filter_is_that_of_the_textbook_in_float() { run_all_beside_textbook<float>(Filter::ud); }
void test_ud_filter_is_that_of_the_textbook_in_fused_double() { run_all_beside_textbook<Fused<double>>(Filter::ud); }

// The model of the constant gain that an online filter ends with.
Model<double> steady_model(const Model<double>& online) {
  constexpr int until_converged = 2000;  // 0.9²⁰⁰⁰ is nothing
  Textbook textbook(online);
  for (int k = 0; k < until_converged; ++k) {
    textbook.update(Vector<Long>::Zero(online.ny), Vector<Long>::Zero(online.nu));
    textbook.predict(Vector<Long>::Zero(online.nu));
  }
  Model<double> steady = online;
  steady.filter = Filter::steady;
  steady.C = textbook.raw_C();
  steady.D = online.D.cols() ? textbook.raw_D() : online.D;
  steady.L = textbook.L().cast<double>();
  steady.M = online.M.cols() ? Matrix<double>(textbook.M().cast<double>()) : online.M;
  steady.P0.clear(), steady.U0.clear(), steady.D0.clear();
  return steady;
}

// After as many samples as make 0.9^k vanish the online filter has forgotten P0, and both have forgotten x0.
void test_online_gain_converges_to_the_constant_one() {
  constexpr int forgotten = 400;
  for (const Filter filter : {Filter::plain, Filter::ud})
    for (int seed = 0; seed < controllers / 2; ++seed) {
      Random random(static_cast<std::uint64_t>(seed));
      const Model<double> online = random_model(random, random_shape(random, filter)), steady = steady_model(online);
      State<double> a = lqg::step::initial_state(online), b = lqg::step::initial_state(steady);
      Textbook textbook(online);
      Listener listener;
      double scale = 1;
      for (int k = 0; k < forgotten + samples; ++k) {
        const Vector<double> y = random_vector<double>(random, online.ny), u = random_vector<double>(random, online.nu);
        lqg::step::update(online, a, y, listener);
        lqg::step::update(steady, b, y, listener);
        scale = std::max(scale, largest(b.x));
        textbook.update(long_numbers(y), long_numbers(u));
        const double accepted = 2 * tolerance(online, textbook) * (1 + largest(textbook.P()));
        if (k >= forgotten) expect_near(largest(a.x - b.x), accepted, scale, seed, "x");
        lqg::step::predict(online, a, u, listener);
        lqg::step::predict(steady, b, u, listener);
        textbook.predict(long_numbers(u));
      }
    }
}

// Small whole numbers, so that y − C x − D u is 0 exactly.
void test_constant_gain_does_nothing_when_every_output_comes_as_expected() {
  Model<float> model;
  model.filter = Filter::steady;
  model.nx = 2, model.nu = 1, model.ny = 2;
  model.C = Matrix<float>::Identity(2, 2) * 3;
  model.D = Matrix<float>::Constant(2, 1, 2);
  model.L = Matrix<float>::Constant(2, 2, 0.3f);
  model.M.resize(2, 0);
  model.x0 = Vector<float>::Constant(2, 5);
  State<float> state = lqg::step::initial_state(model);
  state.u(0) = 7;
  Listener listener;
  TEST_ASSERT_TRUE(lqg::step::update(model, state, Vector<float>(Vector<float>::Constant(2, 29)), listener));
  TEST_ASSERT_TRUE(state.x == model.x0);
  TEST_ASSERT_EQUAL_UINT(0, listener.events);
  lqg::step::update(model, state, Vector<float>(Vector<float>::Constant(2, 30)), listener);
  TEST_ASSERT_FALSE(state.x == model.x0);
}

// A first estimate that is nearly unknown, a sensor that is nearly exact, in float: what makes covariances negative.
void test_D_of_UD_stays_positive_when_V_is_tiny_and_P0_huge() {
  for (int seed = 0; seed < controllers; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    Shape shape = random_shape(random, Filter::ud);
    shape.nq = shape.nx;
    Model<float> model = convert<float>(random_model(random, shape));
    for (float& variance : model.D0) variance = 1e12f;
    model.V *= 1e-10f;
    State<float> state = lqg::step::initial_state(model);
    Listener listener;
    for (int k = 0; k < samples; ++k) {
      TEST_ASSERT_TRUE(lqg::step::update(model, state, random_vector<float>(random, model.ny), listener));
      for (const float variance : state.D) TEST_ASSERT_TRUE(variance >= 0);
      TEST_ASSERT_TRUE(lqg::step::predict(model, state, random_vector<float>(random, model.nu), listener));
      for (const float variance : state.D) TEST_ASSERT_TRUE(variance >= 0);
    }
    TEST_ASSERT_EQUAL_UINT(0, listener.events);
  }
}

void test_UD_goes_on_when_a_variance_has_died_out() {
  Random random(1);
  Shape shape = {Filter::ud};
  shape.nx = 4, shape.nq = 0;
  Model<float> model = convert<float>(random_model(random, shape));
  model.D0.assign(4, 0);
  State<float> state = lqg::step::initial_state(model);
  Listener listener;
  for (int k = 0; k < samples; ++k) {
    TEST_ASSERT_TRUE(lqg::step::update(model, state, random_vector<float>(random, 1), listener));
    TEST_ASSERT_TRUE(lqg::step::predict(model, state, random_vector<float>(random, 1), listener));
    for (const float variance : state.D) TEST_ASSERT_TRUE(variance == 0);
  }
}

// Both ways to an entry are one number, and every number is an entry.
void test_P_is_symmetric_by_its_storage() {
  constexpr int n = 13;
  std::vector<int> places(n * (n + 1) / 2, 0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      TEST_ASSERT_EQUAL_INT(lqg::step::triangle(i, j), lqg::step::triangle(j, i));
      ++places.at(static_cast<std::size_t>(lqg::step::triangle(i, j)));
    }
  int diagonal = 0;
  for (const int count : places) {
    TEST_ASSERT_TRUE(count == 1 || count == 2);
    diagonal += count == 1;
  }
  TEST_ASSERT_EQUAL_INT(n, diagonal);
}

void test_every_entry_above_the_diagonal_of_U_has_a_place_of_its_own() {
  constexpr int n = 13;
  std::vector<int> places(n * (n - 1) / 2, 0);
  for (int j = 0; j < n; ++j)
    for (int k = 0; k < j; ++k) ++places.at(static_cast<std::size_t>(lqg::step::strict_triangle(k, j)));
  for (const int count : places) TEST_ASSERT_EQUAL_INT(1, count);
}

template <class S>
bool equal(const State<S>& a, const State<S>& b) {
  return numbers(a) == numbers(b);
}

// The model without output `left_out`.
template <class S>
Model<S> without(const Model<S>& model, int left_out) {
  Model<S> less = model;
  const auto remove_row = [&](auto& matrix) {
    auto kept = matrix;
    kept.resize(matrix.rows() - 1, matrix.cols());
    for (int i = 0, to = 0; i < matrix.rows(); ++i)
      if (i != left_out) kept.row(to++) = matrix.row(i);
    matrix = kept;
  };
  const auto remove_column = [&](Matrix<S>& matrix) {
    matrix.transposeInPlace();
    remove_row(matrix);
    matrix.transposeInPlace();
  };
  remove_row(less.C);
  if (model.D.cols())
    remove_row(less.D);
  else
    less.D.resize(model.ny - 1, 0);
  if (model.filter == Filter::steady)
    remove_column(less.L);
  else
    remove_row(less.V);
  if (model.filter != Filter::steady) less.E = Matrix<S>::Identity(model.ny - 1, model.ny - 1);
  if (model.M.cols()) remove_column(less.M);
  --less.ny;
  return less;
}

Vector<float> without(const Vector<float>& y, int left_out) {
  Vector<float> less(y.size() - 1);
  for (int i = 0, to = 0; i < y.size(); ++i)
    if (i != left_out) less(to++) = y(i);
  return less;
}

void test_an_output_that_is_not_finite_is_as_if_there_were_none() {
  const float hostile[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                           -std::numeric_limits<float>::infinity()};
  for (const Filter filter : {Filter::steady, Filter::plain, Filter::ud})
    for (int seed = 0; seed < controllers; ++seed) {
      Random random(static_cast<std::uint64_t>(seed));
      Shape shape = random_shape(random, filter);
      shape.ny = random.between(2, 4);
      shape.has_E = false;
      const Model<float> all = convert<float>(random_model(random, shape));
      const int bad = random.below(shape.ny);
      const Model<float> fewer = without(all, bad);
      State<float> a = lqg::step::initial_state(all), b = lqg::step::initial_state(fewer);
      for (int k = 0; k < 20; ++k) {
        Listener of_all, of_fewer;
        Vector<float> y = random_vector<float>(random, shape.ny);
        const Vector<float> u = random_vector<float>(random, shape.nu);
        y(bad) = hostile[random.below(3)];
        lqg::step::update(all, a, y, of_all);
        lqg::step::update(fewer, b, without(y, bad), of_fewer);
        lqg::step::predict(all, a, u, of_all);
        lqg::step::predict(fewer, b, u, of_fewer);
        TEST_ASSERT_TRUE(a.x == b.x && a.P == b.P && a.U == b.U && a.D == b.D);
        TEST_ASSERT_EQUAL_UINT(1u << static_cast<unsigned>(Event::output_rejected) |
                                   1u << static_cast<unsigned>(lqg::step::rejection_of(bad)),
                               of_all.events);
        TEST_ASSERT_EQUAL_UINT(0, of_fewer.events);
      }
    }
}

void test_an_output_of_infinite_variance_is_as_one_that_is_left_out() {
  for (int seed = 0; seed < controllers; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    Shape shape = random_shape(random, Filter::plain);
    shape.ny = random.between(2, 4);
    shape.has_E = shape.has_M = false;
    const Model<double> model = random_model(random, shape);
    Model<double> unsure = model;
    const int bad = random.below(shape.ny);
    unsure.V(bad) = std::numeric_limits<double>::infinity();
    State<double> a = lqg::step::initial_state(model), b = lqg::step::initial_state(unsure);
    Listener listener;
    for (int k = 0; k < 20; ++k) {
      Vector<double> y = random_vector<double>(random, shape.ny);
      const Vector<double> u = random_vector<double>(random, shape.nu);
      lqg::step::update(unsure, b, y, listener);
      y(bad) = std::numeric_limits<double>::quiet_NaN();
      lqg::step::update(model, a, y, listener);
      TEST_ASSERT_TRUE(equal(a, b));
      lqg::step::predict(model, a, u, listener);
      lqg::step::predict(unsure, b, u, listener);
    }
  }
}

void test_without_any_finite_output_update_changes_no_bit() {
  for (const Filter filter : {Filter::steady, Filter::plain, Filter::ud})
    for (int seed = 0; seed < controllers; ++seed) {
      Random random(static_cast<std::uint64_t>(seed));
      const Model<float> model = convert<float>(random_model(random, random_shape(random, filter)));
      State<float> state = lqg::step::initial_state(model);
      Listener listener;
      lqg::step::update(model, state, random_vector<float>(random, model.ny), listener);
      lqg::step::predict(model, state, random_vector<float>(random, model.nu), listener);
      const State<float> before = state;
      const float nothing = std::numeric_limits<float>::quiet_NaN();
      TEST_ASSERT_TRUE(
          lqg::step::update(model, state, Vector<float>(Vector<float>::Constant(model.ny, nothing)), listener));
      TEST_ASSERT_TRUE(equal(before, state));
    }
}

void test_a_zero_of_E_keeps_a_NaN_out_of_the_other_outputs() {
  Random random(1);
  Shape shape = {Filter::plain};
  shape.nx = 2, shape.ny = 3;
  Model<double> model = random_model(random, shape);
  model.E(1, 0) = 0.5;  // the second output hears of the first, the third does not
  Vector<double> y = random_vector<double>(random, 3);
  y(0) = std::numeric_limits<double>::quiet_NaN();
  Listener listener;
  const Vector<double> uncorrelated = lqg::step::decorrelate(model, y, listener);
  TEST_ASSERT_TRUE(std::isnan(uncorrelated(0)) && std::isnan(uncorrelated(1)));
  TEST_ASSERT_TRUE(uncorrelated(2) == y(2));
}

void test_plain_finds_that_P_is_none_where_S_is_not_positive() {
  Random random(1);
  Shape shape = {Filter::plain};
  shape.nx = 2;
  Model<double> model = random_model(random, shape);
  model.P0 = {-100, 0, -100};
  State<double> state = lqg::step::initial_state(model);
  const State<double> before = state;
  Listener listener;
  TEST_ASSERT_FALSE(lqg::step::update(model, state, random_vector<double>(random, 1), listener));
  TEST_ASSERT_TRUE(equal(before, state));
  TEST_ASSERT_EQUAL_UINT(1u << static_cast<unsigned>(Event::innovation_not_positive), listener.events);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_plain_filter_is_that_of_the_textbook_in_double);
  RUN_TEST(test_plain_filter_is_that_of_the_textbook_in_float);
  RUN_TEST(test_plain_filter_is_that_of_the_textbook_in_fused_float);
  RUN_TEST(test_ud_filter_is_that_of_the_textbook_in_double);
  RUN_TEST(test_ud_filter_is_that_of_the_textbook_in_float);
  RUN_TEST(test_ud_filter_is_that_of_the_textbook_in_fused_double);
  RUN_TEST(test_online_gain_converges_to_the_constant_one);
  RUN_TEST(test_constant_gain_does_nothing_when_every_output_comes_as_expected);
  RUN_TEST(test_D_of_UD_stays_positive_when_V_is_tiny_and_P0_huge);
  RUN_TEST(test_UD_goes_on_when_a_variance_has_died_out);
  RUN_TEST(test_P_is_symmetric_by_its_storage);
  RUN_TEST(test_every_entry_above_the_diagonal_of_U_has_a_place_of_its_own);
  RUN_TEST(test_an_output_that_is_not_finite_is_as_if_there_were_none);
  RUN_TEST(test_an_output_of_infinite_variance_is_as_one_that_is_left_out);
  RUN_TEST(test_without_any_finite_output_update_changes_no_bit);
  RUN_TEST(test_a_zero_of_E_keeps_a_NaN_out_of_the_other_outputs);
  RUN_TEST(test_plain_finds_that_P_is_none_where_S_is_not_positive);
  return UNITY_END();
}
