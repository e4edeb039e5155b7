// SPDX-License-Identifier: MIT
// The C and C++ compilers that CMake uses, for tests of what was printed.
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace lqg_test {

// What all emitted code has to compile with.
inline const std::string warnings =
    " -pedantic -Wall -Wextra -Wconversion -Wshadow -Wdouble-promotion -Werror -ffp-contract=off";
inline const std::string as_c = LQG_C_COMPILER " " LQG_C_FLAGS " -std=c99 -Wmissing-prototypes" + warnings;
inline const std::string as_cxx = LQG_CXX_COMPILER " " LQG_CXX_FLAGS " -std=c++17 -x c++" + warnings;

struct Outcome {
  bool succeeded;
  std::string output;  // standard output and error
};

inline Outcome run(const std::string& command) {
  Outcome outcome{false, ""};
  std::FILE* pipe = ::popen(("LC_ALL=C " + command + " 2>&1").c_str(), "r");
  if (!pipe) return {false, "no shell for " + command};
  char text[4096];
  for (std::size_t count; (count = std::fread(text, 1, sizeof text, pipe)) > 0;) outcome.output.append(text, count);
  outcome.succeeded = ::pclose(pipe) == 0;
  return outcome;
}

inline std::string read(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

// An empty folder below the one in which ctest runs the test.
inline std::filesystem::path empty_folder(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::current_path() / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace lqg_test
