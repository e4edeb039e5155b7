// SPDX-License-Identifier: MIT
// Loop transfer recovery in words: margin against cost.
#pragma once

#include <string>
#include <vector>

#include "emit/controller.hpp"

namespace lqg::emit {

// A row for each q, its cells: q, disk margin, phase margin, cost beside that without recovery. A loop that does not
// exist has dashes; a design without a cost, none. The first row has the titles; empty without recovery.
std::vector<std::vector<std::string>> recovery_table(const Controller& controller);

// One sentence: what the rows are, and what the design's own q costs.
std::string recovery_in_words(const Controller& controller);

// Both for the terminal: lines behind an empty one; empty without recovery.
std::string describe_recovery(const Controller& controller);

}  // namespace lqg::emit
