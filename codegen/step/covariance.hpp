// SPDX-License-Identifier: MIT
// The covariance of the estimate's error, for those who look at it.
#pragma once

#include "step/by_hand.hpp"
#include "step/model.hpp"

namespace lqg::step {

// P of what the filter keeps: lower triangle, row by row; U diag(D) Uᵀ is multiplied out, every product and sum
// rounded.
template <class S, class Listener>
std::vector<S> kept_covariance(const Model<S>& model, const State<S>& state, Listener& listener) {
  if (model.filter != Filter::ud) return state.P;
  std::vector<S> P;
  for (int i = 0; i < model.nx; ++i)
    for (int j = 0; j <= i; ++j) {
      S sum = i == j ? S(state.D[i]) : S(state.U[strict_triangle(j, i)] * state.D[i]);
      for (int k = i + 1; k < model.nx; ++k) {
        const S weighted = state.U[strict_triangle(j, k)] * state.D[k];
        listener.name(weighted, "Ud", of_entry(j, k));
        const S term = weighted * state.U[strict_triangle(i, k)];
        sum = sum + term;
      }
      listener.name(sum, "P", of_entry(i, j));
      P.push_back(sum);
    }
  return P;
}

// P of the estimate's error, likewise: T P Tᵀ of a filter that keeps another state than the estimate, row by row of
// T P. Empty where no covariance is carried.
template <class S, class Listener>
std::vector<S> covariance(const Model<S>& model, const State<S>& state, Listener& listener) {
  const std::vector<S> kept = kept_covariance(model, state, listener);
  if (model.to_estimate.size() == 0 || kept.empty()) return kept;
  listener.section("T P Tᵀ");
  std::vector<S> P;
  for (int i = 0; i < model.nx; ++i) {
    Vector<S> row(model.nx);  // of T P
    for (int k = 0; k < model.nx; ++k) {
      Vector<S> column(model.nx);
      for (int j = 0; j < model.nx; ++j) column(j) = kept[static_cast<std::size_t>(triangle(j, k))];
      row(k) = image(Matrix<S>(model.to_estimate.row(i)), column)(0);
      listener.name(row(k), "TP", of_entry(i, k));
    }
    const Vector<S> all = image(Matrix<S>(model.to_estimate.topRows(i + 1)), row);
    for (int j = 0; j <= i; ++j) {
      listener.name(all(j), "P_of_estimate", of_entry(i, j));
      P.push_back(all(j));
    }
  }
  return P;
}
template <class S>
std::vector<S> covariance(const Model<S>& model, const State<S>& state) {
  Listener listener;
  return covariance(model, state, listener);
}

}  // namespace lqg::step
