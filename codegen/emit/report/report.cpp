// SPDX-License-Identifier: MIT
#include "emit/report/report.hpp"

#include <cmath>

#include "emit/text/wording.hpp"
#include "emit/report/report_charts.hpp"
#include "emit/text/continuous_pole.hpp"
#include "emit/text/html.hpp"

namespace lqg::emit {

namespace {

std::string heading(const Controller& controller) {
  const design::Problem& problem = controller.problem;
  return "<h1>" + escaped(problem.name) + "</h1>\n" +
         (problem.brief.empty() ? "" : "<p class=\"brief\">" + escaped(problem.brief) + "</p>\n") +
         "<p class=\"made\">Made by lqgen " + version() + " from " + escaped(controller.source.file) + ", SHA-256 " +
         controller.source.sha256 + "</p>\n";
}

std::string with_unit(const std::optional<double>& value, const char* unit) {
  return value ? decimal(*value) + unit : "";
}

std::string names(const std::vector<design::Signal>& signals) {
  std::string out;
  for (const design::Signal& signal : signals) out += (out.empty() ? "" : ", ") + name_with_unit(signal);
  return out;
}

std::string filter_in_words(const Controller& controller) {
  switch (controller.filter) {
    case step::Filter::none: return "";
    case step::Filter::plain: return "covariance carried on line";
    case step::Filter::ud: return "UD factors carried on line";
    default:
      return controller.filters.size() > 1 ? "a schedule of " + std::to_string(controller.filters.size()) + " gains"
                                           : "constant gain";
  }
}

std::string overview(const Controller& controller) {
  const design::Plant& plant = controller.problem.plant;
  const Rows what = {{"Sample time", decimal(plant.sample_time) + " s"},
                     {"States", names(plant.states)},
                     {"Inputs", names(plant.inputs)},
                     {"Outputs", controller.has.filter ? names(plant.outputs) : ""},
                     {"Law", controller.has.regulator ? "u = " + equation_of_law(controller) : ""},
                     {"Filter", filter_in_words(controller)},
                     {"Form", !controller.has.filter    ? ""
                              : controller.is_predictor ? "predictor"
                                                        : "filter"}};
  const CodeCost& figures = controller.cost;
  const Rows code = {
      {"Code", std::string(controller.target.is_double ? "double, " : "float, ") +
                   (controller.target.is_fused ? "fused, " : "plain, ") +
                   (controller.style == design::Style::compact ? "compact" : "unrolled")},
      {"Multiply-adds a sample", std::to_string(figures.multiply_adds)},
      {"RAM", std::to_string(figures.ram) + " bytes"},
      {"Flash, at most, by arm-none-eabi-gcc 12.2 at -O2 for a Cortex-M4F", std::to_string(figures.flash) + " bytes"},
      {"Stack, likewise", std::to_string(figures.stack) + " bytes"},
      {"Digits of the design", std::to_string(controller.solution.numerics.digits)},
      {"Condition", decimal(controller.solution.numerics.condition)}};
  return "<div class=\"tables\">\n" + table(what) + table(code) + "</div>\n";
}

// The loop as it is designed beside the loop with the target's numbers.
std::string loop(const Controller& controller) {
  const design::LoopSolution& loop = controller.solution.loop;
  const auto row = [&](const char* what, const std::optional<double>& designed, const std::optional<double>& rounded,
                       const char* unit) {
    if (!designed) return std::string();
    return std::string("<tr><td>") + what + "</td><td>" + with_unit(designed, unit) + "</td><td>" +
           with_unit(rounded, unit) + "</td></tr>\n";
  };
  const design::RoundedLoop none, &target = loop.rounded ? *loop.rounded : none;
  const auto times = [&](const std::optional<double>& value, double factor) {
    return value ? std::optional(*value * factor) : std::nullopt;
  };
  const double T = controller.problem.plant.sample_time;
  const design::Margins &exact = loop.at_input, &held = target.at_input;
  const std::string rows =
      row("Gain margin at the inputs", loop.at_input.gain_dB, target.at_input.gain_dB, " dB") +
      row("— the gain may rise by", exact.gain_up_dB, held.gain_up_dB, " dB") +
      row("— the gain may fall by", exact.gain_down_dB, held.gain_down_dB, " dB") +
      row("Delay margin at the inputs, samples", exact.delay_samples, held.delay_samples, "") +
      row("— in seconds", times(exact.delay_samples, T), times(held.delay_samples, T), " s") +
      row("Crossover at the inputs", times(exact.crossover, 1 / T), times(held.crossover, 1 / T), " rad/s") +
      row("Phase margin at the inputs", loop.at_input.phase_deg, target.at_input.phase_deg, "°") +
      row("Disk margin at the inputs", loop.at_input.disk, target.at_input.disk, "") +
      row("Gain margin at the outputs", loop.at_output.gain_dB, target.at_output.gain_dB, " dB") +
      row("Phase margin at the outputs", loop.at_output.phase_deg, target.at_output.phase_deg, "°") +
      row("Disk margin at the outputs", loop.at_output.disk, target.at_output.disk, "") +
      row("Cost per sample", loop.cost_per_sample, target.cost_per_sample, "") +
      row("Cost per second", loop.cost_per_second, {}, "");
  if (rows.empty()) return "";
  return "<h2>The loop</h2>\n<table>\n<tr><th></th><th>as designed</th><th>with the numbers in " +
         std::string(controller.target.is_double ? "double" : "float") + "</th></tr>\n" + rows + "</table>\n";
}

std::string rms(const Controller& controller) {
  if (!controller.solution.loop.rms) return "";
  const design::Rms& rms = *controller.solution.loop.rms;
  Rows rows;
  const auto add = [&](const std::vector<design::Signal>& signals, const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) rows.push_back({name_with_unit(signals[i]), decimal(values[i])});
  };
  add(state_signals(controller), rms.x);
  add(controller.problem.plant.inputs, rms.u);
  add(controller.problem.plant.outputs, rms.y);
  return "<h2>Root mean squares</h2>\n<p>With the noises of the design, r = 0 and no limits: states, inputs, "
         "measured outputs.</p>\n" +
         table(rows);
}

std::string frequency(const std::complex<double>& pole, double sample_time) {
  const double angle = std::abs(std::arg(pole));
  return angle == 0 ? "" : decimal(angle / (2 * std::acos(-1.0) * sample_time)) + " Hz";
}

std::string time_constant(const std::complex<double>& pole, double sample_time) {
  const double size = std::abs(pole);
  if (size < 1e-12) return "0 s";
  if (std::abs(size - 1) < 1e-12) return "∞";
  return decimal(-sample_time / std::log(size)) + " s";
}

// Two cells: the pole in the s plane, and its damping.
std::string in_s(const std::complex<double>& pole, double sample_time) {
  const std::optional<ContinuousPole> found = continuous_pole(pole, sample_time);
  if (!found) return "</td><td>";
  return decimal(found->s.real()) + (found->s.imag() > 0 ? " ± " + decimal(found->s.imag()) + "i" : "") + "</td><td>" +
         decimal(found->damping);
}

std::string pole_rows(const char* whose, const design::Poles& poles, double sample_time) {
  std::string out;
  for (const std::complex<double>& pole : poles) {
    if (pole.imag() < 0) continue;  // stands with its conjugate
    out += std::string("<tr><td>") + whose + "</td><td>" + decimal(pole.real()) +
           (pole.imag() > 0 ? " ± " + decimal(pole.imag()) + "i" : "") + "</td><td>" + decimal(std::abs(pole)) +
           "</td><td>" + in_s(pole, sample_time) + "</td><td>" + time_constant(pole, sample_time) + "</td><td>" +
           frequency(pole, sample_time) + "</td></tr>\n";
  }
  return out;
}

std::string figure(const std::vector<Chart>& charts, const std::string& caption) {
  if (charts.empty()) return "";
  std::string out = "<figure style=\"margin:0\">\n<div class=\"charts\">\n";
  for (const Chart& chart : charts) out += svg(chart);
  return out + "</div>\n" + (caption.empty() ? "" : "<figcaption>" + escaped(caption) + "</figcaption>\n") +
         "</figure>\n";
}

std::string poles(const Controller& controller) {
  std::string rows;
  for (const auto& [owner, poles] : poles_to_show(controller))
    rows += pole_rows(owner, *poles, controller.problem.plant.sample_time);
  if (rows.empty()) return "";
  std::vector<Chart> charts = {pole_chart(controller)};
  for (Chart& chart : nyquist_charts(controller)) charts.push_back(std::move(chart));
  const std::string caption = charts.size() > 1 ? "The dashed circle about −1 is what the disk margin keeps free." : "";
  return "<h2>Poles</h2>\n" + figure(charts, caption) +
         "<table>\n<tr><th></th><th>z</th><th>|z|</th><th>s = ln(z)/T, rad/s</th>"
         "<th>damping</th><th>time constant</th><th>frequency</th></tr>\n" +
         rows + "</table>\n";
}

std::string runs(const Controller& controller) {
  std::string out;
  const Kick kick = kick_charts(controller);
  if (!kick.charts.empty())
    out += "<h2>After a kick</h2>\n" +
           figure(kick.charts, "From the state that " + kick.words + " for one sample leaves; without noise.");
  const std::vector<Chart> noisy = noisy_charts(controller);
  if (!noisy.empty())
    out += "<h2>At work</h2>\n" +
           figure(noisy, std::string("With the noises of the design") + (controller.size.nr ? " and r = 1." : "."));
  return out;
}

std::string matrix(const char* name, const design::RealMatrix& values, bool is_double) {
  if (values.size() == 0) return "";
  std::string out = "<details><summary>" + std::string(name) + ", " + std::to_string(values.rows()) + " × " +
                    std::to_string(values.cols()) + "</summary>\n<div class=\"matrix\"><table>\n";
  for (int i = 0; i < values.rows(); ++i) {
    out += "<tr>";
    for (int j = 0; j < values.cols(); ++j) out += "<td>" + number(values(i, j), is_double) + "</td>";
    out += "</tr>\n";
  }
  return out + "</table></div></details>\n";
}

std::string matrices(const Controller& controller) {
  const design::Solution& solution = controller.solution;
  const bool is_double = controller.target.is_double;
  std::string out = "<h2>Numbers</h2>\n";
  const auto add = [&](const char* name, const design::RealMatrix& values) { out += matrix(name, values, is_double); };
  add("A", solution.plant.A);
  add("B", solution.plant.B);
  if (controller.has.filter) {
    add("C", solution.plant.C);
    add("D", solution.plant.D);
    add("G", solution.plant.G);
  }
  if (solution.regulator) {
    const design::RegulatorSolution& regulator = *solution.regulator;
    add("Q of the samples", regulator.cost.Q);
    add("R of the samples", regulator.cost.R);
    add("N of the samples", regulator.cost.N);
    add("K", regulator.K);
    add("Nbar", regulator.Nbar);
    add("Γ, of ξ + Γ x̂, what the model does not explain", regulator.Gamma);
    add("H, of ξ + H (u − v)", regulator.H);
    add("X, the Riccati solution", regulator.X);
  }
  if (solution.estimator) {
    const design::EstimatorSolution& estimator = *solution.estimator;
    add("W = E[w wᵀ]", estimator.noise.W);
    add("V = E[v vᵀ]", estimator.noise.V);
    add("E[w vᵀ]", estimator.noise.Swv);
    add("L, filter gain", estimator.L);
    add("L_predictor", estimator.L_predictor);
    add("P before the outputs", estimator.P_prior);
    add("P after the outputs", estimator.P_posterior);
    add("S, of the innovations", estimator.S);
    add("L of the continuous equation", estimator.L_continuous);
    add("P of the continuous equation", estimator.P_continuous);
  }
  return out;
}

}  // namespace

std::string report(const Controller& controller) {
  return page(controller.problem.name, heading(controller) + overview(controller) + loop(controller) + rms(controller) +
                                           poles(controller) + runs(controller) + matrices(controller) +
                                           "<footer><p>This file is yours: use it under any licence.</p></footer>\n");
}

}  // namespace lqg::emit
