// SPDX-License-Identifier: MIT
#include "emit/recorded/trace_listener.hpp"

#include "emit/text/text.hpp"

namespace lqg::emit {

using trace::Condition;

std::string status_name(step::Event event) {
  if (event >= step::Event::first_rejected)
    return "LQG_OUTPUT_REJECTED_BIT(" +
           std::to_string(static_cast<int>(event) - static_cast<int>(step::Event::first_rejected)) + ")";
  switch (event) {
    case step::Event::output_rejected: return "LQG_OUTPUT_REJECTED";
    case step::Event::innovation_not_positive: return "LQG_INNOVATION_NOT_POSITIVE";
    case step::Event::input_limited: return "LQG_INPUT_LIMITED";
    case step::Event::output_gated: return "LQG_OUTPUT_GATED";
    case step::Event::reference_not_finite: return "LQG_REFERENCE_NOT_FINITE";
    case step::Event::covariance_reset: return "LQG_COVARIANCE_RESET";
    case step::Event::not_optimal: return "LQG_NOT_OPTIMAL";
    default: return "LQG_STATE_RESET";
  }
}

std::string rejection(int output) {
  return "(LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(" + (output < 0 ? "i" : std::to_string(output)) + "))";
}

namespace {

// A filter that keeps z: the equations are those of x̂.
std::string of_what_is_kept(const Controller& controller, std::string equation) {
  static const std::string x = "x̂";
  for (std::size_t at = equation.find(x); controller.modal && at != std::string::npos; at = equation.find(x, at))
    equation.replace(at, x.size(), "z");
  return equation;
}

}  // namespace

void TraceListener::section(const std::string& of_estimate, int output, const char* supplement) {
  const bool is_of_both = of_estimate.find("T z") != std::string::npos;
  const std::string equation = is_of_both ? of_estimate : of_what_is_kept(controller_, of_estimate);
  is_of_output_ = output >= 0;
  if (output < 0) return function_.graph->section(equation + of_what_is_kept(controller_, supplement), "");
  const design::Signal& signal = controller_.problem.plant.outputs[static_cast<std::size_t>(output)];
  const std::string unit = signal.unit.empty() ? "" : " [" + signal.unit + "]";
  function_.graph->section(
      "output " + std::to_string(output) + ", " + signal.name + unit + ": " + equation + supplement, "_" + signal.name);
}

void TraceListener::raise(step::Event event, const Condition& condition) {
  if (!function_.graph->is_constant(condition.node, 0))
    function_.statuses.push_back(choice(condition, function_.graph->flag(status_name(event)), flag_ok()));
}

Condition TraceListener::accept(const Condition& usable, int output) {
  return accept_or(usable, function_.graph->flag(rejection(output)));
}

Condition TraceListener::accept(const Condition& usable, const Condition& believable, int output) {
  const int one = function_.graph->flag(status_name(step::Event::innovation_not_positive)),
            other = function_.graph->flag(rejection(output));
  return accept_or(usable, choice(believable, one, other));
}

// The status knows: no condition has to wait for the end of the function.
Condition TraceListener::without(step::Event event, const Condition& condition) {
  function_.faults = status_name(event);
  return condition;
}

void TraceListener::gate(const Condition& gated, int) {
  raise(step::Event::output_gated, gated);
  function_.gates.push_back(gated.node);
}

Condition TraceListener::ask_weigh(const Condition& expected, int output, const trace::Expr& innovation,
                                   const trace::Expr& variance) {
  const std::string call = controller_.problem.name + "_weigh(self, " + std::to_string(output);
  function_.asked.push_back(
      function_.graph->ask(expected.node, call, innovation.node, variance.node, controller_.bounds.innovation(output)));
  return {function_.asked.back()};
}

int TraceListener::choice(const Condition& condition, int yes, int no) {
  return function_.graph->make(trace::Op::select, condition.node, yes, no);
}

Condition TraceListener::accept_or(const Condition& usable, int fault) {
  const int status = choice(usable, flag_ok(), fault);
  function_.graph->name(status, "fault");
  function_.statuses.push_back(status);
  const int same = function_.graph->make(trace::Op::same, status, flag_ok());
  function_.graph->name(same, "usable");
  return {same};
}

TracedFunction new_function(const Controller& controller) {
  TracedFunction function;
  function.graph = std::make_shared<trace::Graph>(trace::Target{controller.target.is_double, controller.target.is_fused,
                                                                controller.target.is_prover, controller.target.is_lane},
                                                  upper(controller.problem.name) + "_");
  function.graph->reserve(reserved_names(controller));
  return function;
}

std::string element(const std::string& array, int i) { return array + "[" + std::to_string(i) + "]"; }

Symbols load(const Controller& controller, const std::string& array, const std::string& name, int size,
             step::Place (*place)(int)) {
  Symbols symbols(size);
  for (int i = 0; i < size; ++i)
    symbols(i) = trace::Expr::of(trace::graph().input(element(array, i), name + suffix_of(controller, place(i))));
  return symbols;
}

void store(TracedFunction& function, const std::string& target, const trace::Expr& value) {
  const trace::Node& node = function.graph->nodes()[static_cast<std::size_t>(value.node)];
  if (node.op == trace::Op::input && node.text == target) return;  // as it was
  if (node.op == trace::Op::resumed) {
    const trace::Node& before = function.graph->nodes()[static_cast<std::size_t>(node.a)];
    if (before.op == trace::Op::input && before.text == target) return;
  }
  function.stores.push_back({target, value.node});
}

}  // namespace lqg::emit
