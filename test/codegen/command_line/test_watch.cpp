// SPDX-License-Identifier: MIT
// What lqgen says of long work where no terminal is, and how it ends when its time is up.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <unity.h>

#include <functional>

#include "program.hpp"
#include "watch.hpp"

using lqg::Watch;

namespace {

constexpr std::chrono::seconds at_once(0), never(1000000);

// Does `work` in a process of its own whose standard error is a file.
Outcome in_a_process(const std::function<void()>& work) {
  const std::filesystem::path log = fresh_folder("watch") / "err";
  const pid_t child = ::fork();
  TEST_ASSERT_TRUE(child >= 0);
  if (child == 0) {
    const int file = ::open(log.c_str(), O_WRONLY | O_CREAT, 0644);
    if (file < 0 || ::dup2(file, STDERR_FILENO) < 0) ::_exit(126);
    work();
    ::_exit(0);
  }
  int state = 0;
  TEST_ASSERT_EQUAL_INT(child, ::waitpid(child, &state, 0));
  return {WIFEXITED(state) ? WEXITSTATUS(state) : 128, "", read_file(log)};
}

void three_stages(Watch& watch) {
  watch.show("sampling in 50 digits, step 3 of 9");
  watch.show("sampling in 50 digits, step 4 of 9");
  watch.show("eigenvalues in 50 digits, step 1");
  watch.show("eigenvalues in 100 digits, step 1");
  watch.show("eigenvalues in 100 digits, step 2");
}

void test_each_stage_is_a_line_once() {
  const Outcome outcome = in_a_process([] {
    Watch watch("a\nb.toml", false, std::nullopt, at_once);
    three_stages(watch);
  });
  TEST_ASSERT_EQUAL_STRING(
      "a\\u000Ab.toml: note: at work: sampling in 50 digits, step 3 of 9\n"
      "a\\u000Ab.toml: note: at work: eigenvalues in 50 digits, step 1\n"
      "a\\u000Ab.toml: note: at work: eigenvalues in 100 digits, step 1\n",
      outcome.err.c_str());
}

void test_what_does_not_take_long_and_quiet_say_nothing() {
  const Outcome soon = in_a_process([] {
    Watch watch("a.toml", false, std::nullopt, never);
    three_stages(watch);
  });
  const Outcome quiet = in_a_process([] {
    Watch watch("a.toml", true, std::nullopt, at_once);
    three_stages(watch);
  });
  TEST_ASSERT_EQUAL_STRING("", soon.err.c_str());
  TEST_ASSERT_EQUAL_STRING("", quiet.err.c_str());
}

// It waits for nothing else.
void test_limit_ends_the_program_where_it_is() {
  const Outcome outcome = in_a_process([] {
    Watch watch("a.toml", true, 1u, never);
    three_stages(watch);
    for (;;) ::pause();
  });
  TEST_ASSERT_EQUAL_INT(1, outcome.status);
  TEST_ASSERT_EQUAL_STRING(
      "a.toml: expected the design within 1 s (--time-limit), found it at work: eigenvalues in 100 "
      "digits, step 2; nothing was written: allow more time, or make the design smaller (states, "
      "delay, horizon)\n",
      outcome.err.c_str());
}

void test_limit_that_was_lifted_ends_nothing() {
  const Outcome outcome = in_a_process([] {
    Watch watch("a.toml", true, 1000u, never);
    watch.end();
    if (::alarm(0) != 0) ::_exit(2);  // what was left of it
  });
  TEST_ASSERT_EQUAL_INT(0, outcome.status);
  TEST_ASSERT_EQUAL_STRING("", outcome.err.c_str());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_each_stage_is_a_line_once);
  RUN_TEST(test_what_does_not_take_long_and_quiet_say_nothing);
  RUN_TEST(test_limit_ends_the_program_where_it_is);
  RUN_TEST(test_limit_that_was_lifted_ends_nothing);
  return UNITY_END();
}
