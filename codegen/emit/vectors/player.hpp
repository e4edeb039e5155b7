// SPDX-License-Identifier: MIT
// Plays the turns of the emitted test with the simulated controller, in the target's precision.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "emit/vectors/calls.hpp"

namespace lqg::emit {

class Hash;

struct Answer {
  unsigned events = 0;
  std::vector<double> results;
  std::vector<bool> at_limits;  // what a status does not tell of each input and integral
};

class Player {
 public:
  virtual ~Player() = default;
  virtual std::unique_ptr<Player> copy() const = 0;
  virtual Answer play(const Turn& turn) = 0;
  virtual void add_state(Hash& hash) const = 0;
  // The variances that are kept and not 0, each by its place in P or d.
  virtual std::vector<std::pair<int, double>> variances() const { return {}; }
};

// At the start; `samples` have to outlive it.
std::unique_ptr<Player> make_player(const Controller& controller, const std::vector<Sample>& samples);

}  // namespace lqg::emit
