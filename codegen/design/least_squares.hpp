// SPDX-License-Identifier: MIT
// Batch weighted least squares: the estimate that the library's recursive least squares come to.
#pragma once

#include <optional>

#include "design/finding.hpp"
#include "design/real.hpp"

namespace lqg::design {

// x̂ = (CᵀV⁻¹C)⁻¹CᵀV⁻¹y and its covariance P = (CᵀV⁻¹C)⁻¹.
struct LeastSquares {
  RealVector x;         // nx
  RealMatrix P;         // nx × nx
  unsigned digits = 0;  // in force when Ziv's test settled: every number rounds correctly
};

// For y = C x + v, E[v vᵀ] = V: C ny × nx, V ny × ny symmetric positive definite, y ny. The best linear unbiased
// estimate (C. F. Gauss, "Theoria combinationis observationum erroribus minimis obnoxiae", 1823; A. C. Aitken,
// Proceedings of the Royal Society of Edinburgh 55 (1936), 42–48). Empty, with an error under "C", "V" or "y": shapes,
// V not positive definite, columns of C that depend on one another (exactly: the unknowns in them are named), or so
// nearly that 400 digits do not settle it.
std::optional<LeastSquares> least_squares(const Eigen::MatrixXd& C, const Eigen::MatrixXd& V, const Eigen::VectorXd& y,
                                          Findings& findings);

}  // namespace lqg::design
