// SPDX-License-Identifier: MIT
#include "emit/vectors/extended_plant.hpp"

#include <cmath>

#include "controller/model_of.hpp"
#include "step/extended.hpp"

namespace lqg::emit {

namespace {

// E⁻¹ √diag(V), by substitution: E is unit lower triangular.
Eigen::MatrixXd root_of_output_noise(const step::Model<double>& model) {
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(model.ny, model.ny);
  for (int j = 0; j < model.ny; ++j)
    for (int i = j; i < model.ny; ++i) {
      double sum = i == j ? 1 : 0;
      for (int k = j; k < i; ++k) sum -= model.E(i, k) * root(k, j);
      root(i, j) = sum;
    }
  for (int j = 0; j < model.ny; ++j) root.col(j) *= std::sqrt(model.V(j));
  return root;
}

Eigen::VectorXd normal_numbers(Eigen::Index count, simulate::Noise& noise) {
  Eigen::VectorXd out(count);
  for (double& each : out) each = noise.normal();
  return out;
}

}  // namespace

ExtendedPlant::ExtendedPlant(const Controller& controller, std::uint64_t seed_of_noise)
    : model_(
          controller::model_of<double>(controller, [](const design::Real& value) { return design::to_double(value); })),
      noise_(seed_of_noise), x_(controller.x0), of_outputs_(root_of_output_noise(model_)) {}

Eigen::VectorXd ExtendedPlant::measure(const Eigen::VectorXd& u) {
  const auto x = step::variables<double>(x_);
  Eigen::VectorXd y(model_.ny);
  for (int i = 0; i < model_.ny; ++i) {
    const auto& formula = model_.equations->h[static_cast<std::size_t>(i)];
    y(i) = step::value_of_formula<double>(*model_.equations, *formula, x, u).value.value;
  }
  const Eigen::VectorXd drawn = normal_numbers(model_.ny, noise_);
  for (int i = 0; i < model_.ny; ++i)
    for (int j = 0; j <= i; ++j) y(i) += of_outputs_(i, j) * drawn(j);
  return y;
}

void ExtendedPlant::advance(const Eigen::VectorXd& u) {
  step::Listener listener;
  const auto next = step::next_state<double>(*model_.equations, step::variables<double>(x_), u, listener);
  const Eigen::VectorXd drawn = normal_numbers(model_.w.size(), noise_);
  for (int i = 0; i < model_.nx; ++i) {
    x_(i) = next[static_cast<std::size_t>(i)].value.value;
    for (int q = 0; q < drawn.size(); ++q) x_(i) += model_.G(i, q) * std::sqrt(model_.w(q)) * drawn(q);
  }
}

}  // namespace lqg::emit
