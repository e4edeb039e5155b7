// SPDX-License-Identifier: MIT
#include "emitted.hpp"

#include <unity.h>

#include "emit/c/header.hpp"
#include "emit/recorded/shared_covariance.hpp"
#include "emit/recorded/steady_products.hpp"
#include "emit/unit_test/unit_test.hpp"

namespace lqg_test {

namespace {

namespace fs = std::filesystem;

void expect_success(const Outcome& outcome, const std::string& what) {
  if (!outcome.succeeded) TEST_FAIL_MESSAGE((what + ": " + outcome.output.substr(0, 3000)).c_str());
}

void expect_to_pass(const lqg::emit::Controller& controller, Language language, const fs::path& folder) {
  const std::string name = controller.problem.name, program = (folder / "program").string();
  const std::string compiler = language == Language::c ? as_c : as_cxx;
  const std::string sources = (folder / (name + "_test.c")).string() + " " + (folder / "alone.c").string();
  const std::string what = folder.string() + (language == Language::c ? " as C" : " as C++");
  expect_success(run(compiler + " -O1" + options(controller, folder) + " -o " + program + " " + sources + " -x none " +
                     library(controller) + " " LQG_UNITY_LIBRARY " -lm"),
                 what);
  expect_success(run(program), what);
}

}  // namespace

std::vector<Way> ways_of(const lqg::emit::Controller& controller) {
  using lqg::controller::Sharing;
  using lqg::design::Style;
  std::vector<Way> ways = {{Style::unrolled, Sharing::nothing, "_unrolled"}};
  const bool has_loops = !controller.linear && !controller.modal && !lqg::controller::is_extended(controller);
  if (has_loops) ways.push_back({Style::compact, Sharing::nothing, "_compact"});  // those loops are of x̂
  if (has_loops && lqg::emit::can_share_covariance(controller)) {
    ways.push_back({Style::unrolled, Sharing::outputs, "_outputs"});
    if (controller.size.nx > 1) ways.push_back({Style::unrolled, Sharing::columns, "_columns"});
  }
  if (lqg::emit::can_loop_products(controller)) ways.push_back({Style::unrolled, Sharing::products, "_products"});
  return ways;
}

std::string options(const lqg::emit::Controller& controller, const fs::path& folder) {
  std::string out =
      " -I" + folder.string() + " -I" LQG_INCLUDE_FOLDER " -isystem " LQG_UNITY_FOLDER " -DUNITY_INCLUDE_DOUBLE";
  if (controller.style == lqg::design::Style::unrolled && !controller.has.foresight) return out;
  return out + (controller.target.is_double ? " -DLQG_REAL_DOUBLE" : "") +
         (controller.target.is_fused ? " -DLQG_FUSED" : "");
}

std::string library(const lqg::emit::Controller& controller) {
  if (controller.target.is_double) return controller.target.is_fused ? LQG_LIBRARY_DOUBLE_FUSED : LQG_LIBRARY_DOUBLE;
  return controller.target.is_fused ? LQG_LIBRARY_FUSED : LQG_LIBRARY;
}

void expect_emitted_to_pass(lqg::emit::Controller controller, const std::vector<Language>& languages) {
  const std::string name = controller.problem.name;
  for (const auto& [style, sharing, suffix] : ways_of(controller)) {
    controller.style = style;
    controller.sharing = sharing;
    const fs::path folder = empty_folder(name + suffix);
    write(folder / (name + ".h"), lqg::emit::header(controller));
    write(folder / (name + "_test.c"), lqg::emit::unit_test(controller));
    write(folder / "alone.c", "#include \"" + name + ".h\"\n");
    for (const Language language : languages) expect_to_pass(controller, language, folder);
  }
}

std::string run_with_header(const lqg::emit::Controller& controller, const std::string& text) {
  return run_with_headers({controller}, text);
}

std::string run_with_headers(const std::vector<lqg::emit::Controller>& controllers, const std::string& text) {
  const fs::path folder = empty_folder("with_header");
  for (const lqg::emit::Controller& controller : controllers)
    write(folder / (controller.problem.name + ".h"), lqg::emit::header(controller));
  const lqg::emit::Controller& controller = controllers.front();
  write(folder / "program.c", text);
  const std::string program = (folder / "program").string();
  expect_success(
      run(as_c + options(controller, folder) + " -o " + program + " " + program + ".c " + library(controller) + " -lm"),
      "program.c");
  const Outcome outcome = run(program);
  expect_success(outcome, "program");
  return outcome.output;
}

}  // namespace lqg_test
