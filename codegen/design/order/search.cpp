// SPDX-License-Identifier: MIT
#include "design/order/search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lqg::design::order {

namespace {

// splitmix64 (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014), the
// same on every host.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(seed) {}
  double next() {  // in [−1, 1)
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30)) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ (mixed >> 27)) * 0x94D049BB133111EBu;
    mixed ^= mixed >> 31;
    return static_cast<double>(mixed >> 11) * 0x1p-52 - 1;
  }

 private:
  std::uint64_t state_;
};

// About how many multiplications a Newton step takes.
double work_of_step(const Family& family) {
  const double n = static_cast<double>(family.size()), N = n * (n + 1) / 2;
  return N * N * (N / 3 + static_cast<double>(family.free_entries()));
}

int draws_for(const Family& family) {
  const double work = work_of_step(family);
  return work < 3e5 ? 12 : work < 1e7 ? 6 : 2;
}

// A state more, with a pole of its own, which is hardly driven and hardly heard.
Matrix<double> with_weak_mode(const Family& family, const Matrix<double>& less, Draws& draws) {
  const double faint = 0.3;
  Matrix<double> Theta(less.rows() + 1, less.cols() + 1);
  Theta.topLeftCorner(less.rows(), less.cols()) = less;
  for (Index i = 0; i < less.rows(); ++i) Theta(i, less.cols()) = faint * draws.next();
  for (Index j = 0; j < less.cols(); ++j) Theta(less.rows(), j) = faint * draws.next();
  const double speed = family.terms.front().fixed.topLeftCorner(family.nx, family.nx).cwiseAbs().maxCoeff();
  const double draw = draws.next();
  Theta(less.rows(), less.cols()) = family.is_continuous ? -speed * std::pow(10.0, draw - 0.5) : draw;
  return Theta;
}

}  // namespace

struct OrderSearch::Ends {
  std::vector<Point> minima;
  OrderBest failed;  // the farthest
  int starts = 0;
};

OrderSearch::OrderSearch(const OrderProblem& scaled_problem) : problem_(scaled_problem) {
  for (const auto& [inputs, outputs] : {std::pair(1.0, 1.0), std::pair(100.0, 100.0), std::pair(0.01, 0.01)})
    if (const std::optional<Matrix<double>> law = full_order_law(problem_, inputs, outputs)) laws_.push_back(*law);
}

void OrderSearch::try_start(const Family& family, const Matrix<double>& Theta, Ends& ends) const {
  const Continued end = continued(family, Theta);
  ++ends.starts;
  if (end.point.is_stable)
    ends.minima.push_back(end.point);
  else if (ends.failed.Theta.size() == 0 || end.ease < ends.failed.ease) {
    ends.failed.ease = end.ease;
    ends.failed.Theta = end.Theta;
  }
}

void OrderSearch::start_from_laws(const Family& family, Ends& ends) const {
  const Index nx = family.nx;
  for (const Matrix<double>& law : laws_) {
    if (family.order <= nx) {
      const Family full = loop_family<double>(problem_, nx);
      try_start(family, truncated(full, law, family.order), ends);
      continue;
    }
    Matrix<double> padded = Matrix<double>::Zero(family.nu + family.order, family.ny + family.order);
    padded.topLeftCorner(law.rows(), law.cols()) = law;
    try_start(family, padded, ends);
  }
  if (laws_.empty()) try_start(family, Matrix<double>::Zero(family.nu + family.order, family.ny + family.order), ends);
}

void OrderSearch::start_from_below(const Family& family, Ends& ends) {
  if (family.order == 0) return;
  const OrderBest& less = upwards(family.order - 1);
  const Matrix<double>& Theta = less.point.is_stable ? less.point.Theta : less.Theta;
  Draws draws(static_cast<std::uint64_t>(family.order));
  for (int k = draws_for(family); k > 0; --k) try_start(family, with_weak_mode(family, Theta, draws), ends);
}

namespace {

OrderBest best_of(const std::vector<Point>& minima, const OrderBest& failed, int starts) {
  const double same = 1e-7;
  OrderBest best = failed;
  best.starts = starts;
  for (const Point& minimum : minima)
    if (!best.point.is_stable || minimum.cost < best.point.cost) best.point = minimum;
  for (const Point& minimum : minima) best.reached += minimum.cost <= best.point.cost * (1 + same) ? 1 : 0;
  return best;
}

}  // namespace

const OrderBest& OrderSearch::upwards(Index order) {
  const auto known = upwards_.find(order);
  if (known != upwards_.end()) return known->second;
  const Family family = loop_family<double>(problem_, order);
  Ends ends;
  start_from_laws(family, ends);
  // The climb to an order that is nearly full costs much and finds no more than the law itself.
  const bool is_worth_it = order < family.nx || work_of_step(family) < 1e7;
  if (is_worth_it) start_from_below(family, ends);
  return upwards_[order] = best_of(ends.minima, ends.failed, ends.starts);
}

OrderBest OrderSearch::best(Index order) {
  const OrderBest& from_below = upwards(order);
  const Family family = loop_family<double>(problem_, order);
  if (order >= family.nx) return from_below;
  const OrderBest& more = upwards(order + 1);
  if (!more.point.is_stable) return from_below;
  const Family larger = loop_family<double>(problem_, order + 1);
  const Continued end = continued(family, truncated(larger, balanced(larger, more.point), order));
  OrderBest best = from_below;
  ++best.starts;
  if (!end.point.is_stable) return best;
  const double same = 1e-7;
  if (!best.point.is_stable || end.point.cost < best.point.cost * (1 - same)) {
    best.point = end.point;
    best.reached = 1;
  } else if (end.point.cost <= best.point.cost * (1 + same)) {
    ++best.reached;
  }
  return best;
}

}  // namespace lqg::design::order
