// SPDX-License-Identifier: MIT
// What the filter knows of its error over the first samples.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "emit/report/innovations.hpp"
#include "emit/report/sections.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

using Eigen::MatrixXd;

// The error of the estimate, sample by sample: e⁺ = (A − L_p C) e + G w − L_p v, L_p = A L + M.
struct Covariances {
  MatrixXd A, C, G, W, V, Swv, P;  // P: before the outputs of the sample to come

  // The optimal gain of this sample.
  MatrixXd optimal_gain() const { return P * C.transpose() * (C * P * C.transpose() + V).inverse(); }
  MatrixXd optimal_correction() const { return G * Swv * (C * P * C.transpose() + V).inverse(); }

  MatrixXd after_outputs(const MatrixXd& L) const {
    const MatrixXd F = MatrixXd::Identity(P.rows(), P.cols()) - L * C;
    return F * P * F.transpose() + L * V * L.transpose();
  }
  void advance(const MatrixXd& L, const MatrixXd& M) {
    const MatrixXd Lp = A * L + M, F = A - Lp * C, cross = G * Swv * Lp.transpose();
    P = F * P * F.transpose() + G * W * G.transpose() - cross - cross.transpose() + Lp * V * Lp.transpose();
    P = ((P + P.transpose()) / 2).eval();
  }
};

// Standard deviations and gains, column k of sample k.
struct Beginning {
  std::vector<double> times;
  MatrixXd deviation;          // nx × samples, after the outputs (of a predictor: before)
  std::vector<MatrixXd> gain;  // of each sample
};

bool is_known(const Controller& controller) {
  const auto& estimator = controller.problem.estimator;
  return controller.has.filter && !controller.solution.compensator && design::has_noise(estimator) &&
         controller.solution.noise && controller.problem.stages.empty() && estimator->P0.size() > 0;
}

const design::RealMatrix& row_of(const std::vector<design::RealMatrix>& table, const design::RealMatrix& last,
                                 std::size_t k) {
  return k < table.size() ? table[k] : last;
}

// Until the slowest pole of the estimator has done 98 %.
int samples_to_settle(const Controller& controller) {
  double largest = 0;
  if (controller.solution.estimator)
    for (const std::complex<double>& pole : controller.solution.estimator->poles)
      largest = std::max(largest, std::abs(pole));
  const double count = largest > 0 && largest < 1 ? std::log(0.02) / std::log(largest) : 200;
  return static_cast<int>(std::clamp(count, 20.0, 400.0));
}

Beginning beginning(const Controller& controller) {
  const design::Solution& solution = controller.solution;
  const bool is_on_line = carries_covariance(controller);
  Covariances now = {in_double(solution.plant.A),
                     in_double(solution.plant.C),
                     in_double(solution.plant.G),
                     in_double(solution.noise->W),
                     in_double(solution.noise->V),
                     in_double(solution.noise->Swv),
                     {}};
  now.P = in_double(controller.solution.start->P0);
  Beginning out;
  const int samples = samples_to_settle(controller);
  out.deviation.resize(now.A.rows(), samples);
  for (int k = 0; k < samples; ++k) {
    MatrixXd L, M;
    if (is_on_line) {
      L = now.optimal_gain(), M = now.optimal_correction();
    } else {
      const design::EstimatorSolution& estimator = *solution.estimator;
      L = in_double(row_of(estimator.L_schedule, estimator.L, static_cast<std::size_t>(k)));
      M = in_double(row_of(estimator.M_schedule, estimator.M, static_cast<std::size_t>(k)));
    }
    const MatrixXd P = controller.is_predictor ? now.P : now.after_outputs(L);
    out.deviation.col(k) = P.diagonal().cwiseMax(0).cwiseSqrt();
    out.times.push_back(k * controller.problem.plant.sample_time);
    out.gain.push_back(L);
    now.advance(L, M);
  }
  return out;
}

constexpr Mark line_marks[] = {Mark::line, Mark::dashes, Mark::dash_dots, Mark::dotted};

Chart deviation_chart(const std::string& unit, std::size_t number) {
  Chart chart;
  chart.title = "Standard deviation of the estimate's error";
  chart.id = "deviation-" + std::to_string(number);
  chart.group = "beginning";
  chart.x.label = "t [s]";
  chart.y = {unit, true};
  return chart;
}

// One chart for each unit; at most seven curves in one.
std::vector<Chart> deviation_charts(const Controller& controller, const Beginning& found) {
  std::vector<Chart> charts;
  const std::vector<design::Signal>& states = controller.problem.plant.states;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const std::string& unit = states[i].unit;
    auto same = std::find_if(charts.begin(), charts.end(),
                             [&](const Chart& chart) { return chart.y.label == unit && chart.curves.size() < 7; });
    if (same == charts.end()) same = charts.insert(same, deviation_chart(unit, charts.size()));
    Chart& chart = *same;
    const int number = static_cast<int>(chart.curves.size());
    Curve curve = {states[i].name, line_marks[number % 4], number, found.times, {}};
    for (Eigen::Index k = 0; k < found.deviation.cols(); ++k)
      curve.y.push_back(found.deviation(static_cast<Eigen::Index>(i), k));
    chart.curves.push_back(std::move(curve));
  }
  return charts;
}

// How much of an output's innovation is used, beside what it is in the end: |L e_i|, the first samples.
Chart gain_chart(const Controller& controller, const Beginning& found) {
  Chart chart;
  chart.title = "Gain of each output, relative to its last value";
  chart.id = "gains";
  chart.group = "beginning";
  chart.x.label = "t [s]";
  chart.y = {"1", true};
  for (int j = 0; j < controller.size.ny; ++j) {
    const double last = found.gain.back().col(j).norm();
    if (!(last > 0)) continue;
    Curve curve = {
        controller.problem.plant.outputs[static_cast<std::size_t>(j)].name, line_marks[j % 4], j, found.times, {}};
    for (const MatrixXd& gain : found.gain) curve.y.push_back(gain.col(j).norm() / last);
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

}  // namespace

PageSection estimator_section(const Controller& controller, const Runs& runs) {
  PageSection section = {"estimator", "The estimator", {}};
  PageView view;
  if (is_known(controller)) {
    const Beginning found = beginning(controller);
    view.text =
        "From the start, where the error has the covariance P0, to what it is for good; and what the "
        "innovations of a run tell of it.";
    view.charts = deviation_charts(controller, found);
    if (carries_covariance(controller) || controller.filters.size() > 1)
      view.charts.push_back(gain_chart(controller, found));
  }
  add_innovations(controller, runs, view);
  if (!view.charts.empty()) section.views.push_back(std::move(view));
  return section;
}

}  // namespace lqg::emit
