// SPDX-License-Identifier: MIT
#include "design/numeric/exact_reach.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

namespace lqg::design {

namespace {

using Eigen::Index;
using Residue = std::uint64_t;  // in [0, prime)
using Vector = std::vector<Residue>;

constexpr int bits = 61;
constexpr Residue prime = (Residue{1} << bits) - 1;

// hi·2⁶⁴ + lo ≡ the sum of its 61-bit digits, from the four products of 32-bit halves.
Residue product(Residue a, Residue b) {
  const Residue mask = 0xFFFFFFFF, a1 = a >> 32, a0 = a & mask, b1 = b >> 32, b0 = b & mask;
  const Residue low = a0 * b0, middle = a1 * b0 + (low >> 32), other = a0 * b1 + (middle & mask);
  const Residue hi = a1 * b1 + (middle >> 32) + (other >> 32), lo = (other << 32) | (low & mask);
  Residue sum = (lo & prime) + ((lo >> bits) | (hi << (64 - bits)));
  sum = (sum & prime) + (sum >> bits);
  return sum == prime ? 0 : sum;
}

Residue difference(Residue a, Residue b) { return a >= b ? a - b : a + (prime - b); }

// a^(prime − 2), Fermat's inverse.
Residue inverse(Residue a) {
  Residue result = 1;
  for (Residue exponent = prime - 2; exponent > 0; exponent >>= 1) {
    if (exponent & 1) result = product(result, a);
    a = product(a, a);
  }
  return result;
}

// x = m 2^e with an integer m; 2⁶¹ ≡ 1.
Residue residue(double x) {
  int exponent = 0;
  const double fraction = std::ldexp(std::frexp(std::abs(x), &exponent), 53);
  const int shift = ((exponent - 53) % bits + bits) % bits;
  const Residue result = product(static_cast<Residue>(fraction), Residue{1} << shift);
  return x < 0 ? difference(0, result) : result;
}

std::vector<Vector> columns_of(const Eigen::MatrixXd& a) {
  std::vector<Vector> columns;
  for (Index j = 0; j < a.cols(); ++j) {
    columns.emplace_back();
    for (Index i = 0; i < a.rows(); ++i) columns.back().push_back(residue(a(i, j)));
  }
  return columns;
}

// Vectors in echelon form: each has a 1 in its pivot, where the later ones have a 0.
class Echelon {
 public:
  // Takes v in, reduced, unless it depends on those that are there.
  void append(Vector v) {
    for (std::size_t k = 0; k < vectors_.size(); ++k) subtract(v, v[pivots_[k]], vectors_[k]);
    std::size_t pivot = 0;
    while (pivot < v.size() && v[pivot] == 0) ++pivot;
    if (pivot == v.size()) return;
    const Residue scale = inverse(v[pivot]);
    for (Residue& entry : v) entry = product(entry, scale);
    pivots_.push_back(pivot);
    vectors_.push_back(std::move(v));
  }
  const std::vector<Vector>& vectors() const { return vectors_; }

 private:
  static void subtract(Vector& v, Residue factor, const Vector& other) {
    if (factor == 0) return;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = difference(v[i], product(factor, other[i]));
  }
  std::vector<Vector> vectors_;
  std::vector<std::size_t> pivots_;
};

Vector times(const std::vector<Vector>& columns, const Vector& v) {
  Vector result(v.size(), 0);
  for (std::size_t j = 0; j < v.size(); ++j)
    for (std::size_t i = 0; i < v.size(); ++i)
      result[i] = difference(result[i], difference(0, product(columns[j][i], v[j])));
  return result;
}

}  // namespace

Index reached_dimension(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  const std::vector<Vector> A_columns = columns_of(A);
  Echelon reached;
  for (const Vector& column : columns_of(B)) reached.append(column);
  for (std::size_t k = 0; k < reached.vectors().size(); ++k) reached.append(times(A_columns, reached.vectors()[k]));
  return static_cast<Index>(reached.vectors().size());
}

}  // namespace lqg::design
