// SPDX-License-Identifier: MIT
#include "textbook.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace lqg_test {

namespace {

using Number = Textbook::Number;

Matrix<Number> long_numbers(const Matrix<double>& matrix) { return matrix.cast<Number>(); }

// P of the factors or the triangle, exact but for the last digits.
Matrix<Number> initial_covariance(const Model<double>& model) {
  const int nx = model.nx;
  Matrix<Number> P(nx, nx), U = Matrix<Number>::Identity(nx, nx), D = Matrix<Number>::Zero(nx, nx);
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j <= i; ++j) {
      if (model.filter == Filter::plain)
        P(i, j) = P(j, i) = model.P0[static_cast<std::size_t>(lqg::step::triangle(i, j))];
      else if (j < i)
        U(j, i) = model.U0[static_cast<std::size_t>(lqg::step::strict_triangle(j, i))];
      else
        D(i, i) = model.D0[static_cast<std::size_t>(i)];
    }
  return model.filter == Filter::plain ? P : Matrix<Number>(U * D * U.transpose());
}

}  // namespace

Textbook::Textbook(const Model<double>& model)
    : A_(long_numbers(model.A)), B_(long_numbers(model.B)), P_(initial_covariance(model)), x_(model.x0.cast<Number>()) {
  const Matrix<Number> E_inverse = long_numbers(model.E).inverse();
  const Matrix<Number> V = model.V.cast<Number>().asDiagonal();
  C_ = E_inverse * long_numbers(model.C);
  D_ = model.D.cols() ? Matrix<Number>(E_inverse * long_numbers(model.D)) : Matrix<Number>::Zero(model.ny, model.nu);
  V_ = E_inverse * V * E_inverse.transpose();
  W_ = long_numbers(model.W);
  Swv_ = Matrix<Number>::Zero(model.nx, model.ny);
  if (!model.M.cols()) return;
  const Matrix<Number> M = long_numbers(model.M);
  W_ += M * V * M.transpose();
  Swv_ = M * V * E_inverse.transpose();
}

Vector<Number> Textbook::output(const Vector<Number>& x, const Vector<Number>& u) const { return C_ * x + D_ * u; }

void Textbook::update(const Vector<Number>& y, const Vector<Number>& u_applied) {
  x_prior_ = x_;
  P_prior_ = P_;
  const Matrix<Number> S = C_ * P_ * C_.transpose() + V_;
  const Vector<double> scales = S.cast<double>().selfadjointView<Eigen::Lower>().eigenvalues();
  worst_condition_ = std::max(worst_condition_, scales.maxCoeff() / scales.minCoeff());
  S_inverse_ = S.inverse();
  innovation_ = y - output(x_, u_applied);
  x_ += L() * innovation_;
  P_ -= L() * C_ * P_prior_;
}

void Textbook::predict(const Vector<Number>& u) {
  const Matrix<Number> gain = (A_ * P_prior_ * C_.transpose() + Swv_) * S_inverse_;
  x_ = A_ * x_prior_ + B_ * u + gain * innovation_;
  P_ = A_ * P_prior_ * A_.transpose() + W_ - gain * (A_ * P_prior_ * C_.transpose() + Swv_).transpose();
  P_ = Matrix<Number>((P_ + P_.transpose()) / 2);  // asymmetric rounding errors would grow
}

}  // namespace lqg_test
