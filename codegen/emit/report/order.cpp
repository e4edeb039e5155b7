// SPDX-License-Identifier: MIT
// What is known of a compensator of a given order, and what white parameters cost.
#include "emit/report/sections.hpp"
#include "emit/text/order_description.hpp"

namespace lqg::emit {

namespace {

void add_table(const std::string& title, const Facts& facts, PageView& view) {
  if (facts.empty()) return;
  PageTable table = {title, {}, {}};
  for (const auto& [name, value] : facts) table.rows.push_back({name, value});
  view.tables.push_back(std::move(table));
}

}  // namespace

PageSection order_section(const Controller& controller) {
  PageSection section = {"order", "The optimum", {}};
  PageView view;
  add_table("Compensator of given order", facts_of_optimum(controller), view);
  add_table("White parameters", facts_of_white(controller), view);
  if (!view.tables.empty()) section.views.push_back(std::move(view));
  return section;
}

}  // namespace lqg::emit
