// SPDX-License-Identifier: MIT
// A matrix of the file, whose entries may be more exact than doubles.
//
// An entry that is written as a number is the double that it reads as. One that a formula gives, or the linearisation
// of equations, is a number of many digits; the double is what rounding leaves of it. `real` of such a matrix has all
// digits, so that the design rounds once, at its end.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <type_traits>
#include <utility>

#include "design/real.hpp"

namespace lqg::design {

// Digits of what is kept: more than any run of the design has.
constexpr unsigned exact_digits = 450;

class ExactMatrix : public Eigen::MatrixXd {
 public:
  ExactMatrix() = default;
  template <class Derived>
  ExactMatrix(const Eigen::EigenBase<Derived>& doubles) : Eigen::MatrixXd(doubles.derived()) {}
  template <class Derived>
  ExactMatrix& operator=(const Eigen::EigenBase<Derived>& doubles) {
    exact_.reset();
    Eigen::MatrixXd::operator=(doubles.derived());
    return *this;
  }
  // Rounded, and kept with its digits where these say more.
  static ExactMatrix of(const RealMatrix& exact);

  // Or nullptr: the doubles are all there is.
  const RealMatrix* exact() const { return exact_.get(); }

 private:
  std::shared_ptr<const RealMatrix> exact_;
};

// In the digits in force. An entry that was changed since, in place, is its double.
RealMatrix all_digits(const ExactMatrix& a);

// Only of an ExactMatrix itself, not of what could become one.
template <class Matrix, class = std::enable_if_t<std::is_same_v<Matrix, ExactMatrix>>>
RealMatrix real(const Matrix& a) {
  return all_digits(a);
}

}  // namespace lqg::design
