// SPDX-License-Identifier: MIT
#include "emit/report/summary.hpp"

#include "emit/text/description.hpp"

namespace lqg::emit {

std::string summary(const Controller& controller) {
  return controller.problem.name + "\n" + describe_regulator(controller) + describe_gains(controller) +
         describe_loop(controller) + describe_rms(controller) + describe_poles(controller) +
         describe_forms(controller) + describe_cost(controller);
}

}  // namespace lqg::emit
