#include "emit/plant_simulation.hpp"

#include <algorithm>
#include <cmath>

#include "design/linear_algebra.hpp"
#include "emit/model_of.hpp"
#include "emit/rounding.hpp"

namespace lqg::emit {

namespace {

using step::Matrix;
using step::Vector;

// Σ_j M_ij x_j in a fixed order, so that every host finds the same bits.
Vector<double> product(const Matrix<double>& M, const Vector<double>& x) {
  Vector<double> y = Vector<double>::Zero(M.rows());
  for (int i = 0; i < M.rows(); ++i)
    for (int j = 0; j < M.cols(); ++j) y(i) += M(i, j) * x(j);
  return y;
}

// F Fᵀ = S, F lower triangular, S positive semidefinite: a column that rounding alone would fill stays 0.
Matrix<double> square_root(const Matrix<double>& S) {
  const int n = static_cast<int>(S.rows());
  Matrix<double> F = Matrix<double>::Zero(n, n);
  for (int j = 0; j < n; ++j) {
    double left = S(j, j);
    for (int k = 0; k < j; ++k) left -= F(j, k) * F(j, k);
    if (left <= 1e-12 * S(j, j)) continue;
    F(j, j) = std::sqrt(left);
    for (int i = j + 1; i < n; ++i) {
      double sum = S(i, j);
      for (int k = 0; k < j; ++k) sum -= F(i, k) * F(j, k);
      F(i, j) = sum / F(j, j);
    }
  }
  return F;
}

design::RealMatrix joint(const design::RealMatrix& W, const design::RealMatrix& Swv, const design::RealMatrix& V) {
  design::RealMatrix all(W.rows() + V.rows(), W.rows() + V.rows());
  all << W, Swv, Swv.transpose(), V;
  return all;
}

// An observer's design says nothing of noise; some there has to be, or nothing moves.
design::RealMatrix assumed_noise(const design::SampledPlant& plant) {
  constexpr double variance = 1e-4;
  return design::identity(plant.A.rows() + plant.C.rows()) * design::Real(variance);
}

// Of G w and v.
Matrix<double> joint_covariance(const Controller& controller) {
  const design::Solution& solution = controller.solution;
  const design::Digits digits(std::max(solution.numerics.digits, 50u));
  design::RealMatrix all;
  if (const auto& online = solution.online) {  // v = E⁻¹ v', w = M v' + the noise that v' does not tell
    const design::RealMatrix V = online->V.asDiagonal(), MV = design::multiply(online->M, V);
    const design::RealMatrix inverse = *design::solve(online->E, design::identity(V.rows()));
    all = joint(online->W + design::multiply_transpose(MV, online->M), design::multiply_transpose(MV, inverse),
                design::congruence(inverse, V));
  } else if (solution.estimator->noise.V.size() == 0) {
    all = assumed_noise(solution.plant);
  } else {
    const design::SampledNoise& noise = solution.estimator->noise;
    const design::RealMatrix& G = solution.plant.G;
    all = joint(design::congruence(G, noise.W), design::multiply(G, noise.Swv), noise.V);
  }
  return convert<double>(all, design::to_double);
}

}  // namespace

double Noise::uniform() {  // splitmix64 (Steele, Lea and Flood 2014)
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return (static_cast<double>(z >> 11) + 0.5) / 9007199254740992.0 - 0.5;
}

double Noise::normal() {
  double sum = 0;
  for (int i = 0; i < 12; ++i) sum += uniform();
  return sum;
}

PlantSimulation::PlantSimulation(const Controller& controller, std::uint64_t seed)
    : noise_(seed),
      A_(convert<double>(controller.solution.plant.A, design::to_double)),
      B_(convert<double>(controller.solution.plant.B, design::to_double)),
      C_(convert<double>(controller.solution.plant.C, design::to_double)),
      D_(convert<double>(controller.solution.plant.D, design::to_double)),
      factor_(square_root(joint_covariance(controller))),
      x_(controller.x0()) {}

Vector<double> PlantSimulation::measure(const Vector<double>& u) {
  Vector<double> white(factor_.rows());
  for (int i = 0; i < white.size(); ++i) white(i) = noise_.normal();
  drawn_ = product(factor_, white);
  return product(C_, x_) + product(D_, u) + drawn_.tail(C_.rows());
}

void PlantSimulation::advance(const Vector<double>& u) {
  x_ = product(A_, x_) + product(B_, u) + drawn_.head(A_.rows());
}

}  // namespace lqg::emit
