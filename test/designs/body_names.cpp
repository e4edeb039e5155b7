// SPDX-License-Identifier: MIT
// What a reviewer meets between the braces of straight-line code: no value is called by a number of the generator's
// own, and no line is longer than 120 columns. Takes headers, prints what is wrong.
#include <fstream>
#include <iostream>
#include <regex>
#include <string>

namespace {

int columns_of(const std::string& text) {
  int count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return count;
}

// States, inputs, outputs and references have names; entries of matrices, of d and of z have indices.
const std::regex bad_name(
    "shared_\\d+|sum(_\\w)?|others(_\\w)?|nu(_\\w+)?|[tvw]\\d*|result\\w*|(x|u|y|r|xi|law|next|gain)_?\\d+");
const std::regex declaration("^    (?:const )?(?:float|double|int|bool|lqg_status_t) (\\w+) =");

struct Found {
  int names = 0, mistakes = 0;

  void look_at(const std::string& place, const std::string& line) {
    constexpr int longest = 120;
    if (columns_of(line) > longest) report(place, "a line of " + std::to_string(columns_of(line)) + " columns");
    std::smatch name;
    if (!std::regex_search(line, name, declaration)) return;
    ++names;
    if (std::regex_match(name.str(1), bad_name)) report(place, name.str(1) + " does not say what it is");
  }

 private:
  void report(const std::string& place, const std::string& what) {
    std::cerr << place << ": " << what << '\n';
    ++mistakes;
  }
};

void read_bodies(const std::string& path, Found& found) {
  std::ifstream file(path);
  bool is_inside = false;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line == "{" || line == "}") is_inside = line == "{";
    if (is_inside) found.look_at(path + ":" + std::to_string(number), line);
  }
}

}  // namespace

int main(int count, char** paths) {
  Found found;
  for (int i = 1; i < count; ++i) read_bodies(paths[i], found);
  constexpr int expected = 30;  // names of a header, at least
  std::cout << found.names << " names in " << count - 1 << " headers\n";
  return found.mistakes > 0 || found.names < expected * (count - 1);
}
