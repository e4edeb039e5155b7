// SPDX-License-Identifier: MIT
#include "trace/wrap.hpp"

#include <cstring>

namespace lqg::trace {

namespace {

// Columns, not bytes: a continuation byte of UTF-8 takes none.
int columns(const std::string& text, std::size_t from, std::size_t to) {
  int count = 0;
  for (std::size_t i = from; i < to; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) ++count;
  return count;
}

bool breaks_before(const std::string& line, std::size_t i, const char* signs) {
  return line[i] == ' ' && i + 2 < line.size() && line[i - 1] != ' ' && line[i + 2] == ' ' &&
         std::strchr(signs, line[i + 1]);
}

// How well a line breaks at its character i, the more the better; −1: it does not.
int worth_of_break(const std::string& line, std::size_t i) {
  if (breaks_before(line, i, ":") && line.find(" ? ", i) != std::string::npos) return 6;  // of a choice of choices
  if (breaks_before(line, i, "?:")) return 5;
  if (line.compare(i, 4, " && ") == 0 || line.compare(i, 4, " || ") == 0) return 4;
  if (breaks_before(line, i, "+-")) return 3;
  if (line[i] != ' ') return -1;
  if (line[i - 1] == ',') return 2;
  if (breaks_before(line, i, "<*/")) return 1;
  return i > 1 && line[i - 1] == '=' && line[i - 2] == ' ' ? 0 : -1;  // behind the = of an assignment
}

// The last of the best places before `width` where the line may break; the first place behind it if there is none.
std::size_t break_before(const std::string& line, std::size_t start, int width) {
  std::size_t best = std::string::npos;
  int worth = -1;
  for (std::size_t i = start + 1; i < line.size(); ++i) {
    if (worth >= 0 && columns(line, start, i) >= width) break;
    const int found = worth_of_break(line, i);
    if (found < 0 || found < worth) continue;
    best = i;
    worth = found;
  }
  return best;
}

}  // namespace

std::string heading(const std::string& equation) {
  constexpr int width = 117;  // and " */" behind it
  std::string out = "\n    /* ", rest = equation;
  while (columns(rest, 0, rest.size()) > width - 7) {
    std::size_t end = rest.find(' ');
    for (std::size_t i = end; i != std::string::npos && columns(rest, 0, i) <= width - 7; i = rest.find(' ', i + 1))
      end = i;
    if (end == std::string::npos) break;
    out += rest.substr(0, end) + "\n     * ";
    rest = rest.substr(rest.find_first_not_of(' ', end));
  }
  return out + rest + " */\n";
}

std::string wrap(const std::string& line, int indent, int width) {
  std::string out;
  std::size_t start = 0;
  int room = width;
  while (columns(line, start, line.size()) > room) {
    const std::size_t at = break_before(line, start, room);
    if (at == std::string::npos) break;
    out += line.substr(start, at - start) + "\n" + std::string(static_cast<std::size_t>(indent), ' ');
    start = at + 1;
    room = width - indent;
  }
  return out + line.substr(start);
}

}  // namespace lqg::trace
