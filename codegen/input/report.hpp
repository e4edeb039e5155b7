// SPDX-License-Identifier: MIT
// Where the reader's findings go: each with its key and, beyond those of the keys themselves, its place.
#pragma once

#include <string>
#include <utility>

#include "input/design_file.hpp"

namespace lqg::input {

class Report {
 public:
  explicit Report(DesignFile& file) : file_(file) {}

  // At the key's own place, or above it.
  void error(const std::string& key, std::string message) { add(design::Severity::error, key, std::move(message)); }
  void note(const std::string& key, std::string message) { add(design::Severity::note, key, std::move(message)); }

  // At a place that the key alone does not tell.
  void error(const std::string& key, Location where, std::string message) {
    file_.locations[key] = where;
    error(key, std::move(message));
  }

  void place(const std::string& key, Location where) { file_.locations[key] = where; }

 private:
  void add(design::Severity severity, const std::string& key, std::string message) {
    file_.findings.push_back({severity, key, std::move(message)});
  }

  DesignFile& file_;
};

}  // namespace lqg::input
