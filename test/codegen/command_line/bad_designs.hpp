// SPDX-License-Identifier: MIT
// Designs that lqgen has to refuse, and the words in which it does.
#pragma once

#include <string>
#include <vector>

// `text` in place of the lines `line` to `last` of base.toml, the lines after `line` left empty; line 0: of
// the whole file.
struct Edit {
  int line;
  std::string text;
  int last = 0;
};

// `lines` are all that stands on standard error, without "design.toml:" and in order; "…" there stands for
// any text.
struct BadDesign {
  std::string what;
  std::vector<Edit> edits;
  std::vector<std::string> lines;
};

std::vector<BadDesign> not_toml();
std::vector<BadDesign> wrong_keys();
std::vector<BadDesign> wrong_values();
std::vector<BadDesign> wrong_shapes();
std::vector<BadDesign> wrong_together();
std::vector<BadDesign> wrong_scenarios();
std::vector<BadDesign> missed_in_scenarios();  // right as files, but their controller does not do what [require] asks
std::vector<BadDesign> impossible();           // right as files, but no such controller exists
