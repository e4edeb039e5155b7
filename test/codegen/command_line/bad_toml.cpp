// SPDX-License-Identifier: MIT
#include "bad_designs.hpp"

namespace {

std::string repeated(int count, const std::string& text) {
  std::string result;
  for (int i = 0; i < count; ++i) result += text;
  return result;
}

std::string utf16(const std::string& text) {
  std::string result = "\xFF\xFE";
  for (const char c : text) result += {c, '\0'};
  return result;
}

}  // namespace

std::vector<BadDesign> not_toml() {
  return {
      {"empty file",
       {{0, ""}},
       {"1:1: name: missing", "1:1: plant: missing", "1:1: lqr: expected [lqr], [kalman] or both, found neither"}},
      {"six bytes that abort toml++ 3.3.0", {{0, "[ = 1"}}, {"1:3: not TOML: …"}},
      {"MATLAB's column",
       {{8, "B = [0; 1; 0; 0]"}},
       {"8:…: not TOML: expected a matrix as an array of rows, [[1, 2], [3, 4]], found MATLAB's notation"}},
      {"MATLAB's row", {{17, "Q = [1 0 1 0]"}}, {"17:…: not TOML: …found MATLAB's notation"}},
      {"fraction",
       {{6, "sample_time = 1/200"}},
       {"6:…: not TOML: expected numbers, found arithmetic: it stands in quotes, \"2*pi*50\""}},
      {"number with a unit", {{6, "sample_time = 5 ms"}}, {"6:…: not TOML: expected a number without a unit; …"}},
      {"header without a name", {{4, "[]"}}, {"4:2: not TOML: table header: …"}},
      {"header that is not closed", {{4, "[plant"}}, {"4:7: not TOML: table header: …"}},
      {"string that is not closed", {{1, "name = \"base"}}, {"1:…: not TOML: string: …"}},
      {"key without a value", {{6, "sample_time ="}}, {"6:14: not TOML: …"}},
      {"value without a key", {{6, "= 0.5"}}, {"6:1: not TOML: …"}},
      {"line that says nothing", {{6, "sample_time"}}, {"6:12: not TOML: …"}},
      {"two keys on a line", {{6, "sample_time = 0.5 sample_time = 1"}}, {"6:19: not TOML: …"}},
      {"array that is not closed", {{8, "B = [[0], [1], [0], [0]"}}, {"…: not TOML: array: …"}},
      {"arrays without commas", {{8, "B = [[0] [1] [0] [0]]"}}, {"8:10: not TOML: array: …"}},
      {"Python's word for true", {{6, "sample_time = True"}}, {"6:…: not TOML: …"}},
      {"number with a decimal comma", {{6, "sample_time = 0,5"}}, {"6:16: not TOML: …"}},
      {"number that no double holds",
       {{6, "sample_time = 1e400"}},
       {"6:…: not TOML: floating-point: '1e400' is not …"}},
      {"number that no double tells from 0",
       {{6, "sample_time = 1e-400"}},
       {"6:…: not TOML: floating-point: '1e-400' …"}},
      {"integer of 30 digits",
       {{41, "flash = 123456789012345678901234567890"}},
       {"41:…: not TOML: decimal integer: …"}},
      {"key given twice", {{6, "sample_time = 0.5\nsample_time = 1"}}, {"7:…: not TOML: …cannot redefine existing …"}},
      {"table given twice", {{16, "[plant]"}}, {"16:1: not TOML: …cannot redefine existing table 'plant'"}},
      {"table in the place of a key", {{1, "name.first = 1\nname = \"base\""}}, {"2:…: not TOML: …cannot redefine …"}},
      {"hundred thousand brackets",
       {{7, "A = " + repeated(100000, "[")}},
       {"7:37: not TOML: …maximum nested value depth…"}},
      {"key of a hundred thousand parts",
       {{1, repeated(100000, "a.") + "b = 1"}},
       {"1:16: expected a key of at most 8 parts"}},
      {"five megabytes", {{3, repeated(5000, "#" + repeated(1000, " ") + "\n")}}, {" expected at most 4 MiB"}},
      {"NUL byte",
       {{2, std::string("brief = \"a\0b\"", 13)}},
       {"2:11: expected text, found the control character U+0000"}},
      {"escape sequence of a terminal",
       {{3, "# \x1B[31m"}},
       {"3:3: expected text, found the control character U+001B"}},
      {"Latin-1", {{2, "brief = \"caf\xE9\""}}, {"2:13: expected UTF-8, found the byte 0xE9"}},
      {"UTF-16", {{0, utf16("a = 1")}}, {"1:1: expected UTF-8, found the byte 0xFF"}},
      {"minus sign of a text processor", {{34, "u_min = [−1]"}}, {"34:10: expected ASCII … found `−` (U+2212)"}},
      {"quotes of a text processor", {{1, "name = “base”"}}, {"1:8: expected ASCII … found `“` (U+201C)"}},
      {"space that does not break, twice",
       {{6, "sample_time =\u00A00.5"}, {18, "R =\u00A0[1]"}},
       {"6:14: expected ASCII … (U+00A0)", "18:4: expected ASCII … (U+00A0)"}},
      {"letter beyond ASCII in a key", {{6, "sample_timé = 0.5"}}, {"6:11: expected ASCII … found `é` (U+00E9)"}},
      {"string in a number", {{6, "sample_time = 1\"s\""}}, {"6:16: expected a number, found a string right after …"}},
  };
}
