// SPDX-License-Identifier: MIT
// What the certificate says that rounding may do with active rows, against the same in 80 digits.
#include <cmath>

#include <unity.h>

#include "design/limits/active_rows.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int rows = 8;
constexpr int problems = 60, changes = 40;

// A Gram matrix, as the target has it. Dependence: how much of each row the row before it makes up.
MatrixXd gram_matrix(Random& random, bool is_float, double dependence) {
  MatrixXd M = random.matrix(rows, rows + 2);
  for (int i = 1; i < rows; ++i) M.row(i) = dependence * M.row(i - 1) + (1 - dependence) * M.row(i);
  MatrixXd G = M * M.transpose();
  if (is_float) G = G.cast<float>().cast<double>();
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < i; ++j) G(j, i) = G(i, j);
  return G;
}

// The active rows' G, and factors in each of the target's arithmetics that have gone the same way.
struct Way {
  Way(const MatrixXd& of_rows, bool is_float)
      : G(of_rows), active(G, is_float), arithmetic{{is_float, false}, {is_float, true}},
        factors{RoundedFactor(arithmetic[0]), RoundedFactor(arithmetic[1])} {}
  Way(const Way&) = delete;
  Way& operator=(const Way&) = delete;

  void append(int row) {
    std::vector<double> column;
    for (int k = 0; k < active.length(); ++k) column.push_back(G(row, active.row(k)));
    column.push_back(G(row, row));
    for (RoundedFactor& factor : factors) factor.append(column);
    active.append(row, LimitSide::low);
  }
  void drop(int k) {
    for (RoundedFactor& factor : factors) factor.drop(k);
    active.drop(k);
  }
  bool has(int row) const {
    for (int k = 0; k < active.length(); ++k)
      if (active.row(k) == row) return true;
    return false;
  }
  RealMatrix exact() const {
    RealMatrix result(active.length(), active.length());
    for (int i = 0; i < active.length(); ++i)
      for (int j = 0; j < active.length(); ++j) result(i, j) = G(active.row(i), active.row(j));
    return result;
  }

  const MatrixXd G;
  ActiveRows active;
  TargetArithmetic arithmetic[2];
  RoundedFactor factors[2];
};

// A random row comes, or one that is there goes.
void change(Way& way, Random& random) {
  const int row = static_cast<int>((random.uniform() + 1) / 2 * rows);
  const bool grows = way.active.length() == 0 || (random.uniform() < 1.0 / 3 && !way.has(row));
  if (grows)
    way.append(row);
  else
    way.drop(row % way.active.length());
}

// Of src/mpc.c: L y = right, d, Lᵀ.
std::vector<double> multipliers(const RoundedFactor& factor, TargetArithmetic target, std::vector<double> m) {
  const int n = factor.length();
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < k; ++j)
      m[static_cast<std::size_t>(k)] =
          target.multiply_subtract(factor.L(k, j), m[static_cast<std::size_t>(j)], m[static_cast<std::size_t>(k)]);
  for (int j = 0; j < n; ++j)
    m[static_cast<std::size_t>(j)] = target.round(m[static_cast<std::size_t>(j)] / factor.d(j));
  for (int j = n; j-- > 1;)
    for (int i = 0; i < j; ++i)
      m[static_cast<std::size_t>(i)] =
          target.multiply_subtract(factor.L(j, i), m[static_cast<std::size_t>(j)], m[static_cast<std::size_t>(i)]);
  return m;
}

// Counts the numbers that were compared; the largest share of a bound that was needed.
struct Seen {
  long compared = 0;
  double share = 0;
};

void expect_within(const Real& missed, double bound, Seen& seen) {
  ++seen.compared;
  TEST_ASSERT_TRUE(abs(missed) <= bound);
  if (bound > 0) seen.share = std::max(seen.share, to_double(abs(missed)) / bound);
}

template <class Check>
void on_random_ways(Check check) {
  const Digits scope(80);
  Random random(11);
  for (int n = 0; n < problems; ++n) {
    const bool is_float = n % 2;
    Way way(gram_matrix(random, is_float, n % 3 == 0 ? 0 : n % 3 == 1 ? 0.9 : 0.99), is_float);
    for (int k = 0; k < changes; ++k) {
      change(way, random);
      if (way.active.length() && way.active.is_regular(is_float ? 0x1p-20 : 0x1p-46)) check(way, random);
    }
  }
}

void test_the_inverse_is_as_near_as_its_errors_say() {
  Seen seen;
  on_random_ways([&](const Way& way, Random&) {
    const RealMatrix exact = *solve(way.exact(), identity(way.active.length()));
    for (int i = 0; i < way.active.length(); ++i)
      for (int j = 0; j < way.active.length(); ++j)
        expect_within(exact(i, j) - Real(way.active.inverse()(i, j)), way.active.inverse_error()(i, j), seen);
  });
  TEST_ASSERT_GREATER_THAN(10000, seen.compared);
  TEST_ASSERT_TRUE(seen.share > 1e-4);  // a bound that is never near says nothing
}

// G m − right of what the target finds, plain and fused.
void test_multipliers_of_the_target_miss_no_more_than_the_residual() {
  Seen seen;
  on_random_ways([&](const Way& way, Random& random) {
    const int n = way.active.length();
    const RealMatrix exact = way.exact();
    for (int fused = 0; fused < 2; ++fused) {
      std::vector<double> right;
      for (int k = 0; k < n; ++k) right.push_back(way.arithmetic[fused].round(random.uniform()));
      const std::vector<double> m = multipliers(way.factors[fused], way.arithmetic[fused], right);
      for (int i = 0; i < n; ++i) {
        Real missed = -Real(right[static_cast<std::size_t>(i)]);
        double bound = 0;
        for (int j = 0; j < n; ++j) {
          missed += exact(i, j) * m[static_cast<std::size_t>(j)];
          bound += way.active.residual()(i, j) * std::abs(m[static_cast<std::size_t>(j)]);
        }
        expect_within(missed, bound, seen);
      }
    }
  });
  TEST_ASSERT_GREATER_THAN(5000, seen.compared);
  TEST_ASSERT_TRUE(seen.share > 1e-3);
}

}  // namespace

void setUp() {}
void tearDown() {}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_the_inverse_is_as_near_as_its_errors_say);
  RUN_TEST(test_multipliers_of_the_target_miss_no_more_than_the_residual);
  return UNITY_END();
}
