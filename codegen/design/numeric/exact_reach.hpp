// SPDX-License-Identifier: MIT
// How much of the state space an input reaches, exactly.
#pragma once

#include <Eigen/Core>

namespace lqg::design {

// The rank of [B, AB, A²B, …], exactly: a double is an integer times a power of two, so that the rank can be
// taken modulo a prime. Modulo 2⁶¹ − 1 it is never more than the true rank, and less for one matrix in some
// 10¹⁷.
Eigen::Index reached_dimension(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace lqg::design
