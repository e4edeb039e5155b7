// SPDX-License-Identifier: MIT
// Extended filters of equations that a test states as texts.
#pragma once

#include <boost/multiprecision/eigen.hpp>
#include <boost/multiprecision/mpfr.hpp>
#include <string>
#include <vector>

#include "expression/bind.hpp"
#include "expression/parse.hpp"
#include "random_model.hpp"
#include "step/covariance.hpp"
#include "step/loop.hpp"

namespace lqg_test {

struct Texts {
  std::vector<std::string> states, inputs, f, h;
  std::vector<bool> wraps;
};

// Diagonals, but for the covariance of the first two outputs.
struct Noises {
  std::vector<double> W = {1, 1, 1, 1}, P0 = {1, 1, 1, 1}, V = {1, 1};
  double V_01 = 0;
};

inline double number(double value) { return value; }
inline double number(float value) { return static_cast<double>(value); }
template <class T>
double number(lqg::step::Fused<T> value) {
  return static_cast<double>(value.value);
}
template <class S>
double number(const S& value) {
  return static_cast<double>(value);
}

inline lqg::expression::Tree formula(const std::string& text, const Texts& texts) {
  std::vector<std::string> names = texts.states;
  names.insert(names.end(), texts.inputs.begin(), texts.inputs.end());
  const auto parsed = lqg::expression::parse(text);
  const auto bound = lqg::expression::bind(std::get<lqg::expression::Tree>(parsed),
                                           [&](const std::string& name, std::size_t at) -> lqg::expression::Tree {
                                             for (std::size_t i = 0; i < names.size(); ++i)
                                               if (names[i] == name)
                                                 return lqg::expression::variable(name, static_cast<int>(i), at);
                                             return nullptr;
                                           });
  return std::get<lqg::expression::Tree>(bound);
}

// Constants are made as those of S: with its digits.
template <class S>
void add_constants(const lqg::expression::Node& node, std::map<const lqg::expression::Node*, S>& out) {
  using Exact =
      boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<50>, boost::multiprecision::et_off>;
  if (node.is_constant) out.insert({&node, S(static_cast<real_of<S>>(lqg::expression::Constants<Exact>()(node)))});
  for (const auto& operand : node.operands)
    if (!node.is_constant) add_constants(*operand, out);
}

template <class S>
lqg::step::Model<S> extended_model(const Texts& texts, lqg::step::Integration integration, double T,
                                   lqg::step::Filter filter, const Noises& noises) {
  using lqg::step::Matrix;
  using lqg::step::Vector;
  lqg::step::Model<S> model;
  model.filter = filter;
  model.nx = static_cast<int>(texts.states.size());
  model.nu = static_cast<int>(texts.inputs.size());
  model.ny = static_cast<int>(texts.h.size());
  const auto zeros = [](int rows, int columns) { return Matrix<S>(Matrix<S>::Constant(rows, columns, S(0))); };
  auto equations = std::make_shared<lqg::step::Equations<S>>();
  for (const std::string& text : texts.f) equations->f.push_back(formula(text, texts));
  for (const std::string& text : texts.h) equations->h.push_back(formula(text, texts));
  for (const auto* formulas : {&equations->f, &equations->h})
    for (const auto& each : *formulas) add_constants(*each, equations->constants);
  equations->integration = integration;
  equations->T = S(T);
  equations->T_half = S(equations->T / S(2));
  equations->T_third = S(equations->T / S(3));
  equations->T_sixth = S(equations->T / S(6));
  equations->wraps = texts.wraps;
  model.equations = equations;
  model.A = model.A_free = model.W = zeros(model.nx, model.nx);
  model.B = zeros(model.nx, model.nu);
  model.C = zeros(model.ny, model.nx);
  model.D = zeros(model.ny, model.nu);
  model.M.resize(model.nx, 0);
  model.G = zeros(model.nx, model.nx);
  model.w.resize(model.nx);
  model.x0 = Vector<S>::Constant(model.nx, S(0));
  for (int i = 0; i < model.nx; ++i) {
    const auto at = static_cast<std::size_t>(i);
    model.w(i) = model.W(i, i) = S(noises.W[at]);
    model.G(i, i) = S(1);
    if (filter == lqg::step::Filter::ud) model.D0.push_back(S(noises.P0[at]));
    for (int j = 0; j <= i; ++j)
      if (filter == lqg::step::Filter::plain)
        model.P0.push_back(i == j ? S(noises.P0[at]) : S(0));
      else if (j < i)
        model.U0.push_back(S(0));
  }
  // V = E⁻¹ diag(V) E⁻ᵀ
  model.E = zeros(model.ny, model.ny);
  model.V.resize(model.ny);
  for (int i = 0; i < model.ny; ++i) {
    model.E(i, i) = S(1);
    model.V(i) = S(noises.V[static_cast<std::size_t>(i)]);
  }
  if (noises.V_01 != 0) {
    const S ratio = S(noises.V_01) / S(noises.V[0]);
    model.E(1, 0) = S(S(0) - ratio);
    model.V(1) = S(noises.V[1]) - S(ratio * S(noises.V_01));
  }
  return model;
}

}  // namespace lqg_test
