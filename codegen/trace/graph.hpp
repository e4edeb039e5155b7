// SPDX-License-Identifier: MIT
// The record of a traced run: every operation once, constants folded as the target would compute them.
#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace lqg::trace {

enum class Op {
  constant,
  input,
  add,
  subtract,
  multiply,
  divide,
  negate,
  absolute,
  multiply_add,       // a b + c
  multiply_subtract,  // c − a b
  select,             // a ? b : c
  finite,
  less,
  either,
  both,
  negation,  // conditions
  usable,    // a finite and b positive, in one comparison
  flag,      // a status, by its name in C; select chooses between statuses too
  same,      // a == b, of statuses
  asked,     // a condition: a, or what a function answers where a does not hold
  resumed,   // a, or what stands in memory, at `text`, where a recovery came between
  // Functions of lqg/functions.h.
  square_root,
  sine,
  cosine,
  tangent,
  arcsine,
  arccosine,
  arctangent,
  arctangent_of_two,  // atan2(a, b)
  exponential,
  logarithm,
  hyperbolic_tangent,
  wrapped  // a in [−π, π)
};

bool is_condition(Op op);

struct Node {
  Op op = Op::constant;
  int a = -1, b = -1, c = -1;
  double value = 0;  // of a constant, representable in the target's real
  std::string text;  // its C expression: of an input, of a flag, of a constant that has a name in C
  std::string name;  // empty: printed inside the expression that uses it, or shared by several under its hint
  std::string hint;
  int section = 0;
};

// An input that is a parameter of the function: it has its name already.
inline bool is_parameter(const Node& node) { return node.op == Op::input && node.name == node.text; }

// What the target's numbers are: decides how constants fold.
struct Target {
  bool is_double = false;
  bool is_fused = false;
  bool is_prover = false;  // reads beside each test what follows from it
  bool is_lane = false;    // one of many side by side: [lane] behind each place, and no branches
};

// Nodes are numbered in the order in which the run made them, so a node stands after all that it uses.
//
// The folds keep every bit of a finite result, up to the sign of a zero: x·0, x·±1, x+0, x−0, x/x, operations on
// constants alone. Nothing is reassociated.
class Graph {
 public:
  // `prefix` begins the names of constants in C: "SERVO_".
  explicit Graph(Target target, std::string prefix = "") : target_(target), prefix_(std::move(prefix)) {
    sections_.push_back({});
  }

  int constant(double value);
  // The constant that C knows by the graph's prefix and `name`. It folds like any other; what it folds to has no name.
  int constant(double value, const std::string& name);
  int input(const std::string& text, const std::string& name);
  int flag(const std::string& text);
  // `condition`, or else that the call `function`, b, c), "weigh(self, 0", finds nothing to say: its status is added.
  // Printed as two statements. In either case |b| < `bound` where the answer is yes.
  int ask(int condition, const std::string& function, int b, int c, double bound);
  int make(Op op, int a, int b = -1, int c = -1);
  // A function of lqg/functions.h; unless it gets a name it is called after its argument.
  int call(Op function, int a, int b = -1);

  // From here on a recovery may have come between, once in a graph: nothing is the same as what was made before.
  void begin_rest();
  // `value`, or after a recovery what C reads at `place`.
  int resume(int value, const std::string& place, const std::string& name);
  // The first node behind a recovery; without one there is none.
  int rest() const { return rest_ < 0 ? static_cast<int>(nodes_.size()) : rest_; }

  bool is_constant(int node) const { return nodes_[node].op == Op::constant; }
  bool is_constant(int node, double value) const { return is_constant(node) && nodes_[node].value == value; }

  // Nodes made from now on stand under `equation`; names get `suffix`.
  void section(const std::string& equation, const std::string& suffix);
  // The first name a node gets is kept. Two nodes may get the same: `names_of` tells them apart.
  void name(int node, const std::string& base);
  // The name of a node that has none and is used more than once; this gives it no statement of its own.
  void hint(int node, const std::string& base);
  // Names that no node may have, since C knows something else by them.
  void reserve(const std::set<std::string>& names) { reserved_.insert(names.begin(), names.end()); }

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::string& equation(int section) const { return sections_[section].equation; }
  const std::set<std::string>& reserved() const { return reserved_; }
  Target target() const { return target_; }
  // The constants with a name in C, and their nodes.
  const std::map<std::string, int>& named_constants() const { return named_constants_; }

 private:
  struct Section {
    std::string equation, suffix;
  };
  using Key = std::tuple<Op, int, int, int>;

  int insert(Node node);
  int fold(Op op, int a, int b, int c);
  int fold_constants(Op op, int a, int b, int c);
  int fold_condition(Op op, int a, int b, int c);
  int fold_multiply(int a, int b);
  int fold_multiply_add(int a, int b, int c);
  int fold_multiply_subtract(int a, int b, int c);

  Target target_;
  std::string prefix_;
  std::vector<Node> nodes_;
  int rest_ = -1;
  std::vector<Section> sections_;
  std::map<Key, int> known_;
  std::map<double, int> constants_;
  std::map<std::string, int> named_constants_;
  std::map<std::string, int> flags_;
  std::set<std::string> reserved_;
};

}  // namespace lqg::trace
