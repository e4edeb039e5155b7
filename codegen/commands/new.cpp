// SPDX-License-Identifier: MIT
#include "commands/new.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <regex>

#include "commands/starters.hpp"
#include "input/keys.hpp"
#include "input/names.hpp"

namespace lqg::commands {

namespace {

// The first line `key = "…"` of a text: the prefix up to the quote, what is quoted, and the rest of the text.
bool find_line(const std::string& text, const char* key, std::smatch& found) {
  return std::regex_search(text, found, std::regex("(^|\n)" + std::string(key) + "( *= *\")([^\"]*)"));
}

std::string brief_of(const Starter& starter) {
  std::smatch found;
  return find_line(starter.text, "brief", found) ? found.str(3) : "";
}

const Starter* find_starter(const std::string& name) {
  const std::vector<Starter>& all = starters();
  const auto at = std::find_if(all.begin(), all.end(), [&](const Starter& starter) { return starter.name == name; });
  return at == all.end() ? nullptr : &*at;
}

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string because(const std::string& path) { return path + ": " + std::strerror(errno); }

}  // namespace

std::string list_of_starters() {
  std::size_t width = 0;
  for (const Starter& starter : starters()) width = std::max(width, starter.name.size());
  std::string out;
  for (const Starter& starter : starters())
    out += "  " + starter.name + std::string(width + 2 - starter.name.size(), ' ') + brief_of(starter) + "\n";
  return out;
}

std::optional<std::string> text_of_starter(const std::string& starter, const std::string& name) {
  const Starter* const found = find_starter(starter);
  std::smatch line;
  if (found == nullptr || !find_line(found->text, "name", line)) return std::nullopt;
  std::string text = found->text;
  return text.replace(static_cast<std::size_t>(line.position(3)), static_cast<std::size_t>(line.length(3)), name);
}

std::string nearest_starter(const std::string& word) {
  std::vector<std::string> names;
  for (const Starter& starter : starters()) names.push_back(starter.name);
  return input::nearest_word(names, word);
}

std::optional<std::string> refuse_name(const std::string& name) { return input::check_design_name(name); }

std::optional<std::string> write_new(const std::string& folder, const std::string& name, const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(folder) / (name + ".toml");
  std::error_code failure;
  std::filesystem::create_directories(path.parent_path().empty() ? "." : path.parent_path(), failure);
  if (failure) return folder + ": " + failure.message();

  std::unique_ptr<std::FILE, Closer> file(std::fopen(path.c_str(), "wx"));
  if (!file && errno == EEXIST)
    return path.string() +
           ": expected a file that is not there yet, found one; choose another name, or another folder "
           "with -o";
  if (!file) return because(path.string());
  const bool is_whole = std::fwrite(text.data(), 1, text.size(), file.get()) == text.size();
  if (is_whole && std::fclose(file.release()) == 0) return std::nullopt;
  const std::string why = because(path.string());
  file.reset();
  std::filesystem::remove(path, failure);
  return why;
}

}  // namespace lqg::commands
