// SPDX-License-Identifier: MIT
// What an emitted filter tells of itself beside the estimate: innovation, NIS, and the error that its design promises.
#pragma once

#include <optional>

#include "controller/operating_point.hpp"
#include "controller/stage_in_force.hpp"
#include "design/rounding.hpp"
#include "simulate/emitted_controller.hpp"
#include "simulate/error_covariance.hpp"
#include "simulate/numbers.hpp"
#include "simulate/period.hpp"
#include "step/extended.hpp"

namespace lqg::simulate {

template <class S>
Eigen::MatrixXd kept_covariance_of(const step::Model<S>& model, const step::State<S>& state) {
  const Eigen::Index nx = model.nx;
  if (model.filter == step::Filter::plain) {
    Eigen::MatrixXd P(nx, nx);
    for (int i = 0; i < nx; ++i)
      for (int j = 0; j < nx; ++j) P(i, j) = as_double(state.P[static_cast<std::size_t>(step::triangle(i, j))]);
    return P;
  }
  Eigen::MatrixXd U = Eigen::MatrixXd::Identity(nx, nx), D = Eigen::MatrixXd::Zero(nx, nx);
  for (int j = 0; j < nx; ++j) {
    D(j, j) = as_double(state.D[static_cast<std::size_t>(j)]);
    for (int i = 0; i < j; ++i) U(i, j) = as_double(state.U[static_cast<std::size_t>(step::strict_triangle(i, j))]);
  }
  return ordered_product(ordered_product(U, D), U.transpose());
}

// P of the error of x̂.
template <class S>
Eigen::MatrixXd covariance_of(const Controller& controller, const EmittedController<S>& emitted) {
  const Eigen::MatrixXd P = kept_covariance_of(emitted.model(), emitted.state());
  if (!controller.modal) return P;
  const Eigen::MatrixXd T = design::to_doubles(controller.modal->T);
  return ordered_product(ordered_product(T, P), T.transpose());
}

// Called around each call of the filter, in the order of its form.
class FilterWatch {
 public:
  // The filter keeps x̂.
  explicit FilterWatch(const Controller& controller) : controller_(controller) {
    if (controller::noise_at(controller, 0)) error_.emplace(controller);
  }

  template <class S>
  void before_update(const EmittedController<S>& emitted, const Eigen::VectorXd& y) {
    const Eigen::VectorXd x = as_doubles(emitted.estimated_deviation());
    if (controller::is_extended(controller_))
      hear_by_equations(emitted, y);
    else
      hear_by_matrices(emitted, x, y);
    gain_row_ = emitted.gain_row();
    if (!error_) return;
    error_->go_to(emitted.sample());
    if (carries_covariance(controller_)) error_->set(covariance_of(controller_, emitted));
    S_ = error_->of_innovation(C_);
    if (controller_.is_predictor) keep(x);
  }
  template <class S>
  void after_update(const EmittedController<S>& emitted) {
    std::vector<bool> used = emitted.left_out();
    used.flip();
    if (error_) {
      nis_ = normalised_square(S_, innovation_, used).value;
      if (carries_covariance(controller_))
        error_->set(covariance_of(controller_, emitted));
      else
        error_->update(gain_row_, emitted.left_out());
    }
    if (!controller_.is_predictor) keep(as_doubles(emitted.estimated_deviation()));
  }
  // Of a sample with these events.
  void end_sample(unsigned events) {
    if (!error_ || carries_covariance(controller_)) return;
    if (events >> static_cast<unsigned>(step::Event::state_reset) & 1u)
      error_->begin_anew();
    else
      error_->predict();
  }

  bool knows_its_error() const { return error_.has_value(); }
  const Eigen::VectorXd& innovation() const { return innovation_; }
  double nis() const { return nis_; }
  // That u is made of, the inputs on their way too, from the operating point.
  const Eigen::VectorXd& estimate() const { return estimate_; }
  const Eigen::MatrixXd& P() const { return P_; }  // of its error

 private:
  // y − C x̂ − D u
  template <class S>
  void hear_by_matrices(const EmittedController<S>& emitted, const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    load(controller::plant_at(controller_, emitted.sample()));
    Eigen::VectorXd expected = ordered_image(C_, x);
    if (controller_.has.feedthrough) add_product(D_, as_doubles(emitted.state().u), expected);
    innovation_ = controller::as_deviations(y, controller_.point.y) - expected;
  }
  // y − h(x̂, u), and C, the Jacobian of h there, as the filter makes them.
  template <class S>
  void hear_by_equations(const EmittedController<S>& emitted, const Eigen::VectorXd& y) {
    step::Listener listener;
    const auto outputs = step::outputs_at_estimate(emitted.model(), emitted.state(), numbers_of<S>(y), listener);
    innovation_ = as_doubles(outputs.innovation);
    C_.resize(outputs.C.rows(), outputs.C.cols());
    for (Eigen::Index i = 0; i < C_.rows(); ++i)
      for (Eigen::Index j = 0; j < C_.cols(); ++j) C_(i, j) = as_double(outputs.C(i, j));
  }
  void load(const design::SampledPlant& plant) {
    if (&plant == loaded_) return;
    C_ = design::to_doubles(plant.C), D_ = design::to_doubles(plant.D);
    loaded_ = &plant;
  }
  void keep(const Eigen::VectorXd& x) {
    estimate_ = x;
    if (error_) P_ = error_->P();
  }

  const Controller& controller_;
  const design::SampledPlant* loaded_ = nullptr;
  Eigen::MatrixXd C_, D_, S_, P_;
  std::optional<ErrorCovariance> error_;
  std::size_t gain_row_ = 0;
  Eigen::VectorXd innovation_, estimate_;
  double nis_ = 0;
};

}  // namespace lqg::simulate
