// SPDX-License-Identifier: MIT
#include "design/loop/rounded_loop.hpp"

#include <algorithm>

#include "design/loop/compensator.hpp"
#include "design/loop/cost.hpp"
#include "design/loop/margins.hpp"
#include "design/numeric/poles.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

RealMatrix held_by(Scalar real, const RealMatrix& a) {
  RealMatrix result(a.rows(), a.cols());
  for (Index i = 0; i < a.size(); ++i)
    result.data()[i] = real == Scalar::float32 ? Real(to_float(a.data()[i])) : Real(to_double(a.data()[i]));
  return result;
}

namespace {

SampledPlant held(const SampledPlant& plant, Scalar real) {
  return {held_by(real, plant.A), held_by(real, plant.B), held_by(real, plant.C), held_by(real, plant.D), plant.G};
}

Solution held(const Solution& solution, Scalar real) {
  Solution result;
  result.plant = held(final_plant(solution), real);
  if (solution.regulator) {
    result.regulator.emplace();
    result.regulator->K = held_by(real, solution.regulator->K);
  }
  if (solution.estimator) {
    result.estimator.emplace();
    result.estimator->L = held_by(real, solution.estimator->L);
    result.estimator->M = held_by(real, solution.estimator->M);
  }
  if (const auto& exact = solution.compensator) {
    CompensatorSolution& compensator = result.compensator.emplace();
    compensator.A = held_by(real, exact->A), compensator.B = held_by(real, exact->B);
    compensator.C = held_by(real, exact->C), compensator.D = held_by(real, exact->D);
  }
  return result;
}

std::string name_of(Scalar real) { return real == Scalar::float32 ? "float" : "double"; }

// What helps where this scalar does not, if double does.
std::string remedy(Scalar real, bool helps_in_double) {
  if (real == Scalar::float64) return "";
  return helps_in_double ? ": use real = \"double\"" : ", and double does not help";
}

// The largest |z|, when it is not inside of the circle.
const ComplexReal* unstable_pole(const std::vector<ComplexReal>& poles) {
  const ComplexReal* worst = nullptr;
  Real largest = 1;
  for (const ComplexReal& pole : poles) {
    const Real size = hypot(pole.re, pole.im);
    if (!(size >= largest)) continue;
    largest = size;
    worst = &pole;
  }
  return worst;
}

// A column that is not zero and rounds to zero.
bool loses_column(const RealMatrix& exact, const RealMatrix& rounded) {
  for (Index j = 0; j < exact.cols(); ++j)
    if (!is_zero(exact.col(j)) && is_zero(rounded.col(j))) return true;
  return false;
}

using PolesIn = std::function<std::vector<ComplexReal>(Scalar)>;

// The poles with numbers of this scalar.
std::vector<ComplexReal> checked_poles(const PolesIn& poles_in, const std::string& what, Scalar real,
                                       Findings& findings) {
  const std::vector<ComplexReal> poles = poles_in(real);
  if (const ComplexReal* pole = unstable_pole(poles))
    add_error(findings, "code.real",
              what + " with the numbers rounded to " + name_of(real) + " is unstable: a pole at z = " +
                  short_complex(*pole, 1) + remedy(real, !unstable_pole(poles_in(Scalar::float64))));
  return poles;
}

void check_cost(const SampledStage& last, const Compensator& controller, const Solution& solution, RoundedLoop& rounded,
                Findings& findings) {
  if (!solution.loop.cost_per_sample) return;
  const std::optional<SteadyCost> cost = steady_cost(last.problem, last.of_loop(), controller);
  if (!cost)
    return add_note(findings, "code.real",
                    "the cost of the loop with the numbers rounded to " + name_of(last.problem.code.real) +
                        " is not known: its poles are too near to the unit circle");
  rounded.cost_per_sample = to_double(cost->per_sample);
  const bool is_white = solution.white && solution.white->cost_nominal;  // the loop here has no white parameters
  const double exact = is_white ? *solution.white->cost_nominal : *solution.loop.cost_per_sample;
  const double ratio = *rounded.cost_per_sample / exact;
  if (ratio > 1.01)
    add_note(findings, "code.real",
             "the numbers rounded to " + name_of(last.problem.code.real) + " cost " + short_number(100 * (ratio - 1)) +
                 " % more");
}

std::vector<ComplexReal> poles_of_filter(const Solution& rounded) {
  const RealMatrix& A = rounded.plant.A;
  const RealMatrix gain = multiply(A, rounded.estimator->L) + rounded.estimator->M;
  return eigenvalues(A - multiply(gain, rounded.plant.C));
}

}  // namespace

void check_rounded_controller(const Problem& problem, const SampledStage& last, const ControllerIn& controller_in,
                              Solution& solution, Findings& findings) {
  const MeasuredPlant plant = measured_plant(problem, solution);
  const PolesIn poles_in = [&](Scalar real) { return eigenvalues(closed_loop(plant, controller_in(real)).A); };
  const std::vector<ComplexReal> poles = checked_poles(poles_in, "the loop", problem.code.real, findings);
  if (has_error(findings)) return;
  const Compensator controller = controller_in(problem.code.real);
  RoundedLoop& loop = solution.loop.rounded.emplace();
  loop.poles = sorted_poles(poles);
  loop.at_input = rough_margins(open_at_inputs(plant, controller), poles);
  if (solution.estimator) loop.at_output = rough_margins(open_at_outputs(plant, controller), poles);
  check_cost(last, controller, solution, loop, findings);
}

namespace {

// What of a model is lost when it is rounded.
std::vector<std::string> lost(const SampledPlant& exact, Scalar real) {
  const SampledPlant rounded = held(exact, real);
  const RealMatrix one = identity(exact.A.rows());
  std::vector<std::string> all;
  if (is_zero(rounded.A - one) && !is_zero(exact.A - one)) all.emplace_back("A becomes the identity");
  if (loses_column(exact.B, rounded.B)) all.emplace_back("the effect of an input, B, becomes 0");
  if (loses_column(exact.C.transpose(), rounded.C.transpose())) all.emplace_back("an output's row of C becomes 0");
  return all;
}

}  // namespace

void check_model(const SampledPlant& plant, Scalar real, Findings& findings) {
  for (const std::string& what : lost(plant, real)) {
    const std::vector<std::string> in_double = lost(plant, Scalar::float64);
    const bool helps = std::find(in_double.begin(), in_double.end(), what) == in_double.end();
    add_error(findings, "code.real",
              what + " in " + name_of(real) + ": the sampled plant cannot be represented" + remedy(real, helps));
  }
}

void check_rounded(const Problem& problem, const SampledStage& last, const std::vector<ComplexReal>& poles,
                   Solution& solution, Findings& findings) {
  const Digits enough(std::max(50u, solution.numerics.digits / 2));
  if (has_error(findings) || unstable_pole(poles)) return;
  if (solution.regulator && solution.estimator == std::nullopt && problem.estimator) return;
  const auto in = [&](Scalar real) { return held(solution, real); };
  if (solution.regulator)
    check_rounded_controller(
        problem, last, [&](Scalar real) { return compensator(problem, in(real)); }, solution, findings);
  else if (solution.estimator)
    checked_poles([&](Scalar real) { return poles_of_filter(in(real)); }, "the filter", problem.code.real, findings);
}

}  // namespace lqg::design
