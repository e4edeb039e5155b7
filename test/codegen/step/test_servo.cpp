// SPDX-License-Identifier: MIT
// The law with a memory, library and templates: they agree in every bit, whatever r, y and the applied u are.
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

constexpr int laws = 300, samples = 60, ny = 3;

Matrix<S> random_matrix(Random& random, int rows, int columns) {
  Matrix<S> out(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) out(i, j) = rounded<S>(random.uniform());
  return out;
}

Model<S> random_law(Random& random) {
  Model<S> model;
  model.nx = random.between(1, 6), model.nu = random.between(1, 3), model.ny = ny;
  model.gives_change = random.one_in(2);
  model.nr = random.between(0, ny);
  const int nxi = random.between(0, model.nr);
  for (int i = 0; i < nxi; ++i) {
    model.integral.push_back(random.between(0, ny - 1));
    model.wanted.push_back(i);
  }
  model.K = random_matrix(random, model.nu, model.nx + nxi + (model.gives_change ? model.nu : 0));
  if (random.one_in(2)) model.Nbar = random_matrix(random, model.nu, model.nr);
  model.H = random_matrix(random, nxi, model.nu);
  model.H_input = random_matrix(random, nxi, model.nu);
  model.T = rounded<S>(0.1);
  model.D.resize(ny, 0);
  const Vector<S> positive = Vector<S>::Constant(model.nu, rounded<S>(0.3));
  if (random.one_in(2)) model.u_step = positive;
  if (random.one_in(2)) {
    model.u_max = positive;
    model.u_min = Vector<S>::Constant(model.nu, rounded<S>(-0.2));
  }
  return model;
}

// Bounds that are reached now and then.
void bind(Random& random, Model<S>& model) {
  for (std::size_t i = 0; i < model.integral.size(); ++i) model.xi_bound.push_back(random.between(-1, 2));
  model.error_limit = Vector<S>::Constant(static_cast<Eigen::Index>(model.integral.size()), S(2));
}

// What a caller may hand over: as a rule something honest, now and then anything.
Vector<S> any_vector(Random& random, int size, int one_hostile_in) {
  const lqg_real hostile[] = {Limits::quiet_NaN(), Limits::infinity(), -Limits::max(), random.pattern<lqg_real>()};
  Vector<S> out(size);
  for (int i = 0; i < size; ++i)
    out(i) = random.one_in(one_hostile_in) ? S(hostile[random.below(4)]) : rounded<S>(random.normal());
  return out;
}

lqg_status_t status_of(unsigned events) {
  const auto bit = [&](Event event, lqg_status_t status) {
    return events >> static_cast<unsigned>(event) & 1 ? status : LQG_OK;
  };
  return bit(Event::input_limited, LQG_INPUT_LIMITED) | bit(Event::state_reset, LQG_STATE_RESET) |
         bit(Event::reference_not_finite, LQG_REFERENCE_NOT_FINITE);
}

class Comparison {
 public:
  explicit Comparison(const Model<S>& model)
      : model_(model), state_(lqg::step::initial_state(model)), K_(row_major(model.K)), Nbar_(row_major(model.Nbar)),
        H_(row_major(model.H)), H_input_(row_major(model.H_input)), u_min_(row_major(model.u_min)),
        u_max_(row_major(model.u_max)), u_step_(row_major(model.u_step)), error_limit_(row_major(model.error_limit)),
        output_(model.integral.begin(), model.integral.end()), reference_(model.wanted.begin(), model.wanted.end()),
        wanted_(static_cast<std::size_t>(model.nr)), xi_(output_.size()), error_(output_.size()),
        demand_(static_cast<std::size_t>(state_.demand.size())), u_applied_(static_cast<std::size_t>(state_.u.size())) {
    for (const int bound : model.xi_bound) xi_scale_.push_back(std::ldexp(static_cast<lqg_real>(1), -bound));
    const auto size = [](auto count) { return static_cast<unsigned>(count); };
    servo_ = {
        size(model.nx),     size(model.nu),       size(model.nr),  size(output_.size()), model.gives_change ? 1u : 0u,
        number(model.T),    pointer(K_),          pointer(Nbar_),  pointer(H_),          pointer(H_input_),
        output_.data(),     reference_.data(),    pointer(u_min_), pointer(u_max_),      pointer(u_step_),
        pointer(xi_scale_), pointer(error_limit_)};
    lqg_servo_init(&servo_, &memory_);
  }

  lqg_status_t observe_and_control(const Vector<S>& x, const Vector<S>& r, const Vector<S>& y) {
    Listener listener;
    state_.x = x, state_.r = r;
    lqg::step::observe(model_, state_, y, std::vector<bool>(static_cast<std::size_t>(y.size()), true), listener);
    const Vector<S> u = lqg::step::control(model_, state_, listener);
    const Numbers x_of_library = row_major(x), y_of_library = row_major(y);
    wanted_ = row_major(r);
    memory_.r = pointer(wanted_);
    Numbers found(static_cast<std::size_t>(model_.nu));
    lqg_servo_observe(&servo_, &memory_, y_of_library.data());
    const lqg_status_t status = lqg_servo_control(&servo_, &memory_, x_of_library.data(), found.data());
    expect(status, listener.events);
    TEST_ASSERT_TRUE(found == row_major(u));
    return status;
  }
  // What was applied, by the loop or by hand.
  template <class Templates, class Library>
  lqg_status_t apply(const Vector<S>& u, Templates templates, Library library) {
    Listener listener;
    const bool within = templates(u, listener);
    const Numbers applied = row_major(u);
    const lqg_status_t status = library(applied);
    // A u that nothing remembers is the filter's to refuse.
    if (!within && !state_.u.size() && model_.xi_bound.empty()) return forget();
    listener.raise(Event::state_reset, !within);
    if (!within) lqg::step::begin_anew(model_, state_);
    expect(status, listener.events);
    return status;
  }
  lqg_status_t advance(const Vector<S>& u) {
    return apply(
        u,
        [&](const Vector<S>& applied, Listener& listener) {
          lqg::step::BoundsCheck<S> bounds;
          lqg::step::remember(model_, state_, applied, bounds, listener);
          return bounds.is_within();
        },
        [&](const Numbers& applied) { return lqg_servo_advance(&servo_, &memory_, applied.data()); });
  }
  lqg_status_t set_input(const Vector<S>& u) {
    return apply(
        u,
        [&](const Vector<S>& applied, Listener& listener) {
          return lqg::step::set_input(model_, state_, applied, listener);
        },
        [&](const Numbers& applied) {
          const Numbers x = row_major(state_.x);
          wanted_ = row_major(state_.r);
          memory_.r = pointer(wanted_);
          return lqg_servo_set_input(&servo_, &memory_, x.data(), applied.data());
        });
  }

 private:
  lqg_status_t forget() {
    lqg::step::begin_anew(model_, state_);
    lqg_servo_init(&servo_, &memory_);
    return LQG_OK;
  }
  void expect(lqg_status_t status, unsigned events) {
    TEST_ASSERT_EQUAL_HEX(status_of(events), status);
    TEST_ASSERT_TRUE(xi_ == row_major(state_.xi));
    TEST_ASSERT_TRUE(error_ == row_major(state_.error));
    TEST_ASSERT_TRUE(demand_ == row_major(state_.demand));
    TEST_ASSERT_TRUE(u_applied_ == row_major(state_.u));
  }

  const Model<S>& model_;
  State<S> state_;
  Numbers K_, Nbar_, H_, H_input_, u_min_, u_max_, u_step_, error_limit_, xi_scale_;
  std::vector<unsigned> output_, reference_;
  Numbers wanted_, xi_, error_, demand_, u_applied_;
  lqg_servo_t servo_{};
  lqg_servo_state_t memory_ = {pointer(wanted_), pointer(xi_), pointer(error_), pointer(demand_), pointer(u_applied_)};
};

// One hostile number in `one_hostile_in`.
lqg_status_t compare(int one_hostile_in, bool is_bounded = false) {
  lqg_status_t seen = LQG_OK;
  for (std::uint64_t seed = 0; seed < laws; ++seed) {
    Random random(seed);
    Model<S> model = random_law(random);
    if (is_bounded) bind(random, model);
    Comparison comparison(model);
    for (int k = 0; k < samples; ++k) {
      const auto any = [&](int size) { return any_vector(random, size, one_hostile_in); };
      const Vector<S> x = any_vector(random, model.nx, std::numeric_limits<int>::max());
      seen |= comparison.observe_and_control(x, any(model.nr), any(ny));
      seen |= random.one_in(6) ? comparison.set_input(any(model.nu)) : comparison.advance(any(model.nu));
    }
  }
  return seen;
}

void test_library_and_templates_agree_in_every_bit() {
  TEST_ASSERT_EQUAL_HEX(LQG_INPUT_LIMITED, compare(std::numeric_limits<int>::max()));
}

void test_library_and_templates_agree_on_anything() {
  TEST_ASSERT_EQUAL_HEX(LQG_INPUT_LIMITED | LQG_STATE_RESET | LQG_REFERENCE_NOT_FINITE, compare(20));
}

void test_library_and_templates_agree_within_bounds() {
  TEST_ASSERT_EQUAL_HEX(LQG_INPUT_LIMITED | LQG_STATE_RESET, compare(std::numeric_limits<int>::max(), true));
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_library_and_templates_agree_in_every_bit);
  RUN_TEST(test_library_and_templates_agree_on_anything);
  RUN_TEST(test_library_and_templates_agree_within_bounds);
  return UNITY_END();
}
