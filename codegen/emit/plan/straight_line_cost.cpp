// SPDX-License-Identifier: MIT
#include "emit/plan/straight_line_cost.hpp"

#include <algorithm>

#include "emit/plan/sizes.hpp"

namespace lqg::emit {

namespace {

constexpr long instruction = 4;  // bytes, of nearly all that there are

// Fused, and nearly no coefficient is 0 or 1: all products of a row come before its sums.
bool is_full(const Listing& listing, const Traffic& count) {
  return listing.is_fused && 10 * count.constant_loads >= 9 * count.operations;
}

// Of an update with a constant gain: besides the states it reads each output and its gate's width.
long states_of(const Traffic& count) { return count.inputs - 2 * count.questions; }

// An update with a constant gain chooses nothing but which outputs it uses.
bool weighs_only(const Traffic& count) { return count.selections == count.questions; }

// The rows of C are full, in such an update with fused products.
bool has_full_rows(const Listing& listing, const Traffic& count) {
  const long gains = states_of(count) * count.questions;
  return listing.is_fused && weighs_only(count) && count.questions > 1 && 5 * count.operations > 9 * gains;
}

// Of what a sensor can say: two comparisons each, beside the two of a question and the one of the bounds.
long ranges_of(const Traffic& count) { return std::max(0L, count.comparisons - 2 * count.questions - 1) / 2; }

// Comparisons, branches, calls and what belongs to them besides.
long control_flow_in_float(const Listing& listing, const Traffic& count) {
  if (listing.answers) return 36 * count.selections - 8 - (listing.is_alone ? 40 : 0);
  if (listing.asks)
    return 20 + 66 * count.questions + 14 * std::max(0L, count.selections - count.questions) + 36 * ranges_of(count);
  if (count.status_selections > 0)
    return (count.selections > 4   ? 80
            : count.selections > 3 ? 36
                                   : 0) +
           38 * count.selections + 14 * std::max(0L, count.status_selections - count.selections);
  return 12 + 12 * count.comparisons + 4 * count.selections;
}

long control_flow_in_double(const Listing& listing, const Traffic& count) {
  const long compared = 24 + 12 * count.comparisons;
  if (listing.asks) return compared + 35 * count.questions + 20 * std::max(0L, count.selections - count.questions);
  return compared + (count.status_selections > 0 && !listing.answers ? 40 : 20) * count.selections;
}

// Registers that a function saves come in pairs.
long pairs(long registers) { return std::clamp((registers + 1) / 2 * 2, 0L, 16L); }

// Of the inputs u, each of which has a lower limit, an upper one or both: `selections` choose numbers, `statuses` bits.
bool has_both_limits(const Traffic& count) { return count.selections > count.status_selections; }

long limited_inputs(const Traffic& count) {
  return has_both_limits(count) ? count.selections - count.status_selections : count.status_selections;
}

// Products that are made before their sums need them.
long early_products(const Listing& listing, const Traffic& count) {
  const long held = count.registers + count.slots;
  if (!listing.is_fused) return held == 28;
  if (has_full_rows(listing, count)) return count.questions == 2 ? 2 : std::min(count.questions + 2, 6L);
  return weighs_only(count) && held > 28 ? 2 : 0;
}

// Bytes that wait besides: of what an output changes behind its question (P, U, d), and of fused sums.
long kept_behind_questions(const Listing& listing, const Traffic& count, long live, long slots) {
  const bool is_one = count.questions == 1;
  if (weighs_only(count)) {
    const bool waits = is_one || (count.questions > 2 && has_full_rows(listing, count));
    return listing.is_fused && waits ? 8 : 0;
  }
  const long spilled = slots / 32 * 8;
  if (!is_one) return spilled + (slots > 0 && (listing.is_fused || count.questions == 2) ? 16 : 8);
  if (slots > 0) return spilled + 8;
  if (listing.is_fused) return live > 12 ? 16 : 8;
  return live > 16 ? 8 : 0;
}

// The frame of a function that calls NAME_weigh. Of the values in use at once 14 are not needed behind these calls; the
// others wait in the 16 registers that a call keeps, then on the stack.
long asking_frame_in_float(const Listing& listing) {
  const Traffic count = traffic_of(listing, 30);
  const long live = count.registers + count.slots + early_products(listing, count), slots = std::max(0L, live - 30);
  return 8 + 4 * pairs(std::min(live, 30L) - 14) + aligned(8 + 4 * slots) +
         kept_behind_questions(listing, count, live, slots);
}

// The frame of a law with limits: each input is compared while the others wait, and a lower limit only waits for its
// own.
long limiting_frame_in_float(const Traffic& count) {
  const long inputs = limited_inputs(count);
  const bool has_both = has_both_limits(count);
  const long saved = pairs(count.registers + inputs - (has_both ? 16 : 18));
  return 4 * saved + (has_both && (inputs > 4 || saved == 16) ? 8 : 0) + aligned(4 * count.slots);
}

long frame_in_float(const Listing& listing, const Traffic& count) {
  if (listing.answers) return 8;
  if (listing.asks) return asking_frame_in_float(listing);
  if (count.status_selections > 0) return limiting_frame_in_float(count);
  const long kept_longer = count.slots == 0 ? 0 : std::max(count.slots / 8, count.slots < 24 ? 6L : 0L);
  return aligned(4 * (count.slots + kept_longer)) + 4 * pairs(count.registers - 16);
}

// Doubles wait in memory, spilled or as inputs that were all read at the beginning; nine core registers are saved.

long asking_frame_in_double(const Listing& listing, const Traffic& count) {
  const bool exact = weighs_only(count);
  const long inputs = 24 + 8 * (count.inputs + count.of_tables);
  long places = count.slots;
  if (!listing.is_fused)
    places += count.slots / 16 + !exact;
  else if (count.questions > 2 && has_full_rows(listing, count))
    places += states_of(count);
  else if (count.slots < 13)
    places += std::min(count.slots, 4L);
  else if (!exact && count.slots > 20)
    places += count.slots / 10 + 5;
  return std::max(40 + 8 * places, count.of_tables > 0 ? inputs : 0);
}

long limiting_frame_in_double(const Listing& listing, const Traffic& count) {
  const long limited = limited_inputs(count);
  const long statuses = limited > 1 ? count.status_selections : count.status_selections > 2 ? 2 : 0;
  const long fused = !listing.is_fused ? 0 : 24 + (limited > 1 ? 4 * count.inputs : 0);
  return std::max(24L, 8 + 8 * (count.inputs + statuses)) + fused;
}

// A prediction. Fused products wait with their sums: all of a dense P, all of a factor's row.
long predicting_frame_in_double(const Listing& listing, const Traffic& count) {
  const long read = 24 + 8 * count.inputs,
             spilled = 36 + 8 * count.slots + count.slots / 2 + (count.selections > 0 ? 8 : 0);
  if (!listing.is_fused || count.slots == 0) return std::max(spilled + (listing.is_fused ? 56 : 0), read);
  const long states = count.selections + 1;  // each factor but the last is compared with 0
  if (count.selections == 0) return count.operations < 5 * count.inputs ? 48 + read : 40 + read + 8 * count.slots;
  const bool has_dense_noise = 5 * count.operations > 8 * states * states * states;
  return 56 + 8 * (count.slots + count.slots / 16 + (has_dense_noise ? count.slots * count.slots / 470 : 0));
}

long frame_in_double(const Listing& listing, const Traffic& count) {
  if (listing.answers) return listing.is_alone ? (count.selections > 5 ? 56 : 48) : count.inputs > 3 ? 72 : 64;
  if (listing.asks) return asking_frame_in_double(listing, count);
  return count.status_selections > 0 ? limiting_frame_in_double(listing, count)
                                     : predicting_frame_in_double(listing, count);
}

}  // namespace

namespace {

// All 32 but one; NAME_weigh overwrites some more.
long registers_of(const Listing& listing, bool is_double) {
  if (is_double) return 5;  // pairs of core registers
  return listing.asks ? (listing.is_fused ? 24 : 28) : 31;
}

long statements_in_float(const Listing& listing, const Traffic& count) {
  // GCC gives a value one place for as long as it lives, where the traffic above is the least there can be.
  const long again = count.reloads + std::max(0L, count.loads - count.inputs);
  const long extra = listing.asks ? 0 : again / (listing.is_fused ? 4 : 8);
  return instruction * (count.operations + count.moves + count.loads + count.stores + count.reloads + count.spills +
                        extra + count.constant_loads + count.immediates + count.pool);
}

long statements_in_double(const Listing& listing, const Traffic& count) {
  return 12 * count.operations +
         (listing.is_fused ? 4 * count.operations + (is_full(listing, count) ? 2 : 6) * count.fused : 0) +
         4 * count.constant_loads + 8 * count.pool + 5 * (count.loads + count.stores) +
         2 * (count.reloads + count.spills);
}

// Bytes of the frame of a step besides: what waits from one of its parts to the other.
long kept_in_step_in_float(const Listing& step, const Traffic& count) {
  if (!step.asks) return step.read_again > 0 ? 16 : 0;
  if (step.carries == Carried::plain_covariance) return aligned(8 + count.slots + count.slots / 8);
  if (step.carries == Carried::factors) return count.slots > 0 ? 16 : 0;
  return step.is_fused && count.questions > 1 ? 8 : 0;
}

long kept_in_step_in_double(const Listing& step, const Traffic& count) {
  if (step.carries == Carried::plain_covariance) return 4 * std::max(0L, count.slots - 26);
  if (step.carries == Carried::factors) return step.is_fused ? -count.slots / 4 : 0;
  if (!step.asks) return step.is_fused ? 0 : step.read_again > 0 ? 16 : 56;
  if (!step.is_fused) return 8;
  return count.questions == 1 ? 16 : -count.slots / 4;
}

// Bytes of a step besides that the least traffic does not show.
long more_in_step(const Listing& step, const Traffic& count, bool is_double, long flash) {
  if (is_double) return 0;
  if (step.carries == Carried::plain_covariance) return count.slots == 0 ? 96 : count.slots > 60 ? flash / 16 : 0;
  return step.asks ? 24 : step.read_again == 0 && step.is_fused ? 120 : 0;
}

long control_flow(const Listing& listing, const Traffic& count, bool is_double) {
  return is_double ? control_flow_in_double(listing, count) : control_flow_in_float(listing, count);
}

}  // namespace

FunctionCost cost_in_float(const Listing& listing) {
  const Traffic count = traffic_of(listing, registers_of(listing, false));
  return {statements_in_float(listing, count) + control_flow_in_float(listing, count), frame_in_float(listing, count)};
}

FunctionCost cost_in_double(const Listing& listing) {
  const Traffic count = traffic_of(listing, registers_of(listing, true));
  return {statements_in_double(listing, count) + control_flow_in_double(listing, count),
          aligned(frame_in_double(listing, count))};
}

FunctionCost cost_of_step(const Listing& step, const std::vector<Listing>& calls, bool is_double) {
  const Traffic count = traffic_of(step, registers_of(step, is_double));
  FunctionCost cost;
  cost.flash = is_double ? statements_in_double(step, count) : statements_in_float(step, count);
  for (const Listing& call : calls)
    cost.flash += control_flow(call, traffic_of(call, registers_of(call, is_double)), is_double);
  cost.flash += (is_double ? 8 : instruction) * (step.read_again + step.written_before);
  cost.flash += more_in_step(step, count, is_double, cost.flash);
  cost.stack = is_double ? aligned(frame_in_double(step, count) + kept_in_step_in_double(step, count))
                         : frame_in_float(step, count) + kept_in_step_in_float(step, count);
  return cost;
}

}  // namespace lqg::emit
