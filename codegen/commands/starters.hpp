// SPDX-License-Identifier: MIT
// Design files to begin with.
#pragma once

#include <string>
#include <vector>

namespace lqg::commands {

struct Starter {
  std::string name;  // what is typed after --from
  std::string text;  // a design file that designs as it is
};

const std::vector<Starter>& starters();

}  // namespace lqg::commands
