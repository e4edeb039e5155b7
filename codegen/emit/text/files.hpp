// Writing output files: all of them, or none.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace lqg::emit {

struct File {
  std::string name;  // within the output folder
  std::string content;
};

// Puts `files` into `folder`, which is made if it is not there. Each is written beside its place first; only when all are
// safely on the disk do they take their places. Returns why it failed: then every old file is as it was.
std::optional<std::string> write_all(const std::string& folder, const std::vector<File>& files);

}  // namespace lqg::emit
