// The check that all of a state is finite.
#pragma once

#include "step/scalar.hpp"

namespace lqg::step {

// The sum of all parts of a state is finite if and only if each is, short of an overflow that no honest state comes near.
// Each part is added as it is found, and each sum has a name, so that none has to wait for the last.
template <class S>
struct Total {
  S sum = S(0);
  template <class Listener>
  void add(const S& part, Listener& listener) {
    sum = sum + part;
    listener.name(sum, "sum");
  }
};

}  // namespace lqg::step
