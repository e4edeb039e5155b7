// SPDX-License-Identifier: MIT
// What becomes of the outputs when only some of them are there.
#pragma once

#include "step/online.hpp"

namespace lqg::step {

// Which outputs y an update leaves out, and of which innovations; y is infinite for one that is not there:
// those that are not believable, and those whose noise only one that is lost itself would make independent.
template <class S, class Listener>
auto lost_outputs(const Model<S>& model, Vector<S> innovations, const Vector<S>& y, Listener& listener) {
  for (int i = 0; i < model.ny && model.y_min.size(); ++i) {
    innovations(i) = select(is_in_range(model, S(y(i)), i), S(innovations(i)), not_a_number(S(y(i))));
    listener.hint(innovations(i), "innovation_in_range", of_output(i));
  }
  const Vector<S> independent = model.E.size() ? decorrelate(model, innovations, listener) : innovations;
  std::vector<decltype(is_less(S(), S()))> lost;
  for (int i = 0; i < model.ny; ++i) lost.push_back(negation(is_believable(model.nu_limit, i, S(independent(i)))));
  return lost;
}

}  // namespace lqg::step
