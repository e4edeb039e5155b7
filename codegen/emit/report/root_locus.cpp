// SPDX-License-Identifier: MIT
// The symmetric root locus: the regulator's poles as the weights on the inputs are scaled.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "design/loop/compensator.hpp"
#include "design/sampled/added_states.hpp"
#include "design/sampled/augmentation.hpp"
#include "emit/report/sections.hpp"

namespace lqg::emit {

namespace {

using Eigen::MatrixXd;

// z⁺ = A z + B v, with the cost over z and v; R is what ρ scales.
struct Regulated {
  MatrixXd A, B, Q, R, N;
};

std::optional<Regulated> regulated(const Controller& controller) {
  const design::Problem& problem = controller.problem;
  constexpr Eigen::Index most_states = 40;
  if (!controller.solution.regulator || !design::has_cost(problem.regulator)) return std::nullopt;
  const bool is_steady = problem.regulator->horizon == 0 && problem.stages.empty() && !problem.regulator->decay &&
                         !problem.regulator->settling_time && problem.regulator->structure.size() == 0;
  if (controller.solution.compensator || controller.solution.white) return std::nullopt;
  if (!is_steady || problem.regulator->cost == design::Cost::continuous) return std::nullopt;
  const design::Digits digits(50);
  const design::RegulatedPlant plant =
      design::regulated_plant(problem, design::without_added_states(problem, controller.solution.plant));
  const design::SampledCost cost =
      design::regulated_cost(problem, design::without_added_states(problem, controller.solution.regulator->cost));
  if (plant.A.rows() > most_states) return std::nullopt;
  return Regulated{in_double(plant.A), in_double(plant.B), in_double(cost.Q), in_double(cost.R), in_double(cost.N)};
}

// Eigenvalues inside of the unit circle of the pencil of the Riccati equation with (Q, ρR, N):
//   [A'  0 ]     [I  B R⁻¹Bᵀ/ρ]
//   [−Q' I ] − λ [0  A'ᵀ      ],   A' = A − B R⁻¹Nᵀ/ρ,  Q' = Q − N R⁻¹Nᵀ/ρ
// (T. Pappas, A. J. Laub, N. R. Sandell, IEEE Transactions on Automatic Control 25, 1980). Empty where there are not
// as many as states.
design::Poles poles_with(const Regulated& plant, double rho) {
  const Eigen::Index n = plant.A.rows();
  const MatrixXd inverse = (rho * plant.R).inverse();
  const MatrixXd A = plant.A - plant.B * inverse * plant.N.transpose();
  const MatrixXd Q = plant.Q - plant.N * inverse * plant.N.transpose();
  MatrixXd left = MatrixXd::Identity(2 * n, 2 * n), right = left;
  left.topLeftCorner(n, n) = A;
  left.bottomLeftCorner(n, n) = -Q;
  right.topRightCorner(n, n) = plant.B * inverse * plant.B.transpose();
  right.bottomRightCorner(n, n) = A.transpose();
  const Eigen::GeneralizedEigenSolver<MatrixXd> solver(left, right, false);
  if (solver.info() != Eigen::Success) return {};
  design::Poles inside;
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const double beta = solver.betas()(i);
    if (std::abs(solver.alphas()(i)) < std::abs(beta)) inside.push_back(solver.alphas()(i) / beta);
  }
  return inside.size() == static_cast<std::size_t>(n) ? inside : design::Poles();
}

Curve chosen_poles(const design::Poles& poles) {
  Curve curve = {"ρ = 1, as designed", Mark::crosses, 0, {}, {}};
  for (const std::complex<double>& pole : poles) {
    curve.x.push_back(pole.real());
    curve.y.push_back(pole.imag());
  }
  return curve;
}

// What is cheap in blue-green, what is dear in orange: poles of ρ < 1 and of ρ > 1.
std::vector<Curve> branches(const Regulated& plant) {
  constexpr int steps = 24;  // a decade has eight of them on either side
  Curve cheap = {"ρ from 0.001 to 1, faster", Mark::dots, 2, {}, {}};
  Curve dear = {"ρ from 1 to 1000, slower", Mark::dots, 4, {}, {}};
  for (int k = -steps; k <= steps; ++k) {
    const double rho = std::pow(10, 3.0 * k / steps);
    Curve& curve = k < 0 ? cheap : dear;
    for (const std::complex<double>& pole : poles_with(plant, rho)) {
      curve.x.push_back(pole.real());
      curve.y.push_back(pole.imag());
      curve.texts.push_back("ρ = " + decimal(rho));
    }
  }
  return {cheap, dear};
}

// All that the branches and the chosen poles need, at least a twentieth of the circle.
void fit(Chart& chart) {
  double low = INFINITY, high = -INFINITY, side = 0.025;
  for (const Curve& curve : chart.curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i) {
      low = std::min(low, curve.x[i]);
      high = std::max(high, curve.x[i]);
      side = std::max(side, std::abs(curve.y[i]));
    }
  const double half = 1.1 * std::max((high - low) / 2, side), middle = (low + high) / 2;
  chart.x_low = middle - half, chart.x_high = middle + half;
  chart.y_low = -half, chart.y_high = half;
}

}  // namespace

std::vector<Chart> root_locus(const Controller& controller) {
  const std::optional<Regulated> plant = regulated(controller);
  if (!plant || plant->R.rows() == 0 || poles_with(*plant, 1).empty()) return {};
  Chart chart;
  chart.title = "Regulator's poles with ρ R in place of R";
  chart.id = "root-locus";
  chart.is_square = true;
  chart.x.label = "Re z";
  chart.y.label = "Im z";
  chart.circles.push_back({0, 0, 1});
  chart.curves = branches(*plant);
  chart.curves.push_back(chosen_poles(controller.solution.regulator->poles));
  fit(chart);
  return {chart};
}

}  // namespace lqg::emit
