// SPDX-License-Identifier: MIT
#include "emit/plan/registers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "trace/functions.hpp"

namespace lqg::emit {

namespace {

using trace::Node;
using trace::Op;

constexpr long bytes_of_instruction = 4;
constexpr long reach_of_pool =
    1500;  // bytes: a load reaches a pool 1020 bytes ahead or behind, which lies about in the middle
constexpr long never = std::numeric_limits<long>::max();

// ±n/16 · 2^e, n = 16 … 31, e = −3 … 4: a move holds it.
bool is_immediate(double value) {
  if (value == 0) return false;
  int exponent = 0;
  const double sixteenths = 32 * std::abs(std::frexp(value, &exponent));
  return sixteenths == std::floor(sixteenths) && exponent >= -2 && exponent <= 5;
}

bool is_sum_of_product(Op op) { return op == Op::multiply_add || op == Op::multiply_subtract; }

// Of the tables, which are read where they are needed: nothing writes to them.
bool is_of_table(const Node& node) { return node.text.rfind("gains[", 0) == 0 || node.text.rfind("law[", 0) == 0; }

// One instruction or call: the numbers that it reads, the one that it makes.
struct Step {
  std::vector<int> operands;
  int result = -1;
  int overwritten = -1;  // an operand whose register becomes that of the result
};

// The instructions in their order.
class Order {
 public:
  Order(const Listing& listing, Traffic& traffic)
      : listing_(listing), traffic_(traffic), made_(listing.nodes.size(), false) {}

  std::vector<Step> steps;
  std::map<std::string, long> stored;  // by its expression in C: the step after which the place holds another value

  void run() {
    load_inputs();
    std::multimap<int, const trace::Store*> ready;
    for (const trace::Store& store : listing_.stores)
      ready.emplace(listing_.declared[at(store.node)] ? store.node : -1, &store);
    for (int i = 0; i < static_cast<int>(listing_.nodes.size()); ++i) {
      if (!listing_.needed[at(i)] || !listing_.declared[at(i)] || node(i).op == Op::input) continue;
      if (is_late_input(i)) ++traffic_.inputs, steps.push_back({{}, i, -1});
      make(i);
      for (auto [store, end] = ready.equal_range(i); store != end; ++store) put(*store->second);
    }
    for (const auto& [i, store] : ready)
      if (i < 0 || node(i).op == Op::input || node(i).op == Op::resumed) put(*store);
    for (const int end : listing_.ends) make(end);
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const Node& node(int i) const { return listing_.nodes[at(i)]; }

  // Of a value that a recovery may write to: no instruction, unless it is read only behind it.
  bool is_same_variable(int i) const { return node(i).op == Op::resumed && listing_.needed[at(node(i).a)]; }
  bool is_late_input(int i) const { return node(i).op == Op::resumed && !is_same_variable(i); }

  bool is_number(int i) const {
    if (node(i).op == Op::select) return is_number(node(i).b);  // it may choose between statuses
    return node(i).op != Op::flag && !trace::is_condition(node(i).op);
  }

  void load_inputs() {
    for (int i = 0; i < static_cast<int>(listing_.nodes.size()); ++i) {
      if (!listing_.needed[at(i)] || node(i).op != Op::input) continue;
      ++(is_of_table(node(i)) ? traffic_.of_tables : traffic_.inputs);
      if (!is_of_table(node(i))) steps.push_back({{}, i, -1});
    }
  }

  void put(const trace::Store& store) {
    make(store.node);
    ++traffic_.stores;
    steps.push_back({{same(store.node)}, -1, -1});
    stored[store.target] = static_cast<long>(steps.size());
  }

  void make(int i) {
    const Op op = node(i).op;
    if (op == Op::constant || op == Op::input || op == Op::flag || made_[at(i)]) return;
    if (is_same_variable(i)) return make(node(i).a);
    if (op == Op::resumed) return;
    made_[at(i)] = true;
    Step step;
    for (const int operand : {node(i).a, node(i).b, node(i).c}) {
      if (operand < 0) continue;
      make(operand);
      if (is_number(operand)) step.operands.push_back(same(operand));
    }
    if (is_number(i)) step.result = i;
    const bool is_one = is_sum_of_product(op) && listing_.is_fused;
    if (is_one) step.overwritten = node(i).c;
    count(i, is_one);
    steps.push_back(std::move(step));
  }

  void count(int i, bool is_one) {
    constexpr long instructions_of_call = 3;
    if (trace::is_function(node(i).op)) traffic_.operations += instructions_of_call;
    switch (node(i).op) {
      case Op::multiply_add:
      case Op::multiply_subtract: traffic_.operations += is_one ? 1 : 2, traffic_.fused += is_one; break;
      case Op::negate: break;  // part of the operation before or after it
      case Op::finite:
      case Op::usable: ++traffic_.operations, ++traffic_.comparisons; break;
      case Op::less: ++traffic_.comparisons; break;
      case Op::select: ++(is_number(i) ? traffic_.selections : traffic_.status_selections); break;
      case Op::asked: ++traffic_.questions; break;
      case Op::add:
      case Op::subtract:
      case Op::multiply:
      case Op::divide:
      case Op::absolute: ++traffic_.operations; break;
      default: break;  // conditions are branches of the comparisons in them
    }
  }

  // Of constants of one value, whatever their names, the first.
  int same(int i) {
    if (is_same_variable(i)) return same(node(i).a);
    return node(i).op == Op::constant ? constants_.try_emplace(node(i).value, i).first->second : i;
  }

  const Listing& listing_;
  Traffic& traffic_;
  std::vector<bool> made_;
  std::map<double, int> constants_;
};

// The registers while the instructions run.
class Registers {
 public:
  Registers(const Listing& listing, const Order& order, long number, Traffic& traffic)
      : listing_(listing), order_(order), number_(static_cast<std::size_t>(number)), traffic_(traffic),
        values_(listing.nodes.size()) {
    for (std::size_t t = 0; t < order.steps.size(); ++t)
      for (const int operand : order.steps[t].operands) value(operand).uses.push_back(static_cast<long>(t));
  }

  void run() {
    for (std::size_t t = 0; t < order_.steps.size(); ++t) {
      const Step& step = order_.steps[t];
      step_ = static_cast<long>(t);
      for (const int operand : step.operands) bring(operand, step.operands);
      for (const int operand : step.operands) pass(operand, static_cast<long>(t));
      if (step.overwritten >= 0 && next_use(step.overwritten) != never) ++traffic_.moves;
      for (const int operand : step.operands)
        if (next_use(operand) == never) drop(operand);
      if (step.result >= 0 && !value(step.result).uses.empty()) hold(step.result, step.operands);
    }
  }

 private:
  struct Value {
    std::vector<long> uses;
    std::size_t used = 0;  // so many of them are past
    bool is_held = false, has_slot = false;
    long pooled = -1;  // of a constant: the instruction from which on it is in reach
  };

  Value& value(int i) { return values_[static_cast<std::size_t>(i)]; }
  const Node& node(int i) const { return listing_.nodes[static_cast<std::size_t>(i)]; }

  bool is_input(int i) const { return node(i).op == Op::input || node(i).op == Op::resumed; }

  long next_use(int i) { return value(i).used < value(i).uses.size() ? value(i).uses[value(i).used] : never; }

  void pass(int i, long step) {
    while (value(i).used < value(i).uses.size() && value(i).uses[value(i).used] <= step) ++value(i).used;
  }

  // It stands in memory anyway, and nothing is written there before its last use.
  bool is_in_memory(int i) {
    if (node(i).op == Op::constant) return true;
    if (!is_input(i)) return false;
    if (listing_.asks) return is_of_table(node(i));
    const auto overwritten = order_.stored.find(node(i).text);
    return overwritten == order_.stored.end() || value(i).uses.back() < overwritten->second;
  }

  void bring(int i, const std::vector<int>& kept) {
    if (value(i).is_held) return;
    make_room(kept);
    if (node(i).op == Op::constant)
      load_constant(i);
    else if (value(i).has_slot)
      ++traffic_.reloads;
    else if (is_input(i))
      ++traffic_.loads;
    occupy(i);
  }

  // An input that finds no room and can be loaded later is.
  void hold(int i, const std::vector<int>& kept) {
    if (is_input(i) && is_in_memory(i) && held_.size() >= number_) return;
    traffic_.loads += is_input(i);
    make_room(kept);
    occupy(i);
  }

  void occupy(int i) {
    value(i).is_held = true;
    held_.insert(i);
    traffic_.registers = std::max(traffic_.registers, static_cast<long>(held_.size()));
  }

  void load_constant(int i) {
    if (is_immediate(node(i).value)) {
      ++traffic_.immediates;
      return;
    }
    ++traffic_.constant_loads;
    if (value(i).pooled >= 0 && bytes_so_far() - value(i).pooled < reach_of_pool) return;
    ++traffic_.pool;
    value(i).pooled = bytes_so_far();
  }

  // The operations are counted beforehand: each step is about one.
  long bytes_so_far() const {
    return bytes_of_instruction *
           (traffic_.loads + traffic_.reloads + traffic_.spills + traffic_.constant_loads + step_);
  }

  void drop(int i) {
    held_.erase(i);
    value(i).is_held = false;
    if (value(i).has_slot) --slots_;
    value(i).has_slot = false;
  }

  // How long until its next use; longer for what need not be stored first, and, where nothing is called, for constants:
  // there GCC loads them again rather than keep them.
  long wait_of(int i) {
    if (next_use(i) == never) return never;
    const long times = node(i).op == Op::constant && !listing_.asks ? 32 : value(i).has_slot || is_in_memory(i) ? 4 : 1;
    return times * (next_use(i) - step_);
  }

  void make_room(const std::vector<int>& kept) {
    while (held_.size() >= number_) {
      int victim = -1;
      long longest = -1;
      for (const int i : held_) {
        if (std::find(kept.begin(), kept.end(), i) != kept.end()) continue;
        const long wait = wait_of(i);
        if (wait > longest) longest = wait, victim = i;
      }
      if (victim < 0) return;
      spill(victim);
    }
  }

  void spill(int i) {
    held_.erase(i);
    value(i).is_held = false;
    if (is_in_memory(i) || value(i).has_slot) return;
    ++traffic_.spills;
    value(i).has_slot = true;
    traffic_.slots = std::max(traffic_.slots, ++slots_);
  }

  const Listing& listing_;
  const Order& order_;
  std::size_t number_;
  Traffic& traffic_;
  std::vector<Value> values_;
  std::set<int> held_;
  long slots_ = 0;
  long step_ = 0;  // at which the machine is
};

}  // namespace

Traffic traffic_of(const Listing& listing, long registers) {
  Traffic traffic;
  Order order(listing, traffic);
  order.run();
  Registers(listing, order, registers, traffic).run();
  return traffic;
}

long values_at_once(const Listing& listing) { return traffic_of(listing, std::numeric_limits<long>::max()).registers; }

}  // namespace lqg::emit
