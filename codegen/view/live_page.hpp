// SPDX-License-Identifier: MIT
// The page of a design with a panel of sliders beside it, which follows the file.
#pragma once

#include <string>

#include "serve/server.hpp"

namespace lqg::view {

// Without a picture: its script asks for the state of the file at once. Only the scripts of this answer run in it.
serve::Reply live_page(const std::string& path);

}  // namespace lqg::view
