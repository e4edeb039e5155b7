// SPDX-License-Identifier: MIT
#include "emit/recorded/constants.hpp"

#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include "controller/model_of.hpp"
#include "controller/operating_point.hpp"
#include "emit/recorded/symbols.hpp"
#include "emit/text/wording.hpp"
#include "step/state.hpp"
#include "trace/print.hpp"

namespace lqg::emit {

namespace {

using step::Quantity;

const char* word_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::u_min: return "U_MIN";
    case Quantity::u_max: return "U_MAX";
    case Quantity::u_step: return "U_STEP";
    case Quantity::y_min: return "Y_MIN";
    case Quantity::y_max: return "Y_MAX";
    case Quantity::innovation_limit: return "INNOVATION_LIMIT";
    case Quantity::innovation_limit_squared: return "LIMIT_SQUARED";
    case Quantity::innovation_variance: return "INNOVATION_VARIANCE";
    case Quantity::gate: return "GATE";
    case Quantity::gate_squared: return "GATE_SQUARED";
    case Quantity::gate_widen: return "GATE_WIDEN";
    case Quantity::gate_narrow: return "GATE_NARROW";
    case Quantity::threshold: return "THRESHOLD";
    case Quantity::error_limit: return "ERROR_LIMIT";
    case Quantity::point_x: return "OPERATING_X";
    case Quantity::point_u: return "OPERATING_U";
    case Quantity::point_y: return "OPERATING_Y";
    default: return "SAMPLE_TIME";
  }
}

bool is_of_input(Quantity quantity) {
  return quantity == Quantity::u_min || quantity == Quantity::u_max || quantity == Quantity::u_step ||
         quantity == Quantity::point_u;
}

design::Signal signal_of(const Controller& controller, Quantity quantity, int i) {
  const design::Plant& plant = controller.problem.plant;
  const auto at = static_cast<std::size_t>(i);
  if (is_of_input(quantity)) return plant.inputs[at];
  if (quantity == Quantity::point_x) return state_signals(controller)[at];
  return plant.outputs[quantity == Quantity::error_limit ? static_cast<std::size_t>(controller.integrated[at]) : at];
}

// What the variance of innovation i may be in the step: with a P of its own that of v alone, where row i of C is 0.
std::vector<trace::Expr> possible_variances(const Controller& controller, const SymbolicModel& model,
                                            trace::Graph& graph, int i) {
  if (controller.filter == step::Filter::steady) return {model.variance(i)};
  if (controller.filter == step::Filter::ud) return {model.V(i)};
  return {trace::Expr::of(graph.input("S", "S")), model.V(i)};
}

std::map<std::string, double> values_named_in(const trace::Graph& graph) {
  std::map<std::string, double> values;
  for (const auto& [name, node] : graph.named_constants())
    values[name] = graph.nodes()[static_cast<std::size_t>(node)].value;
  return values;
}

// The names and values of all that is no power of two, as the code has them.
std::map<std::string, double> values_of(const Controller& controller) {
  if (controller.linear && !has_point(controller)) return {};
  TracedFunction function = new_function(controller);
  const trace::Recording recording(*function.graph);
  if (controller.linear) {
    (void)symbolic_point(controller);
    return values_named_in(*function.graph);
  }
  const SymbolicModel model = symbolic_model(controller);
  for (int i = 0; i < controller.size.ny && controller.has.gate; ++i) {  // thresholds are made in the step
    TraceListener listener(controller, function);
    SymbolicState state;
    load_memory(controller, model, state);
    const trace::Expr innovation = trace::Expr::of(function.graph->input("innovation", "innovation"));
    (void)named(controller, model.nu_limit(0), Quantity::innovation_limit);  // that all outputs have
    for (const trace::Expr& variance : possible_variances(controller, model, *function.graph, i))
      step::weigh(model, state, innovation, variance, [&] { return variance; }, i, listener);
  }
  return values_named_in(*function.graph);
}

bool is_of_name(char c) {
  return c == '_' || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

bool uses(const std::string& text, const std::string& name) {
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const bool begins = at == 0 || !is_of_name(text[at - 1]), ends = !is_of_name(text[at + name.size()]);
    if (begins && ends) return true;
  }
  return false;
}

std::string power(double value) { return "2^" + std::to_string(static_cast<int>(std::lround(std::log2(value)))); }

// "limits.u_max = 0.27", and what the target makes of it.
std::string limit(const std::string& key, double given, double value) {
  const std::string text = key + " = " + (std::isinf(given) ? "none" : trace::literal(given, true));
  return given == value || std::isinf(given) ? text : text + ", rounded inwards";
}

// Likewise, where the code has it as a deviation from the operating point.
std::string limit(const Controller& controller, const std::string& key, const Eigen::VectorXd& given, Quantity of_point,
                  const Eigen::VectorXd& point, int i, double value) {
  if (point.size() == 0 || point(i) == 0 || std::isinf(given(i))) return limit(key, given(i), value);
  return key + " = " + trace::literal(given(i), true) + " less " + constant_name(controller, of_point, i);
}

std::string point_key(const char* list, int i) {
  return std::string("plant.operating_point.") + list + "[" + std::to_string(i) + "]";
}

// Of states that are not the plant's, too.
std::string origin_of_state(const Controller& controller, int i) {
  return i < controller.problem.plant.A.rows() ? point_key("states", i) : "plant.operating_point";
}

std::string threshold(const Controller& controller, int i) {
  const double limit = controller.bounds.innovation(i);
  return "min(" + decimal(controller.gate.sigma) + (controller.solution.online ? "² V, " : "² S, ") +
         power(limit * limit) + "), for innovation²";
}

std::string origin(const Controller& controller, Quantity quantity, int i, double value) {
  const auto& limits = controller.problem.limits;
  const auto& estimator = controller.problem.estimator;
  switch (quantity) {
    case Quantity::u_min:
      return limit(controller, "limits.u_min", controller::own_input_limits(controller, +1), Quantity::point_u,
                   controller.point.u, i, value);
    case Quantity::u_max:
      return limit(controller, "limits.u_max", controller::own_input_limits(controller, -1), Quantity::point_u,
                   controller.point.u, i, value);
    case Quantity::u_step:
      if (std::isinf(limits->u_rate(i))) return "no limit: the largest number";
      return "limits.u_rate = " + trace::literal(limits->u_rate(i), true) + " times sample_time, rounded down";
    case Quantity::y_min:
      return limit(controller, "kalman.output_min", controller::own_output_range(controller, +1), Quantity::point_y,
                   controller.point.y, i, value);
    case Quantity::y_max:
      return limit(controller, "kalman.output_max", controller::own_output_range(controller, -1), Quantity::point_y,
                   controller.point.y, i, value);
    case Quantity::point_x: return origin_of_state(controller, i);
    case Quantity::point_u: return point_key("inputs", i);
    case Quantity::point_y: return point_key("outputs", i);
    case Quantity::innovation_limit: return power(value) + ": |innovation| is below it, or rejected";
    case Quantity::innovation_limit_squared: return power(value) + ": the innovation limit squared";
    case Quantity::innovation_variance: return "S = C P Cᵀ + V, steady";
    case Quantity::gate: return std::string("σ, ") + controller::key_of_sigma(*estimator);
    case Quantity::gate_squared:
      return decimal(controller.gate.sigma) + "²: " + controller::key_of_sigma(*estimator) + " squared";
    case Quantity::gate_widen: return "factor of w in a sample that rejects the output";
    case Quantity::gate_narrow: return "factor of w in a sample that uses the output";
    case Quantity::threshold: return threshold(controller, i);
    case Quantity::error_limit: return power(value) + ": |r − y| is below it, or not integrated";
    default: return "plant.sample_time";
  }
}

// A square of the signal's unit for variances and thresholds, none for factors.
std::string unit_of(const Controller& controller, Quantity quantity, int i) {
  if (i < 0 || quantity == Quantity::gate_widen || quantity == Quantity::gate_narrow) return "";
  const std::string unit = signal_of(controller, quantity, i).unit;
  const bool is_squared = quantity == Quantity::innovation_limit_squared || quantity == Quantity::threshold ||
                          quantity == Quantity::innovation_variance;
  if (unit.empty()) return "";
  const bool is_simple = unit.find_first_of(" */^(") == std::string::npos;
  return (!is_squared ? unit : is_simple ? unit + "²" : "(" + unit + ")²") + ", ";
}

// The powers of two that a text names, in their order.
std::set<int> powers_in(const std::string& text, const std::string& prefix) {
  static const std::string word = "TWO_TO_", minus = "MINUS_";
  std::set<int> exponents;
  for (std::size_t at = text.find(prefix + word); at != std::string::npos; at = text.find(prefix + word, at + 1)) {
    if (at > 0 && is_of_name(text[at - 1])) continue;
    std::size_t number = at + prefix.size() + word.size();
    const bool is_negative = text.compare(number, minus.size(), minus) == 0;
    if (is_negative) number += minus.size();
    int exponent = 0;
    const std::from_chars_result end = std::from_chars(text.data() + number, text.data() + text.size(), exponent);
    if (end.ec == std::errc() && end.ptr != text.data() + text.size() && !is_of_name(*end.ptr))
      exponents.insert(is_negative ? -exponent : exponent);
  }
  return exponents;
}

void add_powers(const std::string& text, const Controller& controller, std::vector<Constant>& out) {
  const std::string name = upper(controller.problem.name) + "_";
  for (const int exponent : powers_in(text, name))
    out.push_back({name + name_of_power(exponent),
                   trace::literal(std::ldexp(1.0, exponent), controller.target.is_double),
                   "2^" + std::to_string(exponent)});
}

}  // namespace

std::string name_of_power(int exponent) {
  return std::string("TWO_TO_") + (exponent < 0 ? "MINUS_" : "") + std::to_string(std::abs(exponent));
}

std::string constant_name(const Controller& controller, Quantity quantity, int i) {
  const std::string word = word_of(quantity);
  return i < 0 ? word : word + "_" + upper(signal_of(controller, quantity, i).name);
}

trace::Expr named(const Controller& controller, const trace::Expr& value, Quantity quantity, int i) {
  const trace::Node& node = trace::graph().nodes()[static_cast<std::size_t>(value.node)];
  if (node.op != trace::Op::constant || !std::isfinite(node.value)) return value;
  return trace::Expr::of(trace::graph().constant(node.value, constant_name(controller, quantity, i)));
}

std::vector<Constant> constants_of(const Controller& controller, const std::string& text) {
  std::vector<Constant> out;
  const std::map<std::string, double> values = values_of(controller);
  const auto add = [&](Quantity quantity, int i) {
    const std::string name = upper(controller.problem.name) + "_" + constant_name(controller, quantity, i);
    const auto at = values.find(name);
    const bool is_limit = quantity <= Quantity::y_max;
    if (at == values.end() || !(is_limit || uses(text, name)) || quantity == Quantity::sample_time) return;
    const double value = at->second;
    const std::string literal = trace::literal(value, controller.target.is_double);
    out.push_back({name, value < 0 ? "(" + literal + ")" : literal,
                   unit_of(controller, quantity, i) + origin(controller, quantity, i, value)});
  };
  for (int i = 0; i < controller.size.nu; ++i)
    for (const Quantity quantity : {Quantity::u_min, Quantity::u_max, Quantity::u_step}) add(quantity, i);
  for (int i = 0; i < controller.size.ny; ++i)
    for (const Quantity quantity : {Quantity::y_min, Quantity::y_max}) add(quantity, i);
  for (int i = 0; i < controller.size.nxi; ++i) add(Quantity::error_limit, i);
  for (int i = 0; i < controller.size.nx; ++i) add(Quantity::point_x, i);
  for (int i = 0; i < controller.size.nu; ++i) add(Quantity::point_u, i);
  for (int i = 0; i < controller.problem.plant.C.rows(); ++i) add(Quantity::point_y, i);
  add(Quantity::gate, -1);
  add(Quantity::gate_squared, -1);
  add(Quantity::innovation_limit, -1);
  for (int i = -1; i < controller.size.ny; ++i) {
    if (i >= 0)
      for (const Quantity quantity : {Quantity::innovation_limit, Quantity::innovation_limit_squared,
                                      Quantity::innovation_variance, Quantity::threshold})
        add(quantity, i);
    add(Quantity::gate_widen, i);
    add(Quantity::gate_narrow, i);
  }
  add_powers(text, controller, out);
  return out;
}

}  // namespace lqg::emit

namespace lqg::step {

trace::Expr PowerOfTwo<trace::Expr>::of(int exponent) {
  return trace::Expr::of(trace::graph().constant(std::ldexp(1.0, exponent), emit::name_of_power(exponent)));
}

}  // namespace lqg::step
