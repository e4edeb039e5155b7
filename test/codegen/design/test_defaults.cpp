// SPDX-License-Identifier: MIT
// What a problem that is made in C++ may leave out.
#include <unity.h>

#include "design/defaults.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;

namespace {

void test_defaults_are_those_of_the_design_file() {
  const Problem full = double_integrator(0.1);
  Problem bare;
  bare.plant.sample_time = 0.1;
  bare.plant.A = full.plant.A;
  bare.plant.B = full.plant.B;
  bare.plant.C = full.plant.C;
  bare.regulator.emplace();
  bare.regulator->Q = full.regulator->Q;
  bare.regulator->R = full.regulator->R;
  bare.estimator.emplace();
  bare.estimator->W = full.estimator->W;
  bare.estimator->V = full.estimator->V;
  const Solution expected = solved(full), found = solved(with_defaults(bare));
  expect_rounded(expected.regulator->K, found.regulator->K, "K");
  expect_rounded(expected.estimator->L, found.estimator->L, "L");
}

void test_defaults_leave_alone_what_is_given() {
  Problem problem = two_mass();
  problem.estimator->P0 *= 5;
  const Problem found = with_defaults(problem);
  TEST_ASSERT_TRUE(found.estimator->P0 == problem.estimator->P0 && found.plant.G == problem.plant.G);
  TEST_ASSERT_TRUE(found.estimator->noise == Noise::discrete && found.regulator->cost == Cost::sampled);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_defaults_are_those_of_the_design_file);
  RUN_TEST(test_defaults_leave_alone_what_is_given);
  return UNITY_END();
}
