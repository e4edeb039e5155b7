// SPDX-License-Identifier: MIT
// Columns of numbers in a file: a header line, then a line for each row, separated by commas.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace lqg::input {

struct Columns {
  std::vector<std::vector<double>> values;  // in the order that was asked for
};

// The columns of these names; others are ignored. An empty field is NaN, a missing value, and so is "nan"; lines that
// begin with # are comments. A column that is not there is an empty one where its name is in `optional`. Or what is
// wrong, with the file's line: "log.csv:7: expected …".
std::variant<Columns, std::string> read_columns(const std::string& path, const std::vector<std::string>& names,
                                                const std::vector<std::string>& optional = {});

}  // namespace lqg::input
