// SPDX-License-Identifier: MIT
// Eigenvalues of a real matrix: Hessenberg form, then the implicit double-shift QR sweeps of J. G. F.
// Francis, "The QR transformation, part 2", The Computer Journal 4 (1962), 332–345.
#include <array>
#include <limits>

#include "design/numeric/chains.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/progress.hpp"

namespace lqg::design {

namespace {

// I − beta v vᵀ with v_0 = 1, made to turn (x_0, x_1, …) into a multiple of e_0. beta = 0: nothing to turn.
struct Reflection {
  std::array<Real, 3> v;
  Real beta;
  Index size = 0;
  std::array<Real, 2> scratch;

  void make(const std::array<Real, 3>& x, Index count) {
    size = count;
    Real tail;
    for (Index i = 1; i < size; ++i) tail += x[i] * x[i];
    beta = 0;
    if (tail.is_zero()) return;
    const Real length = sqrt(x[0] * x[0] + tail);
    const Real first = x[0] < 0 ? x[0] - length : x[0] + length;
    beta = 2 * first * first / (first * first + tail);
    v[0] = 1;
    for (Index i = 1; i < size; ++i) v[i] = x[i] / first;
  }

  // a ← (I − beta v vᵀ) a for the entries a[0], a[stride], …
  void apply(Real* a, Index stride) {
    mpfr_ptr dot = scratch[0].backend().data();
    mpfr_ptr part = scratch[1].backend().data();
    mpfr_set(dot, a[0].backend().data(), MPFR_RNDN);
    for (Index i = 1; i < size; ++i) {
      mpfr_mul(part, v[i].backend().data(), a[i * stride].backend().data(), MPFR_RNDN);
      mpfr_add(dot, dot, part, MPFR_RNDN);
    }
    mpfr_mul(dot, dot, beta.backend().data(), MPFR_RNDN);
    mpfr_sub(a[0].backend().data(), a[0].backend().data(), dot, MPFR_RNDN);
    for (Index i = 1; i < size; ++i) {
      mpfr_ptr entry = a[i * stride].backend().data();
      mpfr_mul(part, v[i].backend().data(), dot, MPFR_RNDN);
      mpfr_sub(entry, entry, part, MPFR_RNDN);
    }
  }
};

// One sweep on rows and columns low … high with the two shifts whose sum and product are given.
void sweep(RealMatrix& h, Index low, Index high, const Real& sum, const Real& product) {
  const Index n = h.rows();
  Real* a = h.data();
  // The first column of (H − σ₁)(H − σ₂).
  std::array<Real, 3> x = {h(low, low) * (h(low, low) - sum) + h(low, low + 1) * h(low + 1, low) + product,
                           h(low + 1, low) * (h(low, low) + h(low + 1, low + 1) - sum),
                           low + 2 <= high ? h(low + 1, low) * h(low + 2, low + 1) : Real(0)};
  Reflection reflection;
  for (Index k = low; k < high; ++k) {
    const Index size = std::min<Index>(3, high - k + 1);
    reflection.make(x, size);
    const Index first = k > low ? k - 1 : low;
    if (!reflection.beta.is_zero()) {
      for (Index j = first; j <= high; ++j) reflection.apply(a + k + j * n, 1);
      for (Index i = low; i <= std::min(k + 3, high); ++i) reflection.apply(a + i + k * n, n);
      if (k > low)
        for (Index i = k + 1; i < k + size; ++i) h(i, k - 1) = 0;
    }
    for (Index i = 0; i < 3; ++i) x[i] = k + 1 + i <= high ? h(k + 1 + i, k) : Real(0);
  }
}

// Scales the rows of a block by powers of two, and its columns by their inverses, until both have about the same size
// (B. N. Parlett, C. Reinsch, Numerische Mathematik 13 (1969), 293–304): sweeps make several poles at one place a block
// of rounding with entries of all sizes, which they cannot take apart then.
void balance(RealMatrix& h, Index low, Index high) {
  const int most_rounds = 20;
  bool changed = true;
  for (int round = 0; changed && round < most_rounds; ++round) {
    changed = false;
    for (Index i = low; i <= high; ++i) {
      Real row, column;
      for (Index j = low; j <= high; ++j) {
        if (j == i) continue;
        row += abs(h(i, j));
        column += abs(h(j, i));
      }
      if (row.is_zero() || column.is_zero()) continue;
      const long power = lround(log2(row / column) / 2);
      if (power == 0) continue;
      changed = true;
      for (Index j = low; j <= high; ++j) {
        h(i, j) = ldexp(h(i, j), static_cast<int>(-power));
        h(j, i) = ldexp(h(j, i), static_cast<int>(power));
      }
    }
  }
}

// The eigenvalues of [a b; c d].
std::array<ComplexReal, 2> eigenvalues_of_pair(const Real& a, const Real& b, const Real& c, const Real& d) {
  const Real half = (a - d) / 2;
  const Real square = half * half + b * c;
  if (square < 0) {
    const Real middle = (a + d) / 2;
    const Real height = sqrt(-square);
    return {ComplexReal{middle, height}, ComplexReal{middle, -height}};
  }
  // The root away from zero first: half and the square root do not cancel.
  const Real away = half < 0 ? half - sqrt(square) : half + sqrt(square);
  const Real other = away.is_zero() ? d : d - b * c / away;
  return {ComplexReal{d + away, Real(0)}, ComplexReal{other, Real(0)}};
}

// The start of the trailing block that ends at `high` and cannot be split; the negligible entry before it is
// set to 0.
Index split(RealMatrix& h, Index high, const Real& rounding, const Real& scale) {
  Index low = high;
  while (low > 0) {
    Real size = abs(h(low, low)) + abs(h(low - 1, low - 1));
    if (size.is_zero()) size = scale;
    if (abs(h(low, low - 1)) <= rounding * size) {
      h(low, low - 1) = 0;
      break;
    }
    --low;
  }
  return low;
}

// (I − scaled vᵀ) x for the entries x[0], x[stride], …, as many as v has; without new numbers, for this is where large
// designs spend their time.
class Householder {
 public:
  Householder(const RealMatrix& v, const RealMatrix& scaled) : v_(v), scaled_(scaled) {}

  void apply(Real* x, Index stride) {
    mpfr_ptr dot = dot_.backend().data(), part = part_.backend().data();
    mpfr_set_zero(dot, 1);
    for (Index i = 0; i < v_.size(); ++i) {
      mpfr_srcptr entry = x[i * stride].backend().data();
      if (mpfr_zero_p(entry)) continue;
      mpfr_mul(part, v_.data()[i].backend().data(), entry, MPFR_RNDN);
      mpfr_add(dot, dot, part, MPFR_RNDN);
    }
    if (mpfr_zero_p(dot)) return;
    for (Index i = 0; i < v_.size(); ++i) {
      mpfr_ptr entry = x[i * stride].backend().data();
      mpfr_mul(part, scaled_.data()[i].backend().data(), dot, MPFR_RNDN);
      mpfr_sub(entry, entry, part, MPFR_RNDN);
    }
  }

 private:
  const RealMatrix &v_, &scaled_;
  Real dot_, part_;
};

// On the rows from `first` on, in the columns from `column` on.
void reflect_rows(RealMatrix& a, Index first, Index column, Householder& householder) {
  for (Index j = column; j < a.cols(); ++j) householder.apply(&a(first, j), 1);
}

void reflect_columns(RealMatrix& a, Index first, Householder& householder) {
  for (Index i = 0; i < a.rows(); ++i) householder.apply(&a(i, first), a.rows());
}

}  // namespace

void reduce_to_hessenberg(RealMatrix& A, RealMatrix& B, RealMatrix& C) {
  const Index n = A.rows();
  for (Index k = 0; k + 2 < n; ++k) {
    report_progress("Hessenberg form", k, n);
    RealMatrix v = A.block(k + 1, k, n - k - 1, 1);
    Real tail;
    for (Index i = 1; i < v.rows(); ++i) tail += v(i, 0) * v(i, 0);
    if (tail.is_zero()) continue;
    const Real length = sqrt(v(0, 0) * v(0, 0) + tail);
    v(0, 0) = v(0, 0) < 0 ? v(0, 0) - length : v(0, 0) + length;
    const RealMatrix scaled = (2 / (v(0, 0) * v(0, 0) + tail)) * v;
    Householder householder(v, scaled);
    reflect_rows(A, k + 1, k, householder);
    reflect_rows(B, k + 1, 0, householder);
    reflect_columns(A, k + 1, householder);
    reflect_columns(C, k + 1, householder);
    for (Index i = k + 2; i < n; ++i) A(i, k) = 0;
  }
}

namespace {

// Is row or column i zero beside the diagonal?
bool is_isolated(const RealMatrix& a, Index i) {
  bool row = true, column = true;
  for (Index j = 0; j < a.rows(); ++j) {
    row = row && (j == i || a(i, j).is_zero());
    column = column && (j == i || a(j, i).is_zero());
  }
  return row || column;
}

RealMatrix without(const RealMatrix& a, Index i) {
  const Index n = a.rows() - 1;
  RealMatrix rest(n, n);
  for (Index column = 0; column < n; ++column)
    for (Index row = 0; row < n; ++row) rest(row, column) = a(row + (row >= i), column + (column >= i));
  return rest;
}

// Takes out what is an eigenvalue as it stands: a chain of delays is one zero after the other, exactly.
RealMatrix take_isolated(RealMatrix a, std::vector<ComplexReal>& found) {
  for (Index i = 0; i < a.rows();) {
    if (!is_isolated(a, i)) {
      ++i;
      continue;
    }
    found.push_back({a(i, i), Real(0)});
    a = without(a, i);
    i = 0;
  }
  return a;
}

// Takes out the zeros of differences that vanish: of inputs on their way and the controller's copy of them. The sweeps
// scatter a zero of k states by 10^(−digits/k); as long as that is less than the rounding of a double, it is theirs.
RealMatrix take_equal(const RealMatrix& a, std::vector<ComplexReal>& found) {
  const Merged merged = with_equal_states_merged(a, zeros(a.rows(), 0));
  const Index zeros_there = a.rows() - merged.A.rows();
  if (zeros_there == 0 || negligible(1.0 / zeros_there) < std::numeric_limits<double>::epsilon() / 2) return a;
  found.resize(found.size() + static_cast<std::size_t>(zeros_there), {Real(0), Real(0)});
  return merged.A;
}

}  // namespace

std::vector<ComplexReal> eigenvalues(const RealMatrix& a) {
  std::vector<ComplexReal> found;
  RealMatrix h = take_equal(take_isolated(a, found), found), none_left, none_right;
  reduce_to_hessenberg(h, none_left, none_right);
  const Real scale = largest_entry(h);
  const Real rounding = negligible(1);
  // Each sweep halves a defective eigenvalue's error, if no more: a digit takes 10/3 of them.
  const int most_sweeps = 200 + 5 * static_cast<int>(Real::default_precision()), until_balanced = 50;
  int sweeps = 0;
  for (Index high = h.rows() - 1; high >= 0;) {
    const Index low = split(h, high, rounding, scale);
    if (low == high) {
      found.push_back({h(high, high), Real(0)});
    } else if (low + 1 == high) {
      for (const ComplexReal& value : eigenvalues_of_pair(h(low, low), h(low, high), h(high, low), h(high, high)))
        found.push_back(value);
    } else if (sweeps++ < most_sweeps) {
      report_progress("eigenvalues", a.rows() - high);
      if (sweeps % until_balanced == 0) balance(h, low, high);
      const Index last = high - 1;
      Real sum = h(last, last) + h(high, high);
      Real product = h(last, last) * h(high, high) - h(last, high) * h(high, last);
      if (sweeps % 10 == 0) {  // shifts of another kind when these go in circles
        const Real size = abs(h(high, last)) + abs(h(last, last - 1));
        sum = size * 3 / 2;
        product = size * size;
      }
      sweep(h, low, high, sum, product);
      continue;
    } else {
      const Real unknown = std::numeric_limits<double>::quiet_NaN();
      return std::vector<ComplexReal>(static_cast<std::size_t>(a.rows()), ComplexReal{unknown, unknown});
    }
    high = low - 1;
    sweeps = 0;
  }
  return found;
}

}  // namespace lqg::design
