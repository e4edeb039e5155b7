// SPDX-License-Identifier: MIT
// What `lqgen simulate` shows, for people: NAME_simulation.html.
#pragma once

#include "emit/page/page.hpp"
#include "emit/report/scenario_json.hpp"

namespace lqg::emit {

PageData simulation_data(const Controller& controller, const Simulations& simulations);

// The parts of it.
PageView monte_carlo_view(const Controller& controller, const simulate::MonteCarlo& result);
PageView replay_view(const Controller& controller, const simulate::ReplayRun& run);

}  // namespace lqg::emit
