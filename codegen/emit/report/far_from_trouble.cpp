// SPDX-License-Identifier: MIT
// What may be wrong with the model: Bode, sensitivities, Nyquist, loop by loop.
#include <algorithm>
#include <cmath>

#include "emit/report/loop_response.hpp"
#include "emit/report/nyquist.hpp"
#include "emit/report/sections.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

const double pi = std::acos(-1.0);

// A chart over frequency, in Hz up to half the sampling frequency.
Chart over_frequency(const std::string& title, const std::string& id, const std::string& unit) {
  Chart chart;
  chart.title = title;
  chart.id = id;
  chart.group = "frequency";
  chart.x = {"frequency [Hz]", true};
  chart.y = {unit, false};
  return chart;
}

// What lies far below or above 0 dB is outside at first.
void look_about_0_dB(double lowest, double highest, Chart& chart) {
  double low = 0, high = 0;
  for (const Curve& curve : chart.curves)
    for (const double y : curve.y) low = std::min(low, y), high = std::max(high, y);
  chart.y_low = std::max(low, lowest) - 2, chart.y_high = std::min(high, highest) + 6;
}

std::vector<double> frequencies(const std::vector<double>& angles, double sample_time) {
  std::vector<double> out;
  for (const double angle : angles) out.push_back(hertz(angle, sample_time));
  return out;
}

// Curves of gains in dB are cut off far below what matters.
double shown_decibels(double gain) { return std::max(decibels(gain), -200.0); }

// Above the curve.
void make_room_for_words(Chart& chart) {
  const Window window = window_of(chart);
  chart.y_low = window.y_low;
  chart.y_high = window.y_high + 0.15 * (window.y_high - window.y_low);
}

template <class Value>
std::vector<double> decibels_of(const std::vector<Complex>& L, Value value) {
  std::vector<double> out;
  for (const Complex& l : L) out.push_back(shown_decibels(std::abs(value(l))));
  return out;
}

// In degrees, without jumps; of the angles that it can be called by those with which it is nearest to −180° where the
// gain is nearest to 1.
std::vector<double> phase_of(const std::vector<Complex>& L) {
  std::vector<double> out;
  for (const Complex& l : L) {
    double phase = std::arg(l) * 180 / pi;
    const double before = out.empty() ? -90 : out.back();
    phase -= 360 * std::round((phase - before) / 360);
    out.push_back(phase);
  }
  const auto from_crossover = [](const Complex& a, const Complex& b) {
    return std::abs(std::log(std::abs(a))) < std::abs(std::log(std::abs(b)));
  };
  const auto crossover = std::min_element(L.begin(), L.end(), from_crossover) - L.begin();
  const double turns = std::round((out[static_cast<std::size_t>(crossover)] + 180) / 360);
  for (double& phase : out) phase -= 360 * turns;
  return out;
}

// Where the loop's gain is 1, and by how much its phase misses −180° there.
void mark_crossovers(const LoopCurve& loop, double T, Chart& gain, Chart& phase) {
  for (const double angle : places(loop, [](Complex l) { return std::abs(l) - 1; })) {
    const double f = hertz(angle, T), degrees = std::arg(-loop.at(angle)) * 180 / pi;
    gain.guides.push_back({Guide::Axis::x, f, "crossover " + with_unit(f, "Hz")});
    phase.guides.push_back({Guide::Axis::x, f, "phase " + decimal(std::abs(degrees)) + "° from −180°"});
  }
}

// Where the loop is real and negative: the factor that makes it −1.
void mark_gain_margins(const LoopCurve& loop, double T, Chart& gain) {
  for (const double angle : places(loop, [](Complex l) { return l.imag(); })) {
    const Complex l = loop.at(angle);
    if (!(l.real() < 0) || std::abs(l.imag()) > 1e-3 * std::abs(l.real())) continue;
    const double margin = -decibels(std::abs(l));
    if (std::abs(margin) > 60) continue;
    gain.notes.push_back(
        {hertz(angle, T), -margin, (margin > 0 ? "+" : "−") + decimal(std::abs(margin)) + " dB", 0, 0});
  }
}

std::vector<Chart> bode(const LoopCurve& loop, double T, const std::string& id) {
  Chart gain = over_frequency("Gain of the loop |L|", id + "-gain", "dB");
  Chart phase = over_frequency("Phase of the loop", id + "-phase", "°");
  const std::vector<double> f = frequencies(loop.angles, T);
  gain.curves = {{"|L|", Mark::line, 0, f, decibels_of(loop.L, [](Complex l) { return l; })}};
  phase.curves = {{"phase of L", Mark::line, 0, f, phase_of(loop.L)}};
  gain.guides.push_back({Guide::Axis::y, 0, ""});
  phase.guides.push_back({Guide::Axis::y, -180, "−180°"});
  look_about_0_dB(-60, 80, gain);
  make_room_for_words(phase);
  mark_crossovers(loop, T, gain, phase);
  mark_gain_margins(loop, T, gain);
  return {gain, phase};
}

std::string peak_of(const std::string& name, const Curve& curve) {
  return name + " at most " + decimal(*std::max_element(curve.y.begin(), curve.y.end())) + " dB";
}

Chart sensitivities(const LoopCurve& loop, double T, const std::string& id) {
  Chart chart = over_frequency("", id + "-sensitivity", "dB");
  const std::vector<double> f = frequencies(loop.angles, T);
  chart.curves = {{"|S|", Mark::line, 0, f, decibels_of(loop.L, [](Complex l) { return 1.0 / (1.0 + l); })},
                  {"|T|", Mark::dashes, 1, f, decibels_of(loop.L, [](Complex l) { return l / (1.0 + l); })}};
  chart.guides.push_back({Guide::Axis::y, 0, ""});
  look_about_0_dB(-40, 40, chart);
  chart.title = peak_of("|S|", chart.curves[0]) + ", " + peak_of("|T|", chart.curves[1]);
  return chart;
}

Chart singular_values(const LoopResponse& response, const std::vector<std::vector<double>>& values,
                      const std::string& name, const std::string& title) {
  Chart chart = over_frequency(title, "singular-" + name, "dB");
  const std::vector<double> f = frequencies(response.angles, response.sample_time);
  const std::size_t count = values.front().size();
  constexpr Mark marks[] = {Mark::line, Mark::dashes, Mark::dash_dots, Mark::dotted};
  for (std::size_t i = 0; i < count; ++i) {
    Curve curve = {"σ" + std::to_string(i + 1) + "(" + name + ")", marks[i % 4], static_cast<int>(i), f, {}};
    for (const std::vector<double>& at : values) curve.y.push_back(shown_decibels(at[i]));
    chart.curves.push_back(std::move(curve));
  }
  chart.guides.push_back({Guide::Axis::y, 0, ""});
  name == "L" ? look_about_0_dB(-60, 80, chart) : look_about_0_dB(-40, 40, chart);
  if (name != "L") chart.title += ", " + peak_of("σ1", chart.curves.front());
  return chart;
}

PageView all_loops(const LoopResponse& response) {
  PageView view;
  view.name = "All loops";
  view.charts = {singular_values(response, response.of_L, "L", "Singular values of the loop L"),
                 singular_values(response, response.of_S, "S", "Singular values of S = (I + L)⁻¹"),
                 singular_values(response, response.of_T, "T", "Singular values of T = L (I + L)⁻¹")};
  view.caption = "All loops are opened at the inputs of the plant.";
  return view;
}

PageView one_loop(const Controller& controller, const LoopResponse& response, std::size_t input) {
  const LoopCurve& loop = response.loops[input];
  const std::string id = "loop" + std::to_string(input), &name = controller.problem.plant.inputs[input].name;
  const bool is_alone = response.loops.size() == 1;
  PageView view;
  view.name = is_alone ? "" : name;
  view.text = "The loop opened at " + name + (is_alone ? "." : ", the others closed.");
  view.charts = bode(loop, response.sample_time, id);
  view.charts.push_back(sensitivities(loop, response.sample_time, id));
  const std::optional<double> disk = is_alone ? controller.solution.loop.at_input.disk : std::nullopt;
  for (Chart& chart : nyquist(loop, response.sample_time, disk, id)) view.charts.push_back(std::move(chart));
  if (disk) view.caption = "The dashed circle about −1 is what the disk margin keeps free.";
  return view;
}

}  // namespace

PageSection far_from_trouble(const Controller& controller) {
  PageSection section = {"margins", "How far from trouble", {}};
  const std::optional<LoopResponse> response = loop_response(controller);
  if (!response) return section;
  if (response->loops.size() > 1) section.views.push_back(all_loops(*response));
  for (std::size_t i = 0; i < response->loops.size(); ++i) section.views.push_back(one_loop(controller, *response, i));
  return section;
}

}  // namespace lqg::emit
