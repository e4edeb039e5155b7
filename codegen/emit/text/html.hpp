// SPDX-License-Identifier: MIT
// Text that becomes HTML.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace lqg::emit {

// With &, <, > and " written as entities.
std::string escaped(const std::string& text);

// How many letters a reader sees: UTF-8's continuation bytes do not count.
std::size_t letters(const std::string& text);

// A table of two columns, what and how much; rows without a value are left out.
using Rows = std::vector<std::pair<std::string, std::string>>;
std::string table(const Rows& rows);

// `body` under the style of the report.
std::string page(const std::string& title, const std::string& body);

}  // namespace lqg::emit
