#include "design/open_loop.hpp"

namespace lqg::design {

namespace {

// The filter form with D: the states p and q, the last ū and u, too; ν has D(p − q) more.
OpenLoop with_kept_inputs(const OpenLoop& loop, const RealMatrix& D, const RealMatrix& KL,
                          const RealMatrix& drive) {
  const Index nz = loop.A.rows(), nu = loop.B.cols();
  const RealMatrix sees = beside(D, -D), answer = beside(loop.C, multiply(KL, sees));
  const RealMatrix moved = above(zeros(nz - drive.rows(), 2 * nu), multiply(drive, sees));
  const RealMatrix A = above(beside(loop.A, moved), above(zeros(nu, nz + 2 * nu), -answer));
  return {A, above(loop.B, above(identity(nu), zeros(nu, nu))), answer};
}

}  // namespace

OpenLoop open_loop(const Problem& problem, const Solution& solution) {
  const SampledPlant& plant = solution.plant;
  const RealMatrix& K = solution.regulator->K;
  if (!solution.estimator) return {plant.A, plant.B, K};
  const Index nx = plant.A.rows(), nu = plant.B.cols();
  const EstimatorSolution& filter = *solution.estimator;
  const RealMatrix closed = plant.A - multiply(plant.B, K);
  if (problem.estimator->form == Form::predictor) {
    // x⁺ = Ax + Bū;  x̂⁺ = (A − BK − L_p C)x̂ + L_p C x + L_p D(ū − u),  u = −Kx̂
    const RealMatrix LpC = multiply(filter.L_predictor, plant.C), LpD = multiply(filter.L_predictor, plant.D);
    return {above(beside(plant.A, zeros(nx, nx)), beside(LpC, closed - LpC + multiply(LpD, K))),
            above(plant.B, LpD), beside(zeros(nu, nx), K)};
  }
  // ν = C(x − x̂);  u = −K(x̂ + Lν);  x̂⁺ = (A − BK)(x̂ + Lν) + Mν
  const RealMatrix sees = beside(plant.C, -plant.C);
  const RealMatrix answer = beside(zeros(nu, nx), K) + multiply(multiply(K, filter.L), sees);
  const RealMatrix drive = multiply(closed, filter.L) + filter.M;
  const RealMatrix A =
      above(beside(plant.A, zeros(nx, nx)), beside(zeros(nx, nx), closed) + multiply(drive, sees));
  const RealMatrix B = above(plant.B, zeros(nx, nu));
  return is_zero(plant.D) ? OpenLoop{A, B, answer}
                          : with_kept_inputs({A, B, answer}, plant.D, multiply(K, filter.L), drive);
}

}  // namespace lqg::design
