// SPDX-License-Identifier: MIT
// The equations of a plant with their constants, for any scalar.
#pragma once

#include <map>
#include <memory>
#include <vector>

namespace lqg::expression {
struct Node;
}

namespace lqg::step {

// From one sample to the next: the equations say it (of a discrete plant), or they are integrated with u held.
enum class Integration { none, rk4, euler };

template <class S>
struct Equations {
  using Formula = std::shared_ptr<const expression::Node>;
  // Variable 0 … nx − 1 is that state, then the inputs. f has nx formulas, h one an output.
  std::vector<Formula> f, h;
  std::map<const expression::Node*, S> constants;  // the largest parts without a variable
  Integration integration = Integration::none;
  S T = S(0), T_half = S(0), T_sixth = S(0), T_third = S(0);  // s, the sample time and its parts
  std::vector<bool> wraps;                                    // ny: the innovation lies in [−π, π)
};

}  // namespace lqg::step
