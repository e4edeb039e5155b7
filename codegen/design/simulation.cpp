#include "design/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "design/linear_algebra.hpp"
#include "design/reference.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

template <class Matrix>
MatrixXd in_double(const Matrix& a) {
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

// What is in force from sample `from` on, in double.
struct Present {
  int from = 0;
  MatrixXd A, B, C, D;
  MatrixXd noise;  // [Gw; v] is this times white noise
  std::optional<SampledCost> cost;
  const OnlineSolution* online = nullptr;
};

// F Fᵀ = [G W Gᵀ, G Swv; Swvᵀ Gᵀ, V]
MatrixXd noise_factor(const SampledPlant& plant, const SampledNoise& noise) {
  return square_root(in_double(joint(congruence(plant.G, noise.W), multiply(plant.G, noise.Swv), noise.V)));
}

Present present(int from, const SampledPlant& plant, const std::optional<SampledNoise>& noise) {
  Present result;
  result.from = from;
  result.A = in_double(plant.A);
  result.B = in_double(plant.B);
  result.C = in_double(plant.C);
  result.D = in_double(plant.D);
  const Index size = plant.A.rows() + plant.C.rows();
  result.noise = noise ? noise_factor(plant, *noise) : MatrixXd::Zero(size, size);
  return result;
}

// One for the beginning and one for each stage.
std::vector<Present> presents_of(const Solution& solution) {
  const Digits scope(solution.numerics.digits);
  std::vector<Present> result{present(0, solution.plant, solution.noise)};
  if (solution.regulator) result[0].cost = solution.regulator->cost;
  if (solution.online) result[0].online = &*solution.online;
  for (const StageSolution& stage : solution.stages) {
    result.push_back(present(stage.from, stage.plant, stage.noise));
    result.back().cost = stage.cost;
    if (stage.online) result.back().online = &*stage.online;
  }
  return result;
}

// White noise made the design's, [Gw; v]; the same numbers are drawn whether it is wanted or not.
VectorXd disturbance(const Present& now, NoiseSource& source) {
  VectorXd white(now.noise.cols());
  for (Index i = 0; i < white.size(); ++i) white(i) = source.normal();
  return times(now.noise, white);
}

// x̂ of the design's filter: with constant or scheduled gains, or with its covariance carried along.
class Filter {
 public:
  Filter(const Problem& problem, const Solution& solution)
      : solution_(solution), x_(padded(problem.estimator->x0, solution.plant.A.rows())) {
    if (solution.online) P_ = in_double(solution.online->P0);
  }

  const VectorXd& estimate() const { return x_; }

  void update(const Present& now, int k, const VectorXd& y, const VectorXd& u) {
    if (now.online) return update_online(*now.online, y, u);
    const VectorXd innovation = y - times(now.C, x_) - times(now.D, u);
    const EstimatorSolution& gains = *solution_.estimator;
    x_ += times(in_double(at_sample(gains.L_schedule, gains.L, k)), innovation);
    moved_ = times(in_double(at_sample(gains.M_schedule, gains.M, k)), innovation);
  }

  void predict(const Present& now, const VectorXd& u) {
    x_ = times(now.A, x_) + times(now.B, u) + moved_;
    if (!now.online) return;
    const MatrixXd A = in_double(now.online->A_free);
    const MatrixXd next = times(times(A, P_), A.transpose()) + in_double(now.online->W);
    P_ = (next + next.transpose()) / 2;  // what is not symmetric would grow as the plant without a filter does
  }

 private:
  // y' = E y,  L = P Cᵀ (C P Cᵀ + V)⁻¹,  x̂ ← x̂ + L (y' − C x̂ − D u),  P ← P − L C P
  void update_online(const OnlineSolution& online, const VectorXd& y, const VectorXd& u) {
    const MatrixXd C = in_double(online.C), CP = times(C, P_);
    const MatrixXd V = in_double(online.V).col(0).asDiagonal();
    const VectorXd measured = times(in_double(online.E), y) - times(in_double(online.D), u);
    const MatrixXd gain = solve_definite(times(CP, C.transpose()) + V, CP).transpose();
    x_ += times(gain, measured - times(C, x_));
    P_ -= times(gain, CP);
    moved_ = times(in_double(online.M), measured - times(C, x_));
  }

  const Solution& solution_;
  MatrixXd P_;
  VectorXd x_, moved_;  // moved_: what the innovation tells of w
};

// u = −K [x̂; ξ; u[k−1]] + Nbar r, a Δu with `input_rate`, within the limits.
class Law {
 public:
  Law(const Problem& problem, const Solution& solution, const SimulationOptions& options)
      : problem_(problem), solution_(solution), options_(options), last_(VectorXd::Zero(solution.plant.B.cols())) {
    if (!problem.regulator) return;
    outputs_ = reference_outputs(problem);
    r_ = padded(options.r, static_cast<Index>(outputs_.size()));
    integral_ = VectorXd::Zero(static_cast<Index>(integrated().size()));
  }

  // u of the sample before.
  const VectorXd& last() const { return last_; }

  VectorXd input(int k, const VectorXd& estimate) {
    if (!solution_.regulator) return options_.input ? options_.input(k) : VectorXd(VectorXd::Zero(last_.size()));
    const RegulatorSolution& regulator = *solution_.regulator;
    const bool has_rate = problem_.regulator->input_rate.size() > 0;
    VectorXd z(estimate.size() + integral_.size() + (has_rate ? last_.size() : 0));
    z.head(estimate.size()) = estimate;
    z.segment(estimate.size(), integral_.size()) = integral_;
    if (has_rate) z.tail(last_.size()) = last_;
    VectorXd u = -times(in_double(at_sample(regulator.K_schedule, regulator.K, k)), z);
    if (regulator.Nbar.size() > 0) u += times(in_double(regulator.Nbar), r_);
    if (has_rate) u += last_;
    return limited(u);
  }

  // ξ⁺ = ξ + T (r − y); u was applied.
  void remember(const VectorXd& y, const VectorXd& u) {
    last_ = u;
    for (Index i = 0; i < integral_.size(); ++i) {
      const int output = integrated()[static_cast<std::size_t>(i)];
      const auto place = std::find(outputs_.begin(), outputs_.end(), output) - outputs_.begin();
      integral_(i) += problem_.plant.sample_time * (r_(place) - y(output));
    }
  }

 private:
  const std::vector<int>& integrated() const { return integrated_outputs(problem_); }

  VectorXd limited(VectorXd u) const {
    if (!problem_.limits) return u;
    const Limits& limits = *problem_.limits;
    for (Index i = 0; i < u.size(); ++i) {
      if (limits.u_rate.size() > 0) {
        const double step = limits.u_rate(i) * problem_.plant.sample_time;
        u(i) = std::min(std::max(u(i), last_(i) - step), last_(i) + step);
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
  VectorXd r_, integral_, last_;
};

// xᵀQx + uᵀRu + 2xᵀNu
double cost_of(const Present& now, const VectorXd& x, const VectorXd& u) {
  if (!now.cost || now.cost->Q.size() == 0) return 0;
  const MatrixXd Qx = times(in_double(now.cost->Q), x), Nu = times(in_double(now.cost->N), u);
  const MatrixXd Ru = times(in_double(now.cost->R), u);
  return times(x.transpose(), Qx + 2 * Nu)(0, 0) + times(u.transpose(), Ru)(0, 0);
}

Trajectory empty_trajectory(const SampledPlant& plant, int samples) {
  Trajectory result;
  result.x = MatrixXd::Zero(plant.A.rows(), samples + 1);
  result.estimate = MatrixXd::Zero(plant.A.rows(), samples);
  result.u = MatrixXd::Zero(plant.B.cols(), samples);
  result.y = MatrixXd::Zero(plant.C.rows(), samples);
  result.cost = VectorXd::Zero(samples);
  return result;
}

}  // namespace

double NoiseSource::uniform() {
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return (static_cast<double>(z >> 12) + 0.5) / 4503599627370496.0;
}

double NoiseSource::normal() {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += uniform();
  return sum;
}

Trajectory simulate(const Problem& problem, const Solution& solution, const SimulationOptions& options) {
  std::vector<Present> presents = presents_of(solution);
  if (!options.noise)
    for (Present& each : presents) each.noise.setZero();
  NoiseSource source(options.seed);
  Trajectory result = empty_trajectory(solution.plant, options.samples);
  Law law(problem, solution, options);
  std::optional<Filter> filter;
  if (solution.estimator || solution.online) filter.emplace(problem, solution);
  const bool answers_at_once = filter && problem.estimator->form == Form::filter;
  const Index nx = solution.plant.A.rows(), ny = solution.plant.C.rows();
  VectorXd x = padded(options.x0, nx);
  result.x.col(0) = x;
  std::size_t stage = 0;
  for (int k = 0; k < options.samples; ++k) {
    if (stage + 1 < presents.size() && presents[stage + 1].from <= k) ++stage;
    const Present& now = presents[stage];
    const VectorXd noise = disturbance(now, source);
    result.estimate.col(k) = filter ? filter->estimate() : x;
    VectorXd u = law.last();  // that acts while y is sampled
    if (!answers_at_once) u = law.input(k, result.estimate.col(k));
    const VectorXd y = times(now.C, x) + times(now.D, u) + noise.tail(ny);
    if (filter) filter->update(now, k, y, u);
    if (answers_at_once) {
      result.estimate.col(k) = filter->estimate();
      u = law.input(k, result.estimate.col(k));
    }
    if (filter) filter->predict(now, u);
    law.remember(y, u);
    result.cost(k) = cost_of(now, x, u);
    x = times(now.A, x) + times(now.B, u) + noise.head(nx);
    result.u.col(k) = u;
    result.y.col(k) = y;
    result.x.col(k + 1) = x;
  }
  return result;
}

}  // namespace lqg::design
