// SPDX-License-Identifier: MIT
#include "trace/print.hpp"

#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "trace/consequences.hpp"
#include "trace/functions.hpp"
#include "trace/names.hpp"
#include "trace/wrap.hpp"

namespace lqg::trace {

namespace {

// How tightly an operator binds; an operand that binds less gets brackets.
enum Level { any = 0, logical = 1, comparison = 2, sum = 3, product = 4, unary = 5 };

std::string bracketed(const std::string& text, int binds, int level) { return binds < level ? "(" + text + ")" : text; }

// x - x
bool prints_twice(const Node& node, int operand) {
  return node.op == Op::finite || (node.op == Op::usable && operand == node.a);
}

}  // namespace

std::string literal(double value, bool is_double) {
  if (!std::isfinite(is_double ? value : static_cast<double>(static_cast<float>(value))))
    throw std::range_error(std::string("expected numbers that ") + (is_double ? "double" : "float") +
                           " can hold, found one that is not finite in what is to be printed" +
                           (is_double              ? ""
                            : std::isfinite(value) ? ": choose larger units, or real = \"double\""
                                                   : ": choose larger units"));
  char text[40];
  const std::to_chars_result end = is_double ? std::to_chars(text, text + sizeof text, value)
                                             : std::to_chars(text, text + sizeof text, static_cast<float>(value));
  std::string out(text, end.ptr);
  if (out.find_first_of(".e") == std::string::npos) out += ".0";
  return is_double ? out : out + "f";
}

Printer::Printer(const Graph& graph, const std::vector<int>& results, const std::vector<int>& results_of_rest)
    : graph_(graph), uses_(graph.nodes().size(), 0), partners_(graph.nodes().size(), -1),
      is_variable_(graph.nodes().size(), false), has_variable_of_before_(graph.nodes().size(), false) {
  std::vector<int> all = results;
  all.insert(all.end(), results_of_rest.begin(), results_of_rest.end());
  count_uses(all);
  find_pairs();
  find_variables(results_of_rest);
  std::vector<bool> needed, declared;
  for (int node = 0; node < static_cast<int>(uses_.size()); ++node) {
    needed.push_back(needs(node));
    declared.push_back(needs(node) && is_declared(node) && !has_variable_of_before_[static_cast<std::size_t>(node)]);
  }
  names_ = names_of(graph, needed, declared);
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (has_variable_of_before_[i]) names_[i] = name_of(graph.nodes()[i].a);
}

void Printer::count_uses(const std::vector<int>& results) {
  for (const int result : results) ++uses_[static_cast<std::size_t>(result)];
  for (std::size_t i = uses_.size(); i-- > 0;) {
    if (uses_[i] == 0) continue;
    const Node& node = graph_.nodes()[i];
    const int shown = node.op == Op::resumed && is_lane() ? uses_[i] : 1;  // as what it resumes
    const bool asks_nobody = node.op == Op::asked && is_lane();            // what it would ask about is not printed
    for (const int operand : {node.a, asks_nobody ? -1 : node.b, asks_nobody ? -1 : node.c})
      if (operand >= 0) uses_[static_cast<std::size_t>(operand)] += prints_twice(node, operand) ? 2 : shown;
  }
}

// One call makes both: of a part of the graph, before a recovery or behind it.
void Printer::find_pairs() {
  std::map<std::pair<int, bool>, int> sines;
  for (int node = 0; node < static_cast<int>(uses_.size()); ++node) {
    const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
    if (needs(node) && at.op == Op::sine) sines[{at.a, node < graph_.rest()}] = node;
  }
  for (int node = 0; node < static_cast<int>(uses_.size()); ++node) {
    const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
    if (!needs(node) || at.op != Op::cosine) continue;
    const auto sine = sines.find({at.a, node < graph_.rest()});
    if (sine == sines.end()) continue;
    partners_[static_cast<std::size_t>(node)] = sine->second;
    partners_[static_cast<std::size_t>(sine->second)] = node;
  }
}

bool Printer::is_read_late(int node) const {
  const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
  return at.op == Op::resumed && needs(node) && !needs(at.a);
}

std::string Printer::operand(int node) const { return print(node, unary + 1); }

bool Printer::is_declared(int node) const {
  const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
  if (at.op == Op::constant || at.op == Op::flag || is_parameter(at)) return false;
  if (at.op == Op::resumed && is_lane()) return false;
  return !at.name.empty() || uses_[static_cast<std::size_t>(node)] > 1 ||
         is_variable_[static_cast<std::size_t>(node)] || partners_[static_cast<std::size_t>(node)] >= 0;
}

std::string Printer::print(int node, int level) const {
  const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
  if (at.op == Op::constant && !at.text.empty()) return at.text;
  if (at.op == Op::constant) {
    const std::string text = literal(at.value, graph_.target().is_double);
    return at.value < 0 ? bracketed(text, unary, level + 1) : text;
  }
  if (at.op == Op::resumed) return is_lane() ? print(at.a, level) : name_of(node);
  if (at.op == Op::asked && !is_lane()) return bracketed(name_of(node) + " != 0", comparison, level);
  return is_declared(node) ? name_of(node) : print_operation(node, level);
}

// How tightly the operator binds that a node is printed with; a name and a call are no operators.
int Printer::binds(int node) const {
  const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
  if (at.op == Op::resumed && is_lane()) return binds(at.a);
  if (at.op == Op::asked && !is_lane()) return comparison;
  if (at.op == Op::constant || is_declared(node)) return unary;
  switch (at.op) {
    case Op::select: return any;
    case Op::either:
    case Op::both: return logical;
    case Op::finite:
    case Op::less:
    case Op::usable:
    case Op::same: return comparison;
    case Op::add:
    case Op::subtract: return sum;
    case Op::multiply:
    case Op::divide: return product;
    case Op::multiply_add:
    case Op::multiply_subtract: return graph_.target().is_fused ? unary : sum;
    default: return unary;
  }
}

// An operand, in brackets if it is an operation of another kind: nobody has to know what binds tighter.
std::string Printer::first_operand(int node, int level) const {
  return print(node, binds(node) == level ? level : unary);
}

std::string Printer::print_multiply_add(const Node& node, int level) const {
  const bool subtracts = node.op == Op::multiply_subtract;
  if (!graph_.target().is_fused)
    return bracketed(first_operand(node.c, sum) + (subtracts ? " - (" : " + (") + first_operand(node.a, product) +
                         " * " + print(node.b, unary) + ")",
                     sum, level);
  // The sign goes to a factor that is no number: for -0.5f compilers load another constant beside 0.5f.
  const bool second = subtracts && graph_.is_constant(node.a), first = subtracts && !second;
  const auto factor = [&](int operand, bool has_sign) {
    return has_sign ? "-" + print(operand, unary + 1) : print(operand, any);
  };
  return std::string(graph_.target().is_double ? "fma(" : "fmaf(") + factor(node.a, first) + ", " +
         factor(node.b, second) + ", " + print(node.c, any) + ")";
}

std::string Printer::print_comparison(const Node& node) const {
  if (node.op == Op::less) return print(node.a, unary) + " < " + print(node.b, unary);
  const std::string difference = "(" + print(node.a, unary) + " - " + print(node.a, unary) + ")";
  if (node.op == Op::usable) return difference + " < " + print(node.b, unary);
  return difference + " == " + literal(0, graph_.target().is_double);
}

// a + −0.5 is a − 0.5, to the bit.
std::string Printer::print_sum(const Node& node, int level) const {
  const Node& second = graph_.nodes()[static_cast<std::size_t>(node.b)];
  const bool subtracts = second.op == Op::constant && second.text.empty() && second.value < 0;
  const std::string right = subtracts ? literal(-second.value, graph_.target().is_double) : print(node.b, unary);
  return bracketed(first_operand(node.a, sum) + (subtracts ? " - " : " + ") + right, sum, level);
}

std::string Printer::print_operation(int node, int level) const {
  const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
  const auto binary = [&](const char* sign, int binds) {
    return bracketed(first_operand(at.a, binds) + sign + print(at.b, unary), binds, level);
  };
  const auto chained = [&](const char* sign) {  // a && b && c; brackets where && and || meet
    const bool continues = graph_.nodes()[static_cast<std::size_t>(at.a)].op == at.op;
    return bracketed(print(at.a, continues ? logical : unary) + sign + print(at.b, unary), logical, level);
  };
  if (is_function(at.op))
    return call_of(at.op, print(at.a, any) + (at.b < 0 ? "" : ", " + print(at.b, any)), graph_.target().is_double);
  switch (at.op) {
    case Op::add: return print_sum(at, level);
    case Op::subtract: return binary(" - ", sum);
    case Op::multiply: return binary(" * ", product);
    case Op::divide: return binary(" / ", product);
    case Op::negate: return bracketed("-" + print(at.a, unary + 1), unary, level);
    case Op::absolute: return (graph_.target().is_double ? "fabs(" : "fabsf(") + print(at.a, any) + ")";
    case Op::multiply_add:
    case Op::multiply_subtract: return print_multiply_add(at, level);
    case Op::select:
      return bracketed(print(at.a, unary) + " ? " + print(at.b, unary) + " : " + first_operand(at.c, any), any, level);
    case Op::finite:
    case Op::less:
    case Op::usable: {
      const std::string text = bracketed(print_comparison(at), comparison, level);
      const std::string told = restated(node, text, nullptr);
      return told.empty() ? text : told;
    }
    case Op::same: return binary(" == ", comparison);
    case Op::either: return chained(is_lane() ? " | " : " || ");  // || is a branch
    case Op::both: return chained(is_lane() ? " & " : " && ");
    case Op::negation: return "!" + print(at.a, unary + 1);
    case Op::resumed: return needs(at.a) ? print(at.a, level) : at.text;
    case Op::asked: return print(at.a, level);
    case Op::input: return place(at.text);
    default: return at.text;
  }
}

// Where C reads the value from now on: by its name or, once all stores are done, where it has been stored or was loaded
// from.
std::vector<std::string> Printer::places(int node, const std::vector<Store>* stores) const {
  const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
  if (!stores && is_parameter(at)) return {at.text};
  if (!stores) return needs(node) && is_declared(node) ? std::vector{name_of(node)} : std::vector<std::string>();
  std::vector<std::string> out;
  bool is_overwritten = false;
  for (const Store& store : *stores) {
    if (store.node == node) out.push_back(store.target);
    if (store.target == at.text) is_overwritten = true;
  }
  if (at.op == Op::input && !is_overwritten) out.push_back(at.text);
  return out;
}

// "" for a compiler, and where nothing follows.
std::string Printer::restated(int condition, const std::string& text, const std::vector<Store>* stores) const {
  if (!graph_.target().is_prover) return "";
  std::set<std::string> known;
  std::string facts;
  for (const Consequence& consequence : consequences(graph_, condition)) {
    const bool is_bounded = consequence.limit >= 0 || std::isfinite(consequence.bound);
    const std::string limit = consequence.limit >= 0 ? operand(consequence.limit)
                              : is_bounded           ? literal(consequence.bound, true)
                                                     : "";
    for (const std::string& place : places(consequence.node, stores)) {
      const std::string fact = is_bounded ? "BELOW(" + place + ", " + limit + ")" : "FINITE(" + place + ")";
      if (known.insert(fact).second) facts += (facts.empty() ? "" : " && ") + fact;
    }
  }
  return facts.empty() ? "" : "RESTATED(" + text + ", " + facts + ")";
}

std::string Printer::test(int condition, const std::vector<Store>* stores) const {
  const Node& at = graph_.nodes()[static_cast<std::size_t>(condition)];
  const bool is_comparison = at.op == Op::finite || at.op == Op::less || at.op == Op::usable;
  const std::string text = is_comparison && !is_declared(condition) ? print_comparison(at) : expression(condition);
  const std::string told = restated(condition, text, stores);
  return told.empty() ? text : told;
}

std::string Printer::test(int condition, const std::vector<Store>& stores) const { return test(condition, &stores); }
std::string Printer::test_by_names(int condition) const { return test(condition, nullptr); }

bool Printer::is_status(int node) const {
  const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
  return at.op == Op::flag || (at.op == Op::select && is_status(at.b));
}

std::string Printer::question(int node) const {
  const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
  const std::string name = name_of(node), call = at.text + ", " + print(at.b, any) + ", " + print(at.c, any) + ")";
  const std::string test = "reason == LQG_OK";
  const std::string answer = !graph_.target().is_prover ? "(" + test + ")"
                                                        : "(RESTATED(" + test + ", BELOW(" + print(at.b, any) + ", " +
                                                              literal(at.value, true) + ")))";
  // A prover follows both answers from here on, but not those to the questions before: they would multiply.
  const std::string merge = graph_.target().is_prover ? "    /*@ slevel merge; */ ;\n" : "";
  // 1 or 0: of a bool GCC 12 makes two more instructions for each output.
  return merge + wrap("    int " + name + " = " + print(at.a, unary + 1) + " ? 1 : 0;", 8) + "\n    if (" + name +
         " == 0) {\n" + wrap("        const lqg_status_t reason = " + call + ";", 12) + "\n        " + name + " = " +
         answer + " ? 1 : 0;\n        status |= reason;\n    }\n";
}

// A status is chosen by statements: in C an expression that chooses among numbers has the type of the smallest one.
std::string Printer::status_choice(int node, const std::string& name, int indent) const {
  const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
  const std::string blanks(static_cast<std::size_t>(indent), ' ');
  if (at.op != Op::select) return blanks + name + " = " + print(node, any) + ";\n";
  return wrap(blanks + "if (" + print(at.a, any) + ") {", indent + 4) + "\n" + status_choice(at.b, name, indent + 4) +
         blanks + "} else {\n" + status_choice(at.c, name, indent + 4) + blanks + "}\n";
}

std::string Printer::raise(int status) const {
  const Node& at = graph_.nodes()[static_cast<std::size_t>(status)];
  const auto is_ok = [&](int node) { return graph_.nodes()[static_cast<std::size_t>(node)].text == "LQG_OK"; };
  if (is_lane() || is_declared(status) || at.op != Op::select || is_declared(at.b) || !is_ok(at.c))
    return "    status |= " + operand(status) + ";\n";
  return wrap("    if (" + print(at.a, any) + ") {", 8) + "\n        status |= " + print(at.b, any) + ";\n    }\n";
}

std::string Printer::declaration(int node) const {
  if (is_status(node) && !is_lane()) {
    const Node& at = graph_.nodes()[static_cast<std::size_t>(node)];
    return "    lqg_status_t " + name_of(node) + " = " + print(at.b, any) + ";\n" +
           wrap("    if (!" + print(at.a, unary + 1) + ") {", 8) + "\n" + status_choice(at.c, name_of(node), 8) +
           "    }\n";
  }
  if (graph_.nodes()[static_cast<std::size_t>(node)].op == Op::asked && !is_lane()) return question(node);
  if (partners_[static_cast<std::size_t>(node)] >= 0) return pair_declaration(node);
  const std::string type = is_condition(graph_.nodes()[static_cast<std::size_t>(node)].op) ? "bool"
                           : is_status(node)                                               ? "lqg_status_t"
                           : graph_.target().is_double                                     ? "double"
                                                                                           : "float";
  const std::string variable = (is_variable_[static_cast<std::size_t>(node)] ? "    " : "    const ") + type;
  return wrap(variable + " " + name_of(node) + " = " + print_operation(node, any) + ";", 8) + "\n";
}

// The first of the two makes both.
std::string Printer::pair_declaration(int node) const {
  const int partner = partners_[static_cast<std::size_t>(node)];
  if (partner < node) return "";
  const bool is_sine = graph_.nodes()[static_cast<std::size_t>(node)].op == Op::sine,
             is_double = graph_.target().is_double;
  const std::string sine = name_of(is_sine ? node : partner), cosine = name_of(is_sine ? partner : node);
  const std::string type = is_double ? "    double " : "    float ";
  const std::string argument = print(graph_.nodes()[static_cast<std::size_t>(node)].a, any);
  return type + sine + ";\n" + type + cosine + ";\n" +
         wrap((is_double ? "    lqg_sin_cos(" : "    lqg_sin_cosf(") + argument + ", &" + sine + ", &" + cosine + ");",
              8) +
         "\n";
}

Operations Printer::operations() const {
  Operations count;
  std::set<double> constants;
  for (int node = 0; node < static_cast<int>(graph_.nodes().size()); ++node) {
    if (!needs(node)) continue;
    switch (graph_.nodes()[static_cast<std::size_t>(node)].op) {
      case Op::add:
      case Op::subtract:
      case Op::absolute:
      case Op::finite: ++count.additions; break;
      case Op::multiply: ++count.multiplications; break;
      case Op::multiply_add:
      case Op::multiply_subtract: ++count.multiply_adds; break;
      case Op::divide: ++count.divisions; break;
      case Op::constant: constants.insert(graph_.nodes()[static_cast<std::size_t>(node)].value); break;
      case Op::input:
      case Op::resumed:
      case Op::flag: break;
      case Op::negate: break;  // part of the operation before or after it
      case Op::sine:
        count.in_functions +=
            partners_[static_cast<std::size_t>(node)] < 0 ? multiply_adds_of(Op::sine) : multiply_adds_of(Op::sine) / 2;
        break;
      default:
        if (is_function(graph_.nodes()[static_cast<std::size_t>(node)].op))
          count.in_functions += multiply_adds_of(graph_.nodes()[static_cast<std::size_t>(node)].op);
        else
          ++count.selections;
    }
  }
  count.constants = static_cast<int>(constants.size());
  return count;
}

}  // namespace lqg::trace
