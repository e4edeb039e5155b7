// SPDX-License-Identifier: MIT
// The covariance of the estimate's error, for those who look at it.
#pragma once

#include "step/model.hpp"

namespace lqg::step {

// P of the state: lower triangle, row by row; U diag(D) Uᵀ is multiplied out, every product and sum rounded. Empty
// where no covariance is carried.
template <class S, class Listener>
std::vector<S> covariance(const Model<S>& model, const State<S>& state, Listener& listener) {
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
template <class S>
std::vector<S> covariance(const Model<S>& model, const State<S>& state) {
  Listener listener;
  return covariance(model, state, listener);
}

}  // namespace lqg::step
