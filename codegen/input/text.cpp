// SPDX-License-Identifier: MIT
#include "input/text.hpp"

#include <cstdio>
#include <cstring>

namespace lqg::input {
namespace {

constexpr std::size_t shown_characters = 60;
constexpr int most_key_parts = 8;

// Bytes of the character that `first` begins, 0 if none can begin so; `code` gets the bits it holds.
std::size_t sequence_length(unsigned char first, char32_t& code) {
  if (first < 0x80) return code = first, 1;
  if (first >= 0xC2 && first < 0xE0) return code = first & 0x1Fu, 2;
  if (first >= 0xE0 && first < 0xF0) return code = first & 0x0Fu, 3;
  if (first >= 0xF0 && first < 0xF5) return code = first & 0x07u, 4;
  return 0;
}

bool is_scalar_value(char32_t code, std::size_t length) {
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  return !surrogate && !overlong && code <= 0x10FFFF;
}

std::string hexadecimal(const char* pattern, char32_t code) {
  char buffer[16];
  std::snprintf(buffer, sizeof buffer, pattern, static_cast<unsigned>(code));
  return buffer;
}

bool is_one_of(char c, const char* characters) { return c != 0 && std::strchr(characters, c) != nullptr; }

// What the scanner is inside of. TOML itself is the parser's business; this tells strings and comments from
// the rest.
enum class Inside { plain, comment, text, lines };

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::vector<Fault> scan() {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;  // a byte order mark
    while (at_ < text_.size()) {
      const Character character = decode(text_, at_);
      judge(character);
      advance(character);
    }
    return faults_;
  }

 private:
  void fault(const std::string& message) {
    if (faults_.empty() || faults_.back().where.line != where_.line) faults_.push_back({where_, message});
  }

  void judge(const Character& character) {
    const char32_t code = character.code;
    if (character.length == 0)
      fault("expected UTF-8, found the byte " + hexadecimal("0x%02X", static_cast<unsigned char>(text_[at_])));
    else if ((code < 0x20 && code != '\t' && code != '\n' && code != '\r') || code == 0x7F)
      fault("expected text, found the control character " + hexadecimal("U+%04X", code));
    else if (code >= 0x80 && (inside_ == Inside::plain || inside_ == Inside::lines))
      fault("expected ASCII outside comments and strings of one line, found `" +
            printable(text_.substr(at_, character.length)) + "` (" + hexadecimal("U+%04X", code) + ")");
    else if (inside_ == Inside::plain)
      count_key_parts(static_cast<char>(code));
  }

  // Dots of `a.b.c`; those of the numbers in an array stand between commas.
  void count_key_parts(char c) {
    if (c == '.' && ++dots_ == most_key_parts)
      fault("expected a key of at most " + std::to_string(most_key_parts) + " parts");
    if (is_one_of(c, "\n=,[]{}")) dots_ = 0;
  }

  void advance(const Character& character) {
    const char c = text_[at_];
    std::size_t length = character.length == 0 ? 1 : character.length;
    switch (inside_) {
      case Inside::plain: length = leave_plain(c, length); break;
      case Inside::comment:
        if (c == '\n') inside_ = Inside::plain;
        break;
      case Inside::text: length = leave_text(c, length); break;
      case Inside::lines: length = leave_lines(c, length); break;
    }
    if (c == '\n') where_ = {where_.line + 1, 0};
    where_.column += length == character.length ? 1 : static_cast<int>(length);
    at_ += length;
  }

  std::size_t leave_plain(char c, std::size_t length) {
    if (c == '#') inside_ = Inside::comment;
    if (c != '"' && c != '\'') return note_number(c), length;
    if (in_number_) fault("expected a number, found a string right after its digits");
    delimiter_ = c;
    const bool three = delimiters_at(at_) >= 3;
    inside_ = three ? Inside::lines : Inside::text;
    return three ? 3 : 1;
  }

  // The parser looks ahead from a number's first character to its end, through strings as well.
  void note_number(char c) {
    const bool number = (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
    if (is_one_of(c, " \t\r\n,]}#"))
      in_number_ = false;
    else if (number && starts_value_)
      in_number_ = true;
    starts_value_ = is_one_of(c, " \t\r\n,]}=[{");
  }

  // An unterminated string ends with its line: the parser stops there.
  std::size_t leave_text(char c, std::size_t length) {
    if (c == delimiter_ || c == '\n') inside_ = Inside::plain;
    return escapes(c) ? 2 : length;
  }

  std::size_t leave_lines(char c, std::size_t length) {
    if (escapes(c)) return 2;
    if (c != delimiter_) return length;
    const std::size_t count = delimiters_at(at_);
    if (count >= 3) inside_ = Inside::plain;
    return count < 5 ? count : 5;  // the last two belong to the string
  }

  // A backslash and the ASCII character after it, unless that ends the line.
  bool escapes(char c) const {
    return c == '\\' && delimiter_ == '"' && at_ + 1 < text_.size() && text_[at_ + 1] >= 0x20 && text_[at_ + 1] < 0x7F;
  }

  std::size_t delimiters_at(std::size_t from) const {
    std::size_t count = 0;
    while (from + count < text_.size() && text_[from + count] == delimiter_) ++count;
    return count;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Location where_{1, 1};
  Inside inside_ = Inside::plain;
  char delimiter_ = '"';
  int dots_ = 0;
  bool starts_value_ = true;
  bool in_number_ = false;
  std::vector<Fault> faults_;
};

}  // namespace

Character decode(std::string_view text, std::size_t at) {
  char32_t code = 0;
  const std::size_t length = sequence_length(static_cast<unsigned char>(text[at]), code);
  if (length == 0 || at + length > text.size()) return {};
  for (std::size_t i = 1; i < length; ++i) {
    const auto byte = static_cast<unsigned char>(text[at + i]);
    if ((byte & 0xC0u) != 0x80u) return {};
    code = code << 6 | (byte & 0x3Fu);
  }
  return is_scalar_value(code, length) ? Character{code, length} : Character{};
}

bool is_control(char32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x061C || (code >= 0x200E && code <= 0x200F) ||
         (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const Character character = decode(text, at);
    if (character.length == 0)
      result += hexadecimal("\\x%02X", static_cast<unsigned char>(text[at]));
    else if (is_control(character.code))
      result += hexadecimal("\\u%04X", character.code);
    else
      result += text.substr(at, character.length);
    at += character.length == 0 ? 1 : character.length;
  }
  return result;
}

std::string in_quotes(std::string_view text) {
  std::size_t at = 0;
  for (std::size_t count = 0; at < text.size() && count < shown_characters; ++count) {
    const std::size_t length = decode(text, at).length;
    at += length == 0 ? 1 : length;
  }
  return "\"" + printable(text.substr(0, at)) + (at < text.size() ? "…\"" : "\"");
}

std::string on_one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const bool is_blank = c == ' ' || c == '\t' || c == '\n' || c == '\r';
    if (!is_blank) line += c;
    if (is_blank && !line.empty() && line.back() != ' ') line += ' ';
  }
  if (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::vector<Fault> check_text(std::string_view text) { return Scanner(text).scan(); }

}  // namespace lqg::input
