// SPDX-License-Identifier: MIT
// A line now and then from long work, for a person who waits.
#pragma once

#include <functional>
#include <string>

namespace lqg::design {

// Takes a line like "Riccati equation in 200 digits, step 7", or "…, step 7 of 1000".
using Progress = std::function<void(const std::string&)>;

// During its life report_progress calls `progress`, in this thread, when a second has gone by since the last line.
// `progress` has to live as long.
class ProgressScope {
 public:
  explicit ProgressScope(const Progress& progress);
  ~ProgressScope();
  ProgressScope(const ProgressScope&) = delete;
  ProgressScope& operator=(const ProgressScope&) = delete;
};

// During its life report_progress calls `check`, in this thread, at every step. What `check` throws ends the work: a
// program that no longer needs the result throws an exception of its own, which comes out of solve(). `check` has to
// live as long.
class InterruptionScope {
 public:
  explicit InterruptionScope(const std::function<void()>& check);
  ~InterruptionScope();
  InterruptionScope(const InterruptionScope&) = delete;
  InterruptionScope& operator=(const InterruptionScope&) = delete;
};

// `all`: how many steps there are; 0 where nobody knows.
void report_progress(const char* work, long step, long all = 0);

}  // namespace lqg::design
