// SPDX-License-Identifier: MIT
#include "design/sampled/stages.hpp"

#include "design/sampled/added_states.hpp"

namespace lqg::design {

namespace {

void replace(const ExactMatrix& by, ExactMatrix& matrix) {
  if (by.size() > 0) matrix = by;
}

// `stage` in the place of what the problem says; what it leaves out stays.
Problem replaced(Problem problem, const Stage& stage) {
  Plant& plant = problem.plant;
  replace(stage.A, plant.A);
  replace(stage.B, plant.B);
  replace(stage.C, plant.C);
  replace(stage.D, plant.D);
  replace(stage.G, plant.G);
  if (problem.regulator) {
    replace(stage.Q, problem.regulator->Q);
    replace(stage.R, problem.regulator->R);
    replace(stage.N, problem.regulator->N);
  }
  if (problem.estimator) {
    replace(stage.W, problem.estimator->W);
    replace(stage.V, problem.estimator->V);
  }
  return problem;
}

}  // namespace

std::vector<Problem> problems_of_stages(const Problem& problem) {
  std::vector<Problem> problems = {problem};
  problems.front().stages.clear();
  for (const Stage& stage : problem.stages) problems.push_back(replaced(problems.back(), stage));
  return problems;
}

std::vector<SampledStage> sample_stages(const Problem& problem) {
  std::vector<SampledStage> stages;
  for (const Problem& of_stage : problems_of_stages(problem)) {
    const int from = stages.empty() ? 0 : problem.stages[stages.size() - 1].from;
    SampledStage stage = {from, of_stage, sample(of_stage), std::nullopt, std::nullopt, std::nullopt};
    if (has_added_states(of_stage)) {
      stage.own = std::move(stage.samples);
      stage.surrounding = with_late_outputs(of_stage, *stage.own);
      stage.filtered = with_disturbances(of_stage);
      stage.samples = filter_model(of_stage, *stage.filtered, *stage.own);
    }
    stages.push_back(std::move(stage));
  }
  return stages;
}

const SampledStage& stage_at(const std::vector<SampledStage>& stages, int k) {
  std::size_t i = stages.size() - 1;
  while (i > 0 && stages[i].from > k) --i;
  return stages[i];
}

}  // namespace lqg::design
