// SPDX-License-Identifier: MIT
#include "view/worker.hpp"

#include <chrono>
#include <utility>

#include "design/progress.hpp"
#include "design/thread.hpp"

namespace lqg::view {

namespace {

struct Superseded {};

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

Picture failed_picture(const std::string& path, const std::string& why) {
  Picture picture;
  picture.lines = {path + ": lqgen failed: " + why};
  picture.has_error = true;
  return picture;
}

}  // namespace

Worker::Worker(Post post) : post_(std::move(post)), thread_([this] { run(); }) {}

Worker::~Worker() {
  if (thread_.joinable()) {
    end(std::chrono::hours(1));
    thread_.join();
  }
}

bool Worker::end(std::chrono::milliseconds patience) {
  std::unique_lock<std::mutex> lock(mutex_);
  ends_ = true;
  is_superseded_ = true;
  wake_.notify_one();
  return over_.wait_for(lock, patience, [this] { return is_over_; });
}

void Worker::drop(std::optional<Job>& job) {
  if (job) post_([done = std::move(job->done)] { done(std::nullopt, 0); });
  job.reset();
}

void Worker::start(Job job) {
  const std::lock_guard<std::mutex> lock(mutex_);
  drop(trial_);
  if (!job.is_trial) drop(file_);
  if (!job.is_trial || !works_on_file_) is_superseded_ = true;
  std::optional<Job>& place = job.is_trial ? trial_ : file_;
  place = std::move(job);
  wake_.notify_one();
}

std::optional<Worker::Job> Worker::next() {
  std::unique_lock<std::mutex> lock(mutex_);
  works_on_file_ = false;
  wake_.wait(lock, [this] { return ends_ || file_ || trial_; });
  if (ends_) return std::nullopt;
  works_on_file_ = file_.has_value();
  is_superseded_ = false;
  return std::exchange(works_on_file_ ? file_ : trial_, std::nullopt);
}

void Worker::run() {
  const design::ThreadCaches caches;
  while (std::optional<Job> job = next()) work(*job);
  const std::lock_guard<std::mutex> lock(mutex_);
  is_over_ = true;
  over_.notify_all();
}

void Worker::work(Job& job) {
  const auto begin = std::chrono::steady_clock::now();
  std::optional<Picture> picture;
  const std::function<void()> check = [this] {
    if (is_superseded_) throw Superseded();
  };
  const design::InterruptionScope interruption(check);
  try {
    picture = picture_of(job.text, job.path, job.depth, job.like);
  } catch (const Superseded&) {
  } catch (const std::exception& error) {
    picture = failed_picture(job.path, error.what());
  }
  const double time = milliseconds_since(begin);
  post_([done = std::move(job.done), picture = std::move(picture), time] { done(picture, time); });
}

}  // namespace lqg::view
