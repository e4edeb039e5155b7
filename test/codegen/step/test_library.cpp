// SPDX-License-Identifier: MIT
// The C library and the templates are two texts of one algorithm: they agree in every bit, whatever the sensors say.
//
// Built once for each variant of the library.
#include <limits>

#include <unity.h>

#include "library_numbers.hpp"

using namespace lqg_test;
using lqg::step::Event;
using lqg::step::Listener;

namespace {

using Limits = std::numeric_limits<lqg_real>;

constexpr int largest_nx = 12, controllers = 250, samples = 300;

Numbers in_order(const std::vector<S>& values) {
  Numbers out;
  for (const S& value : values) out.push_back(number(value));
  return out;
}

bool is_identity(const Matrix<S>& matrix) {
  for (int i = 0; i < matrix.rows(); ++i)
    for (int j = 0; j < matrix.cols(); ++j)
      if (number(matrix(i, j)) != (i == j ? 1 : 0)) return false;
  return true;
}

// The model as the library wants it.
struct Description {
  explicit Description(const Model<S>& model);

  Numbers A, B, C, D, L, M, E, V, A_free, W, G, variances, x0, P0, U0, d0, K, u_min, u_max, x_scale, limit;
  lqg_loop_steady_t steady;
  lqg_loop_plain_t plain;
  lqg_loop_ud_t ud;
};

Description::Description(const Model<S>& model)
    : A(row_major(model.A)), B(row_major(model.B)), C(row_major(model.C)), D(row_major(model.D)), L(row_major(model.L)),
      M(row_major(model.M)), E(row_major(model.E)), V(row_major(model.V)), A_free(row_major(model.A_free)),
      G(row_major(model.G)), variances(row_major(model.w)), x0(row_major(model.x0)), P0(in_order(model.P0)),
      U0(in_order(model.U0)), d0(in_order(model.D0)), K(row_major(model.K)), u_min(row_major(model.u_min)),
      u_max(row_major(model.u_max)), limit(row_major(model.nu_limit)) {
  for (const int bound : model.x_bound) x_scale.push_back(std::ldexp(static_cast<lqg_real>(1), -bound));
  for (int i = 0; i < model.W.rows(); ++i)
    for (int j = 0; j <= i; ++j) W.push_back(number(model.W(i, j)));
  if (is_identity(model.E)) E.clear();
  const auto nx = static_cast<unsigned>(model.nx), nu = static_cast<unsigned>(model.nu),
             ny = static_cast<unsigned>(model.ny);
  const lqg_real* free = M.empty() ? nullptr : pointer(A_free);
  const lqg_plant_t plant = {nx, nu, ny, pointer(A), pointer(B), pointer(C), pointer(D), nullptr};
  const lqg_lqr_t lqr = {nx, nu, pointer(K), pointer(u_min), pointer(u_max)};
  const lqg_form_t form = model.predictor_form ? LQG_PREDICTOR_FORM : LQG_FILTER_FORM;
  steady = {
      {plant, pointer(L), pointer(M), pointer(x0), pointer(x_scale), pointer(limit), nullptr, nullptr}, lqr, form};
  plain = {{plant, pointer(E), pointer(V), pointer(W), pointer(M), free, pointer(x0), pointer(P0), pointer(x_scale),
            pointer(limit), nullptr},
           lqr,
           form};
  ud = {{plant, pointer(E), pointer(V), static_cast<unsigned>(model.G.cols()), pointer(G), pointer(variances),
         pointer(M), free, pointer(x0), pointer(U0), pointer(d0), pointer(x_scale), pointer(limit), nullptr},
        lqr,
        form};
}

// The library's side: its state and its calls.
class Library {
 public:
  explicit Library(const Model<S>& model)
      : description_(model), filter_(model.filter), x_(size(model.nx)), P_(model.P0.size()), U_(model.U0.size()),
        d_(model.D0.size()), u_(size(static_cast<int>(model.D.cols()))),
        innovation_(model.M.cols() ? size(model.ny) : 0),
        work_(LQG_KALMAN_UD_WORK(size(model.nx), size(model.ny), size(static_cast<int>(model.G.cols())))) {
    switch (filter_) {
      case Filter::plain: lqg_kalman_plain_init(&description_.plain.kalman, &plain_); break;
      case Filter::ud: lqg_kalman_ud_init(&description_.ud.kalman, &ud_); break;
      default: lqg_kalman_steady_init(&description_.steady.kalman, &steady_);
    }
  }
  Library(const Library&) = delete;  // the states point into it
  lqg_status_t update(const Numbers& y) {
    switch (filter_) {
      case Filter::plain: return lqg_kalman_plain_update(&description_.plain.kalman, &plain_, y.data());
      case Filter::ud: return lqg_kalman_ud_update(&description_.ud.kalman, &ud_, y.data());
      default: return lqg_kalman_steady_update(&description_.steady.kalman, &steady_, y.data());
    }
  }
  lqg_status_t predict(const Numbers& applied) {
    switch (filter_) {
      case Filter::plain: return lqg_kalman_plain_predict(&description_.plain.kalman, &plain_, pointer(applied));
      case Filter::ud: return lqg_kalman_ud_predict(&description_.ud.kalman, &ud_, pointer(applied));
      default: return lqg_kalman_steady_predict(&description_.steady.kalman, &steady_, pointer(applied));
    }
  }
  lqg_status_t control(Numbers& applied) {
    const lqg_status_t status = lqg_lqr_control(&description_.steady.lqr, x_.data(), applied.data());
    if (!u_.empty()) u_ = applied;
    return status;
  }
  lqg_status_t step(const Numbers& y, Numbers& applied) {
    lqg_loop_steady_state_t steady = {steady_, applied.data()};
    lqg_loop_plain_state_t plain = {plain_, applied.data()};
    lqg_loop_ud_state_t ud = {ud_, applied.data()};
    switch (filter_) {
      case Filter::plain: return lqg_loop_plain_step(&description_.plain, &plain, y.data());
      case Filter::ud: return lqg_loop_ud_step(&description_.ud, &ud, y.data());
      default: return lqg_loop_steady_step(&description_.steady, &steady, y.data());
    }
  }
  // In the order of numbers(State).
  Numbers state() const {
    Numbers all = x_;
    for (const Numbers* part : {&P_, &U_, &d_, &u_, &innovation_}) all.insert(all.end(), part->begin(), part->end());
    return all;
  }

 private:
  static std::size_t size(int count) { return static_cast<std::size_t>(count); }

  Description description_;
  Filter filter_;
  Numbers x_, P_, U_, d_, u_, innovation_, work_;
  lqg_kalman_steady_state_t steady_ = {pointer(x_), pointer(u_), pointer(innovation_), {}, pointer(work_)};
  lqg_kalman_plain_state_t plain_ = {pointer(x_), pointer(P_), pointer(u_), pointer(innovation_), {}, pointer(work_)};
  lqg_kalman_ud_state_t ud_ = {pointer(x_),          pointer(U_), pointer(d_),   pointer(u_),
                               pointer(innovation_), {},          pointer(work_)};
};

lqg_status_t status_of(unsigned events) {
  const auto bit = [&](Event event, lqg_status_t status) {
    return events >> static_cast<unsigned>(event) & 1 ? status : LQG_OK;
  };
  lqg_status_t which = LQG_OK;
  for (int i = 0; i < lqg::step::told_rejections; ++i)
    which |= bit(lqg::step::rejection_of(i), LQG_OUTPUT_REJECTED_BIT(i));
  return which | bit(Event::output_rejected, LQG_OUTPUT_REJECTED) |
         bit(Event::innovation_not_positive, LQG_INNOVATION_NOT_POSITIVE) |
         bit(Event::input_limited, LQG_INPUT_LIMITED) | bit(Event::state_reset, LQG_STATE_RESET) |
         bit(Event::covariance_reset, LQG_COVARIANCE_RESET);
}

// The templates' side.
class Templates {
 public:
  explicit Templates(const Model<S>& model) : model_(model), state_(lqg::step::initial_state(model)) {}
  lqg_status_t update(const Vector<S>& y) {
    Listener listener;
    return finish(listener, lqg::step::update(model_, state_, y, listener));
  }
  lqg_status_t predict(const Vector<S>& u) {
    Listener listener;
    return finish(listener, lqg::step::predict(model_, state_, u, listener));
  }
  lqg_status_t control(Vector<S>& u) {
    Listener listener;
    u = lqg::step::control(model_, state_.x, listener);
    if (model_.D.cols()) state_.u = u;
    return status_of(listener.events);
  }
  lqg_status_t step(const Vector<S>& y, Vector<S>& u) { return status_of(lqg::step::run_sample(model_, state_, y, u)); }
  const State<S>& state() const { return state_; }

 private:
  lqg_status_t finish(Listener& listener, bool is_within) {
    if (!is_within) lqg::step::recover(model_, state_, listener);
    return status_of(listener.events);
  }
  const Model<S>& model_;
  State<S> state_;
};

// What a sensor says: as a rule something honest, now and then anything.
lqg_real random_output(Random& random, int one_hostile_in) {
  const lqg_real hostile[] = {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), Limits::denorm_min()};
  if (!random.one_in(one_hostile_in)) return static_cast<lqg_real>(random.normal());
  return hostile[random.below(sizeof hostile / sizeof *hostile)];
}

class Comparison {
 public:
  Comparison(const Model<S>& model, std::uint64_t seed)
      : model_(model), seed_(seed), library_(model), templates_(model) {}

  void run_sample(const Numbers& y, const Numbers& given, bool in_one_call) {
    ++sample_;
    Numbers u = given;
    Vector<S> y_of_templates = vector(y), u_of_templates = vector(given);
    const bool acts = model_.K.rows() > 0;
    const auto control = [&] {
      if (!acts) return;
      expect("control", library_.control(u), templates_.control(u_of_templates));
      expect_same("u", u, u_of_templates);
    };
    if (acts && in_one_call) {
      expect("step", library_.step(y, u), templates_.step(y_of_templates, u_of_templates));
      return expect_same("u", u, u_of_templates);
    }
    if (model_.predictor_form) control();
    expect("update", library_.update(y), templates_.update(y_of_templates));
    if (!model_.predictor_form) control();
    expect("predict", library_.predict(u), templates_.predict(u_of_templates));
  }
  lqg_status_t seen() const { return seen_; }

 private:
  static Vector<S> vector(const Numbers& numbers) {
    Vector<S> out(static_cast<Eigen::Index>(numbers.size()));
    for (std::size_t i = 0; i < numbers.size(); ++i) out(static_cast<Eigen::Index>(i)) = S(numbers[i]);
    return out;
  }
  void expect(const char* call, lqg_status_t library, lqg_status_t templates) {
    seen_ |= library & ~LQG_OUTPUT_REJECTED_BITS;
    if (library != templates) fail(call, "status", library, templates);
    const Numbers found = library_.state();
    const std::vector<double> expected = numbers(templates_.state());
    for (std::size_t i = 0; i < found.size(); ++i)
      if (!(static_cast<double>(found[i]) == expected[i]))
        fail(call, "state", static_cast<double>(found[i]), expected[i]);
    TEST_ASSERT_EQUAL_size_t(expected.size(), found.size());
  }
  void expect_same(const char* what, const Numbers& library, const Vector<S>& templates) {
    for (std::size_t i = 0; i < library.size(); ++i) {
      const double expected = to_double(templates(static_cast<Eigen::Index>(i)));
      if (!(static_cast<double>(library[i]) == expected))
        fail("control", what, static_cast<double>(library[i]), expected);
    }
  }
  void fail(const char* call, const char* what, double library, double templates) const {
    char message[200];
    std::snprintf(
        message, sizeof message, "seed %d, filter %d, nx %d, sample %d, %s: %s of the library %a, of the template %a",
        static_cast<int>(seed_), static_cast<int>(model_.filter), model_.nx, sample_, call, what, library, templates);
    TEST_FAIL_MESSAGE(message);
  }

  const Model<S>& model_;
  std::uint64_t seed_;
  Library library_;
  Templates templates_;
  int sample_ = 0;
  lqg_status_t seen_ = LQG_OK;
};

Shape random_shape(Random& random, Filter filter) {
  Shape shape;
  shape.filter = filter;
  shape.predictor_form = random.one_in(2);
  shape.nx = random.between(1, largest_nx);
  shape.nu = random.between(0, 4);
  shape.ny = random.between(1, 4);
  shape.nq = random.between(0, shape.nx);
  shape.has_D = shape.nu > 0 && random.one_in(3);
  shape.has_M = random.one_in(3);
  shape.has_E = random.one_in(3);
  shape.has_K = shape.nu > 0 && !random.one_in(3);
  shape.has_limits = shape.has_K && random.one_in(2);
  shape.is_sparse = random.one_in(2);
  return shape;
}

// What a design would not have, but a caller of the library may: variances of 0, a covariance that is none.
void spoil(Random& random, Model<S>& model) {
  for (auto* variances : {&model.D0, &model.P0})
    for (S& variance : *variances)
      if (random.one_in(6)) variance = S(0);
  if (!model.P0.empty() && random.one_in(3)) model.P0[0] = S(-1);
}

// Bounds that are reached now and then, for states of any scale.
void bind(Random& random, Model<S>& model) {
  for (int i = 0; i < model.nx; ++i) model.x_bound.push_back(random.between(-1, 2) * 4);
  model.nu_limit.resize(model.ny);
  for (int i = 0; i < model.ny; ++i) model.nu_limit(i) = S(std::ldexp(static_cast<lqg_real>(1), random.between(0, 12)));
}

template <class Output>
lqg_status_t compare_on_random_models(Filter filter, void (*change)(Random&, Model<S>&), Output output) {
  lqg_status_t seen = LQG_OK;
  for (std::uint64_t seed = 0; seed < controllers; ++seed) {
    Random random(seed);
    const Shape shape = random_shape(random, filter);
    Model<S> model = convert<S>(random_model(random, shape));
    if (change) change(random, model);
    Comparison comparison(model, seed);
    for (int k = 0; k < samples * 4 / (shape.nx + 3); ++k) {
      Numbers y, u;
      for (int i = 0; i < shape.ny; ++i) y.push_back(output(random));
      for (int i = 0; i < shape.nu; ++i) u.push_back(static_cast<lqg_real>(random.normal()));
      comparison.run_sample(y, u, random.one_in(2));
    }
    seen |= comparison.seen();
  }
  return seen;
}

lqg_status_t compare_with_faults(Filter filter) {
  return compare_on_random_models(filter, nullptr, [](Random& random) { return random_output(random, 10); });
}

void test_steady_filter_agrees_while_sensors_fail() {
  TEST_ASSERT_EQUAL_HEX(LQG_OUTPUT_REJECTED | LQG_INPUT_LIMITED, compare_with_faults(Filter::steady));
}
void test_plain_filter_agrees_while_sensors_fail() {  // and when it loses its definiteness meanwhile
  TEST_ASSERT_EQUAL_HEX(LQG_OUTPUT_REJECTED | LQG_INPUT_LIMITED,
                        compare_with_faults(Filter::plain) & ~LQG_COVARIANCE_RESET);
}
void test_ud_filter_agrees_while_sensors_fail() {
  TEST_ASSERT_EQUAL_HEX(LQG_OUTPUT_REJECTED | LQG_INPUT_LIMITED, compare_with_faults(Filter::ud));
}

// Large, but so that no sum overflows: the state is far off, and finite.
lqg_real large_output(Random& random) {
  const int most = Limits::max_exponent / 2 - 4;
  if (!random.one_in(8)) return random_output(random, 10);
  return std::ldexp(static_cast<lqg_real>(random.uniform()), random.between(0, most));
}

void test_filters_agree_on_large_outputs() {
  for (const Filter filter : {Filter::steady, Filter::plain, Filter::ud})
    compare_on_random_models(filter, nullptr, large_output);
}

// Any bits: overflows, resets.
lqg_real any_output(Random& random) {
  const lqg_real largest[] = {Limits::max(), Limits::lowest(), Limits::max() / 3};
  if (!random.one_in(8)) return random_output(random, 10);
  return random.one_in(2) ? random.pattern<lqg_real>() : largest[random.below(3)];
}

void test_filters_agree_when_the_state_overflows_and_begins_anew() {
  for (const Filter filter : {Filter::steady, Filter::plain, Filter::ud})
    TEST_ASSERT_TRUE(compare_on_random_models(filter, nullptr, any_output) & LQG_STATE_RESET);
}

void test_filters_agree_on_a_covariance_that_is_none() {
  for (const Filter filter : {Filter::plain, Filter::ud}) {
    const lqg_status_t seen = compare_on_random_models(filter, spoil, large_output);
    TEST_ASSERT_TRUE(filter == Filter::ud || seen & LQG_INNOVATION_NOT_POSITIVE);
  }
}

void test_filters_agree_within_bounds_and_on_what_to_believe() {
  for (const Filter filter : {Filter::steady, Filter::plain, Filter::ud}) {
    const lqg_status_t seen = compare_on_random_models(filter, bind, large_output);
    TEST_ASSERT_TRUE(seen & LQG_STATE_RESET);
    TEST_ASSERT_TRUE(seen & LQG_OUTPUT_REJECTED);
  }
}

void test_control_agrees_on_any_state() {
  for (std::uint64_t seed = 0; seed < controllers; ++seed) {
    Random random(seed);
    Shape shape = random_shape(random, Filter::none);
    shape.nu = random.between(1, 4);
    shape.has_K = true;
    Model<S> model = convert<S>(random_model(random, shape));
    if (shape.has_limits && random.one_in(3)) model.u_min(0) = S(-Limits::infinity());
    const Description description(model);
    for (int k = 0; k < samples; ++k) {
      Vector<S> x(shape.nx);
      for (int i = 0; i < shape.nx; ++i) x(i) = S(any_output(random));
      Numbers u(static_cast<std::size_t>(shape.nu));
      const Numbers x_of_library = row_major(x);
      const lqg_status_t status = lqg_lqr_control(&description.steady.lqr, x_of_library.data(), u.data());
      Listener listener;
      const Vector<S> expected = lqg::step::control(model, x, listener);
      TEST_ASSERT_EQUAL_HEX(status_of(listener.events), status);
      for (std::size_t i = 0; i < u.size(); ++i)
        TEST_ASSERT_TRUE(u[i] == number(expected(static_cast<Eigen::Index>(i))));
    }
  }
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_steady_filter_agrees_while_sensors_fail);
  RUN_TEST(test_plain_filter_agrees_while_sensors_fail);
  RUN_TEST(test_ud_filter_agrees_while_sensors_fail);
  RUN_TEST(test_filters_agree_on_large_outputs);
  RUN_TEST(test_filters_agree_when_the_state_overflows_and_begins_anew);
  RUN_TEST(test_filters_agree_on_a_covariance_that_is_none);
  RUN_TEST(test_filters_agree_within_bounds_and_on_what_to_believe);
  RUN_TEST(test_control_agrees_on_any_state);
  return UNITY_END();
}
