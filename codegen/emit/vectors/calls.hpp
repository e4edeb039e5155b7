// SPDX-License-Identifier: MIT
// What the emitted test calls beside the samples of the loop: every function of the header, with outputs that are
// missing or absurd, at the edge of every bound and limit, with states and inputs set by hand.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "emit/controller.hpp"

namespace lqg::emit {

struct Sample;

enum class Call {
  init,
  step,
  update,
  update_alone,
  partial_without,
  partial_alone,
  control,
  predict,
  advance,
  estimate,
  set_state,
  set_input,
  innovation,
  covariance,
  // what a caller, or a fault of the memory, may have written into the state
  write_r,
  write_x,
  write_covariance,
  write_xi,
  write_z
};

// A call with a row of the samples: times `number`, or with `number` in place of one entry. An update by one output
// takes the number alone; a partial update is by that entry alone, or by all others.
struct Turn {
  static constexpr int every_entry = -1;
  Call call = Call::init;
  std::size_t row = 0;
  int entry = every_entry;
  double number = 1;
};

// The row that a turn hands over, in the target's numbers.
std::vector<double> handed_over(const Turn& turn, std::vector<double> row, const controller::Target& target);

// What a status tells, in the order in which the test counts it; behind it, which outputs were rejected.
inline constexpr std::array told_events = {
    step::Event::output_rejected,  step::Event::output_gated, step::Event::innovation_not_positive,
    step::Event::input_limited,    step::Event::state_reset,  step::Event::reference_not_finite,
    step::Event::covariance_reset, step::Event::not_optimal};

// Whether the header has what the turn calls.
bool has_call(const Controller& controller, Call call);

struct Calls {
  std::vector<Turn> turns;
  std::uint32_t hash = 0;  // FNV-1a over what each told, gave, and left in the state, in the target's precision
};

// Made from what the one simulation does in the target's precision, so that each limit is met from both sides.
Calls make_calls(const Controller& controller, const std::vector<Sample>& samples);

}  // namespace lqg::emit
