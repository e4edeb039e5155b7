// SPDX-License-Identifier: MIT
#include "design/equations/riccati_flow.hpp"

namespace lqg::design {

namespace {

RealMatrix hamiltonian(const RiccatiEquation& e) {
  const Index nx = e.A.rows();
  const RealMatrix weighed = *solve(e.R, beside(e.B.transpose(), e.N.transpose()));
  const RealMatrix A = e.A - multiply(e.B, weighed.rightCols(nx));
  const RealMatrix G = symmetric_part(multiply(e.B, weighed.leftCols(nx)));
  const RealMatrix Q = symmetric_part(e.Q - multiply(e.N, weighed.rightCols(nx)));
  return above(beside(A, -G), beside(-Q, -A.transpose()));
}

// e^F by its series; ‖F‖ ≤ 1.
RealMatrix short_exponential(const RealMatrix& F) {
  RealMatrix sum = identity(F.rows()) + F, term = F;
  const Real rounding = negligible(1) / 1000;
  for (Index k = 2; norm(term) > rounding; ++k) {
    term = multiply(F, term) / Real(k);
    sum += term;
  }
  return sum;
}

// [x; λ](h) = E [x; λ](0), solved for x(h) = A x(0) − G λ(h), λ(0) = H x(0) + Aᵀλ(h).
std::optional<RiccatiFlow> mixed(const RealMatrix& E) {
  const Index nx = E.rows() / 2;
  const std::optional<RealMatrix> solved =
      solve(E.bottomRightCorner(nx, nx), beside(identity(nx), E.bottomLeftCorner(nx, nx)));
  if (!solved) return std::nullopt;
  const RealMatrix inverse = solved->leftCols(nx);
  return RiccatiFlow{inverse.transpose(), -symmetric_part(multiply(E.topRightCorner(nx, nx), inverse)),
                     -symmetric_part(solved->rightCols(nx))};
}

std::optional<RiccatiFlow> doubled(const RiccatiFlow& flow) {
  const Index nx = flow.A.rows();
  const std::optional<RealMatrix> solved = solve(identity(nx) + multiply(flow.G, flow.H), beside(flow.A, flow.G));
  if (!solved) return std::nullopt;
  const RealMatrix moved = solved->leftCols(nx);
  return RiccatiFlow{multiply(flow.A, moved), flow.G + congruence(flow.A, symmetric_part(solved->rightCols(nx))),
                     flow.H + symmetric_part(transpose_multiply(flow.A, multiply(flow.H, moved)))};
}

}  // namespace

std::optional<RiccatiFlow> riccati_flow(const RiccatiEquation& continuous, const Real& T) {
  const RealMatrix F = hamiltonian(continuous);
  int doublings = 0;
  for (Real reach = 1; reach < norm(F) * T; reach *= 2) ++doublings;
  std::optional<RiccatiFlow> flow = mixed(short_exponential(F * ldexp(T, -doublings)));
  for (int i = 0; flow && i < doublings; ++i) flow = doubled(*flow);
  return flow;
}

std::optional<RealMatrix> carried_back(const RiccatiFlow& flow, const RealMatrix& X) {
  const std::optional<RealMatrix> solved = solve(identity(X.rows()) + multiply(flow.G, X), flow.A);
  if (!solved) return std::nullopt;
  return RealMatrix(flow.H + symmetric_part(transpose_multiply(flow.A, multiply(X, *solved))));
}

}  // namespace lqg::design
