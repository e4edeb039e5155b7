// SPDX-License-Identifier: MIT
// A file that editors change in their ways, and that is replaced with its permissions, or not at all.
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <unity.h>

#include "serve/followed_file.hpp"

using namespace lqg::serve;
namespace fs = std::filesystem;

namespace {

fs::path folder;

void put(const fs::path& path, const std::string& content) { std::ofstream(path, std::ios::binary) << content; }

std::string get(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

void expect_change(FollowedFile& file, const char* content) {
  const auto changed = file.changed();
  TEST_ASSERT_TRUE_MESSAGE(changed.has_value(), content);
  TEST_ASSERT_EQUAL_STRING(content, changed->c_str());
}

void expect_no_change(FollowedFile& file) { TEST_ASSERT_FALSE(file.changed().has_value()); }

unsigned mode_of(const fs::path& path) {
  struct stat status = {};
  TEST_ASSERT_EQUAL_INT(0, ::stat(path.c_str(), &status));
  return status.st_mode & 07777;
}

std::size_t files_in_folder() {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

void test_saving_in_place_and_by_rename_are_seen_once_each() {
  const fs::path path = folder / "a.toml";
  put(path, "one");
  FollowedFile file(path);
  expect_change(file, "one");
  expect_no_change(file);
  put(path, "two");  // as long, and within one tick of the clock
  expect_change(file, "two");
  put(folder / "a.new", "three");
  fs::rename(folder / "a.new", path);
  expect_change(file, "three");
  expect_no_change(file);
}

void test_a_change_that_keeps_size_and_time_is_seen() {
  const fs::path path = folder / "b.toml";
  put(path, "one");
  FollowedFile file(path);
  expect_change(file, "one");
  const auto time = fs::last_write_time(path);
  put(path, "two");
  fs::last_write_time(path, time);
  expect_change(file, "two");
}

void test_a_file_that_is_away_for_a_moment_is_no_change() {
  const fs::path path = folder / "c.toml";
  put(path, "one");
  FollowedFile file(path);
  expect_change(file, "one");
  fs::remove(path);
  TEST_ASSERT_FALSE(file.is_there());
  expect_no_change(file);
  put(path, "one");
  TEST_ASSERT_TRUE(file.is_there());
  expect_no_change(file);
  fs::remove(path);
  fs::create_directory(path);
  TEST_ASSERT_FALSE(file.is_there());
  expect_no_change(file);
  fs::remove(path);
}

void test_touching_is_no_change() {
  const fs::path path = folder / "d.toml";
  put(path, "one");
  FollowedFile file(path);
  expect_change(file, "one");
  fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(10));
  expect_no_change(file);
}

void test_replacing_keeps_permissions_and_leaves_nothing_behind() {
  const fs::path path = folder / "e.toml";
  for (const unsigned mode : {0644u, 0600u, 0664u, 0755u}) {
    put(path, "old");
    TEST_ASSERT_EQUAL_INT(0, ::chmod(path.c_str(), mode));
    const std::size_t before = files_in_folder();
    TEST_ASSERT_TRUE(FollowedFile(path).replace("old", "new").written == FollowedFile::Written::yes);
    TEST_ASSERT_EQUAL_STRING("new", get(path).c_str());
    TEST_ASSERT_EQUAL_HEX(mode, mode_of(path));
    TEST_ASSERT_EQUAL_UINT(before, files_in_folder());
  }
}

void test_a_link_stays_a_link() {
  put(folder / "real.toml", "old");
  fs::create_symlink("real.toml", folder / "link.toml");
  TEST_ASSERT_TRUE(FollowedFile(folder / "link.toml").replace("old", "new").written == FollowedFile::Written::yes);
  TEST_ASSERT_TRUE(fs::is_symlink(folder / "link.toml"));
  TEST_ASSERT_EQUAL_STRING("new", get(folder / "real.toml").c_str());
}

void test_a_file_that_changed_meanwhile_is_left_alone() {
  const fs::path path = folder / "f.toml";
  put(path, "of somebody else");
  const std::size_t before = files_in_folder();
  TEST_ASSERT_TRUE(FollowedFile(path).replace("old", "new").written == FollowedFile::Written::changed_meanwhile);
  TEST_ASSERT_EQUAL_STRING("of somebody else", get(path).c_str());
  TEST_ASSERT_EQUAL_UINT(before, files_in_folder());
}

void test_a_failure_says_why() {
  const auto gone = FollowedFile(folder / "gone.toml").replace("old", "new");
  TEST_ASSERT_TRUE(gone.written == FollowedFile::Written::failed);
  TEST_ASSERT_TRUE(gone.why.find("gone.toml: No such file") != std::string::npos);
  // A link in the place of the temporary file is not followed.
  const fs::path path = folder / "g.toml";
  put(path, "old");
  put(folder / "victim", "mine");
  fs::create_symlink("victim", folder / (".g.toml.lqgen-watch-" + std::to_string(::getpid())));
  TEST_ASSERT_TRUE(FollowedFile(path).replace("old", "new").written == FollowedFile::Written::failed);
  TEST_ASSERT_EQUAL_STRING("mine", get(folder / "victim").c_str());
  TEST_ASSERT_EQUAL_STRING("old", get(path).c_str());
}

}  // namespace

int main() {
  std::string name = (fs::temp_directory_path() / "lqgen-followed-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) return 1;
  folder = name;
  UNITY_BEGIN();
  RUN_TEST(test_saving_in_place_and_by_rename_are_seen_once_each);
  RUN_TEST(test_a_change_that_keeps_size_and_time_is_seen);
  RUN_TEST(test_a_file_that_is_away_for_a_moment_is_no_change);
  RUN_TEST(test_touching_is_no_change);
  RUN_TEST(test_replacing_keeps_permissions_and_leaves_nothing_behind);
  RUN_TEST(test_a_link_stays_a_link);
  RUN_TEST(test_a_file_that_changed_meanwhile_is_left_alone);
  RUN_TEST(test_a_failure_says_why);
  const int failures = UNITY_END();
  std::error_code ignored;
  fs::remove_all(folder, ignored);
  return failures;
}
