// SPDX-License-Identifier: MIT
#include "design/checks/well_posed.hpp"
#include "design/numeric/factor.hpp"
#include "design/numeric/poles.hpp"
#include "design/rounding.hpp"
#include "design/sampled/noise.hpp"
#include "design/sampled/weights.hpp"

namespace lqg::design {

namespace {

Real least_eigenvalue(const RealMatrix& weight) {
  Real least;
  for (const ComplexReal& value : eigenvalues(weight)) least = std::min<Real>(least, value.re);
  return least;
}

// The matrix is not positive semidefinite by more than what typing rounded numbers explains, whatever the units of
// its rows, or what computing it in double leaves beside its norm.
bool is_indefinite(const RealMatrix& weight) {
  if (positive_definite(weight) || least_scaled_eigenvalue(weight) >= -1e-9) return false;
  return least_eigenvalue(weight) < -2.3e-16 * static_cast<double>(weight.rows()) * norm(weight);
}

void check_symmetric(const Eigen::MatrixXd& a, const std::string& key, Findings& findings) {
  if (a != a.transpose()) add_error(findings, key, "expected a symmetric matrix");
}

// Errors at `key_a` or `key_b` for one alone, at `key_cross` when only the two together are indefinite.
void check_joint(const RealMatrix& a, const RealMatrix& cross, const RealMatrix& b, const std::string& key_a,
                 const std::string& key_cross, const std::string& key_b, Findings& findings) {
  const std::string expected = "expected a positive semidefinite matrix, found the eigenvalue ";
  const std::size_t before = findings.size();
  for (const auto& [matrix, key] : {std::make_pair(&a, &key_a), std::make_pair(&b, &key_b)})
    if (is_indefinite(*matrix))
      add_error(findings, *key, expected + short_number(to_double(least_eigenvalue(*matrix))));
  if (findings.size() == before && is_indefinite(joint(a, cross, b)))
    add_error(findings, key_cross, "with this cross term the weights together are not positive semidefinite");
}

}  // namespace

void check_symmetry(const Problem& problem, Findings& findings) {
  if (has_cost(problem.regulator)) {
    const Regulator& lqr = *problem.regulator;
    check_symmetric(lqr.Q, "lqr.Q", findings);
    check_symmetric(lqr.R, "lqr.R", findings);
    check_symmetric(lqr.Q_output, "lqr.Q_output", findings);
    check_symmetric(lqr.Q_final, "lqr.Q_final", findings);
    check_symmetric(lqr.input_rate, "lqr.input_rate", findings);
    if (lqr.integral) check_symmetric(lqr.integral->Q, "lqr.integral", findings);
  }
  if (!has_noise(problem.estimator)) return;
  check_symmetric(problem.estimator->W, "kalman.process_noise", findings);
  check_symmetric(problem.estimator->V, "kalman.measurement_noise", findings);
  check_symmetric(problem.estimator->P0, "kalman.initial_covariance", findings);
}

namespace {

void check_semidefinite(const Eigen::MatrixXd& a, const std::string& key, Findings& findings) {
  if (a.size() > 0 && is_indefinite(real(a))) add_error(findings, key, "expected a positive semidefinite matrix");
}

void check_regulator_definiteness(const Problem& problem, Findings& findings) {
  const Regulator& lqr = *problem.regulator;
  const SampledCost weights = weights_of(problem);
  check_joint(weights.Q, weights.N, weights.R, "lqr.Q", "lqr.N", "lqr.R", findings);
  if (lqr.cost == Cost::continuous && !positive_definite(weights.R))
    add_error(findings, "lqr.R", "expected a positive definite matrix: the continuous gain needs its inverse");
  check_semidefinite(lqr.Q_output, "lqr.Q_output", findings);
  check_semidefinite(lqr.Q_final, "lqr.Q_final", findings);
  check_semidefinite(lqr.input_rate, "lqr.input_rate", findings);
  if (lqr.integral) check_semidefinite(lqr.integral->Q, "lqr.integral", findings);
}

// The first output whose noise is none, or follows from that of the outputs before it.
void check_measurement_noise(const Plant& plant, const RealMatrix& V, Findings& findings) {
  const Factors factors = lower_factors(V);
  for (Index i = 0; i < V.rows(); ++i) {
    if (factors.d(i) > 0) continue;
    const std::size_t k = static_cast<std::size_t>(i);
    const std::string name = k < plant.outputs.size() ? plant.outputs[k].name : "y" + std::to_string(i);
    return add_error(findings, "kalman.measurement_noise",
                     "expected a positive definite matrix: every output needs some noise of its own, " + name +
                         (V(i, i) > 0 ? " has only that of the outputs before it" : " has none"));
  }
}

void check_estimator_definiteness(const Problem& problem, Findings& findings) {
  const Estimator& kalman = *problem.estimator;
  check_joint(real(kalman.W), real(kalman.Swv), real(kalman.V), "kalman.process_noise", "kalman.cross_noise",
              "kalman.measurement_noise", findings);
  if (!has_error(findings)) check_measurement_noise(problem.plant, noise_of(problem).V, findings);
  if (kalman.gain != Gain::steady) check_semidefinite(kalman.P0, "kalman.initial_covariance", findings);
}

}  // namespace

void check_definiteness(const Problem& problem, Findings& findings) {
  if (has_cost(problem.regulator)) check_regulator_definiteness(problem, findings);
  if (has_noise(problem.estimator)) check_estimator_definiteness(problem, findings);
}

}  // namespace lqg::design
