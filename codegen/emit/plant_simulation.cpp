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
Matrix<double> joint_covariance(const Controller& controller, std::size_t sample) {
  const design::Solution& solution = controller.solution;
  const design::Digits digits(std::max(solution.numerics.digits, 50u));
  design::RealMatrix all;
  if (solution.online) {  // v = E⁻¹ v', w = M v' + the noise that v' does not tell
    const design::OnlineSolution& online = controller.online_at(sample);
    const design::RealMatrix V = online.V.asDiagonal(), MV = design::multiply(online.M, V);
    const design::RealMatrix inverse = *design::solve(online.E, design::identity(V.rows()));
    all = joint(online.W + design::multiply_transpose(MV, online.M), design::multiply_transpose(MV, inverse),
                design::congruence(inverse, V));
  } else if (solution.estimator->noise.V.size() == 0) {
    all = assumed_noise(solution.plant);
  } else {
    const design::SampledNoise& noise = controller.noise_at(sample);
    const design::RealMatrix& G = controller.plant_at(sample).G;
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
    : noise_(seed), starts_(controller.stage_starts()), x_(controller.x0()) {
  for (const std::size_t start : starts_) {
    const design::SampledPlant& plant = controller.plant_at(start);
    const auto in_doubles = [](const design::RealMatrix& matrix) { return convert<double>(matrix, design::to_double); };
    stages_.push_back({in_doubles(plant.A), in_doubles(plant.B), in_doubles(plant.C), in_doubles(plant.D),
                       square_root(joint_covariance(controller, start))});
  }
}

const PlantSimulation::Stage& PlantSimulation::stage() const {
  std::size_t at = 0;
  while (at + 1 < starts_.size() && starts_[at + 1] <= sample_) ++at;
  return stages_[at];
}

Vector<double> PlantSimulation::measure(const Vector<double>& u) {
  const Stage& now = stage();
  Vector<double> white(now.factor.rows());
  for (int i = 0; i < white.size(); ++i) white(i) = noise_.normal();
  drawn_ = product(now.factor, white);
  return product(now.C, x_) + product(now.D, u) + drawn_.tail(now.C.rows());
}

void PlantSimulation::advance(const Vector<double>& u) {
  const Stage& now = stage();
  x_ = product(now.A, x_) + product(now.B, u) + drawn_.head(now.A.rows());
  ++sample_;
}

}  // namespace lqg::emit
