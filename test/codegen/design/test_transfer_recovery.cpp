// SPDX-License-Identifier: MIT
// Loop transfer recovery: the gain of noise that is not there, and the loop and its errors under the noise that is.
#include <cmath>
#include <string>

#include <unity.h>

#include "design/equations/riccati.hpp"
#include "design/loop/compensator.hpp"
#include "design/rounding.hpp"
#include "design/sampled/samples.hpp"
#include "problems.hpp"

using namespace lqg::design;
using namespace design_test;
using Eigen::MatrixXd;

namespace {

const double rounding = 1e-15;  // of a double, and of the comparison

Problem with_recovery(Problem problem, double q) {
  problem.estimator->recovery = TransferRecovery{q, false};
  return problem;
}

Problem with_auto(Problem problem) {
  problem.estimator->recovery = TransferRecovery{0, true};
  return problem;
}

// J. C. Doyle, "Guaranteed margins for LQG regulators", IEEE Transactions on Automatic Control 23 (1978), 756–757, with
// q = σ = 60, sampled every 10 ms.
Problem doyle() {
  Problem problem = problem_of(Domain::continuous, 0.01, (MatrixXd(2, 2) << 1, 1, 0, 1).finished(),
                               Eigen::Vector2d(0, 1), Eigen::RowVector2d(1, 0));
  problem.plant.G = Eigen::Vector2d(1, 1);
  problem.plant.H = MatrixXd::Zero(1, 1);
  problem.regulator->Q = MatrixXd::Constant(2, 2, 60);
  problem.regulator->R = MatrixXd::Constant(1, 1, 1);
  problem.regulator->cost = Cost::sampled;
  problem.estimator->W = MatrixXd::Constant(1, 1, 60);
  problem.estimator->V = MatrixXd::Constant(1, 1, 1);
  problem.estimator->Swv = MatrixXd::Zero(1, 1);
  problem.estimator->noise = Noise::continuous;
  problem.estimator->form = Form::filter;
  problem.code.real = lqg::design::Scalar::float64;
  return problem;
}

Problem oscillator() {
  Problem problem = doyle();
  problem.plant.sample_time = 0.125;
  problem.plant.A = (MatrixXd(2, 2) << 0, 1, -4, -0.5).finished();
  problem.plant.B = Eigen::Vector2d(0, 2);
  problem.plant.G = Eigen::Vector2d(0, 1);
  problem.regulator->Q = Eigen::Vector2d(1, 0).asDiagonal();
  problem.regulator->R = MatrixXd::Constant(1, 1, 0.125);
  problem.estimator->W = MatrixXd::Constant(1, 1, 0.25);
  problem.estimator->V = MatrixXd::Constant(1, 1, 1.0 / 1024);
  return problem;
}

void expect_near(double expected, double found, const char* what, double share = 1e-14) {
  expect_small(Real(std::abs(found / expected - 1)), share, what);
}

// By transfer_recovery_reference.py.
struct Reference {
  double q, L[2], P[3], cost, disk;  // P: lower triangle, before the outputs
};

void expect_reference(const Problem& problem, const Reference& expected) {
  const Solution found = solved(with_recovery(problem, expected.q));
  const EstimatorSolution& filter = *found.estimator;
  for (int i = 0; i < 2; ++i) expect_near(expected.L[i], to_double(filter.L(i, 0)), "L");
  expect_near(expected.P[0], to_double(filter.P_prior(0, 0)), "P");
  expect_near(expected.P[1], to_double(filter.P_prior(1, 0)), "P");
  expect_near(expected.P[2], to_double(filter.P_prior(1, 1)), "P");
  expect_near(expected.cost, *found.loop.cost_per_sample, "cost");
  expect_near(expected.disk, *found.loop.at_input.disk, "disk margin", 1e-12);
}

void test_doyles_example_has_the_margins_and_the_cost_of_the_reference() {
  expect_reference(doyle(), {0,
                             {0.09514562798826412714, 0.095137702968785296751},
                             {10.51502108308651656, 10.514145249391729748, 20.516394340817017197},
                             79.336966597619945613,
                             0.0099495786846983927418});
  expect_reference(doyle(), {11000,
                             {0.16873123943570607486, 1.1158694523096232096},
                             {16.474593868717554134, 71.08956841102813939, 657.99988162733700377},
                             829.5730508434041114,
                             0.44149796525646924778});
}

void test_oscillator_has_the_gains_and_errors_of_the_reference() {
  expect_reference(oscillator(), {0,
                                  {0.4318733256361783742, 0.95087025565013383847},
                                  {0.0059388346099235732862, 0.013075735056068561615, 0.074073501356081381569},
                                  0.0035882670798469321173,
                                  1.0716443823863246042});
  expect_reference(oscillator(), {0.5,
                                  {0.66610699847936709713, 2.8272379924818558773},
                                  {0.0092751224913334036294, 0.02375731218011012431, 0.11329038955405615903},
                                  0.0047736952050562429911,
                                  1.121712927421763379});
}

// Of a discrete plant q is a variance: the gain is that of a design with B as further columns of G.
void test_gain_is_that_of_noise_at_the_inputs_written_by_hand() {
  int tried = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Problem problem = random_problem(seed);
    if (problem.plant.domain == Domain::continuous) continue;
    ++tried;
    problem.estimator->gain = Gain::steady;
    const Solution recovered = solved(with_recovery(problem, 0.75));
    const Index nu = problem.plant.B.cols(), ny = problem.plant.C.rows(), nw = problem.plant.G.cols();
    MatrixXd G(problem.plant.A.rows(), nw + nu), W = MatrixXd::Zero(nw + nu, nw + nu);
    MatrixXd H = MatrixXd::Zero(ny, nw + nu), Swv = MatrixXd::Zero(nw + nu, ny);
    G << problem.plant.G, problem.plant.B;
    W.topLeftCorner(nw, nw) = problem.estimator->W;
    W.bottomRightCorner(nu, nu) = 0.75 * MatrixXd::Identity(nu, nu);
    if (problem.plant.H.size() > 0) H.leftCols(nw) = problem.plant.H;
    Swv.topRows(nw) = problem.estimator->Swv;
    problem.plant.G = G, problem.plant.H = H, problem.estimator->W = W, problem.estimator->Swv = Swv;
    const Solution by_hand = solved(problem);
    expect_rounded(by_hand.estimator->L, recovered.estimator->L, "L");
    expect_rounded(by_hand.estimator->M, recovered.estimator->M, "M");
    TEST_ASSERT_TRUE(by_hand.estimator->P_prior(0, 0) > recovered.estimator->P_prior(0, 0));
  }
  TEST_ASSERT_TRUE(tried > 3);
}

// [x; s] of plant and controller under the noise itself, by a sum of powers in double: nothing of the engine's but K, L
// and M is in it. The first nx of [x − x̂⁻] have P_prior.
void expect_errors_and_cost_of_the_loop(const Problem& problem) {
  const Solution found = solved(problem);
  const EstimatorSolution& filter = *found.estimator;
  const auto in = [](const RealMatrix& a) { return to_doubles(a); };
  const MatrixXd A = in(found.plant.A), B = in(found.plant.B), C = in(found.plant.C), G = in(found.plant.G);
  const MatrixXd K = in(found.regulator->K), L = in(filter.L), M = in(filter.M);
  const bool filtered = problem.estimator->form == Form::filter;
  const Index nx = A.rows(), ny = C.rows(), nw = G.cols();
  const MatrixXd I = MatrixXd::Identity(nx, nx), used = filtered ? L : MatrixXd(0 * L), Lp = A * L + M;
  MatrixXd F(2 * nx, 2 * nx), D(2 * nx, nw + ny), noise(nw + ny, nw + ny);
  // x⁺ = A x − B K (x̂⁻ + used (C (x − x̂⁻) + v)) + G w,  e⁺ = (A − Lp C) e + G w − Lp v,  x̂⁻ = x − e
  F << A - B * K, B * K * (I - used * C), MatrixXd::Zero(nx, nx), A - Lp * C;
  D << G, -B * K * used, G, -Lp;
  noise << in(filter.noise.W), in(filter.noise.Swv), in(filter.noise.Swv).transpose(), in(filter.noise.V);
  MatrixXd S = D * noise * D.transpose(), power = F;
  for (int k = 0; k < 24; ++k) S += (power * S * power.transpose()).eval(), power = (power * power).eval();
  const MatrixXd P = in(filter.P_prior);
  TEST_ASSERT_TRUE((S.bottomRightCorner(nx, nx) - P).norm() < 1e-9 * P.norm());
  const MatrixXd after = (I - L * C) * P * (I - L * C).transpose() + L * in(filter.noise.V) * L.transpose();
  TEST_ASSERT_TRUE((after - in(filter.P_posterior)).norm() < 1e-9 * P.norm());
  TEST_ASSERT_TRUE((C * P * C.transpose() + in(filter.noise.V) - in(filter.S)).norm() < 1e-9 * in(filter.S).norm());
  MatrixXd seen(nx + K.rows(), 2 * nx), direct = MatrixXd::Zero(nx + K.rows(), nw + ny);
  seen << I, MatrixXd::Zero(nx, nx), -K, K * (I - used * C);
  direct.bottomRightCorner(K.rows(), ny) = -K * used;
  const MatrixXd outputs = seen * S * seen.transpose() + direct * noise * direct.transpose();
  MatrixXd weight(nx + K.rows(), nx + K.rows());
  const SampledCost& cost = found.regulator->cost;
  weight << in(cost.Q), in(cost.N), in(cost.N).transpose(), in(cost.R);
  expect_near((weight * outputs).trace(), *found.loop.cost_per_sample, "cost", 1e-9);
  for (Index i = 0; i < nx; ++i)
    expect_near(std::sqrt(outputs(i, i)), found.loop.rms->x[static_cast<std::size_t>(i)], "rms", 1e-5);
}

void test_errors_cost_and_rms_are_those_of_the_noise_itself() {
  for (const Form form : {Form::filter, Form::predictor})
    for (const double delay : {0.0, 0.01, 0.125, 0.3}) {
      Problem problem = with_recovery(oscillator(), 0.5);
      problem.estimator->form = form;
      problem.plant.delay = delay;
      expect_errors_and_cost_of_the_loop(problem);
      problem.estimator->Swv = MatrixXd::Constant(1, 1, 0.01);
      expect_errors_and_cost_of_the_loop(problem);
    }
}

void test_recovery_of_0_is_the_filter_without() {
  const Solution without = solved(oscillator()), zero = solved(with_recovery(oscillator(), 0));
  expect_rounded(without.estimator->L, zero.estimator->L, "L");
  expect_rounded(without.estimator->P_prior, zero.estimator->P_prior, "P_prior");
  expect_rounded(without.estimator->P_posterior, zero.estimator->P_posterior, "P_posterior");
  expect_rounded(without.estimator->S, zero.estimator->S, "S");
  expect_near(*without.loop.cost_per_sample, *zero.loop.cost_per_sample, "cost", rounding);
  TEST_ASSERT_FALSE(without.loop.recovery.has_value());
}

// As a density q makes of the filter at every sample time what the continuous equation says.
void test_q_means_the_same_at_every_sample_time() {
  for (const double T : {0.01, 0.0025}) {
    Problem problem = with_recovery(oscillator(), 0.5);
    problem.plant.sample_time = T;
    const EstimatorSolution filter = *solved(problem).estimator;
    for (int i = 0; i < 2; ++i)
      expect_near(to_double(filter.L_continuous(i, 0)), to_double(filter.L_predictor(i, 0)) / T, "L/T", 12 * T);
    TEST_ASSERT_EQUAL(0, filter.P_continuous.size());  // the continuous equation's is not that of the error
  }
}

void test_sampled_noise_is_recovered_like_continuous_noise() {
  Problem problem = with_recovery(oscillator(), 1e4);  // beside which its own noise is nothing
  const Solution continuous = solved(problem);
  problem.estimator->noise = Noise::discrete;
  problem.estimator->V /= problem.plant.sample_time;
  const Solution discrete = solved(problem);
  for (int i = 0; i < 2; ++i)
    expect_near(to_double(continuous.estimator->L(i, 0)), to_double(discrete.estimator->L(i, 0)), "L", 1e-4);
}

void test_noise_at_the_inputs_does_what_noise_is_missing_for() {
  Problem problem = doyle();
  problem.plant.A << 0, 1, 0, 0;
  problem.estimator->W.setZero();
  Findings findings;
  TEST_ASSERT_FALSE(solve(problem, findings).has_value());  // on the limit, and driven by nothing
  const Solution found = solved(with_recovery(problem, 1));
  TEST_ASSERT_FALSE(found.loop.recovery->points.front().at_input.disk.has_value());
  expect_small(abs(found.estimator->P_prior(0, 0)), 1e3, "P");
}

std::size_t point_of(const RecoveryReport& report, double q) {
  for (std::size_t i = 0; i < report.points.size(); ++i)
    if (report.points[i].q == q) return i;
  TEST_FAIL_MESSAGE("the table has no such q");
  return 0;
}

void expect_loops_in_the_table(const Problem& problem) {
  const Solution found = solved(with_recovery(problem, 0.5));
  const RecoveryReport& report = *found.loop.recovery;
  TEST_ASSERT_EQUAL(6, report.points.size());
  for (const double q : {0.0, 0.005, 0.05, 0.5, 5.0, 50.0}) {
    const RecoveryPoint& point = report.points[point_of(report, q)];
    const LoopSolution loop = solved(with_recovery(problem, q)).loop;
    expect_near(*loop.at_input.disk, *point.at_input.disk, "disk margin", 1e-5);
    expect_near(*loop.at_input.phase_deg, *point.at_input.phase_deg, "phase margin", 1e-5);
    expect_near(*loop.cost_per_sample, *point.cost_per_sample, "cost", rounding);
  }
}

void test_table_has_the_loops_that_its_q_make() { expect_loops_in_the_table(oscillator()); }

// A disturbance is in the filter, but not in the plant that the loop is opened at: a pole at 1 that no input moves.
void test_table_of_a_loop_with_a_disturbance() {
  Problem problem = oscillator();
  problem.estimator->disturbance = {{0, 0.1}};
  expect_loops_in_the_table(problem);
}

// One step of two digits less is not enough.
void expect_smallest(const Problem& problem, double q, double one_less) {
  Findings findings;
  const std::optional<Solution> found = solve(with_auto(problem), findings);
  TEST_ASSERT_TRUE(found.has_value());
  TEST_ASSERT_EQUAL_DOUBLE(q, found->loop.recovery->q);
  TEST_ASSERT_EQUAL_STRING("kalman.recovery", findings.front().key.c_str());
  TEST_ASSERT_TRUE(findings.front().message.find("the smallest q") == 0);
  const Solution as_number = solved(with_recovery(problem, q));
  expect_rounded(as_number.estimator->L, found->estimator->L, "L");
  Findings missed;
  TEST_ASSERT_FALSE(solve(with_recovery(problem, one_less), missed).has_value());
  TEST_ASSERT_TRUE(missed.front().key.rfind("require.", 0) == 0);
}

void test_auto_finds_the_smallest_q_of_two_digits() {
  Problem problem = doyle();
  problem.requirements.disk_margin = 0.438;  // 3.87 dB
  expect_smallest(problem, 11000, 10000);
  problem.requirements = {};
  problem.requirements.phase_margin_deg = 30;
  problem.requirements.gain_margin_dB = 4;
  expect_smallest(problem, 13000, 12000);
}

void test_auto_is_0_where_nothing_is_missing() {
  Problem problem = oscillator();
  problem.requirements.disk_margin = 0.5;
  Findings findings;
  const std::optional<Solution> found = solve(with_auto(problem), findings);
  TEST_ASSERT_TRUE(found.has_value());
  TEST_ASSERT_EQUAL_DOUBLE(0, found->loop.recovery->q);
  TEST_ASSERT_EQUAL_STRING("[require] is met without it: q = 0", findings.front().message.c_str());
  expect_rounded(solved(oscillator()).estimator->L, found->estimator->L, "L");
}

void expect_refused(const Problem& problem, const std::string& words) {
  Findings findings;
  TEST_ASSERT_FALSE(solve(problem, findings).has_value());
  TEST_ASSERT_EQUAL(1, findings.size());
  const std::string found = findings[0].key + ": " + findings[0].message;
  TEST_ASSERT_TRUE_MESSAGE(found.find(words) != std::string::npos, found.c_str());
}

// A zero at s = 1/2, right of the bandwidth that is asked for.
Problem of_no_use() {
  Problem problem = oscillator();
  problem.plant.C << -0.5, 1;
  problem.regulator->R << 1e-3;
  return problem;
}

void test_auto_that_no_q_satisfies_tells_the_best_and_its_cost() {
  Problem problem = doyle();
  problem.requirements.phase_margin_deg = 88;
  expect_refused(with_auto(problem), "kalman.recovery: no q meets [require]; the best is ");
  expect_refused(with_auto(problem), " times the cost); require.phase_margin_deg requires at least 88°, the loop has ");
  problem = of_no_use();
  problem.requirements.disk_margin = 1;
  expect_refused(with_auto(problem),
                 "no q meets [require], and none comes nearer than 0; require.disk_margin requires");
}

void test_what_has_no_meaning_is_refused_with_its_reason() {
  Problem problem = with_recovery(oscillator(), 1);
  problem.regulator.reset();
  expect_refused(problem, "kalman.recovery: needs [lqr] or [pole_placement]: without a regulator there is no loop");
  problem = with_recovery(oscillator(), 1);
  problem.estimator->gain = Gain::online;
  expect_refused(problem, "kalman.recovery: needs gain = \"steady\" or \"schedule\"");
  problem = with_recovery(oscillator(), 1);
  problem.estimator->structure = MatrixXd::Constant(2, 1, 1);
  expect_refused(problem, "kalman.recovery: expected this or kalman.structure");
  expect_refused(with_auto(oscillator()), "kalman.recovery: \"auto\" needs a margin or max_pole in [require]");
  for (const double q : {-1.0, double(INFINITY), double(NAN)})
    expect_refused(with_recovery(oscillator(), q), "kalman.recovery: expected a number ≥ 0 or \"auto\", found ");
}

std::string note_of(const Problem& problem) {
  Findings findings;
  TEST_ASSERT_TRUE(solve(problem, findings).has_value());
  std::string all;
  for (const Finding& finding : findings)
    if (finding.key == "kalman.recovery") all += finding.message;
  return all;
}

void test_what_costs_more_than_double_is_told() {
  const std::string note = note_of(with_recovery(doyle(), 11000));
  TEST_ASSERT_TRUE_MESSAGE(note.find("this is expensive: disk margin 0.00995 → 0.44") == 0, note.c_str());
  TEST_ASSERT_TRUE_MESSAGE(note.find("for 10.46 times the cost") != note.npos, note.c_str());
}

void test_recovery_of_no_use_is_told() {
  const std::string note = note_of(with_recovery(of_no_use(), 1e3));
  TEST_ASSERT_TRUE_MESSAGE(note.find("the disk margin is not larger than without it") != note.npos, note.c_str());
}

void test_placed_poles_are_recovered_without_a_cost() {
  Problem problem = with_recovery(oscillator(), 0.5);
  problem.regulator->poles = WantedPoles{{{-4, 4}, {-4, -4}}, true};
  problem.regulator->cost = Cost::discrete;
  const Solution found = solved(problem);
  expect_rounded(solved(with_recovery(oscillator(), 0.5)).estimator->L, found.estimator->L, "L");
  TEST_ASSERT_FALSE(found.loop.recovery->points.front().cost_per_sample.has_value());
  TEST_ASSERT_TRUE(found.loop.recovery->points.front().at_input.disk.has_value());
}

// Each gain of the table is that of W and the fictitious noise, its error that of W alone.
void test_gains_of_a_schedule_are_recovered_from_the_start_on() {
  Problem problem = with_recovery(oscillator(), 0.5);
  problem.estimator->P0 = Eigen::Vector2d(0.25, 1).asDiagonal();
  problem.estimator->gain = Gain::schedule;
  problem.estimator->horizon = 7;
  const Solution found = solved(problem);
  const Digits scope(60);
  const RealMatrix &A = found.plant.A, &C = found.plant.C, V = found.estimator->noise.V;
  const RealMatrix W = congruence(found.plant.G, found.estimator->noise.W);
  RealMatrix P = real(problem.estimator->P0), error = P;
  for (std::size_t k = 0; k < 7; ++k) {
    const RealMatrix S = congruence(C, P) + V, L = solve(S, multiply(C, P))->transpose();
    expect_rounded(L, found.estimator->L_schedule[k], "L of the schedule");
    if (k == 6) expect_rounded(error, found.estimator->P_prior, "P_prior");
    const RealMatrix kept = identity(2) - multiply(L, C);
    P = congruence(A, P - congruence(L, S)) + W + found.estimator->fictitious;
    error = congruence(A, congruence(kept, error) + congruence(L, V)) + W;
  }
}

// B of the last stage is where the noise is in the end.
void test_fictitious_noise_follows_the_stages() {
  Problem last = with_recovery(oscillator(), 0.5);
  Problem problem = last;
  problem.estimator->gain = Gain::schedule;
  Stage stage;
  stage.from = 5;
  stage.B = Eigen::Vector2d(1, 1);
  problem.stages = {stage};
  last.plant.B = stage.B;
  const Solution found = solved(problem);
  expect_rounded(solved(last).estimator->L, found.estimator->L, "L");
  expect_rounded(solved(last).estimator->P_prior, found.estimator->P_prior, "P_prior");
}

void test_first_look_finds_what_the_design_finds() {
  Problem problem = doyle();
  problem.requirements.disk_margin = 0.438;
  const std::optional<Solution> first = first_look(without_requirements(with_auto(problem)));
  TEST_ASSERT_TRUE(first.has_value());
  expect_near(to_double(solved(with_recovery(problem, 11000)).estimator->L(1, 0)), to_double(first->estimator->L(1, 0)),
              "L", rounding);
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_doyles_example_has_the_margins_and_the_cost_of_the_reference);
  RUN_TEST(test_oscillator_has_the_gains_and_errors_of_the_reference);
  RUN_TEST(test_gain_is_that_of_noise_at_the_inputs_written_by_hand);
  RUN_TEST(test_errors_cost_and_rms_are_those_of_the_noise_itself);
  RUN_TEST(test_recovery_of_0_is_the_filter_without);
  RUN_TEST(test_q_means_the_same_at_every_sample_time);
  RUN_TEST(test_sampled_noise_is_recovered_like_continuous_noise);
  RUN_TEST(test_noise_at_the_inputs_does_what_noise_is_missing_for);
  RUN_TEST(test_table_has_the_loops_that_its_q_make);
  RUN_TEST(test_table_of_a_loop_with_a_disturbance);
  RUN_TEST(test_auto_finds_the_smallest_q_of_two_digits);
  RUN_TEST(test_auto_is_0_where_nothing_is_missing);
  RUN_TEST(test_auto_that_no_q_satisfies_tells_the_best_and_its_cost);
  RUN_TEST(test_what_has_no_meaning_is_refused_with_its_reason);
  RUN_TEST(test_what_costs_more_than_double_is_told);
  RUN_TEST(test_recovery_of_no_use_is_told);
  RUN_TEST(test_placed_poles_are_recovered_without_a_cost);
  RUN_TEST(test_gains_of_a_schedule_are_recovered_from_the_start_on);
  RUN_TEST(test_fictitious_noise_follows_the_stages);
  RUN_TEST(test_first_look_finds_what_the_design_finds);
  return UNITY_END();
}
