#include "design/numeric/response.hpp"

#include <cmath>
#include <utility>

#include "design/rounding.hpp"

namespace lqg::design {

namespace {

// c ← c − a b, complex; without new numbers, for this is where the margins spend their time.
class RealProducts {
 public:
  void subtract(Real& c_re, Real& c_im, const Real& a_re, const Real& a_im, const Real& b_re,
                const Real& b_im) {
    apply(mpfr_sub, c_re, a_re, b_re);
    apply(mpfr_add, c_re, a_im, b_im);
    apply(mpfr_sub, c_im, a_re, b_im);
    apply(mpfr_sub, c_im, a_im, b_re);
  }

 private:
  template <typename Operation>
  void apply(Operation operation, Real& c, const Real& a, const Real& b) {
    mpfr_ptr sum = c.backend().data(), product = product_.backend().data();
    mpfr_mul(product, a.backend().data(), b.backend().data(), MPFR_RNDN);
    operation(sum, sum, product, MPFR_RNDN);
  }
  Real product_;
};

struct DoubleProducts {
  void subtract(double& c_re, double& c_im, double a_re, double a_im, double b_re, double b_im) {
    c_re -= a_re * b_re - a_im * b_im;
    c_im -= a_re * b_im + a_im * b_re;
  }
};

// zI − A, an upper Hessenberg matrix, and the right sides, transposed: a column here is a row there, so that
// the loops run along memory.
template <typename Scalar, typename Products>
struct System {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  Matrix re, im;
  Index size;
  Products products;

  System(const Matrix& A, const Matrix& B, const Scalar& z_re, const Scalar& z_im)
      : re(A.cols() + B.cols(), A.rows()), im(A.cols() + B.cols(), A.rows()), size(A.rows()) {
    re.topRows(size) = -A.transpose();
    re.bottomRows(B.cols()) = B.transpose();
    for (Index i = 0; i < im.size(); ++i) im.data()[i] = 0;
    for (Index i = 0; i < size; ++i) {
      re(i, i) += z_re;
      im(i, i) = z_im;
    }
  }

  // (re, im)(k, i) / (re, im)(k', i')
  std::pair<Scalar, Scalar> quotient(Index k, Index i, Index k_below, Index i_below) const {
    const Scalar &a_re = re(k, i), &a_im = im(k, i), &b_re = re(k_below, i_below),
                 &b_im = im(k_below, i_below);
    const Scalar length = b_re * b_re + b_im * b_im;
    return {(a_re * b_re + a_im * b_im) / length, (a_im * b_re - a_re * b_im) / length};
  }

  // Only the entry left of the diagonal has to go; the larger one of the two rows is the pivot.
  void eliminate() {
    for (Index i = 0; i + 1 < size; ++i) {
      if (re(i, i + 1) == 0) continue;
      if (re(i, i + 1) * re(i, i + 1) > re(i, i) * re(i, i) + im(i, i) * im(i, i)) {
        re.col(i).swap(re.col(i + 1));
        im.col(i).swap(im.col(i + 1));
      }
      const auto [f_re, f_im] = quotient(i, i + 1, i, i);
      for (Index k = i + 1; k < re.rows(); ++k)
        products.subtract(re(k, i + 1), im(k, i + 1), f_re, f_im, re(k, i), im(k, i));
    }
  }

  // The solution for one right side, in its place.
  void substitute(Index right) {
    for (Index i = size - 1; i >= 0; --i) {
      for (Index k = i + 1; k < size; ++k)
        products.subtract(re(right, i), im(right, i), re(k, i), im(k, i), re(right, k), im(right, k));
      const auto [x_re, x_im] = quotient(right, i, i, i);
      re(right, i) = x_re;
      im(right, i) = x_im;
    }
  }

  void solve() {
    eliminate();
    for (Index right = size; right < re.rows(); ++right) substitute(right);
  }
};

Eigen::MatrixXd in_double(const RealMatrix& a) {
  Eigen::MatrixXd result(a.rows(), a.cols());
  for (Index i = 0; i < a.size(); ++i) result.data()[i] = to_double(a.data()[i]);
  return result;
}

}  // namespace

Response::Response(RealMatrix A, RealMatrix B, RealMatrix C)
    : A_(std::move(A)), B_(std::move(B)), C_(std::move(C)) {
  reduce_to_hessenberg(A_, B_, C_);
  rough_A_ = in_double(A_);
  rough_B_ = in_double(B_);
  rough_C_ = in_double(C_);
}

Response Response::in_present_digits() const {
  Response result = *this;
  for (RealMatrix* matrix : {&result.A_, &result.B_, &result.C_})
    *matrix = design::in_present_digits(*matrix);
  return result;
}

ComplexMatrix Response::at(const Real& angle) const {
  System<Real, RealProducts> system(A_, B_, cos(angle), sin(angle));
  system.solve();
  return {multiply_transpose(C_, system.re.bottomRows(B_.cols())),
          multiply_transpose(C_, system.im.bottomRows(B_.cols()))};
}

ComplexMatrix Response::roughly_at(const Real& angle) const {
  System<double, DoubleProducts> system(rough_A_, rough_B_, to_double(cos(angle)), to_double(sin(angle)));
  system.solve();
  const Index right_sides = B_.cols();
  return {real(rough_C_ * system.re.bottomRows(right_sides).transpose()),
          real(rough_C_ * system.im.bottomRows(right_sides).transpose())};
}

}  // namespace lqg::design
