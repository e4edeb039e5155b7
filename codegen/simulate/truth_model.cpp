// SPDX-License-Identifier: MIT
#include "simulate/truth_model.hpp"

#include <algorithm>
#include <cmath>

#include "design/rounding.hpp"
#include "design/sampled/added_states.hpp"
#include "simulate/designed.hpp"

namespace lqg::simulate {

namespace {

using design::Scenario;
using Eigen::Index;
using Eigen::MatrixXd;

// A delay or a time of a sensor within this of whole periods is whole.
constexpr double nearly_whole = 1e-9;

const MatrixXd& given_or(const MatrixXd& given, const MatrixXd& otherwise) { return given.size() ? given : otherwise; }

void scale_entries(const Scenario& scenario, char matrix, MatrixXd& M) {
  for (const design::ScaledEntries& scaled : scenario.plant.scale) {
    if (scaled.matrix != matrix) continue;
    for (Index i = 0; i < M.rows(); ++i)
      for (Index j = 0; j < M.cols(); ++j)
        if ((scaled.row < 0 || scaled.row == i) && (scaled.column < 0 || scaled.column == j)) M(i, j) *= scaled.factor;
  }
}

void multiply_entries(const MatrixXd& factors, MatrixXd& M) {
  if (factors.size()) M = M.cwiseProduct(factors);
}

const design::Actuator* actuator_of(const Scenario& scenario, int input) {
  for (const design::Actuator& actuator : scenario.actuator)
    if (actuator.input == input && actuator.time_constant > 0) return &actuator;
  return nullptr;
}

// With the actuators' lags as states, and h as input.
struct Whole {
  MatrixXd A, B;
};

// a of lag i: a' = (asked − a)/τ of a continuous plant; of a sampled one a⁺ = s a + (1 − s) asked, and a⁺ acts.
Whole with_lags(const TruthModel& model, const TruthModel::Stage& stage) {
  const Index n = model.nx + static_cast<Index>(model.lagged.size());
  Whole whole = {MatrixXd::Zero(n, n), MatrixXd::Zero(n, model.nu + (model.has_loads ? model.nu + model.nx : 0))};
  whole.A.topLeftCorner(model.nx, model.nx) = stage.A;
  whole.B.topLeftCorner(model.nx, model.nu) = stage.B;
  if (model.has_loads) {
    whole.B.block(0, model.nu, model.nx, model.nu) = stage.B;
    whole.B.block(0, 2 * model.nu, model.nx, model.nx) = MatrixXd::Identity(model.nx, model.nx);
  }
  for (std::size_t i = 0; i < model.lagged.size(); ++i) {
    const Index input = model.lagged[i], lag = model.nx + static_cast<Index>(i);
    const double rate = 1 / actuator_of(*model.scenario, model.lagged[i])->time_constant;
    const double stays =
        model.is_continuous ? 0 : period_of(MatrixXd::Constant(1, 1, -rate), MatrixXd::Zero(1, 0), model.T).A(0, 0);
    whole.A(lag, lag) = model.is_continuous ? -rate : stays;
    whole.B(lag, input) = model.is_continuous ? rate : 1 - stays;
    whole.A.col(lag).head(model.nx) = stage.B.col(input) * (model.is_continuous ? 1 : stays);
    whole.B.col(input).head(model.nx) = stage.B.col(input) * (model.is_continuous ? 0 : 1 - stays);
  }
  return whole;
}

void add_moves(const TruthModel& model, TruthModel::Stage& stage) {
  if (model.motion) return;
  const Whole whole = with_lags(model, stage);
  stage.moves.clear();
  for (const double time : model.times)
    stage.moves.push_back({time, model.is_continuous ? period_of(whole.A, whole.B, time) : Period{whole.A, whole.B}});
}

// Over which times the state is moved: to the next sample, to the instants that are shown, to those of late sensors;
// until a late input acts, and from then on.
std::vector<double> times_of(const TruthModel& model) {
  std::vector<double> ends = {model.T}, times;
  ends.insert(ends.end(), model.instants.begin(), model.instants.end());
  for (const double delay : model.output_delay)
    if (const double part = within_period(delay, model.T); part > 0) ends.push_back(model.T - part);
  for (const double end : ends) {
    times.push_back(std::min(end, model.part > 0 ? model.part : end));
    if (model.part > 0 && end > model.part) times.push_back(end - model.part);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

TruthModel::Stage stage_of(const TruthModel& model, std::size_t from) {
  const controller::Controller& controller = *model.controller;
  const design::PlantChange& change = model.scenario->plant;
  TruthModel::Stage stage;
  stage.from = from;
  const design::Plant& plant = controller.problem.plant;
  stage.A = given_or(change.A, plant.A), stage.B = given_or(change.B, plant.B), stage.C = given_or(change.C, plant.C);
  stage.D = plant.D;
  for (const design::Stage& later : controller.problem.stages) {
    if (static_cast<std::size_t>(later.from) > from) break;
    stage.A = given_or(later.A, stage.A), stage.B = given_or(later.B, stage.B);
    stage.C = given_or(later.C, stage.C), stage.D = given_or(later.D, stage.D);
  }
  scale_entries(*model.scenario, 'A', stage.A);
  scale_entries(*model.scenario, 'B', stage.B);
  scale_entries(*model.scenario, 'C', stage.C);
  const PlantNoise wanted = model.scenario->noise ? PlantNoise::designed : PlantNoise::none;
  const MatrixXd factor = noise_factor(controller, from, wanted);
  stage.noise_factor.resize(model.nx + model.ny, factor.cols());
  stage.noise_factor << factor.topRows(model.nx), factor.bottomRows(model.ny);
  if (const design::SampledCost* cost = sampled_cost(controller, from)) {
    stage.Q = design::to_doubles(cost->Q);
    stage.R = design::to_doubles(cost->R);
    stage.N = design::to_doubles(cost->N);
  }
  return stage;
}

std::shared_ptr<const Motion> motion_of(const TruthModel& model) {
  const design::Plant& plant = model.controller->problem.plant;
  if (!plant.equations) return nullptr;
  std::vector<Lag> lags;
  for (const int input : model.lagged) lags.push_back({input, actuator_of(*model.scenario, input)->time_constant});
  return std::make_shared<const Motion>(plant, model.scenario->plant.parameters, lags);
}

}  // namespace

double within_period(double time, double sample_time) {
  const double periods = time / sample_time;
  const double part = periods - std::floor(periods + nearly_whole);
  return part < nearly_whole ? 0 : part * sample_time;
}

const TruthModel::Stage& TruthModel::stage_at(int sample) const {
  std::size_t at = 0;
  while (at + 1 < stages.size() && static_cast<int>(stages[at + 1].from) <= sample) ++at;
  return stages[at];
}

TruthModel TruthModel::with(const Factors& factors) const {
  TruthModel other = *this;
  for (Stage& stage : other.stages) {
    multiply_entries(factors.A, stage.A);
    multiply_entries(factors.B, stage.B);
    multiply_entries(factors.C, stage.C);
    add_moves(other, stage);
  }
  return other;
}

TruthModel truth_model(const controller::Controller& controller, const Scenario& scenario, const Courses& courses,
                       int instants) {
  const design::Plant& plant = controller.problem.plant;
  TruthModel model;
  model.controller = &controller, model.scenario = &scenario, model.courses = &courses;
  model.nx = plant.A.rows(), model.nu = plant.B.cols(), model.ny = plant.C.rows();
  model.T = plant.sample_time;
  model.is_continuous = scenario.plant.continuous || plant.domain == design::Domain::continuous;
  model.has_loads = !scenario.load.empty() || !scenario.state_load.empty();
  const double delay = scenario.plant.delay.value_or(plant.delay);
  model.late = static_cast<int>(std::floor(delay / model.T + nearly_whole));
  model.part = within_period(delay, model.T);
  model.output_delay =
      plant.output_delay.size() ? plant.output_delay : Eigen::VectorXd(Eigen::VectorXd::Zero(model.ny));
  for (const design::Sensor& sensor : scenario.sensor) model.output_delay(sensor.output) += sensor.delay;
  model.added = design::added_states(controller.problem);
  model.designed_delay = static_cast<int>(std::ceil(plant.delay / model.T - nearly_whole));
  for (int i = 1; i < instants && model.is_continuous; ++i) model.instants.push_back(model.T * i / instants);
  for (int input = 0; input < model.nu; ++input)
    if (actuator_of(scenario, input)) model.lagged.push_back(input);
  model.times = times_of(model);
  model.motion = motion_of(model);
  model.stages.push_back(stage_of(model, 0));
  for (const design::Stage& stage : controller.problem.stages)
    model.stages.push_back(stage_of(model, static_cast<std::size_t>(stage.from)));
  for (TruthModel::Stage& stage : model.stages) add_moves(model, stage);
  return model;
}

}  // namespace lqg::simulate
