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
  return result;
}

std::string name_of(Scalar real) { return real == Scalar::float32 ? "float" : "double"; }

// What may help where this scalar does not.
std::string remedy(Scalar real) { return real == Scalar::float32 ? ": use real = \"double\"" : ""; }

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

void check_poles(const std::vector<ComplexReal>& poles, const std::string& what, Scalar real, Findings& findings) {
  if (const ComplexReal* pole = unstable_pole(poles))
    add_error(findings, "code.real",
              what + " with the numbers rounded to " + name_of(real) + " is unstable: a pole at z = "
                  + short_complex(*pole, 1) + remedy(real));
}

void check_cost(const SampledStage& last, const Compensator& controller, const Solution& solution, RoundedLoop& rounded,
                Findings& findings) {
  if (!solution.loop.cost_per_sample) return;
  const std::optional<SteadyCost> cost = steady_cost(last.problem, last.samples, controller);
  if (!cost) return;
  rounded.cost_per_sample = to_double(cost->per_sample);
  const double ratio = *rounded.cost_per_sample / *solution.loop.cost_per_sample;
  if (ratio > 1.01)
    add_note(findings, "code.real",
             "the numbers rounded to " + name_of(last.problem.code.real) + " cost " + short_number(100 * (ratio - 1)) + " % more");
}

void check_filter(const Solution& rounded, Scalar real, Findings& findings) {
  const RealMatrix& A = rounded.plant.A;
  const RealMatrix gain = multiply(A, rounded.estimator->L) + rounded.estimator->M;
  check_poles(eigenvalues(A - multiply(gain, rounded.plant.C)), "the filter", real, findings);
}

bool is_stable(const Poles& poles) {
  for (const std::complex<double>& pole : poles)
    if (!(std::abs(pole) < 1)) return false;
  return true;
}

}  // namespace

void check_rounded_controller(const Problem& problem, const SampledStage& last, const Compensator& controller,
                              Solution& solution, Findings& findings) {
  const MeasuredPlant plant = measured_plant(problem, final_plant(solution));
  const std::vector<ComplexReal> poles = eigenvalues(closed_loop(plant, controller).A);
  check_poles(poles, "the loop", problem.code.real, findings);
  if (has_error(findings)) return;
  RoundedLoop& loop = solution.loop.rounded.emplace();
  loop.poles = sorted_poles(poles);
  loop.at_input = rough_margins(open_at_inputs(plant, controller), poles);
  if (solution.estimator) loop.at_output = rough_margins(open_at_outputs(plant, controller), poles);
  check_cost(last, controller, solution, loop, findings);
}

void check_model(const SampledPlant& exact, Scalar real, Findings& findings) {
  const SampledPlant rounded = held(exact, real);
  const RealMatrix one = identity(exact.A.rows());
  const std::string end = " in " + name_of(real) + ": the sampled plant cannot be represented" + remedy(real);
  if (is_zero(rounded.A - one) && !is_zero(exact.A - one))
    add_error(findings, "code.real", "A becomes the identity" + end);
  if (loses_column(exact.B, rounded.B)) add_error(findings, "code.real", "the effect of an input, B, becomes 0" + end);
  if (loses_column(exact.C.transpose(), rounded.C.transpose()))
    add_error(findings, "code.real", "an output's row of C becomes 0" + end);
}

void check_rounded(const Problem& problem, const SampledStage& last, Solution& solution, Findings& findings) {
  const Digits enough(std::max(50u, solution.numerics.digits / 2));
  const Solution rounded = held(solution, problem.code.real);
  if (has_error(findings) || !is_stable(solution.loop.poles)) return;
  if (solution.regulator && solution.estimator == std::nullopt && problem.estimator) return;
  if (solution.regulator)
    check_rounded_controller(problem, last, compensator(problem, rounded), solution, findings);
  else if (solution.estimator)
    check_filter(rounded, problem.code.real, findings);
}

}  // namespace lqg::design
