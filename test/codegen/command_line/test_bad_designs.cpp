// SPDX-License-Identifier: MIT
// test_bad_designs LQGEN BASE.toml: every bad design is refused in its own words, with its own exit status,
// each finding on a line of its own, and what an earlier run has written stays as it was, to the byte and to
// the second.
#include <unity.h>

#include "bad_designs.hpp"
#include "program.hpp"

namespace fs = std::filesystem;

namespace {

std::string lqgen, base;
const BadDesign* design;  // under test
int expected_status;

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t at = text.find(separator); at != text.npos; at = text.find(separator, from)) {
    parts.push_back(text.substr(from, at - from));
    from = at + separator.size();
  }
  parts.push_back(text.substr(from));
  return parts;
}

// Lines count from 1; a last line end makes no line.
std::string edited(const std::vector<Edit>& edits) {
  std::vector<std::string> lines = split(base, "\n");
  for (const Edit& edit : edits) {
    if (edit.line == 0) return edit.text;
    for (int line = edit.line; line <= edit.last; ++line) lines.at(static_cast<std::size_t>(line) - 1).clear();
    lines.at(static_cast<std::size_t>(edit.line) - 1) = edit.text;
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

bool matches(const std::string& pattern, const std::string& line) {
  const std::vector<std::string> parts = split(pattern, "…");
  std::size_t at = parts.front().size();
  if (line.compare(0, at, parts.front()) != 0) return false;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const bool last = i + 1 == parts.size();
    if (last && line.size() < at + parts[i].size()) return false;
    at = last ? line.size() - parts[i].size() : line.find(parts[i], at);
    if (at == line.npos || line.compare(at, parts[i].size(), parts[i]) != 0) return false;
    at += parts[i].size();
  }
  return at == line.size();
}

void expect_lines(const std::vector<std::string>& patterns, const std::string& text) {
  std::vector<std::string> lines = split(text, "\n");
  TEST_ASSERT_EQUAL_STRING("", lines.back().c_str());
  lines.pop_back();
  TEST_ASSERT_EQUAL_UINT_MESSAGE(patterns.size(), lines.size(), text.c_str());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string pattern = "design.toml:" + patterns[i];
    TEST_ASSERT_TRUE_MESSAGE(matches(pattern, lines[i]), (lines[i] + "   is not   " + pattern).c_str());
  }
}

void refuses_design() {
  const fs::path folder = fresh_folder("bad_designs");
  write_file(folder / "design.toml", edited(design->edits));
  write_old_outputs(folder / "out", "base");
  const Snapshot before = snapshot(folder / "out");
  const Outcome outcome = run({lqgen, "design.toml", "-o", "out"}, folder);
  expect_lines(design->lines, outcome.err);
  TEST_ASSERT_EQUAL_INT(expected_status, outcome.status);
  TEST_ASSERT_EQUAL_STRING("", outcome.out.c_str());
  TEST_ASSERT_TRUE_MESSAGE(before == snapshot(folder / "out"), "outputs were touched");
}

void accepts_base() {
  const fs::path folder = fresh_folder("bad_designs");
  write_file(folder / "design.toml", base);
  const Outcome outcome = run({lqgen, "design.toml", "-o", "out"}, folder);
  TEST_ASSERT_EQUAL_STRING("", outcome.err.c_str());
  TEST_ASSERT_EQUAL_INT(0, outcome.status);
}

void check_all(const std::vector<BadDesign>& designs, int status) {
  for (const BadDesign& each : designs) {
    design = &each;
    expected_status = status;
    UnityDefaultTestRun(refuses_design, each.what.c_str(), __LINE__);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  lqgen = fs::absolute(arguments[1]).string();
  base = read_file(arguments[2]);
  UNITY_BEGIN();
  RUN_TEST(accepts_base);
  check_all(not_toml(), 2);
  check_all(wrong_keys(), 2);
  check_all(wrong_values(), 2);
  check_all(wrong_shapes(), 2);
  check_all(wrong_together(), 2);
  check_all(wrong_scenarios(), 2);
  check_all(missed_in_scenarios(), 1);
  check_all(impossible(), 1);
  return UNITY_END();
}
