// SPDX-License-Identifier: MIT
// Controllers that keep z: what is emitted passes its own test, does what the physical form does, in faults too, and
// the numbers of NAME.json say the same.
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include <unity.h>

#include "design/solve.hpp"
#include "design_text.hpp"
#include "emit/c/header.hpp"
#include "emit/plan/plan.hpp"
#include "emit/plan/realisation.hpp"
#include "emit/report/json.hpp"
#include "emitted.hpp"
#include "input/design_file.hpp"

using namespace lqg_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using lqg::emit::Controller;
using nlohmann::json;

namespace {

Controller in_form(const DesignText& design, const std::string& form) {
  return controller_of(toml(design) + "realisation = \"" + form + "\"\n");
}

// Two springs that pull at each other, both seen, one driven: every number of its forms is another one.
DesignText two_springs(const char* form) {
  DesignText design;
  design.A =
      (MatrixXd(4, 4) << 0.9, 0.1, 0.05, 0, -0.3, 0.8, 0, 0.1, 0.05, 0, 0.85, 0.12, 0, 0.1, -0.4, 0.7).finished();
  design.B = (MatrixXd(4, 1) << 0.01, 0.2, 0, 0).finished();
  design.C = (MatrixXd(2, 4) << 1, 0, 0, 0, 0, 0, 1, 0).finished();
  design.D = (MatrixXd(2, 1) << 0, 0.1).finished();
  design.Q = MatrixXd::Identity(4, 4);
  design.R = MatrixXd::Constant(1, 1, 0.1);
  design.W = 0.01 * MatrixXd::Identity(4, 4);
  design.V = 0.02 * MatrixXd::Identity(2, 2);
  design.Swv = (MatrixXd(4, 2) << 0.002, 0, 0, 0, 0, 0.003, 0, 0).finished();
  design.form = form;
  design.gain = "steady";
  return design;
}

void test_emitted_forms_pass_their_own_test() {
  int made = 0;
  for (const char* form : {"filter", "predictor"})
    for (const char* real : {"float", "double"})
      for (const char* arithmetic : {"plain", "fused"})
        for (const char* realisation : {"folded", "modal"}) {
          DesignText design = two_springs(form);
          design.real = real, design.arithmetic = arithmetic;
          design.name = "form_" + std::to_string(made++);
          expect_emitted_to_pass(in_form(design, realisation), {Language::c, Language::cxx});
        }
}

// L has a column of zeros: no u and no z is made of the second output. The emitted test asks that NaN in it is
// reported.
void test_an_output_that_nothing_is_made_of_is_looked_at() {
  for (const char* form : {"filter", "predictor"})
    for (const char* realisation : {"folded", "modal"}) {
      DesignText design = two_springs(form);
      design.name = std::string("unheard_") + form;
      design.Swv.resize(0, 0);
      std::string text = toml(design) + "realisation = \"" + realisation + "\"\n";
      text.insert(text.find("[kalman]\n") + 9, "structure = [[1, 0], [1, 0], [1, 0], [1, 0]]\n");
      const Controller controller = controller_of(text);
      TEST_ASSERT_TRUE(controller.linear->B.col(1).isZero(0) && controller.linear->D.col(1).isZero(0));
      expect_emitted_to_pass(controller, {Language::c});
    }
}

// Everything by chance but what has no such form. Of each form at least some must come about.
void test_random_designs_pass_in_every_form_that_they_have() {
  int made[2] = {0, 0};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random(seed);
    DesignText design = random_design(random, 1 + static_cast<int>(seed % 8));
    design.gain = "steady", design.covariance = "", design.style = "auto";
    design.u_min.resize(0), design.u_max.resize(0);
    const Controller controller = in_form(design, "cheapest");
    if (!controller.forms) continue;
    const bool has[2] = {controller.forms->folded.has_value(), controller.forms->modal.has_value()};
    for (int form = 0; form < 2; ++form) {
      if (!has[form]) continue;
      design.name = "random_" + std::to_string(seed);
      expect_emitted_to_pass(in_form(design, form == 0 ? "folded" : "modal"), {Language::c});
      ++made[form];
    }
  }
  TEST_ASSERT_GREATER_THAN_INT(3, made[0]);
  TEST_ASSERT_GREATER_THAN_INT(3, made[1]);
}

MatrixXd matrix(const json& rows) {
  MatrixXd out(rows.size(), rows.empty() ? 0 : rows[0].size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows[i].size(); ++j)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j].get<double>();
  return out;
}

// u of the numbers of the design, and of those of its compensator, for the same random outputs.
void expect_compensator_to_be_the_design(const json& made) {
  const json &plant = made["plant"], &compensator = made["compensator"];
  const MatrixXd A = matrix(plant["A"]), B = matrix(plant["B"]), C = matrix(plant["C"]), D = matrix(plant["D"]);
  const MatrixXd K = matrix(made["lqr"]["K"]), L = matrix(made["kalman"]["L"]);
  const MatrixXd M = matrix(made["kalman"]["L_predictor"]) - A * L;
  const MatrixXd Az = matrix(compensator["A"]), Bz = matrix(compensator["B"]), Cz = matrix(compensator["C"]),
                 Dz = matrix(compensator["D"]);
  const bool predicts = made["kalman"]["form"] == "predictor";
  Random random(7);
  VectorXd x = VectorXd::Zero(A.rows()), u = VectorXd::Zero(B.cols()), z = matrix(compensator["z0"]);
  for (int k = 0; k < 200; ++k) {
    VectorXd y(C.rows());
    for (Eigen::Index i = 0; i < y.size(); ++i) y(i) = random.normal();
    if (predicts) u = -K * x;
    const VectorXd e = y - C * x - D * u, updated = x + L * e;
    if (!predicts) u = -K * updated;
    x = A * updated + B * u + M * e;
    const VectorXd found = Cz * z + Dz * y;
    z = Az * z + Bz * y;
    for (Eigen::Index i = 0; i < u.size(); ++i) TEST_ASSERT_DOUBLE_WITHIN(1e-12, u(i), found(i));
  }
}

void test_json_has_the_compensator_and_what_each_form_costs() {
  for (const char* form : {"filter", "predictor"})
    for (const char* realisation : {"folded", "modal"}) {
      const Controller controller = in_form(two_springs(form), realisation);
      const json made = json::parse(lqg::emit::json(controller));
      expect_compensator_to_be_the_design(made);
      const json& report = made["code"]["realisation"];
      TEST_ASSERT_EQUAL_STRING(realisation, report["kind"].get<std::string>().c_str());
      TEST_ASSERT_TRUE(report["multiply_adds"][realisation] == made["code"]["multiply_adds"]);
      TEST_ASSERT_TRUE(report["multiply_adds"]["modal"] < report["multiply_adds"]["physical"]);
      TEST_ASSERT_TRUE(report["rounding_error"][realisation] > 0 && report["rounding_error"][realisation] < 1e-5);
      TEST_ASSERT_TRUE(report["agreement_digits"] > 40 && report["condition"] >= 1);
    }
}

void test_nothing_is_said_of_forms_when_none_is_asked_for() {
  const json made = json::parse(lqg::emit::json(controller_of(two_springs("filter"))));
  TEST_ASSERT_FALSE(made.contains("compensator") || made["code"].contains("realisation"));
}

// Both headers in one program, in a loop around a plant: every third sample an output is missing, one or the other or
// both. What is missing has come as expected in both forms, so that u stays the same but for rounding.
void test_missing_outputs_mean_the_same_in_every_form() {
  const std::string program = R"(
#include <math.h>
#include <stdio.h>

int main(void)
{
    loop_t physical;
    form_t form;
    float u[1] = {0}, v[1], y[2], x = 0.5f, speed = 0, worst = 0, largest = 0;
    lqg_status_t missing = 0;

    loop_init(&physical);
    form_init(&form);
    for (int k = 0; k < 300; k++) {
        lqg_status_t status;
        y[0] = k % 3 == 1 ? NAN : x + 0.01f * (float)(k % 5);
        y[1] = k % 6 == 1 ? -INFINITY : 0.3f * x + 0.1f * u[0];
        CALL_BOTH
        if (k % 3 == 1 && !(status & LQG_OUTPUT_REJECTED))
            return 1;
        missing |= status;
        worst = fmaxf(worst, fabsf(u[0] - v[0]));
        largest = fmaxf(largest, fabsf(u[0]));
        speed += 0.1f * (u[0] - x - 0.2f * speed);
        x += 0.1f * speed;
    }
    printf("%g %g %u", (double)worst, (double)largest, missing);
    return 0;
}
)";
  for (const char* form : {"filter", "predictor"})
    for (const char* realisation : {"folded", "modal"}) {
      DesignText design = two_springs(form);
      const std::string physical = lqg::emit::header(controller_of(design));
      design.name = "form";
      std::string text = physical + "#include \"form.h\"\n" + program;
      const std::string sample =
          std::string(form) == "filter"
              ? "loop_update(&physical, y); loop_control(&physical, u); loop_predict(&physical, u);"
                "status = form_control(&form, y, v); status |= form_advance(&form);"
              : "loop_control(&physical, u); loop_update(&physical, y); loop_predict(&physical, u);"
                "status = form_control(&form, v); status |= form_advance(&form, y);";
      text.replace(text.find("CALL_BOTH"), 9, sample);
      double worst = 1, largest = 0;
      unsigned missing = 0;
      const std::string answer = run_with_header(in_form(design, realisation), text);
      TEST_ASSERT_EQUAL_INT(3, std::sscanf(answer.c_str(), "%lf %lf %u", &worst, &largest, &missing));
      TEST_ASSERT_TRUE(largest > 0.1);
      TEST_ASSERT_TRUE_MESSAGE(worst < 1e-5 * largest, answer.c_str());
      TEST_ASSERT_EQUAL_UINT(1 | 3u << 8, missing);  // both outputs; no reset, no input that was not finite
    }
}

// x̂ by hand comes back: in predictor form as it is; in filter form after an output that came as expected, which leaves
// it.
void test_state_set_by_hand_is_the_estimate() {
  const std::string program = R"(
#include <math.h>
#include <stdio.h>
#include "form.h"

int main(void)
{
    const float x[4] = {0.5f, -1, 2, 0.25f};
    const float missing[2] = {NAN, NAN};
    float found[4], u[1], bad[4] = {0, NAN, 0, 0};
    form_t form;
    lqg_status_t status = 0;

    form_init(&form);
    status |= form_set_state(&form, x);
    CONTROL
    form_estimate(&form, found);
    for (int i = 0; i < 4; i++)
        if (!(fabsf(found[i] - x[i]) < 1e-5f))
            return 1 + i;
    (void)missing, (void)u;
    printf("%u %u", status, form_set_state(&form, bad));
    return form.z[0] == 0 ? 0 : 9;
}
)";
  for (const char* form : {"filter", "predictor"})
    for (const char* realisation : {"folded", "modal"}) {
      DesignText design = two_springs(form);
      design.name = "form";
      std::string text = program;
      text.replace(
          text.find("CONTROL"), 7,
          std::string(form) == "filter"
              ? "status |= form_control(&form, missing, u) & ~(LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BITS);"
              : "");
      TEST_ASSERT_EQUAL_STRING("0 16", run_with_header(in_form(design, realisation), text).c_str());
    }
}

// The physical form has a threshold by default: who leaves it is told, unless the file says that no spike comes.
void test_a_form_without_a_threshold_for_spikes_says_so() {
  const std::string text = toml(two_springs("filter")) + "realisation = \"modal\"\n";
  for (const bool is_ruled_out : {false, true}) {
    lqg::design::Problem problem = *lqg::input::parse_design(text).problem;
    if (is_ruled_out) problem.estimator->spike = std::numeric_limits<double>::infinity();
    lqg::design::Findings findings;
    const auto solution = lqg::design::solve(problem, findings);
    findings.clear();
    TEST_ASSERT_TRUE(lqg::emit::make_controller(problem, *solution, {}, findings).has_value());
    TEST_ASSERT_EQUAL_size_t(is_ruled_out ? 0 : 1, findings.size());
    if (!is_ruled_out) TEST_ASSERT_TRUE(findings[0].message.find("a spike is let in") != std::string::npos);
  }
}

void test_cheapest_takes_the_fewest_multiply_adds_and_physical_when_they_are_even() {
  const Controller controller = in_form(two_springs("filter"), "cheapest");
  const lqg::emit::FormChoice& forms = *controller.forms;
  TEST_ASSERT_TRUE(forms.chosen == lqg::design::Realisation::modal);
  TEST_ASSERT_TRUE(forms.modal->multiply_adds < forms.folded->multiply_adds);
  TEST_ASSERT_TRUE(forms.modal->multiply_adds == controller.cost.multiply_adds);

  DesignText one;  // x⁺ = x + u: z is x̂⁻, and update, control and predict are as few operations
  one.A = one.B = one.C = MatrixXd::Constant(1, 1, 1);
  one.Q = one.R = one.W = one.V = MatrixXd::Constant(1, 1, 1);
  one.gain = "steady", one.form = "predictor";
  const lqg::emit::FormChoice of_one = *in_form(one, "cheapest").forms;
  const long least = std::min(of_one.folded->multiply_adds, of_one.modal->multiply_adds);
  TEST_ASSERT_TRUE((of_one.chosen == lqg::design::Realisation::physical) == (of_one.physical.multiply_adds <= least));
}

// An observer that gives the controller the poles 0.5 ± 0.0005: their modes cancel, and "cheapest" does not take them.
void test_cheapest_does_not_buy_operations_with_errors() {
  const Controller controller = controller_of(R"(name = "near"
[plant]
domain = "discrete"
sample_time = 0.1
A = [[1, 0.1], [0, 1]]
B = [[0.005], [0.1]]
C = [[1, 0]]
[pole_placement]
poles = [0.9, 0.92]
[observer]
poles = [0.3430283195082636, 0.8369716804917362]
[code]
realisation = "cheapest"
)");
  const lqg::emit::FormChoice& forms = *controller.forms;
  TEST_ASSERT_TRUE(forms.modal && forms.modal->multiply_adds < forms.folded->multiply_adds);
  TEST_ASSERT_TRUE(forms.modal->rounding_error > lqg::emit::most_loss * forms.physical.rounding_error);
  TEST_ASSERT_TRUE(forms.chosen == lqg::design::Realisation::folded);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_emitted_forms_pass_their_own_test);
  RUN_TEST(test_an_output_that_nothing_is_made_of_is_looked_at);
  RUN_TEST(test_random_designs_pass_in_every_form_that_they_have);
  RUN_TEST(test_json_has_the_compensator_and_what_each_form_costs);
  RUN_TEST(test_nothing_is_said_of_forms_when_none_is_asked_for);
  RUN_TEST(test_missing_outputs_mean_the_same_in_every_form);
  RUN_TEST(test_state_set_by_hand_is_the_estimate);
  RUN_TEST(test_a_form_without_a_threshold_for_spikes_says_so);
  RUN_TEST(test_cheapest_takes_the_fewest_multiply_adds_and_physical_when_they_are_even);
  RUN_TEST(test_cheapest_does_not_buy_operations_with_errors);
  return UNITY_END();
}
