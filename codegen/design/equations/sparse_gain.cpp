// SPDX-License-Identifier: MIT
#include "design/equations/sparse_gain.hpp"

#include <algorithm>

#include "design/numeric/factor.hpp"
#include "design/numeric/modes.hpp"

namespace lqg::design {

namespace {

RealMatrix kept_entries(const Eigen::MatrixXd& kept, const RealMatrix& K) {
  RealMatrix result = zeros(K.rows(), K.cols());
  for (Index i = 0; i < K.size(); ++i)
    if (kept.data()[i] != 0) result.data()[i] = K.data()[i];
  return result;
}

// The kept entries of a matrix as a column, and back.
RealMatrix packed(const Eigen::MatrixXd& kept, const RealMatrix& K) {
  std::vector<Real> entries;
  for (Index i = 0; i < K.size(); ++i)
    if (kept.data()[i] != 0) entries.push_back(K.data()[i]);
  RealMatrix column(static_cast<Index>(entries.size()), 1);
  std::copy(entries.begin(), entries.end(), column.data());
  return column;
}

RealMatrix unpacked(const Eigen::MatrixXd& kept, const RealMatrix& column) {
  RealMatrix result = zeros(kept.rows(), kept.cols());
  Index next = 0;
  for (Index i = 0; i < result.size(); ++i)
    if (kept.data()[i] != 0) result.data()[i] = column(next++, 0);
  return result;
}

// Everything at one stabilising K.
struct Point {
  RealMatrix K, closed;
  RealMatrix X, P;
  RealMatrix weight;    // R + BᵀXB
  RealMatrix residual;  // (R + BᵀXB)K − BᵀXA − Nᵀ = RK − Nᵀ − BᵀX(A − BK)
  Real cost;
};

std::optional<Point> point_at(const StructureProblem& problem, const RealMatrix& K) {
  const RiccatiEquation& e = problem.equation;
  Point point;
  point.K = K;
  point.closed = e.A - multiply(e.B, K);
  const std::optional<RealMatrix> X = solve_stein(point.closed, step_cost(e, K));
  const std::optional<RealMatrix> P = X ? solve_stein(point.closed.transpose(), problem.W) : std::nullopt;
  if (!P) return std::nullopt;
  point.X = *X;
  point.P = *P;
  const RealMatrix XB = multiply(*X, e.B);
  point.weight = e.R + symmetric_part(transpose_multiply(e.B, XB));
  point.residual = multiply(e.R, K) - e.N.transpose() - transpose_multiply(XB, point.closed);
  point.cost = trace_of_product(*X, problem.W);
  return point;
}

// Half of the gradient over the kept entries.
RealMatrix slope(const StructureProblem& problem, const Point& point) {
  return packed(problem.kept, multiply(point.residual, point.P));
}

// The change of that half gradient when K changes by E, with F = A − BK and M the residual:
//   dX = Fᵀ dX F + EᵀM + MᵀE,  dP = F dP Fᵀ − BEPFᵀ − FPEᵀBᵀ,  d(MP) = ((R + BᵀXB)E − Bᵀ dX F)P + M dP.
RealMatrix slope_change(const StructureProblem& problem, const Point& point, const RealMatrix& E) {
  const RiccatiEquation& e = problem.equation;
  const RealMatrix ME = transpose_multiply(point.residual, E);
  const RealMatrix dX = *solve_stein(point.closed, ME + ME.transpose());
  const RealMatrix moved = multiply_transpose(multiply(multiply(e.B, E), point.P), point.closed);
  const RealMatrix dP = -*solve_stein(point.closed.transpose(), moved + moved.transpose());
  const RealMatrix dM = multiply(point.weight, E) - transpose_multiply(e.B, multiply(dX, point.closed));
  return packed(problem.kept, multiply(dM, point.P) + multiply(point.residual, dP));
}

RealMatrix curvature(const StructureProblem& problem, const Point& point) {
  const Index count = packed(problem.kept, point.K).rows();
  RealMatrix result(count, count);
  for (Index j = 0; j < count; ++j)
    result.col(j) = slope_change(problem, point, unpacked(problem.kept, identity(count).col(j)));
  return symmetric_part(result);
}

// The part of the curvature that is never negative, tr(Eᵀ(R + BᵀXB)EP): the measure of a step.
RealMatrix measure(const StructureProblem& problem, const Point& point) {
  const Index count = packed(problem.kept, point.K).rows();
  RealMatrix result(count, count);
  for (Index j = 0; j < count; ++j) {
    const RealMatrix E = unpacked(problem.kept, identity(count).col(j));
    result.col(j) = packed(problem.kept, multiply(multiply(point.weight, E), point.P));
  }
  return result;
}

// Newton steps, damped by a multiple of `measure` that grows until the cost falls: downhill to a minimum, or for
// `most` steps.
Point descend(const StructureProblem& problem, Point point, int most) {
  const Real done = 1e-12;  // of the square root of the cost; the chord steps go on from there
  Real damping = 1;
  for (int step = 0; step < most; ++step) {
    const RealMatrix g = slope(problem, point), H = curvature(problem, point), size = measure(problem, point);
    bool fell = false;
    for (int attempt = 0; attempt < 60 && !fell; ++attempt) {
      const RealMatrix damped = H + damping * size;
      const std::optional<RealMatrix> change = positive_definite(damped) ? solve(damped, -g) : std::nullopt;
      const std::optional<Point> next =
          change ? point_at(problem, point.K + unpacked(problem.kept, *change)) : std::nullopt;
      fell = next && next->cost <= point.cost;
      if (!fell) {
        damping = std::max<Real>(4 * damping, 1e-6);
        continue;
      }
      const Real length = -trace_of_product(change->transpose(), g);
      point = *next;
      damping = damping > 1e-9 ? Real(damping / 10) : Real(0);
      if (length <= done * done * point.cost) return point;
    }
    if (!fell) return point;
  }
  return point;
}

Real radius(const RealMatrix& A) {
  Real largest;
  for (const ComplexReal& value : eigenvalues(A)) largest = std::max<Real>(largest, hypot(value.re, value.im));
  return largest;
}

StructureProblem shrunk(const StructureProblem& problem, const Real& gamma) {
  StructureProblem result = problem;
  result.equation.A /= gamma;
  result.equation.B /= gamma;
  return result;
}

// From the full gain on, its other entries fade away in steps, the kept ones following.
std::optional<Point> faded_in(const StructureProblem& problem, const RealMatrix& full) {
  std::optional<Point> point = point_at(problem, full);
  Real left = 1, step = 0.5;
  while (point && step > 1e-3) {
    const Real next = left > step ? Real(left - step) : Real(0);
    const RealMatrix kept = kept_entries(problem.kept, point->K), others = point->K - kept;
    const std::optional<Point> less = point_at(problem, kept + (next / left) * others);
    if (!less) {
      step /= 2;
      continue;
    }
    if (next.is_zero()) return less;
    point = descend(problem, *less, 5);
    left = next;
    step *= 1.5;
  }
  return std::nullopt;
}

// A stabilising gain of that structure, from the plant shrunk until one stabilises it.
std::optional<Point> grown_into(const StructureProblem& problem, const RealMatrix& full) {
  RealMatrix K = kept_entries(problem.kept, full);
  const RiccatiEquation& e = problem.equation;
  Real gamma = 0;
  for (int stage = 0; stage < 60; ++stage) {
    const Real reach = radius(e.A - multiply(e.B, K));
    if (reach < 1)
      if (const std::optional<Point> found = point_at(problem, K)) return found;
    // Just beyond the poles that the last stage has reached.
    const Real next = reach * 1.05 + 0.001;
    if (stage > 0 && next >= gamma * 0.9999) return std::nullopt;
    gamma = next;
    const StructureProblem easier = shrunk(problem, gamma);
    const std::optional<Point> start = point_at(easier, K);
    if (!start) return std::nullopt;
    K = descend(easier, *start, 15).K;
  }
  return std::nullopt;
}

StructureProblem rounded(const StructureProblem& problem) {
  const RiccatiEquation& e = problem.equation;
  return {{in_present_digits(e.A), in_present_digits(e.B), in_present_digits(e.Q), in_present_digits(e.R),
           in_present_digits(e.N)},
          in_present_digits(problem.W),
          problem.kept};
}

// In few digits: a minimum, or as near as these come.
std::optional<RealMatrix> rough_gain(const StructureProblem& problem, const RealMatrix& full) {
  const Digits few(30);
  const StructureProblem few_digits = rounded(problem);
  std::optional<Point> first = faded_in(few_digits, in_present_digits(full));
  if (!first) first = grown_into(few_digits, in_present_digits(full));
  if (!first) return std::nullopt;
  return descend(few_digits, *first, 200).K;
}

// K ← K − H⁻¹g with H once, in few digits: each step brings about as many digits as H has.
StructuredGain polish(const StructureProblem& problem, RealMatrix K) {
  StructuredGain result;
  result.failure = StructureFailure::not_converged;
  RealMatrix inverse;
  {
    const Digits few(30);
    const StructureProblem few_digits = rounded(problem);
    const std::optional<Point> point = point_at(few_digits, in_present_digits(K));
    if (!point) return result;
    const RealMatrix H = curvature(few_digits, *point);
    const std::optional<RealMatrix> solved = positive_definite(H) ? solve(H, identity(H.rows())) : std::nullopt;
    if (!solved) return result;
    inverse = *solved;
  }
  for (int step = 0; step < 100; ++step) {
    const std::optional<Point> point = point_at(problem, K);
    if (!point) return result;
    const RealMatrix change = multiply(inverse, slope(problem, *point));
    K -= unpacked(problem.kept, change);
    if (!(largest_entry(change) <= negligible(0.75) * largest_entry(K))) continue;
    result.failure = StructureFailure::none;
    result.K = K;
    result.X = point->X;
    return result;
  }
  return result;
}

// Some gain of that structure, as large as moves the poles.
RealMatrix gain_without_pattern(const StructureProblem& problem, const Real& turn) {
  const RealMatrix B = problem.equation.B;
  const Real size = (1 + norm(problem.equation.A)) / (norm(B) + negligible(1));
  RealMatrix K = zeros(B.cols(), B.rows());
  for (Index i = 0; i < K.size(); ++i) K.data()[i] = size * sin(turn * (i + 1) * (i + 2));
  return kept_entries(problem.kept, K);
}

}  // namespace

StructuredGain structured_gain(const StructureProblem& problem, const RealMatrix& full, const RealMatrix& start) {
  if (start.size() > 0) return polish(problem, in_present_digits(start));
  const std::optional<RealMatrix> rough = rough_gain(problem, full);
  if (rough) return polish(problem, in_present_digits(*rough));
  StructuredGain result;
  result.failure = StructureFailure::no_start;
  return result;
}

std::vector<ComplexReal> fixed_unstable_modes(const StructureProblem& problem) {
  const RiccatiEquation& e = problem.equation;
  const Real near = negligible(0.25);
  std::vector<ComplexReal> fixed;
  const auto poles_of = [&](double turn) {
    return eigenvalues(e.A - multiply(e.B, gain_without_pattern(problem, turn)));
  };
  const std::vector<ComplexReal> other = poles_of(1.7);
  for (const ComplexReal& pole : poles_of(0.6))
    if (pole.im >= 0 && on_or_outside_circle(pole) &&
        std::any_of(other.begin(), other.end(), [&](const ComplexReal& z) {
          return hypot(z.re - pole.re, z.im - pole.im) <= near * (1 + hypot(z.re, z.im));
        }))
      fixed.push_back(pole);
  return fixed;
}

}  // namespace lqg::design
