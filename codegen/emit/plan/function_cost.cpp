// SPDX-License-Identifier: MIT
#include "emit/plan/function_cost.hpp"

#include <set>

#include "trace/functions.hpp"

namespace lqg::emit {

namespace {

using trace::Op;

// Measured, and a tenth more.
struct BytesOfFunction {
  Op function;
  long floats, doubles;
};
constexpr BytesOfFunction bytes_of_functions[] = {{Op::square_root, 48, 476},
                                                  {Op::sine, 312, 692},
                                                  {Op::cosine, 304, 692},
                                                  {Op::tangent, 340, 860},
                                                  {Op::arcsine, 344, 1488},
                                                  {Op::arccosine, 368, 1536},
                                                  {Op::arctangent, 420, 1204},
                                                  {Op::arctangent_of_two, 440, 2612},
                                                  {Op::exponential, 296, 632},
                                                  {Op::logarithm, 332, 624},
                                                  {Op::hyperbolic_tangent, 420, 956},
                                                  {Op::wrapped, 260, 460}};
constexpr long bytes_of_sine_and_cosine = 352, bytes_of_double_sine_and_cosine = 748;
constexpr long stack_of_function = 48, stack_of_double_function = 200;

}  // namespace

CostOfFunctions cost_of_functions(const std::vector<const TracedFunction*>& callers, bool is_double) {
  std::set<Op> called;
  bool calls_both = false;
  for (const TracedFunction* caller : callers) {
    if (!caller->graph) continue;
    const trace::Printer printer = printer_of(*caller);
    const std::vector<trace::Node>& nodes = caller->graph->nodes();
    for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
      const Op op = nodes[static_cast<std::size_t>(i)].op;
      if (!printer.needs(i) || !trace::is_function(op)) continue;
      if (printer.is_pair(i))
        calls_both = true;
      else
        called.insert(op);
    }
  }
  CostOfFunctions cost;
  for (const BytesOfFunction& each : bytes_of_functions)
    if (called.count(each.function)) cost.flash += is_double ? each.doubles : each.floats;
  if (calls_both) cost.flash += is_double ? bytes_of_double_sine_and_cosine : bytes_of_sine_and_cosine;
  if (cost.flash > 0) cost.stack = is_double ? stack_of_double_function : stack_of_function;
  return cost;
}

}  // namespace lqg::emit
