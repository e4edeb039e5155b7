// SPDX-License-Identifier: MIT
// A program run in a folder, and what it left behind.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

struct Outcome {
  int status = -1;  // 128 + the signal that ended it
  std::string out, err;
};

// Runs `command` in `folder`. Files that it writes may have `largest_file` bytes: a write beyond fails.
Outcome run(const std::vector<std::string>& command, const std::filesystem::path& folder,
            std::optional<unsigned long> largest_file = std::nullopt);

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& content);

// Bytes and time of every file below a folder.
using Snapshot = std::map<std::string, std::pair<std::string, std::filesystem::file_time_type>>;
Snapshot snapshot(const std::filesystem::path& folder);

// An empty folder of this name, below the current one.
std::filesystem::path fresh_folder(const std::string& name);

// Outputs of an earlier run of the design `name`, a day old, in the new folder `folder`.
void write_old_outputs(const std::filesystem::path& folder, const std::string& name);
