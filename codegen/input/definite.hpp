// SPDX-License-Identifier: MIT
// Symmetry and definiteness of weights and covariances.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

namespace lqg::input {

// Up to here an asymmetry is rounding of typed numbers: relative to the two entries and to √|q_ii q_jj|.
constexpr double symmetry_tolerance = 1e-9;

// With a unit diagonal: down to here a negative eigenvalue is such rounding too …
constexpr double semidefinite_tolerance = 1e-9;

// … and up to here, per row, a positive one is what the eigenvalue computation makes of 0.
constexpr double definite_margin = 1e-14;

struct Asymmetry {
  int row = 0, column = 0;  // row < column
  double size = 0;          // relative; 0: symmetric to the last bit
};

// Where the square matrix Q differs most from its transpose.
Asymmetry worst_asymmetry(const Eigen::MatrixXd& Q);

// (Q + Qᵀ)/2
Eigen::MatrixXd symmetrised(const Eigen::MatrixXd& Q);

// Says what keeps the symmetric matrix Q from being positive semidefinite, or with `strictly` positive
// definite:
// "[1][1] = -0.1", "the eigenvalue -0.1". Judged after scaling to a unit diagonal: rows and columns may have
// any units.
std::optional<std::string> indefinite(const Eigen::MatrixXd& Q, bool strictly);

// [Q N; Nᵀ R]
Eigen::MatrixXd joint(const Eigen::MatrixXd& Q, const Eigen::MatrixXd& N, const Eigen::MatrixXd& R);

}  // namespace lqg::input
