// SPDX-License-Identifier: MIT
// Problems to design for: named ones and random ones, the same on every machine.
#pragma once

#include <cstdint>

#include "design/equations/riccati.hpp"
#include "design/limits/limited_rows.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/solution.hpp"
#include "design/solve.hpp"

namespace design_test {

using lqg::design::Problem;
using lqg::design::Real;
using lqg::design::RealMatrix;

// Numbers from a seed (xorshift64*, S. Vigna), the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 2654435769u + 1) {}
  double uniform();  // in [−1, 1)
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns);
  Eigen::MatrixXd semidefinite(Eigen::Index size, Eigen::Index rank);

 private:
  std::uint64_t state_;
};

// A plant with regulator and estimator whose fields hold the defaults of the design file and unit weights.
Problem problem_of(lqg::design::Domain domain, double sample_time, const Eigen::MatrixXd& A, const Eigen::MatrixXd& B,
                   const Eigen::MatrixXd& C);

Problem regulator_alone(Problem problem);

// Of inputs, which are clipped.
lqg::design::Limits limits_of_size(const Eigen::VectorXd& u_min, const Eigen::VectorXd& u_max);

// The law that solves `equation`, which foresees `blocks`: no limits yet.
lqg::design::LimitedProblem foreseeing_law(const lqg::design::RiccatiEquation& equation,
                                           const std::vector<int>& blocks);

// ẍ = u, the position is measured.
Problem double_integrator(double sample_time);

// Two masses with spring and damper: k = 0.1, b = 0.004, M = 1, m = 0.2, dt = 0.5, the example of Scilab's
// help page `lqe`.
Problem two_mass();

// `masses` of them in a chain, driven at one end, seen at both: 2 masses states.
Problem chain_of_masses(int masses);

// A random problem of either domain with cross terms, correlated noise and D.
Problem random_problem(std::uint64_t seed);

// Solved, or the test fails with the first finding.
lqg::design::Solution solved(const Problem& problem);

// random_problem(seed), solved once.
const lqg::design::Solution& solved_random_problem(std::uint64_t seed);

// The largest |a − b| beside the largest |b|, in the digits in force.
Real distance(const RealMatrix& a, const RealMatrix& b);

// Fails unless every entry of `found` rounds to the double that `expected` rounds to.
void expect_rounded(const RealMatrix& expected, const RealMatrix& found, const char* name);

// Fails unless value ≤ bound.
void expect_small(const Real& value, double bound, const char* what);

}  // namespace design_test
