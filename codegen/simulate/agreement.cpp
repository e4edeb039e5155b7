// SPDX-License-Identifier: MIT
#include "simulate/agreement.hpp"

#include <algorithm>

#include "controller/operating_point.hpp"
#include "design/numeric/digits.hpp"
#include "design/numeric/linear_algebra.hpp"
#include "design/rounding.hpp"
#include "simulate/emitted_controller.hpp"

namespace lqg::simulate {

namespace {

using design::Real;
using design::RealMatrix;
using Eigen::Index;

// u, sample by sample, for an impulse of output j in the first.
std::vector<Vector<Real>> answers_to_impulse(EmittedController<Real> emitted, Index j, Index samples) {
  const step::Model<Real>& model = emitted.model();
  emitted.state().x.setConstant(Real(0));
  Vector<Real> u, y = Vector<Real>::Constant(model.ny, Real(0));
  y(j) = 1;
  std::vector<Vector<Real>> answers;
  while (static_cast<Index>(answers.size()) < samples) {
    if (model.predictor_form) emitted.control(u);
    emitted.update(y);
    if (!model.predictor_form) emitted.control(u);
    emitted.predict(u);
    answers.push_back(u);
    y(j) = 0;
  }
  return answers;
}

// The same of all outputs: a column each.
std::vector<RealMatrix> answers_of(const Controller& physical, Index samples) {
  const unsigned digits = digits_of_agreement(physical.solution);
  const Controller at_zero = controller::without_point(physical);
  const EmittedController<Real> emitted(at_zero, [digits](const Real& value) { return Real(value, digits); });
  std::vector<RealMatrix> answers(static_cast<std::size_t>(samples), RealMatrix(physical.size.nu, physical.size.ny));
  for (Index j = 0; j < physical.size.ny; ++j) {
    const std::vector<Vector<Real>> column = answers_to_impulse(emitted, j, samples);
    for (std::size_t k = 0; k < column.size(); ++k) answers[k].col(j) = column[k];
  }
  return answers;
}

}  // namespace

unsigned digits_of_agreement(const design::Solution& solution) { return std::max(solution.numerics.digits, 100u); }

double agreement(const Controller& physical, const design::LinearForm& form) {
  const design::Digits digits(digits_of_agreement(physical.solution));
  const std::vector<RealMatrix> wanted = answers_of(physical, 2 * form.A.rows() + 1);
  RealMatrix found = form.D, states = form.B, difference = design::zeros(found.rows(), found.cols()),
             scale = difference;
  for (const RealMatrix& answer : wanted) {
    difference = difference.cwiseMax((found - answer).cwiseAbs());
    scale = scale.cwiseMax(answer.cwiseAbs());
    found = design::multiply(form.C, states);
    states = design::multiply(form.A, states);
  }
  const Real whole = design::largest_entry(scale);
  Real worst = design::negligible(1);
  for (Index i = 0; i < scale.size(); ++i) {
    const Real& own = scale.data()[i].is_zero() ? whole : scale.data()[i];
    if (!own.is_zero()) worst = std::max<Real>(worst, difference.data()[i] / own);
  }
  return design::to_double(-log10(worst));
}

}  // namespace lqg::simulate
