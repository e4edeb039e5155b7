// SPDX-License-Identifier: MIT
#include "view/neighbours.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace lqg::view {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_neighbours = 100;

fs::path folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder;
}

}  // namespace

std::vector<std::string> neighbours(const std::string& path) {
  const fs::path own = fs::path(path).filename();
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder_of(path), error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    const fs::path name = entry->path().filename();
    if (name.extension() == ".toml" && name != own && entry->is_regular_file(ignored)) names.push_back(name.string());
  }
  std::sort(names.begin(), names.end());
  names.resize(std::min(names.size(), most_neighbours));
  return names;
}

std::optional<Neighbour> read_neighbour(const std::string& path, const std::string& name) {
  const std::vector<std::string> names = neighbours(path);
  if (std::find(names.begin(), names.end(), name) == names.end()) return std::nullopt;
  const fs::path other = fs::path(path).parent_path() / name;
  std::ifstream file(other, std::ios::binary);
  Neighbour neighbour = {other.string(), {std::istreambuf_iterator<char>(file), {}}};
  if (!file) return std::nullopt;
  return neighbour;
}

}  // namespace lqg::view
