// SPDX-License-Identifier: MIT
// test_simulate LQGEN BASE.toml: `lqgen simulate`.
#include <algorithm>
#include <sstream>
#include <unity.h>

#include "program.hpp"

namespace fs = std::filesystem;

namespace {

enum Status { written = 0, impossible = 1, wrong = 2, unreadable = 3 };

const char* const scenarios = R"(
[[scenario]]
name = "a push, and a gap"
duration = 10
load = [{ input = "force", value = 1, at = 1, until = 2 }]
dropout = [{ output = "y1", from = 4, until = 5 }]
spread = { A = 0.1 }

[[scenario]]
name = "a push and a gap"
duration = 10
noise = false
load = [{ state = "v1", csv = "force.csv", at = 1 }]
)";

std::string lqgen, base;
fs::path folder;  // of the test that runs, with base.toml

Outcome run_lqgen(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), lqgen);
  return run(arguments, folder);
}

void expect_refusal(Status status, const std::string& line, const std::vector<std::string>& arguments) {
  const Snapshot before = snapshot(folder);
  const Outcome outcome = run_lqgen(arguments);
  TEST_ASSERT_EQUAL_INT_MESSAGE(status, outcome.status, outcome.err.c_str());
  TEST_ASSERT_EQUAL_STRING((line + "\n").c_str(), outcome.err.c_str());
  TEST_ASSERT_TRUE_MESSAGE(before == snapshot(folder), "files were touched");
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void test_each_scenario_has_its_file_and_its_numbers() {
  const Outcome outcome = run_lqgen({"simulate", "base.toml", "-o", "out"});
  TEST_ASSERT_EQUAL_INT_MESSAGE(written, outcome.status, outcome.err.c_str());
  TEST_ASSERT_TRUE(has(outcome.out, "a push, and a gap\n") && has(outcome.out, "force"));
  TEST_ASSERT_EQUAL_UINT(3, snapshot(folder / "out").size());
  const std::vector<std::string> lines = lines_of(read_file(folder / "out/base_a_push_and_a_gap.csv"));
  TEST_ASSERT_EQUAL_UINT(1 + 20, lines.size());
  TEST_ASSERT_EQUAL_STRING(
      "t,y_y1,y_y2,u_force,x_dy1,x_v1,x_dy2,x_v2,estimate_dy1,estimate_v1,estimate_dy2,estimate_v2,"
      "sigma_dy1,sigma_v1,sigma_dy2,sigma_v2,innovation_y1,innovation_y2,nis,nees,events",
      lines[0].c_str());
  TEST_ASSERT_TRUE_MESSAGE(lines[9].rfind("4,,", 0) == 0, "a missing output is an empty field");
  TEST_ASSERT_TRUE(has(lines[9], "output_rejected|output_rejected_0"));
  TEST_ASSERT_TRUE(fs::exists(folder / "out/base_a_push_and_a_gap_2.csv"));
  TEST_ASSERT_TRUE(has(read_file(folder / "out/base_simulation.html"), "The loop holds in every scenario."));
}

// A table of 0 and 2 from 1 s and 2 s on, times from `at` on; the mass's own spring moves it little in half a second.
void test_a_load_may_be_a_column_of_a_file_beside_the_design() {
  fs::create_directory(folder / "sub");
  write_file(folder / "sub/base.toml", base + scenarios);
  write_file(folder / "sub/force.csv", "v1,t\n0,0\n# from here on\n2,1\n");
  const Outcome outcome =
      run_lqgen({"simulate", "sub/base.toml", "--scenario", "a push and a gap", "--quiet", "-o", "out"});
  TEST_ASSERT_EQUAL_INT_MESSAGE(written, outcome.status, outcome.err.c_str());
  const std::vector<std::string> lines = lines_of(read_file(folder / "out/base_a_push_and_a_gap.csv"));
  TEST_ASSERT_TRUE(has(lines[5], "2,0,0,0,0,0,0,0,"));
  TEST_ASSERT_FALSE(has(lines[6], "2.5,0,0,0,0,0,0,0,"));
}

void test_the_same_seed_gives_the_same_bytes_and_another_one_others() {
  const auto with_seed = [](const char* seed) {
    return run_lqgen({"simulate", "base.toml", "--json", "--seed", seed}).out;
  };
  const std::string once = with_seed("5");
  TEST_ASSERT_TRUE(once == with_seed("5"));
  TEST_ASSERT_FALSE(once == with_seed("6"));
  TEST_ASSERT_FALSE_MESSAGE(has(once, "nan") || has(once, "inf\""), "JSON has no NaN");
}

void test_json_writes_no_file() {
  const Snapshot before = snapshot(folder);
  const Outcome outcome = run_lqgen({"simulate", "base.toml", "--json", "--runs", "3"});
  TEST_ASSERT_EQUAL_INT(written, outcome.status);
  TEST_ASSERT_TRUE(outcome.out.rfind("{\"name\":\"base\"", 0) == 0 && outcome.out.back() == '\n');
  TEST_ASSERT_TRUE(has(outcome.out, "\"monte_carlo\":[{\"name\":\"a push, and a gap\",\"runs\":3,"));
  TEST_ASSERT_TRUE(before == snapshot(folder));
}

void test_runs_write_the_numbers_of_each_run() {
  const Outcome outcome = run_lqgen({"simulate", "base.toml", "--runs", "20", "-o", "out"});
  TEST_ASSERT_EQUAL_INT_MESSAGE(written, outcome.status, outcome.err.c_str());
  TEST_ASSERT_TRUE(has(outcome.out, "a push, and a gap, 20 runs: 0 % failed"));
  TEST_ASSERT_TRUE(has(outcome.out, "NEES: mean "));
  TEST_ASSERT_TRUE(has(read_file(folder / "out/base_simulation.html"), "No run failed."));
  TEST_ASSERT_EQUAL_UINT(21, lines_of(read_file(folder / "out/base_a_push_and_a_gap_runs.csv")).size());
}

void test_a_run_is_replayed_from_its_own_file() {
  run_lqgen({"simulate", "base.toml", "-o", "out"});
  const Outcome outcome =
      run_lqgen({"simulate", "base.toml", "--replay", "out/base_a_push_and_a_gap.csv", "-o", "out"});
  TEST_ASSERT_EQUAL_INT_MESSAGE(written, outcome.status, outcome.err.c_str());
  TEST_ASSERT_TRUE(has(outcome.out, "replay of 20 samples\n") && has(outcome.out, "left out: y1 in 2 samples"));
  const auto estimates = [](const std::string& file) {
    const std::vector<std::string> lines = lines_of(read_file(folder / "out" / file));
    std::vector<std::string> names = lines_of(lines[0]), out;
    std::string head = lines[0];
    std::replace(head.begin(), head.end(), ',', '\n');
    names = lines_of(head);
    const std::size_t column =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), "estimate_v2") - names.begin());
    for (std::size_t i = 1; i < lines.size(); ++i) {
      std::istringstream fields(lines[i]);
      std::string field;
      for (std::size_t j = 0; j <= column; ++j) std::getline(fields, field, ',');
      out.push_back(field);
    }
    return out;
  };
  TEST_ASSERT_TRUE(estimates("base_a_push_and_a_gap.csv") == estimates("base_replay.csv"));
}

void test_logs_that_cannot_be_right_are_refused_with_their_line() {
  const auto expect = [](const std::string& log, const std::string& line) {
    write_file(folder / "log.csv", log);
    expect_refusal(wrong, "lqgen simulate: log.csv" + line, {"simulate", "base.toml", "--replay", "log.csv"});
  };
  expect("y1,force\n1,2\n", ": expected a column \"y2\" or \"y_y2\" with numbers, found none");
  expect("y1,y2,force\n1,2,3\n1,two,3\n", ":3: expected a number, found \"two\"");
  expect("y1,y2,force\n1,2,3\n1,2\n", ":3: expected as many fields, separated by commas, as the header has");
  expect("y1,y2,force\n1,2,\n",
         ": expected finite inputs, found none in sample 0: write what was applied, 0 before "
         "the start");
  expect("t,y1,y2,force\n0,1,2,3\n0.1,1,2,3\n",
         ": expected a sample every 0.5 s (plant.sample_time), found t = 0.1 after 0; a missing sample is a line with "
         "empty outputs");
  expect_refusal(wrong, "lqgen simulate: none.csv: cannot be read", {"simulate", "base.toml", "--replay", "none.csv"});
}

void test_a_scenario_that_is_not_there_is_named() {
  expect_refusal(wrong,
                 "lqgen simulate: --scenario: expected one of \"a push, and a gap\", \"a push and a gap\", found "
                 "\"a push and a gab\"; did you mean \"a push and a gap\"?",
                 {"simulate", "base.toml", "--scenario", "a push and a gab"});
}

void test_what_misses_a_requirement_is_shown_and_the_status_tells() {
  write_file(folder / "base.toml", base + scenarios + "[require]\nrms = [{ output = \"y1\", value = 1e-6 }]\n");
  const Outcome outcome = run_lqgen({"simulate", "base.toml", "-o", "out"});
  TEST_ASSERT_EQUAL_INT(impossible, outcome.status);
  TEST_ASSERT_EQUAL_UINT(2, lines_of(outcome.err).size());
  TEST_ASSERT_TRUE(has(outcome.err,
                       "require.rms[0].value: requires at most 1e-06, scenario \"a push and a gap\": the "
                       "rms of y1 is "));
  TEST_ASSERT_EQUAL_UINT(3, snapshot(folder / "out").size());
  TEST_ASSERT_EQUAL_INT(impossible, run_lqgen({"check", "base.toml"}).status);
}

void test_an_output_that_cannot_be_written() {
  write_file(folder / "file", "");
  expect_refusal(unreadable, "file: Not a directory", {"simulate", "base.toml", "-o", "file"});
}

}  // namespace

void setUp() {
  folder = fresh_folder("simulate");
  write_file(folder / "base.toml", base + scenarios);
  write_file(folder / "force.csv", "t,v1\n0,0.5\n");
}
void tearDown() {}

int main(int, char** arguments) {
  lqgen = fs::absolute(arguments[1]);
  base = read_file(arguments[2]);
  UNITY_BEGIN();
  RUN_TEST(test_each_scenario_has_its_file_and_its_numbers);
  RUN_TEST(test_a_load_may_be_a_column_of_a_file_beside_the_design);
  RUN_TEST(test_the_same_seed_gives_the_same_bytes_and_another_one_others);
  RUN_TEST(test_json_writes_no_file);
  RUN_TEST(test_runs_write_the_numbers_of_each_run);
  RUN_TEST(test_a_run_is_replayed_from_its_own_file);
  RUN_TEST(test_logs_that_cannot_be_right_are_refused_with_their_line);
  RUN_TEST(test_a_scenario_that_is_not_there_is_named);
  RUN_TEST(test_what_misses_a_requirement_is_shown_and_the_status_tells);
  RUN_TEST(test_an_output_that_cannot_be_written);
  return UNITY_END();
}
