// SPDX-License-Identifier: MIT
// What is written when lqgen is killed at any moment, when two of them run at once, and when somebody has put links in
// the way.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <map>

#include <unity.h>

#include "../compiler.hpp"
#include "emit/text/files.hpp"

using namespace lqg_test;
using lqg::emit::File;
using lqg::emit::write_all;

namespace fs = std::filesystem;

namespace {

using Contents = std::map<std::string, std::string>;
const std::vector<std::string> names = {"a.h", "a_test.c", "a.json", "a.html"};
const Contents nothing;
fs::path folder;

std::vector<File> set_of(const std::string& run) {
  std::vector<File> files;
  for (const std::string& name : names) files.push_back({name, name + " of " + run});
  return files;
}

Contents contents_of(const std::string& run) {
  Contents contents;
  for (const File& file : set_of(run)) contents[file.name] = file.content;
  return contents;
}

// Those of the set `names` that are there.
Contents visible() {
  Contents found;
  for (const std::string& name : names)
    if (fs::exists(fs::symlink_status(folder / name))) found[name] = read(folder / name);
  return found;
}

bool is_part_of(const Contents& part, const Contents& whole) {
  for (const auto& [name, content] : part)
    if (whole.count(name) == 0 || whole.at(name) != content) return false;
  return true;
}

std::size_t entries() {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

// Runs `work` in a process of its own up to the stop of that number: before or behind a system call. 0: it has ended
// before.
template <class Work>
pid_t stopped_at(int stop, Work work) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) ::_exit(99);
    std::raise(SIGSTOP);
    work();
    ::_exit(0);
  }
  int state = 0;
  ::waitpid(child, &state, 0);
  for (int k = 0; k < stop && WIFSTOPPED(state); ++k) {
    ::ptrace(PTRACE_SYSCALL, child, nullptr, nullptr);
    ::waitpid(child, &state, 0);
  }
  if (WIFEXITED(state)) {
    if (WEXITSTATUS(state) == 99) TEST_IGNORE_MESSAGE("no right to trace a process");
    return 0;
  }
  return child;
}

// The same, and kills it there. False: it has ended before.
template <class Work>
bool killed_at(int stop, Work work) {
  const pid_t child = stopped_at(stop, work);
  if (child == 0) return false;
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  return true;
}

void begin_with(const Contents& before) {
  folder = empty_folder("interrupted");
  for (const auto& [name, content] : before) write(folder / name, content);
}

void write_new() { (void)write_all(folder.string(), set_of("new")); }
void write_other() { (void)write_all(folder.string(), {{"b.h", "b"}}); }

// The next run, of whatever design, finds the old set or the new one, as a whole, and leaves nothing else.
void expect_whole_after_the_next_run(const Contents& before, const std::string& where) {
  write_other();
  const Contents after = visible();
  TEST_ASSERT_TRUE_MESSAGE(after == before || after == contents_of("new"), ("a mixed set " + where).c_str());
  TEST_ASSERT_EQUAL_size_t_MESSAGE(after.size() + 1, entries(), ("litter " + where).c_str());
}

int killed_at_every_point(const Contents& before) {
  int stop = 1;
  for (;; ++stop) {
    begin_with(before);
    if (!killed_at(stop, write_new)) break;
    const Contents seen = visible();
    const std::string where = "at stop " + std::to_string(stop);
    TEST_ASSERT_TRUE_MESSAGE(is_part_of(seen, before) || is_part_of(seen, contents_of("new")),
                             ("a mixed set " + where).c_str());
    TEST_ASSERT_TRUE_MESSAGE(before.empty() || seen.count("a.h"), ("no a.h " + where).c_str());
    expect_whole_after_the_next_run(before, where);
  }
  TEST_ASSERT_TRUE(visible() == contents_of("new"));
  TEST_ASSERT_EQUAL_size_t(names.size(), entries());
  return stop;
}

void test_a_kill_at_any_point_leaves_files_of_one_run_and_the_next_run_makes_them_whole() {
  TEST_ASSERT_TRUE(killed_at_every_point(contents_of("old")) > 40);
}

void test_a_kill_at_any_point_of_the_first_run_leaves_nothing_or_files_of_that_run() { killed_at_every_point(nothing); }

void test_a_kill_where_some_old_files_are_there_brings_them_back_or_the_new_ones() {
  killed_at_every_point({{"a.h", "a.h of old"}, {"a.html", "a.html of old"}});
}

void test_a_kill_while_the_next_run_cleans_up_changes_nothing_of_that() {
  const Contents before = contents_of("old");
  for (int stop = 40;; stop += 16) {
    begin_with(before);
    if (!killed_at(stop, write_new)) break;
    for (int next = 1; killed_at(next, write_other); next += 5) {
      const Contents seen = visible();
      TEST_ASSERT_TRUE(is_part_of(seen, before) || is_part_of(seen, contents_of("new")));
    }
    expect_whole_after_the_next_run(before, "after kills at stop " + std::to_string(stop));
  }
}

// Where temporary files are made, and were made by lqgen 0.1.0.
std::vector<std::string> temporary_names(pid_t process) {
  std::vector<std::string> found;
  const std::string number = std::to_string(process);
  for (const std::string& name : names) {
    for (const char* role : {"first", "new", "old"}) found.push_back("." + name + ".lqgen-" + role + "-" + number);
    for (const char* role : {"new", "old"}) found.push_back(name + "." + role + number);
  }
  return found;
}

void test_links_in_the_place_of_temporary_files_are_not_followed() {
  begin_with(contents_of("old"));
  write(folder / "victim", "kept");
  const pid_t child = ::fork();
  if (child == 0) {
    for (const std::string& name : temporary_names(::getpid())) fs::create_symlink("victim", folder / name);
    ::_exit(write_all(folder.string(), set_of("new")) ? 1 : 0);
  }
  int state = 0;
  ::waitpid(child, &state, 0);
  TEST_ASSERT_TRUE(WIFEXITED(state) && WEXITSTATUS(state) == 0);
  TEST_ASSERT_TRUE(read(folder / "victim") == "kept");
  TEST_ASSERT_TRUE(visible() == contents_of("new"));
  for (const std::string& name : names) TEST_ASSERT_FALSE(fs::is_symlink(folder / name));
}

void test_temporary_files_of_another_user_do_not_become_outputs() {
  if (::geteuid() != 0) TEST_IGNORE_MESSAGE("only root can give a file away");
  begin_with(contents_of("old"));
  for (const char* name : {".a.h.lqgen-first-1", ".a.h.lqgen-old-1", ".a.json.lqgen-new-2"}) {
    write(folder / name, "forged");
    TEST_ASSERT_EQUAL_INT(0, ::lchown((folder / name).c_str(), 65534, 65534));
  }
  write_other();
  TEST_ASSERT_TRUE(visible() == contents_of("old"));
  TEST_ASSERT_EQUAL_size_t(names.size() + 1, entries());
}

void test_files_that_only_look_like_temporary_ones_stay() {
  begin_with(nothing);
  const char* const mine[] = {".a.h.lqgen-new-", ".a.h.lqgen-new-1x", ".a.h.lqgen-mine-1",
                              "a.h.lqgen-new-1", ".lqgen-new-1",      "a.h.old1"};
  for (const char* name : mine) write(folder / name, "mine");
  write_new();
  for (const char* name : mine) TEST_ASSERT_TRUE_MESSAGE(read(folder / name) == "mine", name);
}

// One run is halted at each point in turn while another begins and ends.
void test_two_runs_at_once_leave_the_set_of_one() {
  for (int stop = 1;; ++stop) {
    begin_with(contents_of("old"));
    const pid_t child = stopped_at(stop, write_new);
    if (child == 0) break;
    const auto failure = write_all(folder.string(), set_of("second"), std::chrono::milliseconds(0));
    ::ptrace(PTRACE_DETACH, child, nullptr, nullptr);
    ::waitpid(child, nullptr, 0);
    const std::string where = "at stop " + std::to_string(stop);
    const bool is_second = !failure && visible() == contents_of("second");
    TEST_ASSERT_TRUE_MESSAGE(is_second || visible() == contents_of("new"), where.c_str());
    TEST_ASSERT_EQUAL_size_t_MESSAGE(names.size(), entries(), where.c_str());
  }
}

void test_runs_wait_for_each_other() {
  begin_with(nothing);
  pid_t children[4];
  for (int k = 0; k < 4; ++k) {
    children[k] = ::fork();
    if (children[k] != 0) continue;
    int failures = 0;
    for (int call = 0; call < 10; ++call) failures += write_all(folder.string(), set_of(std::to_string(k))).has_value();
    ::_exit(failures);
  }
  for (const pid_t child : children) {
    int state = 0;
    ::waitpid(child, &state, 0);
    TEST_ASSERT_TRUE_MESSAGE(WIFEXITED(state) && WEXITSTATUS(state) == 0, "a run has failed");
  }
  TEST_ASSERT_EQUAL_size_t(names.size(), entries());
  TEST_ASSERT_EQUAL_size_t(names.size(), visible().size());
}

void test_a_folder_that_another_program_keeps_locked_is_left_as_it_is() {
  begin_with(contents_of("old"));
  const int other = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY);
  TEST_ASSERT_EQUAL_INT(0, ::flock(other, LOCK_EX));
  const auto failure = write_all(folder.string(), set_of("new"), std::chrono::milliseconds(0));
  ::close(other);
  TEST_ASSERT_TRUE(failure.has_value());
  TEST_ASSERT_TRUE_MESSAGE(failure->find("locked") != std::string::npos, failure->c_str());
  TEST_ASSERT_TRUE(visible() == contents_of("old"));
  TEST_ASSERT_EQUAL_size_t(names.size(), entries());
  TEST_ASSERT_FALSE(write_all(folder.string(), set_of("new"), std::chrono::milliseconds(0)).has_value());
}

}  // namespace

extern "C" {
void setUp(void) {}
void tearDown(void) {}
}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_a_kill_at_any_point_leaves_files_of_one_run_and_the_next_run_makes_them_whole);
  RUN_TEST(test_a_kill_at_any_point_of_the_first_run_leaves_nothing_or_files_of_that_run);
  RUN_TEST(test_a_kill_where_some_old_files_are_there_brings_them_back_or_the_new_ones);
  RUN_TEST(test_a_kill_while_the_next_run_cleans_up_changes_nothing_of_that);
  RUN_TEST(test_links_in_the_place_of_temporary_files_are_not_followed);
  RUN_TEST(test_temporary_files_of_another_user_do_not_become_outputs);
  RUN_TEST(test_files_that_only_look_like_temporary_ones_stay);
  RUN_TEST(test_two_runs_at_once_leave_the_set_of_one);
  RUN_TEST(test_runs_wait_for_each_other);
  RUN_TEST(test_a_folder_that_another_program_keeps_locked_is_left_as_it_is);
  return UNITY_END();
}
