// SPDX-License-Identifier: MIT
// A plant as its user's equations.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace lqg::expression {
struct Node;
}

namespace lqg::design {

// ẋ = f(x, u) of a continuous plant, x⁺ = f(x, u) of a discrete one; y = h(x, u). In the plant's own units.
struct Equations {
  // Bound: variable 0 … nx−1 is that state, nx … nx+nu−1 that input. One formula a state, and one an output.
  std::vector<std::shared_ptr<const expression::Node>> f, h;
  std::vector<std::string> f_text, h_text;  // the same as the file has them
};

}  // namespace lqg::design
