// SPDX-License-Identifier: MIT
// The units of plant.f and plant.h: of a state's per second, of the next state, of an output.
#pragma once

#include "expression/measure.hpp"
#include "input/document.hpp"
#include "input/formula_place.hpp"
#include "input/parameters.hpp"
#include "input/report.hpp"
#include "input/values.hpp"

namespace lqg::input {

// Of the equations in `values`; `f` and `h` are the arrays of the file that they come from.
class EquationUnits {
 public:
  EquationUnits(const Node* f, const Node* h, const Parameters& parameters, const FormulaPlaces& places,
                const Values& values, Report& report)
      : f_(f), h_(h), of_parameters_(measure_of_parameters(parameters)), places_(places), values_(values),
        report_(report) {}

  // False, and reported, where units do not go together, as far as the file tells them.
  bool check() const;

 private:
  bool check_formula(const std::string& key, const Node& text, const expression::Node& tree,
                     const expression::Measure& wanted) const;

  const Node *f_, *h_;
  expression::MeasureOf of_parameters_;
  const FormulaPlaces& places_;
  const Values& values_;
  Report& report_;
};

}  // namespace lqg::input
