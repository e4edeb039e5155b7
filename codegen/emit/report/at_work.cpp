// SPDX-License-Identifier: MIT
// The controller at work, scenario by scenario. It has the bits of the emitted one.
#include "emit/report/sections.hpp"

namespace lqg::emit {

PageSection at_work(const Controller& controller, const std::vector<ShownRun>& runs) {
  PageSection section = {"at-work", "At work", {}};
  for (const ShownRun& shown : runs) section.views.push_back(scenario_view(controller, shown));
  return section;
}

}  // namespace lqg::emit
