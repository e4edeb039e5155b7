// SPDX-License-Identifier: MIT
// The response of a discrete system on the unit circle.
#pragma once

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

struct ComplexMatrix {
  RealMatrix re, im;
};

// T(z) = C (zI − A)⁻¹ B, made in the digits in force, in the way that takes fewer complex multiply-adds a point:
//   A in Hessenberg form: nx² of them
//   chains of delays folded, A and C polynomials in 1/z over the k states that are more than a delay: k³/3 of them
class Response {
 public:
  Response(RealMatrix A, RealMatrix B, RealMatrix C);

  // The same, to be evaluated in the digits in force now.
  Response in_present_digits() const;

  // Of B's and C's it has that of input and output i alone: a response of one number.
  Response channel(Index i) const;

  // At z = e^(j angle) in many digits, and in double: some fifty times faster.
  ComplexMatrix at(const Real& angle) const;
  Eigen::MatrixXcd roughly_at(const Real& angle) const;

  // An entry of a coefficient of z^−ago, ago > 0.
  template <typename Scalar>
  struct Late {
    Index row, column, ago;
    Scalar value;
  };

  // zI − A − A_late(z), B, and C + C_late(z). Below the diagonal A has `below` diagonals.
  template <typename Scalar>
  struct Terms {
    using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    Matrix A, B, C;
    std::vector<Late<Scalar>> A_late, C_late;
    Index below = 1;
  };

 private:
  Response(Terms<Real> exact, Terms<double> rough);

  Terms<Real> exact_;
  Terms<double> rough_;
};

}  // namespace lqg::design
