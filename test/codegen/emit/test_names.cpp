// SPDX-License-Identifier: MIT
// No two things that a header defines have one name, and none has that of a type or a header that the firmware may
// know: whatever the design and its signals are called.
#include <map>
#include <regex>
#include <set>

#include <unity.h>

#include "../compiler.hpp"
#include "design/solve.hpp"
#include "emit/c/header.hpp"
#include "emit/plan/plan.hpp"
#include "emit/text/text.hpp"
#include "input/design_file.hpp"

using namespace lqg;
using namespace lqg_test;

namespace {

using Names = std::multiset<std::string>;
using Values = std::map<std::string, std::string>;

// A loop of two states, two outputs and one input; each {key} is to be filled.
const std::string loop = R"(name = "{name}"
[plant]
domain = "discrete"
sample_time = 0.1
A = [[1, 0.1], [0, 0.9]]
B = [[0], [0.1]]
C = [[1, 0], [0, 1]]
{delay}
states = ["{state}", "speed"]
inputs = ["{input}"]
outputs = ["{output}", "rate"]
[lqr]
Q = [1, 1]
R = [1]
{law}
[kalman]
process_noise = [1e-4, 1e-3]
measurement_noise = [1e-2, 1e-2]
{filter}
{more}
[code]
style = "{style}"
{code}
)";

const Values plain_names = {{"name", "loop"},      {"state", "place"}, {"input", "force"}, {"output", "y"},
                            {"delay", ""},         {"law", ""},        {"filter", ""},     {"more", ""},
                            {"style", "unrolled"}, {"code", ""}};

const std::string limits = "[limits]\nu_min = [-1]\nu_max = [1]\nu_rate = [3]";
const std::string stage = "[[stage]]\nfrom = 3\nA = [[1, 0.1], [0, 0.8]]";

// What brings other macros, arrays, members and functions into the header.
const std::vector<Values> variants = {
    {},
    {{"style", "compact"}, {"more", limits}},
    {{"style", "compact"}, {"more", limits}, {"law", "integral = { outputs = [0], Q = [1] }"}, {"filter", "gate = 4"}},
    {{"law", "track = [0]"}, {"more", limits}, {"delay", "delay = 0.2"}},
    {{"style", "compact"}, {"filter", "gain = \"online\"\ninitial_state = [1, 0]"}, {"more", stage}},
    {{"filter", "gain = \"online\"\ncovariance = \"plain\"\ngate = 5"}},
    {{"style", "compact"}, {"filter", "gain = \"online\"\ncovariance = \"plain\""}},
    {{"filter", "gain = \"schedule\"\nhorizon = 5"}},
    {{"style", "compact"}, {"filter", "gain = \"schedule\"\nhorizon = 5"}, {"law", "horizon = 5"}},
    {{"law", "horizon = 5"}, {"filter", "form = \"predictor\""}},
    {{"code", "realisation = \"folded\""}},
    {{"code", "realisation = \"modal\""}, {"filter", "form = \"predictor\""}},
};

input::DesignFile parsed(Values values) {
  values.insert(plain_names.begin(), plain_names.end());
  return input::parse_design(emit::fill(loop, values));
}

bool is_refused(const Values& values) { return !parsed(values).problem; }

std::string header_of(const Values& values) {
  const input::DesignFile file = parsed(values);
  design::Findings findings = file.findings;
  if (!file.problem) TEST_FAIL_MESSAGE(findings.front().message.c_str());
  std::optional<design::Solution> solution = design::solve(*file.problem, findings);
  if (!solution) TEST_FAIL_MESSAGE(findings.back().message.c_str());
  const auto controller = emit::make_controller(*file.problem, *std::move(solution), {"names.toml", "0"}, findings);
  if (!controller) TEST_FAIL_MESSAGE(findings.back().message.c_str());
  return emit::header(*controller);
}

void collect(const std::string& text, const char* pattern, Names& names) {
  const std::regex regex(pattern);
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at) names.insert((*at)[1]);
}

// Macros, enumerators, constants, types and functions.
Names defined_names(const std::string& header) {
  Names names;
  collect(header, "\n#define (\\w+)", names);
  collect(header, "\n    ([A-Z][A-Z0-9_a-z]*) = \\d+", names);
  collect(header, "\nstatic const \\w+ (\\w+)", names);
  collect(header, "\n\\} (\\w+);", names);
  collect(header, "\nstatic [^\\n=;(]*?(\\w+)\\(", names);
  return names;
}

void expect_no_doubles(const std::string& header, const std::string& what) {
  const Names names = defined_names(header);
  TEST_ASSERT_TRUE_MESSAGE(names.size() > 10, "the names were not found");
  for (const std::string& name : names)
    if (names.count(name) > 1) TEST_FAIL_MESSAGE((name + " is defined twice: " + what).c_str());
}

const char* const kinds[] = {"state", "input", "output"};
const char* const letters[] = {"X", "U", "Y"};

// Behind "LOOP_X_" and so on: what a signal could be called to have the name of something else.
std::set<std::string> rivals(const std::string& letter) {
  std::set<std::string> found;
  for (const Values& variant : variants)
    for (const std::string& name : defined_names(header_of(variant)))
      for (const std::string& prefix : {"LOOP_" + letter + "_", std::string("loop_update_"), std::string("LOOP_R_")})
        if (name.rfind(prefix, 0) == 0) found.insert(name.substr(prefix.size()));
  return found;
}

void test_no_two_things_of_a_header_have_one_name() {
  for (const Values& variant : variants)
    expect_no_doubles(header_of(variant), variant.empty() ? "" : variant.begin()->second);
}

void test_a_signal_never_gets_the_name_of_something_else() {
  for (int k = 0; k < 3; ++k)
    for (const std::string& rival : rivals(letters[k]))
      for (Values variant : variants) {
        variant[kinds[k]] = rival;
        if (!is_refused(variant)) expect_no_doubles(header_of(variant), kinds[k] + std::string(" ") + rival);
      }
}

void test_a_state_is_not_called_bounds_whatever_its_capitals() {
  for (const char* name : {"bounds", "Bounds", "BOUNDS"}) TEST_ASSERT_TRUE(is_refused({{"state", name}}));
  TEST_ASSERT_FALSE(is_refused({{"input", "bounds"}, {"output", "bounds"}}));
}

void test_an_input_or_output_is_not_called_like_a_limit_of_another_one() {
  for (const char* name : {"min_rate", "MAX_RATE", "Step_rate"}) TEST_ASSERT_TRUE(is_refused({{"output", name}}));
  for (const char* name : {"min_y", "max_force", "minimum_rate"}) TEST_ASSERT_FALSE(is_refused({{"output", name}}));
  TEST_ASSERT_FALSE(is_refused({{"state", "min_speed"}}));
}

void test_a_state_of_the_name_of_a_delayed_input_stays_apart_from_it() {
  for (const char* name : {"force_delayed_1", "FORCE_DELAYED_1", "Force_delayed_2", "force_delayed_1_samples"})
    expect_no_doubles(header_of({{"state", name}, {"delay", "delay = 0.2"}}), name);
}

// Those of C, and of POSIX.
const char* const standard_headers[] = {
    "assert",   "complex", "ctype",    "errno",   "fenv",   "float",       "inttypes", "iso646",
    "limits",   "locale",  "math",     "setjmp",  "signal", "stdalign",    "stdarg",   "stdatomic",
    "stdbool",  "stddef",  "stdint",   "stdio",   "stdlib", "stdnoreturn", "string",   "tgmath",
    "threads",  "time",    "uchar",    "wchar",   "wctype", "aio",         "cpio",     "dirent",
    "dlfcn",    "fcntl",   "fmtmsg",   "fnmatch", "ftw",    "glob",        "grp",      "iconv",
    "langinfo", "libgen",  "monetary", "mqueue",  "ndbm",   "netdb",       "nl_types", "poll",
    "pthread",  "pwd",     "regex",    "sched",   "search", "semaphore",   "spawn",    "strings",
    "syslog",   "tar",     "termios",  "ulimit",  "unistd", "utime",       "utmpx",    "wordexp"};

void test_no_design_is_called_as_a_header_of_c_posix_or_unity() {
  for (const char* name : standard_headers) TEST_ASSERT_TRUE_MESSAGE(is_refused({{"name", name}}), name);
  for (const char* name : {"unity", "unity_config", "unity_internals", "atomic"})
    TEST_ASSERT_TRUE_MESSAGE(is_refused({{"name", name}}), name);
}

// Of the compilers at hand: whatever NAME their headers have a NAME_t of.
void test_no_design_has_the_type_of_a_standard_header() {
  const std::filesystem::path folder = empty_folder("types");
  std::string text;
  for (const char* header : standard_headers)
    if (std::string(header) != "ndbm")  // of a library of its own
      text += std::string("#if __has_include(<") + header + ".h>)\n#include <" + header + ".h>\n#endif\n";
  write(folder / "all.c",
        text + "#include <sys/types.h>\n#include <sys/stat.h>\n#include <sys/time.h>\n#include <sys/wait.h>\n");
  const Outcome outcome = run(LQG_C_COMPILER " -D_GNU_SOURCE -E -P " + (folder / "all.c").string());
  TEST_ASSERT_TRUE_MESSAGE(outcome.succeeded, outcome.output.substr(0, 2000).c_str());
  Names types;
  collect(outcome.output, "\\b([a-z][a-z0-9_]{0,30})_t\\b", types);
  TEST_ASSERT_TRUE_MESSAGE(types.count("size") && types.count("pthread"), "the types were not found");
  for (const std::string& name : std::set<std::string>(types.begin(), types.end()))
    TEST_ASSERT_TRUE_MESSAGE(is_refused({{"name", name}}), name.c_str());
}

void test_ordinary_names_are_free() {
  for (const char* name : {"two_mass", "bounds", "step", "x", "u", "y", "r", "p", "ap", "gain", "shared", "self",
                           "work", "test", "main", "a_"})
    TEST_ASSERT_FALSE_MESSAGE(is_refused({{"name", name}}), name);
}

// Names that are those of variables and arguments inside of the functions, and of the test.
void test_a_short_name_compiles_as_c_and_cxx() {
  const std::filesystem::path folder = empty_folder("short");
  for (const char* name : {"x", "u", "p", "self", "gain", "test", "main"})
    for (const char* style : {"unrolled", "compact"}) {
      const std::string path = (folder / (std::string(name) + ".h")).string();
      write(path, header_of({{"name", name}, {"style", style}, {"filter", "gain = \"online\""}}));
      for (const std::string& compiler : {as_c, as_cxx}) {
        write(folder / "alone.c", "#include \"" + std::string(name) + ".h\"\n");
        const Outcome outcome =
            run(compiler + " -fsyntax-only -I" LQG_INCLUDE_FOLDER " " + (folder / "alone.c").string());
        TEST_ASSERT_TRUE_MESSAGE(outcome.succeeded, outcome.output.substr(0, 2000).c_str());
      }
    }
}

// Inside of the functions.

// In the styles and forms that differ in what their functions call.
const std::vector<Values> bodies = {
    {{"filter", "gain = \"online\""}, {"more", limits}},
    {{"filter", "gain = \"online\"\ncovariance = \"plain\""}, {"law", "integral = { outputs = [0], Q = [1] }"}},
    {{"code", "realisation = \"modal\""}, {"filter", "form = \"predictor\""}}};

// Behind all headers of C, whose macros and types have been defined.
void expect_to_compile(const Values& names, const std::filesystem::path& folder) {
  for (Values values : bodies) {
    values.insert(names.begin(), names.end());
    const std::string name = values.count("name") ? values.at("name") : "loop";
    write(folder / (name + ".h"), header_of(values));
    write(folder / "alone.c",
          "#include <sys/types.h>\n#include <errno.h>\n#include <math.h>\n#include <complex.h>\n#include <limits.h>\n"
          "#include <float.h>\n#include <signal.h>\n#include <sys/wait.h>\n#include <sys/stat.h>\n#include \"" +
              name + ".h\"\n");
    for (const std::string& compiler : {as_c, as_cxx}) {
      const Outcome outcome =
          run(compiler + " -D_GNU_SOURCE -fsyntax-only -I" LQG_INCLUDE_FOLDER " " + (folder / "alone.c").string());
      TEST_ASSERT_TRUE_MESSAGE(outcome.succeeded, outcome.output.substr(0, 2000).c_str());
    }
  }
}

// x of speed_rate, and x of speed behind the update by the output rate.
void test_two_states_of_one_identifier_are_told_apart() {
  const Values names = {{"state", "speed_rate"}};
  expect_to_compile(names, empty_folder("one_identifier"));
  Values values = names;
  values["filter"] = "gain = \"online\"";
  const std::string header = header_of(values);
  for (const char* declared : {"const float x_speed_rate = self->x[0];", "const float x_speed_rate_2 = "})
    TEST_ASSERT_TRUE_MESSAGE(header.find(declared) != std::string::npos, declared);
}

void test_signals_may_be_called_as_keywords_macros_types_and_values() {
  const std::filesystem::path folder = empty_folder("words");
  expect_to_compile({{"state", "int"}, {"input", "class"}, {"output", "NAN"}}, folder);
  expect_to_compile({{"state", "I"}, {"input", "errno"}, {"output", "char"}}, folder);
  expect_to_compile({{"state", "part"}, {"input", "int"}, {"output", "r"}}, folder);  // u_int is a type
}

void test_a_value_never_gets_the_name_of_a_function_of_the_design() {
  const std::filesystem::path folder = empty_folder("functions");
  for (const char* name : {"reset", "update_rate", "hear"}) expect_to_compile({{"name", "x"}, {"state", name}}, folder);
  expect_to_compile({{"name", "law"}, {"input", "t"}}, folder);
}

// Of the longest names that a design may have.
void test_no_line_of_a_body_is_too_long_whatever_the_names() {
  const auto longest = [](char c) { return std::string(31, c); };
  for (Values values : bodies) {
    values.insert({{"state", longest('s')}, {"input", longest('i')}, {"output", longest('o')}, {"name", longest('n')}});
    bool is_inside = false;
    std::istringstream lines(header_of(values));
    for (std::string line; std::getline(lines, line);) {
      if (line == "{" || line == "}") is_inside = line == "{";
      if (is_inside && line.find("    const float ") == 0)
        TEST_ASSERT_LESS_OR_EQUAL_INT_MESSAGE(120, static_cast<int>(line.size()), line.c_str());
    }
  }
}

}  // namespace

extern "C" {
void setUp(void) {}
void tearDown(void) {}
}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_no_two_things_of_a_header_have_one_name);
  RUN_TEST(test_a_signal_never_gets_the_name_of_something_else);
  RUN_TEST(test_a_state_is_not_called_bounds_whatever_its_capitals);
  RUN_TEST(test_an_input_or_output_is_not_called_like_a_limit_of_another_one);
  RUN_TEST(test_a_state_of_the_name_of_a_delayed_input_stays_apart_from_it);
  RUN_TEST(test_no_design_is_called_as_a_header_of_c_posix_or_unity);
  RUN_TEST(test_no_design_has_the_type_of_a_standard_header);
  RUN_TEST(test_ordinary_names_are_free);
  RUN_TEST(test_a_short_name_compiles_as_c_and_cxx);
  RUN_TEST(test_two_states_of_one_identifier_are_told_apart);
  RUN_TEST(test_signals_may_be_called_as_keywords_macros_types_and_values);
  RUN_TEST(test_a_value_never_gets_the_name_of_a_function_of_the_design);
  RUN_TEST(test_no_line_of_a_body_is_too_long_whatever_the_names);
  return UNITY_END();
}
