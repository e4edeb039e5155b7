// SPDX-License-Identifier: MIT
#include "view/compare.hpp"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <set>

#include "design/solve.hpp"
#include "emit/plan/plan.hpp"
#include "emit/report/report.hpp"
#include "emit/text/files.hpp"
#include "emit/text/sha256.hpp"
#include "emit/text/wording.hpp"
#include "input/design_file.hpp"
#include "input/text.hpp"
#include "simulate/scenario_run.hpp"
#include "view/differences.hpp"
#include "view/merge.hpp"

namespace lqg::view {

namespace {

namespace fs = std::filesystem;

enum Status { made = 0, impossible_design = 1, wrong_file = 2, not_read = 3 };

const char* const page_name = "compare.html";

struct Compared {
  std::string path, text;
  emit::Controller controller;
  design::Findings findings;
  emit::PageData page;
};

void print(const CompareArguments& arguments, const std::string& path, const input::DesignFile& file,
           const design::Findings& findings) {
  for (const design::Finding& finding : findings)
    if (finding.severity == design::Severity::error || !arguments.quiet)
      std::cerr << input::format(path, input::locate(file, finding.key), finding) << "\n";
}

// The design of one file, or why there is none.
Status read(const CompareArguments& arguments, const std::string& path, const design::Progress& progress,
            std::vector<Compared>& all) {
  const input::DesignFile file = input::read_design_file(path);
  print(arguments, path, file, file.findings);
  if (!file.readable) return not_read;
  if (!file.problem) return wrong_file;
  design::Findings findings;
  std::optional<design::Solution> solution = design::solve(*file.problem, findings, progress);
  std::optional<emit::Controller> controller;
  if (solution && !design::has_error(findings))
    controller = emit::make_controller(*file.problem, *std::move(solution),
                                       {fs::path(path).filename().string(), emit::sha256(file.text)}, findings);
  input::sort_by_place(file, findings);
  print(arguments, path, file, findings);
  if (!controller) return impossible_design;
  all.push_back({path, file.text, *std::move(controller), std::move(findings), {}});
  return made;
}

void draw_pages(std::vector<Compared>& all) {
  std::vector<std::vector<design::Scenario>> shown;
  for (const Compared& one : all)
    if (one.controller.problem.scenarios.empty()) shown.push_back(simulate::scenarios_to_show(one.controller));
  const std::vector<design::Scenario> common = simulate::common_scenarios(shown);
  for (Compared& one : all) {
    one.controller.problem.scenarios = simulate::scenarios_to_show(one.controller, common);
    one.page = emit::page_data(one.controller, one.findings);
  }
}

using NameOf = std::string (*)(const Compared&);

std::string design_name(const Compared& one) { return one.page.title; }
std::string file_name(const Compared& one) { return fs::path(one.path).stem().string(); }
std::string whole_path(const Compared& one) { return one.path; }

bool is_unique(const std::vector<Compared>& all, NameOf name) {
  std::set<std::string> names;
  for (const Compared& one : all) names.insert(name(one));
  return names.size() == all.size();
}

// The shortest names that tell them apart.
std::vector<OwnedPage> with_owners(const std::vector<Compared>& all) {
  const NameOf name = is_unique(all, design_name) ? design_name : is_unique(all, file_name) ? file_name : whole_path;
  std::vector<OwnedPage> pages;
  for (const Compared& one : all) pages.push_back({input::printable(name(one)), one.page});
  return pages;
}

emit::PageSection difference_section(const std::vector<Compared>& all, const std::vector<OwnedPage>& pages) {
  emit::PageTable table = {"", {"key"}, {}};
  for (const OwnedPage& page : pages) table.head.push_back(page.owner);
  std::vector<std::string> texts;
  for (const Compared& one : all) texts.push_back(one.text);
  for (const Difference& difference : differences(texts)) {
    table.rows.push_back({difference.key});
    table.rows.back().insert(table.rows.back().end(), difference.values.begin(), difference.values.end());
  }
  emit::PageView view;
  if (table.rows.empty())
    view.text = "The files say the same.";
  else
    view.tables = {table};
  return {"files", "What differs in the files", {view}};
}

emit::PageSection figure_section(const std::vector<OwnedPage>& pages) {
  emit::PageView view;
  view.tables = {figure_table(pages)};
  return {"figures", "In numbers", {view}};
}

std::string listed(const std::vector<OwnedPage>& pages) {
  std::string list;
  for (std::size_t i = 0; i < pages.size(); ++i)
    list += (i == 0 ? "" : i + 1 == pages.size() ? " and " : ", ") + pages[i].owner;
  return list;
}

emit::PageData compared_page(const std::vector<Compared>& all) {
  const std::vector<OwnedPage> pages = with_owners(all);
  emit::PageData page;
  page.title = listed(pages);
  page.brief = "Designs side by side";
  page.made = "Made by lqgen " + emit::version();
  std::size_t sound = 0;
  for (const OwnedPage& owned : pages) {
    sound += owned.page.is_sound ? 1 : 0;
    page.notes.push_back({owned.owner, owned.page.verdict});
  }
  page.is_sound = sound == pages.size();
  const std::size_t risky = pages.size() - sound;
  page.verdict = std::to_string(pages.size()) + " designs; " +
                 (risky == 0 ? "none is at risk." : std::to_string(risky) + " at risk.");
  page.sections = {difference_section(all, pages), figure_section(pages)};
  for (emit::PageSection& section : merged_sections(pages)) page.sections.push_back(std::move(section));
  return page;
}

// A design that is called compare.html would otherwise be lost.
bool overwrites(const CompareArguments& arguments) {
  std::error_code ignored;
  return std::any_of(arguments.design_files.begin(), arguments.design_files.end(), [&](const std::string& path) {
    return fs::equivalent(path, fs::path(arguments.folder) / page_name, ignored);
  });
}

}  // namespace

int compare(const CompareArguments& arguments, const design::Progress& progress) {
  std::vector<Compared> all;
  int worst = made;
  for (const std::string& path : arguments.design_files)
    worst = std::max<int>(worst, read(arguments, path, progress, all));
  if (worst != made) return worst;
  draw_pages(all);
  if (overwrites(arguments)) {
    std::cerr << "lqgen compare: expected design files that are not " << page_name
              << "; rename it, or choose another folder with -o\n";
    return wrong_file;
  }
  const auto failure = emit::write_all(arguments.folder, {{page_name, emit::page_html(compared_page(all))}});
  if (failure) std::cerr << input::printable(*failure) << "\n";
  return failure ? not_read : made;
}

}  // namespace lqg::view
