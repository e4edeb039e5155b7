// SPDX-License-Identifier: MIT
// Reference vectors: the same on every run, near enough to say something, of a plant that does what its design says.
#include <cmath>

#include <unity.h>

#include "design_text.hpp"
#include "controller/model_of.hpp"
#include "controller/rounding.hpp"
#include "emit/vectors/vectors.hpp"
#include "simulate/plant.hpp"

using namespace lqg_test;
using lqg::emit::Controller;
using lqg::emit::Sample;
using lqg::emit::Vectors;

namespace {

bool equal(const Vectors& a, const Vectors& b) {
  bool same = a.hash == b.hash && a.samples.size() == b.samples.size() && a.tolerance.x == b.tolerance.x &&
              a.tolerance.u == b.tolerance.u && a.tolerance.P == b.tolerance.P;
  for (std::size_t k = 0; same && k < a.samples.size(); ++k)
    same = a.samples[k].y == b.samples[k].y && a.samples[k].u == b.samples[k].u && a.samples[k].x == b.samples[k].x &&
           a.samples[k].P == b.samples[k].P;
  return same;
}

DesignText design_of(const char* gain, const char* covariance, const char* real) {
  DesignText design = double_integrators(2);
  design.gain = gain, design.covariance = covariance, design.real = real;
  return design;
}

void test_vectors_are_the_same_each_time() {
  for (const char* real : {"float", "double"}) {
    const Controller controller = controller_of(design_of("online", "ud", real));
    TEST_ASSERT_TRUE(equal(lqg::emit::make_vectors(controller), lqg::emit::make_vectors(controller)));
  }
}

// A tolerance of entry i, and the largest value that this entry has.
void expect_small(const std::vector<double>& tolerance, const std::vector<Sample>& samples,
                  std::vector<double> Sample::* values, double largest_share) {
  for (std::size_t i = 0; i < tolerance.size(); ++i) {
    double largest = 0;
    for (const Sample& sample : samples) largest = std::max(largest, std::abs((sample.*values)[i]));
    TEST_ASSERT_TRUE(largest == 0 || tolerance[i] > 0);
    TEST_ASSERT_TRUE(tolerance[i] <= largest_share * largest);
  }
}

// A few hundred roundings, four times over; nothing here is ill conditioned.
void test_tolerances_are_positive_and_small_beside_the_signal() {
  for (const char* gain : {"steady", "online"})
    for (const char* covariance : {"plain", "ud"})
      for (const char* real : {"float", "double"}) {
        const Controller controller = controller_of(design_of(gain, covariance, real));
        const Vectors vectors = lqg::emit::make_vectors(controller);
        const double share = 400 * (controller.target.is_double ? 0x1p-52 : 0x1p-23);
        expect_small(vectors.tolerance.x, vectors.samples, &Sample::x, share);
        expect_small(vectors.tolerance.u, vectors.samples, &Sample::u, share);
        expect_small(vectors.tolerance.P, vectors.samples, &Sample::P, share);
        TEST_ASSERT_EQUAL_size_t(controller.size.nx, vectors.tolerance.x.size());
        TEST_ASSERT_EQUAL_size_t(controller.size.nu, vectors.tolerance.u.size());
      }
}

void test_inputs_and_outputs_are_numbers_of_the_target() {
  const Vectors vectors = lqg::emit::make_vectors(controller_of(design_of("steady", "ud", "float")));
  TEST_ASSERT_GREATER_THAN_size_t(99, vectors.samples.size());
  for (const Sample& sample : vectors.samples) {
    for (const double y : sample.y) TEST_ASSERT_TRUE(y == static_cast<double>(static_cast<float>(y)));
    for (const double u : sample.u) TEST_ASSERT_TRUE(u == static_cast<double>(static_cast<float>(u)));
  }
}

// Each rounds differently somewhere.
void test_the_hash_tells_reals_and_arithmetics_apart() {
  std::vector<std::uint32_t> hashes;
  for (const char* real : {"float", "double"})
    for (const char* arithmetic : {"plain", "fused"}) {
      DesignText design = design_of("online", "ud", real);
      design.arithmetic = arithmetic;
      hashes.push_back(lqg::emit::make_vectors(controller_of(design)).hash);
    }
  for (std::size_t i = 0; i < hashes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) TEST_ASSERT_TRUE(hashes[i] != hashes[j]);
}

// The online filter ends with the covariance of the design.
void test_P_of_the_vectors_ends_at_the_posterior_of_the_design() {
  for (const char* covariance : {"plain", "ud"}) {
    const Controller controller = controller_of(design_of("online", covariance, "double"));
    const Vectors vectors = lqg::emit::make_vectors(controller);
    const lqg::design::RealMatrix& P = controller.solution.estimator->P_posterior;
    for (int i = 0; i < controller.size.nx; ++i)
      for (int j = 0; j <= i; ++j) {
        const double expected = lqg::design::to_double(P(i, j));
        const double scale = std::sqrt(lqg::design::to_double(P(i, i) * P(j, j)));
        const double found = vectors.samples.back().P[static_cast<std::size_t>(lqg::step::triangle(i, j))];
        TEST_ASSERT_TRUE(std::abs(found - expected) <= 1e-9 * scale);  // the transient of 200 samples has died out
      }
  }
}

// 5-σ bounds: with a fixed seed the test cannot fail by chance later.
constexpr double sigmas = 5;

// With x0 = 0 and u = 0 the first output is v, and the state after it G w.
void test_the_simulated_plant_has_the_noise_of_the_design() {
  constexpr int draws = 20000;
  DesignText design = double_integrators(2);
  design.V << 0.01, 0.004, 0.004, 0.02;
  design.Swv = (Eigen::MatrixXd(2, 2) << 0.01, 0, -0.005, 0.02).finished();
  const Controller controller = controller_of(design);
  const Eigen::MatrixXd G = double_integrators(2).G;
  Eigen::MatrixXd wanted(6, 6), found = Eigen::MatrixXd::Zero(6, 6);
  wanted << G * design.W * G.transpose(), G * design.Swv, design.Swv.transpose() * G.transpose(), design.V;
  const Eigen::VectorXd u = Eigen::VectorXd::Zero(2);
  for (std::uint64_t seed = 0; seed < draws; ++seed) {
    lqg::simulate::Plant plant(controller, controller.x0, lqg::simulate::PlantNoise::assumed, seed * 1000);
    const Eigen::VectorXd v = plant.measure(u);
    plant.advance(u);
    const Eigen::VectorXd& Gw = plant.state();
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) found(i, j) += (i < 4 ? Gw(i) : v(i - 4)) * (j < 4 ? Gw(j) : v(j - 4)) / draws;
  }
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double accepted = sigmas * std::sqrt((wanted(i, i) * wanted(j, j) + wanted(i, j) * wanted(i, j)) / draws);
      TEST_ASSERT_TRUE(std::abs(found(i, j) - wanted(i, j)) <= accepted);
    }
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_vectors_are_the_same_each_time);
  RUN_TEST(test_tolerances_are_positive_and_small_beside_the_signal);
  RUN_TEST(test_inputs_and_outputs_are_numbers_of_the_target);
  RUN_TEST(test_the_hash_tells_reals_and_arithmetics_apart);
  RUN_TEST(test_P_of_the_vectors_ends_at_the_posterior_of_the_design);
  RUN_TEST(test_the_simulated_plant_has_the_noise_of_the_design);
  return UNITY_END();
}
