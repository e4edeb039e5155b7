// SPDX-License-Identifier: MIT
// Numbers of every size in every key: a controller whose numbers are numbers of its target, or a refusal that names a
// key.
#include <regex>
#include <stdexcept>

#include <unity.h>

#include "design/solve.hpp"
#include "emit/c/header.hpp"
#include "emit/plan/plan.hpp"
#include "emit/report/json.hpp"
#include "emit/report/report.hpp"
#include "emit/text/text.hpp"
#include "emit/unit_test/unit_test.hpp"
#include "input/design_file.hpp"

namespace {

using namespace lqg;

// A loop with all that has a size; each {key} is a number.
const std::string loop = R"(name = "sizes"
[plant]
domain = "discrete"
sample_time = {time}
A = [[1, {coupling}], [0, 0.9]]
B = [[0], [{push}]]
C = [[{shown}, 0]]
[lqr]
Q = [{state}, {state}]
R = [{effort}]
{law}
[kalman]
process_noise = [1e-4, {drift}]
measurement_noise = [{noise}]
initial_state = [{start}, 0]
gain = "{gain}"
gate = {gate}
[limits]
u_min = [{low}]
u_max = [{high}]
u_rate = [{rate}]
[code]
real = "{real}"
style = "{style}"
)";

using Values = std::map<std::string, std::string>;
const Values ordinary = {
    {"time", "0.1"}, {"coupling", "0.1"}, {"push", "0.1"},   {"shown", "1"},    {"state", "1"},       {"effort", "1"},
    {"law", ""},     {"drift", "1e-3"},   {"noise", "1e-2"}, {"start", "0.5"},  {"gain", "steady"},   {"gate", "4"},
    {"low", "-10"},  {"high", "10"},      {"rate", "100"},   {"real", "float"}, {"style", "unrolled"}};

struct Result {
  std::optional<emit::Controller> controller;
  design::Findings findings;
  input::DesignFile file;
};

Result designed(Values values) {
  values.insert(ordinary.begin(), ordinary.end());
  Result result;
  result.file = input::parse_design(emit::fill(loop, values));
  result.findings = result.file.findings;
  if (!result.file.problem) return result;
  std::optional<design::Solution> solution = design::solve(*result.file.problem, result.findings);
  if (!solution || design::has_error(result.findings)) return result;
  result.controller =
      emit::make_controller(*result.file.problem, *std::move(solution), {"sizes.toml", "0"}, result.findings);
  return result;
}

void expect_no_literal_of_infinity(const std::string& text, const std::string& what) {
  static const std::regex infinite("[^A-Za-z_0-9](inf|nan)[^A-Za-z_]");
  std::smatch found;
  if (std::regex_search(text, found, infinite)) TEST_FAIL_MESSAGE((what + ": " + found.str()).c_str());
}

// Refused under a key, or in print: never a literal that C does not have.
void expect_numbers_or_a_refusal(const Values& values, const std::string& what) {
  const Result result = designed(values);
  if (!result.controller) {
    TEST_ASSERT_TRUE_MESSAGE(design::has_error(result.findings), what.c_str());
    return;
  }
  try {
    for (const std::string& text : {emit::header(*result.controller), emit::unit_test(*result.controller)})
      expect_no_literal_of_infinity(text, what);
    (void)emit::json(*result.controller);
    (void)emit::report(*result.controller);
  } catch (const std::range_error&) {  // lqgen says so and writes nothing
  }
}

void test_no_size_of_a_number_becomes_a_literal_that_c_does_not_have() {
  const char* const keys[] = {"time",  "coupling", "push",  "shown", "state", "effort",
                              "drift", "noise",    "start", "gate",  "high",  "rate"};
  const char* const sizes[] = {"1e-300", "1e-46", "1e-25", "1e25", "1e39", "1e300"};
  int turn = 0;
  for (const char* key : keys)
    for (const char* size : sizes)
      for (const char* real : {"float", "double"}) {
        const char* const style = turn % 2 ? "compact" : "unrolled";
        const char* const gain = turn++ % 3 ? "steady" : "schedule";
        expect_numbers_or_a_refusal({{key, size}, {"real", real}, {"style", style}, {"gain", gain}},
                                    std::string(key) + " = " + size + ", " + real + ", " + style + ", " + gain);
      }
}

void test_no_gain_of_an_integral_or_a_reference_becomes_such_a_literal() {
  for (const char* law : {"integral = { outputs = [0], Q = [{weight}] }", "track = [0]"})
    for (const char* weight : {"1e-80", "1e-60", "1e60", "1e80"})
      for (const char* shown : {"1e-30", "1", "1e30"})
        expect_numbers_or_a_refusal({{"law", emit::fill(law, {{"weight", weight}})}, {"shown", shown}, {"gate", "0"}},
                                    std::string(law) + weight + ", " + shown);
}

// The finding under `key`, which stands in the file at its line.
void expect_finding(design::Severity severity, const std::string& key, const Values& values) {
  const Result result = designed(values);
  TEST_ASSERT_EQUAL(severity == design::Severity::error, !result.controller);
  if (const auto& emitted = result.controller)
    expect_no_literal_of_infinity(emit::header(*emitted) + emit::unit_test(*emitted), key);
  for (const design::Finding& finding : result.findings)
    if (finding.severity == severity && finding.key == key) {
      TEST_ASSERT_TRUE(input::locate(result.file, key).line > 1);
      return;
    }
  TEST_FAIL_MESSAGE(
      ("nothing is said of " + key + ", " + values.begin()->first + " = " + values.begin()->second).c_str());
}

void test_what_overflows_or_must_not_vanish_is_refused_at_its_line() {
  const auto refused = [](const char* key, const Values& values) {
    expect_finding(design::Severity::error, key, values);
  };
  for (const char* time : {"1e39", "1e-46"}) refused("plant.sample_time", {{"time", time}, {"rate", "inf"}});
  for (const char* gate : {"1e300", "1e39", "1e20", "1e-30", "1e-46"}) refused("kalman.gate", {{"gate", gate}});
  for (const char* gate : {"1e300", "1e-300"}) refused("kalman.gate", {{"gate", gate}, {"real", "double"}});
  refused("limits.u_max[0]", {{"low", "-1e-46"}, {"high", "1e-46"}});
  refused("limits.u_max[0]", {{"low", "1e39"}, {"high", "1e40"}});
  refused("limits.u_max[0]", {{"low", "-1e40"}, {"high", "-1e39"}});
  refused("limits.u_min[0]", {{"low", "1e39"}, {"high", "inf"}});
  refused("limits.u_max[0]", {{"low", "1.00000001"}, {"high", "1.00000002"}});
  refused("limits.u_rate[0]", {{"rate", "1e-50"}});
  refused("limits.u_rate[0]", {{"rate", "1e-300"}, {"time", "1e-30"}, {"real", "double"}});
}

void test_what_is_clipped_or_becomes_0_is_noted_at_its_line() {
  const auto noted = [](const char* key, const Values& values) { expect_finding(design::Severity::note, key, values); };
  noted("limits.u_max[0]", {{"high", "1e39"}});
  noted("limits.u_min[0]", {{"low", "-1e39"}});
  noted("limits.u_max[0]", {{"high", "1e-46"}});
  noted("limits.u_min[0]", {{"low", "-1e-46"}});
  noted("limits.u_rate[0]", {{"rate", "1e60"}});
  noted("limits.u_rate[0]", {{"rate", "1.7e308"}, {"time", "100"}, {"real", "double"}});
  noted("kalman.initial_state[0]", {{"start", "1e-46"}});
}

void test_ordinary_numbers_and_infinite_limits_are_not_worth_a_word() {
  for (const char* rate : {"100", "inf"}) {
    const Result result = designed({{"rate", rate}, {"low", "-inf"}});
    TEST_ASSERT_TRUE(result.controller.has_value());
    for (const design::Finding& finding : result.findings)
      TEST_ASSERT_TRUE_MESSAGE(finding.key.rfind("limits", 0) != 0, finding.message.c_str());
    expect_no_literal_of_infinity(emit::header(*result.controller), rate);
  }
}

}  // namespace

extern "C" {
void setUp(void) {}
void tearDown(void) {}
}

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_no_size_of_a_number_becomes_a_literal_that_c_does_not_have);
  RUN_TEST(test_no_gain_of_an_integral_or_a_reference_becomes_such_a_literal);
  RUN_TEST(test_what_overflows_or_must_not_vanish_is_refused_at_its_line);
  RUN_TEST(test_what_is_clipped_or_becomes_0_is_noted_at_its_line);
  RUN_TEST(test_ordinary_numbers_and_infinite_limits_are_not_worth_a_word);
  return UNITY_END();
}
