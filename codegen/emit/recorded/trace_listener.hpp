// SPDX-License-Identifier: MIT
// From a step that runs over symbols to a TracedFunction: who listens to it, what it loads and stores.
#pragma once

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

  void section(const std::string& equation, int output = -1);
  template <class Value>  // Expr or Condition
  void name(const Value& value, const char* base, int i = -1, int j = -1) {
    function_.graph->name(value.node, base + index_suffix(i, j, controller_.size.nx));
  }
  void raise(step::Event event, const trace::Condition& condition);
  // The fault is decided where it is found and asked for afterwards: one comparison on the way of an honest output.
  trace::Condition accept(const trace::Condition& usable, int output);
  trace::Condition accept(const trace::Condition& usable, const trace::Condition& believable, int output);
  trace::Condition without(step::Event event, const trace::Condition& condition);
  void gate(const trace::Condition& gated, int output);
  // NAME_weigh answers where the innovation is not as expected.
  template <class Variance, class Otherwise>
  trace::Condition weigh(const trace::Condition& expected, int output, const trace::Expr& nu, Variance variance,
                         Otherwise) {
    return ask_weigh(expected, output, nu, trace::Expr(variance()));
  }

 private:
  trace::Condition ask_weigh(const trace::Condition& expected, int output, const trace::Expr& nu,
                             const trace::Expr& variance);
  int flag_ok() { return function_.graph->flag("LQG_OK"); }
  int choice(const trace::Condition& condition, int yes, int no);
  trace::Condition accept_or(const trace::Condition& usable, int fault);

  const Controller& controller_;
  TracedFunction& function_;
};

// "LQG_STATE_RESET"
std::string status_name(step::Event event);

// "(LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(0))", of a negative output that of i.
std::string rejection(int output);

// With an empty graph for the target's numbers.
TracedFunction new_function(const Controller& controller);

// "array[i]"
std::string element(const std::string& array, int i);

// array[0], array[1] … as inputs name_0, name_1 …
Symbols load(trace::Graph& graph, const std::string& array, const std::string& name, int size);

// Nothing where it is what was loaded from there.
void store(TracedFunction& function, const std::string& target, const trace::Expr& value);

}  // namespace lqg::emit
