// SPDX-License-Identifier: MIT
// The place in the file of a byte of a string.
#pragma once

#include <cstddef>
#include <string>

#include "input/document.hpp"
#include "input/places.hpp"

namespace lqg::input {

class FormulaPlaces {
 public:
  explicit FormulaPlaces(const std::string& text) : text_(text), places_(text) {}

  // Of byte `at` of the string that `node` was in the file; that of the string as a whole where it is written with
  // escapes or over several lines.
  Location of(const Node& node, std::size_t at) const;

 private:
  const std::string& text_;
  Places places_;
};

}  // namespace lqg::input
