// SPDX-License-Identifier: MIT
#include "input/names.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "expression/tree.hpp"
#include "input/text.hpp"

namespace lqg::input {
namespace {

// clang-format off
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

// NAME.h would stand before the header of that name: of C, of POSIX, of what these include, and of Unity, for the test.
constexpr std::string_view headers[] = {
    "aio", "alloca", "assert", "byteswap", "complex", "cpio", "ctype", "devctl", "dirent", "dlfcn",
    "endian", "envlock", "errno", "fcntl", "features", "fenv", "float", "fmtmsg", "fnmatch", "ftw",
    "getopt", "glob", "grp", "iconv", "ieeefp", "inttypes", "iso646", "langinfo", "libgen", "libintl",
    "limits", "locale", "malloc", "math", "memory", "monetary", "mqueue", "ndbm", "netdb", "newlib",
    "nl_types", "picolibc", "poll", "pthread", "pwd", "reent", "regex", "sched", "search", "semaphore",
    "setjmp", "signal", "spawn", "stdalign", "stdarg", "stdatomic", "stdbit", "stdbool", "stdckdint",
    "stddef", "stdfix", "stdint", "stdio", "stdlib", "stdnoreturn", "string", "strings", "stropts",
    "syslimits", "syslog", "tar", "termios", "tgmath", "threads", "time", "trace", "uchar", "ucontext",
    "ulimit", "unistd", "unity", "unity_config", "unity_internals", "utime", "utmpx", "wchar", "wctype",
    "wordexp"};

// NAME_t would be a type of C's, POSIX' or a C library's headers.
constexpr std::string_view types[] = {
    "active_reg", "argp_parser", "atomic_char16", "atomic_char32", "atomic_int_fast16",
    "atomic_int_fast32", "atomic_int_fast64", "atomic_int_fast8", "atomic_int_least16",
    "atomic_int_least32", "atomic_int_least64", "atomic_int_least8", "atomic_intmax", "atomic_intptr",
    "atomic_ptrdiff", "atomic_size", "atomic_uint_fast16", "atomic_uint_fast32", "atomic_uint_fast64",
    "atomic_uint_fast8", "atomic_uint_least16", "atomic_uint_least32", "atomic_uint_least64",
    "atomic_uint_least8", "atomic_uintmax", "atomic_uintptr", "atomic_wchar", "bfloat16", "blkcnt",
    "blkcnt64", "blksize", "caddr", "cc", "char16", "char32", "char8", "clock", "clockid", "cnd", "comp",
    "comparison_fn", "cookie_close_function", "cookie_io_functions", "cookie_read_function",
    "cookie_seek_function", "cookie_write_function", "cpu_set", "daddr", "dev", "div", "double",
    "elf_fpregset", "elf_greg", "elf_gregset", "epoll_data", "errno", "error", "femode", "fenv",
    "fexcept", "fixpt", "float", "float128", "float16", "float32", "float64", "fpos", "fpos64",
    "fpregset", "fsblkcnt", "fsblkcnt64", "fsfilcnt", "fsfilcnt64", "fsid", "gid", "glob", "glob64",
    "greg", "gregset", "iconv", "id", "idtype", "imaxdiv", "in_addr", "in_port", "ino", "ino64", "int128",
    "int16", "int32", "int64", "int8", "int_farptr", "int_fast16", "int_fast32", "int_fast64",
    "int_fast8", "int_least16", "int_least32", "int_least64", "int_least8", "intmax", "intptr", "key",
    "ldiv", "lldiv", "locale", "loff", "lwpid", "max_align", "mbstate", "mcontext", "mode", "mqd",
    "msglen", "msgqnum", "mtx", "nfds", "nlink", "nullptr", "off", "off64", "pid",
    "posix_spawn_file_actions", "posix_spawnattr", "prfpregset", "prgregset", "prpsinfo", "prstatus",
    "psaddr", "pthread", "pthread_attr", "pthread_barrier", "pthread_barrierattr", "pthread_cond",
    "pthread_condattr", "pthread_key", "pthread_mutex", "pthread_mutexattr", "pthread_once",
    "pthread_rwlock", "pthread_rwlockattr", "pthread_spinlock", "ptrdiff", "q15", "q31", "q63", "q7",
    "quad", "re_dfa", "reg_errcode", "reg_syntax", "regex", "register", "regmatch", "regoff", "rlim",
    "rlim64", "rsize", "s_reg", "sa_family", "sbintime", "segsz", "sem", "shmatt", "sig", "sig_atomic",
    "sigevent", "sighandler", "siginfo", "sigset", "sigval", "size", "socklen", "speed", "ssize", "stack",
    "suseconds", "swblk", "tcflag", "td_event_msg", "td_eventbuf", "td_notify", "td_ta_stats",
    "td_thr_events", "td_thragent", "td_thrhandle", "td_thrinfo", "thrd", "thrd_start", "thread",
    "thread_key", "time", "timer", "tss", "tss_dtor", "u_int16", "u_int32", "u_int64", "u_int8", "u_quad",
    "u_register", "ucontext", "uid", "uint128", "uint16", "uint32", "uint64", "uint8", "uint_farptr",
    "uint_fast16", "uint_fast32", "uint_fast64", "uint_fast8", "uint_least16", "uint_least32",
    "uint_least64", "uint_least8", "uintmax", "uintptr", "useconds", "uuid", "wchar", "wctrans", "wctype",
    "wint", "wordexp"};

// NAME_init or NAME_reset would be a function of theirs, where NAME_t is none.
constexpr std::string_view prefixes[] = {
    "atomic", "fanotify", "inotify", "obstack", "res", "wdt"};
// clang-format on

// NAME_X_STATE would be a macro of the header, by the key of the signals; in capitals.
constexpr std::pair<std::string_view, std::string_view> macros[] = {{"plant.states", "BOUNDS"}};

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
    return "expected lower case" + found(name) + "; did you mean " + in_quotes(in_lower_case(name)) + "?";
  if (contains(keywords, name)) return "expected a name that is no keyword of C or C++" + found(name);
  if (contains(headers, name)) return "expected a name that no standard header has" + found(name);
  if (contains(types, name))
    return "expected a name that leaves " + in_quotes(name + "_t") + " to C and POSIX" + found(name);
  if (contains(prefixes, name))
    return "expected a name that leaves " + in_quotes(name + "_…") + " to the functions of C libraries" + found(name);
  if (name == "lqg" || name.rfind("lqg_", 0) == 0)
    return "expected a name that does not begin with the library's prefix lqg_" + found(name);
  return {};
}

Complaint check_parameter_name(const std::string& name) {
  if (const Complaint complaint = check_identifier(name)) return complaint;
  if (name == "pi" || expression::function_of(name))
    return "expected a name that no function has, and not pi" + found(name);
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
      return "expected text that can stand in a C comment, without `" + std::string(sequence) + "`" + found(text);
  return {};
}

Complaint check_file_name(const std::string& name) {
  if (const Complaint complaint = check_comment_text(name)) return "file name: " + *complaint + "; rename it";
  for (const char* sequence : {"\"", "?\?"})
    if (name.find(sequence) != name.npos)
      return "file name: expected one that can stand in a string of C, without `" + std::string(sequence) + "`" +
             found(name) + "; rename it";
  return {};
}

Complaint check_signal_name(const std::string& key, const std::string& name) {
  const std::string capitals = in_capitals(name);
  for (const auto& [of, reserved] : macros)
    if (key == of && capitals == reserved) return "expected a name that the header has no macro of" + found(name);
  return {};
}

Complaint check_limit_name(const std::string& key, const std::string& name,
                           const std::map<std::string, std::size_t>& others) {
  if (key != "plant.inputs" && key != "plant.outputs") return {};
  const std::string capitals = in_capitals(name);
  for (const std::string prefix : {"MIN_", "MAX_", "STEP_"})
    if (capitals.rfind(prefix, 0) == 0 && others.count(capitals.substr(prefix.size())) > 0)
      return "expected a name that is not that of a limit of " + in_quotes(name.substr(prefix.size())) + found(name);
  return {};
}

std::string in_capitals(std::string name) {
  for (char& c : name)
    if (is_lower(c)) c = static_cast<char>(c - 'a' + 'A');
  return name;
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
