// SPDX-License-Identifier: MIT
// Margin against cost of loop transfer recovery.
#include "emit/report/sections.hpp"
#include "emit/text/recovery_table.hpp"

namespace lqg::emit {

PageSection recovery_section(const Controller& controller) {
  PageSection section = {"recovery", "Margin against cost", {}};
  std::vector<std::vector<std::string>> rows = recovery_table(controller);
  if (rows.empty()) return section;
  PageTable table = {"Loop transfer recovery, margins at the inputs", rows.front(), {}};
  table.rows.assign(rows.begin() + 1, rows.end());
  PageView view;
  view.text = recovery_in_words(controller);
  view.tables = {table};
  section.views.push_back(std::move(view));
  return section;
}

}  // namespace lqg::emit
