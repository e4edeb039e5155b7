// SPDX-License-Identifier: MIT
// test_commands LQGEN BASE.toml: `lqgen new`, `lqgen check` and `lqgen run`.
#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <unity.h>

#include "program.hpp"

namespace fs = std::filesystem;

namespace {

enum Status { written = 0, impossible = 1, wrong = 2, unreadable = 3 };

std::string lqgen, base;
fs::path folder;  // of the test that runs, with base.toml

Outcome run_lqgen(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), lqgen);
  return run(arguments, folder);
}

// Standard error is this line, and the folder is as it was.
void expect_refusal(Status status, const std::string& line, const std::vector<std::string>& arguments) {
  const Snapshot before = snapshot(folder);
  const Outcome outcome = run_lqgen(arguments);
  TEST_ASSERT_EQUAL_INT_MESSAGE(status, outcome.status, outcome.err.c_str());
  TEST_ASSERT_EQUAL_STRING((line + "\n").c_str(), outcome.err.c_str());
  TEST_ASSERT_TRUE_MESSAGE(before == snapshot(folder), "files were touched");
}

// The first word of each line that begins with two blanks.
std::vector<std::string> listed_starters() {
  std::vector<std::string> names;
  std::istringstream lines(run_lqgen({"new"}).out);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("  ", 0) == 0) names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

void test_new_alone_lists_what_there_is() {
  const Outcome outcome = run_lqgen({"new"});
  TEST_ASSERT_EQUAL_INT(written, outcome.status);
  for (const char* starter : {"  servo ", "  balancing ", "  temperature ", "  estimator ", "  regulator "})
    TEST_ASSERT_TRUE_MESSAGE(outcome.out.find(starter) != std::string::npos, starter);
  TEST_ASSERT_TRUE(outcome.out.find("angle of a DC motor") != std::string::npos);
}

void test_what_every_starter_writes_designs_at_once() {
  for (const std::string& starter : listed_starters()) {
    TEST_ASSERT_EQUAL_INT(written, run_lqgen({"new", "mine", "--from", starter, "-o", starter}).status);
    const std::string file = starter + "/mine.toml";
    TEST_ASSERT_TRUE(read_file(folder / file).find("\"mine\"") != std::string::npos);
    const Outcome outcome = run_lqgen({"check", file, "--quiet"});
    TEST_ASSERT_EQUAL_INT_MESSAGE(written, outcome.status, (starter + ": " + outcome.err).c_str());
    TEST_ASSERT_EQUAL_STRING("", outcome.err.c_str());
    TEST_ASSERT_EQUAL_UINT(1, snapshot(folder / starter).size());
  }
}

void test_new_is_the_shipped_design_but_for_its_name() {
  run_lqgen({"new", "servo", "--from", "servo"});
  const std::string servo = read_file(folder / "servo.toml");
  run_lqgen({"new", "arm", "--from", "servo"});
  std::string arm = read_file(folder / "arm.toml");
  const std::size_t at = arm.find("\"arm\"");
  TEST_ASSERT_TRUE(at != std::string::npos);
  TEST_ASSERT_EQUAL_STRING(servo.c_str(), arm.replace(at, 5, "\"servo\"").c_str());
}

// A line for each order; the last one is LQG. Limits have no place there.
void test_orders_prints_what_each_state_is_worth_and_writes_nothing() {
  std::string text = read_file(folder / "base.toml");
  text.erase(text.find("[limits]"), text.find("[code]") - text.find("[limits]"));
  write_file(folder / "free.toml", text);
  const Snapshot before = snapshot(folder);
  const Outcome outcome = run_lqgen({"--orders", "free.toml"});
  TEST_ASSERT_EQUAL_INT_MESSAGE(written, outcome.status, outcome.err.c_str());
  TEST_ASSERT_TRUE(before == snapshot(folder));
  std::istringstream lines(outcome.out);
  std::string line, last;
  TEST_ASSERT_TRUE(std::getline(lines, line) && line.rfind("order cost a sample    above full", 0) == 0);
  double least = 1e300;
  for (int order = 1; std::getline(lines, line); ++order) {
    int found = 0;
    double cost = 0;
    TEST_ASSERT_TRUE(sscanf(line.c_str(), "%d %lf", &found, &cost) == 2 && found == order && cost < least);
    least = cost, last = line;
  }
  TEST_ASSERT_TRUE_MESSAGE(last.rfind("    4", 0) == 0 && last.find(" 0.00 %") != last.npos, last.c_str());
  expect_refusal(impossible,
                 "base.toml:33:1: limits: does not go together with [compensator]: it does not hear of the "
                 "input that was applied",
                 {"--orders", "base.toml"});
}

void test_new_never_writes_over_a_file() {
  expect_refusal(
      unreadable,
      "./base.toml: expected a file that is not there yet, found one; choose another name, or another folder "
      "with -o",
      {"new", "base", "--from", "servo"});
}

void test_new_where_nothing_can_be_written() {
  write_file(folder / "file", "");
  expect_refusal(unreadable, "file: Not a directory", {"new", "mine", "--from", "servo", "-o", "file"});
}

void test_new_refuses_what_no_header_can_be_called() {
  expect_refusal(wrong, "lqgen new: name: expected a name that is no keyword of C or C++, found \"while\"",
                 {"new", "while", "--from", "servo"});
}

const char* const with_parameters = R"(name = "p"
[parameters]
m = { value = 2, unit = "kg" }
k = "4*m"
[plant]
domain = "continuous"
sample_time = 0.01
A = [[0, 1], ["-k/m", 0]]
B = [[0], ["1/m"]]
[lqr]
Q = [1, 1]
R = [1]
)";

void test_set_replaces_the_value_of_a_parameter_and_says_so() {
  write_file(folder / "p.toml", with_parameters);
  TEST_ASSERT_EQUAL_INT(written, run_lqgen({"--set", "m=3", "p.toml", "--set", "k=m/2", "--quiet"}).status);
  const std::string json = read_file(folder / "p.json"), header = read_file(folder / "p.h");
  TEST_ASSERT_TRUE(json.find(R"("m": {
      "value": 3.0,
      "unit": "kg",
      "is_set": true
    })") != json.npos);
  TEST_ASSERT_TRUE(json.find(R"("k": {
      "value": 1.5,
      "expression": "m/2",
      "is_set": true
    })") != json.npos);
  TEST_ASSERT_TRUE(json.find(R"("plant.A[1][0]": {
      "value": -0.5,
      "expression": "-k/m"
    })") != json.npos);
  TEST_ASSERT_TRUE_MESSAGE(header.find(" *   m  3.0 kg  set on the command line\n"
                                       " *   k  1.5     set on the command line, = m/2\n") != header.npos,
                           header.substr(0, 1500).c_str());
  for (const char* command : {"check", "simulate"})
    TEST_ASSERT_EQUAL_INT(written, run_lqgen({command, "p.toml", "--set", "m=3", "--quiet"}).status);
}

void test_long_expression_is_cut_in_the_header_alone() {
  std::string sum = "1";
  for (int i = 0; i < 200; ++i) sum += "+0*m";
  std::string text = with_parameters;
  text.replace(text.find("4*m"), 3, sum);
  write_file(folder / "p.toml", text);
  TEST_ASSERT_EQUAL_INT(written, run_lqgen({"p.toml", "--quiet"}).status);
  TEST_ASSERT_TRUE(read_file(folder / "p.json").find(sum) != std::string::npos);
  std::istringstream header(read_file(folder / "p.h"));
  for (std::string line; std::getline(header, line);) TEST_ASSERT_TRUE_MESSAGE(line.size() < 200, line.c_str());
}

void test_setting_that_is_wrong_is_refused() {
  write_file(folder / "p.toml", with_parameters);
  expect_refusal(wrong, "p.toml:2:1: parameters: --set: expected the name of a parameter, found \"mm\"",
                 {"p.toml", "--set", "mm=3"});
  expect_refusal(wrong, "p.toml:3:15: parameters.m: --set: 1/0 is no finite number",
                 {"check", "p.toml", "--set", "m=1/0"});
  const Outcome outcome = run_lqgen({"p.toml", "--set", "m"});
  TEST_ASSERT_EQUAL_INT(wrong, outcome.status);
  TEST_ASSERT_TRUE(outcome.err.find("--set: expected NAME=VALUE, found \"m\"") != std::string::npos);
}

void test_new_says_which_starter_may_be_meant() {
  expect_refusal(wrong, "lqgen new: unknown starter `srevo`, did you mean `servo`?", {"new", "a", "--from", "srevo"});
  expect_refusal(wrong, "lqgen new: unknown starter `xyz`; lqgen new lists them", {"new", "a", "--from", "xyz"});
  expect_refusal(wrong, "lqgen new: expected the name of the design, found none: lqgen new NAME --from servo",
                 {"new", "--from", "servo"});
}

void test_misspelt_options_of_a_command_are_explained() {
  expect_refusal(wrong, "lqgen: unknown option `--form`, did you mean `--from`?", {"new", "a", "--form=servo"});
}

void test_check_says_what_lqgen_says_and_writes_nothing() {
  const Snapshot before = snapshot(folder);
  const Outcome outcome = run_lqgen({"check", "base.toml"});
  TEST_ASSERT_EQUAL_INT(written, outcome.status);
  TEST_ASSERT_EQUAL_STRING("", outcome.out.c_str());
  TEST_ASSERT_TRUE(before == snapshot(folder));
  const Outcome made = run_lqgen({"base.toml", "-o", "out"});
  TEST_ASSERT_EQUAL_STRING(made.err.c_str(), outcome.err.c_str());
}

void test_check_refuses_what_lqgen_refuses() {
  write_file(folder / "bad.toml", "name = \"bad\"\n");
  const Outcome outcome = run_lqgen({"check", "bad.toml"}), made = run_lqgen({"bad.toml"});
  TEST_ASSERT_EQUAL_INT(wrong, outcome.status);
  TEST_ASSERT_EQUAL_STRING(made.err.c_str(), outcome.err.c_str());
  TEST_ASSERT_EQUAL_INT(unreadable, run_lqgen({"check", "none.toml"}).status);
}

void test_check_as_json_has_findings_with_their_places_and_the_design() {
  const Outcome good = run_lqgen({"check", "--json", "base.toml"});
  TEST_ASSERT_EQUAL_INT(written, good.status);
  TEST_ASSERT_EQUAL_UINT(0, good.out.find("{\n  \"status\": 0,\n  \"findings\": [],\n  \"design\": {"));
  run_lqgen({"base.toml", "--only", "json", "-o", "out"});
  const std::string K = read_file(folder / "out/base.json");
  const std::size_t begin = K.find("\"stack\": ");
  TEST_ASSERT_TRUE(good.out.find(K.substr(begin, K.find('\n', begin) - begin)) != std::string::npos);
  std::string text = base;
  write_file(folder / "bad.toml", text.replace(text.find("sample_time = 0.5"), 17, "sample_time = 0"));
  const Outcome bad = run_lqgen({"check", "--json", "bad.toml"});
  TEST_ASSERT_EQUAL_INT(wrong, bad.status);
  TEST_ASSERT_TRUE(bad.out.find("\"severity\": \"error\",\n      \"line\": 6,\n      \"column\": 15,\n      \"key\": "
                                "\"plant.sample_time\"") != std::string::npos);
  TEST_ASSERT_TRUE(bad.out.find("\"status\": 2") != std::string::npos);
  TEST_ASSERT_TRUE(bad.out.find("\"design\": null") != std::string::npos);
}

// `lqgen run` with these lines as its standard input; the file's name stands for the design's.
Outcome run_lines(const std::string& lines, const std::string& design = "base.toml") {
  write_file(folder / "lines", lines);
  return run({"/bin/sh", "-c", "exec '" + lqgen + "' run --quiet \"$0\" < lines", design}, folder);
}

void test_run_answers_each_line_and_begins_anew_when_told() {
  const Outcome outcome = run_lines("0.5 0\n0.25,0.1\nreset\n0.5 0\n");
  TEST_ASSERT_EQUAL_INT_MESSAGE(written, outcome.status, outcome.err.c_str());
  TEST_ASSERT_EQUAL_STRING("", outcome.err.c_str());
  std::istringstream answers(outcome.out);
  std::vector<std::string> lines;
  for (std::string line; std::getline(answers, line);) lines.push_back(line);
  TEST_ASSERT_EQUAL_UINT(3, lines.size());
  TEST_ASSERT_EQUAL_STRING(lines[0].c_str(), lines[2].c_str());
  TEST_ASSERT_TRUE(lines[0] != lines[1]);
}

void test_run_ends_at_a_line_that_is_wrong() {
  const Outcome outcome = run_lines("0.5 0\n0.5 volt\n0.5 0\n");
  TEST_ASSERT_EQUAL_INT(wrong, outcome.status);
  TEST_ASSERT_EQUAL_UINT(1, std::count(outcome.out.begin(), outcome.out.end(), '\n'));
  TEST_ASSERT_EQUAL_STRING("standard input: line 2: expected 2 numbers (y), or reset, found \"volt\"\n",
                           outcome.err.c_str());
}

void test_run_refuses_what_lqgen_refuses_and_a_design_on_standard_input() {
  write_file(folder / "bad.toml", "name = \"bad\"\n");
  TEST_ASSERT_EQUAL_STRING(run_lqgen({"bad.toml"}).err.c_str(), run_lines("1\n", "bad.toml").err.c_str());
  expect_refusal(wrong, "lqgen run: expected the path of a design file, found -: standard input has the samples",
                 {"run", "-"});
}

void test_a_command_has_to_have_its_design() {
  TEST_ASSERT_EQUAL_INT(wrong, run_lqgen({"check"}).status);
  TEST_ASSERT_EQUAL_INT(wrong, run_lqgen({}).status);
}

void test_a_design_file_may_be_called_like_a_command() {
  write_file(folder / "check", base);
  TEST_ASSERT_EQUAL_INT(written, run_lqgen({"./check", "-o", "out"}).status);
}

}  // namespace

void setUp() {
  folder = fresh_folder("commands");
  write_file(folder / "base.toml", base);
}
void tearDown() {}

int main(int, char** arguments) {
  lqgen = fs::absolute(arguments[1]);
  base = read_file(arguments[2]);
  UNITY_BEGIN();
  RUN_TEST(test_new_alone_lists_what_there_is);
  RUN_TEST(test_what_every_starter_writes_designs_at_once);
  RUN_TEST(test_new_is_the_shipped_design_but_for_its_name);
  RUN_TEST(test_orders_prints_what_each_state_is_worth_and_writes_nothing);
  RUN_TEST(test_new_never_writes_over_a_file);
  RUN_TEST(test_new_where_nothing_can_be_written);
  RUN_TEST(test_new_refuses_what_no_header_can_be_called);
  RUN_TEST(test_new_says_which_starter_may_be_meant);
  RUN_TEST(test_set_replaces_the_value_of_a_parameter_and_says_so);
  RUN_TEST(test_setting_that_is_wrong_is_refused);
  RUN_TEST(test_long_expression_is_cut_in_the_header_alone);
  RUN_TEST(test_misspelt_options_of_a_command_are_explained);
  RUN_TEST(test_check_says_what_lqgen_says_and_writes_nothing);
  RUN_TEST(test_check_refuses_what_lqgen_refuses);
  RUN_TEST(test_check_as_json_has_findings_with_their_places_and_the_design);
  RUN_TEST(test_run_answers_each_line_and_begins_anew_when_told);
  RUN_TEST(test_run_ends_at_a_line_that_is_wrong);
  RUN_TEST(test_run_refuses_what_lqgen_refuses_and_a_design_on_standard_input);
  RUN_TEST(test_a_command_has_to_have_its_design);
  RUN_TEST(test_a_design_file_may_be_called_like_a_command);
  return UNITY_END();
}
