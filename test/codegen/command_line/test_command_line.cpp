// SPDX-License-Identifier: MIT
// test_command_line LQGEN BASE.toml DOCUMENTS: options, files that cannot be read, places that cannot be written.
// Whatever fails, what an earlier run has written stays as it was, and nothing half-written is left beside
// it.
#include <sys/stat.h>
#include <unistd.h>

#include <unity.h>

#include "program.hpp"

namespace fs = std::filesystem;

namespace {

enum Status { written = 0, impossible = 1, wrong = 2, unreadable = 3 };

std::string lqgen, base;
fs::path documents_folder;  // with what lqgen prints
fs::path folder;            // of the test that runs, with base.toml and the outputs of an earlier run in out/
Snapshot before;            // of out/

void make_folder() {
  folder = fresh_folder("command_line");
  write_file(folder / "base.toml", base);
  write_old_outputs(folder / "out", "base");
  before = snapshot(folder / "out");
}

Outcome run_lqgen(std::vector<std::string> arguments, std::optional<unsigned long> largest_file = std::nullopt) {
  arguments.insert(arguments.begin(), lqgen);
  return run(arguments, folder, largest_file);
}

bool untouched() { return before == snapshot(folder / "out"); }

void expect_refusal(Status status, const Outcome& outcome) {
  TEST_ASSERT_EQUAL_INT_MESSAGE(status, outcome.status, outcome.err.c_str());
  TEST_ASSERT_TRUE_MESSAGE(outcome.err.size() > 1 && outcome.err.back() == '\n', "no line of its own");
  TEST_ASSERT_TRUE_MESSAGE(untouched(), "outputs were touched");
}

// The same, and standard error says nothing else than `line`.
void expect_line(Status status, const std::string& line, const Outcome& outcome) {
  expect_refusal(status, outcome);
  TEST_ASSERT_EQUAL_STRING((line + "\n").c_str(), outcome.err.c_str());
}

void test_good_design_replaces_the_outputs_and_leaves_nothing_beside_them() {
  const Outcome outcome = run_lqgen({"base.toml", "-o", "out"});
  TEST_ASSERT_EQUAL_INT(written, outcome.status);
  TEST_ASSERT_EQUAL_STRING("", outcome.err.c_str());
  const Snapshot after = snapshot(folder / "out");
  TEST_ASSERT_EQUAL_UINT(before.size(), after.size());
  for (const char* name : {"base.h", "base_test.c", "base.json", "base.html"})
    TEST_ASSERT_TRUE(after.at(name) != before.at(name));
}

void test_outputs_go_into_a_folder_that_is_made() {
  TEST_ASSERT_EQUAL_INT(written, run_lqgen({"base.toml", "-o", "new/folder"}).status);
  TEST_ASSERT_TRUE(fs::is_regular_file(folder / "new/folder/base.h"));
}

void test_only_what_is_asked_for_is_written() {
  TEST_ASSERT_EQUAL_INT(written, run_lqgen({"base.toml", "-o", "new", "--only", "json"}).status);
  TEST_ASSERT_EQUAL_UINT(1, snapshot(folder / "new").size());
}

void test_batch_is_written_beside_the_header_and_only_if_asked_for() {
  TEST_ASSERT_EQUAL_INT(written,
                        run_lqgen({"base.toml", "-o", "new", "--only", "h,batch", "--style", "unrolled"}).status);
  TEST_ASSERT_EQUAL_UINT(2, snapshot(folder / "new").size());
  TEST_ASSERT_TRUE(read_file(folder / "new/base_batch.h").find("base_batch_step(") != std::string::npos);
  const Outcome outcome = run_lqgen({"base.toml", "-o", "out", "--only", "h,batch", "--style", "compact"});
  expect_refusal(impossible, outcome);
  TEST_ASSERT_TRUE(outcome.err.find("base.toml: --only batch: ") != std::string::npos);
  TEST_ASSERT_TRUE(outcome.err.find("--style unrolled") != std::string::npos);
}

void test_quiet_leaves_notes_out_and_errors_in() {
  std::string text = base;
  text.replace(text.find("domain"), text.find("sample_time") - text.find("domain"), "\n");
  write_file(folder / "noted.toml", text);
  const char* note = "noted.toml:4:1: note: plant.domain: missing, taken for \"continuous\"\n";
  TEST_ASSERT_EQUAL_STRING(note, run_lqgen({"noted.toml", "-o", "new"}).err.c_str());
  TEST_ASSERT_EQUAL_STRING("", run_lqgen({"noted.toml", "-o", "new", "--quiet"}).err.c_str());
  write_file(folder / "bad.toml", base + "size = 1\n");
  expect_line(wrong, "bad.toml:42:1: code.size: unknown key", run_lqgen({"bad.toml", "-o", "out", "--quiet"}));
}

void test_command_line_that_is_wrong() {
  expect_refusal(wrong, run_lqgen({}));
  expect_refusal(wrong, run_lqgen({"base.toml", "-o", "out", "--unknown"}));
  expect_refusal(wrong, run_lqgen({"base.toml", "-o"}));
  expect_refusal(wrong, run_lqgen({"base.toml", "base.toml", "-o", "out"}));
  expect_refusal(wrong, run_lqgen({"base.toml", "-o", "out", "--only", "h,exe"}));
  expect_refusal(wrong, run_lqgen({"base.toml", "-o", "out", "--style", "terse"}));
  expect_refusal(wrong, run_lqgen({"base.toml", "-o", "out", "--real", "half"}));
  for (const char* seconds : {"0", "-1", "0.5", "nan", "soon", "1000001"})
    expect_refusal(wrong, run_lqgen({"base.toml", "-o", "out", "--time-limit", seconds}));
}

void test_misspelt_options_are_explained_in_their_order() {
  const Outcome outcome = run_lqgen({"base.toml", "--sytle", "compact", "--quite", "--zzzz"});
  TEST_ASSERT_EQUAL_INT(wrong, outcome.status);
  TEST_ASSERT_EQUAL_STRING(
      "lqgen: unknown option `--sytle`, did you mean `--style`?\n"
      "lqgen: unknown option `--quite`, did you mean `--quiet`?\n"
      "lqgen: unknown option `--zzzz`; lqgen --help lists them\n",
      outcome.err.c_str());
}

// The header is the file's, but for its name.
void test_dash_reads_standard_input() {
  const std::string command = "exec \"$0\" - -o piped --only h --quiet <base.toml";
  TEST_ASSERT_EQUAL_INT(written, run({"/bin/sh", "-c", command, lqgen}, folder).status);
  TEST_ASSERT_EQUAL_INT(written, run_lqgen({"base.toml", "-o", "named", "--only", "h", "--quiet"}).status);
  std::string piped = read_file(folder / "piped/base.h");
  const std::string name = "standard input";
  for (std::size_t at = piped.find(name); at != piped.npos; at = piped.find(name))
    piped.replace(at, name.size(), "base.toml");
  TEST_ASSERT_EQUAL_STRING(read_file(folder / "named/base.h").c_str(), piped.c_str());
  const Outcome bad = run({"/bin/sh", "-c", "echo | exec \"$0\" -", lqgen}, folder);
  TEST_ASSERT_EQUAL_INT(wrong, bad.status);
  TEST_ASSERT_EQUAL_STRING_LEN("standard input:1:1: ", bad.err.c_str(), 20);
}

// The very files that stand beside lqgen's page, so that `lqgen --schema > design.schema.json` gives that one.
void test_keys_and_schema_are_printed_without_a_design() {
  for (const auto& [option, file] : {std::pair("--keys", "keys.md"), std::pair("--schema", "design.schema.json")}) {
    const Outcome outcome = run_lqgen({option});
    TEST_ASSERT_EQUAL_INT(written, outcome.status);
    TEST_ASSERT_EQUAL_STRING(read_file(documents_folder / file).c_str(), outcome.out.c_str());
  }
}

void test_help_and_version_are_no_errors() {
  for (const char* option : {"--help", "--version"}) {
    const Outcome outcome = run_lqgen({option});
    TEST_ASSERT_EQUAL_INT(written, outcome.status);
    TEST_ASSERT_TRUE(!outcome.out.empty() && outcome.err.empty());
  }
}

// Its name stands in comments and in a string of what is emitted.
void test_design_file_whose_name_is_no_text() {
  for (const char* name : {"a\n#error b.toml", "a\".toml", "a\\.toml", "a\xff.toml", "a\tb.toml", "a\x1b[2J.toml",
                           "a\xe2\x80\xae.toml", "a?\?).toml", "\xc0\xaf.toml"}) {
    write_file(folder / name, base);
    const Outcome outcome = run_lqgen({name, "-o", "out"});
    expect_refusal(wrong, outcome);
    TEST_ASSERT_TRUE_MESSAGE(outcome.err.find("file name: expected ") != std::string::npos, outcome.err.c_str());
    TEST_ASSERT_TRUE_MESSAGE(outcome.err.find("; rename it") != std::string::npos, outcome.err.c_str());
    TEST_ASSERT_EQUAL_size_t_MESSAGE(outcome.err.size() - 1, outcome.err.find('\n'), outcome.err.c_str());
  }
}

void test_design_file_whose_name_is_odd_and_whose_folder_is_worse() {
  const fs::path odd = fs::path("a\n\"\xff") / "it's {name} & <b> ?: ä*.toml";
  fs::create_directory(folder / odd.parent_path());
  write_file(folder / odd, base);
  const Outcome outcome = run_lqgen({odd.string(), "-o", "new"});
  TEST_ASSERT_EQUAL_STRING("", outcome.err.c_str());
  for (const char* name : {"base.h", "base_test.c", "base.json"})
    TEST_ASSERT_TRUE_MESSAGE(read_file(folder / "new" / name).find(odd.filename().string()) != std::string::npos, name);
  TEST_ASSERT_TRUE(read_file(folder / "new/base.html").find("it's {name} &amp; &lt;b&gt; ?: ä*.toml") !=
                   std::string::npos);
}

void test_design_that_is_not_there() {
  expect_line(unreadable, "none.toml: cannot be read: No such file or directory",
              run_lqgen({"none.toml", "-o", "out"}));
  expect_line(unreadable, "a\\u000Ab: cannot be read: No such file or directory", run_lqgen({"a\nb", "-o", "out"}));
}

void test_design_that_is_no_regular_file() {
  expect_line(unreadable, "out: cannot be read: it is a folder", run_lqgen({"out", "-o", "out"}));
  expect_line(unreadable, "/dev/zero: cannot be read: it is not a regular file", run_lqgen({"/dev/zero", "-o", "out"}));
  TEST_ASSERT_EQUAL_INT(0, ::mkfifo((folder / "pipe").c_str(), 0600));
  expect_line(unreadable, "pipe: cannot be read: it is not a regular file", run_lqgen({"pipe", "-o", "out"}));
}

void test_design_that_may_not_be_read() {
  if (::geteuid() == 0) TEST_IGNORE_MESSAGE("root may read everything");
  fs::permissions(folder / "base.toml", fs::perms::none);
  expect_line(unreadable, "base.toml: cannot be read: Permission denied", run_lqgen({"base.toml", "-o", "out"}));
}

void test_output_folder_that_is_a_file() {
  write_file(folder / "file", "kept");
  expect_refusal(unreadable, run_lqgen({"base.toml", "-o", "file"}));
  expect_refusal(unreadable, run_lqgen({"base.toml", "-o", "file/below"}));
  TEST_ASSERT_EQUAL_STRING("kept", read_file(folder / "file").c_str());
}

void test_output_folder_that_cannot_be_written() {
  if (fs::exists("/proc/self")) expect_refusal(unreadable, run_lqgen({"base.toml", "-o", "/proc/self"}));
  if (::geteuid() == 0) return;  // root may write everywhere else
  fs::permissions(folder / "out", fs::perms::owner_read | fs::perms::owner_exec);
  const Outcome outcome = run_lqgen({"base.toml", "-o", "out"});
  fs::permissions(folder / "out", fs::perms::owner_all);
  expect_refusal(unreadable, outcome);
}

// A ring of lags: many states, and no delay among them that would make it quick.
std::string long_design() {
  const int states = 240;
  std::string A, B, C, noise;
  for (int i = 0; i < states; ++i) {
    const char* comma = i > 0 ? ", " : "";
    A += std::string(comma) + "[";
    for (int j = 0; j < states; ++j) {
      const int apart = (i - j + states) % states;
      const bool neighbours = apart == 1 || apart == states - 1;
      A += std::string(j > 0 ? ", " : "") + (apart == 0 ? "0.5" : neighbours ? "0.2" : "0");
    }
    A += "]";
    B += std::string(comma) + (i == 0 ? "[1]" : "[0]");
    C += std::string(comma) + (i == 0 ? "1" : "0");
    noise += std::string(comma) + "1";
  }
  return "name = \"base\"\n[plant]\ndomain = \"discrete\"\nsample_time = 1\nA = [" + A + "]\nB = [" + B + "]\n" +
         "C = [[" + C + "]]\n[lqr]\nQ_output = [1]\nR = [1]\n[kalman]\nprocess_noise = [" + noise +
         "]\nmeasurement_noise = [1]\n";
}

// The design would take minutes.
void test_time_limit_ends_with_a_reason_and_touches_nothing() {
  write_file(folder / "long.toml", long_design());
  const Outcome outcome = run_lqgen({"long.toml", "-o", "out", "--time-limit", "1"});
  expect_refusal(impossible, outcome);
  const std::string start = "long.toml: expected the design within 1 s (--time-limit), found it at work: ";
  const std::string end =
      "; nothing was written: allow more time, or make the design smaller (states, delay, horizon)\n";
  TEST_ASSERT_EQUAL_STRING(start.c_str(), outcome.err.substr(0, start.size()).c_str());
  TEST_ASSERT_TRUE_MESSAGE(outcome.err.size() > start.size() + end.size(), outcome.err.c_str());
  TEST_ASSERT_EQUAL_STRING(end.c_str(), outcome.err.substr(outcome.err.size() - end.size()).c_str());
}

void test_time_limit_that_is_not_reached_changes_nothing() {
  TEST_ASSERT_EQUAL_INT(written, run_lqgen({"base.toml", "-o", "new"}).status);
  const Outcome outcome = run_lqgen({"base.toml", "-o", "limited", "--time-limit", "100000"});
  TEST_ASSERT_EQUAL_INT(written, outcome.status);
  TEST_ASSERT_EQUAL_STRING("", outcome.err.c_str());
  for (const char* name : {"base.h", "base_test.c", "base.json", "base.html"})
    TEST_ASSERT_TRUE(read_file(folder / "new" / name) == read_file(folder / "limited" / name));
}

// Found out only when other files have taken their places already.
void test_design_that_an_output_would_overwrite() {
  write_file(folder / "out" / "base.json", base);
  before = snapshot(folder / "out");
  expect_line(wrong,
              "out/base.json: expected a design file that is not one of the outputs; rename it, or choose "
              "another folder with -o",
              run_lqgen({"out/base.json", "-o", "out"}));
}

void test_output_whose_place_a_folder_has() {
  for (const char* name : {"base.h", "base_test.c", "base.json", "base.html"}) {
    make_folder();
    fs::remove(folder / "out" / name);
    fs::create_directories(folder / "out" / name / "full");
    before = snapshot(folder / "out");
    expect_refusal(unreadable, run_lqgen({"base.toml", "-o", "out"}));
  }
}

// One byte short of each file in turn: sooner or later the others have been written already.
void test_write_that_fails_at_the_last_byte_of_a_file() {
  TEST_ASSERT_EQUAL_INT(written, run_lqgen({"base.toml", "-o", "new"}).status);
  for (const char* name : {"base.h", "base_test.c", "base.json", "base.html"}) {
    const unsigned long size = fs::file_size(folder / "new" / name);
    expect_refusal(unreadable, run_lqgen({"base.toml", "-o", "out"}, size - 1));
  }
}

void test_full_disk() {
  fs::create_directory(folder / "full");
  fs::create_directory(folder / "after");
  const int status = run({"/bin/sh", "-c", "unshare -rm mount -t tmpfs none full"}, folder).status;
  if (status != 0) TEST_IGNORE_MESSAGE("no file system can be mounted here");
  const std::string script =
      "mount -t tmpfs -o size=32k none full && cp -p out/* full && \"$0\" base.toml -o full; status=$?; "
      "cp -pR full/. after; exit $status";
  const Outcome outcome = run({"/bin/sh", "-c", "exec unshare -rm sh -c '" + script + "' '" + lqgen + "'"}, folder);
  expect_refusal(unreadable, outcome);
  TEST_ASSERT_TRUE_MESSAGE(outcome.err.find("No space left on device") != std::string::npos, outcome.err.c_str());
  TEST_ASSERT_TRUE_MESSAGE(before == snapshot(folder / "after"), "outputs on the full disk were touched");
}

}  // namespace

extern "C" {
void setUp(void) { make_folder(); }
void tearDown(void) {}
}

int main(int count, char** arguments) {
  if (count != 4) return 2;
  lqgen = fs::absolute(arguments[1]).string();
  base = read_file(arguments[2]);
  documents_folder = arguments[3];
  UNITY_BEGIN();
  RUN_TEST(test_good_design_replaces_the_outputs_and_leaves_nothing_beside_them);
  RUN_TEST(test_outputs_go_into_a_folder_that_is_made);
  RUN_TEST(test_only_what_is_asked_for_is_written);
  RUN_TEST(test_batch_is_written_beside_the_header_and_only_if_asked_for);
  RUN_TEST(test_quiet_leaves_notes_out_and_errors_in);
  RUN_TEST(test_command_line_that_is_wrong);
  RUN_TEST(test_misspelt_options_are_explained_in_their_order);
  RUN_TEST(test_dash_reads_standard_input);
  RUN_TEST(test_keys_and_schema_are_printed_without_a_design);
  RUN_TEST(test_help_and_version_are_no_errors);
  RUN_TEST(test_design_file_whose_name_is_no_text);
  RUN_TEST(test_design_file_whose_name_is_odd_and_whose_folder_is_worse);
  RUN_TEST(test_design_that_is_not_there);
  RUN_TEST(test_design_that_is_no_regular_file);
  RUN_TEST(test_design_that_may_not_be_read);
  RUN_TEST(test_output_folder_that_is_a_file);
  RUN_TEST(test_output_folder_that_cannot_be_written);
  RUN_TEST(test_time_limit_ends_with_a_reason_and_touches_nothing);
  RUN_TEST(test_time_limit_that_is_not_reached_changes_nothing);
  RUN_TEST(test_design_that_an_output_would_overwrite);
  RUN_TEST(test_output_whose_place_a_folder_has);
  RUN_TEST(test_write_that_fails_at_the_last_byte_of_a_file);
  RUN_TEST(test_full_disk);
  return UNITY_END();
}
