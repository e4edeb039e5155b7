// SPDX-License-Identifier: MIT
#include "design/sampled/delay_reduction.hpp"

namespace lqg::design {

namespace {

// The plant with its integrals, driven by u.
RegulatedPlant driven_by_input(const Problem& problem, const SampledPlant& plant) {
  Problem without_rate = problem;
  without_rate.regulator->input_rate = Eigen::MatrixXd();
  return regulated_plant(without_rate, plant);
}

// z⁺ = A z + B u over the inputs on their way but the first `left`, from the rows of `z` on that are z now;
// `inputs` are the rows of all inputs on their way.
RealMatrix after_inputs(const RegulatedPlant& plant, RealMatrix z, const RealMatrix& inputs, Index left) {
  const Index nu = plant.B.cols();
  for (Index at = left * nu; at < inputs.rows(); at += nu)
    z = multiply(plant.A, z) + multiply(plant.B, inputs.middleRows(at, nu));
  return z;
}

// Does the delay postpone all of the cost? Not N of the samples, which weighs u when it is decided; and with a decay,
// that makes what comes later dearer, neither R of the samples nor the weight of Δu.
bool is_postponed(const Problem& problem) {
  const Regulator& lqr = *problem.regulator;
  const bool is_discrete = lqr.cost == Cost::discrete;
  if (decay_of(problem) != 1) return !is_discrete && lqr.input_rate.size() == 0;
  return !is_discrete || lqr.N.isZero(0);
}

// X ← X + rowsᵀ Q rows, where few columns of `rows` are not zero.
void add_weight(RealMatrix& X, const RealMatrix& rows, const RealMatrix& Q) {
  std::vector<Index> used;
  for (Index j = 0; j < rows.cols(); ++j)
    if (!is_zero(rows.col(j))) used.push_back(j);
  const std::size_t count = used.size();
  RealMatrix seen(rows.rows(), static_cast<Index>(count));
  for (std::size_t j = 0; j < count; ++j) seen.col(static_cast<Index>(j)) = rows.col(used[j]);
  const RealMatrix weight = transpose_congruence(seen, Q);
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t i = 0; i < count; ++i) X(used[i], used[j]) += weight(static_cast<Index>(i), static_cast<Index>(j));
}

}  // namespace

std::optional<Prediction> without_whole_periods(const Problem& problem, const Samples& samples) {
  Delay delay = delay_of(problem.plant);
  const Index left = delay.is_whole ? 0 : 1;
  if (delay.samples <= left) return std::nullopt;
  const Index nx = samples.own_states, nu = samples.plant.B.cols(), on_their_way = delay.samples * nu;
  Prediction result;
  result.steps = delay.samples - left;
  delay.samples = left;
  result.samples = sample(problem, delay);
  const RealMatrix all = identity(regulated_plant(problem, samples.plant).A.rows());
  const Index kept = problem.regulator->input_rate.size() > 0 ? nu : 0;
  const Index integrals = all.rows() - nx - on_their_way - kept;
  const RealMatrix inputs = all.middleRows(nx, on_their_way);
  const RealMatrix now = above(all.topRows(nx + left * nu), all.middleRows(nx + on_their_way, integrals));
  result.predict =
      above(after_inputs(driven_by_input(problem, result.samples.plant), now, inputs, left), all.bottomRows(kept));
  result.is_exact = is_postponed(problem);
  return result;
}

RealMatrix cost_after_prediction(const Problem& problem, const RiccatiEquation& e, const Prediction& prediction,
                                 const RealMatrix& X_sooner) {
  const Index nz = e.A.rows(), kept = problem.regulator->input_rate.size() > 0 ? e.B.cols() : 0;
  std::vector<Index> weighed;  // not u[k−1]: its weight is that of the u that is decided
  for (Index i = 0; i + kept < nz; ++i)
    if (!is_zero(e.Q.row(i))) weighed.push_back(i);
  const Index count = static_cast<Index>(weighed.size());
  RealMatrix rows(count, nz), Q(count, count);
  for (Index i = 0; i < count; ++i) {
    const Index row = weighed[static_cast<std::size_t>(i)];
    rows.row(i) = identity(nz).row(row);
    for (Index j = 0; j < count; ++j) Q(i, j) = e.Q(row, weighed[static_cast<std::size_t>(j)]);
  }
  RealMatrix X = pow(decay_of(problem), 2 * prediction.steps) * transpose_congruence(prediction.predict, X_sooner);
  for (Index k = 0; k < prediction.steps; ++k) {
    add_weight(X, rows, Q);
    rows = multiply(rows, e.A);
  }
  return X;
}

}  // namespace lqg::design
