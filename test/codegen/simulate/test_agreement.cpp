// SPDX-License-Identifier: MIT
// Forms that keep z beside the physical form that they stand for.
#include <unity.h>

#include "../design/problems.hpp"
#include "controller/controller.hpp"
#include "design/linear_form.hpp"
#include "simulate/agreement.hpp"

using namespace lqg::design;
using namespace design_test;

namespace {

lqg::controller::Controller physical(const Problem& problem) {
  Findings findings;
  const auto controller = lqg::controller::controller_of(problem, solved(problem), {}, findings);
  TEST_ASSERT_TRUE_MESSAGE(controller.has_value(), findings.empty() ? "" : findings.front().message.c_str());
  return *controller;
}

void expect_agreement(Problem problem, Form form) {
  problem.estimator->form = form;
  const lqg::controller::Controller controller = physical(problem);
  for (const auto& found : {folded_form(problem, controller.solution), modal_form(problem, controller.solution)}) {
    TEST_ASSERT_TRUE_MESSAGE(found.form.has_value(), found.obstacle.c_str());
    TEST_ASSERT_TRUE(lqg::simulate::agreement(controller, *found.form) > 40);
  }
}

void test_folded_and_modal_form_agree_in_40_digits_in_either_form() {
  for (const Form form : {Form::filter, Form::predictor}) expect_agreement(two_mass(), form);
}

void test_start_that_is_not_0_does_not_matter() {
  Problem problem = two_mass();
  problem.estimator->x0 = Eigen::Vector4d(1, -2, 3, -4);
  expect_agreement(problem, Form::filter);
}

void test_form_with_one_number_off_by_1e_20_agrees_in_about_20_digits() {
  const Problem problem = two_mass();
  const lqg::controller::Controller controller = physical(problem);
  LinearForm form = *folded_form(problem, controller.solution).form;
  form.C(0, 0) *= 1 + Real("1e-20");
  const double digits = lqg::simulate::agreement(controller, form);
  TEST_ASSERT_TRUE(digits > 18 && digits < 22);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_folded_and_modal_form_agree_in_40_digits_in_either_form);
  RUN_TEST(test_start_that_is_not_0_does_not_matter);
  RUN_TEST(test_form_with_one_number_off_by_1e_20_agrees_in_about_20_digits);
  return UNITY_END();
}
