// SPDX-License-Identifier: MIT
// All files are written, or none: whatever goes wrong, what was there stays to the byte and nothing is left behind.
#include <sys/resource.h>
#include <sys/stat.h>
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

const std::vector<File> files = {{"a.h", "new a"}, {"b.c", "new b"}, {"c.json", "new c"}};
fs::path folder;

// Every file below the folder, with what is in it; a folder has a slash behind its name.
std::map<std::string, std::string> contents() {
  std::map<std::string, std::string> found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (entry.is_directory())
      found[name + "/"] = "";
    else
      found[name] = read(entry.path());
  }
  return found;
}

void expect_written() {
  TEST_ASSERT_EQUAL_size_t(files.size(), contents().size());
  for (const File& file : files) TEST_ASSERT_TRUE(read(folder / file.name) == file.content);
}

// Fails for `reason`, which names `culprit`, and leaves everything as it was.
void expect_refused(const std::vector<File>& wanted, const std::string& culprit, const std::string& reason) {
  const auto before = contents();
  const auto failure = write_all(folder.string(), wanted);
  TEST_ASSERT_TRUE(failure.has_value());
  TEST_ASSERT_TRUE_MESSAGE(failure->find(culprit) != std::string::npos, failure->c_str());
  TEST_ASSERT_TRUE_MESSAGE(failure->find(reason) != std::string::npos, failure->c_str());
  TEST_ASSERT_TRUE(before == contents());
}

void test_files_are_written_into_a_folder_that_is_made_for_them() {
  folder = folder / "deeper" / "still";
  TEST_ASSERT_FALSE(write_all(folder.string(), files).has_value());
  expect_written();
}

void test_old_files_are_replaced_as_a_whole() {
  for (const File& file : files) write(folder / file.name, std::string(1000, 'x'));
  TEST_ASSERT_FALSE(write_all(folder.string(), files).has_value());
  expect_written();
}

void test_other_files_in_the_folder_are_left_alone() {
  write(folder / "mine", "mine");
  TEST_ASSERT_FALSE(write_all(folder.string(), files).has_value());
  TEST_ASSERT_TRUE(read(folder / "mine") == "mine");
  TEST_ASSERT_EQUAL_size_t(files.size() + 1, contents().size());
}

void test_an_empty_file_and_one_with_any_bytes_are_written_as_they_are() {
  const std::string bytes("\0\r\n\xff", 4);
  TEST_ASSERT_FALSE(write_all(folder.string(), {{"empty", ""}, {"bytes", bytes}}).has_value());
  TEST_ASSERT_TRUE(read(folder / "empty").empty() && fs::exists(folder / "empty"));
  TEST_ASSERT_TRUE(read(folder / "bytes") == bytes);
}

void test_a_folder_in_the_place_of_any_file_stops_all() {
  for (const File& file : files) {
    folder = empty_folder("files");
    for (const File& old : files) write(folder / old.name, "old " + old.name);
    fs::remove(folder / file.name);
    fs::create_directory(folder / file.name);
    write(folder / file.name / "inside", "kept");
    expect_refused(files, file.name, "Is a directory");
  }
}

void test_a_folder_in_the_place_of_the_second_file_leaves_no_first() {
  fs::create_directory(folder / "b.c");
  expect_refused(files, "b.c", "Is a directory");
}

void test_a_file_in_the_place_of_the_folder_stays() {
  write(folder / "file", "kept");
  const auto before = contents();
  for (const char* where : {"file", "file/deeper"}) {
    const auto failure = write_all((folder / where).string(), files);
    TEST_ASSERT_TRUE(failure.has_value());
    TEST_ASSERT_TRUE_MESSAGE(failure->find("file") != std::string::npos, failure->c_str());
    TEST_ASSERT_TRUE(before == contents());
  }
}

void test_a_name_that_no_file_can_have_stops_all() {
  for (const File& file : files) write(folder / file.name, "old");
  expect_refused({files[0], {std::string(300, 'n'), ""}}, "nnn", "File name too long");
  expect_refused({files[0], {"nowhere/b.c", ""}}, "nowhere", "No such file");
}

// As on a full disk: the second file does not fit any more.
void test_a_file_that_grows_too_large_stops_all() {
  for (const File& file : files) write(folder / file.name, "old");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  ::getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 10000;
  ::setrlimit(RLIMIT_FSIZE, &small);
  expect_refused({files[0], {"b.c", std::string(20000, 'b')}, files[2]}, "b.c", "File too large");
  ::setrlimit(RLIMIT_FSIZE, &before);
}

// Where this process may mount one; RLIMIT_FSIZE above tells the same story everywhere.
void test_a_full_disk_stops_all() {
  const std::string disk = folder.string();
  if (!run("mount -t tmpfs -o size=64k tmpfs " + disk).succeeded) TEST_IGNORE_MESSAGE("no right to mount");
  for (const File& file : files) write(folder / file.name, "old");
  const auto before = contents();
  const auto failure = write_all(disk, {files[0], {"b.c", std::string(100000, 'b')}, files[2]});
  const auto after = contents();
  run("umount " + disk);
  TEST_ASSERT_TRUE(failure.has_value());
  TEST_ASSERT_TRUE_MESSAGE(failure->find("No space left") != std::string::npos, failure->c_str());
  TEST_ASSERT_TRUE(before == after);
}

void test_a_read_only_folder_stops_all() {
  if (::geteuid() == 0) TEST_IGNORE_MESSAGE("root may write anywhere");
  for (const File& file : files) write(folder / file.name, "old");
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  const auto failure = write_all(folder.string(), files);
  fs::permissions(folder, fs::perms::owner_all);
  TEST_ASSERT_TRUE(failure.has_value());
  for (const File& file : files) TEST_ASSERT_TRUE(read(folder / file.name) == "old");
}

void test_old_and_new_files_come_back_when_a_later_one_fails() {
  write(folder / "a.h", "old a");           // replaced, then put back
  fs::create_directory(folder / "c.json");  // b.c is new and goes again
  expect_refused(files, "c.json", "Is a directory");
}

void test_a_symbolic_link_is_replaced_and_what_it_points_to_is_kept() {
  write(folder / "elsewhere", "kept");
  fs::create_symlink("elsewhere", folder / "a.h");
  TEST_ASSERT_FALSE(write_all(folder.string(), files).has_value());
  TEST_ASSERT_TRUE(read(folder / "elsewhere") == "kept" && read(folder / "a.h") == "new a");
  TEST_ASSERT_FALSE(fs::is_symlink(folder / "a.h"));
}

void test_a_symbolic_link_comes_back_when_a_later_file_fails() {
  write(folder / "elsewhere", "kept");
  fs::create_symlink("elsewhere", folder / "a.h");
  fs::create_directory(folder / "b.c");
  expect_refused(files, "b.c", "Is a directory");
  TEST_ASSERT_TRUE(fs::is_symlink(folder / "a.h"));
}

}  // namespace

extern "C" {
void setUp(void) { folder = empty_folder("files"); }
void tearDown(void) {}
}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_files_are_written_into_a_folder_that_is_made_for_them);
  RUN_TEST(test_old_files_are_replaced_as_a_whole);
  RUN_TEST(test_other_files_in_the_folder_are_left_alone);
  RUN_TEST(test_an_empty_file_and_one_with_any_bytes_are_written_as_they_are);
  RUN_TEST(test_a_folder_in_the_place_of_any_file_stops_all);
  RUN_TEST(test_a_folder_in_the_place_of_the_second_file_leaves_no_first);
  RUN_TEST(test_a_file_in_the_place_of_the_folder_stays);
  RUN_TEST(test_a_name_that_no_file_can_have_stops_all);
  RUN_TEST(test_a_file_that_grows_too_large_stops_all);
  RUN_TEST(test_a_full_disk_stops_all);
  RUN_TEST(test_a_read_only_folder_stops_all);
  RUN_TEST(test_old_and_new_files_come_back_when_a_later_one_fails);
  RUN_TEST(test_a_symbolic_link_is_replaced_and_what_it_points_to_is_kept);
  RUN_TEST(test_a_symbolic_link_comes_back_when_a_later_file_fails);
  return UNITY_END();
}
