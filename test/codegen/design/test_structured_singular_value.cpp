// SPDX-License-Identifier: MIT
// The structured singular value against what it is by definition.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>

#include <unity.h>

#include "design/numeric/structured_singular_value.hpp"
#include "problems.hpp"

namespace {

using namespace design_test;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;
using lqg::design::structured_norm;

constexpr int seeds = 40;

MatrixXcd random_matrix(Random& random, Index size) {
  MatrixXcd H(size, size);
  H.real() = random.matrix(size, size);
  H.imag() = random.matrix(size, size);
  return H;
}

// ρ(U H), U = diag(e^(jφ)): the largest of all U is μ(H).
double radius(const MatrixXcd& H, const Eigen::VectorXd& angles) {
  VectorXcd U(angles.size());
  for (Index i = 0; i < U.size(); ++i) U(i) = std::polar(1.0, angles(i));
  return Eigen::ComplexEigenSolver<MatrixXcd>(U.asDiagonal() * H, false).eigenvalues().cwiseAbs().maxCoeff();
}

// The first angle changes nothing but the angle of all eigenvalues.
double largest_radius(const MatrixXcd& H) {
  Eigen::VectorXd best = Eigen::VectorXd::Zero(H.rows());
  double largest = 0;
  for (double step = 0.2; step > 1e-7; step /= 4) {
    const Eigen::VectorXd middle = best;
    const int reach = step == 0.2 ? 16 : 6;
    Eigen::VectorXd angles = middle;
    for (int a = -reach; a <= reach; ++a)
      for (int b = -reach; b <= (H.rows() > 2 ? reach : -reach); ++b) {
        angles(1) = middle(1) + a * step;
        if (H.rows() > 2) angles(2) = middle(2) + b * step;
        const double here = radius(H, angles);
        if (here <= largest) continue;
        largest = here;
        best = angles;
      }
  }
  return largest;
}

// Both searches end: for the best scaling, and for the worst phases of two angles.
void expect_definition(Index channels, double tolerance) {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Random random(seed);
    const MatrixXcd H = random_matrix(random, channels);
    const double largest = largest_radius(H);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance * largest, largest, structured_norm(H));
  }
}

void test_two_channels_reach_the_worst_phases() { expect_definition(2, 1e-6); }
void test_three_channels_reach_the_worst_phases() { expect_definition(3, 1e-3); }

void test_units_of_the_channels_change_nothing() {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Random random(seed);
    const Index channels = 2 + static_cast<Index>(seed % 3);
    const MatrixXcd H = random_matrix(random, channels);
    MatrixXcd other = H;
    for (Index i = 0; i < channels; ++i) {
      const double unit = std::exp2(20 * random.uniform());
      other.row(i) *= unit;
      other.col(i) /= unit;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-5 * structured_norm(H), structured_norm(H), structured_norm(other));
  }
}

void test_channels_that_do_not_meet_have_the_largest_of_their_own() {
  MatrixXcd H = MatrixXcd::Zero(3, 3);
  H.diagonal() << 1.0, std::complex<double>(0, -3), 2.0;
  TEST_ASSERT_DOUBLE_WITHIN(1e-14, 3, structured_norm(H));
  H(0, 1) = 1e3;  // one way only: no loop through it
  TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3, structured_norm(H));
}

void test_never_more_than_the_norm_nor_than_the_balanced_one() {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Random random(seed);
    const MatrixXcd H = random_matrix(random, 4);
    const double norm = structured_norm(H);
    TEST_ASSERT_TRUE(norm <= H.operatorNorm() * (1 + 1e-12) && norm <= lqg::design::balanced_norm(H));
    TEST_ASSERT_TRUE(norm >= radius(H, Eigen::VectorXd::Zero(4)) * (1 - 1e-12));
  }
}

// Up to three channels the scaling reaches μ (Doyle 1982): both searches end there. With more, the search channel by
// channel is the reference, and ρ(H) is never more.
void test_the_search_for_many_channels_ends_where_that_for_few_does() {
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Random random(seed);
    const Index channels = 2 + static_cast<Index>(seed % 7);
    const MatrixXcd H = random_matrix(random, channels);
    const double found = lqg::design::structured_norm_of_many(H), reference = structured_norm(H);
    TEST_ASSERT_TRUE(found <= reference * 1.01 && found >= radius(H, Eigen::VectorXd::Zero(channels)) * (1 - 1e-12));
    if (channels <= 3) TEST_ASSERT_DOUBLE_WITHIN(1e-3 * reference, reference, found);
  }
}

void test_the_search_for_many_channels_takes_no_loop_for_0() {
  TEST_ASSERT_TRUE(lqg::design::structured_norm_of_many(MatrixXcd::Zero(12, 12)) == 0);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_two_channels_reach_the_worst_phases);
  RUN_TEST(test_three_channels_reach_the_worst_phases);
  RUN_TEST(test_units_of_the_channels_change_nothing);
  RUN_TEST(test_channels_that_do_not_meet_have_the_largest_of_their_own);
  RUN_TEST(test_never_more_than_the_norm_nor_than_the_balanced_one);
  RUN_TEST(test_the_search_for_many_channels_ends_where_that_for_few_does);
  RUN_TEST(test_the_search_for_many_channels_takes_no_loop_for_0);
  return UNITY_END();
}
