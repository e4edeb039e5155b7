// SPDX-License-Identifier: MIT
#include "input/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

// Uses std::numeric_limits without including it.
#define CSV_IO_NO_THREAD
#include <csv.h>

#include "input/text.hpp"

namespace lqg::input {
namespace {

using Reader = io::CSVReader<1, io::trim_chars<' ', '\t'>, io::double_quote_escape<',', '"'>, io::throw_on_overflow,
                             io::single_and_empty_line_comment<'#'>>;

struct NotANumber {
  unsigned line;
  std::string field;
};

double number_of(const std::string& field, unsigned line) {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const char* const begin = field.data() + (field[0] == '+');
  const char* const end = field.data() + field.size();
  const auto result = std::from_chars(begin, end, value);
  if (result.ec != std::errc() || result.ptr != end) throw NotANumber{line, field};
  return value;
}

// Throws what the reader does, and NotANumber.
std::vector<double> read_column(const std::string& path, const std::string& name) {
  Reader reader(path);
  reader.read_header(io::ignore_extra_column | io::ignore_missing_column, name);
  std::vector<double> values;
  if (!reader.has_column(name)) return values;
  for (char* field = nullptr; reader.read_row(field);) values.push_back(number_of(field, reader.get_file_line()));
  return values;
}

bool is_one_of(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::variant<Columns, std::string> read_columns(const std::string& path, const std::vector<std::string>& names,
                                                const std::vector<std::string>& optional) {
  Columns columns;
  try {
    for (const std::string& name : names) {
      columns.values.push_back(read_column(path, name));
      if (columns.values.back().empty() && !is_one_of(optional, name))
        return path + ": expected a column " + in_quotes(name) + " with numbers, found none";
    }
  } catch (const NotANumber& wrong) {
    return path + ":" + std::to_string(wrong.line) + ": expected a number, found " + in_quotes(wrong.field);
  } catch (const io::error::can_not_open_file&) {
    return path + ": cannot be read";
  } catch (const io::error::with_file_line& error) {
    const int line = error.file_line;
    return path + ":" + std::to_string(line) + ": expected as many fields, separated by commas, as the header has";
  } catch (const io::error::base& error) {
    error.format_error_message();
    return path + ": not a table of numbers separated by commas: " + error.error_message_buffer;
  }
  return columns;
}

}  // namespace lqg::input
