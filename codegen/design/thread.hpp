// SPDX-License-Identifier: MIT
// For programs that solve problems in threads of their own.
#pragma once

namespace lqg::design {

// MPFR keeps constants and memory for each thread. An object of this class, the first in a thread that calls solve() or
// first_look(), gives them back at the thread's end.
class ThreadCaches {
 public:
  ThreadCaches() = default;
  ~ThreadCaches();
  ThreadCaches(const ThreadCaches&) = delete;
  ThreadCaches& operator=(const ThreadCaches&) = delete;
};

}  // namespace lqg::design
