// SPDX-License-Identifier: MIT
// Tells of work that takes long, and ends the program when it takes too long.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace lqg {

// On a terminal standard error has one line of what goes on, which is gone in the end. Elsewhere each stage that is at
// work after `patience` gets a line, once. `limit` is in seconds: when they have passed, the program ends with a line
// that says where it was, and exit status 1.
class Watch {
 public:
  Watch(const std::string& design_file, bool quiet, std::optional<unsigned> limit,
        std::chrono::seconds patience = std::chrono::seconds(5));
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  // "eigenvalues in 50 digits, step 7 of 10": a stage, and how far it is.
  void show(const std::string& work);
  // A stage of which so much is done, from 0 to 1: a bar on a terminal.
  void show(const std::string& work, double share);

  // Takes the line off the terminal.
  void clear();

  // From here on there is no limit.
  void end();

 private:
  void prepare_last_line(const std::string& work) const;

  std::string file_, stage_;
  bool shows_, is_terminal_, has_line_ = false;
  std::optional<unsigned> limit_;
  std::chrono::seconds patience_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace lqg
