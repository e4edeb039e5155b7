// SPDX-License-Identifier: MIT
#include "design/equations/placement.hpp"
#include "design/numeric/modes.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

// Numbers in [−1/2, 1/2) that no pattern of a plant meets: the fractional parts of multiples of the golden ratio.
class Scatter {
 public:
  RealMatrix matrix(Index rows, Index columns) {
    RealMatrix result(rows, columns);
    for (Index i = 0; i < result.size(); ++i) {
      position_ += golden_;
      if (position_ >= 0.5) position_ -= 1;
      result.data()[i] = position_;
    }
    return result;
  }

 private:
  Real golden_ = (sqrt(Real(5)) - 1) / 2, position_ = Real(0);
};

// Unit columns, orthogonal to one another, that span those of `a`.
RealMatrix orthonormal(const RealMatrix& a) {
  RealMatrix basis(a.rows(), 0);
  for (Index j = 0; j < a.cols(); ++j) {
    RealMatrix v = a.col(j);
    for (int pass = 0; pass < 2; ++pass) v -= multiply(basis, transpose_multiply(basis, v));
    const Real length = sqrt(trace_of_product(v.transpose(), v));
    if (!length.is_zero()) basis = beside(basis, v / length);
  }
  return basis;
}

// The columns of B that do not depend on those before.
std::vector<Index> independent_inputs(const RealMatrix& B) {
  std::vector<Index> inputs;
  RealMatrix basis(B.rows(), 0);
  for (Index j = 0; j < B.cols(); ++j) {
    const RealMatrix column = B.col(j);
    RealMatrix rest = column;
    for (int pass = 0; pass < 2; ++pass) rest -= multiply(basis, transpose_multiply(basis, rest));
    if (largest_entry(rest) <= no_coupling() * largest_entry(column)) continue;
    inputs.push_back(j);
    basis = beside(basis, orthonormal(rest));
  }
  return inputs;
}

// A pole, or a conjugate pair, and where its eigenvector may lie: `basis` of all x with (A − λ)x in the span of B,
// a complex x as [Re x; Im x]. `column` of X is its own, with the next one for a pair.
struct Freedom {
  ComplexReal pole;
  RealMatrix basis;
  Index column;
  bool is_pair() const { return !pole.im.is_zero(); }
};

// [Re a; Im a]ᴴ [Re b; Im b]
ComplexReal complex_dot(const RealMatrix& a, const RealMatrix& b) {
  const Index n = a.rows() / 2;
  ComplexReal sum = {Real(0), Real(0)};
  for (Index i = 0; i < n; ++i) {
    sum.re += a(i, 0) * b(i, 0) + a(n + i, 0) * b(n + i, 0);
    sum.im += a(i, 0) * b(n + i, 0) - a(n + i, 0) * b(i, 0);
  }
  return sum;
}

// The eigenvectors X as real columns, and the inverse that tells how far each is from the span of the others.
class Eigenvectors {
 public:
  explicit Eigenvectors(RealMatrix X) : X_(std::move(X)) {}

  // False when they are dependent.
  bool invert() {
    const std::optional<RealMatrix> inverse = solve(X_, identity(X_.rows()));
    if (!inverse || !(largest_entry(*inverse) * no_coupling() < 1)) return false;
    inverse_ = *inverse;
    return true;
  }

  // Puts the best vector of its freedom in the place of one; returns by how much |det X| has grown.
  Real improve(const Freedom& freedom) {
    const RealMatrix x = freedom.is_pair() ? best_pair(freedom) : best_vector(freedom);
    const Index nx = X_.rows(), j = freedom.column;
    if (!freedom.is_pair()) return replace(j, x);
    RealMatrix re = x.topRows(nx), im = x.bottomRows(nx);
    // x and jx are the same eigenvector; that one first which is farther from all others.
    const auto distance = [&](const RealMatrix& v) { return Real(abs(multiply(inverse_.row(j), v)(0, 0))); };
    if (distance(im) > distance(re)) {
      re.swap(im);
      re = -re;
    }
    const Real first = replace(j, re);
    return first * replace(j + 1, im);
  }

  RealMatrix vector_of(const Freedom& freedom) const {
    const RealMatrix re = X_.col(freedom.column);
    return freedom.is_pair() ? above(re, X_.col(freedom.column + 1)) : re;
  }

 private:
  RealMatrix unit(const RealMatrix& x) const { return x / sqrt(trace_of_product(x.transpose(), x)); }

  static RealMatrix project(const RealMatrix& basis, const RealMatrix& x) {
    return multiply(basis, transpose_multiply(basis, x));
  }

  // Row j of X⁻¹ is orthogonal to all other columns: its projection is the farthest from their span.
  RealMatrix best_vector(const Freedom& freedom) const {
    return unit(project(freedom.basis, inverse_.row(freedom.column).transpose()));
  }

  // With a = uᵀx, b = vᵀx for the two rows u, v of X⁻¹: |det X| grows as |Im(āb)| = |xᴴ(pqᴴ − qpᴴ)x/2j|, p and q the
  // projections of u and v. The largest |eigenvalue| μ of that matrix has the eigenvector −(qᴴq)p + (qᴴp − 2jμ)q.
  RealMatrix best_pair(const Freedom& freedom) const {
    const Index nx = X_.rows();
    const RealMatrix u = inverse_.row(freedom.column).transpose(), v = inverse_.row(freedom.column + 1).transpose();
    const RealMatrix p = project(freedom.basis, above(u, zeros(nx, 1))),
                     q = project(freedom.basis, above(v, zeros(nx, 1)));
    const ComplexReal qp = complex_dot(q, p);
    const Real pp = complex_dot(p, p).re, qq = complex_dot(q, q).re;
    const Real square = pp * qq - qp.re * qp.re;  // t² + ‖p‖²‖q‖² − |qᴴp|² with t = Im qᴴp
    const Real root = square > 0 ? Real(sqrt(square)) : Real(0);
    const Real twice_mu = qp.im < 0 ? qp.im - root : qp.im + root;
    const RealMatrix turned_q = above(-q.bottomRows(nx), q.topRows(nx));
    return unit(-qq * p + qp.re * q + (qp.im - twice_mu) * turned_q);
  }

  // X with the column j replaced, and its inverse; returns |det| after over before.
  Real replace(Index j, const RealMatrix& x) {
    const RealMatrix share = multiply(inverse_, x);
    const Real& own = share(j, 0);
    const RealMatrix row = inverse_.row(j) / own;
    inverse_ -= multiply(share, row);
    inverse_.row(j) = row;
    X_.col(j) = x;
    return abs(own);
  }

  RealMatrix X_, inverse_;
};

std::optional<std::vector<Freedom>> freedoms_of(const RealMatrix& A, const RealMatrix& B,
                                                const std::vector<ComplexReal>& poles, Scatter& scatter) {
  std::vector<Freedom> freedoms;
  Index column = 0;
  for (const ComplexReal& pole : poles) {
    const Index parts = pole.im.is_zero() ? 1 : 2;
    const RealMatrix F = detail::eigenvector_equation(A, B, pole);
    const std::optional<RealMatrix> free = detail::onto_null_space(F, scatter.matrix(F.cols(), parts * B.cols()));
    if (!free) return std::nullopt;
    freedoms.push_back({pole, orthonormal(free->topRows(parts * A.rows())), column});
    column += parts;
  }
  return freedoms;
}

Eigenvectors first_eigenvectors(const std::vector<Freedom>& freedoms, Index nx, Scatter& scatter) {
  RealMatrix X(nx, 0);
  for (const Freedom& freedom : freedoms) {
    const RealMatrix x = multiply(freedom.basis, scatter.matrix(freedom.basis.cols(), 1));
    X = beside(X, x.topRows(nx));
    if (freedom.is_pair()) X = beside(X, x.bottomRows(nx));
  }
  return Eigenvectors(X);
}

// g of Bg = (A − λ)x.
std::optional<RealMatrix> input_share(const RealMatrix& A, const RealMatrix& B, const ComplexReal& pole,
                                      const RealMatrix& x) {
  const RealMatrix F = detail::eigenvector_equation(A, B, pole);
  const RealMatrix moved = multiply(F.leftCols(x.rows()), x), drive = -F.rightCols(F.cols() - x.rows());
  return solve(transpose_multiply(drive, drive), transpose_multiply(drive, moved));
}

}  // namespace

std::optional<PlacementChoice> choose_placement(const RealMatrix& A, const RealMatrix& B,
                                                const std::vector<ComplexReal>& poles) {
  PlacementChoice choice;
  choice.inputs = independent_inputs(B);
  for (const Index input : choice.inputs)
    choice.exponents.push_back(static_cast<int>(ilogb(largest_entry(B.col(input)))));
  if (choice.inputs.empty()) return std::nullopt;
  if (choice.inputs.size() == 1) return choice;
  const RealMatrix chosen = detail::chosen_inputs(B, choice);
  Scatter scatter;
  const std::optional<std::vector<Freedom>> freedoms = freedoms_of(A, chosen, poles, scatter);
  if (!freedoms) return std::nullopt;
  Eigenvectors vectors = first_eigenvectors(*freedoms, A.rows(), scatter);
  if (!vectors.invert()) return std::nullopt;
  const Real worthwhile = 1.001;
  for (int sweep = 0; sweep < 50; ++sweep) {
    Real growth = 1;
    for (const Freedom& freedom : *freedoms) growth *= vectors.improve(freedom);
    if (sweep > 0 && growth < worthwhile) break;
  }
  for (const Freedom& freedom : *freedoms) {
    const RealMatrix x = vectors.vector_of(freedom);
    const std::optional<RealMatrix> g = input_share(A, chosen, freedom.pole, x);
    if (!g) return std::nullopt;
    const RealMatrix both = above(x, *g);
    Eigen::VectorXd direction(both.rows());
    for (Index i = 0; i < both.rows(); ++i) direction(i) = to_double(both(i, 0));
    choice.directions.push_back(direction);
  }
  return choice;
}

}  // namespace lqg::design
