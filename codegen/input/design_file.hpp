// SPDX-License-Identifier: MIT
// The design file: read, checked, and every finding with its place.
//
// A key is written as in the file, "kalman.gain"; rows, entries and names count from 0: "plant.A[2]",
// "plant.A[2][0]". What belongs to no key, such as text that is not TOML, has its place as a key, "@3:5".
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "design/finding.hpp"
#include "design/problem.hpp"
#include "input/location.hpp"

namespace lqg::input {

struct DesignFile {
  bool readable = true;                       // false: not read at all (exit status 3); the finding says why
  std::optional<design::Problem> problem;     // there exactly when no finding is an error
  design::Findings findings;                  // in the order of the file; errors here mean exit status 2
  std::map<std::string, Location> locations;  // of every key in the file (its value; a table's header)
  std::string text;                           // the bytes of the file, for its hash
};

// What stands in place of the value of one of the file's parameters: a number or a formula.
struct Setting {
  std::string name, value;
};
using Settings = std::vector<Setting>;

// "R=2.5" as a setting; nothing of what has no name before a =.
std::optional<Setting> setting_of(const std::string& text);

// Reads the file at `path`, or standard input where that is "-". Never throws for what stands in the file, whatever its
// bytes.
DesignFile read_design_file(const std::string& path, const Settings& settings = {});

// The same for a text already in memory. Files that it names are sought from `folder` on; without one it may name none.
DesignFile parse_design(const std::string& text, const std::optional<std::filesystem::path>& folder = {},
                        const Settings& settings = {});

// Where `key` stands, or else the nearest key above it, or else the first character of the file.
Location locate(const DesignFile& file, const std::string& key);

// Sorts findings, those of the design engine too, by their place in the file; at one place their order stays.
void sort_by_place(const DesignFile& file, design::Findings& findings);

// One line without its line end: "two_mass.toml:9:5: plant.B: expected 4 rows (nx), found 3",
// "two_mass.toml:12:5: note: lqr.Q: …". Control characters and what is not UTF-8 are written as escapes.
std::string format(const std::string& path, Location where, const design::Finding& finding);

}  // namespace lqg::input
