// SPDX-License-Identifier: MIT
#include "design/sampled/anti_windup.hpp"

#include "design/numeric/elimination.hpp"
#include "design/sampled/reference.hpp"

namespace lqg::design {

namespace {

// What ξ sums up, T (C x + D u), of x, or of [x; u[k−1]] with `input_rate`, which v moves by A and B.
struct Integrated {
  RealMatrix A, B, C, D;
};

Integrated integrated_plant(const Problem& problem, const SampledPlant& plant) {
  const Real T(problem.plant.sample_time);
  const RealMatrix C = T * rows_of(plant.C, integrated_outputs(problem)),
                   D = T * rows_of(plant.D, integrated_outputs(problem));
  if (problem.regulator->input_rate.size() == 0) return {plant.A, plant.B, C, D};
  const Index nx = plant.A.rows(), nu = plant.B.cols();
  return {above(beside(plant.A, plant.B), beside(zeros(nu, nx), identity(nu))), above(plant.B, identity(nu)),
          beside(C, D), D};
}

// X with X A = b, where A has all its rank.
std::optional<RealMatrix> solve_from_the_right(const RealMatrix& A, const RealMatrix& b) {
  const Eliminated solved = eliminated(A.transpose(), b.transpose());
  if (solved.rank < A.rows()) return std::nullopt;
  return without_rounding(solved.particular.transpose());
}

}  // namespace

std::optional<RealMatrix> state_share_of_integrals(const Problem& problem, const SampledPlant& plant,
                                                   const RealMatrix& K) {
  const Integrated moves = integrated_plant(problem, plant);
  const Index nx = plant.A.rows(), nxi = moves.C.rows(), last = moves.A.rows() - nx;
  const RealMatrix Kx = beside(K.leftCols(nx), K.rightCols(last)), Kxi = K.middleCols(nx, nxi);
  constexpr int passes = 3;
  RealMatrix Gamma = zeros(nxi, moves.A.rows());
  for (int pass = 0; pass < passes; ++pass) {
    const RealMatrix law = Kx - multiply(Kxi, Gamma);
    const auto share = solve_from_the_right(moves.A - identity(moves.A.rows()) - multiply(moves.B, law),
                                            moves.C - multiply(moves.D, law));
    if (!share) return std::nullopt;
    Gamma = *share;
  }
  return Gamma;
}

RealMatrix anti_windup(const Problem& problem, const SampledPlant& plant, const RealMatrix& Gamma) {
  const Integrated moves = integrated_plant(problem, plant);
  return without_rounding(moves.D - multiply(Gamma, moves.B));
}

}  // namespace lqg::design
