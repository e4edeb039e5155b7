// SPDX-License-Identifier: MIT
// Emitted files, compiled and run.
#pragma once

#include "../compiler.hpp"
#include "emit/controller.hpp"

namespace lqg_test {

enum class Language { c, cxx };

// A way in which a controller can be emitted.
struct Way {
  lqg::design::Style style;
  lqg::controller::Sharing sharing;
  const char* suffix;  // of a name
};
std::vector<Way> ways_of(const lqg::emit::Controller& controller);

// Writes NAME.h and NAME_test.c of both styles, compiles them and runs the test; fails with what went wrong.
void expect_emitted_to_pass(lqg::emit::Controller controller, const std::vector<Language>& languages);

// The options of the compiler for the header of a controller: include folders, the library's variant.
std::string options(const lqg::emit::Controller& controller, const std::filesystem::path& folder);

// What the library's archive of the controller's variant is.
std::string library(const lqg::emit::Controller& controller);

// Compiles `program`, which includes NAME.h, and runs it: its output.
std::string run_with_header(const lqg::emit::Controller& controller, const std::string& program);
// Likewise with the headers of several, all for the same variant of the library.
std::string run_with_headers(const std::vector<lqg::emit::Controller>& controllers, const std::string& program);

}  // namespace lqg_test
