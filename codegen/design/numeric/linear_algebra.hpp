// SPDX-License-Identifier: MIT
// The matrix operations of the design, on Real, compiled once.
//
// Products with an exact zero are skipped, so that structural zeros stay exact zeros and cost nothing.
#pragma once

#include <optional>
#include <vector>

#include "design/numeric/digits.hpp"
#include "design/real.hpp"

namespace lqg::design {

using Eigen::Index;

struct ComplexReal {
  Real re, im;
};

RealMatrix real(const Eigen::MatrixXd& a);
RealMatrix zeros(Index rows, Index columns);
RealMatrix identity(Index size);

// The same values as `a` in the digits in force now (exact when these are not fewer).
RealMatrix in_present_digits(const RealMatrix& a);

// a b, aᵀ b, a bᵀ: each entry one sum in ascending order.
RealMatrix multiply(const RealMatrix& a, const RealMatrix& b);
RealMatrix transpose_multiply(const RealMatrix& a, const RealMatrix& b);
RealMatrix multiply_transpose(const RealMatrix& a, const RealMatrix& b);

// a p aᵀ and aᵀ p a for a symmetric p: the lower triangle is computed, the upper one is its mirror image.
RealMatrix congruence(const RealMatrix& a, const RealMatrix& p);
RealMatrix transpose_congruence(const RealMatrix& a, const RealMatrix& p);

// (a + aᵀ)/2
RealMatrix symmetric_part(const RealMatrix& a);

// [a b]  and  [a; b]
RealMatrix beside(const RealMatrix& a, const RealMatrix& b);
RealMatrix above(const RealMatrix& a, const RealMatrix& b);

// [a cross; crossᵀ b]
RealMatrix joint(const RealMatrix& a, const RealMatrix& cross, const RealMatrix& b);

// [a 0; 0 0] with that many rows and columns.
RealMatrix padded(const RealMatrix& a, Index rows, Index columns);

// a⁻¹ b by elimination with row exchanges; empty when a pivot is exactly zero.
std::optional<RealMatrix> solve(const RealMatrix& a, const RealMatrix& b);

// tr(a b)
Real trace_of_product(const RealMatrix& a, const RealMatrix& b);

// The largest absolute entry, and the largest absolute row sum.
Real largest_entry(const RealMatrix& a);
Real norm(const RealMatrix& a);

bool is_zero(const RealMatrix& a);

// 10^exponent
Real power_of_ten(double exponent);

// What rounding leaves of `fraction` of the digits in force: 10^(−fraction · digits).
Real negligible(double fraction);

// A ← VᵀAV with A(i, j) = 0 for i > j + 1, B ← VᵀB, C ← CV, V orthogonal. B and C may be empty.
void reduce_to_hessenberg(RealMatrix& A, RealMatrix& B, RealMatrix& C);

// All eigenvalues by the Francis QR algorithm, conjugates side by side, positive imaginary part first.
// NaN where the (generous) cap on the sweeps was reached.
std::vector<ComplexReal> eigenvalues(const RealMatrix& a);

}  // namespace lqg::design
