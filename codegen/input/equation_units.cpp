// SPDX-License-Identifier: MIT
#include "input/equation_units.hpp"

#include <variant>

#include "input/unit_check.hpp"

namespace lqg::input {

using expression::Measure;

bool EquationUnits::check() const {
  const bool is_continuous = values_.text("plant.domain") != "discrete";
  const auto key = [](const char* list, std::size_t i) { return std::string(list) + "[" + std::to_string(i) + "]"; };
  bool good = true;
  for (std::size_t i = 0; i < values_.equations->f.size(); ++i) {
    Measure wanted = measure_of_signal(values_, "plant.states", i);
    if (is_continuous) wanted.unit = wanted.unit / *expression::parse_unit("s");
    good = check_formula(key("plant.f", i), f_->items[i], *values_.equations->f[i], wanted) && good;
  }
  for (std::size_t i = 0; i < values_.equations->h.size(); ++i)
    good = check_formula(key("plant.h", i), h_->items[i], *values_.equations->h[i],
                         measure_of_signal(values_, "plant.outputs", i)) &&
           good;
  return good;
}

bool EquationUnits::check_formula(const std::string& key, const Node& text, const expression::Node& tree,
                                  const Measure& wanted) const {
  const std::size_t nx = values_.equations->f.size();
  const auto found = expression::measure_of(tree, [&](const expression::Node& node) {
    if (node.kind != expression::Node::Kind::variable) return of_parameters_(node);
    const std::size_t at = static_cast<std::size_t>(node.index);
    return at < nx ? measure_of_signal(values_, "plant.states", at)
                   : measure_of_signal(values_, "plant.inputs", at - nx);
  });
  if (const auto* fault = std::get_if<expression::Fault>(&found)) {
    report_.error(key, places_.of(text, fault->at), fault->message);
    return false;
  }
  const Measure& measure = std::get<Measure>(found);
  if (wanted.kind != Measure::Kind::known || measure.kind != Measure::Kind::known) return true;
  if (is_same(wanted.unit, measure.unit)) return true;
  report_.error(key, text.where,
                "expected a formula in " + in_words(wanted.unit) + ", found one in " + in_words(measure.unit));
  return false;
}

}  // namespace lqg::input
