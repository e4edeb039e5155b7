// SPDX-License-Identifier: MIT
// One thread that computes what the page shows: the state of the file before all trials, and the newest trial only. It
// is one alone, for the engine's number of digits is that of the whole process.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "view/picture.hpp"

namespace lqg::view {

class Worker {
 public:
  // Posts a piece of work to the thread that the results belong to.
  using Post = std::function<void(std::function<void()>)>;

  // Gets the picture and the time that it took in ms, or nothing where a newer job came first.
  using Done = std::function<void(std::optional<Picture>, double)>;

  struct Job {
    std::string text, path;
    bool is_trial = false;  // else it is the state of the file
    Depth depth = Depth::whole;
    std::vector<design::Scenario> like;  // see picture_of
    Done done;
  };

  explicit Worker(Post post);

  // Ends the thread where it reports within a moment; leaves it behind, and says so by false, where it is deep in work.
  bool end(std::chrono::milliseconds patience);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  // A trial takes the place of one that waits, and breaks off one at work at its next step. The
  // state of the file does so with everything.
  void start(Job job);

 private:
  void run();
  void work(Job& job);
  void drop(std::optional<Job>& job);
  std::optional<Job> next();

  Post post_;
  std::mutex mutex_;
  std::condition_variable wake_, over_;
  std::optional<Job> file_, trial_;  // that wait
  bool works_on_file_ = false, ends_ = false, is_over_ = false;
  std::atomic<bool> is_superseded_ = false;
  std::thread thread_;
};

}  // namespace lqg::view
