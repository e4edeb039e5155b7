// SPDX-License-Identifier: MIT
// How often the set of active limits changes, at most, until the target's solver has the optimum: a proof over a box of
// states. codegen/design/README.md has the method.
#pragma once

#include <functional>

#include "design/limits/limited_rows.hpp"
#include "design/problem.hpp"

namespace lqg::design {

// What lqg_mpc_limit gets, in the target's numbers.
struct LimitNumbers {
  Eigen::MatrixXd law;  // nu × nx, u of the law is law x: −K, where x is all that u and the rows depend on
  Eigen::MatrixXd F, G;
  Eigen::VectorXd scale, low, high, tolerance;
  Eigen::VectorXd u_step;  // nu, or empty
  Scalar real = Scalar::float64;
};

// Rounded as they are emitted. Reads what a precision of its own has.
LimitNumbers limit_numbers(const RealMatrix& law, const LimitedRows& rows, const RealVector& u_step, Scalar real);

// Finite, low ≤ high. u[k−1] where u_step is there; else empty.
struct CertifiedBox {
  Eigen::VectorXd low, high;
  Eigen::VectorXd u_low, u_high;
};

struct CertificateEffort {
  // 0: a proof for every state. > 0: states are left out that are nearer than this, as a share of the box's half width,
  // to a plane on which two decisions of the solver tie; 1e-9 leaves out about a billionth of the box a plane.
  double tie_distance = 0;
  long pieces = 1000000;             // of the box, at most: with the same number comes the same result
  std::function<bool()> is_time_up;  // asked at each piece; may be empty. Then the result may differ from run to run
};

enum class ProofGap {
  none,
  effort,    // pieces or time came to their end
  rounding,  // too near to singular, or to a tie, for the target's precision: a set of limits might come twice
};

struct CertifiedChanges {
  int changes = 0;  // proved: enough for `iterations`. Else: the most that were met, and no proof
  ProofGap gap = ProofGap::none;
  long pieces = 0;
  bool is_proved() const { return gap == ProofGap::none; }
};

// Calls report_progress at each thousandth piece.
CertifiedChanges certify_changes(const LimitNumbers& numbers, const CertifiedBox& box, const CertificateEffort& effort);

}  // namespace lqg::design
