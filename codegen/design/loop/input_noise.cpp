#include "design/loop/input_noise.hpp"

#include "design/rounding.hpp"

namespace lqg::design {

namespace {

using Eigen::MatrixXd;

// P = A P Aᵀ + W by doubling: P ← P + A P Aᵀ, A ← A². 2⁶⁰ samples are all that counts.
MatrixXd steady_covariance(MatrixXd A, MatrixXd P) {
  for (int step = 0; step < 60 && A.cwiseAbs().maxCoeff() > 1e-30; ++step) {
    P += (A * P * A.transpose()).eval();
    A = (A * A).eval();
  }
  return P;
}

}  // namespace

Eigen::VectorXd rms_of_inputs(const Problem& problem, const Samples& samples, const Compensator& controller) {
  const SampledNoise& noise = *samples.noise;
  const ClosedLoop loop = closed_loop(measured_plant(problem, samples.plant), controller);
  const MatrixXd disturbance = to_doubles(joint(noise.W, noise.Swv, noise.V));
  const MatrixXd B = to_doubles(loop.B), C = to_doubles(loop.C), D = to_doubles(loop.D);
  const MatrixXd P = steady_covariance(to_doubles(loop.A), B * disturbance * B.transpose());
  return (C * P * C.transpose() + D * disturbance * D.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
}

}  // namespace lqg::design
