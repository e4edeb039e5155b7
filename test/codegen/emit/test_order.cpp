// SPDX-License-Identifier: MIT
// Compensators of a given order and designs under white parameters: what is emitted passes its own test, NAME.json says
// what an independent text in double finds, and the emitted C costs what it says.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include <unity.h>

#include "design/solve.hpp"
#include "design_text.hpp"
#include "emit/report/json.hpp"
#include "emitted.hpp"
#include "input/design_file.hpp"

using namespace lqg_test;
using Eigen::Index;
using Eigen::MatrixXd;
using lqg::emit::Controller;
using nlohmann::json;

namespace {

// Two springs that pull at each other, both seen, one driven.
DesignText two_springs(const char* form) {
  DesignText design;
  design.A =
      (MatrixXd(4, 4) << 0.9, 0.1, 0.05, 0, -0.3, 0.8, 0, 0.1, 0.05, 0, 0.85, 0.12, 0, 0.1, -0.4, 0.7).finished();
  design.B = (MatrixXd(4, 1) << 0.01, 0.2, 0, 0).finished();
  design.C = (MatrixXd(2, 4) << 1, 0, 0, 0, 0, 0, 1, 0).finished();
  design.Q = MatrixXd::Identity(4, 4);
  design.R = MatrixXd::Constant(1, 1, 0.1);
  design.W = 0.01 * MatrixXd::Identity(4, 4);
  design.V = 0.02 * MatrixXd::Identity(2, 2);
  design.form = form;
  design.gain = "steady";
  return design;
}

std::string with(std::string text, const std::string& table, const std::string& line) {
  return text.insert(text.find(table) + table.size(), line);
}

std::string of_order(const DesignText& design, int order, const std::string& realisation = "") {
  return toml(design) + (realisation.empty() ? "" : "realisation = \"" + realisation + "\"\n") +
         "[compensator]\norder = " + std::to_string(order) + "\n";
}

json json_of(const std::string& text) { return json::parse(lqg::emit::json(controller_of(text))); }

MatrixXd matrix(const json& rows) {
  MatrixXd out(rows.size(), rows.empty() ? 0 : rows[0].size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows[i].size(); ++j)
      out(static_cast<Index>(i), static_cast<Index>(j)) = rows[i][j].get<double>();
  return out;
}

// What white parameters add to a plant.
struct Deviation {
  MatrixXd A, B, C;
};

// The loop of NAME.json's plant and compensator in double, under white parameters.
struct Loop {
  MatrixXd A, B, C, D, Az, Bz, Cz, Dz, W, V, Q, R, N;
  std::vector<Deviation> white;

  explicit Loop(const json& made) {
    const json &plant = made["plant"], &own = made["compensator"], &noise = made["noise"], &cost = made["cost"];
    A = matrix(plant["A"]), B = matrix(plant["B"]), C = matrix(plant["C"]), D = matrix(plant["D"]);
    Az = matrix(own["A"]), Bz = matrix(own["B"]), Cz = matrix(own["C"]), Dz = matrix(own["D"]);
    const MatrixXd G = matrix(plant["G"]);
    W = G * matrix(noise["W"]) * G.transpose(), V = matrix(noise["V"]);
    Q = matrix(cost["Q"]), R = matrix(cost["R"]), N = matrix(cost["N"]);
  }

  MatrixXd map(const MatrixXd& a, const MatrixXd& b, const MatrixXd& c, bool is_mean) const {
    const Index nx = A.rows(), nz = Az.rows();
    MatrixXd phi(nx + nz, nx + nz);
    const MatrixXd at_once = is_mean ? MatrixXd(B * Dz * C) : MatrixXd(b * Dz * C + B * Dz * c);
    phi << a + at_once, b * Cz, Bz * c, is_mean ? MatrixXd(Az + Bz * D * Cz) : MatrixXd(MatrixXd::Zero(nz, nz));
    return phi;
  }

  // Second moments of [x; z], from nothing on until they stay.
  MatrixXd moments() const {
    const Index nx = A.rows(), nz = Az.rows();
    std::vector<MatrixXd> all = {map(A, B, C, true)};
    for (const Deviation& one : white) all.push_back(map(one.A, one.B, one.C, false));
    MatrixXd noise = MatrixXd::Zero(nx + nz, nx + nz), of_v(nx + nz, V.rows());
    of_v << B * Dz, Bz;
    noise.topLeftCorner(nx, nx) = W;
    noise += of_v * V * of_v.transpose();
    for (const Deviation& one : white) noise.topLeftCorner(nx, nx) += one.B * Dz * V * (one.B * Dz).transpose();
    MatrixXd P = noise;
    for (int k = 0; k < 20000; ++k) {
      MatrixXd next = noise;
      for (const MatrixXd& phi : all) next += phi * P * phi.transpose();
      if ((next - P).norm() <= 1e-16 * P.norm()) break;
      P = next;
    }
    return P;
  }

  double cost() const {
    const Index nx = A.rows(), nz = Az.rows(), nu = B.cols();
    const MatrixXd P = moments();
    MatrixXd see(nx + nu, nx + nz), weight(nx + nu, nx + nu);
    see << MatrixXd::Identity(nx, nx), MatrixXd::Zero(nx, nz), Dz * C, Cz;
    weight << Q, N, N.transpose(), R;
    MatrixXd of_u = Dz * V * Dz.transpose();
    for (const Deviation& one : white) of_u += Dz * one.C * P.topLeftCorner(nx, nx) * (Dz * one.C).transpose();
    return (weight * see * P * see.transpose()).trace() + (R * of_u).trace();
  }
};

void expect_near(double expected, double found, double relative) {
  TEST_ASSERT_DOUBLE_WITHIN(relative * std::abs(expected), expected, found);
}

void test_emitted_compensators_pass_their_own_test() {
  int made = 0;
  for (const char* form : {"filter", "predictor"})
    for (const char* real : {"float", "double"})
      for (const char* arithmetic : {"plain", "fused"})
        for (const char* realisation : {"physical", "modal"}) {
          DesignText design = two_springs(form);
          design.real = real, design.arithmetic = arithmetic;
          design.name = "order_" + std::to_string(made++);
          const Controller controller = controller_of(of_order(design, 2, realisation));
          TEST_ASSERT_EQUAL_INT(2, controller.size.nz);
          expect_emitted_to_pass(controller, {Language::c, Language::cxx});
        }
}

void test_a_feedthrough_of_the_plant_is_heard_as_it_acts() {
  for (const char* form : {"filter", "predictor"}) {
    DesignText design = two_springs(form);
    design.D = (MatrixXd(2, 1) << 0, 0.1).finished();
    design.name = std::string("through_") + form;
    const Controller controller = controller_of(of_order(design, 2));
    expect_emitted_to_pass(controller, {Language::c});
    if (controller.is_predictor) {
      const json made = json::parse(lqg::emit::json(controller));
      expect_near(made["loop"]["cost_per_sample"], Loop(made).cost(), 1e-12);
    }
  }
}

// D, C B, C A B, … of both are the same numbers; z of the full order is x̂ itself.
void test_the_full_order_is_the_lqg_controller() {
  for (const char* form : {"filter", "predictor"}) {
    const DesignText design = two_springs(form);
    const json own = json_of(of_order(design, 4)), lqg = json_of(toml(design) + "realisation = \"folded\"\n");
    for (const char* name : {"A", "B", "C", "D"}) {
      const MatrixXd found = matrix(own["compensator"][name]), expected = matrix(lqg["compensator"][name]);
      TEST_ASSERT_TRUE((found - expected).norm() <= 1e-12 * (1 + expected.norm()));
    }
    TEST_ASSERT_TRUE(matrix(own["compensator"]["T"]) == MatrixXd::Identity(4, 4));
    expect_near(lqg["loop"]["cost_per_sample"], own["loop"]["cost_per_sample"], 1e-13);
    TEST_ASSERT_DOUBLE_WITHIN(1e-10, 0, own["compensator"]["gap_percent"]);
  }
}

void test_cost_is_that_of_the_loop_and_falls_with_the_order() {
  for (const char* form : {"filter", "predictor"}) {
    double before = std::numeric_limits<double>::infinity();
    for (int order = 1; order <= 4; ++order) {
      const json made = json_of(of_order(two_springs(form), order));
      const double cost = made["loop"]["cost_per_sample"];
      expect_near(cost, Loop(made).cost(), 1e-12);
      TEST_ASSERT_TRUE(cost < before && made["compensator"]["cost_of_full_order"].get<double>() <= cost * (1 + 1e-13));
      TEST_ASSERT_TRUE(made["compensator"]["curvature"].get<double>() > 0);
      before = cost;
    }
  }
}

// E[(x − T z) zᵀ] = 0, its rows at `estimates` are those of the identity, and what is set comes back.
void test_T_is_the_best_linear_estimate() {
  const json made = json_of(of_order(two_springs("predictor"), 2));
  const MatrixXd P = Loop(made).moments(), T = matrix(made["compensator"]["T"]);
  TEST_ASSERT_TRUE((P.topRightCorner(4, 2) - T * P.bottomRightCorner(2, 2)).norm() <= 1e-12 * P.norm());
  for (int i = 0; i < 2; ++i) {
    const MatrixXd row = T.row(made["compensator"]["estimates"][i].get<int>());
    TEST_ASSERT_TRUE(row == MatrixXd::Identity(2, 2).row(i));
  }
  TEST_ASSERT_TRUE((matrix(made["compensator"]["of_state"]) * T - MatrixXd::Identity(2, 2)).norm() <= 1e-12);
}

void test_a_lost_packet_in_ten_is_part_of_the_optimum() {
  for (const char* form : {"filter", "predictor"}) {
    const std::string text = with(toml(two_springs(form)), "[plant]\n", "dropout = [0.1, 0]\n");
    const json made = json_of(text);
    Loop loop(made);
    TEST_ASSERT_EQUAL_INT(4, made["compensator"]["order"]);
    MatrixXd C1 = MatrixXd::Zero(2, 4);
    C1(0, 0) = std::sqrt(0.1 * 0.9);
    TEST_ASSERT_EQUAL_DOUBLE(0.9, loop.C(0, 0));
    loop.white = {{MatrixXd::Zero(4, 4), MatrixXd::Zero(4, 1), C1}};
    expect_near(made["loop"]["cost_per_sample"], loop.cost(), 1e-12);
    // Each of 8 other controllers nearby costs more.
    const double best = loop.cost();
    for (MatrixXd* numbers : {&loop.Az, &loop.Bz, &loop.Cz}) {
      for (const double step : {1e-3, -1e-3}) {
        const MatrixXd before = *numbers;
        (*numbers)(0, 0) += step;
        TEST_ASSERT_TRUE(loop.cost() > best);
        *numbers = before;
      }
    }
    loop.white.clear();
    expect_near(made["uncertain"]["nominal_cost_per_sample"], loop.cost(), 1e-12);
  }
}

lqg::design::Findings findings_of(const std::string& text) {
  lqg::input::DesignFile file = lqg::input::parse_design(text);
  lqg::design::Findings findings = file.findings;
  if (file.problem) (void)lqg::design::solve(*file.problem, findings);
  return findings;
}

// x⁺ = [1 T + δ; 0 1] x + [(T + δ)²/2; T + δ] u:  A₁ = σ [0 1; 0 0], B₁ = σ [T; 1].
void test_jitter_moves_the_period_of_a_double_integrator() {
  const std::string text =
      "name = \"late\"\n[plant]\ndomain = \"continuous\"\nsample_time = 0.5\nA = [[0, 1], [0, 0]]\nB = [[0], [1]]\n"
      "C = [[1, 0]]\njitter = 0.1\n[lqr]\nQ = [1, 1]\nR = [1]\n[kalman]\nprocess_noise = [0.1, 0.1]\n"
      "measurement_noise = [0.1]\nform = \"filter\"\ngain = \"steady\"\n";
  const json made = json_of(text);
  Loop loop(made);
  loop.white = {
      {(MatrixXd(2, 2) << 0, 0.1, 0, 0).finished(), (MatrixXd(2, 1) << 0.05, 0.1).finished(), MatrixXd::Zero(1, 2)}};
  expect_near(made["loop"]["cost_per_sample"], loop.cost(), 1e-12);
  TEST_ASSERT_TRUE(made["uncertain"]["unaware"]["cost_per_sample"] > made["loop"]["cost_per_sample"]);
}

// One state for a plant with poles at −1.79, 1.60 and 0.22; the search finds an optimum whose own pole is at −2.37.
void test_a_compensator_that_is_unstable_by_itself_is_emitted() {
  DesignText design = two_springs("predictor");
  design.name = "unstable";
  design.A = (MatrixXd(3, 3) << -0.9430734009845374, -0.9185285446326413, 0.5355751315087757, -1.835128075705529,
              -0.11470707064037514, -1.8048618139166934, 0.880777277059487, 0.16231848940201815, 1.0850527894392437)
                 .finished();
  design.B = (MatrixXd(3, 1) << -0.5041825699791492, 0.39819491214293934, -0.28587736278104525).finished();
  design.C = (MatrixXd(1, 3) << -0.7383269512797096, 0.14532433504702602, -1.2572075323652374).finished();
  design.Q = design.W = MatrixXd::Identity(3, 3);
  design.R = design.V = MatrixXd::Identity(1, 1);
  const Controller controller = controller_of(of_order(design, 1));
  TEST_ASSERT_TRUE(std::abs(controller.solution.compensator->poles.front()) > 1);
  expect_emitted_to_pass(controller, {Language::c});
  const lqg::design::Findings notes = findings_of(of_order(design, 1));
  TEST_ASSERT_TRUE(std::any_of(notes.begin(), notes.end(), [](const lqg::design::Finding& note) {
    return strstr(note.message.c_str(), "the compensator by itself is unstable") != nullptr;
  }));
}

// The fourth state changes the cost by less than 1e-10 of it: nobody asked for that many.
void test_white_parameters_alone_call_for_no_state_whose_worth_cannot_be_told() {
  const std::string text =
      "name = \"flat\"\n"
      "[plant]\n"
      "domain = \"discrete\"\n"
      "sample_time = 1\n"
      "A = [[0.19789, -0.329221, 0.174551, -0.618156], [0.197491, -0.394227, 0.0792927, -0.115906], "
      "[0.0981509, 0.15264, -0.0233913, -0.0229751], [-0.629526, -0.803596, 0.534169, 0.24303]]\n"
      "B = [[0.438346], [1.9092], [-0.714396], [0.510963]]\n"
      "C = [[0.425231, 0.108556, 0.60847, -1.37392], [-0.0361406, -0.254055, 0.0875632, -0.274177]]\n"
      "[lqr]\n"
      "Q = [1, 1, 1, 1]\n"
      "R = [1]\n"
      "[kalman]\n"
      "noise = \"discrete\"\n"
      "form = \"filter\"\n"
      "process_noise = [1, 1, 1, 1]\n"
      "measurement_noise = [0.1, 0.1]\n"
      "[[uncertain]]\n"
      "A = [[0.0884676, -0.0848002, 0.036246, 0.0349882], [-0.00978995, 0.042337, 0.0542088, -0.0532155], "
      "[0.0336165, 0.190555, -0.107091, -0.0302409], [-0.076693, 0.198501, -0.140279, 0.000708364]]\n"
      "[[uncertain]]\n"
      "B = [[0.0929139], [-0.08682], [-0.0136012], [-0.0711969]]\n";
  const json made = json_of(text);
  TEST_ASSERT_EQUAL_INT(3, made["compensator"]["order"]);
  const lqg::design::Findings notes = findings_of(text);
  TEST_ASSERT_TRUE(std::any_of(notes.begin(), notes.end(), [](const lqg::design::Finding& note) {
    return note.message.rfind("the compensator has 3 states, not 4: ", 0) == 0;
  }));
}

const char* scalar_plant =
    "name = \"gain\"\n[plant]\ndomain = \"discrete\"\nsample_time = 1\nA = [[2]]\nB = [[1]]\n[lqr]\nQ = [1]\nR = [1]\n"
    "[[uncertain]]\nB = [[";

// M. Athans, R. Ku, S. Gershwin, "The uncertainty threshold principle", IEEE Transactions on Automatic Control 22
// (1977), 491-495: x⁺ = 2 x + (1 + σγ) u has an optimal law for ever where 4 σ²/(1 + σ²) < 1: σ < 1/√3.
void test_the_uncertainty_threshold_on_both_sides() {
  const json made = json_of(std::string(scalar_plant) + "0.577]]\n");
  // X = 1 + 4X − (2X)²/(1 + X (1 + σ²)), K = 2X/(1 + X (1 + σ²))
  const double X = made["lqr"]["X"][0][0], K = made["lqr"]["K"][0][0], E = 1 + X * (1 + 0.577 * 0.577);
  expect_near(X, 1 + 4 * X - 4 * X * X / E, 1e-9);
  expect_near(K, 2 * X / E, 1e-12);
  expect_near((2 - K) * (2 - K) + 0.577 * 0.577 * K * K, made["uncertain"]["growth"], 1e-9);
  const lqg::design::Findings refused = findings_of(std::string(scalar_plant) + "0.578]]\n");
  TEST_ASSERT_TRUE(has_error(refused));
  TEST_ASSERT_NOT_NULL(strstr(refused.back().message.c_str(), "grow by a factor of 1.0017 in a sample"));
}

// X = A X Aᵀ + A₁ X A₁ᵀ + W of the plant alone; A₁ X A₁ᵀ is noise to the filter.
void test_a_filter_alone_takes_what_the_parameters_move_for_noise() {
  const std::string text =
      "name = \"drift\"\n[plant]\ndomain = \"discrete\"\nsample_time = 1\nA = [[0.9]]\nC = [[1]]\n[kalman]\n"
      "process_noise = [0.01]\nmeasurement_noise = [0.1]\ngain = \"steady\"\n[[uncertain]]\nA = [[0.3]]\nC = [[0.2]]\n";
  const json made = json_of(text);
  const double X = 0.01 / (1 - 0.81 - 0.09), W = 0.01 + 0.09 * X, V = 0.1 + 0.04 * X, S = 0.3 * 0.2 * X;
  expect_near(W, made["noise"]["W"][0][0], 1e-14);
  expect_near(V, made["noise"]["V"][0][0], 1e-14);
  expect_near(S, made["noise"]["cross"][0][0], 1e-14);
  const double P = made["kalman"]["P_prior"][0][0], L = made["kalman"]["L_predictor"][0][0];
  expect_near((0.9 * P + S) / (P + V), L, 1e-13);
  expect_near(0.81 * P + W - (0.9 * P + S) * L, P, 1e-12);
  const lqg::design::Findings refused = findings_of(with(text, "A = [[0.9", "9"));
  TEST_ASSERT_TRUE(has_error(refused));
  TEST_ASSERT_NOT_NULL(strstr(refused.back().message.c_str(), "grow by a factor of"));
}

// A mass between a spring and a wall, and what a continuous cost makes of it.
void test_the_full_order_of_a_continuous_cost_is_lqg() {
  DesignText design = double_integrator();
  design.domain = "continuous", design.sample_time = 0.01;
  design.A = (MatrixXd(2, 2) << 0, 1, -1, -0.1).finished(), design.B = (MatrixXd(2, 1) << 0, 1).finished();
  design.C = (MatrixXd(1, 2) << 1, 0).finished(), design.D.resize(0, 0), design.G.resize(0, 0);
  design.Q = MatrixXd::Identity(2, 2), design.R = MatrixXd::Identity(1, 1), design.N.resize(0, 0);
  design.W = 0.1 * MatrixXd::Identity(2, 2), design.V = 0.01 * MatrixXd::Identity(1, 1), design.Swv.resize(0, 0);
  design.cost = "continuous", design.noise = "continuous", design.gain = "steady", design.form = "predictor";
  design.covariance = "", design.u_min.resize(0), design.u_max.resize(0);
  design.name = "held";
  const json full = json_of(of_order(design, 2));
  TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0, full["compensator"]["gap_percent"]);
  expect_near(full["compensator"]["cost_of_full_order"], full["loop"]["cost_per_second"], 1e-12);
  TEST_ASSERT_TRUE(full["compensator"]["held_cost_per_second"] > full["loop"]["cost_per_second"]);
  const Controller one = controller_of(of_order(design, 1));
  const json made = json::parse(lqg::emit::json(one));
  const double a = made["compensator"]["continuous"]["A"][0][0], b = made["compensator"]["continuous"]["B"][0][0];
  expect_near(std::exp(0.01 * a), made["compensator"]["A"][0][0], 1e-14);
  expect_near((std::exp(0.01 * a) - 1) / a * b, made["compensator"]["B"][0][0], 1e-12);
  expect_emitted_to_pass(one, {Language::c});
}

// The emitted C around a plant that loses packets: means of 64 runs of 20,000 samples each, whose spread tells how far
// their mean may be from what is expected. 4.5 of its standard deviations: once in 150,000 seeds.
void test_the_emitted_c_costs_what_is_said_where_packets_are_lost() {
  DesignText design = two_springs("predictor");
  design.name = "lossy", design.real = "double";
  const Controller controller = controller_of(with(toml(design), "[plant]\n", "dropout = [0.3, 0]\n"));
  const json made = json::parse(lqg::emit::json(controller));
  const std::string program = R"(
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include "lossy.h"
static uint64_t state = 88172645463325252u;
static double uniform(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return ((double)(state >> 11) + 0.5) / 9007199254740992.0;
}
static double normal(void) { return sqrt(-2 * log(uniform())) * cos(6.283185307179586 * uniform()); }
int main(void)
{
    static const double A[4][4] = {{0.9, 0.1, 0.05, 0}, {-0.3, 0.8, 0, 0.1},
                                   {0.05, 0, 0.85, 0.12}, {0, 0.1, -0.4, 0.7}};
    static const double B[4] = {0.01, 0.2, 0, 0};
    double sum = 0, squares = 0;
    for (int run = 0; run < 64; run++) {
        lossy_t self;
        double x[4] = {0, 0, 0, 0}, cost = 0;
        lossy_init(&self);
        for (int k = -500; k < 20000; k++) {
            double y[2], u[1], next[4];
            (void)lossy_control(&self, u);
            y[0] = (uniform() < 0.3 ? 0 : x[0]) + sqrt(0.02) * normal();
            y[1] = x[2] + sqrt(0.02) * normal();
            (void)lossy_advance(&self, y);
            if (k >= 0) cost += x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3] + 0.1 * u[0] * u[0];
            for (int i = 0; i < 4; i++) {
                next[i] = B[i] * u[0] + 0.1 * normal();
                for (int j = 0; j < 4; j++) next[i] += A[i][j] * x[j];
            }
            for (int i = 0; i < 4; i++) x[i] = next[i];
        }
        sum += cost / 20000;
        squares += cost / 20000 * (cost / 20000);
    }
    printf("%.17g %.17g\n", sum / 64, sqrt((squares / 64 - sum / 64 * (sum / 64)) / 63));
    return 0;
}
)";
  double mean = 0, deviation = 0;
  TEST_ASSERT_EQUAL_INT(2, sscanf(run_with_header(controller, program).c_str(), "%lf %lf", &mean, &deviation));
  const double expected = made["loop"]["cost_per_sample"];
  TEST_ASSERT_TRUE(deviation < 0.005 * expected);  // it can tell
  TEST_ASSERT_DOUBLE_WITHIN(4.5 * deviation, expected, mean);
}

}  // namespace

void setUp(void) {}
void tearDown(void) {}

int main(void) {
  UNITY_BEGIN();
  RUN_TEST(test_emitted_compensators_pass_their_own_test);
  RUN_TEST(test_a_feedthrough_of_the_plant_is_heard_as_it_acts);
  RUN_TEST(test_the_full_order_is_the_lqg_controller);
  RUN_TEST(test_cost_is_that_of_the_loop_and_falls_with_the_order);
  RUN_TEST(test_T_is_the_best_linear_estimate);
  RUN_TEST(test_a_lost_packet_in_ten_is_part_of_the_optimum);
  RUN_TEST(test_jitter_moves_the_period_of_a_double_integrator);
  RUN_TEST(test_a_compensator_that_is_unstable_by_itself_is_emitted);
  RUN_TEST(test_white_parameters_alone_call_for_no_state_whose_worth_cannot_be_told);
  RUN_TEST(test_the_uncertainty_threshold_on_both_sides);
  RUN_TEST(test_a_filter_alone_takes_what_the_parameters_move_for_noise);
  RUN_TEST(test_the_full_order_of_a_continuous_cost_is_lqg);
  RUN_TEST(test_the_emitted_c_costs_what_is_said_where_packets_are_lost);
  return UNITY_END();
}
