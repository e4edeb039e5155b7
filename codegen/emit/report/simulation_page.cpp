// SPDX-License-Identifier: MIT
#include "emit/report/simulation_page.hpp"

#include <algorithm>

#include "emit/report/scenario_view.hpp"
#include "emit/report/sections.hpp"
#include "emit/text/wording.hpp"

namespace lqg::emit {

namespace {

std::string verdict_of(const Simulations& simulations, bool& is_sound) {
  const auto is_lost = [](const simulate::ScenarioRun& run) { return run.numbers.has_diverged; };
  const auto lost = std::count_if(simulations.runs.begin(), simulations.runs.end(), is_lost);
  if (lost) {
    is_sound = false;
    return "The loop is lost in " + std::to_string(lost) + " of " + std::to_string(simulations.runs.size()) +
           " scenarios.";
  }
  for (const simulate::MonteCarlo& result : simulations.monte_carlo) {
    const auto failed = std::count(result.failed.begin(), result.failed.end(), true);
    if (failed == 0) continue;
    is_sound = false;
    return std::to_string(failed) + " of " + std::to_string(result.failed.size()) + " runs of \"" + result.name +
           "\" failed.";
  }
  if (!simulations.monte_carlo.empty()) return "No run failed.";
  if (simulations.replay)
    return "The filter over a log of " + std::to_string(simulations.replay->times.size()) + " samples.";
  return "The loop holds in every scenario.";
}

}  // namespace

PageData simulation_data(const Controller& controller, const Simulations& simulations) {
  PageData page;
  page.title = controller.problem.name + ": simulation";
  page.brief = controller.problem.brief;
  page.made = "Made by lqgen simulate " + version() + " from " + controller.source.file + ", SHA-256 " +
              controller.source.sha256 + ", seed " + std::to_string(simulations.seed);
  page.verdict = verdict_of(simulations, page.is_sound);
  PageSection runs = {"at-work", "At work", {}}, many = {"many-runs", "Many runs", {}}, log = {"log", "A log", {}};
  for (std::size_t i = 0; i < simulations.runs.size(); ++i)
    runs.views.push_back(scenario_view(controller, {simulations.scenarios[i], simulations.runs[i]}));
  for (const simulate::MonteCarlo& result : simulations.monte_carlo)
    many.views.push_back(monte_carlo_view(controller, result));
  if (simulations.replay) log.views.push_back(replay_view(controller, *simulations.replay));
  for (PageSection& section : std::vector<PageSection>{runs, many, log})
    if (!section.views.empty()) page.sections.push_back(std::move(section));
  page.footer = drawn_by();
  shorten(page);
  return page;
}

}  // namespace lqg::emit
