// SPDX-License-Identifier: MIT
// Units: what is understood, how it is shown, and which expressions of a design do not go together.
#include <cmath>
#include <string>

#include <unity.h>

#include "expression/unit.hpp"
#include "input/design_file.hpp"

using namespace lqg;
using expression::parse_unit;

namespace {

std::string words_of(const std::string& text) {
  const auto unit = parse_unit(text);
  return unit ? expression::in_words(*unit) : "?";
}

bool are_same(const std::string& a, const std::string& b) {
  const auto first = parse_unit(a), second = parse_unit(b);
  TEST_ASSERT_TRUE_MESSAGE(first && second, (a + ", " + b).c_str());
  return is_same(*first, *second);
}

void test_units_are_written_in_many_ways() {
  for (const char* same : {"kg*m^2/s^2", "kg m²/s²", "kg·m^2·s^-2", "kg m2/s2", "kg m^2 s⁻²", "kg (m/s)^2", "J", "N m",
                           "N*m", "Nm", "W s", "V*A*s", "C V", "Pa m^3", "kg m^2/s/s"})
    TEST_ASSERT_TRUE_MESSAGE(are_same(same, "J"), same);
  TEST_ASSERT_TRUE(are_same("N*m/A", "V*s/rad"));
  TEST_ASSERT_TRUE(are_same("ohm", "Ω") && are_same("ohm", "\u2126") && are_same("V/A", "Ohm"));
  TEST_ASSERT_TRUE(are_same("H/ohm", "s") && are_same("ohm F", "s") && are_same("Wb", "V s") &&
                   are_same("T m^2", "Wb"));
  TEST_ASSERT_TRUE(are_same("rad/s", "1/s") && are_same("Hz", "1/s") && are_same("√Hz", "1/√s") && are_same("-", "1"));
  TEST_ASSERT_TRUE(are_same("", "1") && are_same("m^(0.5)", "√m") && are_same("°C", "K") && are_same("L", "dm^3"));
}

// Sizes by the SI brochure and by definition.
void test_sizes() {
  const std::pair<const char*, double> sizes[] = {{"mm", 1e-3},
                                                  {"µF", 1e-6},
                                                  {"uF", 1e-6},
                                                  {"kohm", 1e3},
                                                  {"min", 60},
                                                  {"h", 3600},
                                                  {"mN", 1e-3},
                                                  {"%", 0.01},
                                                  {"bar", 1e5},
                                                  {"g", 1e-3},
                                                  {"mNm", 1e-3},
                                                  {"km/h", 1 / 3.6},
                                                  {"mm^2", 1e-6},
                                                  {"ms", 1e-3},
                                                  {"Mbar", 1e11},
                                                  {"deg", std::acos(-1.0) / 180},
                                                  {"rpm", std::acos(-1.0) / 30}};
  for (const auto& [text, size] : sizes)
    TEST_ASSERT_TRUE_MESSAGE(std::abs(parse_unit(text)->decades - std::log10(size)) < 1e-12, text);
}

void test_what_is_no_unit_is_not_understood() {
  for (const char* text : {"counts", "10 ms", "m//s", "m/(s", "m^", "m ^2", "kkg", "m^2^2", "m^999", "(", ")", "m)",
                           "2", "mdeg", "°F", "m s s^", "\xc2"})
    TEST_ASSERT_FALSE_MESSAGE(parse_unit(text), text);
  TEST_ASSERT_FALSE(parse_unit(std::string(101, ' ') + "m"));
  TEST_ASSERT_FALSE(parse_unit(std::string(60, '(') + "m"));
}

void test_units_are_shown_as_they_were_written_and_long_ones_in_the_si() {
  TEST_ASSERT_EQUAL_STRING("N·m/A", words_of("N m/A").c_str());
  TEST_ASSERT_EQUAL_STRING("W/(K·m²)", words_of("W/m²/K").c_str());
  TEST_ASSERT_EQUAL_STRING("V/√Hz", words_of("V/√Hz").c_str());
  TEST_ASSERT_EQUAL_STRING("1/s", words_of("N*m/A*V*s/rad/ohm/kg/m^2").c_str());
  TEST_ASSERT_EQUAL_STRING("a pure number", words_of("1").c_str());
  TEST_ASSERT_EQUAL_STRING("rad", words_of("rad").c_str());
}

std::string lines(const std::string& parameters, const std::string& a = "0", const std::string& b = "1",
                  const std::string& more = "") {
  const input::DesignFile file = input::parse_design(
      "name = \"d\"\n[plant]\ndomain = \"continuous\"\nsample_time = 0.01\nstates = [\"p [m]\", \"v [m/s]\"]\n"
      "inputs = [\"force [N]\"]\nA = [[0, 1], [" +
      a + ", 0]]\nB = [[0], [" + b + "]]\n" + more +
      "\n[lqr]\nQ = [1, 1]\nR = [1]\n[parameters]\nm = { value = 2, unit = \"kg\" }\n"
      "k = { value = 8, unit = \"N/m\" }\n"
      "h = { value = 1, unit = \"m\" }\nl = { value = 20, unit = \"mm\" }\nV = { value = 3, unit = \"V\" }\n"
      "a = { value = 3, unit = \"deg\" }\nq = 3\n" +
      parameters);
  std::string text;
  for (const design::Finding& finding : file.findings)
    text += input::format("d", input::locate(file, finding.key), finding) + "\n";
  return text;
}

void test_what_goes_together_is_not_remarked() {
  for (const char* good : {"k/m", "-k/m + 1", "k/m + q", "2*k/m - k/(3*m)", "sqrt(k^2/m^2)", "q", "h*q", "k/m*sin(h/h)",
                           "max(k/m, 0)*cos(atan2(h, 2*h))", "k^2/m^2*m/k", "abs(-k)/m*2^3", "k/m*exp(log(h/h))",
                           "(k/m)^(1/2)*sqrt(k/m)", "9.81*m/h + k/m", "sin(h/h) + k/m", "0.5*V + k/m"})
    TEST_ASSERT_EQUAL_STRING_MESSAGE("", lines("", "\"" + std::string(good) + "\"").c_str(), good);
}

void test_sums_and_functions_of_different_units_are_refused_with_their_place() {
  const std::pair<const char*, const char*> wrong[] = {
      {"m + V", "a sum of kg and V"},
      {"l - h", "a sum of different units, mm and m: convert one to the other"},
      {"min(h, V)", "min of m and V"},
      {"atan2(h, m)", "atan2 of m and kg"},
      {"sin(h)", "sin needs a pure number (or rad), found m"},
      {"cos(a)", "cos needs a pure number (or rad), found deg: convert it"},
      {"2^h", "an exponent is a pure number, found m"},
      {"h^2 + h", "a sum of m² and m"},
      {"1/m + 1/h", "a sum of 1/kg and 1/m"},
      {"m*sin(h/h) - h", "a sum of kg and m"},
      {"sin(h/l)", "sin needs a pure number (or rad), found m/mm: convert it"}};
  for (const auto& [text, message] : wrong) {
    const std::string line = lines("", "\"" + std::string(text) + "\"");
    TEST_ASSERT_TRUE_MESSAGE(line.find(std::string("plant.A[1][0]: ") + message + "\n") != line.npos, line.c_str());
  }
  TEST_ASSERT_EQUAL_STRING("d:7:18: plant.A[1][0]: a sum of kg and V\n", lines("", "\"m + V\"").c_str());
}

void test_entries_have_the_units_of_their_signals() {
  TEST_ASSERT_EQUAL_STRING("", lines("", "\"-k/m\"", "\"1/m\"").c_str());
  TEST_ASSERT_EQUAL_STRING("d:8:12: plant.B[1][0]: expected an expression in m/(N·s²), found one in 1/(kg·m)\n",
                           lines("", "\"-k/m\"", "\"1/(m*h)\"").c_str());
  TEST_ASSERT_EQUAL_STRING(
      "d:9:9: plant.delay: expected an expression in s, found one in m\n"
      "d:11:10: limits.u_max[0]: expected an expression in N, found one in V\n"
      "d:14:16: limits.states.v: expected an expression in m/s, found one in mm/s: convert it\n",
      lines("s = { value = 1, unit = \"s\" }", "0", "1",
            "delay = \"h\"\n[limits]\nu_max = [\"V\"]\nu_min = [-1]\nhorizon = 4\n"
            "states = { v = \"l/s\" }\n")
          .c_str());
}

void test_parameters_have_the_units_that_they_say() {
  TEST_ASSERT_EQUAL_STRING("", lines("w = { value = \"sqrt(k/m)\", unit = \"rad/s\" }").c_str());
  TEST_ASSERT_EQUAL_STRING("d:21:16: parameters.w: expected an expression in m, its unit, found one in N/(kg·m)\n",
                           lines("w = { value = \"k/m\", unit = \"m\" }").c_str());
  TEST_ASSERT_EQUAL_STRING("d:22:8: parameters.t: a sum of kg and N/m\n", lines("w = \"m\"\nt = \"w + k\"").c_str());
}

void test_unit_that_is_not_known_is_noted_once_and_not_judged() {
  TEST_ASSERT_EQUAL_STRING(
      "d:21:25: note: parameters.c.unit: the unit \"counts\" is not known, as \"V*s/rad\" would be: it is shown "
      "and not checked\n",
      lines("c = { value = 1, unit = \"counts\" }\ne = { value = 2, unit = \"counts\" }", "\"c*m + e*V\"").c_str());
}

}  // namespace

int main() {
  UNITY_BEGIN();
  RUN_TEST(test_units_are_written_in_many_ways);
  RUN_TEST(test_sizes);
  RUN_TEST(test_what_is_no_unit_is_not_understood);
  RUN_TEST(test_units_are_shown_as_they_were_written_and_long_ones_in_the_si);
  RUN_TEST(test_what_goes_together_is_not_remarked);
  RUN_TEST(test_sums_and_functions_of_different_units_are_refused_with_their_place);
  RUN_TEST(test_entries_have_the_units_of_their_signals);
  RUN_TEST(test_parameters_have_the_units_that_they_say);
  RUN_TEST(test_unit_that_is_not_known_is_noted_once_and_not_judged);
  return UNITY_END();
}
