// SPDX-License-Identifier: MIT
// From the graph to C99: declarations under their equations, in the order of the run.
#pragma once

#include <string>
#include <vector>

#include "trace/graph.hpp"

namespace lqg::trace {

// The shortest decimal that reads back as the same number: "0.01f", "1e-06f", "0.5", "-3.0f". C has no literal of what
// is not finite in the target's numbers: it throws std::range_error.
std::string literal(double value, bool is_double);

// An assignment of a result, "self->x[0] = …".
struct Store {
  std::string target;
  int node;
};

struct Operations {
  int additions = 0, multiplications = 0, multiply_adds = 0, divisions = 0, selections = 0;
  int in_functions = 0;  // multiply-adds in the functions that it calls, about
  int constants = 0;     // distinct ones that the code must load
  int total() const { return additions + multiplications + multiply_adds + divisions + in_functions; }
};

// Prints what `results` need, and nothing else; those of the rest of the graph, behind a recovery, come last.
class Printer {
 public:
  Printer(const Graph& graph, const std::vector<int>& results, const std::vector<int>& results_of_rest = {});

  // One statement a line, indented by four columns: the inputs first, then block after block. A result is stored as
  // soon as it is there, since a register that waits is one that something else lacks; all inputs have been read by
  // then.
  std::string statements(const std::vector<Store>& stores) const;
  // Of a graph with a rest: what comes before it, which ends with the variables that a recovery may write to.
  std::string statements_before_rest(const std::vector<Store>& stores) const;
  // Behind the recovery: these variables are read again.
  std::string read_again(int indent) const;
  std::string statements_of_rest(const std::vector<Store>& stores) const;
  // A result as an expression: a name or a literal where it has one.
  std::string expression(int node) const { return print(node, 0); }
  // A condition, beside which a prover reads what it says of the places of the values, all `stores` being done:
  // RESTATED(x_0 * x_0 < 4.0f, BELOW(self->x[0], 2.0)). Inside of expressions it reads it of their names.
  std::string test(int condition, const std::vector<Store>& stores) const;
  // The same of the names of the values.
  std::string test_by_names(int condition) const;
  // The same, in brackets where it is more than a name.
  std::string operand(int node) const;
  // Of one of many lanes: a recovery that comes between has no lane to itself, so that the whole is one part.
  bool is_lane() const { return graph_.target().is_lane; }
  // "self->x[0]", of one of many lanes "self->x[0][lane]".
  std::string place(const std::string& text) const { return is_lane() ? text + "[lane]" : text; }
  // A statement that adds a status to `status`.
  std::string raise(int status) const;
  bool needs(int node) const { return uses_[static_cast<std::size_t>(node)] > 0; }
  // Whether it has a statement of its own; other operations are computed inside of the one that uses them.
  bool is_declared(int node) const;
  // Whether a sine and a cosine of one value are both needed, which one call makes.
  bool is_pair(int node) const { return partners_[static_cast<std::size_t>(node)] >= 0; }
  // Whether a resumed value needs no variable before the rest: it is read there first.
  bool is_read_late(int node) const;
  Operations operations() const;

 private:
  bool is_status(int node) const;
  void find_pairs();
  std::string pair_declaration(int node) const;
  const std::string& name_of(int node) const { return names_[static_cast<std::size_t>(node)]; }
  std::string print(int node, int level) const;
  int binds(int node) const;
  std::string first_operand(int node, int level) const;
  std::string print_operation(int node, int level) const;
  std::string print_sum(const Node& node, int level) const;
  std::string print_comparison(const Node& node) const;
  std::string print_multiply_add(const Node& node, int level) const;
  std::string restated(int condition, const std::string& text, const std::vector<Store>* stores) const;
  std::vector<std::string> places(int node, const std::vector<Store>* stores) const;
  std::string question(int node) const;
  std::string status_choice(int node, const std::string& name, int indent) const;
  std::string declaration(int node) const;
  std::string printed(int from, int to, const std::vector<Store>& stores, std::string loads) const;
  std::string test(int condition, const std::vector<Store>* stores) const;
  void count_uses(const std::vector<int>& results);
  void find_variables(const std::vector<int>& results_of_rest);
  std::vector<bool> used_in_rest(const std::vector<int>& results_of_rest) const;
  std::string assignment(const Store& store) const;

  const Graph& graph_;
  std::vector<int> uses_;
  std::vector<int> partners_;       // of a sine the cosine of the same value that is needed, too, and the other way
  std::vector<std::string> names_;  // of what is declared
  // A resumed value and the one before it are one variable, unless the rest reads that one, too.
  std::vector<bool> is_variable_, has_variable_of_before_;
};

}  // namespace lqg::trace
