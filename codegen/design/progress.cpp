// SPDX-License-Identifier: MIT
#include "design/progress.hpp"

#include <chrono>

#include "design/real.hpp"

namespace lqg::design {

namespace {

using Clock = std::chrono::steady_clock;

struct Listener {
  const Progress* progress = nullptr;
  Clock::time_point last;
};

thread_local Listener listener;
thread_local const std::function<void()>* interruption = nullptr;

}  // namespace

ProgressScope::ProgressScope(const Progress& progress) {
  listener.progress = progress ? &progress : nullptr;
  listener.last = Clock::now();
}

ProgressScope::~ProgressScope() { listener.progress = nullptr; }

InterruptionScope::InterruptionScope(const std::function<void()>& check) { interruption = check ? &check : nullptr; }

InterruptionScope::~InterruptionScope() { interruption = nullptr; }

void report_progress(const char* work, long step, long all) {
  if (interruption) (*interruption)();
  if (!listener.progress) return;
  const Clock::time_point now = Clock::now();
  if (now - listener.last < std::chrono::seconds(1)) return;
  listener.last = now;
  (*listener.progress)(std::string(work) + " in " + std::to_string(Real::default_precision()) + " digits, step " +
                       std::to_string(step) + (all > 0 ? " of " + std::to_string(all) : ""));
}

}  // namespace lqg::design
