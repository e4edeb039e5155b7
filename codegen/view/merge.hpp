// SPDX-License-Identifier: MIT
// Pages of several designs laid over each other.
#pragma once

#include <string>
#include <vector>

#include "emit/page/page.hpp"

namespace lqg::view {

struct OwnedPage {
  std::string owner;  // the name of the design, its own among them
  emit::PageData page;
};

// The figures of the heads as a table: a row for each name, a column for each design. `requirement`s stand in brackets.
emit::PageTable figure_table(const std::vector<OwnedPage>& pages);

// The sections of all pages, in the order in which they come first. Charts with the same id are one: its curves carry
// the owner in their labels, and differ by colour or, where colours tell the curves of one design apart, by their line.
// Rows with the same name are one, with a column for each design. Matrices are left out.
std::vector<emit::PageSection> merged_sections(const std::vector<OwnedPage>& pages);

}  // namespace lqg::view
