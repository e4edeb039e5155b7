// SPDX-License-Identifier: MIT
#include "controller/numbers.hpp"

#include <cmath>
#include <limits>

#include "controller/model_of.hpp"
#include "controller/rounding.hpp"

namespace lqg::controller {

namespace {

using design::Real;
using design::RealMatrix;

class NumberCheck {
 public:
  NumberCheck(bool is_double, design::Findings& findings) : is_double_(is_double), findings_(findings) {}

  bool has_failed() const { return design::has_error(findings_); }

  // A number of the file that must be neither infinite nor 0.
  void keep(const std::string& key, double value) {
    const double rounded = of_target(value);
    if (!is_number(rounded)) refuse(key, "a number", value, is_number(value));
  }

  // Its square is a number of the target, too.
  void keep_square(const std::string& key, double value) {
    const double rounded = of_target(value), square = of_target(rounded * rounded);
    if (!is_number(square)) refuse(key, "a number whose square", value, is_number(value * value));
  }

  void keep(const std::string& key, const std::string& what, const RealMatrix& matrix, bool may_vanish) {
    bool overflows = false, vanishes = false;
    for (Eigen::Index i = 0; i < matrix.size(); ++i) {
      const double rounded = rounded_to_target(matrix.data()[i], is_double_);
      overflows = overflows || !std::isfinite(rounded);
      vanishes = vanishes || (rounded == 0 && !matrix.data()[i].is_zero());
    }
    if (overflows) design::add_error(findings_, key, what + " has an entry too large for " + scalar());
    if (vanishes && !may_vanish) design::add_error(findings_, key, what + " has an entry too small for " + scalar());
  }

  void note_start(const Eigen::VectorXd& x0) {
    for (int i = 0; i < x0.size(); ++i)
      if (x0(i) != 0 && of_target(x0(i)) == 0)
        note("kalman.initial_state[" + std::to_string(i) + "]", x0(i), "is too small for", "it becomes 0");
  }

  // Finite limits stay apart, and are numbers; infinite ones are none.
  void check_limits(double u_min, double u_max, int input) {
    const std::string entry = "[" + std::to_string(input) + "]";
    const double low = limit_of_target(u_min, +1, is_double_), high = limit_of_target(u_max, -1, is_double_);
    if (!are_apart(low, high))
      return design::add_error(
          findings_, "limits." + std::string(std::isinf(u_max) ? "u_min" : "u_max") + entry,
          "expected limits with two numbers of " + scalar() + " or more from one to the other, found " +
              design::decimal(u_min) + " and " + design::decimal(u_max) +
              remedy(are_apart(limit_of_target(u_min, +1, true), limit_of_target(u_max, -1, true))));
    note_limit("limits.u_min" + entry, u_min, low);
    note_limit("limits.u_max" + entry, u_max, high);
  }

  void check_rate(double rate, double sample_time, int input) {
    const std::string key = "limits.u_rate[" + std::to_string(input) + "]";
    const double change = rate * sample_time;
    if (std::isinf(rate)) return;
    if (limit_of_target(std::min(change, largest()), -1, is_double_) == 0)
      return design::add_error(findings_, key,
                               "expected a change in a sample, u_rate · sample_time, that " + scalar() +
                                   " can tell from 0, found " + design::decimal(rate) + " · " +
                                   design::decimal(sample_time) + remedy(limit_of_target(change, -1, true) != 0));
    if (change > largest()) note(key, rate, "times sample_time is beyond", "the largest number is the limit");
  }

 private:
  double of_target(double value) const { return is_double_ ? value : static_cast<double>(static_cast<float>(value)); }
  double largest() const {
    return is_double_ ? std::numeric_limits<double>::max() : static_cast<double>(std::numeric_limits<float>::max());
  }
  std::string scalar() const { return is_double_ ? "double" : "float"; }
  // What may help; double where it does.
  std::string remedy(bool helps_in_double) const {
    return std::string(": choose another unit") + (!is_double_ && helps_in_double ? ", or real = \"double\"" : "");
  }
  static bool is_number(double value) { return std::isfinite(value) && value != 0; }
  static bool are_apart(double low, double high) {
    return low < high && !(std::isinf(low) && low > 0) && !(std::isinf(high) && high < 0);
  }

  void refuse(const std::string& key, const std::string& what, double found, bool helps_in_double) {
    design::add_error(findings_, key,
                      "expected " + what + " that " + scalar() + " can tell from 0 and infinity, found " +
                          design::decimal(found) + remedy(helps_in_double));
  }
  void note(const std::string& key, double value, const std::string& is, const std::string& consequence) {
    design::add_note(findings_, key, design::decimal(value) + " " + is + " " + scalar() + ": " + consequence);
  }
  void note_limit(const std::string& key, double limit, double rounded) {
    if (limit != 0 && rounded == 0) note(key, limit, "is too small for", "the limit becomes 0");
    if (std::isfinite(limit) && std::abs(limit) > largest())
      note(key, limit, "is beyond", "the largest number is the limit");
  }

  bool is_double_;
  design::Findings& findings_;
};

void check_limits(const Controller& controller, NumberCheck& check) {
  const design::Limits& limits = *controller.problem.limits;
  for (int i = 0; i < limits.u_min.size(); ++i) check.check_limits(limits.u_min(i), limits.u_max(i), i);
  for (int i = 0; i < limits.u_rate.size(); ++i)
    check.check_rate(limits.u_rate(i), controller.problem.plant.sample_time, i);
}

void check_filter(const Controller& controller, NumberCheck& check) {
  if (controller.has.gate) check.keep_square(key_of_sigma(*controller.problem.estimator), controller.gate.sigma);
  check.note_start(controller.x0);
  const bool may_vanish = !controller.has.gate;  // a gate would leave out all
  const char *noise = "kalman.measurement_noise", *variance = "the variance of the innovations";
  for (const Gains& row : controller.filters)
    if (row.size() > 2 && !check.has_failed()) check.keep(noise, variance, row[2], may_vanish);
  if (!controller.filters.empty() && controller.has.variance)
    check.keep(noise, variance, controller.solution.estimator->S.diagonal(), may_vanish);
}

}  // namespace

bool fit_variances(const Controller& controller) {
  const double square = controller.gate.sigma * controller.gate.sigma;
  const auto fits = [&](const Real& variance) {
    for (const Real& each : {variance, Real(square * variance)}) {
      const double rounded = rounded_to_target(each, controller.target.is_double);
      if (!std::isfinite(rounded) || rounded == 0) return false;
    }
    return true;
  };
  for (const Gains& row : controller.filters)
    for (Eigen::Index i = 0; row.size() > 2 && i < row[2].size(); ++i)
      if (!fits(row[2].data()[i])) return false;
  return true;
}

void check_numbers(const Controller& controller, design::Findings& findings) {
  NumberCheck check(controller.target.is_double, findings);
  check.keep("plant.sample_time", controller.problem.plant.sample_time);
  if (controller.has.filter) check_filter(controller, check);
  const std::string law =
      controller.problem.regulator && controller.problem.regulator->poles ? "pole_placement" : "lqr";
  for (const Gains& row : controller.laws) {
    if (check.has_failed()) return;
    for (const auto& [what, at] :
         {std::pair("a gain K", 0), std::pair("Nbar, of the references,", 1),
          std::pair("H, of the integrals at a limit,", 2), std::pair("H_input, of the integrals,", 3)})
      check.keep(law, what, row[static_cast<std::size_t>(at)], true);
  }
  if (controller.has.regulator && controller.problem.limits) check_limits(controller, check);
}

void check_numbers(const design::LinearForm& form, bool is_double, design::Findings& findings) {
  NumberCheck check(is_double, findings);
  const auto keep = [&](const RealMatrix& matrix) {
    check.keep("code.realisation", "a matrix of this form", matrix, true);
  };
  for (const RealMatrix* matrix :
       {&form.A, &form.B, &form.C, &form.D, &form.expected, &form.estimate, &form.heard, &form.of_state, &form.keep})
    keep(*matrix);
  keep(form.z0);
}

}  // namespace lqg::controller
