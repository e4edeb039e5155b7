// SPDX-License-Identifier: MIT
#include "design/numeric/linear_algebra.hpp"

#include <cmath>

namespace lqg::design {

namespace {

// sum ← sum ± Σ a_k b_k. A product and a sum into a scratch number take 35 ns at 50 digits, mpfr_fma takes
// 56.
class Accumulator {
 public:
  void add(Real& sum, const Real* a, Index a_stride, const Real* b, Index b_stride, Index count) {
    for (Index k = 0; k < count; ++k)
      if (product(a[k * a_stride], b[k * b_stride])) {
        mpfr_ptr total = sum.backend().data();
        mpfr_add(total, total, scratch_.backend().data(), MPFR_RNDN);
      }
  }
  void subtract(Real& sum, const Real* a, Index a_stride, const Real* b, Index b_stride, Index count) {
    for (Index k = 0; k < count; ++k)
      if (product(a[k * a_stride], b[k * b_stride])) {
        mpfr_ptr total = sum.backend().data();
        mpfr_sub(total, total, scratch_.backend().data(), MPFR_RNDN);
      }
  }

 private:
  bool product(const Real& a, const Real& b) {
    mpfr_srcptr left = a.backend().data();
    mpfr_srcptr right = b.backend().data();
    if (mpfr_zero_p(left) || mpfr_zero_p(right)) return false;
    mpfr_mul(scratch_.backend().data(), left, right, MPFR_RNDN);
    return true;
  }
  Real scratch_;
};

// Copies the lower triangle onto the upper one.
void mirror(RealMatrix& a) {
  for (Index j = 0; j < a.cols(); ++j)
    for (Index i = 0; i < j; ++i) a(i, j) = a(j, i);
}

}  // namespace

RealMatrix real(const Eigen::MatrixXd& a) {
  RealMatrix result(a.rows(), a.cols());
  for (Index i = 0; i < a.size(); ++i) result.data()[i] = a.data()[i];
  return result;
}

RealMatrix zeros(Index rows, Index columns) { return RealMatrix::Constant(rows, columns, Real(0)); }

RealMatrix identity(Index size) {
  RealMatrix result = zeros(size, size);
  for (Index i = 0; i < size; ++i) result(i, i) = 1;
  return result;
}

RealMatrix in_present_digits(const RealMatrix& a) {
  RealMatrix result(a.rows(), a.cols());
  for (Index i = 0; i < a.size(); ++i)
    mpfr_set(result.data()[i].backend().data(), a.data()[i].backend().data(), MPFR_RNDN);
  return result;
}

RealMatrix multiply(const RealMatrix& a, const RealMatrix& b) {
  RealMatrix result = zeros(a.rows(), b.cols());
  if (a.cols() == 0) return result;
  Accumulator sum;
  for (Index j = 0; j < b.cols(); ++j)
    for (Index i = 0; i < a.rows(); ++i)
      sum.add(result(i, j), a.data() + i, a.rows(), b.data() + j * b.rows(), 1, a.cols());
  return result;
}

RealMatrix transpose_multiply(const RealMatrix& a, const RealMatrix& b) {
  RealMatrix result = zeros(a.cols(), b.cols());
  if (a.rows() == 0) return result;
  Accumulator sum;
  for (Index j = 0; j < b.cols(); ++j)
    for (Index i = 0; i < a.cols(); ++i)
      sum.add(result(i, j), a.data() + i * a.rows(), 1, b.data() + j * b.rows(), 1, a.rows());
  return result;
}

RealMatrix multiply_transpose(const RealMatrix& a, const RealMatrix& b) {
  RealMatrix result = zeros(a.rows(), b.rows());
  if (a.cols() == 0) return result;
  Accumulator sum;
  for (Index j = 0; j < b.rows(); ++j)
    for (Index i = 0; i < a.rows(); ++i)
      sum.add(result(i, j), a.data() + i, a.rows(), b.data() + j, b.rows(), a.cols());
  return result;
}

RealMatrix congruence(const RealMatrix& a, const RealMatrix& p) {
  const RealMatrix ap = multiply(a, p);
  RealMatrix result = zeros(a.rows(), a.rows());
  if (a.cols() == 0) return result;
  Accumulator sum;
  for (Index j = 0; j < a.rows(); ++j)
    for (Index i = j; i < a.rows(); ++i)
      sum.add(result(i, j), ap.data() + i, ap.rows(), a.data() + j, a.rows(), a.cols());
  mirror(result);
  return result;
}

RealMatrix transpose_congruence(const RealMatrix& a, const RealMatrix& p) {
  const RealMatrix pa = multiply(p, a);
  RealMatrix result = zeros(a.cols(), a.cols());
  if (a.rows() == 0) return result;
  Accumulator sum;
  for (Index j = 0; j < a.cols(); ++j)
    for (Index i = j; i < a.cols(); ++i)
      sum.add(result(i, j), pa.data() + j * pa.rows(), 1, a.data() + i * a.rows(), 1, a.rows());
  mirror(result);
  return result;
}

RealMatrix symmetric_part(const RealMatrix& a) {
  RealMatrix result(a.rows(), a.cols());
  for (Index j = 0; j < a.cols(); ++j)
    for (Index i = 0; i < a.rows(); ++i) result(i, j) = (a(i, j) + a(j, i)) / 2;
  return result;
}

RealMatrix beside(const RealMatrix& a, const RealMatrix& b) {
  RealMatrix result(a.rows(), a.cols() + b.cols());
  result.leftCols(a.cols()) = a;
  result.rightCols(b.cols()) = b;
  return result;
}

RealMatrix above(const RealMatrix& a, const RealMatrix& b) {
  RealMatrix result(a.rows() + b.rows(), a.cols());
  result.topRows(a.rows()) = a;
  result.bottomRows(b.rows()) = b;
  return result;
}

RealMatrix joint(const RealMatrix& a, const RealMatrix& cross, const RealMatrix& b) {
  return above(beside(a, cross), beside(cross.transpose(), b));
}

RealMatrix padded(const RealMatrix& a, Index rows, Index columns) {
  RealMatrix result = zeros(rows, columns);
  result.topLeftCorner(a.rows(), a.cols()) = a;
  return result;
}

namespace {

// a = PᵀLU in place; the rows of `b` move along. False when a pivot is exactly zero.
bool eliminate(RealMatrix& a, RealMatrix& b) {
  const Index n = a.rows();
  Accumulator sum;
  for (Index j = 0; j < n; ++j) {
    Index pivot = j;
    for (Index i = 0; i < n; ++i) {
      sum.subtract(a(i, j), a.data() + i, n, a.data() + j * n, 1, std::min(i, j));
      if (i > j && abs(a(i, j)) > abs(a(pivot, j))) pivot = i;
    }
    if (a(pivot, j).is_zero()) return false;
    if (pivot != j) {
      a.row(j).swap(a.row(pivot));
      b.row(j).swap(b.row(pivot));
    }
    const Real inverse = 1 / a(j, j);
    for (Index i = j + 1; i < n; ++i) a(i, j) *= inverse;
  }
  return true;
}

}  // namespace

std::optional<RealMatrix> solve(const RealMatrix& a, const RealMatrix& b) {
  const Index n = a.rows();
  RealMatrix lu = a;
  RealMatrix x = b;
  if (!eliminate(lu, x)) return std::nullopt;
  Accumulator sum;
  for (Index j = 0; j < x.cols(); ++j) {
    Real* column = x.data() + j * n;
    for (Index i = 0; i < n; ++i) sum.subtract(column[i], lu.data() + i, n, column, 1, i);
    for (Index i = n - 1; i >= 0; --i) {
      if (i + 1 < n) sum.subtract(column[i], &lu(i, i + 1), n, column + i + 1, 1, n - 1 - i);
      column[i] /= lu(i, i);
    }
  }
  return x;
}

Real trace_of_product(const RealMatrix& a, const RealMatrix& b) {
  Real result = 0;
  if (a.cols() == 0) return result;
  Accumulator sum;
  for (Index i = 0; i < a.rows(); ++i) sum.add(result, a.data() + i, a.rows(), b.data() + i * b.rows(), 1, a.cols());
  return result;
}

Real largest_entry(const RealMatrix& a) {
  Real largest;
  for (Index i = 0; i < a.size(); ++i)
    if (abs(a.data()[i]) > largest) largest = abs(a.data()[i]);
  return largest;
}

Real norm(const RealMatrix& a) {
  Real largest;
  for (Index i = 0; i < a.rows(); ++i) {
    Real sum;
    for (Index j = 0; j < a.cols(); ++j) sum += abs(a(i, j));
    if (sum > largest) largest = sum;
  }
  return largest;
}

bool is_zero(const RealMatrix& a) {
  for (Index i = 0; i < a.size(); ++i)
    if (!a.data()[i].is_zero()) return false;
  return true;
}

Real power_of_ten(double exponent) { return pow(Real(10), Real(exponent)); }

Real negligible(double fraction) { return power_of_ten(-fraction * Real::default_precision()); }

}  // namespace lqg::design
