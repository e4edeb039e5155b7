// SPDX-License-Identifier: MIT
#include "input/matrices.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "input/formulas.hpp"
#include "input/values.hpp"

namespace lqg::input {
namespace {

bool is_array(const Node& node) { return node.kind == Kind::array; }
bool is_number(const Node& node) { return node.kind == Kind::number; }

bool all_of(const Node& node, bool (*predicate)(const Node&)) {
  return std::all_of(node.items.begin(), node.items.end(), predicate);
}

std::string indexed(const std::string& key, std::size_t index) { return key + "[" + std::to_string(index) + "]"; }

// Rows and columns of an array of equally long rows, {−1, −1} of anything else.
std::pair<int, int> shape_of(const Node& node) {
  if (!is_array(node) || node.items.empty() || !all_of(node, is_array)) return {-1, -1};
  const std::size_t columns = node.items[0].items.size();
  for (const Node& row : node.items)
    if (row.items.size() != columns) return {-1, -1};
  if (columns == 0) return {-1, -1};
  return {static_cast<int>(node.items.size()), static_cast<int>(columns)};
}

// One matrix of the file while it is read: what it is called, what is asked of it, where its findings go.
class MatrixReader {
 public:
  MatrixReader(const KeyRule& rule, const std::map<Size, int>& sizes, Report& report)
      : rule_(rule), rows_(sizes.at(rule.rows)), columns_(sizes.at(rule.columns)), report_(report) {}

  std::optional<Eigen::MatrixXd> read(const Node& node) const {
    if (!is_array(node) || node.items.empty()) return fail("found " + describe(node));
    if (is_list()) return read_list(node);
    if (rule_.type == Type::weight && !is_array(node.items[0])) {
      const auto diagonal = read_list(node);
      if (!diagonal || diagonal->rows() > most_signals) return {};
      return Eigen::MatrixXd(diagonal->col(0).asDiagonal());
    }
    if (is_number(node.items[0])) return fail("found an array of numbers");
    return read_rows(node);
  }

 private:
  bool is_list() const {
    return rule_.type == Type::vector || rule_.type == Type::positives || rule_.type == Type::bounds;
  }

  std::nullopt_t fail(const std::string& found) const {
    report_.error(rule_.path, expected() + ", " + found);
    return std::nullopt;
  }

  static std::string sized(int count, Size size, const std::string& noun) {
    if (count <= 0) return (noun == "number" ? "numbers (" : "rows (") + name_of(size) + ")";
    return counted(count, noun) + " (" + name_of(size) + ")";
  }

  std::string expected() const {
    if (is_list()) return "expected an array of " + sized(rows_, rule_.rows, "number");
    const std::string diagonal = rule_.type == Type::weight ? ", or the array of its diagonal" : "";
    return "expected an array of " + sized(rows_, rule_.rows, "row") + " of " +
           sized(columns_, rule_.columns, "number") + diagonal;
  }

  std::optional<Eigen::MatrixXd> read_list(const Node& node) const {
    Eigen::MatrixXd list(node.items.size(), 1);
    if (!read_entries(rule_.path, node, list.data())) return {};
    if (rows_ <= 0 || list.rows() == rows_) return list;
    const std::string found = std::to_string(list.rows());
    report_.error(rule_.path, "expected " + sized(rows_, rule_.rows, "number") + ", found " + found);
    return {};
  }

  // Every row is looked at, whatever is wrong with others.
  std::optional<Eigen::MatrixXd> read_rows(const Node& node) const {
    bool good = true;
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const Node& row = node.items[i];
      rows.emplace_back(row.items.size());
      good = check_row(node, i) && good;
      if (is_array(row)) good = read_entries(indexed(rule_.path, i), row, rows.back().data()) && good;
    }
    const auto [row_count, column_count] = shape_of(node);
    if (row_count < 0 || !check_shape(row_count, column_count) || !good) return {};
    Eigen::MatrixXd matrix(row_count, column_count);
    for (int i = 0; i < row_count; ++i)
      for (int j = 0; j < column_count; ++j) matrix(i, j) = rows[i][j];
    return matrix;
  }

  bool check_row(const Node& node, std::size_t i) const {
    const Node& row = node.items[i];
    const std::size_t columns = node.items[0].items.size();
    std::string wrong;
    if (!is_array(row) || row.items.empty())
      wrong = "expected an array of numbers, found " + describe(row);
    else if (is_array(node.items[0]) && columns != 0 && row.items.size() != columns)
      wrong = "expected " + counted(static_cast<long>(columns), "number") + " as in the first row, found " +
              std::to_string(row.items.size());
    if (!wrong.empty()) report_.error(indexed(rule_.path, i), row.where, wrong);
    return wrong.empty();
  }

  // The entries of one array of numbers; the first wrong one is reported.
  bool read_entries(const std::string& key, const Node& array, double* entries) const {
    for (std::size_t j = 0; j < array.items.size(); ++j) {
      const Node& item = array.items[j];
      std::string wrong;
      if (!is_number(item))
        wrong = "expected a number, found " + describe(item);
      else if (std::isnan(item.number) || (std::isinf(item.number) && rule_.type != Type::bounds))
        wrong = "expected a finite number, found " + shown(item.number);
      else if (rule_.type == Type::positives && !(item.number > 0))
        wrong = "expected a number > 0, found " + shown(item.number);
      else if (rule_.type == Type::mask && item.number != 0 && item.number != 1)
        wrong = "expected 0 or 1, found " + shown(item.number);
      if (!wrong.empty()) {
        report_.error(indexed(key, j), item.where, wrong);
        return false;
      }
      entries[j] = item.number;
    }
    return true;
  }

  bool check_shape(int rows, int columns) const {
    const bool square = rule_.type == Type::weight || rule_.path == "plant.A";
    if (square && rows != columns && rows_ <= 0) {
      report_.error(rule_.path,
                    "expected a square matrix, found " + counted(rows, "row") + " of " + counted(columns, "number"));
      return false;
    }
    const bool is_lying = rows == 1 && columns == rows_ && columns_ <= 0;
    const bool rows_good = check_count(rows, rows_, rule_.rows, "row", is_lying ? "; a column is [[1], [2], [3]]" : "");
    return check_count(columns, columns_, rule_.columns, "column") && rows_good;
  }

  bool check_count(int found, int wanted, Size size, const std::string& noun, const std::string& hint = "") const {
    if (found > most_signals)
      report_.error(rule_.path, "expected at most " + counted(most_signals, noun) + " (" + name_of(size) + "), found " +
                                    std::to_string(found));
    else if (wanted > 0 && found != wanted)
      report_.error(rule_.path, "expected " + sized(wanted, size, noun) + ", found " + std::to_string(found) + hint);
    else
      return true;
    return false;
  }

  const KeyRule& rule_;
  int rows_, columns_;
  Report& report_;
};

bool has_formulas(const Node& node) {
  return node.formula || std::any_of(node.items.begin(), node.items.end(), has_formulas);
}

// The matrix that was read as `doubles`, its formulas with all of their digits.
design::RealMatrix with_formulas(const Node& node, const Eigen::MatrixXd& doubles) {
  const bool is_list = !is_array(node.items[0]);
  const bool is_diagonal = is_list && doubles.cols() > 1;
  design::RealMatrix exact = doubles.cast<design::Real>();
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (is_list) exact(row, is_diagonal ? row : 0) = exact_value(node.items[i]);
    for (std::size_t j = 0; !is_list && j < node.items[i].items.size(); ++j)
      exact(row, static_cast<Eigen::Index>(j)) = exact_value(node.items[i].items[j]);
  }
  return exact;
}

}  // namespace

std::string name_of(Size size) {
  switch (size) {
    case Size::nx: return "nx";
    case Size::nu: return "nu";
    case Size::ny: return "ny";
    case Size::nw: return "nw";
    case Size::integrals: return "integrated outputs";
    case Size::none: break;
  }
  return "1";
}

std::map<Size, int> measure(const std::map<std::string, const Node*>& nodes) {
  const auto shape = [&](const char* key, int absent) {
    const auto node = nodes.find(key);
    return node == nodes.end() ? std::pair(absent, absent) : shape_of(*node->second);
  };
  const auto limited = [](int size) { return size > most_signals ? -1 : size; };
  // Entries of an array; −1 of anything else.
  const auto length = [&](const char* key, int absent) {
    const auto node = nodes.find(key);
    if (node == nodes.end()) return absent;
    return is_array(*node->second) ? static_cast<int>(node->second->items.size()) : -1;
  };
  std::map<Size, int> sizes{{Size::none, 1}};
  if (nodes.count("plant.f") != 0) {
    sizes[Size::nx] = limited(length("plant.f", -1));
    sizes[Size::nu] = limited(length("plant.inputs", 0));
    sizes[Size::ny] = limited(length("plant.h", 0));
  } else {
    const auto [nx, columns] = shape("plant.A", -1);
    sizes[Size::nx] = limited(nx == columns ? nx : -1);
    // A row where a column was meant, as of one input, tells no number of inputs.
    const auto [rows_of_B, columns_of_B] = shape("plant.B", 0);
    sizes[Size::nu] = rows_of_B != nx && columns_of_B == nx ? -1 : limited(columns_of_B);
    sizes[Size::ny] = limited(shape("plant.C", 0).first);
  }
  const auto integrated = nodes.find("lqr.integral.outputs");
  sizes[Size::integrals] = integrated == nodes.end() ? 0 : limited(static_cast<int>(integrated->second->items.size()));
  sizes[Size::nw] = limited(shape("plant.G", sizes[Size::nx]).second);
  return sizes;
}

std::optional<design::ExactMatrix> read_matrix(const KeyRule& rule, const Node& node, const std::map<Size, int>& sizes,
                                               Report& report) {
  const std::optional<Eigen::MatrixXd> doubles = MatrixReader(rule, sizes, report).read(node);
  if (!doubles) return {};
  return has_formulas(node) ? design::ExactMatrix::of(with_formulas(node, *doubles)) : design::ExactMatrix(*doubles);
}

}  // namespace lqg::input
