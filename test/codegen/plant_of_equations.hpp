// SPDX-License-Identifier: MIT
// A plant of equations from their texts.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <unity.h>

#include "design/problem.hpp"
#include "expression/bind.hpp"

namespace lqg_test {

using Texts = std::vector<std::string>;

// The names in `parameters` have these values.
inline lqg::expression::Tree tree_of(const std::string& text, const lqg::design::Plant& plant,
                                     const std::map<std::string, double>& parameters = {}) {
  namespace expression = lqg::expression;
  const auto parsed = expression::parse(text);
  TEST_ASSERT_TRUE_MESSAGE(std::holds_alternative<expression::Tree>(parsed), text.c_str());
  const auto meaning = [&](const std::string& name, std::size_t at) -> expression::Tree {
    int index = 0;
    for (const auto* signals : {&plant.states, &plant.inputs})
      for (const lqg::design::Signal& signal : *signals) {
        if (signal.name == name) return expression::variable(name, index, at);
        ++index;
      }
    const auto found = parameters.find(name);
    return found == parameters.end() ? nullptr : expression::parameter(name, expression::number(found->second), at);
  };
  const auto bound = expression::bind(std::get<expression::Tree>(parsed), meaning);
  TEST_ASSERT_TRUE_MESSAGE(std::holds_alternative<expression::Tree>(bound), text.c_str());
  return std::get<expression::Tree>(bound);
}

inline lqg::design::Plant plant_of(lqg::design::Domain domain, const Texts& states, const Texts& inputs, const Texts& f,
                                   const Texts& h, const std::map<std::string, double>& parameters = {}) {
  lqg::design::Plant plant;
  plant.domain = domain;
  for (const std::string& name : states) plant.states.push_back({name, ""});
  for (const std::string& name : inputs) plant.inputs.push_back({name, ""});
  auto equations = std::make_shared<lqg::design::Equations>();
  for (const std::string& text : f) equations->f.push_back(tree_of(text, plant, parameters));
  for (const std::string& text : h) equations->h.push_back(tree_of(text, plant, parameters));
  plant.equations = equations;
  return plant;
}

}  // namespace lqg_test
