// SPDX-License-Identifier: MIT
#include "design/least_squares.hpp"

#include "design/numeric/exact_reach.hpp"
#include "design/numeric/factor.hpp"
#include "design/numeric/modes.hpp"
#include "design/numeric/ziv_test.hpp"

namespace lqg::design {

namespace {

std::string text_of(Index count) { return std::to_string(count); }

void check_shapes(const Eigen::MatrixXd& C, const Eigen::MatrixXd& V, const Eigen::VectorXd& y, Findings& findings) {
  if (!C.allFinite() || !V.allFinite() || !y.allFinite()) add_error(findings, "y", "expected finite numbers");
  if (C.cols() == 0) add_error(findings, "C", "expected a column for every unknown, found none");
  if (V.rows() != C.rows() || V.cols() != C.rows())
    add_error(findings, "V", "expected " + text_of(C.rows()) + " rows and columns (ny)");
  else if (V != V.transpose())
    add_error(findings, "V", "expected a symmetric matrix");
  else if (!positive_definite(real(V)))
    add_error(findings, "V", "expected a positive definite matrix: every output needs some noise");
  if (y.size() != C.rows()) add_error(findings, "y", "expected " + text_of(C.rows()) + " entries (ny)");
}

// The unknowns that a change of x which no output shows moves.
std::string undetermined(const Eigen::MatrixXd& C) {
  std::string names;
  for (const Mode& mode : unreached_modes(zeros(C.cols(), C.cols()), real(C.transpose())).modes)
    for (const Index i : mode.states) {
      const std::string name = "x" + text_of(i);
      if ((names + ",").find(name + ",") == std::string::npos) names += (names.empty() ? "" : ", ") + name;
    }
  return names;
}

std::optional<LeastSquares> solve_in_present_digits(const Eigen::MatrixXd& C, const Eigen::MatrixXd& V,
                                                    const Eigen::VectorXd& y) {
  const Index nx = C.cols();
  const RealMatrix seen = real(C);
  const RealMatrix weighed = *solve(real(V), beside(seen, real(y)));
  const std::optional<RealMatrix> both = solve(transpose_multiply(seen, weighed.leftCols(nx)),
                                               beside(transpose_multiply(seen, weighed.rightCols(1)), identity(nx)));
  if (!both) return std::nullopt;
  return LeastSquares{both->col(0), symmetric_part(both->rightCols(nx)), Real::default_precision()};
}

}  // namespace

std::optional<LeastSquares> least_squares(const Eigen::MatrixXd& C, const Eigen::MatrixXd& V, const Eigen::VectorXd& y,
                                          Findings& findings) {
  std::optional<LeastSquares> coarse;
  unsigned coarse_digits = 0;
  for (const unsigned digits : {50u, 100u, 200u, 400u}) {
    const Digits scope(digits);
    if (coarse_digits == 0) {
      check_shapes(C, V, y, findings);
      if (has_error(findings)) return std::nullopt;
      const Index rank = reached_dimension(Eigen::MatrixXd::Zero(C.cols(), C.cols()), C.transpose());
      if (rank < C.cols()) {
        add_error(findings, "C",
                  "has the rank " + text_of(rank) + ", expected " + text_of(C.cols()) +
                      ": the outputs do not determine " + undetermined(C));
        return std::nullopt;
      }
    }
    std::optional<LeastSquares> fine = solve_in_present_digits(C, V, y);
    if (coarse && fine && passes_ziv_test(coarse->x, fine->x, coarse_digits) &&
        passes_ziv_test(coarse->P, fine->P, coarse_digits))
      return fine;
    coarse = std::move(fine);
    coarse_digits = digits;
  }
  add_error(findings, "C", "the unknowns depend on one another so nearly that 400 digits do not settle them");
  return std::nullopt;
}

}  // namespace lqg::design
