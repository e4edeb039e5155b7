// SPDX-License-Identifier: MIT
// Formulas in quotes where the table of keys expects numbers.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "design/real.hpp"
#include "expression/tree.hpp"
#include "input/document.hpp"
#include "input/parameters.hpp"

namespace lqg::input {

struct Formula {
  std::string text;
  expression::Tree tree;  // bound: numbers and parameters
  design::Real exact;     // its value
};

struct PlacedFormula {
  std::string key;  // "plant.A[1][0]"
  Node node;        // the number that it has become
};

struct Formulas {
  std::vector<PlacedFormula> all;  // in the order of the file
  std::set<std::string> wrong;     // keys, "plant.A", that have a wrong one; that has been reported
};

// All formulas of a file together have at most so many bytes.
constexpr std::size_t most_formula_bytes = 400000;

// Makes each text of `document` that stands where a number may stand the number that it is as a formula.
Formulas read_formulas(Node& document, const Parameters& parameters, const FormulaPlaces& places, ExactValues& values,
                       Report& report);

// The value of a number with all of its digits.
design::Real exact_value(const Node& number);
bool is_whole(const Node& number);

}  // namespace lqg::input
