// SPDX-License-Identifier: MIT
// `lqgen watch`: a page on the loopback interface that follows a design file, with sliders for its numbers.
#pragma once

#include <string>

namespace lqg::view {

struct WatchArguments {
  std::string design_file;
  unsigned port = 0;  // 0: a free one
};

// Serves until SIGINT, SIGTERM or SIGHUP. Exit status: 0 ended so; 2 a name of a file that lqgen refuses; 3 the file
// cannot be read, or nothing can listen at the port. An error in the file stands in the page.
int watch(const WatchArguments& arguments);

}  // namespace lqg::view
