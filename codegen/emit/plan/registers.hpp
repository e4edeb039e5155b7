// SPDX-License-Identifier: MIT
// How a compiler fits the values of straight-line code into the registers of the target: what it loads, keeps and
// spills.
#pragma once

#include <vector>

#include "trace/print.hpp"

namespace lqg::emit {

enum class Carried { nothing, plain_covariance, factors };

// A function as it is printed.
struct Listing {
  const std::vector<trace::Node>& nodes;
  std::vector<bool> needed, declared;  // of each node: the results need it, it has a statement of its own
  std::vector<trace::Store> stores;
  std::vector<int> ends;                    // what is computed behind the last statement: statuses, tests
  long read_again = 0, written_before = 0;  // a recovery in the middle: values behind and before it
  Carried carries = Carried::nothing;
  bool is_fused = false;
  bool asks = false;      // it calls NAME_weigh, which may write to *self: all inputs are loaded before
  bool answers = false;   // it is NAME_weigh …
  bool is_alone = false;  // … of one output only
};

// Counts of a function, none of them in bytes.
struct Traffic {
  long operations = 0, comparisons = 0;
  long fused = 0;  // of the operations: a product and a sum in one
  long selections = 0, status_selections = 0, questions = 0;
  long moves = 0;                  // an addend is needed after the fused instruction that overwrites it
  long inputs = 0, of_tables = 0;  // which are loaded first; which are read where they are needed
  long loads = 0, stores = 0;
  long reloads = 0, spills = 0;
  long constant_loads = 0, immediates = 0;
  long pool = 0;       // constants that stand behind the code, those that are out of reach once more
  long slots = 0;      // of the stack, for spilled values
  long registers = 0;  // the most in use at once
};

// With this many registers, values that wait longest for their next use spilled first.
Traffic traffic_of(const Listing& listing, long registers);

// The most values in use at once, with the statements in their order.
long values_at_once(const Listing& listing);

}  // namespace lqg::emit
