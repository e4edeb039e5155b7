// SPDX-License-Identifier: MIT
#include "emit/plan/certified_iterations.hpp"

#include "controller/model_of.hpp"
#include "design/limits/certificate.hpp"
#include "design/numeric/digits.hpp"

namespace lqg::emit {

namespace {

// Beyond them a proof takes minutes, or does not come.
constexpr Eigen::Index most_rows = 12, most_states = 6;
constexpr long most_pieces = 40000;

}  // namespace

void certify_iterations(Controller& controller) {
  using Origin = controller::Iterations::Origin;
  const design::LimitedRows& rows = *controller.solution.foreseen;
  const Eigen::VectorXd& far = controller.worth->reach;
  if (controller.iterations.origin != Origin::cap || rows.G.rows() > most_rows) return;
  if (rows.F.cols() != far.size() || far.size() > most_states || controller.has.rate_limit) return;
  const design::Digits scope(std::max(50u, controller.solution.numerics.digits));
  const design::CertifiedBox box{-far, far, {}, {}};
  design::CertificateEffort effort;
  effort.tie_distance = controller.target.is_double ? 1e-9 : 2e-3;
  effort.pieces = most_pieces;
  const design::CertifiedChanges changes = design::certify_changes(
      design::limit_numbers(-controller.solution.regulator->K, rows, {}, controller.problem.code.real), box, effort);
  if (!changes.is_proved()) return;
  controller.iterations = {Origin::certified, static_cast<unsigned>(changes.changes), effort.tie_distance};
}

}  // namespace lqg::emit
