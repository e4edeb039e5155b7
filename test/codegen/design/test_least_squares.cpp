// SPDX-License-Identifier: MIT
// Weighted least squares: normal equations, a published example, and unknowns that the outputs do not determine.
#include <cmath>
#include <string>

#include <unity.h>

#include "design/least_squares.hpp"
#include "design/rounding.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

void test_random_problems_satisfy_the_normal_equations() {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    const Index nx = 1 + static_cast<Index>(seed % 5), ny = nx + static_cast<Index>(seed % 7);
    const MatrixXd C = random.matrix(ny, nx), V = random.semidefinite(ny, ny + 2) + MatrixXd::Identity(ny, ny);
    const MatrixXd y = random.matrix(ny, 1);
    Findings findings;
    const std::optional<LeastSquares> found = least_squares(C, V, y, findings);
    TEST_ASSERT_TRUE(found.has_value());
    const Digits scope(found->digits);
    const RealMatrix left = *solve(real(V), real(y) - multiply(real(C), RealMatrix(found->x)));
    expect_small(largest_entry(transpose_multiply(real(C), left)), 1e-40, "CᵀV⁻¹(y − Cx̂)");
    const RealMatrix information = transpose_multiply(real(C), *solve(real(V), real(C)));
    expect_small(largest_entry(multiply(information, found->P) - identity(nx)), 1e-35, "CᵀV⁻¹C P − I");
  }
}

// NIST's Statistical Reference Dataset Longley: seven certified coefficients of a nearly dependent C.
// https://www.itl.nist.gov/div898/strd/lls/data/Longley.shtml
void test_nist_longley_has_its_certified_coefficients() {
  MatrixXd data(16, 7);
  data << 60323, 83.0, 234289, 2356, 1590, 107608, 1947, 61122, 88.5, 259426, 2325, 1456, 108632, 1948, 60171, 88.2,
      258054, 3682, 1616, 109773, 1949, 61187, 89.5, 284599, 3351, 1650, 110929, 1950, 63221, 96.2, 328975, 2099, 3099,
      112075, 1951, 63639, 98.1, 346999, 1932, 3594, 113270, 1952, 64989, 99.0, 365385, 1870, 3547, 115094, 1953, 63761,
      100.0, 363112, 3578, 3350, 116219, 1954, 66019, 101.2, 397469, 2904, 3048, 117388, 1955, 67857, 104.6, 419180,
      2822, 2857, 118734, 1956, 68169, 108.4, 442769, 2936, 2798, 120445, 1957, 66513, 110.8, 444546, 4681, 2637,
      121950, 1958, 68655, 112.6, 482704, 3813, 2552, 123366, 1959, 69564, 114.2, 502601, 3931, 2514, 125368, 1960,
      69331, 115.7, 518173, 4806, 2572, 127852, 1961, 70551, 116.9, 554894, 4007, 2827, 130081, 1962;
  MatrixXd C = data;
  C.col(0).setOnes();
  Findings findings;
  const std::optional<LeastSquares> found = least_squares(C, MatrixXd::Identity(16, 16), data.col(0), findings);
  TEST_ASSERT_TRUE(found.has_value());
  const double certified[] = {-3482258.63459582, 15.0618722713733,       -0.358191792925910E-01, -2.02022980381683,
                              -1.03322686717359, -0.511041056535807E-01, 1829.15146461355};
  for (Index i = 0; i < 7; ++i)
    TEST_ASSERT_DOUBLE_WITHIN(1e-14 * std::abs(certified[i]), certified[i], to_double(found->x(i)));
}

void expect_error(const MatrixXd& C, const MatrixXd& V, const VectorXd& y, const char* key, const char* part) {
  Findings findings;
  TEST_ASSERT_FALSE(least_squares(C, V, y, findings).has_value());
  TEST_ASSERT_EQUAL_STRING(key, findings[0].key.c_str());
  TEST_ASSERT_TRUE_MESSAGE(findings[0].message.find(part) != std::string::npos, findings[0].message.c_str());
}

void test_unknowns_that_always_come_together_are_named() {
  MatrixXd C(3, 3);
  C << 1, 2, 4, 0, 1, 2, 3, 5, 10;
  expect_error(C, MatrixXd::Identity(3, 3), VectorXd::Ones(3), "C",
               "has the rank 2, expected 3: the outputs do not determine x1, x2");
}

void test_fewer_outputs_than_unknowns_are_refused() {
  expect_error(MatrixXd::Identity(1, 2), MatrixXd::Identity(1, 1), VectorXd::Ones(1), "C", "do not determine x1");
}

void test_output_without_noise_is_refused() {
  expect_error(MatrixXd::Identity(2, 2), Eigen::Vector2d(1, 0).asDiagonal(), VectorXd::Ones(2), "V", "every output");
}

void test_shapes_that_do_not_fit_are_refused() {
  expect_error(MatrixXd::Identity(2, 2), MatrixXd::Identity(3, 3), VectorXd::Ones(2), "V", "expected 2 rows");
  expect_error(MatrixXd::Identity(2, 2), MatrixXd::Identity(2, 2), VectorXd::Ones(3), "y", "expected 2 entries");
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_random_problems_satisfy_the_normal_equations);
  RUN_TEST(test_nist_longley_has_its_certified_coefficients);
  RUN_TEST(test_unknowns_that_always_come_together_are_named);
  RUN_TEST(test_fewer_outputs_than_unknowns_are_refused);
  RUN_TEST(test_output_without_noise_is_refused);
  RUN_TEST(test_shapes_that_do_not_fit_are_refused);
  return UNITY_END();
}
