// SPDX-License-Identifier: MIT
#include "watch.hpp"

#include <unistd.h>

#include <csignal>
#include <iostream>
#include <sstream>

#include "input/text.hpp"

namespace lqg {

namespace {

constexpr int impossible = 1;            // exit status
constexpr std::chrono::seconds soon(1);  // on a terminal
const char* const clear_line = "\r\033[K";

// What the signal handler writes; changed only while the signal is blocked.
std::string last_line;

void end_program(int) {
  const char* text = last_line.data();
  for (std::size_t left = last_line.size(); left > 0;) {
    const ssize_t written = ::write(STDERR_FILENO, text, left);
    if (written <= 0) break;
    text += written;
    left -= static_cast<std::size_t>(written);
  }
  ::_exit(impossible);
}

class AlarmBlocked {
 public:
  AlarmBlocked() {
    sigset_t alarm;
    sigemptyset(&alarm);
    sigaddset(&alarm, SIGALRM);
    ::sigprocmask(SIG_BLOCK, &alarm, &before_);
  }
  ~AlarmBlocked() { ::sigprocmask(SIG_SETMASK, &before_, nullptr); }
  AlarmBlocked(const AlarmBlocked&) = delete;
  AlarmBlocked& operator=(const AlarmBlocked&) = delete;

 private:
  sigset_t before_;
};

}  // namespace

Watch::Watch(const std::string& design_file, bool quiet, std::optional<unsigned> limit, std::chrono::seconds patience)
    : file_(input::printable(design_file)), shows_(!quiet), is_terminal_(::isatty(STDERR_FILENO)), limit_(limit),
      patience_(patience), begin_(std::chrono::steady_clock::now()) {
  if (!limit_) return;
  prepare_last_line("reading");
  std::signal(SIGALRM, end_program);
  ::alarm(*limit_);
}

Watch::~Watch() { end(); }

void Watch::prepare_last_line(const std::string& work) const {
  std::ostringstream line;
  line << (has_line_ ? clear_line : "") << file_ << ": expected the design within " << *limit_
       << " s (--time-limit), found it at work: " << work
       << "; nothing was written: allow more time, or make the design smaller (states, delay, horizon)\n";
  const AlarmBlocked blocked;
  last_line = line.str();
}

void Watch::show(const std::string& work, double share) {
  constexpr int width = 30;
  const int full = static_cast<int>(share * width), percent = static_cast<int>(share * 100);
  std::string bar;
  for (int i = 0; i < width; ++i) bar += i < full ? "█" : "░";
  show(work + ", step " + (shows_ && is_terminal_ ? bar + " " : "") + std::to_string(percent) + " %");
}

void Watch::show(const std::string& work) {
  const auto elapsed = std::chrono::steady_clock::now() - begin_;
  const std::string stage = work.substr(0, work.find(", step"));
  if (shows_ && is_terminal_ && elapsed >= soon) {
    std::cerr << clear_line << work << " …" << std::flush;
    has_line_ = true;
  } else if (shows_ && !is_terminal_ && elapsed >= patience_ && stage != stage_) {
    std::cerr << file_ << ": note: at work: " << work << "\n" << std::flush;
    stage_ = stage;
  }
  if (limit_) prepare_last_line(work);
}

void Watch::clear() {
  if (has_line_) std::cerr << clear_line << std::flush;
  has_line_ = false;
}

void Watch::end() {
  if (limit_) ::alarm(0);
  limit_.reset();
  clear();
}

}  // namespace lqg
