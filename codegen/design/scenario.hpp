// SPDX-License-Identifier: MIT
// What a loop has to live through: references, loads, failing sensors, weak actuators, a plant that is another one.
// Data only, as the design file states it; times in s, values in the signals' units.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lqg::design {

constexpr double forever = std::numeric_limits<double>::infinity();

// What is added to a signal: 0 before `at` and from `until` on. Between: `value`, reached within `ramp` in a straight
// line; a sine of that amplitude with `sine` Hz that begins with 0 at `at`; or `value` times the column of a file,
// which holds from one of its `times` (counted from `at`) to the next.
struct Course {
  int signal = 0;  // of the outputs, inputs or states
  double value = 1, at = 0, until = forever;
  double ramp = 0;
  double sine = 0;  // Hz; 0: none
  std::vector<double> times, column;
};

// Of an output, from … until, in s.
struct DropOut {
  int output = 0;
  double from = 0, until = forever;
};

// One sample, or all of those before `until`, says `value` in place of what is measured.
struct Outlier {
  int output = 0;
  double value = 0, at = 0;
  std::optional<double> until;
};

// y is late by `delay`; then gain y + bias; then to the nearest multiple of `quantum`; then within min … max.
struct Sensor {
  int output = 0;
  double gain = 1, bias = 0, delay = 0, quantum = 0;
  double min = -forever, max = forever;
};

// u within min … max, changing by at most `rate` per second, times `gain`, late by a first-order lag.
struct Actuator {
  int input = 0;
  double gain = 1, time_constant = 0, rate = forever;
  double min = -forever, max = forever;
};

// One entry, a row (column −1), a column (row −1) or all of A, B or C, multiplied.
struct ScaledEntries {
  char matrix = 'A';
  int row = -1, column = -1;
  double factor = 1;
};

// What of the plant is not as the design has it. Empty matrices: as there.
struct PlantChange {
  bool continuous = false;  // A and B are those of ẋ, in place of the samples of a discrete design
  Eigen::MatrixXd A, B, C;
  std::optional<double> delay;  // s, in place of plant.delay
  std::vector<ScaledEntries> scale;
  std::map<std::string, double> parameters;  // of the plant's equations, in place of the design's
};

// Of a Monte Carlo run: what differs from run to run.
struct Spread {
  double A = 0, B = 0, C = 0;  // each entry times a factor in 1 ± this, evenly
  Eigen::VectorXd x0;          // standard deviations; empty: none
};

struct Scenario {
  std::string name;
  double duration = 0;
  Eigen::VectorXd x0;              // of the plant's own states; empty: 0
  bool noise = true;               // w and v as the design has them
  std::vector<Course> reference;   // of outputs that follow one
  std::vector<Course> load;        // added to what an actuator does
  std::vector<Course> state_load;  // added to ẋ, or to x of the next sample of a discrete plant
  std::vector<Course> input;       // u, where there is no regulator
  std::vector<DropOut> dropout;
  std::vector<Outlier> outlier;
  std::vector<Sensor> sensor;
  std::vector<Actuator> actuator;
  PlantChange plant;
  Spread spread;
};

}  // namespace lqg::design
