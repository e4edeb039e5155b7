// SPDX-License-Identifier: MIT
// The table [parameters]: names for numbers and formulas, which formulas of the whole file are over.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "expression/bind.hpp"
#include "expression/measure.hpp"
#include "input/design_file.hpp"
#include "input/document.hpp"
#include "input/exact_value.hpp"
#include "input/formula_place.hpp"
#include "input/report.hpp"

namespace lqg::input {

struct Parameter {
  std::string name;
  expression::Tree value;  // bound: numbers and parameters
  double number = 0;       // its value, rounded
  std::string formula;     // as it is written; empty where it is a number
  std::string unit;        // as it is written, "ohm", or empty
  expression::Measure measure;
  bool is_set = false;  // in place of what the file says
};

struct Parameters {
  std::vector<Parameter> all;   // in the order of the file
  std::set<std::string> wrong;  // those that have no value; that has been reported

  const Parameter* find(const std::string& name) const;  // nullptr: not there, or wrong
};

// More of them are refused.
constexpr std::size_t most_parameters = 1000;

// Reads the table of `document`, if it has one, and reports what is wrong with it.
Parameters read_parameters(const Node& document, const Settings& settings, const FormulaPlaces& places,
                           ExactValues& values, Report& report);

// Of formulas that have nothing but parameters.
expression::Meaning meaning(const Parameters& parameters);

// The unit of each parameter, and unknown of what else there is.
expression::MeasureOf measure_of_parameters(const Parameters& parameters);

// "expected a parameter, a function or pi, found …": of a name in a formula that is neither a parameter nor one of
// `others`.
std::string unknown_name(const std::string& name, const Parameters& parameters,
                         const std::vector<std::string>& others = {});

// "expected a number or an expression, found …": of a text that is no formula.
std::string not_a_formula(const std::string& text, const expression::Fault& fault);

// A text as a formula of parameters. Nothing, and what is wrong reported under `key`, where it is none; where it needs
// a parameter that is wrong itself, nothing more is said.
expression::Tree read_formula(const std::string& key, const Node& text, const Parameters& parameters,
                              const FormulaPlaces& places, Report& report);

}  // namespace lqg::input
