#include "emit/plan/straight_line_cost.hpp"

#include <algorithm>

namespace lqg::emit {

namespace {

constexpr long instruction = 4;  // bytes, of nearly all that there are

long rounded_up(long bytes) { return (bytes + 7) / 8 * 8; }

// Comparisons, branches, calls and what belongs to them besides.
long control_flow_in_float(const Listing& listing, const Traffic& count) {
  if (listing.answers) return 36 * count.selections - 8 - (listing.is_alone ? 40 : 0);
  if (listing.asks) return 20 + 66 * count.questions + 14 * std::max(0L, count.selections - count.questions);
  if (count.status_selections > 0)
    return (count.selections > 4 ? 80 : count.selections > 3 ? 36 : 0) + 38 * count.selections +
           14 * std::max(0L, count.status_selections - count.selections);
  return 12 + 12 * count.comparisons + 4 * count.selections;
}

long control_flow_in_double(const Listing& listing, const Traffic& count) {
  const long compared = 24 + 12 * count.comparisons;
  if (listing.asks) return compared + 35 * count.questions + 20 * std::max(0L, count.selections - count.questions);
  return compared + (count.status_selections > 0 && !listing.answers ? 40 : 20) * count.selections;
}

}  // namespace

FunctionCost cost_in_float(const Listing& listing) {
  // All 32 but one; NAME_weigh overwrites some more.
  const Traffic count = traffic_of(listing, listing.asks ? (listing.is_fused ? 24 : 28) : 31);
  // GCC gives a value one place for as long as it lives, where the traffic above is the least there can be.
  const long again = count.reloads + std::max(0L, count.loads - count.inputs);
  const long extra = listing.asks ? 0 : again / (listing.is_fused ? 4 : 8);
  const long slots = listing.asks ? count.slots : count.slots + count.slots / (listing.is_fused ? 7 : 8);
  FunctionCost cost;
  cost.flash = instruction * (count.operations + count.moves + count.loads + count.stores + count.reloads + count.spills + extra +
                              count.constant_loads + count.immediates + count.pool) + control_flow_in_float(listing, count);
  // What may be used freely: half of the registers, and of these what NAME_weigh leaves alone.
  const long free = listing.asks ? 11 : 16;
  cost.stack = rounded_up(4 * slots) + rounded_up(4 * std::clamp(count.registers - free, 0L, 16L)) + (listing.asks ? 16 : 0);
  if (listing.answers) cost.stack = 8;
  return cost;
}

FunctionCost cost_in_double(const Listing& listing) {
  const Traffic count = traffic_of(listing, 5);  // pairs of core registers
  FunctionCost cost;
  cost.flash = 12 * count.operations + (listing.is_fused ? 4 * count.operations + 6 * count.fused : 0) + 4 * count.constant_loads +
               8 * count.pool + 5 * (count.loads + count.stores) + 2 * (count.reloads + count.spills) + control_flow_in_double(listing, count);
  // The core registers that it saves, and what waits in memory: all inputs at the beginning, or spilled values later.
  const long saved = 36, spilled = 8 * count.slots + count.slots / 2 + (listing.is_fused ? 56 : 0);
  cost.stack = listing.answers ? 72 : rounded_up(std::max(saved + spilled, 24 + 8 * (count.inputs + count.of_tables)));
  return cost;
}

}  // namespace lqg::emit
