// SPDX-License-Identifier: MIT
// Name, verdict, the six figures.
#include <algorithm>
#include <cmath>

#include "emit/report/sections.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

// Margins below these are small (K. J. Åström, R. M. Murray, "Feedback Systems", section 10.3: 6 dB, 30° and |S| < 2).
constexpr double small_gain_dB = 6, small_phase_deg = 30, small_delay = 1, small_disk = 2.0 / 3;

std::string at_least(const std::optional<double>& least, const std::string& unit) {
  return least ? "at least " + with_unit(*least, unit) : "";
}

PageFigure gain_margin(const design::Margins& margins, const design::Requirements& wanted) {
  PageFigure figure = {"Gain margin, down / up"};
  const auto side = [](const std::optional<double>& value, const char* sign) {
    return value ? sign + decimal(std::abs(*value)) : std::string(sign) + "∞";
  };
  figure.value = side(margins.gain_down_dB, "−") + " / " + side(margins.gain_up_dB, "+") + " dB";
  figure.requirement = at_least(wanted.gain_margin_dB, "dB");
  figure.is_met = !wanted.gain_margin_dB || !margins.gain_dB || *margins.gain_dB >= *wanted.gain_margin_dB;
  return figure;
}

PageFigure margin(const std::string& name, const std::optional<double>& value, const std::string& unit,
                  const std::optional<double>& least) {
  return {name, value ? with_unit(*value, unit) : "∞", at_least(least, unit), !least || !value || *value >= *least};
}

PageFigure delay_margin(const design::Margins& margins, const Controller& controller) {
  const double T = controller.problem.plant.sample_time;
  const std::optional<double>& least = controller.problem.requirements.delay_margin;
  const std::string required = at_least(least ? std::optional(*least / T) : std::nullopt, "samples");
  if (!margins.delay_samples) return {"Delay margin", "∞", required, true};
  return {"Delay margin", with_unit(*margins.delay_samples, "samples"), required,
          !least || *margins.delay_samples * T >= *least};
}

// Of an input its rms beside its limit; NaN without one.
double share_of_limit(const Controller& controller, std::size_t input) {
  const auto& limits = controller.problem.limits;
  if (!limits || !limits->u_min.size()) return NAN;
  const auto i = static_cast<Eigen::Index>(input);
  const double reach = std::min(std::abs(limits->u_min(i)), std::abs(limits->u_max(i)));
  return std::isfinite(reach) && reach > 0 ? controller.solution.loop.rms->u[input] / reach : NAN;
}

std::optional<PageFigure> effort(const Controller& controller) {
  const auto& rms = controller.solution.loop.rms;
  if (!rms || rms->u.empty()) return std::nullopt;
  std::size_t worst = 0;
  for (std::size_t i = 1; i < rms->u.size(); ++i)
    if (share_of_limit(controller, i) > share_of_limit(controller, worst)) worst = i;
  const design::Signal& input = controller.problem.plant.inputs[worst];
  const double share = share_of_limit(controller, worst);
  PageFigure figure = {"rms of " + input.name, with_unit(rms->u[worst], input.unit)};
  if (std::isfinite(share)) figure.value = decimal(100 * share) + " % of its limit";
  for (const design::RmsRequirement& required : controller.problem.requirements.rms)
    if (required.of == design::RmsRequirement::Of::input && required.signal == static_cast<int>(worst)) {
      figure.requirement = "at most " + with_unit(required.most, input.unit);
      figure.is_met = rms->u[worst] <= required.most;
    }
  return figure;
}

std::optional<PageFigure> slowest(const Controller& controller) {
  double largest = 0;
  for (const NamedPoles& named : poles_of_controller(controller))
    for (const std::complex<double>& pole : named.poles) largest = std::max(largest, std::abs(pole));
  if (largest == 0) return std::nullopt;
  const std::string value =
      largest < 1 ? with_unit(-controller.problem.plant.sample_time / std::log(largest), "s") : "∞";
  PageFigure figure = {"Slowest time constant", value};
  if (const auto& most = controller.problem.requirements.max_pole) {
    figure.requirement = "poles within " + decimal(*most);
    figure.is_met = largest <= *most;
  }
  return figure;
}

std::vector<PageFigure> figures_of(const Controller& controller) {
  const design::Margins& margins = controller.solution.loop.at_input;
  const design::Requirements& wanted = controller.problem.requirements;
  std::vector<PageFigure> out;
  if (margins.disk || margins.phase_deg) {
    out = {gain_margin(margins, wanted), margin("Phase margin", margins.phase_deg, "°", wanted.phase_margin_deg),
           delay_margin(margins, controller), margin("Disk margin", margins.disk, "", wanted.disk_margin)};
  }
  const auto add = [&](std::optional<PageFigure> figure) {
    if (figure && out.size() < 6) out.push_back(*std::move(figure));
  };
  add(effort(controller));
  const CodeCost& cost = controller.cost;
  add(PageFigure{"Multiply-adds a sample", std::to_string(cost.multiply_adds)});
  for (const auto& [core, instructions] : cost.instructions)
    if (core == "cortex-m4f")
      add(PageFigure{"Instructions a sample, Cortex-M4F", "about " + std::to_string(instructions)});
  add(slowest(controller));
  add(PageFigure{"RAM", std::to_string(cost.ram) + " bytes"});
  add(PageFigure{"Flash, at most", std::to_string(cost.flash) + " bytes",
                 "at most " + std::to_string(controller.problem.code.flash) + " bytes",
                 cost.flash <= controller.problem.code.flash});
  add(PageFigure{"Stack, at most", std::to_string(cost.stack) + " bytes"});
  return out;
}

// What is smaller than is usual, in words.
std::vector<std::string> at_risk(const design::Margins& margins) {
  std::vector<std::string> out;
  if (margins.gain_down_dB && std::abs(*margins.gain_down_dB) < small_gain_dB)
    out.push_back("the gain may fall by " + decimal(std::abs(*margins.gain_down_dB)) + " dB only");
  if (margins.gain_up_dB && *margins.gain_up_dB < small_gain_dB)
    out.push_back("the gain may rise by " + decimal(*margins.gain_up_dB) + " dB only");
  if (margins.phase_deg && *margins.phase_deg < small_phase_deg)
    out.push_back("a phase margin of " + decimal(*margins.phase_deg) + "° is small");
  if (margins.delay_samples && *margins.delay_samples < small_delay)
    out.push_back("less than a sample of additional delay is allowed (" + decimal(*margins.delay_samples) + ")");
  if (out.empty() && margins.disk && *margins.disk < small_disk)
    out.push_back("a disk margin of " + decimal(*margins.disk) + " is small");
  return out;
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (std::size_t i = 0; i < words.size(); ++i)
    out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return out;
}

std::string verdict_of_loop(const design::Margins& margins) {
  const std::vector<std::string> risks = at_risk(margins);
  if (!risks.empty()) return "The loop is stable, but " + joined(risks);
  if (margins.phase_deg && margins.gain_dB)
    return "The loop is stable and tolerates errors of the model: " + decimal(*margins.gain_dB) + " dB of gain, " +
           decimal(*margins.phase_deg) + "° of phase";
  return "The loop is stable";
}

// "settling time" of "require.settling_time", "rms" of "require.rms[0].value".
std::string requirement_in_words(const std::string& key) {
  const std::size_t dot = key.find('.');
  std::string words = dot == key.npos ? "" : key.substr(dot + 1);
  words = words.substr(0, words.find('['));
  for (char& c : words)
    if (c == '_') c = ' ';
  return words;
}

// What [require] asks for and a finding, or else a figure, misses.
std::vector<std::string> missed_requirements(const design::Findings& findings, const PageData& page) {
  std::vector<std::string> missed;
  for (const design::Finding& finding : findings) {
    if (finding.severity != design::Severity::error) continue;
    const std::string words = requirement_in_words(finding.key);
    if (std::find(missed.begin(), missed.end(), words) == missed.end()) missed.push_back(words);
  }
  if (!missed.empty()) return missed;
  for (const PageFigure& figure : page.figures)
    if (!figure.is_met) missed.push_back(figure.name);
  return missed;
}

void set_verdict(const Controller& controller, const design::Findings& findings, PageData& page) {
  const design::Margins& margins = controller.solution.loop.at_input;
  const std::vector<std::string> missed = missed_requirements(findings, page);
  bool has_requirement = false;
  for (const PageFigure& figure : page.figures) has_requirement |= !figure.requirement.empty();
  page.is_sound = missed.empty() && at_risk(margins).empty();
  if (!missed.empty())
    page.verdict = "What is required is not met: " + joined(missed) + ".";
  else if (!controller.has.regulator)
    page.verdict = "The estimate follows the plant: its error decays, whatever it begins with.";
  else if (!margins.phase_deg && !margins.disk)
    page.verdict = "The loop changes with time: it has gains for each sample, and no steady margins.";
  else
    page.verdict = verdict_of_loop(margins) + (has_requirement && page.is_sound ? "; what is required is met." : ".");
}

}  // namespace

void add_head(const Controller& controller, const design::Findings& findings, PageData& page) {
  page.title = controller.problem.name;
  page.brief = controller.problem.brief;
  page.made =
      "Made by lqgen " + version() + " from " + controller.source.file + ", SHA-256 " + controller.source.sha256;
  page.figures = figures_of(controller);
  set_verdict(controller, findings, page);
  for (const auto severity : {design::Severity::error, design::Severity::note})
    for (const design::Finding& finding : findings)
      if (finding.severity == severity) page.notes.push_back({finding.key, finding.message});
}

}  // namespace lqg::emit
