// SPDX-License-Identifier: MIT
#include "emit/text/columns.hpp"

#include <algorithm>

#include "trace/print.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

std::string blanks(std::size_t count) { return std::string(count, ' '); }

bool begins(const std::string& line, std::size_t at, const char* text) { return line.compare(at, 2, text, 2) == 0; }

// Words of a comment on several lines; those after the first begin with `head`.
std::string break_comment(const std::string& line, std::size_t indent, const std::string& head) {
  std::string out, current;
  std::size_t at = indent;
  while (at < line.size()) {
    const std::size_t end = std::min(line.find(' ', at + 1), line.size());  // a word with the blank before it
    const std::string word = line.substr(at, end - at);
    if (columns(blanks(indent) + current + word) > widest_line && !current.empty()) {
      out += blanks(indent) + current + "\n";
      current = head + word.substr(word.find_first_not_of(' ') == std::string::npos ? 0 : word.find_first_not_of(' '));
    } else {
      current += word;
    }
    at = end;
  }
  return out + blanks(indent) + current;
}

// A function and its first parameter may be too long together.
std::string break_behind_bracket(const std::string& line, std::size_t indent) {
  const std::size_t end = line.find('\n'), bracket = line.find('(');
  if (columns(line.substr(0, end)) <= widest_line || bracket == std::string::npos || bracket > end) return line;
  return line.substr(0, bracket + 1) + "\n" + blanks(indent + 4) + line.substr(bracket + 1);
}

std::string fit_line(const std::string& line) {
  if (columns(line) <= widest_line) return line;
  const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
  if (line.back() == '\\') return line;
  if (line.compare(0, 2, " *") == 0) return break_comment(line, 0, " * ");
  if (begins(line, indent, "/*")) return break_comment(line, indent, " * ");
  const std::size_t comment = line.find("  /* ");
  if (comment != std::string::npos)
    return fit_line(blanks(indent) + line.substr(comment + 2)) + "\n" + fit_line(line.substr(0, comment));
  if (line[indent] == '#') return line;
  return break_behind_bracket(trace::wrap(line, static_cast<int>(indent) + 4, static_cast<int>(widest_line)), indent);
}

}  // namespace

std::size_t columns(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string fit_columns(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out += fit_line(text.substr(at, end - at)) + "\n";
    at = end + 1;
  }
  return out;
}

}  // namespace lqg::emit
