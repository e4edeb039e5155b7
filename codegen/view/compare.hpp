// SPDX-License-Identifier: MIT
// `lqgen compare`: one page of several designs, compare.html.
#pragma once

#include <string>
#include <vector>

#include "design/progress.hpp"

namespace lqg::view {

struct CompareArguments {
  std::vector<std::string> design_files;  // two or more
  std::string folder = ".";
  bool quiet = false;  // no notes
};

// Prints what lqgen has to say of the files, and writes FOLDER/compare.html if all of them have a design. Exit status
// as that of lqgen: 0 written, 1 a design is impossible, 2 a file is wrong, 3 not read or not written.
int compare(const CompareArguments& arguments, const design::Progress& progress = {});

}  // namespace lqg::view
