// SPDX-License-Identifier: MIT
#include "simulate/foresight.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "controller/model_of.hpp"
#include "simulate/noise.hpp"
#include "simulate/numbers.hpp"
#include "step/lqr.hpp"

namespace lqg::simulate {

namespace {

using controller::Controller;
using controller::Worth;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int starts = 200;
constexpr double settled = 1e-6;  // of xᵀXx at the start
constexpr double lost = 1e6;

MatrixXd doubles(const design::RealMatrix& values) { return design::to_doubles(values); }

// The emitted law with its limits, clipped or foreseen.
template <class S>
step::Model<S> law_of(const Controller& controller, bool is_clipped) {
  auto model = controller::model_of<S>(controller, constants_of<S>(controller.target));
  model.point = {};  // all of it is in deviations
  if (!is_clipped) return model;
  model.u_min = model.foreseen.low.head(model.nu);
  model.u_max = model.foreseen.high.head(model.nu);
  model.u_step = model.foreseen.u_step;
  model.foreseen = {};
  return model;
}

struct Run {
  double cost = 0, excess = 0;
  bool settles = false;
  int samples = 0;  // until then
  VectorXd reach;   // of the plant's own states
  MatrixXd u, x;
};

class Comparison {
 public:
  explicit Comparison(const Controller& controller)
      : controller_(controller), A_(doubles(controller.solution.plant.A)), B_(doubles(controller.solution.plant.B)),
        C_(doubles(controller.solution.plant.C)), D_(doubles(controller.solution.plant.D)),
        Q_(doubles(controller.solution.regulator->cost.Q)), R_(doubles(controller.solution.regulator->cost.R)),
        N_(doubles(controller.solution.regulator->cost.N)), X_(doubles(controller.solution.regulator->X)),
        clipped_(law_of<double>(controller, true)), optimal_(law_of<double>(controller, false)),
        samples_(samples_to_settle()) {}

  Worth result() {
    Worth worth;
    worth.reach = VectorXd::Zero(own());
    Noise noise(1);
    std::vector<double> ratios;
    std::vector<std::pair<double, VectorXd>> found;
    for (int n = 0; n < starts; ++n) {
      const VectorXd x = start(noise);
      const Run clipped = run(x, clipped_, false), optimal = run(x, optimal_, false);
      if (optimal.settles) worth.reach = worth.reach.cwiseMax(optimal.reach);
      ++worth.starts;
      worth.clipped_settle += clipped.settles;
      worth.optimal_settle += optimal.settles;
      const double ratio = clipped.settles ? clipped.cost / optimal.cost : design::forever;
      if (optimal.settles) found.emplace_back(ratio, x);
      if (!clipped.settles || !optimal.settles) continue;
      ratios.push_back(ratio);
      worth.clipped_excess += clipped.excess;
      worth.optimal_excess += optimal.excess;
    }
    std::sort(ratios.begin(), ratios.end());
    worth.both_settle = static_cast<int>(ratios.size());
    if (!ratios.empty()) {
      worth.median_ratio = ratios[ratios.size() / 2];
      worth.high_ratio = ratios[(ratios.size() - 1) * 99 / 100];
      worth.clipped_excess /= worth.both_settle;
      worth.optimal_excess /= worth.both_settle;
    }
    if (!found.empty()) show(found, worth);
    return worth;
  }

 private:
  Eigen::Index own() const { return controller_.problem.plant.A.rows(); }

  // Until a loop that is slowed down by its limits has settled.
  int samples_to_settle() const {
    double slowest = 0;
    for (const auto& pole : controller_.solution.regulator->poles) slowest = std::max(slowest, std::abs(pole));
    return static_cast<int>(std::clamp(100 / std::max(1 - slowest, 1e-3), 200.0, 5000.0));
  }

  // Equally dear in all directions of the plant's own states, and so far out that the law goes beyond a limit; a state
  // that is limited begins within its limits.
  VectorXd start(Noise& noise) const {
    const Eigen::LLT<MatrixXd> factor(X_.topLeftCorner(own(), own()));
    VectorXd direction(own());
    for (double& entry : direction) entry = noise.normal();
    VectorXd x = VectorXd::Zero(controller_.size.nx);
    x.head(own()) = factor.info() == Eigen::Success ? VectorXd(factor.matrixU().solve(direction)) : direction;
    const double most = std::exp2(2 * (noise.uniform() + 0.5));
    x *= most / share_of_limits(x);
    const Eigen::MatrixXd& range = controller_.problem.limits->states.range;
    for (Eigen::Index i = 0; i < range.rows(); ++i) x(i) = std::clamp(x(i), range(i, 0), range(i, 1));
    return x;
  }

  // The largest of what the law alone does with the limited quantities, as a share of their limits.
  double share_of_limits(const VectorXd& x) const {
    VectorXd s = VectorXd::Zero(optimal_.foreseen.F.cols());
    s.head(x.size()) = x;
    VectorXd z(optimal_.foreseen.low.size());
    z << -(optimal_.K.leftCols(x.size()) * x), optimal_.foreseen.F * s;
    double share = 0;
    for (Eigen::Index i = 0; i < z.size(); ++i) {
      const double limit = z(i) < 0 ? -optimal_.foreseen.low(i) : optimal_.foreseen.high(i);
      if (limit > 0 && std::isfinite(limit)) share = std::max(share, std::abs(z(i)) / limit);
    }
    return share > 0 ? share : 1;
  }

  // Price of the excess, and its largest share of a range.
  double price_of(const design::SoftLimits& limits, const VectorXd& values, double& excess) const {
    double price = 0;
    for (Eigen::Index i = 0; i < limits.range.rows() && i < values.size(); ++i) {
      const double low = limits.range(i, 0), high = limits.range(i, 1);
      const double beyond = std::max({0.0, low - values(i), values(i) - high});
      const double range = std::isfinite(high - low) ? high - low : std::isfinite(low) ? std::abs(low) : std::abs(high);
      price += limits.price(i) * beyond * beyond;
      if (range > 0 && std::isfinite(range)) excess = std::max(excess, beyond / range);
    }
    return price;
  }

  // The plant in double, the law in S.
  template <class S>
  Run run(VectorXd x, const step::Model<S>& law, bool is_kept) const {
    Run out;
    step::State<S> state;
    VectorXd before = VectorXd::Zero(controller_.size.nu);
    state.u = numbers_of<S>(before);
    state.r = step::Vector<S>::Constant(controller_.size.nr, S(0));
    const auto distance = [&] {
      const VectorXd own_state = x.head(own());
      return own_state.dot(X_.topLeftCorner(own(), own()) * own_state);
    };
    const double first = distance();
    out.reach = VectorXd::Zero(own());
    for (int k = 0; k < samples_; ++k) {
      step::Listener listener;
      state.x = numbers_of<S>(x);
      state.u = step::control(law, state, listener);
      const VectorXd u = as_doubles<S>(state.u);
      if (is_kept) keep(out, k, x, u);
      out.reach = out.reach.cwiseMax(x.head(own()).cwiseAbs());
      const design::Limits& limits = *controller_.problem.limits;
      out.cost += x.dot(Q_ * x) + u.dot(R_ * u) + 2 * x.dot(N_ * u);
      const Eigen::MatrixXd& rate = controller_.problem.regulator->input_rate;
      if (rate.size()) out.cost += (u - before).dot(rate * (u - before));
      if (k > 0) out.cost += price_of(limits.states, x.head(own()), out.excess);
      out.cost += price_of(limits.outputs, C_ * x + D_ * u, out.excess);
      x = A_ * x + B_ * u;
      before = u;
      const double now = distance();
      if (!(now < lost * lost * first)) return out;
      if (now >= settled * first) continue;
      if (!out.settles) out.samples = k + 1;
      out.settles = true;
      if (!is_kept) break;
    }
    return out;
  }

  static void keep(Run& out, int k, const VectorXd& x, const VectorXd& u) {
    constexpr int most = 400;
    if (k >= most) return;
    out.u.conservativeResize(u.size(), k + 1);
    out.x.conservativeResize(x.size(), k + 1);
    out.u.col(k) = u;
    out.x.col(k) = x;
  }

  void show(std::vector<std::pair<double, VectorXd>>& found, Worth& worth) const {
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto is_lost = [](const auto& start) { return std::isinf(start.first); };
    const auto lost_start = std::find_if(found.begin(), found.end(), is_lost);
    const VectorXd& x = lost_start != found.end() ? lost_start->second : found[(found.size() - 1) * 9 / 10].second;
    constexpr Eigen::Index after = 20;
    const Eigen::Index wanted = 2 * run(x, optimal_, false).samples + after;
    const auto begin = [&](const MatrixXd& all) { return MatrixXd(all.leftCols(std::min(all.cols(), wanted))); };
    with_scalar_of(controller_.target, [&](auto scalar) {
      using S = decltype(scalar);
      const Run clipped = run(x, law_of<S>(controller_, true), true);
      const Run optimal = run(x, law_of<S>(controller_, false), true);
      worth.shown = {x, begin(clipped.u), begin(optimal.u), begin(clipped.x), begin(optimal.x)};
    });
  }

  const Controller& controller_;
  const MatrixXd A_, B_, C_, D_, Q_, R_, N_, X_;
  const step::Model<double> clipped_, optimal_;
  const int samples_;
};

}  // namespace

Worth worth_of_foresight(const Controller& controller) { return Comparison(controller).result(); }

}  // namespace lqg::simulate
