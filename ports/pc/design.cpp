// SPDX-License-Identifier: MIT
// The design engine as a C++ library: a cart on a track is regulated over a finite and over an infinite horizon, its
// state is estimated, then both together, and each of them is simulated with noise from a seed. What the long runs
// show has to be what the design says; the exit status is 0 if it is.
//
//   find_package(tinylqg REQUIRED COMPONENTS design)
//   target_link_libraries(<program> PRIVATE tinylqg::design)
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <design/defaults.hpp>
#include <design/rounding.hpp>
#include <design/solve.hpp>
#include <simulate/simulation.hpp>

namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using namespace lqg::design;

const int part = 1000, parts = 50;  // the samples that a mean is of, and such means
bool as_designed = true;

// A cart of 1 kg that a force drives and whose position is measured: x = [position; speed], every 50 ms.
Problem cart() {
  Problem problem;
  problem.plant.sample_time = 0.05;
  problem.plant.A = (MatrixXd(2, 2) << 0, 1, 0, -0.1).finished();
  problem.plant.B = Vector2d(0, 1);
  problem.plant.C = Eigen::RowVector2d(1, 0);
  return problem;
}

// horizon 0: for ever.
Regulator regulator(int horizon) {
  Regulator lqr;
  lqr.Q = Vector2d(10, 1).asDiagonal();
  lqr.R = MatrixXd::Constant(1, 1, 0.1);
  lqr.horizon = horizon;
  return lqr;
}

// A random force on the cart, and a sensor that is some centimetres off.
Estimator estimator() {
  Estimator kalman;
  kalman.W = Vector2d(0, 0.05).asDiagonal();
  kalman.V = MatrixXd::Constant(1, 1, 5e-5);
  return kalman;
}

// The solution, or the reasons on standard error and the end.
Solution solved(const Problem& problem) {
  Findings findings;
  const std::optional<Solution> solution = solve(problem, findings);
  for (const Finding& finding : findings)
    std::fprintf(stderr, "%s: %s\n", finding.key.c_str(), finding.message.c_str());
  if (!solution) std::exit(EXIT_FAILURE);
  return *solution;
}

Trajectory run(const Problem& problem, const Solution& solution, int samples) {
  SimulationOptions options;
  options.samples = samples;
  options.x0 = Vector2d(1, 0);
  options.seed = 2026;
  return simulate(problem, solution, options);
}

void print(const char* name, const RealMatrix& a) {
  std::printf("  %s =", name);
  for (Eigen::Index i = 0; i < a.size(); ++i) std::printf(" %.6g", to_double(a.data()[i]));
  std::printf("\n");
}

void expect(const char* what, double designed, double found, double bound) {
  const bool is_near = std::abs(found - designed) <= bound;
  std::printf("  %-24s %.6g by design, %.6g simulated%s\n", what, designed, found, is_near ? "" : "  (!)");
  if (!is_near) as_designed = false;
}

// The mean of the last parts × part values. The means of the parts are as good as independent, so that it has the
// standard error s/√parts: five of them are allowed.
void expect_mean(const char* what, double designed, const VectorXd& values) {
  const VectorXd late = values.tail(parts * part);
  const VectorXd means = Eigen::Map<const MatrixXd>(late.data(), part, parts).colwise().mean().transpose();
  const double mean = means.mean(), s = std::sqrt((means.array() - mean).square().sum() / (parts - 1));
  expect(what, designed, mean, 5 * s / std::sqrt(parts));
}

// J = x₀ᵀ X x₀; what is left of x at the end costs nothing.
void regulate(int horizon, int samples) {
  Problem problem = cart();
  problem.regulator = regulator(horizon);
  problem = with_defaults(problem);
  const Solution solution = solved(problem);
  const RegulatorSolution& lqr = *solution.regulator;
  if (horizon > 0) print("K of the first sample", lqr.K_schedule.front());
  print(horizon > 0 ? "K of the last sample" : "K", lqr.K);
  const double designed = to_double((horizon > 0 ? lqr.X0 : lqr.X)(0, 0));
  expect("cost from 1 m", designed, run(problem, solution, samples).cost.sum(), 1e-9 * designed);
}

void estimate() {
  Problem problem = cart();
  problem.estimator = estimator();
  problem = with_defaults(problem);
  const Solution solution = solved(problem);
  print("L", solution.estimator->L);
  const Trajectory trajectory = run(problem, solution, parts * part + 1000);
  const MatrixXd errors = trajectory.estimate - trajectory.x.leftCols(trajectory.estimate.cols());
  const RealMatrix& P = solution.estimator->P_posterior;
  expect_mean("variance of the position", to_double(P(0, 0)), errors.row(0).array().square().transpose());
  expect_mean("covariance", to_double(P(1, 0)), errors.colwise().prod().transpose());
  expect_mean("variance of the speed", to_double(P(1, 1)), errors.row(1).array().square().transpose());
}

void control() {
  Problem problem = cart();
  problem.regulator = regulator(0);
  problem.estimator = estimator();
  problem = with_defaults(problem);
  const Solution solution = solved(problem);
  const LoopSolution& loop = solution.loop;
  std::printf("  phase margin %.1f°, disk margin %.2f, cost per second %.4g\n", *loop.at_input.phase_deg,
              *loop.at_input.disk, *loop.cost_per_second);
  const Trajectory trajectory = run(problem, solution, parts * part + 1000);
  expect_mean("cost per sample", *loop.cost_per_sample, trajectory.cost);
}

}  // namespace

int main() {
  std::printf("LQR over 40 samples\n");
  regulate(40, 40);
  std::printf("LQR for ever\n");
  regulate(0, 1000);
  std::printf("Kalman filter\n");
  estimate();
  std::printf("LQG\n");
  control();
  return as_designed ? EXIT_SUCCESS : EXIT_FAILURE;
}
