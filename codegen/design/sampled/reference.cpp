// SPDX-License-Identifier: MIT
#include "design/sampled/reference.hpp"

#include <algorithm>

#include "design/numeric/elimination.hpp"
#include "design/sampled/weights.hpp"

namespace lqg::design {

namespace {

// x = particular + null c with c free, column by column.
struct Freedom {
  RealMatrix particular, null;
};

// What is left free when xᵀWx is least.
Freedom least(const Freedom& of, const RealMatrix& W) {
  if (of.null.cols() == 0) return of;
  const RealMatrix slope = transpose_multiply(of.null, multiply(W, of.particular));
  const Eliminated solved = eliminated(transpose_congruence(of.null, W), -slope);
  return {of.particular + multiply(of.null, solved.particular), multiply(of.null, solved.null)};
}

}  // namespace

const std::vector<int>& integrated_outputs(const Problem& problem) {
  static const std::vector<int> none;
  return problem.regulator && problem.regulator->integral ? problem.regulator->integral->outputs : none;
}

std::vector<int> reference_outputs(const Problem& problem) {
  std::vector<int> outputs = integrated_outputs(problem);
  if (problem.regulator)
    outputs.insert(outputs.end(), problem.regulator->track.begin(), problem.regulator->track.end());
  std::sort(outputs.begin(), outputs.end());
  outputs.erase(std::unique(outputs.begin(), outputs.end()), outputs.end());
  return outputs;
}

std::optional<SetPoint> set_point(const Problem& problem, const SampledPlant& plant, Findings& findings) {
  const std::vector<int>& track = problem.regulator->track;
  const std::vector<int> outputs = reference_outputs(problem);
  const std::size_t before = findings.size();
  check_set_points(plant, track, "lqr.track", findings);
  if (findings.size() > before) return std::nullopt;
  const Index nx = plant.A.rows(), nu = plant.B.cols(), tracked = static_cast<Index>(track.size());
  RealMatrix wanted = zeros(nx + tracked, static_cast<Index>(outputs.size()));
  for (std::size_t i = 0; i < track.size(); ++i)
    for (std::size_t j = 0; j < outputs.size(); ++j)
      if (outputs[j] == track[i]) wanted(nx + static_cast<Index>(i), static_cast<Index>(j)) = 1;
  const RealMatrix M =
      above(beside(plant.A - identity(nx), plant.B), beside(rows_of(plant.C, track), rows_of(plant.D, track)));
  const Eliminated all = eliminated(M, wanted);
  RealMatrix of_u = zeros(nx + nu, nx + nu), of_x = of_u;
  of_u.bottomRightCorner(nu, nu) = stated_weights(problem).R;
  of_x.topLeftCorner(nx, nx) = identity(nx);
  const RealMatrix point = without_rounding(least(least({all.particular, all.null}, of_u), of_x).particular);
  return SetPoint{point.topRows(nx), point.bottomRows(nu)};
}

RealMatrix feed_forward(const Problem& problem, const RealMatrix& K, const RealMatrix& Gamma,
                        const SetPoint& set_point) {
  const Index nx = set_point.Nx.rows();
  const bool gives_change = problem.regulator->input_rate.size() > 0;
  const RealMatrix rest = gives_change ? above(set_point.Nx, set_point.Nu) : set_point.Nx;
  RealMatrix of_rest = beside(K.leftCols(nx), K.rightCols(rest.rows() - nx));
  if (Gamma.size() > 0) of_rest -= multiply(K.middleCols(nx, Gamma.rows()), Gamma);
  const RealMatrix out = multiply(of_rest, rest);
  return gives_change ? out : RealMatrix(set_point.Nu + out);
}

}  // namespace lqg::design
