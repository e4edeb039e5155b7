// SPDX-License-Identifier: MIT
// Random controllers, and what the tests of a step do with their states.
#pragma once

#include <cmath>
#include <vector>

#include "../random.hpp"
#include "step/loop.hpp"

namespace lqg_test {

using lqg::step::Filter;
using lqg::step::Fused;
using lqg::step::Matrix;
using lqg::step::Model;
using lqg::step::State;
using lqg::step::Vector;

struct Shape {
  Filter filter = Filter::none;
  bool predictor_form = false;
  int nx = 1, nu = 1, ny = 1, nq = 1;
  bool has_D = false, has_M = false, has_E = false, has_K = false, has_limits = false;
  bool is_sparse = false;  // half of all entries are 0, 1 or −1
};

// Everything that the filter needs: numbers of double, the poles of A and of A_free = A − M C within a circle of 0.9,
// W = G diag(w) Gᵀ, P0 = U0 diag(D0) U0ᵀ.
Model<double> random_model(Random& random, const Shape& shape);

inline double to_double(double value) { return value; }
inline double to_double(float value) { return static_cast<double>(value); }
template <class T>
double to_double(Fused<T> value) {
  return static_cast<double>(value.value);
}

template <class T>
struct Real {
  using type = T;
};
template <class T>
struct Real<Fused<T>> {
  using type = T;
};
// float or double, where S may be fused.
template <class S>
using real_of = typename Real<S>::type;

// The number of the target nearest to `value`.
template <class S>
S rounded(double value) {
  return S(static_cast<real_of<S>>(value));
}

template <class S, class From>
Matrix<S> convert(const From& from) {
  Matrix<S> to(from.rows(), from.cols());
  for (int i = 0; i < from.rows(); ++i)
    for (int j = 0; j < from.cols(); ++j) to(i, j) = rounded<S>(from(i, j));
  return to;
}

template <class S>
std::vector<S> convert(const std::vector<double>& from) {
  std::vector<S> to;
  for (const double value : from) to.push_back(rounded<S>(value));
  return to;
}

template <class S>
Model<S> convert(const Model<double>& from) {
  Model<S> to;
  to.filter = from.filter;
  to.predictor_form = from.predictor_form;
  to.nx = from.nx, to.nu = from.nu, to.ny = from.ny;
  to.A = convert<S>(from.A), to.B = convert<S>(from.B), to.C = convert<S>(from.C), to.D = convert<S>(from.D);
  to.L = convert<S>(from.L), to.M = convert<S>(from.M), to.E = convert<S>(from.E), to.V = convert<S>(from.V);
  to.A_free = convert<S>(from.A_free), to.W = convert<S>(from.W), to.G = convert<S>(from.G), to.w = convert<S>(from.w);
  to.x0 = convert<S>(from.x0), to.K = convert<S>(from.K);
  to.u_min = convert<S>(from.u_min), to.u_max = convert<S>(from.u_max);
  to.P0 = convert<S>(from.P0), to.U0 = convert<S>(from.U0), to.D0 = convert<S>(from.D0);
  return to;
}

// All numbers of a state, one after the other.
template <class S>
std::vector<double> numbers(const State<S>& state) {
  std::vector<double> all;
  const auto add = [&](const auto& values) {
    for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(values.size()); ++i)
      all.push_back(to_double(values[static_cast<std::size_t>(i)]));
  };
  const auto add_vector = [&](const Vector<S>& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) all.push_back(to_double(values(i)));
  };
  add_vector(state.x);
  add(state.P);
  add(state.U);
  add(state.D);
  add_vector(state.u);
  add_vector(state.innovation);
  return all;
}

// The covariance that a state stands for.
template <class S>
Matrix<double> covariance(const Model<S>& model, const State<S>& state) {
  using namespace lqg::step;
  const int nx = model.nx;
  Matrix<double> P = Matrix<double>::Zero(nx, nx), U = Matrix<double>::Identity(nx, nx), D = P;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < nx; ++j) {
      if (model.filter == Filter::plain) P(i, j) = to_double(state.P[static_cast<std::size_t>(triangle(i, j))]);
      if (model.filter == Filter::ud && i < j)
        U(i, j) = to_double(state.U[static_cast<std::size_t>(strict_triangle(i, j))]);
      if (model.filter == Filter::ud && i == j) D(i, i) = to_double(state.D[static_cast<std::size_t>(i)]);
    }
  return model.filter == Filter::ud ? Matrix<double>(U * D * U.transpose()) : P;
}

template <class S>
Vector<S> random_vector(Random& random, int size) {
  Vector<S> values(size);
  for (int i = 0; i < size; ++i) values(i) = rounded<S>(random.normal());
  return values;
}

}  // namespace lqg_test
