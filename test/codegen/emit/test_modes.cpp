// SPDX-License-Identifier: MIT
// Filters that carry P and keep z: what is emitted passes its own test, is the filter that keeps x̂ for any outputs, in
// faults too, and is chosen where it is cheaper.
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
#include "simulate/emitted_controller.hpp"
#include "simulate/numbers.hpp"
#include "simulate/plant.hpp"
#include "step/covariance.hpp"

using namespace lqg_test;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using lqg::emit::Controller;
using lqg::simulate::EmittedController;
using nlohmann::json;

namespace {

Controller in_form(const DesignText& design, const std::string& form) {
  return controller_of(toml(design) + "realisation = \"" + form + "\"\n");
}

// Poles within the unit circle, every number another one.
DesignText dense(int nx, int nu, int ny, std::uint64_t seed) {
  Random random(seed);
  const auto by_chance = [&](int rows, int columns) {
    MatrixXd out(rows, columns);
    for (double& entry : out.reshaped()) entry = random.uniform();
    return out;
  };
  DesignText design;
  design.A = by_chance(nx, nx);
  design.A *= 0.95 / design.A.cwiseAbs().rowwise().sum().maxCoeff();
  design.B = by_chance(nx, nu);
  design.C = by_chance(ny, nx);
  design.Q = MatrixXd::Identity(nx, nx);
  design.R = MatrixXd::Identity(nu, nu);
  design.W = 0.01 * MatrixXd::Identity(nx, nx);
  design.V = 0.1 * MatrixXd::Identity(ny, ny);
  design.P0 = MatrixXd::Identity(nx, nx);
  design.x0 = by_chance(nx, 1);
  design.gain = "online";
  design.covariance = "plain";
  return design;
}

// With D, correlated noise of both kinds, two poles of each kind.
DesignText correlated(const char* form, const char* covariance) {
  DesignText design = dense(4, 1, 2, 5);
  design.D = (MatrixXd(2, 1) << 0, 0.1).finished();
  design.V = (MatrixXd(2, 2) << 0.1, 0.03, 0.03, 0.2).finished();
  design.Swv = 0.004 * MatrixXd::Ones(4, 2);
  design.form = form, design.covariance = covariance;
  return design;
}

// Masses in a chain between walls, both ends seen: hardly a number of it is not 0.
DesignText chain(int masses) {
  DesignText design;
  const int nx = 2 * masses;
  design.A = MatrixXd::Zero(nx, nx);
  for (int i = 0; i < masses; ++i) {
    design.A(2 * i, 2 * i + 1) = 1;
    design.A(2 * i + 1, 2 * i) = -2 - 0.1 * i, design.A(2 * i + 1, 2 * i + 1) = -0.02;
    if (i > 0) design.A(2 * i + 1, 2 * i - 2) = 1;
    if (i + 1 < masses) design.A(2 * i + 1, 2 * i + 2) = 1;
  }
  design.A = 0.98 * (MatrixXd::Identity(nx, nx) + 0.05 * design.A);
  design.B = MatrixXd::Zero(nx, 1), design.B(1, 0) = 0.05;
  design.C = MatrixXd::Zero(2, nx), design.C(0, 0) = design.C(1, nx - 2) = 1;
  design.Q = MatrixXd::Identity(nx, nx), design.R = MatrixXd::Identity(1, 1);
  design.W = 1e-4 * MatrixXd::Identity(nx, nx), design.V = 1e-3 * MatrixXd::Identity(2, 2);
  design.gain = "online", design.covariance = "plain";
  return design;
}

void test_emitted_filters_pass_their_own_test() {
  int made = 0;
  for (const char* form : {"filter", "predictor"})
    for (const char* covariance : {"plain", "ud"})
      for (const char* real : {"float", "double"})
        for (const char* arithmetic : {"plain", "fused"}) {
          DesignText design = correlated(form, covariance);
          design.real = real, design.arithmetic = arithmetic;
          design.name = "modes_" + std::to_string(made++);
          const Controller controller = in_form(design, "modal");
          TEST_ASSERT_TRUE(controller.modal.has_value());
          expect_emitted_to_pass(controller, {Language::c, Language::cxx});
        }
}

// Everything by chance: domains, D, noises, limits. At least some have such coordinates.
void test_random_designs_pass_where_they_have_modes() {
  int made = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Random random(seed);
    DesignText design = random_design(random, 1 + static_cast<int>(seed % 6));
    design.gain = "online", design.covariance = seed % 2 ? "ud" : "plain", design.style = "auto";
    const Controller any = in_form(design, "cheapest");
    if (!any.forms) continue;
    design.name = "random_" + std::to_string(seed);
    expect_emitted_to_pass(in_form(design, "modal"), {Language::c});
    ++made;
  }
  TEST_ASSERT_GREATER_THAN_INT(3, made);
}

// ---- beside the filter that keeps x̂ -------------------------------------------------------------------------------

// Largest differences from the reference, and largest numbers of it.
struct Differences {
  VectorXd of_modal, of_physical, scale;

  void add(const VectorXd& modal, const VectorXd& physical, const VectorXd& reference) {
    if (scale.size() == 0) of_modal = of_physical = scale = VectorXd::Zero(reference.size());
    of_modal = of_modal.cwiseMax((modal - reference).cwiseAbs());
    of_physical = of_physical.cwiseMax((physical - reference).cwiseAbs());
    scale = scale.cwiseMax(reference.cwiseAbs());
  }
  // T and its inverse take a rounding error of one part of x to another `condition` times as large, in the best units:
  // those that make the scales one.
  void expect_small(double condition, double epsilon, const char* what) const {
    const double worst = (of_physical.array() / scale.array()).maxCoeff();
    for (Eigen::Index i = 0; i < scale.size(); ++i)
      TEST_ASSERT_TRUE_MESSAGE(of_modal(i) <= 4 * condition * (worst + 4 * epsilon) * scale(i),
                               (std::string(what) + " " + std::to_string(i) + ": " + std::to_string(of_modal(i)) +
                                " of " + std::to_string(scale(i)))
                                   .c_str());
  }
};

template <class S>
VectorXd covariance_of(const EmittedController<S>& emitted) {
  const std::vector<S> P = lqg::step::covariance(emitted.model(), emitted.state());
  VectorXd out(static_cast<Eigen::Index>(P.size()));
  for (std::size_t i = 0; i < P.size(); ++i) out(static_cast<Eigen::Index>(i)) = lqg::simulate::as_double(P[i]);
  return out;
}

template <class S>
struct Run {
  EmittedController<S> emitted;
  VectorXd u;

  // One sample as it comes; u is that of the reference.
  unsigned hear(const VectorXd& y) { return emitted.update(lqg::simulate::numbers_of<S>(y)); }
  void act() {
    lqg::step::Vector<S> made;
    emitted.control(made);
    u = lqg::simulate::as_doubles(made);
  }
  void predict(const VectorXd& applied) { emitted.predict(lqg::simulate::numbers_of<S>(applied)); }
};

// In float, beside the double that both stand for: x̂, P and u of 10⁴ noisy samples, of which some miss outputs.
void expect_the_same_filter(const Controller& modal) {
  const Controller& physical = *modal.physical;
  const auto in_float = lqg::simulate::constants_of<float>(modal.target);
  Run<float> of_z{{modal, in_float}, {}}, of_x{{physical, in_float}, {}};
  Run<double> reference{{physical, [](const lqg::design::Real& value) { return lqg::design::to_double(value); }}, {}};
  lqg::simulate::Plant plant(physical, physical.x0, lqg::simulate::PlantNoise::designed, 7);
  Random random(11);
  Differences x, P, u;
  VectorXd applied = VectorXd::Zero(modal.size.nu);
  for (int k = 0; k < 10000; ++k) {
    const auto act = [&] {
      of_z.act(), of_x.act(), reference.act();
      u.add(of_z.u, of_x.u, reference.u);
      applied = lqg::simulate::in_target(modal.target, reference.u);
    };
    if (modal.is_predictor) act();
    VectorXd y = lqg::simulate::in_target(modal.target, plant.measure(applied));
    if (k % 11 == 4) y(random.below(modal.size.ny)) = std::numeric_limits<double>::quiet_NaN();
    const unsigned events = reference.hear(y);
    TEST_ASSERT_EQUAL_UINT(events, of_z.hear(y));
    TEST_ASSERT_EQUAL_UINT(events, of_x.hear(y));
    if (!modal.is_predictor) act();
    x.add(lqg::simulate::as_doubles(of_z.emitted.estimate()), lqg::simulate::as_doubles(of_x.emitted.estimate()),
          lqg::simulate::as_doubles(reference.emitted.estimate()));
    P.add(covariance_of(of_z.emitted), covariance_of(of_x.emitted), covariance_of(reference.emitted));
    of_z.predict(applied), of_x.predict(applied), reference.predict(applied);
    plant.advance(applied);
  }
  constexpr double epsilon = 0x1p-24;
  const double condition = modal.modal->condition;
  TEST_ASSERT_EQUAL_UINT(0, of_z.emitted.resets());
  x.expect_small(condition, epsilon, "x̂");
  u.expect_small(condition * static_cast<double>(modal.size.nx), epsilon, "u");
  P.expect_small(condition * condition, epsilon, "P");
}

void test_estimates_covariances_and_inputs_are_those_of_the_physical_filter() {
  expect_the_same_filter(in_form(dense(6, 2, 3, 1), "modal"));
  for (const char* form : {"filter", "predictor"})
    for (const char* covariance : {"plain", "ud"})
      expect_the_same_filter(in_form(correlated(form, covariance), "modal"));
}

// P of the start, in both coordinates.
void test_P_begins_anew_as_that_of_the_physical_filter() {
  const Controller modal = in_form(dense(6, 2, 3, 1), "modal");
  EmittedController<float> of_z(modal, lqg::simulate::constants_of<float>(modal.target));
  const VectorXd start = covariance_of(of_z);
  const VectorXd y = VectorXd::Zero(3), u = VectorXd::Zero(2);
  for (int k = 0; k < 5; ++k) of_z.update(lqg::simulate::numbers_of<float>(y)), of_z.predict({u.cast<float>()});
  TEST_ASSERT_TRUE((covariance_of(of_z) - start).cwiseAbs().maxCoeff() > 0.1);
  const VectorXd x = lqg::simulate::as_doubles(of_z.estimate());
  of_z.state().P[0] = -1;
  of_z.predict({u.cast<float>()});
  TEST_ASSERT_EQUAL_UINT(1, of_z.covariance_resets());
  TEST_ASSERT_EQUAL_UINT(0, of_z.resets());
  TEST_ASSERT_TRUE((covariance_of(of_z) - start).cwiseAbs().maxCoeff() == 0);
  TEST_ASSERT_TRUE(x.cwiseAbs().maxCoeff() > 0);  // which stayed
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) TEST_ASSERT_DOUBLE_WITHIN(1e-5, i == j, start(lqg::step::triangle(i, j)));
}

void test_state_set_by_hand_is_the_estimate_that_is_read() {
  DesignText design = correlated("filter", "plain");
  design.name = "loop";
  const std::string program = R"(
#include <math.h>
#include <stdio.h>

#include "loop.h"

int main(void)
{
    static loop_t loop;
    const float x[4] = {1.0f, -2.0f, 3.0f, 0.5f}, bad[4] = {0.0f, NAN, 0.0f, 0.0f};
    float found[4];
    lqg_status_t status;

    loop_init(&loop);
    status = loop_set_state(&loop, x);
    loop_estimate(&loop, found);
    for (int i = 0; i < 4; i++)
        if (!(fabsf(found[i] - x[i]) < 1e-4f))
            return 1 + i;
    printf("%u %u", status, loop_set_state(&loop, bad));
    return loop.resets == 1 ? 0 : 9;
}
)";
  TEST_ASSERT_EQUAL_STRING("0 16", run_with_header(in_form(design, "modal"), program).c_str());
}

// ---- what is said ---------------------------------------------------------------------------------------------------

MatrixXd matrix(const json& rows) {
  MatrixXd out(rows.size(), rows.empty() ? 0 : rows[0].size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows[i].size(); ++j)
      out(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = rows[i][j].get<double>();
  return out;
}

void expect_equal(const MatrixXd& expected, const MatrixXd& found) {
  TEST_ASSERT_TRUE((expected - found).cwiseAbs().maxCoeff() < 1e-12 * (1 + expected.cwiseAbs().maxCoeff()));
}

void test_json_has_both_plants() {
  const Controller controller = in_form(correlated("filter", "plain"), "modal");
  const json made = json::parse(lqg::emit::json(controller));
  const json &modes = made["modes"], &plant = made["plant"], &code = made["code"]["realisation"];
  const MatrixXd T = matrix(modes["T"]);
  expect_equal(MatrixXd::Identity(4, 4), matrix(modes["inverse"]) * T);
  expect_equal(matrix(plant["A"]) * T, T * matrix(modes["A"]));
  expect_equal(matrix(plant["B"]), T * matrix(modes["B"]));
  expect_equal(matrix(plant["C"]) * T, matrix(modes["C"]));
  expect_equal(matrix(plant["G"]), T * matrix(modes["G"]));
  expect_equal(matrix(made["lqr"]["K"]) * T, matrix(modes["K"]));
  expect_equal(controller.problem.estimator->x0, T * matrix(modes["z0"]));
  expect_equal(MatrixXd::Identity(4, 4), T * matrix(modes["P0"]) * T.transpose());
  TEST_ASSERT_EQUAL_STRING("modal", code["kind"].get<std::string>().c_str());
  TEST_ASSERT_TRUE(code["multiply_adds"]["modal"] == made["code"]["multiply_adds"]);
  TEST_ASSERT_TRUE(code["share_of_deviation"]["modal"] < 1e-3 && code["agreement_digits"] > 40 &&
                   code["condition"] >= 1);
  TEST_ASSERT_FALSE(code["multiply_adds"].contains("folded") || made.contains("compensator"));
  TEST_ASSERT_TRUE(made["numerics"]["bounds"].contains("z") && !made["numerics"]["bounds"].contains("x"));
}

// Of a design that keeps x̂ nothing is another.
void test_physical_header_is_as_before() {
  const DesignText design = dense(4, 1, 2, 5);
  const std::string plain = lqg::emit::header(controller_of(design)),
                    asked = lqg::emit::header(in_form(design, "physical"));
  const auto body = [](const std::string& text) { return text.substr(text.find("#ifndef LOOP_H")); };
  TEST_ASSERT_EQUAL_STRING(body(plain).c_str(), body(asked).c_str());
  TEST_ASSERT_TRUE(plain.find("loop_estimate") == std::string::npos);
}

// ---- what is chosen -------------------------------------------------------------------------------------------------

void test_cheapest_takes_the_modes_of_a_dense_plant_and_the_states_of_a_chain() {
  const Controller taken = in_form(dense(6, 2, 3, 1), "cheapest");
  TEST_ASSERT_TRUE(taken.modal && taken.forms->chosen == lqg::design::Realisation::modal);
  TEST_ASSERT_TRUE(taken.cost.multiply_adds == taken.forms->modal->multiply_adds);
  TEST_ASSERT_TRUE(10 * taken.forms->modal->multiply_adds < 6 * taken.forms->physical.multiply_adds);
  const Controller left = in_form(chain(6), "cheapest");
  TEST_ASSERT_TRUE(!left.modal && left.forms->chosen == lqg::design::Realisation::physical);
  TEST_ASSERT_TRUE(left.forms->modal->multiply_adds > left.forms->physical.multiply_adds);
}

// Straight-line code that the flash has no room for is no choice: loops over x̂ are smaller.
void test_cheapest_takes_what_fits() {
  DesignText design = dense(9, 2, 3, 1);
  design.style = "auto";
  const long flash = in_form(design, "cheapest").cost.flash;
  std::string text = toml(design) + "realisation = \"cheapest\"\n";
  text.replace(text.find("flash = 1000000"), 15, "flash = " + std::to_string(flash - 1));
  const Controller controller = controller_of(text);
  TEST_ASSERT_FALSE(controller.modal.has_value());
  TEST_ASSERT_TRUE(controller.forms->chosen == lqg::design::Realisation::physical);
  TEST_ASSERT_LESS_THAN_INT64(flash, controller.cost.flash);
}

std::string finding_of(const DesignText& design, const std::string& more) {
  const lqg::input::DesignFile file = lqg::input::parse_design(toml(design) + more);
  TEST_ASSERT_TRUE(file.problem.has_value());
  lqg::design::Findings findings;
  const auto solution = lqg::design::solve(*file.problem, findings);
  findings.clear();
  lqg::emit::make_controller(*file.problem, *solution, {}, findings);
  return findings.empty() ? "" : findings.front().key + ": " + findings.front().message;
}

void test_what_has_no_modes_says_why() {
  DesignText design = dense(4, 1, 2, 5);
  TEST_ASSERT_EQUAL_STRING("code.realisation: expected \"physical\": the filter's gain is not constant",
                           finding_of(design, "realisation = \"folded\"\n").c_str());
  design.style = "compact";
  TEST_ASSERT_EQUAL_STRING(
      "code.realisation: expected \"physical\": the library's loops, style = \"compact\", are of x̂",
      finding_of(design, "realisation = \"modal\"\n").c_str());
  TEST_ASSERT_EQUAL_STRING("code.realisation: physical: the library's loops, style = \"compact\", are of x̂",
                           finding_of(design, "realisation = \"cheapest\"\n").c_str());
  design = double_integrator();
  design.gain = "online", design.covariance = "plain";
  TEST_ASSERT_EQUAL_STRING("code.realisation: expected \"physical\": a pole of the plant is repeated",
                           finding_of(design, "realisation = \"modal\"\n").c_str());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_emitted_filters_pass_their_own_test);
  RUN_TEST(test_random_designs_pass_where_they_have_modes);
  RUN_TEST(test_estimates_covariances_and_inputs_are_those_of_the_physical_filter);
  RUN_TEST(test_P_begins_anew_as_that_of_the_physical_filter);
  RUN_TEST(test_state_set_by_hand_is_the_estimate_that_is_read);
  RUN_TEST(test_json_has_both_plants);
  RUN_TEST(test_physical_header_is_as_before);
  RUN_TEST(test_cheapest_takes_the_modes_of_a_dense_plant_and_the_states_of_a_chain);
  RUN_TEST(test_cheapest_takes_what_fits);
  RUN_TEST(test_what_has_no_modes_says_why);
  return UNITY_END();
}
