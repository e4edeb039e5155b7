// SPDX-License-Identifier: MIT
#include "simulate/motion.hpp"

#include <algorithm>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "design/numeric/digits.hpp"
#include "design/rounding.hpp"
#include "expression/evaluate.hpp"

namespace lqg::simulate {

namespace {

namespace odeint = boost::numeric::odeint;
using Eigen::Index;
using Eigen::VectorXd;
using expression::Node;
using expression::Tree;
using States = std::vector<double>;
using Stepper = odeint::runge_kutta_fehlberg78<States>;

// The error of a step in units of what is allowed: 10⁻¹² of each state and of its change, and what rounding leaves of
// the largest. A step into where f has no value is too long.
class ErrorOfStep {
 public:
  template <class Algebra, class Err, class Time>
  double error(Algebra&, const States& x, const States& rate, Err& errors, Time step) const {
    double largest = std::numeric_limits<double>::min(), worst = 0;
    for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::abs(x[i]) + std::abs(step * rate[i]));
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double allowed = 1e-12 * (std::abs(x[i]) + std::abs(step * rate[i])) + 1e-15 * largest;
      const double relative = std::abs(errors[i]) / allowed;
      if (!std::isfinite(relative)) return far;
      worst = std::max(worst, relative);
    }
    return worst;
  }

 private:
  static constexpr double far = 1e9;
};

// The tree with other numbers in the place of these parameters.
Tree with_parameters(const Tree& tree, const std::map<std::string, double>& changed,
                     std::map<const Node*, Tree>& known) {
  if (tree->operands.empty()) return tree;
  if (const auto found = known.find(tree.get()); found != known.end()) return found->second;
  Tree result = tree;
  if (const auto other = changed.find(tree->name); tree->kind == Node::Kind::parameter && other != changed.end()) {
    result = expression::parameter(tree->name, expression::number(other->second), tree->at);
  } else {
    std::vector<Tree> operands;
    for (const Tree& operand : tree->operands) operands.push_back(with_parameters(operand, changed, known));
    result = tree->kind == Node::Kind::parameter ? expression::parameter(tree->name, operands[0], tree->at)
                                                 : expression::operation(tree->operation, operands, tree->at);
  }
  known[tree.get()] = result;
  return result;
}

void add_constants(const Node& node, expression::Constants<design::Real>& values,
                   std::map<const Node*, double>& constants) {
  if (node.is_constant) {
    constants[&node] = design::to_double(values(node));
    return;
  }
  for (const Tree& operand : node.operands) add_constants(*operand, values, constants);
}

bool is_finite(const States& x) {
  return std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

Motion::Formula Motion::formula_of(const Tree& tree, const std::map<std::string, double>& changed) {
  const design::Digits digits(50);
  std::map<const Node*, Tree> known;
  expression::Constants<design::Real> values;
  Formula formula = {changed.empty() ? tree : with_parameters(tree, changed, known), {}};
  add_constants(*formula.tree, values, formula.constants);
  return formula;
}

double Motion::value(const Formula& formula, const std::vector<double>& signals) {
  return expression::evaluate<double>(
      *formula.tree, [&](int i) { return signals[static_cast<std::size_t>(i)]; },
      [&](const Node& node) { return formula.constants.at(&node); });
}

Motion::Motion(const design::Plant& plant, const std::map<std::string, double>& changed, std::vector<Lag> lags)
    : is_continuous_(plant.domain == design::Domain::continuous), sample_time_(plant.sample_time),
      nx_(plant.equations->f.size()), nu_(plant.inputs.size()), lags_(std::move(lags)) {
  for (const Tree& tree : plant.equations->f) f_.push_back(formula_of(tree, changed));
  for (const Tree& tree : plant.equations->h) h_.push_back(formula_of(tree, changed));
  point_.assign(nx_ + nu_, 0);
  y_.assign(h_.size(), 0);
  if (!plant.operating_point) return;
  const design::OperatingPoint& at = *plant.operating_point;
  std::copy(at.x.begin(), at.x.end(), point_.begin());
  std::copy(at.u.begin(), at.u.end(), point_.begin() + at.x.size());
  y_.assign(at.y.begin(), at.y.end());
}

// The plant's own states and what acts on it, in its own units. In `states` only what an actuator does is a deviation.
States Motion::signals_of(const States& states, const Held& held) const {
  States signals(states.begin(), states.begin() + static_cast<std::ptrdiff_t>(nx_));
  for (std::size_t i = 0; i < nu_; ++i) {
    const Index at = static_cast<Index>(i);
    signals.push_back(point_[nx_ + i] + held.command(at) + (held.load.size() ? held.load(at) : 0));
  }
  for (std::size_t i = 0; i < lags_.size(); ++i)
    signals[nx_ + static_cast<std::size_t>(lags_[i].input)] += states[nx_ + i] - held.command(lags_[i].input);
  return signals;
}

States Motion::in_own_units(const VectorXd& x) const {
  States states(x.begin(), x.end());
  for (std::size_t i = 0; i < nx_; ++i) states[i] += point_[i];
  return states;
}

void Motion::move(const Held& held, double time, VectorXd& x) const {
  if (is_continuous_)
    integrate(held, time, x);
  else
    move_sample(held, x);
  if (!x.allFinite()) x.setConstant(std::numeric_limits<double>::infinity());
}

// What a lagging actuator does at the end of the sample acts in all of it, as in the linear plant.
void Motion::move_sample(const Held& held, VectorXd& x) const {
  for (std::size_t i = 0; i < lags_.size(); ++i) {
    const double stays = std::exp(-sample_time_ / lags_[i].time_constant);
    double& acts = x(static_cast<Index>(nx_ + i));
    acts = stays * acts + (1 - stays) * held.command(lags_[i].input);
  }
  const States signals = signals_of(in_own_units(x), held);
  for (std::size_t i = 0; i < nx_; ++i) {
    const Index at = static_cast<Index>(i);
    x(at) = value(f_[i], signals) - point_[i] + (held.state_load.size() ? held.state_load(at) : 0);
  }
}

// By Runge's, Kutta's and Fehlberg's steps of order 8 whose length follows the error of order 7. Steps are no shorter
// than a thousandth of the time: across a jump of f, and where the plant is stiff, the error is what it is then.
void Motion::integrate(const Held& held, double time, VectorXd& x) const {
  const auto rates = [&](const States& own, States& rate, double) {
    const States signals = signals_of(own, held);
    for (std::size_t i = 0; i < nx_; ++i)
      rate[i] = value(f_[i], signals) + (held.state_load.size() ? held.state_load(static_cast<Index>(i)) : 0);
    for (std::size_t i = 0; i < lags_.size(); ++i)
      rate[nx_ + i] = (held.command(lags_[i].input) - own[nx_ + i]) / lags_[i].time_constant;
  };
  States own = in_own_units(x);
  odeint::controlled_runge_kutta<Stepper, ErrorOfStep> controlled;
  Stepper plain;
  const double shortest = time / 1000;
  double t = 0, step = time;
  while (t < time && is_finite(own)) {
    const double left = time - t;
    if (left <= shortest || step <= shortest) {
      const double last = std::min(left, shortest);
      plain.do_step(rates, own, t, last);
      t = last == left ? time : t + last;
      step = 2 * shortest;
      continue;
    }
    const bool reaches = step >= left;
    if (reaches) step = left;
    if (controlled.try_step(rates, own, t, step) == odeint::success && reaches) t = time;
  }
  for (std::size_t i = 0; i < nx_; ++i) own[i] -= point_[i];
  std::copy(own.begin(), own.end(), x.begin());
}

VectorXd Motion::outputs(const VectorXd& x, const VectorXd& acting) const {
  States signals = in_own_units(x.head(static_cast<Index>(nx_)));
  for (std::size_t i = 0; i < nu_; ++i) signals.push_back(point_[nx_ + i] + acting(static_cast<Index>(i)));
  VectorXd y(static_cast<Index>(h_.size()));
  for (std::size_t i = 0; i < h_.size(); ++i) y(static_cast<Index>(i)) = value(h_[i], signals) - y_[i];
  return y;
}

}  // namespace lqg::simulate
