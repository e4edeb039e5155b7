// SPDX-License-Identifier: MIT
// A plant under inputs that are held, after any time, in double: the same bits on every host.
#pragma once

#include <Eigen/Core>

namespace lqg::simulate {

// The products of a row in ascending order: the same bits on every host.
Eigen::MatrixXd ordered_product(const Eigen::MatrixXd& M, const Eigen::MatrixXd& N);
Eigen::VectorXd ordered_image(const Eigen::MatrixXd& M, const Eigen::VectorXd& x);
double ordered_dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b);
// out += M x
void add_product(const Eigen::MatrixXd& M, const Eigen::VectorXd& x, Eigen::VectorXd& out);

// x(t) = A x(0) + B h of ẋ = A' x + B' h with h held.
struct Period {
  Eigen::MatrixXd A, B;
};

// After `time` seconds. By Taylor's series of a short time that is then doubled: good to a few units in the last place
// of the largest entries.
Period period_of(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, double time);

}  // namespace lqg::simulate
