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
#include "design/numeric/ziv_test.hpp"
#include "design/rounding.hpp"
#include "design/sampled/reference.hpp"
#include "design/sampled/stages.hpp"

namespace lqg::design {

namespace {

constexpr unsigned least_digits = 100;  // of which half have to settle what is emitted

// The numbers of `solution` that a form is made of, in the digits in force.
Solution in_present_digits(const Solution& solution) {
  Solution result;
  const auto rounded = [](const RealMatrix& a) { return design::in_present_digits(a); };
  const SampledPlant& plant = solution.plant;
  result.plant = {rounded(plant.A), rounded(plant.B), rounded(plant.C), rounded(plant.D), rounded(plant.G)};
  result.regulator.emplace().K = rounded(solution.regulator->K);
  result.estimator.emplace().L = rounded(solution.estimator->L);
  result.estimator->M = rounded(solution.estimator->M);
  return result;
}

LinearForm in_physical_states(const Problem& problem, const Solution& solution) {
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
  form.z0 = padded(real(problem.estimator->x0), ns, 1);
  return form;
}

// Columns of T within a block, times R = [p q; −q p] (or [p]), which the block does not notice: the largest row of its
// C becomes [1 0]. A block that u does not see stays as it is.
void take_to_one(ModalBasis& basis, Index start, Index size, const RealMatrix& C) {
  const RealMatrix columns = basis.T.middleCols(start, size), own = multiply(C, columns);
  const RealMatrix squares = own.cwiseProduct(own).rowwise().sum();
  Index largest = 0;
  for (Index i = 1; i < own.rows(); ++i)
    if (squares(i) > 1.001 * squares(largest)) largest = i;  // of equal ones the first, whatever their rounding is
  if (!(sqrt(squares(largest)) > negligible(0.6) * largest_entry(C) * largest_entry(columns))) return;
  const RealMatrix row = own.row(largest);
  RealMatrix R = zeros(size, size), inverse = zeros(size, size);
  for (Index i = 0; i < size; ++i) {
    R(i, i) = row(0) / squares(largest);
    inverse(i, i) = row(0);
  }
  if (size == 2) {
    R(1, 0) = row(1) / squares(largest), R(0, 1) = -R(1, 0);
    inverse(0, 1) = row(1), inverse(1, 0) = -row(1);
  }
  basis.T.middleCols(start, size) = multiply(columns, R);
  basis.inverse.middleRows(start, size) = multiply(inverse, basis.inverse.middleRows(start, size));
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
  for (std::size_t i = 0; i + 1 < basis->starts.size(); ++i)
    take_to_one(*basis, basis->starts[i], basis->starts[i + 1] - basis->starts[i], form.C);
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

bool form_passes_ziv_test(const LinearForm& coarse, LinearForm& fine, unsigned coarse_digits) {
  const auto before = matrices_of(coarse);
  const auto after = matrices_of(fine);
  bool settled = true;
  for (std::size_t i = 0; i < after.size(); ++i)
    settled = passes_ziv_test(*before[i], *after[i], coarse_digits) && settled;
  return settled;
}

bool fits(const LinearForm& form, Scalar scalar) {
  for (const RealMatrix* matrix : matrices_of(form))
    for (Index i = 0; i < matrix->size(); ++i) {
      const Real& entry = matrix->data()[i];
      if (!(scalar == Scalar::float32 ? std::isfinite(to_float(entry)) : std::isfinite(to_double(entry)))) return false;
    }
  return true;
}

double largest_condition(Scalar scalar) {
  return scalar == Scalar::float32 ? std::sqrt(1 / static_cast<double>(std::numeric_limits<float>::epsilon()))
                                   : std::sqrt(1 / std::numeric_limits<double>::epsilon());
}

std::string name_of(Scalar scalar) { return scalar == Scalar::float32 ? "float" : "double"; }

// Made twice: of the solution, and of the same with half of its digits, which stands in for a coarser run of the
// design.
template <class Make>
LinearFormResult settled_form(const Problem& problem, const Solution& solution, Make make) {
  const unsigned digits = std::max(solution.numerics.digits, least_digits);
  std::optional<LinearForm> coarse;
  {
    const Digits half(digits / 2);
    coarse = make(problem, in_present_digits(solution));
  }
  const Digits scope(digits);
  LinearFormResult result;
  result.form = make(problem, in_present_digits(solution));
  const auto refuse = [&](const std::string& why) { return LinearFormResult{std::nullopt, why}; };
  if (!coarse || !result.form) return refuse("a pole of the controller is repeated");
  const double most = largest_condition(problem.code.real);
  if (!(result.form->condition <= most))
    return refuse("poles of the controller are so near each other that their modes cancel by a factor of " +
                  short_number(result.form->condition) + ", in " + name_of(problem.code.real) + " at most " +
                  short_number(most) + " will do");
  if (!form_passes_ziv_test(*coarse, *result.form, digits / 2))
    return refuse(std::to_string(digits / 2) + " digits do not settle its numbers");
  if (!fits(*result.form, problem.code.real))
    return refuse("a number of it is too large for " + name_of(problem.code.real));
  return result;
}

}  // namespace

std::string no_linear_form(const Problem& problem, const Solution& solution) {
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
  const Digits scope(std::max(solution.numerics.digits, least_digits));
  for (const ComplexReal& pole : eigenvalues(compensator(problem, solution).A))
    if (on_or_outside_circle(pole))
      return "the controller by itself has a pole at z = " + short_complex(pole, 1) +
             ", and what comes of an input that was not applied as it is would not die out";
  return "";
}

LinearFormResult folded_form(const Problem& problem, const Solution& solution) {
  return settled_form(problem, solution, [](const Problem& of, const Solution& in) {
    return std::optional<LinearForm>(in_physical_states(of, in));
  });
}

LinearFormResult modal_form(const Problem& problem, const Solution& solution) {
  return settled_form(problem, solution, in_modes);
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
