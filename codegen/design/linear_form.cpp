// SPDX-License-Identifier: MIT
#include "design/linear_form.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "design/equations/riccati.hpp"
#include "design/loop/compensator.hpp"
#include "design/loop/rounded_loop.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/numeric/modal_basis.hpp"
#include "design/numeric/modes.hpp"
#include "design/numeric/poles.hpp"
#include "design/sampled/reference.hpp"
#include "design/sampled/stages.hpp"
#include "design/settled_form.hpp"

namespace lqg::design {

namespace {

// The numbers of `solution` that a form is made of, in the digits in force.
Solution in_present_digits(const Solution& solution) {
  Solution result;
  const auto rounded = [](const RealMatrix& a) { return design::in_present_digits(a); };
  const SampledPlant& plant = solution.plant;
  result.plant = {rounded(plant.A), rounded(plant.B), rounded(plant.C), rounded(plant.D), rounded(plant.G)};
  result.start = FilterStart{rounded(solution.start->x0), RealMatrix()};
  result.regulator.emplace().K = rounded(solution.regulator->K);
  result.estimator.emplace().L = rounded(solution.estimator->L);
  result.estimator->M = rounded(solution.estimator->M);
  if (!solution.compensator) return result;
  CompensatorSolution& own = result.compensator.emplace(*solution.compensator);
  for (RealMatrix* a :
       {&own.A, &own.B, &own.C, &own.D, &own.T, &own.expected, &own.estimate, &own.heard, &own.of_state, &own.keep})
    *a = rounded(*a);
  return result;
}

// Of a given order: z is what it keeps.
LinearForm of_given_order(const Solution& solution) {
  const CompensatorSolution& own = *solution.compensator;
  LinearForm form;
  form.A = own.A, form.B = own.B, form.C = own.C, form.D = own.D;
  form.T = own.T, form.expected = own.expected, form.estimate = own.estimate, form.heard = own.heard;
  form.of_state = own.of_state, form.keep = own.keep;
  form.z0 = multiply(own.of_state, solution.start->x0);
  return form;
}

LinearForm in_physical_states(const Problem& problem, const Solution& solution) {
  if (solution.compensator) return of_given_order(solution);
  const Compensator controller = compensator(problem, solution);
  const SampledPlant& plant = solution.plant;
  const Index nx = plant.A.rows(), ny = plant.C.rows(), ns = controller.A.rows(), kept = ns - nx;
  const bool answers_at_once = problem.estimator->form == Form::filter;
  const RealMatrix all = identity(ns), x = all.topRows(nx), L = solution.estimator->L;
  LinearForm form;
  form.A = controller.A, form.B = controller.B, form.C = controller.C, form.D = controller.D;
  form.T = all;
  form.expected = multiply(plant.C, x);
  if (kept > 0) form.expected += multiply(plant.D, all.bottomRows(kept));
  if (!answers_at_once) form.expected += multiply(plant.D, form.C);
  form.estimate = answers_at_once ? RealMatrix(x - multiply(L, form.expected)) : x;
  form.heard = answers_at_once ? L : zeros(nx, ny);
  form.of_state = all.leftCols(nx);
  if (kept > 0) form.keep = multiply(all.rightCols(kept), all.bottomRows(kept));
  form.z0 = padded(solution.start->x0, ns, 1);
  return form;
}

// What modal_form calls the condition. P_j = Σ Aᵏ b_j b_jᵀ Aᵏᵀ holds all norms: ‖c z‖² = c P_j cᵀ.
double cancellation(const LinearForm& form, const std::vector<Index>& starts) {
  const RealMatrix C = above(form.C, form.estimate), D = above(form.D, form.heard);
  RealMatrix parts = D.cwiseAbs(), whole = D.cwiseProduct(D);
  for (Index j = 0; j < D.cols(); ++j) {
    const std::optional<RealMatrix> P =
        solve_stein(form.A.transpose(), multiply_transpose(form.B.col(j), form.B.col(j)));
    if (!P) return std::numeric_limits<double>::infinity();
    for (Index i = 0; i < D.rows(); ++i) {
      whole(i, j) += congruence(C.row(i), *P)(0, 0);
      for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
        const Index at = starts[k], size = starts[k + 1] - at;
        parts(i, j) += sqrt(abs(congruence(C.row(i).middleCols(at, size), P->block(at, at, size, size))(0, 0)));
      }
    }
  }
  Real worst = 1;
  for (Index i = 0; i < D.rows(); ++i) {
    const Real least = negligible(0.6) * largest_entry(parts.row(i));  // y_j has nothing to do with it
    for (Index j = 0; j < D.cols(); ++j)
      if (parts(i, j) > least) worst = std::max<Real>(worst, parts(i, j) / sqrt(abs(whole(i, j))));
  }
  return to_double(worst);
}

std::optional<LinearForm> in_modes(const Problem& problem, const Solution& solution) {
  LinearForm form = in_physical_states(problem, solution);
  std::optional<ModalBasis> basis = modal_basis(form.A);
  if (!basis) return std::nullopt;
  take_to_one(*basis, form.C);
  const RealMatrix &T = basis->T, &inverse = basis->inverse;
  form.A = basis->blocks;
  form.B = multiply(inverse, form.B);
  form.C = multiply(form.C, T);
  form.T = T;
  form.expected = multiply(form.expected, T);
  form.estimate = multiply(form.estimate, T);
  if (form.keep.size() > 0) form.keep = multiply(inverse, multiply(form.keep, T));
  form.of_state = multiply(inverse, form.of_state);
  form.z0 = multiply(inverse, form.z0);
  form.condition = cancellation(form, basis->starts);
  return form;
}

template <class Form>
auto matrices_of(Form& form) {
  return std::array{&form.A,        &form.B,     &form.C,        &form.D,    &form.T, &form.expected,
                    &form.estimate, &form.heard, &form.of_state, &form.keep, &form.z0};
}

// Made of the solution in the digits in force.
template <class Make>
LinearFormResult settled_linear_form(const Problem& problem, const Solution& solution, Make make) {
  const auto made = [&] { return make(problem, in_present_digits(solution)); };
  const auto visit_both = [](const LinearForm& coarse, LinearForm& fine, auto visit) {
    const auto before = matrices_of(coarse);
    const auto after = matrices_of(fine);
    for (std::size_t i = 0; i < after.size(); ++i) visit(*before[i], *after[i]);
  };
  Settled<LinearForm> settled = settled_form<LinearForm>(solution.numerics.digits, problem.code.real, made, visit_both);
  LinearFormResult result{std::move(settled.form), std::move(settled.obstacle)};
  if (settled.is_singular) result.obstacle = "a pole of the controller is repeated";
  if (settled.is_ill_conditioned)
    result.obstacle =
        "poles of the controller are so near each other that their modes cancel by a factor of " + result.obstacle;
  return result;
}

std::string unstable_by_itself(unsigned digits, const RealMatrix& A) {
  const Digits scope(std::max(digits, least_digits_of_form));
  for (const ComplexReal& pole : eigenvalues(A))
    if (on_or_outside_circle(pole))
      return "the controller by itself has a pole at z = " + short_complex(pole, 1) +
             ", and what comes of an input that was not applied as it is would not die out";
  return "";
}

}  // namespace

std::string no_linear_form(const Problem& problem, const Solution& solution) {
  if (solution.compensator) return unstable_by_itself(solution.numerics.digits, solution.compensator->A);
  if (!problem.regulator || !problem.estimator) return "u of y takes a regulator and an estimator";
  const Regulator& regulator = *problem.regulator;
  const Estimator& estimator = *problem.estimator;
  if (problem.limits) return "with [limits] x̂ has to hear of the input that was applied";
  if (!problem.stages.empty()) return "its numbers change from stage to stage";
  if (estimator.gain != Gain::steady) return "the filter's gain is not constant";
  if (estimator.gate > 0 || (estimator.spike && std::isfinite(*estimator.spike))) return "the gate compares with x̂";
  if (estimator.output_min.size()) return "the range of each output is asked for in every sample";
  if (regulator.horizon > 0) return "the regulator's gain is not constant";
  if (!reference_outputs(problem).empty()) return "the law follows a reference";
  if (regulator.input_rate.size() > 0) return "the law goes on from the input that was applied";
  return unstable_by_itself(solution.numerics.digits, compensator(problem, solution).A);
}

LinearFormResult folded_form(const Problem& problem, const Solution& solution) {
  return settled_linear_form(problem, solution, [](const Problem& of, const Solution& in) {
    return std::optional<LinearForm>(in_physical_states(of, in));
  });
}

LinearFormResult modal_form(const Problem& problem, const Solution& solution) {
  return settled_linear_form(problem, solution, in_modes);
}

void check_rounded_form(const Problem& problem, const LinearForm& form, Solution& solution, Findings& findings) {
  const Digits enough(std::max(50u, solution.numerics.digits / 2));
  if (!solution.loop.rounded) return;
  const auto controller_in = [&](Scalar real) -> Compensator {
    return {held_by(real, form.A), held_by(real, form.B), held_by(real, form.C),
            held_by(real, form.D), form.A.rows(),         0};
  };
  check_rounded_controller(problem, sample_stages(problem).back(), controller_in, solution, findings);
}

}  // namespace lqg::design
