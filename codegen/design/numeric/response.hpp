// The response of a discrete system on the unit circle.
#pragma once

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

struct ComplexMatrix {
  RealMatrix re, im;
};

// T(z) = C (zI − A)⁻¹ B through the Hessenberg form of A, made in the digits in force: nx² complex
// multiply-adds a point.
class Response {
 public:
  Response(RealMatrix A, RealMatrix B, RealMatrix C);

  // The same, to be evaluated in the digits in force now.
  Response in_present_digits() const;

  // At z = e^(j angle) in many digits, and in double: some fifty times faster.
  ComplexMatrix at(const Real& angle) const;
  ComplexMatrix roughly_at(const Real& angle) const;

 private:
  RealMatrix A_, B_, C_;
  Eigen::MatrixXd rough_A_, rough_B_, rough_C_;
};

}  // namespace lqg::design
