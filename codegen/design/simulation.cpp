#include "design/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "design/linear_algebra.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd in_double(const RealMatrix& a) {
  MatrixXd result(a.rows(), a.cols());
  for (Index i = 0; i < a.size(); ++i) result.data()[i] = to_double(a.data()[i]);
  return result;
}

// Products with every sum in ascending order.
MatrixXd times(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd result = MatrixXd::Zero(a.rows(), b.cols());
  for (Index i = 0; i < a.rows(); ++i)
    for (Index j = 0; j < b.cols(); ++j)
      for (Index k = 0; k < a.cols(); ++k) result(i, j) += a(i, k) * b(k, j);
  return result;
}

// F Fᵀ = S, F lower triangular, S positive semidefinite: a column that rounding alone would fill stays 0.
MatrixXd square_root(const MatrixXd& S) {
  MatrixXd F = MatrixXd::Zero(S.rows(), S.rows());
  for (Index j = 0; j < S.rows(); ++j) {
    double left = S(j, j);
    for (Index k = 0; k < j; ++k) left -= F(j, k) * F(j, k);
    if (left <= 1e-12 * S(j, j)) continue;
    F(j, j) = std::sqrt(left);
    for (Index i = j + 1; i < S.rows(); ++i) {
      double sum = S(i, j);
      for (Index k = 0; k < j; ++k) sum -= F(i, k) * F(j, k);
      F(i, j) = sum / F(j, j);
    }
  }
  return F;
}

// a⁻¹ b for a symmetric positive definite a, by its square root.
MatrixXd solve_definite(const MatrixXd& a, MatrixXd b) {
  const MatrixXd F = square_root(a);
  const Index n = a.rows();
  for (Index j = 0; j < b.cols(); ++j) {
    for (Index i = 0; i < n; ++i) {
      for (Index k = 0; k < i; ++k) b(i, j) -= F(i, k) * b(k, j);
      b(i, j) /= F(i, i);
    }
    for (Index i = n - 1; i >= 0; --i) {
      for (Index k = i + 1; k < n; ++k) b(i, j) -= F(k, i) * b(k, j);
      b(i, j) /= F(i, i);
    }
  }
  return b;
}

VectorXd padded(const VectorXd& x, Index size) {
  VectorXd result = VectorXd::Zero(size);
  result.head(std::min(size, x.size())) = x.head(std::min(size, x.size()));
  return result;
}

const RealMatrix& at_sample(const std::vector<RealMatrix>& schedule, const RealMatrix& then, int k) {
  return static_cast<std::size_t>(k) < schedule.size() ? schedule[static_cast<std::size_t>(k)] : then;
}

struct Model {
  MatrixXd A, B, C, D;
};

Model model_of(const SampledPlant& plant) {
  return {in_double(plant.A), in_double(plant.B), in_double(plant.C), in_double(plant.D)};
}

// The noise of a sample, [Gw; v].
class Disturbance {
 public:
  Disturbance(const Solution& solution, const SimulationOptions& options)
      : source_(options.seed), size_(solution.plant.A.rows() + solution.plant.C.rows()) {
    if (!options.noise || !solution.noise) return;
    const Digits scope(solution.numerics.digits);
    const SampledNoise& noise = *solution.noise;
    const RealMatrix cross = multiply(solution.plant.G, noise.Swv);
    factor_ = square_root(in_double(above(beside(congruence(solution.plant.G, noise.W), cross),
                                          beside(cross.transpose(), noise.V))));
  }

  VectorXd next() {
    if (factor_.size() == 0) return VectorXd::Zero(size_);
    VectorXd white(size_);
    for (Index i = 0; i < size_; ++i) white(i) = source_.normal();
    return times(factor_, white);
  }

 private:
  NoiseSource source_;
  Index size_;
  MatrixXd factor_;
};

// x̂ of the design's filter: with constant or scheduled gains, or with its covariance carried along.
class Filter {
 public:
  Filter(const Problem& problem, const Solution& solution, Model model)
      : solution_(solution), model_(std::move(model)), x(padded(problem.estimator->x0, model_.A.rows())) {
    if (solution.online) P_ = in_double(solution.online->P0);
  }

  void update(int k, const VectorXd& y, const VectorXd& u) {
    if (solution_.online) return update_online(y, u);
    innovation_ = y - times(model_.C, x) - times(model_.D, u);
    const EstimatorSolution& gains = *solution_.estimator;
    x += times(in_double(at_sample(gains.L_schedule, gains.L, k)), innovation_);
    moved_ = times(in_double(at_sample(gains.M_schedule, gains.M, k)), innovation_);
  }

  void predict(const VectorXd& u) {
    x = times(model_.A, x) + times(model_.B, u) + moved_;
    if (!solution_.online) return;
    const MatrixXd A = in_double(solution_.online->A_free);
    P_ = times(times(A, P_), A.transpose()) + in_double(solution_.online->W);
  }

 private:
  void update_online(const VectorXd& y, const VectorXd& u) {
    const OnlineSolution& online = *solution_.online;
    const MatrixXd C = in_double(online.C), CP = times(C, P_);
    const MatrixXd V = in_double(RealMatrix(online.V)).col(0).asDiagonal();
    const VectorXd expected = times(in_double(online.D), u), measured = times(in_double(online.E), y) - expected;
    const MatrixXd gain = solve_definite(times(CP, C.transpose()) + V, CP).transpose();
    x += times(gain, measured - times(C, x));
    P_ -= times(gain, CP);
    moved_ = times(in_double(online.M), measured - times(C, x));
  }

  const Solution& solution_;
  Model model_;
  MatrixXd P_;
  VectorXd innovation_, moved_;

 public:
  VectorXd x;
};

// u = −K [x̂; ξ; u[k−1]] + Nbar r, a Δu with `input_rate`, within the limits.
class Law {
 public:
  Law(const Problem& problem, const Solution& solution, const SimulationOptions& options)
      : problem_(problem), solution_(solution), options_(options), last(VectorXd::Zero(solution.plant.B.cols())) {
    if (!problem.regulator) return;
    std::set<int> followed(problem.regulator->track.begin(), problem.regulator->track.end());
    if (problem.regulator->integral)
      followed.insert(problem.regulator->integral->outputs.begin(), problem.regulator->integral->outputs.end());
    outputs_.assign(followed.begin(), followed.end());
    r_ = padded(options.r, static_cast<Index>(outputs_.size()));
    integral_ = VectorXd::Zero(static_cast<Index>(integrated().size()));
  }

  VectorXd input(int k, const VectorXd& estimate) {
    if (!solution_.regulator) return options_.input ? options_.input(k) : VectorXd(VectorXd::Zero(last.size()));
    const RegulatorSolution& regulator = *solution_.regulator;
    const bool has_rate = problem_.regulator->input_rate.size() > 0;
    VectorXd z(estimate.size() + integral_.size() + (has_rate ? last.size() : 0));
    z.head(estimate.size()) = estimate;
    z.segment(estimate.size(), integral_.size()) = integral_;
    if (has_rate) z.tail(last.size()) = last;
    VectorXd u = -times(in_double(at_sample(regulator.K_schedule, regulator.K, k)), z);
    if (regulator.Nbar.size() > 0) u += times(in_double(regulator.Nbar), r_);
    if (has_rate) u += last;
    return limited(u);
  }

  // ξ⁺ = ξ + T (r − y)
  void integrate(const VectorXd& y) {
    for (Index i = 0; i < integral_.size(); ++i) {
      const int output = integrated()[static_cast<std::size_t>(i)];
      const auto place = std::find(outputs_.begin(), outputs_.end(), output) - outputs_.begin();
      integral_(i) += problem_.plant.sample_time * (r_(place) - y(output));
    }
  }

 private:
  const std::vector<int>& integrated() const {
    static const std::vector<int> none;
    return problem_.regulator && problem_.regulator->integral ? problem_.regulator->integral->outputs : none;
  }

  VectorXd limited(VectorXd u) const {
    if (!problem_.limits) return u;
    const Limits& limits = *problem_.limits;
    for (Index i = 0; i < u.size(); ++i) {
      if (limits.u_rate.size() > 0) {
        const double step = limits.u_rate(i) * problem_.plant.sample_time;
        u(i) = std::min(std::max(u(i), last(i) - step), last(i) + step);
      }
      if (limits.u_min.size() > 0) u(i) = std::max(u(i), limits.u_min(i));
      if (limits.u_max.size() > 0) u(i) = std::min(u(i), limits.u_max(i));
    }
    return u;
  }

  const Problem& problem_;
  const Solution& solution_;
  const SimulationOptions& options_;
  std::vector<int> outputs_;  // that follow r
  VectorXd r_, integral_;

 public:
  VectorXd last;
};

double cost_of(const SampledCost& cost, const VectorXd& x, const VectorXd& u) {
  if (cost.Q.size() == 0 || cost.Q.rows() != x.size() || cost.R.rows() != u.size()) return 0;
  const MatrixXd Qx = times(in_double(cost.Q), x), Ru = times(in_double(cost.R), u), Nu = times(in_double(cost.N), u);
  return times(x.transpose(), Qx + 2 * Nu)(0, 0) + times(u.transpose(), Ru)(0, 0);
}

Trajectory empty_trajectory(const Model& plant, int samples) {
  Trajectory result;
  result.x = MatrixXd::Zero(plant.A.rows(), samples + 1);
  result.estimate = MatrixXd::Zero(plant.A.rows(), samples);
  result.u = MatrixXd::Zero(plant.B.cols(), samples);
  result.y = MatrixXd::Zero(plant.C.rows(), samples);
  return result;
}

}  // namespace

double NoiseSource::uniform() {
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return (static_cast<double>(z >> 11) + 0.5) / 9007199254740992.0;
}

double NoiseSource::normal() {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += uniform();
  return sum;
}

Trajectory simulate(const Problem& problem, const Solution& solution, const SimulationOptions& options) {
  const Model plant = model_of(solution.plant);
  const Index nx = plant.A.rows(), ny = plant.C.rows();
  Trajectory result = empty_trajectory(plant, options.samples);
  Disturbance disturbance(solution, options);
  Law law(problem, solution, options);
  std::optional<Filter> filter;
  if (solution.estimator || solution.online) filter.emplace(problem, solution, plant);
  const bool answers_at_once = filter && problem.estimator->form == Form::filter;
  VectorXd x = padded(options.x0, nx);
  result.x.col(0) = x;
  for (int k = 0; k < options.samples; ++k) {
    const VectorXd noise = disturbance.next();
    VectorXd u = law.last;  // that acts while y is sampled
    if (!answers_at_once) u = law.input(k, filter ? filter->x : x);
    if (!answers_at_once) result.estimate.col(k) = filter ? filter->x : x;
    const VectorXd y = times(plant.C, x) + times(plant.D, u) + noise.tail(ny);
    if (filter) filter->update(k, y, u);
    if (answers_at_once) result.estimate.col(k) = filter->x;
    if (answers_at_once) u = law.input(k, filter->x);
    if (filter) filter->predict(u);
    law.integrate(y);
    law.last = u;
    if (solution.regulator) result.cost += cost_of(solution.regulator->cost, x, u);
    x = times(plant.A, x) + times(plant.B, u) + noise.head(nx);
    result.u.col(k) = u;
    result.y.col(k) = y;
    result.x.col(k + 1) = x;
  }
  return result;
}

}  // namespace lqg::design
