// SPDX-License-Identifier: MIT
#include "emit/plan/instructions.hpp"

#include <array>
#include <cmath>
#include <map>

namespace lqg::emit {

namespace {

using trace::Op;

// What the numbers below are of: NAME_step of 20 shipped and 60 random designs (test/bench/random_design.awk, seeds 1
// to 60; 17 more with fused constant gains), counted under QEMU by test/bench/run.sh, fitted by least squares of
// relative errors. The largest error is 16 % with an FPU, 10 % without.

// ---- software: the C library computes, in a call for each operation

// Instructions of a call, and of an input with its loads and stores.
struct LibraryCosts {
  double add, multiply, divide, compare, input;
};
struct SoftFloats {
  LibraryCosts floats, doubles;
};
constexpr SoftFloats armv6_m = {{91, 103, 302, 45, 34}, {174, 259, 295, 35, 168}};
constexpr SoftFloats armv7_m = {{69, 21, 136, 44, 17}, {83, 37, 520, 52, 45}};
constexpr SoftFloats riscv = {{78, 107, 100, 44, 8}, {120, 180, 300, 16, 121}};

double of_calls(const Listing& listing, const LibraryCosts& calls) {
  double sum = 0;
  for (std::size_t i = 0; i < listing.nodes.size(); ++i) {
    if (!listing.needed[i]) continue;
    switch (listing.nodes[i].op) {
      case Op::add:
      case Op::subtract: sum += calls.add; break;
      case Op::multiply: sum += calls.multiply; break;
      case Op::multiply_add:
      case Op::multiply_subtract: sum += calls.add + calls.multiply; break;
      case Op::divide: sum += calls.divide; break;
      case Op::less:
      case Op::finite:
      case Op::usable: sum += calls.compare; break;
      case Op::input: sum += calls.input; break;
      default: break;
    }
  }
  return sum;
}

// ---- hardware

// Instructions of each count of the traffic; `decision`: a selection, a question, a condition of two.
struct Weights {
  double operation, load, reload, constant, comparison, decision, call;
};
struct Unit {
  Weights online, steady, steady_fused;  // with the covariance carried along; with constant gains
  long registers;                        // one is left for what is being made
};
constexpr Unit arm_floats = {
    {0.85, 2.0, 2.0, 1.79, 0, 3.75, 0}, {1.19, 0.77, 2.0, 0, 0, 3.25, 21}, {1.44, 0, 1.25, 1.02, 0, 2.63, 14.5}, 31};
constexpr Weights any_double = {0.3, 3.19, 2.35, 1.98, 0, 3.91, 0};
constexpr Unit arm_doubles = {any_double, any_double, any_double, 15};
constexpr Unit riscv_numbers = {{0.84, 1.63, 2.03, 3.4, 1.04, 2.37, 0},
                                {1.07, 2.86, 7.37, 2.06, 0, 2.23, 9.6},
                                {1.67, 0, 5.16, 1.59, 0, 3.39, 13.4},
                                31};

long decisions_in(const Listing& listing) {
  long decisions = 0;
  for (std::size_t i = 0; i < listing.nodes.size(); ++i) {
    const Op op = listing.nodes[i].op;
    decisions += listing.needed[i] && (op == Op::select || op == Op::asked || op == Op::either || op == Op::both);
  }
  return decisions;
}

double in_unit(const Listing& listing, const Unit& unit, const Traffic& traffic) {
  const Weights& weights = listing.carries != Carried::nothing ? unit.online
                           : listing.is_fused                  ? unit.steady_fused
                                                               : unit.steady;
  return weights.operation * static_cast<double>(traffic.operations) +
         weights.load * static_cast<double>(traffic.loads) + weights.reload * static_cast<double>(traffic.reloads) +
         weights.constant * static_cast<double>(traffic.constant_loads) +
         weights.comparison * static_cast<double>(traffic.comparisons) +
         weights.decision * static_cast<double>(decisions_in(listing)) + weights.call;
}

// ---- the cores

struct Core {
  const char* port;
  const SoftFloats& library;
  const Unit *floats, *doubles;  // null: the library computes
};
constexpr std::array<Core, 9> cores = {{{"cortex-m0", armv6_m, nullptr, nullptr},
                                        {"cortex-m3", armv7_m, nullptr, nullptr},
                                        {"cortex-m4f", armv7_m, &arm_floats, nullptr},
                                        {"cortex-m7", armv7_m, &arm_floats, &arm_doubles},
                                        {"cortex-m33", armv7_m, &arm_floats, nullptr},
                                        {"cortex-m55", armv7_m, &arm_floats, &arm_doubles},
                                        {"rv32", riscv, nullptr, nullptr},
                                        {"rv32f", riscv, &riscv_numbers, nullptr},
                                        {"rv64", riscv, &riscv_numbers, &riscv_numbers}}};

}  // namespace

std::vector<controller::CoreInstructions> instructions_of(const Listing& listing, bool is_double) {
  std::vector<controller::CoreInstructions> all;
  std::map<long, Traffic> traffic;  // by the number of registers
  for (const Core& core : cores) {
    const Unit* unit = is_double ? core.doubles : core.floats;
    if (unit) {
      const auto [found, is_new] = traffic.try_emplace(unit->registers);
      if (is_new) found->second = traffic_of(listing, unit->registers);
      all.push_back({core.port, std::lround(in_unit(listing, *unit, found->second))});
    }
    if (!unit && !listing.is_fused)
      all.push_back(
          {core.port, std::lround(of_calls(listing, is_double ? core.library.doubles : core.library.floats))});
  }
  return all;
}

}  // namespace lqg::emit
