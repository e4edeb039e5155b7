// SPDX-License-Identifier: MIT
#include "design/exact_matrix.hpp"

#include "design/numeric/linear_algebra.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

ExactMatrix ExactMatrix::of(const RealMatrix& exact) {
  ExactMatrix result(to_doubles(exact));
  const Digits scope(exact_digits);
  RealMatrix kept = in_present_digits(exact);
  if (kept != design::real(static_cast<const Eigen::MatrixXd&>(result)))
    result.exact_ = std::make_shared<const RealMatrix>(std::move(kept));
  return result;
}

RealMatrix all_digits(const ExactMatrix& a) {
  RealMatrix result = real(static_cast<const Eigen::MatrixXd&>(a));
  const RealMatrix* exact = a.exact();
  if (!exact || exact->rows() != a.rows() || exact->cols() != a.cols()) return result;
  for (Index i = 0; i < a.size(); ++i)
    if (to_double(exact->data()[i]) == a.data()[i])
      mpfr_set(result.data()[i].backend().data(), exact->data()[i].backend().data(), MPFR_RNDN);
  return result;
}

}  // namespace lqg::design
