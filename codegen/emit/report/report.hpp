// SPDX-License-Identifier: MIT
// NAME.html: what a person wants to see of a design, in one file.
#pragma once

#include <string>

#include "design/finding.hpp"
#include "emit/controller.hpp"
#include "emit/page/page.hpp"

namespace lqg::emit {

// The page of this design. Findings: what lqgen has noted of it.
PageData page_data(const Controller& controller, const design::Findings& findings = {});

// page_html of it.
std::string report(const Controller& controller, const design::Findings& findings = {});

}  // namespace lqg::emit
