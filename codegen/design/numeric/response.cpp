// SPDX-License-Identifier: MIT
#include "design/numeric/response.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "design/numeric/chains.hpp"
#include "design/numeric/on_circle.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

// c ← c − a b, complex; without new numbers, for this is where the margins spend their time.
class RealProducts {
 public:
  void subtract(Real& c_re, Real& c_im, const Real& a_re, const Real& a_im, const Real& b_re, const Real& b_im) {
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

// z^0, z^−1, … for |z| = 1.
template <typename Scalar>
struct Delays {
  std::vector<Scalar> re = {Scalar(1)}, im = {Scalar(0)};

  Delays(Index longest, const Scalar& z_re, const Scalar& z_im) {
    for (Index k = 0; k < longest; ++k) {
      const Scalar last_re = re.back(), last_im = im.back();
      re.push_back(last_re * z_re + last_im * z_im);
      im.push_back(last_im * z_re - last_re * z_im);
    }
  }
};

template <typename Scalar>
Index longest_delay(const Response::Terms<Scalar>& terms) {
  Index longest = 0;
  for (const auto* late : {&terms.A_late, &terms.C_late})
    for (const Response::Late<Scalar>& entry : *late) longest = std::max(longest, entry.ago);
  return longest;
}

// zI − A(z) and the right sides, transposed: a column here is a row there, so that the loops run along memory.
template <typename Scalar, typename Products>
struct System {
  using Terms = Response::Terms<Scalar>;
  using Matrix = typename Terms::Matrix;
  Matrix re, im;
  Index size, below;
  Products products;

  System(const Terms& terms, const Scalar& z_re, const Scalar& z_im, const Delays<Scalar>& delays)
      : re(terms.A.cols() + terms.B.cols(), terms.A.rows()), im(re.rows(), re.cols()), size(terms.A.rows()),
        below(terms.below) {
    for (Index i = 0; i < size; ++i) {
      for (Index k = 0; k < size; ++k) re(k, i) = -terms.A(i, k);
      for (Index right = 0; right < terms.B.cols(); ++right) re(size + right, i) = terms.B(i, right);
    }
    for (Index i = 0; i < im.size(); ++i) im.data()[i] = 0;
    for (Index i = 0; i < size; ++i) {
      re(i, i) += z_re;
      im(i, i) = z_im;
    }
    for (const auto& entry : terms.A_late) {
      const std::size_t k = static_cast<std::size_t>(entry.ago);
      re(entry.column, entry.row) -= entry.value * delays.re[k];
      im(entry.column, entry.row) -= entry.value * delays.im[k];
    }
  }

  // (re, im)(k, i) / (re, im)(k', i')
  std::pair<Scalar, Scalar> quotient(Index k, Index i, Index k_below, Index i_below) const {
    const Scalar &a_re = re(k, i), &a_im = im(k, i), &b_re = re(k_below, i_below), &b_im = im(k_below, i_below);
    const Scalar length = b_re * b_re + b_im * b_im;
    return {(a_re * b_re + a_im * b_im) / length, (a_im * b_re - a_re * b_im) / length};
  }

  Scalar squared(Index k, Index i) const { return re(k, i) * re(k, i) + im(k, i) * im(k, i); }
  bool vanishes(Index k, Index i) const { return re(k, i) == 0 && im(k, i) == 0; }

  // The largest one of the entries on and left of the diagonal in `i` becomes the pivot.
  void bring_pivot(Index i, Index last) {
    Index pivot = i;
    Scalar largest = squared(i, i);
    for (Index row = i + 1; row <= last; ++row) {
      if (vanishes(i, row)) continue;
      const Scalar length = squared(i, row);
      if (!(length > largest)) continue;
      pivot = row;
      largest = length;
    }
    if (pivot == i) return;
    re.col(i).swap(re.col(pivot));
    im.col(i).swap(im.col(pivot));
  }

  void eliminate() {
    for (Index i = 0; i + 1 < size; ++i) {
      const Index last = std::min(i + below, size - 1);
      bring_pivot(i, last);
      for (Index row = i + 1; row <= last; ++row) {
        if (vanishes(i, row)) continue;
        const auto [f_re, f_im] = quotient(i, row, i, i);
        for (Index k = i + 1; k < re.rows(); ++k)
          products.subtract(re(k, row), im(k, row), f_re, f_im, re(k, i), im(k, i));
      }
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

Response::Terms<Real> in_hessenberg_form(RealMatrix A, RealMatrix B, RealMatrix C) {
  reduce_to_hessenberg(A, B, C);
  return {std::move(A), std::move(B), std::move(C), {}, {}, 1};
}

// `rows` over all states, as rows over those that are kept: what is there at once, and what comes later.
void fold(const RealMatrix& rows, const Chains& chains, const std::vector<Index>& place, RealMatrix& at_once,
          std::vector<Response::Late<Real>>& late) {
  for (Index j = 0; j < rows.cols(); ++j) {
    const std::size_t state = static_cast<std::size_t>(j);
    const Index column = place[static_cast<std::size_t>(chains.source[state])];
    for (Index i = 0; i < rows.rows(); ++i) {
      if (rows(i, j).is_zero()) continue;
      if (chains.ago[state] == 0)
        at_once(i, column) += rows(i, j);
      else
        late.push_back({i, column, chains.ago[state], rows(i, j)});
    }
  }
}

Response::Terms<Real> with_chains_folded(const Chains& chains, const RealMatrix& A, const RealMatrix& B,
                                         const RealMatrix& C) {
  const std::vector<Index> kept = chains.kept();
  const Index size = static_cast<Index>(kept.size());
  std::vector<Index> place(chains.source.size());
  RealMatrix own(size, A.cols());
  Response::Terms<Real> terms = {zeros(size, size), RealMatrix(size, B.cols()), zeros(C.rows(), size), {}, {},
                                 size - 1};
  for (Index k = 0; k < size; ++k) {
    const Index state = kept[static_cast<std::size_t>(k)];
    place[static_cast<std::size_t>(state)] = k;
    own.row(k) = A.row(state);
    terms.B.row(k) = B.row(state);
  }
  fold(own, chains, place, terms.A, terms.A_late);
  fold(C, chains, place, terms.C, terms.C_late);
  return terms;
}

// Does solving over the kept states take fewer multiply-adds than a Hessenberg form of all of them?
bool pays(const Chains& chains, Index right_sides) {
  const double all = static_cast<double>(chains.source.size()), kept = static_cast<double>(chains.kept().size());
  const double rights = static_cast<double>(right_sides);
  return kept * kept * (kept / 3 + rights / 2) + all < all * all * (1 + rights) / 2;
}

Response::Terms<double> in_double(const Response::Terms<Real>& exact) {
  Response::Terms<double> rough = {in_double(exact.A), in_double(exact.B), in_double(exact.C), {}, {}, exact.below};
  for (const auto& [from, to] : {std::pair(&exact.A_late, &rough.A_late), std::pair(&exact.C_late, &rough.C_late)})
    for (const Response::Late<Real>& entry : *from)
      to->push_back({entry.row, entry.column, entry.ago, to_double(entry.value)});
  return rough;
}

template <typename Scalar>
Response::Terms<Scalar> channel_of(const Response::Terms<Scalar>& all, Index i) {
  Response::Terms<Scalar> one = {all.A, all.B.col(i), all.C.row(i), all.A_late, {}, all.below};
  for (const Response::Late<Scalar>& entry : all.C_late)
    if (entry.row == i) one.C_late.push_back({0, entry.column, entry.ago, entry.value});
  return one;
}

// C xᵀ
RealMatrix product(const RealMatrix& C, const RealMatrix& x) { return multiply_transpose(C, x); }
Eigen::MatrixXd product(const Eigen::MatrixXd& C, const Eigen::MatrixXd& x) { return C * x.transpose(); }

template <typename Scalar>
struct Complex {
  typename Response::Terms<Scalar>::Matrix re, im;
};

// C(z) (zI − A(z))⁻¹ B
template <typename Products, typename Scalar>
Complex<Scalar> solution(const Response::Terms<Scalar>& terms, const Scalar& z_re, const Scalar& z_im) {
  const Delays<Scalar> delays(longest_delay(terms), z_re, z_im);
  System<Scalar, Products> system(terms, z_re, z_im, delays);
  system.solve();
  const auto re = system.re.bottomRows(terms.B.cols()), im = system.im.bottomRows(terms.B.cols());
  Complex<Scalar> T = {product(terms.C, re), product(terms.C, im)};
  for (const auto& entry : terms.C_late) {
    const std::size_t k = static_cast<std::size_t>(entry.ago);
    const Scalar c_re = entry.value * delays.re[k], c_im = entry.value * delays.im[k];
    for (Index right = 0; right < re.rows(); ++right) {
      T.re(entry.row, right) += c_re * re(right, entry.column) - c_im * im(right, entry.column);
      T.im(entry.row, right) += c_re * im(right, entry.column) + c_im * re(right, entry.column);
    }
  }
  return T;
}

}  // namespace

Response::Response(RealMatrix A, RealMatrix B, RealMatrix C) {
  const Chains chains = chains_of(A, B);
  exact_ = pays(chains, B.cols()) ? with_chains_folded(chains, A, B, C)
                                  : in_hessenberg_form(std::move(A), std::move(B), std::move(C));
  rough_ = in_double(exact_);
}

Response::Response(Terms<Real> exact, Terms<double> rough) : exact_(std::move(exact)), rough_(std::move(rough)) {}

Response Response::channel(Index i) const { return Response(channel_of(exact_, i), channel_of(rough_, i)); }

Response Response::in_present_digits() const {
  Response result = *this;
  for (RealMatrix* matrix : {&result.exact_.A, &result.exact_.B, &result.exact_.C})
    *matrix = design::in_present_digits(*matrix);
  for (std::vector<Late<Real>>* late : {&result.exact_.A_late, &result.exact_.C_late})
    for (Late<Real>& entry : *late) {
      Real value;
      mpfr_set(value.backend().data(), entry.value.backend().data(), MPFR_RNDN);
      entry.value = value;
    }
  return result;
}

ComplexMatrix Response::at(const Real& angle) const {
  Complex<Real> T = solution<RealProducts>(exact_, Real(cos(angle)), Real(sin(angle)));
  return {std::move(T.re), std::move(T.im)};
}

Eigen::MatrixXcd Response::roughly_at(const Real& angle) const {
  const std::complex<double> z = on_circle(angle);
  const Complex<double> T = solution<DoubleProducts>(rough_, z.real(), z.imag());
  Eigen::MatrixXcd result(T.re.rows(), T.re.cols());
  result.real() = T.re;
  result.imag() = T.im;
  return result;
}

}  // namespace lqg::design
