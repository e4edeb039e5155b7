// SPDX-License-Identifier: MIT
// The keys of scenarios, and of what [require] asks for.
#include "input/key_table.hpp"

namespace lqg::input {
namespace {

// What changes with time, of each signal on its own.
std::vector<KeyRule> course(const std::string& table) {
  constexpr auto no = Size::none;
  constexpr auto optional = Need::optional;

  // clang-format off
  return {
      {table + ".value", Type::real, no, no, optional, {}, "How much is added.", "1"},
      {table + ".at", Type::not_negative, no, no, optional, {}, "When it begins, in s.", "0"},
      {table + ".until", Type::positive, no, no, optional, {}, "When it ends, in s.", "the end"},
      {table + ".ramp", Type::positive, no, no, optional, {}, "Time in s in which `value` is reached.", "a step"},
      {table + ".sine", Type::positive, no, no, optional, {},
       "Frequency in Hz: a sine with the amplitude `value` that begins with 0.", "none"},
      {table + ".csv", Type::line, no, no, optional, {},
       "A file with a header line and columns that commas separate, beside the design file. Its column `t` is the "
       "time in s from `at` on; the entry of the column is multiplied by `value` and held until the next time.",
       "none"},
      {table + ".column", Type::line, no, no, optional, {}, "Name of the column.", "the signal's name"},
  };
  // clang-format on
}

}  // namespace

std::vector<KeyRule> scenario_keys() {
  constexpr auto no = Size::none;
  constexpr auto nx = Size::nx;
  constexpr auto nu = Size::nu;
  constexpr auto ny = Size::ny;
  constexpr auto required = Need::required;
  constexpr auto optional = Need::optional;

  // clang-format off
  std::vector<KeyRule> keys = {
      {"scenario", Type::tables, no, no, optional, {},
       "What the loop has to live through, for `lqgen simulate`, the report and `[require]`.", "",
       "README.md#scenarios"},
      {"scenario.name", Type::line, no, no, required, {}, "Name of the scenario, different from the others."},
      {"scenario.duration", Type::positive, no, no, required, {}, "Length in s; at most 1,000,000 samples."},
      {"scenario.x0", Type::vector, nx, no, optional, {},
       "State of the plant at the start. x̂ begins with `kalman.initial_state`.", "0, or `plant.operating_point`"},
      {"scenario.noise", Type::flag, no, no, optional, {}, "`false`: without the noises of the design.", "true"},
      {"scenario.reference", Type::tables, no, no, optional, {},
       "References r of outputs that are in `lqr.track` or `lqr.integral.outputs`. Several add up. With "
       "`plant.operating_point` r begins with the output there and `value` is what it becomes; what adds up are the "
       "changes, and a sine is one."},
      {"scenario.reference.output", Type::signal, ny, no, required, {}, "The output."},
  };
  append(keys, course("scenario.reference"));
  append(keys, {
      {"scenario.load", Type::tables, no, no, optional, {}, "Loads that the controller does not know of."},
      {"scenario.load.input", Type::signal, nu, no, optional, {},
       "Added to what the actuator of this input does, in its unit. One of `input` and `state` is required."},
      {"scenario.load.state", Type::signal, nx, no, optional, {},
       "Added to the derivative of this state, in its unit per second; with a discrete plant to its next value."},
  });
  append(keys, course("scenario.load"));
  append(keys, {
      {"scenario.input", Type::tables, no, no, optional, {}, "The input u of a design without a regulator."},
      {"scenario.input.input", Type::signal, nu, no, required, {}, "The input."},
  });
  append(keys, course("scenario.input"));
  append(keys, {
      {"scenario.dropout", Type::tables, no, no, optional, {}, "Outputs that are missing (NaN) for a while."},
      {"scenario.dropout.output", Type::signal, ny, no, required, {}, "The output."},
      {"scenario.dropout.from", Type::not_negative, no, no, optional, {}, "First time in s.", "0"},
      {"scenario.dropout.until", Type::positive, no, no, optional, {}, "Time in s when it is back.", "the end"},
      {"scenario.outlier", Type::tables, no, no, optional, {}, "Wrong values in place of an output."},
      {"scenario.outlier.output", Type::signal, ny, no, required, {}, "The output."},
      {"scenario.outlier.value", Type::real, no, no, required, {}, "What the sensor says."},
      {"scenario.outlier.at", Type::not_negative, no, no, required, {}, "When, in s."},
      {"scenario.outlier.until", Type::positive, no, no, optional, {}, "When it ends, in s.", "after one sample"},
      {"scenario.sensor", Type::tables, no, no, optional, {},
       "Sensors that are not ideal: the output comes `delay` late, times `gain`, plus `bias`, rounded to multiples of "
       "`quantum`, within `min` and `max`."},
      {"scenario.sensor.output", Type::signal, ny, no, required, {}, "The output."},
      {"scenario.sensor.delay", Type::not_negative, no, no, optional, {},
       "In s, beyond `plant.output_delay`; with a discrete plant it is a whole number of periods.", "0"},
      {"scenario.sensor.gain", Type::real, no, no, optional, {}, "Factor.", "1"},
      {"scenario.sensor.bias", Type::real, no, no, optional, {}, "Offset.", "0"},
      {"scenario.sensor.quantum", Type::positive, no, no, optional, {}, "Smallest step.", "none"},
      {"scenario.sensor.min", Type::real, no, no, optional, {}, "Smallest value.", "−inf"},
      {"scenario.sensor.max", Type::real, no, no, optional, {}, "Largest value.", "inf"},
      {"scenario.actuator", Type::tables, no, no, optional, {},
       "Actuators that do less than the controller believes: u within `min` and `max`, no faster than `rate`, times "
       "`gain`, with a first-order lag."},
      {"scenario.actuator.input", Type::signal, nu, no, required, {}, "The input."},
      {"scenario.actuator.min", Type::real, no, no, optional, {}, "Smallest value.", "−inf"},
      {"scenario.actuator.max", Type::real, no, no, optional, {}, "Largest value.", "inf"},
      {"scenario.actuator.rate", Type::positive, no, no, optional, {}, "Largest change per second.", "inf"},
      {"scenario.actuator.gain", Type::real, no, no, optional, {}, "Factor.", "1"},
      {"scenario.actuator.time_constant", Type::positive, no, no, optional, {},
       "Time constant of the lag in s.", "no lag"},
      {"scenario.plant", Type::table, no, no, optional, {}, "How the plant differs from the design."},
      {"scenario.plant.A", Type::matrix, nx, nx, optional, {}, "In place of `plant.A`.", "unchanged"},
      {"scenario.plant.B", Type::matrix, nx, nu, optional, {}, "In place of `plant.B`.", "unchanged"},
      {"scenario.plant.C", Type::matrix, ny, nx, optional, {}, "In place of `plant.C`.", "unchanged"},
      {"scenario.plant.parameters", Type::parameters, no, no, optional, {},
       "Parameters that are others in the equations of this plant: `{ mass = 0.7 }`.", "those of the design"},
      {"scenario.plant.delay", Type::not_negative, no, no, optional, {},
       "In s, in place of `plant.delay`; with a discrete plant it is a whole number of periods.", "unchanged"},
      {"scenario.plant.continuous", Type::flag, no, no, optional, {},
       "`true`: A and B are those of ẋ although the design's plant is discrete, so that what lies between the "
       "samples is seen.", "false"},
      {"scenario.plant.scale", Type::tables, no, no, optional, {}, "Entries that are multiplied by a factor."},
      {"scenario.plant.scale.matrix", Type::word, no, no, required, {"A", "B", "C"}, "The matrix."},
      {"scenario.plant.scale.row", Type::entry, no, no, optional, {},
       "Name of the state or output of the row, or its number from 0.", "all rows"},
      {"scenario.plant.scale.column", Type::entry, no, no, optional, {},
       "Name of the state or input of the column, or its number from 0.", "all columns"},
      {"scenario.plant.scale.factor", Type::real, no, no, required, {}, "The factor."},
      {"scenario.spread", Type::table, no, no, optional, {},
       "What differs from run to run with `lqgen simulate --runs`, beside the noise."},
      {"scenario.spread.A", Type::not_negative, no, no, optional, {},
       "Each entry is multiplied by its own factor from 1 − this to 1 + this.", "0"},
      {"scenario.spread.B", Type::not_negative, no, no, optional, {}, "Likewise.", "0"},
      {"scenario.spread.C", Type::not_negative, no, no, optional, {}, "Likewise.", "0"},
      {"scenario.spread.x0", Type::vector, nx, no, optional, {},
       "Standard deviation of each state at the start, around `x0`.", "0"},
  });
  // clang-format on
  return keys;
}

std::vector<KeyRule> requirement_keys() {
  constexpr auto no = Size::none;
  constexpr auto nx = Size::nx;
  constexpr auto nu = Size::nu;
  constexpr auto ny = Size::ny;
  constexpr auto required = Need::required;
  constexpr auto optional = Need::optional;

  // clang-format off
  return {
      {"require", Type::table, no, no, optional, {},
       "Requirements on the loop, opened at the plant's inputs, and on what scenarios show. A design that misses one "
       "is refused.", "",
       "README.md#margins"},
      {"require.gain_margin_dB", Type::positive, no, no, optional, {}, "Least gain margin, in dB.", "none"},
      {"require.phase_margin_deg", Type::positive, no, no, optional, {}, "Least phase margin, in degrees.", "none"},
      {"require.disk_margin", Type::positive, no, no, optional, {}, "Least disk margin α, at most 2.", "none"},
      {"require.max_pole", Type::positive, no, no, optional, {},
       "Largest |z| of the poles of the closed loop.", "none"},
      {"require.delay_margin", Type::positive, no, no, optional, {}, "Least delay margin, in s.", "none"},
      {"require.scenario", Type::line, no, no, optional, {},
       "Name of the scenario in which the following have to hold.", "every scenario"},
      {"require.overshoot", Type::not_negative, no, no, optional, {},
       "Largest overshoot after a step of a reference, as a share of the step.", "none"},
      {"require.settling_time", Type::positive, no, no, optional, {},
       "Longest time in s until an output stays within 2 % of a step of its reference.", "none"},
      {"require.share_at_limits", Type::not_negative, no, no, optional, {},
       "Largest share of samples in which an input is at a limit, from 0 to 1.", "none"},
      {"require.rms", Type::tables, no, no, optional, {}, "Largest root mean squares."},
      {"require.rms.state", Type::signal, nx, no, optional, {},
       "Of this state. One of `state`, `input` and `output` is required."},
      {"require.rms.input", Type::signal, nu, no, optional, {}, "Of this input."},
      {"require.rms.output", Type::signal, ny, no, optional, {}, "Of this output, without its noise."},
      {"require.rms.value", Type::positive, no, no, required, {}, "The largest value, in the signal's unit."},
  };
  // clang-format on
}

}  // namespace lqg::input
