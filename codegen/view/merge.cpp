// SPDX-License-Identifier: MIT
#include "view/merge.hpp"

#include <algorithm>

#include "view/merge_charts.hpp"

namespace lqg::view {

namespace {

using emit::Chart;
using emit::PageData;
using emit::PageFigure;
using emit::PageSection;
using emit::PageTable;
using emit::PageView;

const char* const no_value = "–";

// The place of `name` among rows, a new one where it is not there yet.
std::vector<std::string>& row_of(PageTable& table, const std::string& name, std::size_t columns) {
  const auto is_it = [&](const std::vector<std::string>& row) { return row.front() == name; };
  const auto found = std::find_if(table.rows.begin(), table.rows.end(), is_it);
  if (found != table.rows.end()) return *found;
  table.rows.emplace_back(columns + 1, no_value);
  table.rows.back().front() = name;
  return table.rows.back();
}

// Each value of a table becomes a row of its own: "angle, overshoot".
void add_table(PageTable& merged, const PageTable& table, std::size_t owner, std::size_t owners) {
  for (const std::vector<std::string>& row : table.rows)
    for (std::size_t j = 1; j < row.size(); ++j) {
      const std::string column = row.size() > 2 && j < table.head.size() ? ", " + table.head[j] : "";
      row_of(merged, row.front() + column, owners)[owner + 1] = row[j];
    }
}

std::vector<std::string> head_of(const std::vector<OwnedPage>& pages) {
  std::vector<std::string> head = {""};
  for (const OwnedPage& page : pages) head.push_back(page.owner);
  return head;
}

// The element of `list` for which `is_it`, or a new one like `otherwise`.
template <class Element, class Predicate>
Element& found_or_added(std::vector<Element>& list, const Predicate& is_it, const Element& otherwise) {
  const auto found = std::find_if(list.begin(), list.end(), is_it);
  if (found != list.end()) return *found;
  list.push_back(otherwise);
  return list.back();
}

class Merger {
 public:
  explicit Merger(const std::vector<OwnedPage>& pages) : pages_(pages), head_(head_of(pages)) {}

  std::vector<PageSection> sections() {
    for (owner_ = 0; owner_ < pages_.size(); ++owner_)
      for (const PageSection& section : pages_[owner_].page.sections) add(section);
    for (PageSection& section : merged_) drop_empty(section);
    const auto is_empty = [](const PageSection& section) { return section.views.empty(); };
    merged_.erase(std::remove_if(merged_.begin(), merged_.end(), is_empty), merged_.end());
    return std::move(merged_);
  }

 private:
  static void drop_empty(PageSection& section) {
    const auto is_empty = [](const PageView& view) { return view.charts.empty() && view.tables.empty(); };
    section.views.erase(std::remove_if(section.views.begin(), section.views.end(), is_empty), section.views.end());
  }

  void add(const PageSection& section) {
    PageSection& place = found_or_added(
        merged_, [&](const PageSection& other) { return other.id == section.id; },
        PageSection{section.id, section.title, {}});
    for (const PageView& view : section.views) add(view, place);
  }

  void add(const PageView& view, PageSection& section) {
    PageView empty;
    empty.name = view.name;
    empty.text = view.text;
    PageView& place =
        found_or_added(section.views, [&](const PageView& other) { return other.name == view.name; }, empty);
    for (const Chart& chart : view.charts) add(chart, place);
    for (std::size_t i = 0; i < view.tables.size(); ++i) add(view.tables[i], place);
  }

  void add(const Chart& chart, PageView& view) {
    const auto is_it = [&](const Chart& other) {
      return chart.id.empty() ? other.title == chart.title : other.id == chart.id;
    };
    const auto found = std::find_if(view.charts.begin(), view.charts.end(), is_it);
    if (found == view.charts.end())
      view.charts.push_back(owned_chart(chart, pages_[owner_].owner, owner_));
    else
      lay_over(*found, owned_chart(chart, pages_[owner_].owner, owner_));
  }

  void add(const PageTable& table, PageView& view) {
    PageTable& place = found_or_added(
        view.tables, [&](const PageTable& other) { return other.caption == table.caption; },
        PageTable{table.caption, head_, {}});
    add_table(place, table, owner_, pages_.size());
  }

  const std::vector<OwnedPage>& pages_;
  std::vector<std::string> head_;
  std::vector<PageSection> merged_;
  std::size_t owner_ = 0;
};

}  // namespace

PageTable figure_table(const std::vector<OwnedPage>& pages) {
  PageTable table = {"", head_of(pages), {}};
  for (std::size_t i = 0; i < pages.size(); ++i)
    for (const PageFigure& figure : pages[i].page.figures) {
      const std::string requirement = figure.requirement.empty() ? "" : " (" + figure.requirement + ")";
      row_of(table, figure.name, pages.size())[i + 1] = figure.value + requirement;
    }
  return table;
}

std::vector<PageSection> merged_sections(const std::vector<OwnedPage>& pages) { return Merger(pages).sections(); }

}  // namespace lqg::view
