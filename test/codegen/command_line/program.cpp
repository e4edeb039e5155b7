// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace {

constexpr int could_not_start = 126;

void redirect(int stream, const fs::path& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0 || ::dup2(file, stream) < 0) ::_exit(could_not_start);
}

[[noreturn]] void become(const std::vector<std::string>& command, const fs::path& folder, const fs::path& log,
                         std::optional<unsigned long> largest_file) {
  redirect(STDOUT_FILENO, log.string() + ".out");
  redirect(STDERR_FILENO, log.string() + ".err");
  if (::chdir(folder.c_str()) != 0) ::_exit(could_not_start);
  if (largest_file) {
    const struct rlimit limit = {*largest_file, *largest_file};
    std::signal(SIGXFSZ, SIG_IGN);  // the write fails instead
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(could_not_start);
  }
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  ::execv(arguments[0], arguments.data());
  ::_exit(could_not_start);
}

}  // namespace

Outcome run(const std::vector<std::string>& command, const fs::path& folder,
            std::optional<unsigned long> largest_file) {
  const fs::path log = fs::absolute(folder).string() + "_log";
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child == 0) become(command, folder, log, largest_file);
  int state = 0;
  if (::waitpid(child, &state, 0) != child) throw std::runtime_error("waitpid failed");
  const int status = WIFSIGNALED(state) ? 128 + WTERMSIG(state) : WEXITSTATUS(state);
  return {status, read_file(log.string() + ".out"), read_file(log.string() + ".err")};
}

std::string read_file(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + path.string());
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}

void write_file(const fs::path& path, const std::string& content) {
  std::ofstream stream(path, std::ios::binary);
  stream << content;
  if (!stream.flush()) throw std::runtime_error("cannot write " + path.string());
}

Snapshot snapshot(const fs::path& folder) {
  Snapshot files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const std::string content = entry.is_regular_file() ? read_file(entry.path()) : "";
    files[entry.path().lexically_relative(folder).string()] = {content, entry.last_write_time()};
  }
  return files;
}

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::absolute(name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

void write_old_outputs(const fs::path& folder, const std::string& name) {
  fs::create_directories(folder);
  for (const char* end : {".h", "_test.c", ".json", ".html"}) {
    const fs::path file = folder / (name + end);
    write_file(file, "an earlier " + file.filename().string() + "\n");
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(24));
  }
}
