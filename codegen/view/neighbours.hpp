// SPDX-License-Identifier: MIT
// The other design files in a file's folder, which a page can compare it with.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lqg::view {

// The names of the files beside `path` that end in .toml, in the order of their bytes, a hundred at most; not its own.
std::vector<std::string> neighbours(const std::string& path);

struct Neighbour {
  std::string path, text;
};

// One of them; nothing where the name is none of them, or the file cannot be read.
std::optional<Neighbour> read_neighbour(const std::string& path, const std::string& name);

}  // namespace lqg::view
