// SPDX-License-Identifier: MIT
// What the parameters of the design file are, and which of its numbers hang on them.
#include "emit/report/sections.hpp"
#include "emit/text/parameter_description.hpp"

namespace lqg::emit {

PageSection parameter_section(const Controller& controller) {
  PageSection section = {"parameters", "Parameters", {}};
  PageView view;
  const auto parameters = table_of_parameters(controller), expressions = table_of_expressions(controller);
  if (!parameters.empty()) view.tables.push_back({"", {"name", "value", "expression"}, parameters});
  if (!expressions.empty())
    view.tables.push_back({"Numbers by expressions", {"key", "value", "expression"}, expressions});
  if (!view.tables.empty()) section.views.push_back(std::move(view));
  return section;
}

}  // namespace lqg::emit
