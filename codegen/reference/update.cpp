// SPDX-License-Identifier: MIT
// update_reference FOLDER [--check]: writes what is made from the table of keys into codegen's documents. With --check
// it writes nothing and fails where a document differs.
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "reference/documents.hpp"

namespace {

using namespace lqg;

constexpr char begin_mark[] = ".\\\" keys: begin (cmake --build build --target update_documents)\n";
constexpr char end_mark[] = ".\\\" keys: end\n";

struct Document {
  const char* name;
  std::function<std::string(const std::string&)> made;  // from what it was
};

std::string with_keys(const std::string& manual) {
  const std::size_t begin = manual.find(begin_mark), end = manual.find(end_mark);
  if (begin == manual.npos || end == manual.npos || end < begin)
    throw std::runtime_error("lqgen.1: expected the lines `.\\\" keys: begin…` and `.\\\" keys: end`");
  return manual.substr(0, begin) + begin_mark + reference::manual() + manual.substr(end);
}

const Document documents[] = {
    {"keys.md", [](const std::string&) { return reference::page(); }},
    {"design.schema.json", [](const std::string&) { return reference::schema(); }},
    {"lqgen.1", with_keys},
};

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream out;
  out << file.rdbuf();
  return out.str();
}

bool write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  return static_cast<bool>(file.flush());
}

// The number of the first line that differs.
std::size_t first_difference(const std::string& a, const std::string& b) {
  std::size_t line = 1;
  for (std::size_t i = 0; i < a.size() && i < b.size() && a[i] == b[i]; ++i) line += a[i] == '\n';
  return line;
}

bool update(const std::string& folder, const Document& document, bool only_check) {
  const std::string path = folder + "/" + document.name, old = content(path), made = document.made(old);
  if (made == old) return true;
  if (!only_check && write(path, made)) return true;
  std::cerr << path << ":" << first_difference(old, made)
            << (only_check ? ": expected what codegen/input/key_table.cpp says, found something else; "
                             "cmake --build build --target update_documents brings it up to date\n"
                           : ": could not be written\n");
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3 || (argc == 3 && std::string(argv[2]) != "--check")) {
    std::cerr << "usage: update_reference FOLDER [--check]\n";
    return 2;
  }
  bool good = true;
  try {
    for (const Document& document : documents) good = update(argv[1], document, argc == 3) && good;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return good ? 0 : 1;
}
