// SPDX-License-Identifier: MIT
#include "design/order/search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

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
  return work < 2e6 ? 12 : work < 1e7 ? 6 : 2;
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

// Any compensator of about the size that laws have in these units.
Matrix<double> drawn(const Family& family, Draws& draws) {
  Matrix<double> column(family.free_entries(), 1);
  for (Index k = 0; k < column.size(); ++k) column(k, 0) = draws.next() + draws.next();
  return unpacked<double>(family, column);
}

void try_start(const Family& family, const Matrix<double>& Theta, OrderMinima& found) {
  const double same = 1e-7;
  const Continued end = continued(family, Theta);
  ++found.starts;
  std::vector<Point>& minima = found.minima;
  if (!end.point.is_stable) {
    if (found.easiest.size() == 0 || end.ease < found.ease) {
      found.ease = end.ease;
      found.easiest = end.Theta;
    }
    return;
  }
  const auto place = std::find_if(minima.begin(), minima.end(),
                                  [&](const Point& other) { return end.point.cost <= other.cost * (1 + same); });
  const bool is_known = place != minima.end() && end.point.cost >= place->cost * (1 - same);
  if (place == minima.begin()) found.reached = is_known ? found.reached + 1 : 1;
  if (!is_known) minima.insert(place, end.point);
}

}  // namespace

OrderSearch::OrderSearch(OrderProblem scaled_problem) : problem_(std::move(scaled_problem)) {
  for (const auto& [inputs, outputs] : {std::pair(1.0, 1.0), std::pair(100.0, 100.0), std::pair(0.01, 0.01)})
    if (const std::optional<Matrix<double>> law = full_order_law(problem_, inputs, outputs)) laws_.push_back(*law);
}

void OrderSearch::start_from_laws(const Family& family, OrderMinima& found) const {
  const Family full = loop_family<double>(problem_, family.nx);
  const Matrix<double> nothing = Matrix<double>::Zero(family.nu + family.order, family.ny + family.order);
  for (const Matrix<double>& law : laws_) {
    Matrix<double> padded = nothing;
    if (family.order > family.nx) padded.topLeftCorner(law.rows(), law.cols()) = law;
    try_start(family, family.order > family.nx ? padded : truncated(full, law, family.order), found);
  }
  if (laws_.empty()) try_start(family, nothing, found);
}

void OrderSearch::start_from_below(const Family& family, OrderMinima& found) {
  if (family.order == 0) return;
  const OrderMinima& less = upwards(family.order - 1);
  const std::size_t most_seeds = 3, seeds = std::min(most_seeds, less.minima.size());
  Draws draws(static_cast<std::uint64_t>(family.order));
  const int count = draws_for(family);
  for (int k = 0; k < count; ++k) {
    const Matrix<double>& seed = seeds == 0 ? less.easiest : less.minima[static_cast<std::size_t>(k) % seeds].Theta;
    try_start(family, with_weak_mode(family, seed, draws), found);
  }
  for (int k = 0; k < count / 2; ++k) try_start(family, drawn(family, draws), found);
}

const OrderMinima& OrderSearch::upwards(Index order) {
  const auto known = upwards_.find(order);
  if (known != upwards_.end()) return known->second;
  const Family family = loop_family<double>(problem_, order);
  OrderMinima found;
  start_from_laws(family, found);
  // The climb to an order that is nearly full costs much and finds no more than the law itself.
  const bool is_worth_it = order < family.nx || work_of_step(family) < 1e7;
  if (is_worth_it) start_from_below(family, found);
  return upwards_[order] = found;
}

OrderMinima OrderSearch::minima(Index order) {
  OrderMinima found = upwards(order);
  const Family family = loop_family<double>(problem_, order);
  if (order >= family.nx) return found;
  const Family larger = loop_family<double>(problem_, order + 1);
  const std::size_t most_seeds = 3;
  const std::vector<Point>& more = upwards(order + 1).minima;
  for (std::size_t k = 0; k < std::min(most_seeds, more.size()); ++k)
    try_start(family, truncated(larger, balanced(larger, more[k]), order), found);
  return found;
}

}  // namespace lqg::design::order
