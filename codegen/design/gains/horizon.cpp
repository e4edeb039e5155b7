// SPDX-License-Identifier: MIT
#include "design/gains/horizon.hpp"

#include "design/equations/riccati_flow.hpp"
#include "design/progress.hpp"

namespace lqg::design {

namespace {

struct Step {
  RealMatrix K, X;
};

// The rows of `a` in which a or b has anything.
std::vector<int> rows_in_use(const RealMatrix& a, const RealMatrix& b) {
  std::vector<int> rows;
  for (Index i = 0; i < a.rows(); ++i)
    if (!is_zero(a.row(i)) || !is_zero(b.row(i))) rows.push_back(static_cast<int>(i));
  return rows;
}

// gain_of, with zeros for inputs that cost nothing and do nothing.
std::optional<RealMatrix> gain_before(const RiccatiEquation& e, const RealMatrix& X) {
  const std::optional<RealMatrix> gain = gain_of(e, X);
  if (gain) return gain;
  const RealMatrix XB = multiply(X, e.B), weight = e.R + symmetric_part(transpose_multiply(e.B, XB));
  const std::vector<int> used = rows_in_use(weight, transpose_multiply(XB, e.A) + e.N.transpose());
  RealMatrix K = zeros(e.B.cols(), e.A.rows());
  if (used.empty()) return K;
  if (static_cast<Index>(used.size()) == K.rows()) return std::nullopt;
  const RealMatrix B = rows_of(e.B.transpose(), used).transpose(), N = rows_of(e.N.transpose(), used).transpose();
  const RealMatrix R = rows_of(rows_of(e.R, used).transpose(), used);
  const std::optional<RealMatrix> part = gain_of({e.A, B, e.Q, R, N}, X);
  if (!part) return std::nullopt;
  for (std::size_t i = 0; i < used.size(); ++i) K.row(used[i]) = part->row(static_cast<Index>(i));
  return K;
}

std::optional<Step> discrete_step(const RiccatiEquation& e, const RealMatrix& X_next) {
  const std::optional<RealMatrix> K = gain_before(e, X_next);
  if (!K) return std::nullopt;
  return Step{*K, step_cost(e, *K) + transpose_congruence(e.A - multiply(e.B, *K), X_next)};
}

std::optional<Step> continuous_step(const RiccatiEquation& e, const RiccatiFlow& flow, const RealMatrix& X_next) {
  const std::optional<RealMatrix> X = carried_back(flow, X_next);
  if (!X) return std::nullopt;
  return Step{*solve(e.R, transpose_multiply(e.B, *X) + e.N.transpose()), *X};
}

// One stage, ready for any number of steps.
struct StageSteps {
  RiccatiEquation equation;
  std::optional<RiccatiFlow> flow;  // of a continuous cost

  explicit StageSteps(const SampledStage& stage) : equation(regulator_equation(stage.problem, stage.of_regulator())) {
    if (stage.problem.regulator->cost == Cost::continuous)
      flow = riccati_flow(equation, Real(stage.problem.plant.sample_time));
  }
  std::optional<Step> before(const RealMatrix& X_next) const {
    return flow ? continuous_step(equation, *flow, X_next) : discrete_step(equation, X_next);
  }
};

}  // namespace

GainTable gains_backward(const std::vector<SampledStage>& stages, int steps, const RealMatrix& X_end) {
  std::vector<StageSteps> prepared;
  for (const SampledStage& stage : stages) prepared.emplace_back(stage);
  GainTable table;
  table.K.resize(static_cast<std::size_t>(steps));
  RealMatrix X = X_end;
  for (int k = steps - 1; k >= 0; --k) {
    report_progress("gains from the end back", steps - k, steps);
    const std::ptrdiff_t stage = &stage_at(stages, k) - stages.data();
    const std::optional<Step> step = prepared[static_cast<std::size_t>(stage)].before(X);
    if (!step) {
      table.failed_at = k;
      return table;
    }
    X = step->X;
    table.K[static_cast<std::size_t>(k)] = step->K;
    if (k == steps - 1) table.X_last = X;
  }
  table.X_first = X;
  return table;
}

RealMatrix final_weight(const SampledStage& last, const Eigen::MatrixXd& Q_final) {
  const Index size = regulated_plant(last.problem, last.of_regulator().plant).A.rows();
  return padded(real(Q_final), size, size);
}

}  // namespace lqg::design
