// SPDX-License-Identifier: MIT
#include "input/formula_place.hpp"

#include <algorithm>

namespace lqg::input {

Location FormulaPlaces::of(const Node& node, std::size_t at) const {
  if (node.where.line <= 0) return node.where;
  const std::size_t begin = places_.byte(node.where);
  const bool is_plain = begin + 1 < text_.size() && (text_[begin] == '"' || text_[begin] == '\'') &&
                        text_.compare(begin + 1, node.text.size(), node.text) == 0 &&
                        node.text.find_first_of("\\\n") == node.text.npos;
  if (!is_plain) return node.where;
  const auto end = node.text.begin() + static_cast<std::ptrdiff_t>(std::min(at, node.text.size()));
  const auto is_first_byte = [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; };
  return {node.where.line,
          node.where.column + 1 + static_cast<int>(std::count_if(node.text.begin(), end, is_first_byte))};
}

}  // namespace lqg::input
