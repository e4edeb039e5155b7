#include "input/names.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "input/text.hpp"

namespace lqg::input {
namespace {

constexpr std::size_t longest_name = 31;  // characters of an external identifier that C99 tells apart

constexpr std::string_view keywords[] = {
    "alignas", "alignof", "and", "and_eq", "asm", "auto", "bitand", "bitor", "bool", "break", "case", "catch",
    "char", "char16_t", "char32_t", "char8_t", "class", "co_await", "co_return", "co_yield", "compl",
    "concept", "const", "const_cast", "consteval", "constexpr", "constinit", "continue", "decltype",
    "default", "delete", "do", "double", "dynamic_cast", "else", "enum", "explicit", "export", "extern",
    "false", "float", "for", "friend", "goto", "if", "inline", "int", "long", "mutable", "namespace", "new",
    "noexcept", "not", "not_eq", "nullptr", "operator", "or", "or_eq", "private", "protected", "public",
    "register", "reinterpret_cast", "requires", "restrict", "return", "short", "signed", "sizeof", "static",
    "static_assert", "static_cast", "struct", "switch", "template", "this", "thread_local", "throw", "true",
    "try", "typedef", "typeid", "typename", "union", "unsigned", "using", "virtual", "void", "volatile",
    "wchar_t", "while", "xor", "xor_eq"};

// NAME.h would stand before the standard's header of that name.
constexpr std::string_view headers[] = {
    "assert", "complex", "ctype", "errno", "fenv", "float", "inttypes", "iso646", "limits", "locale", "math",
    "memory", "setjmp", "signal", "stdarg", "stdbool", "stddef", "stdint", "stdio", "stdlib", "string",
    "strings", "tgmath", "threads", "time", "unistd", "wchar", "wctype"};

// NAME_t would be a type of C's or POSIX' headers.
constexpr std::string_view types[] = {
    "blkcnt", "blksize", "char16", "char32", "char8", "clock", "clockid", "dev", "div", "double", "fenv",
    "fexcept", "float", "fpos", "gid", "id", "imaxdiv", "ino", "int16", "int32", "int64", "int8", "intmax",
    "intptr", "key", "ldiv", "lldiv", "max_align", "mbstate", "mode", "nlink", "off", "pid", "ptrdiff",
    "sig_atomic", "sigset", "size", "ssize", "suseconds", "time", "timer", "uid", "uint16", "uint32",
    "uint64", "uint8", "uintmax", "uintptr", "useconds", "wchar", "wctrans", "wctype", "wint"};

template <std::size_t n>
bool contains(const std::string_view (&list)[n], std::string_view word) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_letter(char c) { return is_lower(c) || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string found(const std::string& text) { return ", found " + in_quotes(text); }

Complaint check_identifier(const std::string& name) {
  const bool good = !name.empty() && is_letter(name[0]) && std::all_of(name.begin(), name.end(), [](char c) {
    return is_letter(c) || is_digit(c) || c == '_';
  });
  if (!good) return "expected a C identifier (letters, digits and _, a letter first)" + found(name);
  if (name.size() > longest_name)
    return "expected at most " + std::to_string(longest_name) + " characters" + found(name);
  return {};
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == text.npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

}  // namespace

Complaint check_design_name(const std::string& name) {
  if (const Complaint complaint = check_identifier(name)) return complaint;
  if (std::any_of(name.begin(), name.end(), [](char c) { return is_letter(c) && !is_lower(c); }))
    return "expected lower case" + found(name);
  if (contains(keywords, name)) return "expected a name that is no keyword of C or C++" + found(name);
  if (contains(headers, name)) return "expected a name that no standard header has" + found(name);
  if (contains(types, name))
    return "expected a name that leaves " + in_quotes(name + "_t") + " to C and POSIX" + found(name);
  if (name == "lqg" || name.rfind("lqg_", 0) == 0)
    return "expected a name that does not begin with the library's prefix lqg_" + found(name);
  return {};
}

Complaint check_comment_text(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const Character character = decode(text, at);
    if (character.length == 0 || is_control(character.code))
      return "expected one line without control characters" + found(text);
    at += character.length;
  }
  for (const char* sequence : {"*/", "/*", "\\", "?\?/"})
    if (text.find(sequence) != text.npos)
      return "expected text that can stand in a C comment, without `" + std::string(sequence) + "`" +
             found(text);
  return {};
}

Complaint check_file_name(const std::string& name) {
  if (const Complaint complaint = check_comment_text(name)) return "file name: " + *complaint + "; rename it";
  for (const char* sequence : {"\"", "?\?"})
    if (name.find(sequence) != name.npos)
      return "file name: expected one that can stand in a string of C, without `" + std::string(sequence) + "`" + found(name) +
             "; rename it";
  return {};
}

Complaint parse_signal(const std::string& text, design::Signal& signal) {
  const std::size_t open = text.find('[');
  signal.name = trimmed(text.substr(0, open));
  if (const Complaint complaint = check_identifier(signal.name)) return complaint;
  if (open == text.npos) return {};
  const std::string rest = trimmed(text.substr(open));
  if (rest.find(']') != rest.size() - 1 || rest.find('[', 1) != rest.npos)
    return "expected a name and one unit in brackets, as in \"dy1 [m]\"" + found(text);
  signal.unit = trimmed(rest.substr(1, rest.size() - 2));
  return check_comment_text(signal.unit);
}

}  // namespace lqg::input
