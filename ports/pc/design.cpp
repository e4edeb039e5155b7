// The design engine as a C++ library: a cart on a track is regulated over a finite and an infinite horizon, its state
// estimated, both put together, and each of them simulated with noise from a seed.
//
//   find_package(tinylqg REQUIRED COMPONENTS design)
//   target_link_libraries(<program> PRIVATE tinylqg::design)
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include <design/defaults.hpp>
#include <design/rounding.hpp>
#include <design/simulation.hpp>

using namespace lqg::design;

namespace {

// A cart of 1 kg that a force drives and whose position is measured: x = [position; speed], every 50 ms.
Problem cart() {
  Problem problem;
  problem.plant.sample_time = 0.05;
  problem.plant.A = (Eigen::MatrixXd(2, 2) << 0, 1, 0, -0.1).finished();
  problem.plant.B = Eigen::Vector2d(0, 1);
  problem.plant.C = Eigen::RowVector2d(1, 0);
  return problem;
}

Regulator regulator(int horizon) {
  Regulator lqr;
  lqr.Q = Eigen::Vector2d(10, 1).asDiagonal();
  lqr.R = Eigen::MatrixXd::Constant(1, 1, 0.1);
  lqr.horizon = horizon;
  return lqr;
}

// A random force on the cart, and a sensor of some centimetres.
Estimator estimator() {
  Estimator kalman;
  kalman.W = Eigen::Vector2d(0, 0.05).asDiagonal();
  kalman.V = Eigen::MatrixXd::Constant(1, 1, 5e-5);
  return kalman;
}

// The solution, or the reasons on standard error and the end.
Solution solved(const Problem& problem) {
  Findings findings;
  const std::optional<Solution> solution = solve(problem, findings);
  for (const Finding& finding : findings) std::cerr << finding.key << ": " << finding.message << "\n";
  if (!solution) std::exit(EXIT_FAILURE);
  return *solution;
}

void print(const char* name, const RealMatrix& a) {
  std::printf("  %s =", name);
  for (Eigen::Index i = 0; i < a.size(); ++i) std::printf(" %.6g", to_double(a.data()[i]));
  std::printf("\n");
}

// The last position, and how far the estimates were from the states.
void simulate(const Problem& problem, const Solution& solution) {
  SimulationOptions options;
  options.samples = 200;
  options.x0 = Eigen::Vector2d(1, 0);
  options.seed = 2026;
  const Trajectory run = simulate(problem, solution, options);
  const Eigen::MatrixXd error = run.estimate - run.x.leftCols(options.samples);
  std::printf("  after 10 s at %.3f m, estimates %.4f m off (rms)\n", run.x(0, options.samples),
              error.row(0).norm() / std::sqrt(options.samples));
}

}  // namespace

int main() {
  Problem problem = cart();
  problem.regulator = regulator(40);
  std::printf("LQR over 40 samples: the first gain and the last\n");
  Solution solution = solved(with_defaults(problem));
  print("K", solution.regulator->K_schedule.front());
  print("K", solution.regulator->K_schedule.back());
  simulate(with_defaults(problem), solution);

  problem.regulator = regulator(0);
  std::printf("LQR for ever\n");
  solution = solved(with_defaults(problem));
  print("K", solution.regulator->K);
  simulate(with_defaults(problem), solution);

  std::printf("Kalman filter\n");
  problem.regulator.reset();
  problem.estimator = estimator();
  solution = solved(with_defaults(problem));
  print("L", solution.estimator->L);
  simulate(with_defaults(problem), solution);

  std::printf("LQG\n");
  problem.regulator = regulator(0);
  solution = solved(with_defaults(problem));
  std::printf("  cost per second %.5g, phase margin %.1f°, disk margin %.2f\n", *solution.loop.cost_per_second,
              *solution.loop.at_input.phase_deg, *solution.loop.at_input.disk);
  simulate(with_defaults(problem), solution);
  return EXIT_SUCCESS;
}
