// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <cmath>
#include <limits>
#include <map>

namespace lqg_test {

namespace {

// LQG_OK and three more of lqg/status.h.
const std::map<double, std::string> flags = {
    {0, "LQG_OK"}, {1, "LQG_OUTPUT_REJECTED"}, {4, "LQG_INNOVATION_NOT_POSITIVE"}, {8, "LQG_INPUT_LIMITED"}};

template <class T>
T random_value(Random& random) {
  using Limits = std::numeric_limits<T>;
  const T special[] = {0,
                       -T(0),
                       1,
                       -1,
                       2,
                       T(0.5),
                       Limits::min(),
                       Limits::denorm_min(),
                       Limits::max(),
                       Limits::lowest(),
                       Limits::infinity(),
                       -Limits::infinity(),
                       Limits::quiet_NaN(),
                       Limits::epsilon()};
  switch (random.below(8)) {
    case 0: return special[random.below(sizeof special / sizeof *special)];
    case 1: return random.pattern<T>();
    case 2: return static_cast<T>(random.between(-3, 3));
    default: return static_cast<T>(std::ldexp(random.uniform(), random.between(-6, 6)));
  }
}

template <class T>
double random_constant(Random& random) {
  if (random.one_in(2)) return random.between(-1, 1);
  for (;;) {
    const T value = random_value<T>(random);
    if (std::isfinite(value)) return static_cast<double>(value) + 0.0;
  }
}

int random_of_kind(Random& random, const Program& program, Kind wanted) {
  for (;;) {
    const int at = random.below(static_cast<int>(program.size()));
    if (kind(program, at) == wanted) return at;
  }
}

Operation random_operation(Random& random, const Program& program) {
  const auto number = [&] { return random_of_kind(random, program, Kind::number); };
  const auto condition = [&] { return random_of_kind(random, program, Kind::condition); };
  const auto status = [&] { return random_of_kind(random, program, Kind::status); };
  switch (random.below(16)) {
    case 0:
    case 1: return {Op::add, number(), number()};
    case 2:
    case 3: return {Op::subtract, number(), number()};
    case 4:
    case 5: return {Op::multiply, number(), number()};
    case 6: return {Op::divide, number(), number()};
    case 7: return {random.one_in(2) ? Op::negate : Op::absolute, number()};
    case 8:
    case 9: return {Op::multiply_add, number(), number(), number()};
    case 10:
    case 11: return {Op::multiply_subtract, number(), number(), number()};
    default: break;
  }
  switch (random.below(8)) {
    case 0: return {Op::finite, number()};
    case 1: return {Op::less, number(), number()};
    case 2: return {Op::usable, number(), number()};
    case 3: return {Op::same, status(), status()};
    case 4: return {Op::either, condition(), condition()};
    case 5: return {Op::negation, condition()};
    case 6: return {Op::select, condition(), status(), status()};
    default: return {Op::select, condition(), number(), number()};
  }
}

template <class T>
T apply_to(Op op, bool fused, T a, T b, T c) {
  const T product = a * b;
  switch (op) {
    case Op::add: return a + b;
    case Op::subtract: return a - b;
    case Op::multiply: return product;
    case Op::divide: return a / b;
    case Op::negate: return -a;
    case Op::absolute: return std::abs(a);
    case Op::multiply_add: return fused ? std::fma(a, b, c) : product + c;
    case Op::multiply_subtract: return fused ? std::fma(-a, b, c) : c - product;
    case Op::select: return a != 0 ? b : c;
    case Op::finite: return T(std::isfinite(a));
    case Op::less: return T(a < b);
    case Op::usable: return T(std::isfinite(a) && b > 0);
    case Op::same: return T(a == b);
    case Op::either: return T(a != 0 || b != 0);
    case Op::both: return T(a != 0 && b != 0);
    case Op::negation: return T(a == 0);
    default: return std::numeric_limits<T>::quiet_NaN();
  }
}

bool is_honest(const Program& program, const Results& results, std::size_t at) {
  const Operation& operation = program[at];
  const auto honest = [&](int operand) { return operand < 0 || results.is_honest[static_cast<std::size_t>(operand)]; };
  const auto is_input = [&](int operand) { return program[static_cast<std::size_t>(operand)].op == Op::input; };
  const auto value = [&](int operand) { return results.values[static_cast<std::size_t>(operand)]; };
  switch (operation.op) {
    case Op::select: return honest(operation.a) && honest(value(operation.a) != 0 ? operation.b : operation.c);
    case Op::finite: return honest(operation.a) || is_input(operation.a);
    case Op::usable: return (honest(operation.a) || is_input(operation.a)) && honest(operation.b);
    default:
      return std::isfinite(results.values[at]) && honest(operation.a) && honest(operation.b) && honest(operation.c);
  }
}

}  // namespace

Kind kind(const Program& program, int at) {
  const Operation& operation = program[static_cast<std::size_t>(at)];
  if (operation.op == Op::flag) return Kind::status;
  if (operation.op == Op::select) return kind(program, operation.b);
  return lqg::trace::is_condition(operation.op) ? Kind::condition : Kind::number;
}

Program random_program(Random& random, Target target, int inputs, int operations) {
  Program program;
  for (int i = 0; i < inputs; ++i) program.push_back({Op::input, -1, -1, -1, static_cast<double>(i)});
  for (int i = 0; i < inputs; ++i)
    program.push_back({Op::constant, -1, -1, -1,
                       target.is_double ? random_constant<double>(random) : random_constant<float>(random)});
  for (const auto& [value, text] : flags) program.push_back({Op::flag, -1, -1, -1, value});
  program.push_back({Op::finite, 0});
  for (int i = 0; i < operations; ++i) program.push_back(random_operation(random, program));
  return program;
}

double random_number(Random& random, Target target) {
  return target.is_double ? random_value<double>(random) : static_cast<double>(random_value<float>(random));
}

std::vector<int> record(const Program& program, Graph& graph) {
  std::vector<int> nodes;
  const auto node = [&](int operand) { return operand < 0 ? -1 : nodes[static_cast<std::size_t>(operand)]; };
  for (const Operation& operation : program) {
    const int i = static_cast<int>(operation.value);
    switch (operation.op) {
      case Op::input: nodes.push_back(graph.input(input_text(i), "in_" + std::to_string(i))); break;
      case Op::constant: nodes.push_back(graph.constant(operation.value)); break;
      case Op::flag: nodes.push_back(graph.flag(flag_text(operation.value))); break;
      default: nodes.push_back(graph.make(operation.op, node(operation.a), node(operation.b), node(operation.c)));
    }
  }
  return nodes;
}

double apply(Op op, Target target, double a, double b, double c) {
  if (target.is_double) return apply_to<double>(op, target.is_fused, a, b, c);
  return static_cast<double>(
      apply_to<float>(op, target.is_fused, static_cast<float>(a), static_cast<float>(b), static_cast<float>(c)));
}

Results evaluate(const Program& program, Target target, const std::vector<double>& inputs) {
  Results results;
  const auto value = [&](int operand) { return operand < 0 ? 0 : results.values[static_cast<std::size_t>(operand)]; };
  for (std::size_t at = 0; at < program.size(); ++at) {
    const Operation& operation = program[at];
    const bool is_given = operation.op == Op::constant || operation.op == Op::flag;
    results.values.push_back(is_given                    ? operation.value
                             : operation.op == Op::input ? inputs[static_cast<std::size_t>(operation.value)]
                                                         : apply(operation.op, target, value(operation.a),
                                                                 value(operation.b), value(operation.c)));
    results.is_honest.push_back(is_honest(program, results, at));
  }
  return results;
}

std::vector<double> interpret(const Graph& graph, const std::vector<double>& inputs) {
  std::map<std::string, double> known;
  for (std::size_t i = 0; i < inputs.size(); ++i) known[input_text(static_cast<int>(i))] = inputs[i];
  for (const auto& [value, text] : flags) known[text] = value;
  std::vector<double> values;
  const auto value = [&](int operand) { return operand < 0 ? 0 : values[static_cast<std::size_t>(operand)]; };
  for (const lqg::trace::Node& node : graph.nodes())
    values.push_back(node.op == Op::constant ? node.value
                     : node.op == Op::input || node.op == Op::flag
                         ? known.at(node.text)
                         : apply(node.op, graph.target(), value(node.a), value(node.b), value(node.c)));
  return values;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

std::string input_text(int i) { return "in[" + std::to_string(i) + "]"; }

std::string flag_text(double value) { return flags.at(value); }

}  // namespace lqg_test
