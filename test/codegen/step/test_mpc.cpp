// SPDX-License-Identifier: MIT
// The law with limits in the library and on the host: the same bits, whatever they are given.
//
// Built once for each variant of the library.
#include <cstring>
#include <limits>

#include <unity.h>

#include "library_numbers.hpp"
#include "step/mpc.hpp"

extern "C" {
#include "limited.h"
}

using namespace lqg_test;

namespace {

constexpr unsigned problems = 20000;

bool have_the_same_bits(lqg_real a, lqg_real b) { return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b); }

lqg::step::LimitedLaw<S> host_law(const lqg_mpc_t& mpc) {
  const auto matrix = [](const lqg_real* values, unsigned rows, unsigned columns) {
    Matrix<S> result(rows, columns);
    for (unsigned i = 0; i < rows * columns; ++i) result(i / columns, i % columns) = S(values[i]);
    return result;
  };
  const auto vector = [](const lqg_real* values, unsigned length) {
    Vector<S> result(values ? length : 0);
    for (unsigned i = 0; values && i < length; ++i) result(i) = S(values[i]);
    return result;
  };
  lqg::step::LimitedLaw<S> law;
  law.nu = static_cast<int>(mpc.nu);
  law.iterations = mpc.iterations;
  law.F = matrix(mpc.F, mpc.rows - mpc.nu, mpc.nx);
  law.G = matrix(mpc.G, mpc.rows, mpc.rows);
  law.scale = vector(mpc.scale, mpc.rows);
  law.low = vector(mpc.low, mpc.rows);
  law.high = vector(mpc.high, mpc.rows);
  law.tolerance = vector(mpc.tolerance, mpc.rows);
  law.u_step = vector(mpc.u_step, mpc.nu);
  return law;
}

void compare(const lqg_mpc_t& mpc, const lqg_real applied[], const lqg_real f[]) {
  scratch_t scratch;
  lqg_real u[MAX_U];
  Vector<S> last(mpc.nu), x(mpc.nx), law(mpc.nu);
  for (unsigned i = 0; i < mpc.nx; ++i) x(i) = S(f[i]);
  for (unsigned i = 0; i < mpc.nu; ++i) {
    last(i) = S(applied[i]);
    law(i) = S(u[i] = f[i]);
  }
  begin_scratch(&scratch, &mpc, applied);
  const lqg_status_t status = lqg_mpc_limit(&mpc, &scratch.state, f, u);
  const auto found = limited_input(host_law(mpc), last, x, law);
  TEST_ASSERT_EQUAL(!(status & LQG_NOT_OPTIMAL), found.is_optimal);
  TEST_ASSERT_EQUAL(status & LQG_INPUT_LIMITED ? 1 : 0, found.is_limited ? 1 : 0);
  for (unsigned i = 0; i < mpc.nu; ++i) TEST_ASSERT_TRUE(have_the_same_bits(number(found.u(i)), u[i]));
  for (std::size_t k = 0; found.is_optimal && k < found.active.size(); ++k) {
    TEST_ASSERT_EQUAL(scratch.state.active[k], found.active[k]);
    TEST_ASSERT_TRUE(have_the_same_bits(number(found.multipliers[k]), scratch.state.m[k]));
  }
}

void test_host_and_library_agree_in_every_bit() {
  static const lqg_real applied[MAX_U] = {0, 1};
  for (int kind = 0; kind < KINDS; ++kind)
    for (unsigned seed = 0; seed < problems; ++seed) {
      const problem_t problem = random_problem(static_cast<kind_t>(kind), seed);
      description_t d;
      describe(&problem, &d);
      compare(d.mpc, applied, d.f);
    }
}

void test_they_agree_where_changes_are_too_few_and_u_may_only_move_so_far() {
  static const lqg_real u_step[MAX_U] = {0.5f, 0.125f};
  for (unsigned seed = 0; seed < problems; ++seed) {
    const problem_t problem = random_problem(RATES, seed);
    const lqg_real applied[MAX_U] = {static_cast<lqg_real>(seed % 7) / 2 - 1, 3};
    description_t d;
    describe(&problem, &d);
    d.mpc.iterations = seed % 12;
    d.mpc.u_step = u_step;
    compare(d.mpc, applied, d.f);
  }
}

void test_they_agree_on_what_nobody_should_say() {
  constexpr auto infinity = std::numeric_limits<lqg_real>::infinity(), most = std::numeric_limits<lqg_real>::max();
  const lqg_real hostile[] = {infinity - infinity, infinity, -infinity, most, -most, most / 1024, 1e30f, -1e19f};
  static const lqg_real u_step[MAX_U] = {0.5f, 0.125f};
  for (int kind = 0; kind < KINDS; ++kind)
    for (unsigned seed = 0; seed < 512; ++seed) {
      const problem_t problem = random_problem(static_cast<kind_t>(kind), seed);
      const lqg_real applied[MAX_U] = {hostile[seed % 8], 0};
      description_t d;
      describe(&problem, &d);
      d.mpc.iterations = 20;
      d.f[seed % problem.rows] = hostile[seed / 8 % 8];
      d.f[seed / 3 % problem.rows] = hostile[seed / 64];
      d.mpc.u_step = seed % 2 ? u_step : nullptr;
      compare(d.mpc, applied, d.f);
    }
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_host_and_library_agree_in_every_bit);
  RUN_TEST(test_they_agree_where_changes_are_too_few_and_u_may_only_move_so_far);
  RUN_TEST(test_they_agree_on_what_nobody_should_say);
  return UNITY_END();
}
