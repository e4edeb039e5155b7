// SPDX-License-Identifier: MIT
#include "emit/report/summary.hpp"

#include "emit/report/sections.hpp"
#include "emit/text/description.hpp"
#include "emit/text/equations.hpp"
#include "emit/text/order_description.hpp"
#include "emit/text/parameter_description.hpp"
#include "emit/text/recovery_table.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

std::string summary(const Controller& controller) {
  const std::string worth = controller.worth ? "\n" + trace::wrap(worth_in_words(controller), 0, 96) + "\n" : "";
  return controller.problem.name + "\n" + describe_parameters(controller) + describe_point(controller) +
         describe_equations(controller) + describe_regulator(controller) + worth + describe_gains(controller) +
         describe_optimum(controller) + describe_white(controller) + describe_loop(controller) +
         describe_recovery(controller) + describe_rms(controller) + describe_poles(controller) +
         describe_forms(controller) + describe_cost(controller);
}

}  // namespace lqg::emit
