// SPDX-License-Identifier: MIT
#include "random_model.hpp"

#include <Eigen/Eigenvalues>

namespace lqg_test {

namespace {

using lqg::step::strict_triangle;
using lqg::step::triangle;

Matrix<double> random_matrix(Random& random, int rows, int columns, bool is_sparse) {
  Matrix<double> matrix(rows, columns);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      matrix(i, j) = is_sparse && random.one_in(2) ? random.between(-1, 1) : random.uniform();
  return matrix;
}

double spectral_radius(const Matrix<double>& matrix) { return matrix.eigenvalues().cwiseAbs().maxCoeff(); }

Matrix<double> stable_matrix(Random& random, int size, bool is_sparse) {
  const Matrix<double> matrix = random_matrix(random, size, size, is_sparse);
  const double radius = spectral_radius(matrix);
  return radius > 0.88 ? Matrix<double>(matrix * (0.88 / radius)) : matrix;
}

Vector<double> random_variances(Random& random, int size) {
  Vector<double> variances(size);
  for (int i = 0; i < size; ++i) variances(i) = 0.6 + 0.4 * random.uniform();
  return variances;
}

void add_covariance(Random& random, const Shape& shape, Model<double>& model) {
  const int nx = shape.nx;
  model.G = random_matrix(random, nx, shape.nq, shape.is_sparse);
  model.w = random_variances(random, shape.nq);
  model.W = model.G * model.w.asDiagonal() * model.G.transpose();
  Matrix<double> U = Matrix<double>::Identity(nx, nx);
  for (int j = 0; j < nx; ++j)
    for (int k = 0; k < j; ++k) U(k, j) = shape.is_sparse && random.one_in(2) ? 0 : random.uniform();
  const Vector<double> D = random_variances(random, nx);
  const Matrix<double> P = U * D.asDiagonal() * U.transpose();
  model.P0.resize(static_cast<std::size_t>(nx * (nx + 1) / 2));
  model.U0.resize(static_cast<std::size_t>(nx * (nx - 1) / 2));
  model.D0.assign(D.data(), D.data() + nx);
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j <= i; ++j) {
      model.P0[static_cast<std::size_t>(triangle(i, j))] = P(i, j);
      if (j < i) model.U0[static_cast<std::size_t>(strict_triangle(j, i))] = U(j, i);
    }
  (shape.filter == Filter::plain ? model.U0 : model.P0).clear();
  if (shape.filter == Filter::plain) model.D0.clear();
}

void add_decorrelation(Random& random, const Shape& shape, Model<double>& model) {
  model.E = Matrix<double>::Identity(shape.ny, shape.ny);
  for (int i = 0; i < shape.ny && shape.has_E; ++i)
    for (int j = 0; j < i; ++j) model.E(i, j) = random.one_in(3) ? 0 : random.uniform();
  model.V = random_variances(random, shape.ny);
  model.A_free = model.A;
  if (!shape.has_M) return;
  while (spectral_radius(model.A - model.M * model.C) > 0.9) model.M /= 2;
  model.A_free -= model.M * model.C;
}

}  // namespace

Model<double> random_model(Random& random, const Shape& shape) {
  Model<double> model;
  model.filter = shape.filter;
  model.predictor_form = shape.predictor_form;
  model.nx = shape.nx, model.nu = shape.nu, model.ny = shape.ny;
  model.A = stable_matrix(random, shape.nx, shape.is_sparse);
  model.B = random_matrix(random, shape.nx, shape.nu, shape.is_sparse);
  model.C = random_matrix(random, shape.ny, shape.nx, shape.is_sparse);
  model.D = random_matrix(random, shape.ny, shape.has_D ? shape.nu : 0, shape.is_sparse);
  model.M = 0.2 * random_matrix(random, shape.nx, shape.has_M ? shape.ny : 0, shape.is_sparse);
  model.x0 = random_vector<double>(random, shape.nx);
  if (shape.filter == Filter::steady) model.L = 0.2 * random_matrix(random, shape.nx, shape.ny, shape.is_sparse);
  if (shape.filter == Filter::plain || shape.filter == Filter::ud) {
    add_decorrelation(random, shape, model);
    add_covariance(random, shape, model);
  }
  if (shape.has_K) model.K = 0.1 * random_matrix(random, shape.nu, shape.nx, shape.is_sparse);
  if (shape.has_limits) {
    model.u_max = random_variances(random, shape.nu) / 2;
    model.u_min = -random_variances(random, shape.nu) / 2;
  }
  return model;
}

}  // namespace lqg_test
