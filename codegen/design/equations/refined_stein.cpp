// SPDX-License-Identifier: MIT
#include "design/equations/refined_stein.hpp"

#include "design/equations/riccati.hpp"
#include "design/progress.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

// Smith's doubling in double; empty when the powers of A do not vanish.
std::optional<Eigen::MatrixXd> rough_stein(Eigen::MatrixXd power, Eigen::MatrixXd X) {
  const int most_doublings = 60;
  for (int k = 0; k < most_doublings; ++k) {
    const Eigen::MatrixXd moved = X * power;
    X += power.transpose() * moved;
    power = (power * power).eval();
    if (!power.allFinite()) return std::nullopt;
    if (power.cwiseAbs().maxCoeff() < 1e-20) return X;
  }
  return std::nullopt;
}

}  // namespace

std::optional<RealMatrix> refined_stein(const RealMatrix& A, const RealMatrix& Y) {
  const Eigen::MatrixXd rough_A = to_doubles(A);
  const int most_corrections = 100;
  RealMatrix X = zeros(Y.rows(), Y.cols()), residual = Y;
  Real size = largest_entry(residual);
  for (int k = 0; k < most_corrections; ++k) {
    report_progress("Stein equation, refinement", k);
    if (size <= negligible(0.9) * largest_entry(X)) return X;
    const std::optional<Eigen::MatrixXd> correction = rough_stein(rough_A, to_doubles(residual / size));
    if (!correction || !correction->allFinite()) break;
    X += size * symmetric_part(real(*correction));
    residual = Y + transpose_congruence(A, X) - X;
    const Real before = size;
    size = largest_entry(residual);
    if (!(size < before / 4)) break;
  }
  return solve_stein(A, Y);
}

}  // namespace lqg::design
