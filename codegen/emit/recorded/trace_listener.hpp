// SPDX-License-Identifier: MIT
// From a step that runs over symbols to a TracedFunction: who listens to it, what it loads and stores.
#pragma once

#include "emit/recorded/constants.hpp"
#include "emit/recorded/place_names.hpp"
#include "emit/recorded/traced.hpp"
#include "step/model.hpp"
#include "trace/expr.hpp"

namespace lqg::emit {

using Symbols = step::Vector<trace::Expr>;

// Hears the names and equations of a step and keeps them in the graph.
class TraceListener {
 public:
  TraceListener(const Controller& controller, TracedFunction& function)
      : controller_(controller), function_(function) {}

  void section(const std::string& equation, int output = -1, const char* supplement = "");
  template <class Value>  // Expr or Condition
  void name(const Value& value, const char* base, const step::Place& place = {}) {
    function_.graph->name(value.node, base + suffix(place));
  }
  template <class Value>
  void hint(const Value& value, const char* base, const step::Place& place = {}) {
    function_.graph->hint(value.node, base + suffix(place));
  }
  trace::Expr constant(const trace::Expr& value, step::Quantity quantity, int i = -1) const {
    return named(controller_, value, quantity, i);
  }
  void raise(step::Event event, const trace::Condition& condition);
  // The fault is decided where it is found and asked for afterwards: one comparison on the way of an honest output.
  trace::Condition accept(const trace::Condition& usable, int output);
  trace::Condition accept(const trace::Condition& usable, const trace::Condition& believable, int output);
  trace::Condition without(step::Event event, const trace::Condition& condition);
  void gate(const trace::Condition& gated, int output);
  // NAME_weigh answers where the innovation is not as expected.
  template <class Variance, class Otherwise>
  trace::Condition weigh(const trace::Condition& expected, int output, const trace::Expr& innovation, Variance variance,
                         Otherwise) {
    return ask_weigh(expected, output, innovation, trace::Expr(variance()));
  }

 private:
  // In the block of an output its name stands behind each value already.
  std::string suffix(const step::Place& place) const {
    return place.kind == step::Place::Kind::output && is_of_output_ ? "" : suffix_of(controller_, place);
  }
  trace::Condition ask_weigh(const trace::Condition& expected, int output, const trace::Expr& innovation,
                             const trace::Expr& variance);
  int flag_ok() { return function_.graph->flag("LQG_OK"); }
  int choice(const trace::Condition& condition, int yes, int no);
  trace::Condition accept_or(const trace::Condition& usable, int fault);

  const Controller& controller_;
  TracedFunction& function_;
  bool is_of_output_ = false;  // the block
};

// "LQG_STATE_RESET"
std::string status_name(step::Event event);

// "(LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(0))", of a negative output that of i.
std::string rejection(int output);

// With an empty graph for the target's numbers.
TracedFunction new_function(const Controller& controller);

// "array[i]"
std::string element(const std::string& array, int i);

inline step::Place at_state(int i) { return step::of_state(i); }
inline step::Place at_input(int i) { return step::of_input(i); }
inline step::Place at_output(int i) { return step::of_output(i); }
inline step::Place at_integral(int i) { return step::of_integral(i); }
inline step::Place at_reference(int i) { return step::of_reference(i); }
inline step::Place at_entry(int i) { return step::of_entry(i); }

// array[0], array[1] … as inputs, each with the name of its place.
Symbols load(const Controller& controller, const std::string& array, const std::string& name, int size,
             step::Place (*place)(int));

// Nothing where it is what was loaded from there.
void store(TracedFunction& function, const std::string& target, const trace::Expr& value);

}  // namespace lqg::emit
