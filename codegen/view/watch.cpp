// SPDX-License-Identifier: MIT
#include "view/watch.hpp"

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>

#include "input/design_file.hpp"
#include "input/text.hpp"
#include "serve/server.hpp"
#include "serve/token.hpp"
#include "view/session.hpp"
#include "view/worker.hpp"

namespace lqg::view {

namespace {

enum Exit { ended = 0, wrong = 2, unreadable = 3 };

constexpr std::chrono::milliseconds farewell(200);

void print_findings(const std::string& path, const input::DesignFile& file) {
  for (const design::Finding& finding : file.findings)
    if (finding.severity == design::Severity::error)
      std::cerr << input::format(path, input::locate(file, finding.key), finding) << "\n";
}

// What no change of the file's text can mend.
std::optional<int> refuse_file(const std::string& path) {
  if (path == "-") {
    std::cerr << "lqgen watch: expected the name of a file, found -: standard input cannot be followed\n";
    return wrong;
  }
  const input::DesignFile file = input::read_design_file(path);
  const bool is_text_good =
      !design::has_error(input::parse_design(file.text, std::filesystem::path(path).parent_path()).findings);
  const bool is_name_bad = file.readable && is_text_good && design::has_error(file.findings);
  if (file.readable && !is_name_bad) return std::nullopt;
  print_findings(path, file);
  return is_name_bad ? wrong : unreadable;
}

}  // namespace

int watch(const WatchArguments& arguments) {
  if (const std::optional<int> status = refuse_file(arguments.design_file)) return *status;
  std::optional<serve::Server> server;
  std::optional<Session> session;  // ends before the server, whose connections its answers hold
  try {
    server.emplace(
        arguments.port, serve::random_token(),
        [&](const serve::Request& request, const serve::Answer& answer) { session->answer(request, answer); });
  } catch (const std::runtime_error& error) {
    std::cerr << "lqgen watch: " << input::printable(error.what()) << "\n";
    return unreadable;
  }
  Worker worker([&server](std::function<void()> work) { server->post(std::move(work)); });
  session.emplace(arguments.design_file, worker);
  session->start(*server);
  std::cout << input::printable(arguments.design_file) << ": " << server->address() << "\n";
  if (::isatty(STDOUT_FILENO)) std::cout << "Open this address in a browser at this machine. Ctrl-C ends.\n";
  std::cout << std::flush;
  server->run();
  if (!worker.end(farewell)) ::_exit(ended);  // deep in a design; nothing is being written
  return ended;
}

}  // namespace lqg::view
