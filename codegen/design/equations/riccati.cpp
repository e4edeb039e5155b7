// SPDX-License-Identifier: MIT
#include "design/equations/riccati.hpp"

#include <limits>

#include "design/numeric/factor.hpp"
#include "design/progress.hpp"

namespace lqg::design {

namespace {

// The largest |entry| of a − b beside the largest of a.
Real relative_change(const RealMatrix& a, const RealMatrix& b) {
  const Real change = largest_entry(a - b);
  return change.is_zero() ? change : Real(change / largest_entry(a));
}

bool is_finite(const RealMatrix& a) {
  for (Index i = 0; i < a.size(); ++i)
    if (!isfinite(a.data()[i])) return false;
  return true;
}

int most_doublings() { return 4 * static_cast<int>(Real::default_precision()); }

// X by structure-preserving doubling (E. K. Chu, H. Y. Fan, W. W. Lin, C. S. Wang, International Journal of
// Control 77 (2004), 767–788); the minimal X, not the stabilising one, where an unstable mode has no weight.
// Empty when R or a step is singular.
//   A ← A(I + GH)⁻¹A,  G ← G + A(I + GH)⁻¹GAᵀ,  H ← H + AᵀH(I + GH)⁻¹A;  H → X
std::optional<RealMatrix> doubled_up(const RiccatiEquation& e) {
  const Index nx = e.A.rows();
  const std::optional<RealMatrix> weighed = solve(e.R, beside(e.B.transpose(), e.N.transpose()));
  if (!weighed) return std::nullopt;
  RealMatrix A = e.A - multiply(e.B, weighed->rightCols(nx));
  RealMatrix G = symmetric_part(multiply(e.B, weighed->leftCols(nx)));
  RealMatrix H = symmetric_part(e.Q - multiply(e.N, weighed->rightCols(nx)));
  for (int k = 0; k < most_doublings(); ++k) {
    report_progress("Riccati equation, doubling,", k);
    const std::optional<RealMatrix> solved = solve(identity(nx) + multiply(G, H), beside(A, G));
    if (!solved || !is_finite(*solved)) return std::nullopt;
    const RealMatrix next = H + symmetric_part(transpose_multiply(A, multiply(H, solved->leftCols(nx))));
    G += congruence(A, symmetric_part(solved->rightCols(nx)));
    A = multiply(A, solved->leftCols(nx));
    const Real change = relative_change(next, H);
    H = next;
    if (change < negligible(0.6)) break;
  }
  return H;
}

// K of some other weights: Q and R lifted off the semidefinite limit by `lift`, or identities for all when it
// is 0.
std::optional<RealMatrix> gain_of_other_weights(const RiccatiEquation& e, const Real& lift) {
  RiccatiEquation other = e;
  const Index nx = e.A.rows(), nu = e.B.cols();
  const Real scale = norm(e.B);
  if (lift.is_zero()) {
    other.Q = identity(nx);
    other.R = scale * scale * identity(nu);
    other.N = zeros(nx, nu);
  } else {
    const Real size = largest_entry(e.Q) + largest_entry(e.R);
    other.Q += lift * size * identity(nx);
    other.R += lift * size * identity(nu);
  }
  const std::optional<RealMatrix> X = doubled_up(other);
  return X ? gain_of(other, *X) : std::nullopt;
}

// One step of D. L. Kleinman's iteration (G. A. Hewer, IEEE Transactions on Automatic Control 16 (1971),
// 382–384): the X that u = −Kx costs. K was made of `X`, which may be empty; then the step is a correction of
// X by the residual, and a small residual needs only half of the digits to be solved for. Empty when A − BK
// is not strictly stable.
std::optional<RealMatrix> cost_of_gain(const RiccatiEquation& e, const RealMatrix& K, const RealMatrix& X) {
  const RealMatrix closed = e.A - multiply(e.B, K), cost = step_cost(e, K);
  if (X.size() == 0) return solve_stein(closed, cost);
  const RealMatrix residual = cost + transpose_congruence(closed, X) - X;
  const bool is_small = largest_entry(residual) <= negligible(0.4) * largest_entry(X);
  std::optional<RealMatrix> correction;
  {
    const Digits enough(is_small ? Real::default_precision() / 2 + 5 : Real::default_precision());
    correction = solve_stein(in_present_digits(closed), in_present_digits(residual));
  }
  if (!correction) return std::nullopt;
  return X + in_present_digits(*correction);
}

// Is X the rounding of 0? So it is where u = −Kx costs nothing, Q = N R⁻¹ Nᵀ: the terms of its cost cancel.
bool is_rounding_of_zero(const RiccatiEquation& e, const RealMatrix& K, const RealMatrix& X) {
  return largest_entry(X) <= negligible(0.6) * (largest_entry(e.Q) + largest_entry(transpose_congruence(K, e.R)));
}

// Kleinman's steps, quadratic from a stabilising K on; every closed loop on the way is stable.
RiccatiResult polish(const RiccatiEquation& e, RealMatrix K, RealMatrix X) {
  RiccatiResult result;
  Real before = 1;
  for (int i = 0; i < 200; ++i) {
    report_progress("Riccati equation, Newton's method,", i);
    std::optional<RealMatrix> next = cost_of_gain(e, K, X);
    if (!next) {
      result.failure = i == 0 ? RiccatiFailure::no_start : RiccatiFailure::not_converged;
      return result;
    }
    if (is_rounding_of_zero(e, K, *next)) next->setZero();
    const std::optional<RealMatrix> gain = gain_of(e, *next);
    if (!gain) {
      result.failure = RiccatiFailure::not_definite;
      return result;
    }
    const Real change = X.size() > 0 ? relative_change(*next, X) : Real(1);
    X = *next;
    K = *gain;
    // The next change would be about this one's square.
    const bool at_rest = change < negligible(0.45) || (change < negligible(0.3) && change > before / 2);
    before = change;
    if (!at_rest) continue;
    result.X = X;
    result.K = K;
    result.closed = e.A - multiply(e.B, K);
    return result;
  }
  result.failure = RiccatiFailure::not_converged;
  return result;
}

RiccatiResult first_that_stabilises(const RiccatiEquation& e) {
  RiccatiResult result;
  const std::optional<RealMatrix> X = doubled_up(e);
  const std::optional<RealMatrix> K = X ? gain_of(e, *X) : std::nullopt;
  result.failure = RiccatiFailure::no_start;
  if (K) result = polish(e, *K, *X);
  for (const double lift : {1e-12, 1e-4, 0.0}) {
    if (result.failure != RiccatiFailure::no_start) break;
    const std::optional<RealMatrix> other = gain_of_other_weights(e, lift);
    if (other) result = polish(e, *other, RealMatrix());
  }
  return result;
}

// ‖Ω⁻¹‖ ‖Ω‖ of Ω: Z ↦ Z − AᵀZA. Ω⁻¹ keeps definiteness, so that the identity is its worst right-hand side.
// Few digits are enough, but where A is too far from normal for them.
Real stein_condition(const RealMatrix& A) {
  for (const unsigned digits : {20u, Real::default_precision()}) {
    const Digits scope(digits);
    const RealMatrix rounded = in_present_digits(A);
    const std::optional<RealMatrix> worst = solve_stein(rounded, identity(A.rows()));
    if (worst) return norm(*worst) * (1 + norm(rounded) * norm(rounded.transpose()));
  }
  return Real(std::numeric_limits<double>::infinity());
}

// The residual beside the size of its terms.
bool satisfies(const RiccatiEquation& e, const RiccatiResult& result) {
  const RealMatrix right = transpose_congruence(result.closed, result.X) + step_cost(e, result.K);
  const Real size = largest_entry(result.X) * (1 + norm(e.A) * norm(e.A.transpose())) + largest_entry(e.Q);
  return largest_entry(right - result.X) <= negligible(0.5) * size;
}

// s = γ(z − 1)/(z + 1) takes the continuous problem to a discrete one with the same X:
//   A_d = (γ − A)⁻¹(γ + A),  B_d = √(2γ)(γ − A)⁻¹B,  [x; u] = [C_d D_d][x_d; u],
//   C_d = √(2γ)[(γ − A)⁻¹; 0],  D_d = [(γ − A)⁻¹B; I],  [Q N; Nᵀ R]_d = [C_d D_d]ᵀ[Q N; Nᵀ R][C_d D_d].
std::optional<RiccatiEquation> bilinear(const RiccatiEquation& e) {
  const Index nx = e.A.rows(), nu = e.B.cols();
  Real fastest;
  for (const ComplexReal& value : eigenvalues(e.A)) fastest = std::max<Real>(fastest, hypot(value.re, value.im));
  if (fastest < 1e-6 * norm(e.A)) fastest = norm(e.A);
  const Real gamma = fastest.is_zero() ? Real(1) : Real(2 * fastest), root = sqrt(2 * gamma);
  const std::optional<RealMatrix> solved =
      solve(gamma * identity(nx) - e.A, beside(identity(nx), beside(gamma * identity(nx) + e.A, e.B)));
  if (!solved) return std::nullopt;
  const RealMatrix inverse = solved->leftCols(nx), solved_B = solved->rightCols(nu);
  const RealMatrix weights = joint(e.Q, e.N, e.R);
  const RealMatrix outputs = above(beside(root * inverse, solved_B), beside(zeros(nu, nx), identity(nu)));
  const RealMatrix seen = transpose_congruence(outputs, weights);
  return RiccatiEquation{solved->middleCols(nx, nx), root * solved_B, seen.topLeftCorner(nx, nx),
                         seen.bottomRightCorner(nu, nu), seen.topRightCorner(nx, nu)};
}

}  // namespace

std::optional<RealMatrix> solve_stein(const RealMatrix& A, const RealMatrix& Y) {
  RealMatrix power = A, X = Y;
  const Real vanished = negligible(0.5) / 100;
  const Real exploded = power_of_ten(4.0 * Real::default_precision());
  for (int k = 0; k < most_doublings(); ++k) {
    report_progress("Stein equation", k);
    X += transpose_congruence(power, X);
    const Real size = norm(power) * norm(power.transpose());
    if (!(size < exploded)) return std::nullopt;
    if (size < vanished) return X;  // the next power's share is size²
    power = multiply(power, power);
  }
  return std::nullopt;
}

RealMatrix step_cost(const RiccatiEquation& e, const RealMatrix& K) {
  const RealMatrix NK = multiply(e.N, K);
  return e.Q - (NK + NK.transpose()) + transpose_congruence(K, e.R);
}

std::optional<RealMatrix> gain_of(const RiccatiEquation& e, const RealMatrix& X) {
  const RealMatrix XB = multiply(X, e.B);
  const RealMatrix weight = e.R + symmetric_part(transpose_multiply(e.B, XB));
  if (!positive_definite(weight)) return std::nullopt;
  return solve(weight, transpose_multiply(XB, e.A) + e.N.transpose());
}

RiccatiResult solve_discrete_riccati(const RiccatiEquation& e, const RealMatrix& start) {
  RiccatiResult result;
  result.failure = RiccatiFailure::no_start;
  if (start.size() > 0) {
    const RealMatrix X = in_present_digits(start);
    const std::optional<RealMatrix> K = gain_of(e, X);
    if (K) result = polish(e, *K, X);
  }
  if (result.failure != RiccatiFailure::none) result = first_that_stabilises(e);
  if (result.failure != RiccatiFailure::none) return result;
  if (!satisfies(e, result)) result.failure = RiccatiFailure::residual;
  result.condition = stein_condition(result.closed);
  return result;
}

RiccatiResult solve_continuous_riccati(const RiccatiEquation& e, const RealMatrix& start) {
  RiccatiResult result;
  result.failure = RiccatiFailure::not_definite;
  const std::optional<RiccatiEquation> discrete = bilinear(e);
  if (!discrete || !positive_definite(e.R)) return result;
  result = solve_discrete_riccati(*discrete, start);
  if (result.failure != RiccatiFailure::none) return result;
  result.K = *solve(e.R, transpose_multiply(e.B, result.X) + e.N.transpose());
  result.closed = e.A - multiply(e.B, result.K);
  return result;
}

}  // namespace lqg::design
