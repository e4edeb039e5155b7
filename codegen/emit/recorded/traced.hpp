// The controller's step, recorded: the very templates that are the host reference, run over symbols.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "emit/controller.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

struct TracedFunction {
  std::shared_ptr<trace::Graph> graph;
  std::vector<trace::Store> stores;
  std::vector<int> statuses;  // joined by |
  int finite = -1;  // condition; −1: cannot become infinite
  std::string recovery;  // the call that answers where it is not finite; empty: NAME_reset
  bool is_void = false;
  std::vector<std::pair<int, int>> gates;  // output, and the condition that it was gated

  std::vector<int> results() const;
};

struct TracedController {
  TracedFunction update, control, predict, set_input;
  std::vector<TracedFunction> updates_alone;
};

// nu[] and S[] of y[].
TracedFunction trace_innovation(const Controller& controller);

TracedController trace_controller(const Controller& controller);

// Which entries of P (or of U, then D) are ever different from 0: those of P0, and those that a step makes so.
std::vector<bool> covariance_pattern(const Controller& controller);

// "_0", "_31", "_3_11": row and column behind the name of a matrix with up to `size` rows.
std::string index_suffix(int i, int j, int size);

}  // namespace lqg::emit
