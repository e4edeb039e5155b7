// SPDX-License-Identifier: MIT
#include "emit/plan/plan.hpp"

#include <algorithm>
#include <vector>

#include "emit/plan/certified_iterations.hpp"
#include "emit/plan/code_cost.hpp"
#include "emit/plan/library_cost.hpp"
#include "emit/plan/realisation.hpp"
#include "emit/recorded/shared_covariance.hpp"
#include "emit/recorded/steady_products.hpp"
#include "simulate/drop_outs.hpp"
#include "simulate/foresight.hpp"
#include "simulate/scenario_requirements.hpp"

namespace lqg::emit {

namespace {

// A style, what its straight-line code shares, and what it costs.
struct Way {
  design::Style style;
  controller::Sharing sharing;
  CodeCost cost;
};

const Way& smallest(const std::vector<Way>& ways) {
  return *std::min_element(ways.begin(), ways.end(),
                           [](const Way& a, const Way& b) { return a.cost.flash < b.cost.flash; });
}

// Compact code has loops; over fewer states than these they would be no shorter than what stands in them.
constexpr int least_in_loops = 5;

std::vector<controller::Sharing> sharings_of(const Controller& controller) {
  if (controller.size.nx < least_in_loops) return {controller::Sharing::outputs};
  if (controller.problem.code.style == design::Style::compact)
    return {controller::Sharing::columns, controller::Sharing::entries};
  return {controller::Sharing::outputs, controller::Sharing::columns, controller::Sharing::entries};
}

// With a constant gain straight lines and loops over tables. The compact style has those lines as long as the loops
// save little, and neither where the library's loops, which know no zeros, are smaller still.
std::vector<Way> steady_ways(const Controller& controller) {
  const Way straight = {design::Style::unrolled, controller::Sharing::nothing, cost_of_unrolled(controller)};
  std::vector<Way> ways = {straight};
  if (can_loop_products(controller)) {
    Controller looping = controller;
    looping.sharing = controller::Sharing::products;
    ways.push_back({design::Style::unrolled, looping.sharing, cost_of_products(looping)});
  }
  if (controller.problem.code.style != design::Style::compact) return ways;
  const Way& least = smallest(ways);
  const Way& compact = 4 * straight.cost.flash <= 5 * least.cost.flash ? straight : least;
  if (compact.cost.flash < cost_of_compact(controller).flash) return {compact};
  return {};
}

// Those that the design file lets choose among, the fastest first: what is shared takes calls, and loops for columns.
std::vector<Way> ways_of(const Controller& controller) {
  const design::Style asked = controller.problem.code.style;
  const bool is_steady = controller.filter == step::Filter::steady && controller.size.nx >= least_in_loops;
  std::vector<Way> ways;
  if (controller.modal || controller::is_extended(controller))
    return {{design::Style::unrolled, controller::Sharing::nothing, cost_of_unrolled(controller)}};
  if (asked == design::Style::unrolled || (asked == design::Style::automatic && !controller.has.stages && !is_steady))
    ways.push_back({design::Style::unrolled, controller::Sharing::nothing, cost_of_unrolled(controller)});
  if (asked != design::Style::unrolled && is_steady && !controller.has.stages) ways = steady_ways(controller);
  if (asked != design::Style::unrolled && can_share_covariance(controller)) {
    Controller sharing = controller;
    for (const controller::Sharing what : sharings_of(controller)) {
      sharing.sharing = what;
      ways.push_back({design::Style::unrolled, what, cost_of_shared(sharing)});
    }
  }
  if (asked != design::Style::unrolled)
    ways.push_back({design::Style::compact, controller::Sharing::nothing, cost_of_compact(controller)});
  for (Way& way : ways) add_foresight(controller, way.style == design::Style::compact, way.cost);
  return ways;
}

// The first that fits, else the smallest.
const Way& chosen_of(const std::vector<Way>& ways, long flash) {
  for (const Way& way : ways)
    if (way.cost.flash <= flash) return way;
  return smallest(ways);
}

void choose_style(Controller& controller) {
  if (controller.linear) {
    controller.style = design::Style::unrolled;
    controller.cost = cost_of_linear_form(controller);
    return;
  }
  const std::vector<Way> ways = ways_of(controller);
  const Way& chosen = chosen_of(ways, controller.problem.code.flash);
  controller.style = chosen.style;
  controller.sharing = chosen.sharing;
  controller.cost = chosen.cost;
}

// An error where lqgen may choose and still finds nothing that fits, else a note.
void check_flash(const Controller& controller, design::Findings& findings) {
  const design::Code& code = controller.problem.code;
  if (controller.cost.flash <= code.flash) return;
  findings.push_back({code.style == design::Style::automatic ? design::Severity::error : design::Severity::note,
                      "code.flash",
                      "expected at least " + std::to_string(controller.cost.flash) +
                          " bytes, which the controller takes, found " + std::to_string(code.flash)});
}

}  // namespace

std::optional<Controller> make_controller(design::Problem problem, design::Solution solution, controller::Source source,
                                          design::Findings& findings) {
  std::optional<Controller> physical =
      controller::controller_of(std::move(problem), std::move(solution), std::move(source), findings);
  if (!physical) return std::nullopt;
  std::optional<Controller> chosen = in_chosen_form(*std::move(physical), findings);
  if (!chosen) return std::nullopt;
  choose_style(*chosen);
  if (chosen->has.foresight) {
    chosen->worth = simulate::worth_of_foresight(*chosen);
    certify_iterations(*chosen);
  }
  check_flash(*chosen, findings);
  simulate::check_drop_outs(*chosen, findings);
  simulate::check_scenario_requirements(*chosen, findings);
  if (design::has_error(findings)) return std::nullopt;
  return chosen;
}

}  // namespace lqg::emit
