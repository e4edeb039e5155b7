// SPDX-License-Identifier: MIT
#include "design/numeric/modes.hpp"

#include "design/progress.hpp"

namespace lqg::design {

namespace {

// Orthonormal columns, grown one vector at a time.
class Basis {
 public:
  explicit Basis(Index size) : columns_(size, 0) {}
  const RealMatrix& columns() const { return columns_; }

  // What of `v` lies outside of the basis; twice, for orthogonality to the working rounding.
  RealMatrix outside(RealMatrix v) const {
    for (int pass = 0; pass < 2; ++pass) v -= multiply(columns_, transpose_multiply(columns_, v));
    return v;
  }
  void append(const RealMatrix& v) {
    const Real length = sqrt(trace_of_product(v.transpose(), v));
    columns_ = beside(columns_, v / length);
  }

 private:
  RealMatrix columns_;
};

// Takes `v` into the basis unless what lies outside is no larger than `least`.
void append_if_new(Basis& basis, const RealMatrix& v, const Real& least) {
  if (basis.columns().cols() == v.rows()) return;
  const RealMatrix rest = basis.outside(v);
  if (largest_entry(rest) > least) basis.append(rest);
}

// An orthonormal basis of the subspace that is reached: span [B, AB, A²B, …].
Basis reached(const RealMatrix& A, const RealMatrix& B, const Real& coupling) {
  Basis basis(A.rows());
  const Real least_B = coupling * largest_entry(B), least_A = coupling * largest_entry(A);
  for (Index j = 0; j < B.cols(); ++j) append_if_new(basis, B.col(j), least_B);
  for (Index j = 0; j < basis.columns().cols(); ++j) {
    report_progress("modes that are reached", j, A.rows());
    append_if_new(basis, multiply(A, basis.columns().col(j)), least_A);
  }
  return basis;
}

// Completes the basis to the whole space by the unit vectors that lie farthest outside; returns the new
// columns.
RealMatrix completion(Basis basis) {
  const Index n = basis.columns().rows(), before = basis.columns().cols();
  while (basis.columns().cols() < n) {
    RealMatrix farthest;
    Real largest;
    for (Index i = 0; i < n; ++i) {
      const RealMatrix rest = basis.outside(identity(n).col(i));
      const Real size = trace_of_product(rest.transpose(), rest);
      if (size > largest) {
        largest = size;
        farthest = rest;
      }
    }
    basis.append(farthest);
  }
  return basis.columns().rightCols(n - before);
}

// A vector that a (nearly) singular matrix takes to (nearly) nothing, by two steps of inverse iteration.
RealMatrix null_vector(RealMatrix a) {
  const Index n = a.rows();
  const Real nudge = negligible(0.9) * (largest_entry(a) + negligible(1));
  for (Index i = 0; i < n; ++i) a(i, i) += nudge * (i + 1) / n;
  RealMatrix v = RealMatrix::Constant(n, 1, Real(1));
  for (Index i = 0; i < n; ++i) v(i, 0) += Real(i) / (3 * n);
  for (int step = 0; step < 2; ++step) {
    const std::optional<RealMatrix> next = solve(a, v);
    if (!next) return v;
    v = *next / largest_entry(*next);
  }
  return v;
}

// (A − λ) for a real λ, (A − λ)(A − λ̄) for a complex one.
RealMatrix annihilator(const RealMatrix& A, const ComplexReal& value) {
  const RealMatrix one = identity(A.rows());
  if (value.im.is_zero()) return A - value.re * one;
  return multiply(A, A) - 2 * value.re * A + (value.re * value.re + value.im * value.im) * one;
}

// The states in the left eigenvector of the mode (real and imaginary part: v and vA span both).
std::vector<Index> states_of(const RealMatrix& unreached, const RealMatrix& rest, const ComplexReal& value) {
  const RealMatrix v = null_vector(annihilator(rest, value).transpose());
  RealMatrix share = multiply(unreached, v).cwiseAbs();
  if (!value.im.is_zero()) share += multiply(unreached, transpose_multiply(rest, v)).cwiseAbs();
  std::vector<Index> states;
  const Real least = 1e-6 * largest_entry(share);
  for (Index i = 0; i < share.rows(); ++i)
    if (share(i, 0) > least) states.push_back(i);
  return states;
}

// Wide enough for the scatter of an eigenvalue that is five times defective.
Real limit() { return negligible(1.0 / 6); }

}  // namespace

Real no_coupling() { return negligible(0.6); }

Unreached unreached_modes(const RealMatrix& A, const RealMatrix& B, const Real& coupling) {
  Unreached result;
  const Basis basis = reached(A, B, coupling);
  result.dimension = A.rows() - basis.columns().cols();
  if (result.dimension == 0) return result;
  const RealMatrix unreached = completion(basis);
  const RealMatrix rest = transpose_multiply(unreached, multiply(A, unreached));
  for (const ComplexReal& value : eigenvalues(rest))
    if (!(value.im < 0)) result.modes.push_back({value, states_of(unreached, rest, value)});
  return result;
}

Unreached unreached_sampled_modes(const RealMatrix& A, const RealMatrix& B, const Real& coupling) {
  Unreached result = unreached_modes(A - identity(A.rows()), B, coupling);
  for (Mode& mode : result.modes) mode.value.re += 1;
  return result;
}

// (A − λ)ᵀ(A − λ̄)ᵀ takes a real v to 0; then (A − λ)ᵀv is an eigenvector, or 0.
LeftEigenvector left_eigenvector(const RealMatrix& A, const ComplexReal& value) {
  LeftEigenvector result;
  const RealMatrix v = null_vector(annihilator(A, value).transpose());
  result.re = v;
  result.im = zeros(v.rows(), 1);
  if (!value.im.is_zero()) {
    result.re = transpose_multiply(A, v) - value.re * v;
    result.im = value.im * v;
  }
  result.states = states_of(identity(A.rows()), A, value);
  return result;
}

bool on_or_outside_circle(const ComplexReal& z) { return hypot(z.re, z.im) >= 1 - limit(); }

bool on_circle(const ComplexReal& z) { return abs(hypot(z.re, z.im) - 1) <= limit(); }

bool on_axis(const ComplexReal& s, const Real& scale) { return abs(s.re) <= limit() * scale; }

bool on_or_right_of_axis(const ComplexReal& s, const Real& scale) { return s.re >= -limit() * scale; }

}  // namespace lqg::design
