// SPDX-License-Identifier: MIT
#include "design/modal_plant.hpp"

#include <algorithm>
#include <cmath>

#include "design/loop/compensator.hpp"
#include "design/loop/rounded_loop.hpp"
#include "design/numeric/factor.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/numeric/modal_basis.hpp"
#include "design/sampled/stages.hpp"
#include "design/settled_form.hpp"

namespace lqg::design {

namespace {

// Poles of a file's doubles are never so near each other: these are one, as far as the digits tell.
constexpr double condition_of_repeated = 1e20;

RealMatrix now(const RealMatrix& a) { return design::in_present_digits(a); }

// [a 0; 0 1]
RealMatrix with_rest(const RealMatrix& a, Index size) {
  RealMatrix result = identity(size);
  result.topLeftCorner(a.rows(), a.cols()) = a;
  return result;
}

// ρ(|T⁻¹| |T|) by powers of it. All of it is positive within each part that belongs together, and 1 elsewhere.
double condition_of(const RealMatrix& T, const RealMatrix& inverse) {
  constexpr int most_powers = 200;
  const Eigen::MatrixXd M = to_doubles(multiply(inverse.cwiseAbs(), T.cwiseAbs()));
  Eigen::VectorXd v = Eigen::VectorXd::Ones(M.rows());
  double found = 0;
  for (int k = 0; k < most_powers; ++k) {
    const Eigen::VectorXd next = M * v;
    const double size = next.maxCoeff();
    if (!(std::abs(size - found) > 1e-6 * size)) break;
    found = size;
    v = next / size;
  }
  return found;
}

double agreement_of(const RealMatrix& A, const ModalBasis& basis) {
  const Index n = A.rows();
  const RealMatrix image = multiply(A, basis.T);
  const Real worst =
      std::max<Real>(largest_entry(image - multiply(basis.T, basis.blocks)) / (norm(A) * largest_entry(basis.T)),
                     largest_entry(multiply(basis.inverse, basis.T) - identity(n)));
  return to_double(-log10(std::max<Real>(worst, negligible(1))));
}

// Of K over [x; …] that over [z; …].
RealMatrix law_of_modes(const RealMatrix& K, const RealMatrix& T) {
  RealMatrix result = now(K);
  if (K.size() > 0) result.leftCols(T.rows()) = multiply(result.leftCols(T.rows()), T);
  return result;
}

OnlineSolution online_of_modes(const OnlineSolution& of, const ModalPlant& modal, bool has_factors) {
  OnlineSolution online;
  online.E = now(of.E);
  online.V = now(of.V);
  online.w = now(of.w);
  online.D = now(of.D);
  online.C = multiply(now(of.C), modal.T);
  online.M = multiply(modal.inverse, now(of.M));
  online.A_free = modal.plant.A - multiply(online.M, online.C);
  online.W = congruence(modal.inverse, now(of.W));
  online.G = multiply(modal.inverse, now(of.G));
  online.P0 = congruence(modal.inverse, now(of.P0));
  if (!has_factors) return online;
  const Factors P0 = upper_factors(online.P0);
  online.U0 = P0.U;
  online.D0 = P0.d;
  return online;
}

std::optional<ModalPlant> plant_in_modes(const Problem& problem, const Solution& solution) {
  const SampledPlant& plant = solution.plant;
  const Index own = problem.plant.A.rows(), all = plant.A.rows();
  std::optional<ModalBasis> basis = modal_basis(now(plant.A.topLeftCorner(own, own)));
  if (!basis) return std::nullopt;
  ModalPlant modal;
  take_to_one(*basis, now(solution.online->C.leftCols(own)));
  modal.agreement = agreement_of(now(plant.A.topLeftCorner(own, own)), *basis);
  modal.T = with_rest(basis->T, all);
  modal.inverse = with_rest(basis->inverse, all);
  modal.condition = condition_of(basis->T, basis->inverse);
  if (modal.condition > condition_of_repeated) return std::nullopt;
  modal.plant.A = multiply(modal.inverse, multiply(now(plant.A), modal.T));
  modal.plant.A.topLeftCorner(own, own) = basis->blocks;
  modal.plant.B = multiply(modal.inverse, now(plant.B));
  modal.plant.C = multiply(now(plant.C), modal.T);
  modal.plant.D = now(plant.D);
  modal.plant.G = multiply(modal.inverse, now(plant.G));
  modal.online = online_of_modes(*solution.online, modal, problem.estimator->covariance == Covariance::ud);
  modal.z0 = multiply(modal.inverse, padded(real(problem.estimator->x0), all, 1));
  if (!solution.regulator) return modal;
  modal.K = law_of_modes(solution.regulator->K, modal.T);
  for (const RealMatrix& K : solution.regulator->K_schedule) modal.K_schedule.push_back(law_of_modes(K, modal.T));
  return modal;
}

// Each matrix of `fine` beside that of `coarse`.
struct VisitModes {
  template <class Visit>
  void operator()(const ModalPlant& coarse, ModalPlant& fine, Visit visit) const {
    for (const auto matrix : {&ModalPlant::T, &ModalPlant::inverse, &ModalPlant::K, &ModalPlant::z0})
      visit(coarse.*matrix, fine.*matrix);
    for (const auto matrix : {&SampledPlant::A, &SampledPlant::B, &SampledPlant::C, &SampledPlant::D, &SampledPlant::G})
      visit(coarse.plant.*matrix, fine.plant.*matrix);
    for (const auto matrix :
         {&OnlineSolution::E, &OnlineSolution::C, &OnlineSolution::D, &OnlineSolution::M, &OnlineSolution::A_free,
          &OnlineSolution::W, &OnlineSolution::G, &OnlineSolution::P0, &OnlineSolution::U0})
      visit(coarse.online.*matrix, fine.online.*matrix);
    for (const auto vector : {&OnlineSolution::V, &OnlineSolution::w, &OnlineSolution::D0})
      visit(coarse.online.*vector, fine.online.*vector);
    for (std::size_t k = 0; k < fine.K_schedule.size(); ++k) visit(coarse.K_schedule[k], fine.K_schedule[k]);
  }
};

// What the target loses of the plant, or of the variances at the start and those that a sample adds; empty: nothing.
std::string what_is_lost(const ModalPlant& modal, Scalar real) {
  Findings findings;
  check_model(modal.plant, real, findings);
  if (!findings.empty()) return findings.front().message;
  for (const RealMatrix* covariance : {&modal.online.W, &modal.online.P0}) {
    const RealMatrix exact = covariance->diagonal(), rounded = held_by(real, exact);
    for (Index i = 0; i < exact.size(); ++i)
      if (rounded(i).is_zero() && !exact(i).is_zero())
        return std::string("a variance is too small for ") + (real == Scalar::float32 ? "float" : "double");
  }
  return "";
}

// What the loop is made of, as the target holds it.
Solution held_in_modes(const ModalPlant& modal, const Solution& solution, Scalar real) {
  const auto held = [&](const RealMatrix& a) { return held_by(real, a); };
  Solution result;
  result.plant = {held(modal.plant.A), held(modal.plant.B), held(modal.plant.C), held(modal.plant.D), modal.plant.G};
  result.regulator.emplace().K = held(modal.K);
  result.estimator.emplace().L = held(multiply(modal.inverse, solution.estimator->L));
  result.estimator->M = held(multiply(modal.inverse, solution.estimator->M));
  return result;
}

}  // namespace

std::string no_modal_plant(const Problem& problem) {
  if (!problem.estimator || problem.estimator->gain != Gain::online) return "the filter does not carry P";
  if (foresees(problem.limits)) return "limits are foreseen of x̂";
  if (!problem.stages.empty()) return "the plant, and its modes with it, changes from stage to stage";
  return "";
}

ModalPlantResult modal_plant(const Problem& problem, const Solution& solution) {
  Settled<ModalPlant> settled = settled_form<ModalPlant>(
      solution.numerics.digits, problem.code.real, [&] { return plant_in_modes(problem, solution); }, VisitModes{});
  ModalPlantResult result{std::move(settled.form), std::move(settled.obstacle)};
  if (settled.is_singular) result.obstacle = "a pole of the plant is repeated";
  if (settled.is_ill_conditioned)
    result.obstacle = "poles of the plant are so near each other that x = T z loses a factor of " + result.obstacle;
  if (!result.modal) return result;
  if (result.modal->agreement < solution.numerics.digits / 2.0)
    return {std::nullopt, "its modes are not found in half of the digits"};
  const std::string lost = what_is_lost(*result.modal, problem.code.real);
  return lost.empty() ? result : ModalPlantResult{std::nullopt, lost};
}

void check_rounded_modes(const Problem& problem, const ModalPlant& modal, Solution& solution, Findings& findings) {
  const Digits enough(std::max(50u, solution.numerics.digits / 2));
  if (!solution.loop.rounded) return;
  const auto controller_in = [&](Scalar real) { return compensator(problem, held_in_modes(modal, solution, real)); };
  check_rounded_controller(problem, sample_stages(problem).back(), controller_in, solution, findings);
}

}  // namespace lqg::design
