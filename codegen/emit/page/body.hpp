// SPDX-License-Identifier: MIT
// The part of a page that people see without scripts.
#pragma once

#include <string>

#include "emit/page/page.hpp"

namespace lqg::emit {

// Without pictures a chart is an empty figure, for a script to fill.
std::string body(const PageData& data, bool with_pictures);

// The id of a chart that has none: of its place in the page.
std::string chart_id(const PageSection& section, std::size_t view, std::size_t chart);

}  // namespace lqg::emit
