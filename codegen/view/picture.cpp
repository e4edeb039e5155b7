// SPDX-License-Identifier: MIT
#include "view/picture.hpp"

#include <filesystem>

#include "design/checks/requirements.hpp"
#include "design/solve.hpp"
#include "emit/plan/plan.hpp"
#include "emit/report/report.hpp"
#include "emit/text/sha256.hpp"
#include "input/design_file.hpp"
#include "simulate/scenario_requirements.hpp"
#include "simulate/scenario_run.hpp"

namespace lqg::view {

namespace {

void add_lines(Picture& picture, const input::DesignFile& file, const std::string& path,
               const design::Findings& findings) {
  for (const design::Finding& finding : findings) {
    const input::Location where = input::locate(file, finding.key);
    picture.lines.push_back(input::format(path, where, finding));
    if (finding.severity != design::Severity::error) continue;
    if (!picture.has_error) picture.line = where.line;
    picture.has_error = true;
  }
}

controller::Source source_of(const std::string& text, const std::string& path) {
  return {std::filesystem::path(path).filename().string(), emit::sha256(text)};
}

using Scenarios = std::vector<design::Scenario>;

emit::PageData draw(emit::Controller& controller, const input::DesignFile& file, const Scenarios& like,
                    const design::Findings& findings, Picture& picture) {
  controller.problem.requirements = file.problem->requirements;
  picture.scenarios = controller.problem.scenarios = simulate::scenarios_to_show(controller, like);
  return emit::page_data(controller, findings);
}

std::optional<emit::PageData> first_page(const input::DesignFile& file, const std::string& path, const Scenarios& like,
                                         Picture& picture) {
  design::Problem problem = design::without_requirements(*file.problem);
  std::optional<design::Solution> solution = design::first_look(problem);
  if (!solution) return std::nullopt;
  design::Findings ignored;
  auto controller =
      emit::make_controller(std::move(problem), *std::move(solution), source_of(file.text, path), ignored);
  if (!controller) return std::nullopt;
  return draw(*controller, file, like, {}, picture);
}

std::optional<emit::PageData> whole_page(const input::DesignFile& file, const std::string& path, const Scenarios& like,
                                         Picture& picture) {
  design::Problem problem = design::without_requirements(*file.problem);
  design::Findings findings;
  std::optional<design::Solution> solution = design::solve(problem, findings);
  std::optional<emit::Controller> controller;
  if (solution && !design::has_error(findings))
    controller = emit::make_controller(std::move(problem), *std::move(solution), source_of(file.text, path), findings);
  if (controller) {
    controller->problem.requirements = file.problem->requirements;
    design::check_requirements(controller->problem, controller->solution, findings);
    simulate::check_scenario_requirements(*controller, findings);
  }
  input::sort_by_place(file, findings);
  add_lines(picture, file, path, findings);
  return controller ? std::optional(draw(*controller, file, like, findings, picture)) : std::nullopt;
}

}  // namespace

Picture picture_of(const std::string& text, const std::string& path, Depth depth, const Scenarios& like) {
  const input::DesignFile file = input::parse_design(text, std::filesystem::path(path).parent_path());
  Picture picture;
  add_lines(picture, file, path, file.findings);
  if (!file.problem) return picture;
  picture.tunables = tunables(file);
  if (depth == Depth::whole) picture.page = whole_page(file, path, like, picture);
  if (!picture.page) picture.page = first_page(file, path, like, picture);
  return picture;
}

emit::PageData empty_page(const std::string& path) {
  emit::PageData page;
  page.title = path;
  page.verdict = "No picture yet.";
  return page;
}

}  // namespace lqg::view
