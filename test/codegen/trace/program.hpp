// SPDX-License-Identifier: MIT
// A random computation, once as a list of operations that are done one by one, once as the graph that it is traced to.
#pragma once

#include <string>
#include <vector>

#include "../random.hpp"
#include "trace/graph.hpp"

namespace lqg_test {

using lqg::trace::Graph;
using lqg::trace::Op;
using lqg::trace::Target;

struct Operation {
  Op op;
  int a = -1, b = -1, c = -1;  // earlier operations
  double value = 0;            // of a constant or a flag; the index of an input
};

enum class Kind { number, condition, status };

using Program = std::vector<Operation>;

Kind kind(const Program& program, int at);

// `inputs` inputs, as many constants (0, ±1 and others), four flags, then `operations` operations of all kinds.
Program random_program(Random& random, Target target, int inputs, int operations);

// Numbers of the target: zeros, ones, subnormal, largest, infinite, NaN, any bits, and honest ones.
double random_number(Random& random, Target target);

// The node of every operation.
std::vector<int> record(const Program& program, Graph& graph);

// One operation on numbers of the target, written down independently of the graph.
double apply(Op op, Target target, double a, double b, double c);

struct Results {
  std::vector<double> values;
  // A fold may change what is not finite, so such a value counts no more once it was computed with. An input may be
  // whatever it is for finite(), usable() and the branch of a select that was not taken.
  std::vector<bool> is_honest;
};

Results evaluate(const Program& program, Target target, const std::vector<double>& inputs);

// The value of every node of the graph; inputs by their text, "in[3]".
std::vector<double> interpret(const Graph& graph, const std::vector<double>& inputs);

// Equal bits, but for the sign of a zero.
bool same(double a, double b);

std::string input_text(int i);
std::string flag_text(double value);

}  // namespace lqg_test
