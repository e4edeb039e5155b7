#include "emit/plan/code_cost.hpp"

#include <algorithm>

#include "controller/gains.hpp"
#include "controller/model_of.hpp"
#include "controller/state_fields.hpp"
#include "emit/recorded/linear_traced.hpp"
#include "emit/recorded/traced.hpp"

namespace lqg::emit {

namespace {

// Estimates for a Cortex-M4F at -O2, fitted to what GCC 12 made of the designs in designs/ and of two_mass,
// dc_motor and quadrotor with every filter and arithmetic; test/bench/run.sh prints estimate and truth. The FPU
// computes floats; double is left to the C library.
struct StraightLine {
  long function, operation, constant, access, selection;
};
struct Software {
  long numbers, division;
};
struct Loops {
  long steady, plain, ud;
};
struct Rates {
  StraightLine line;  // bytes of straight-line code
  Software software;  // bytes of the C library's routines
  Loops code;         // bytes of this library's loops, the control law among them
  Loops frame;        // bytes of their stack without work[]
};
constexpr Rates rates_of_float = {{-24, 4, 10, 5, 11}, {0, 0}, {1650, 2690, 2970}, {164, 214, 224}};
constexpr Rates rates_of_double = {{-60, 13, 20, 15, 12}, {1780, 480}, {4210, 5550, 5980}, {220, 288, 318}};

// Of the FPU: half of them are free to use, what a function uses of the others it saves on the stack.
constexpr long registers = 32;

const Rates& rates(const Controller& controller) {
  return controller.target.is_double ? rates_of_double : rates_of_float;
}

long bytes_of_real(const Controller& controller) { return controller.target.is_double ? 8 : 4; }

long triangle(long n) { return n * (n + 1) / 2; }

// ---- straight-line code

bool is_number(const std::vector<trace::Node>& nodes, int i) {
  const trace::Node& node = nodes[static_cast<std::size_t>(i)];
  if (node.op == trace::Op::select) return is_number(nodes, node.b);  // it may choose between statuses
  return node.op != trace::Op::flag && !trace::is_condition(node.op);
}

struct Numbers {
  long inputs = 0;
  long at_once = 0;         // the most that wait for a later use; inputs are read first, the rest in order
  long with_constants = 0;  // the same with the constants, each from its first use on
};

Numbers numbers_of(const TracedFunction& function, const trace::Printer& printer) {
  const std::vector<trace::Node>& nodes = function.graph->nodes();
  std::vector<std::size_t> first(nodes.size(), nodes.size()), last(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const int operand : {nodes[i].a, nodes[i].b, nodes[i].c}) {
      if (operand < 0 || !printer.needs(static_cast<int>(i))) continue;
      const std::size_t at = static_cast<std::size_t>(operand);
      first[at] = std::min(first[at], i);
      last[at] = i;
    }
  Numbers numbers;
  std::vector<long> values(nodes.size(), 0), constants(nodes.size(), 0);  // how many more there are from a node on
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (last[i] == 0 || !is_number(nodes, static_cast<int>(i))) continue;
    const trace::Op op = nodes[i].op;
    std::vector<long>& more = op == trace::Op::constant ? constants : values;
    ++more[op == trace::Op::constant ? first[i] : op == trace::Op::input ? 0 : i];
    --more[last[i]];
    numbers.inputs += op == trace::Op::input;
  }
  long waiting = 0, waiting_constants = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    waiting += values[i];
    waiting_constants += constants[i];
    numbers.at_once = std::max(numbers.at_once, waiting);
    numbers.with_constants = std::max(numbers.with_constants, waiting + waiting_constants);
  }
  return numbers;
}

long stack_of(const Controller& controller, const Numbers& numbers, long statuses) {
  const long in_core_registers = 4 * std::max(0L, statuses - 2);
  if (controller.target.is_double) return 60 + 8 * numbers.at_once + in_core_registers;
  return 4 * std::clamp(numbers.with_constants - registers / 2, 0L, registers / 2) +
         4 * std::max(0L, numbers.at_once - registers) + in_core_registers;
}

void add_function(CodeCost& cost, const Controller& controller, const TracedFunction& function) {
  if (!function.graph) return;
  const trace::Printer printer(*function.graph, function.results());
  const trace::Operations count = printer.operations();
  const Numbers numbers = numbers_of(function, printer);
  const bool is_one_operation = controller.target.is_fused && !controller.target.is_double;  // a multiply-add
  const long operations = count.total() + (is_one_operation ? 0 : count.multiply_adds);
  const StraightLine& bytes = rates(controller).line;
  cost.multiply_adds += count.total();
  cost.flash += bytes.function + bytes.operation * operations + bytes.constant * count.constants +
                   bytes.access * (numbers.inputs + static_cast<long>(function.stores.size())) +
                   bytes.selection * count.selections;
  const long statuses = static_cast<long>(function.statuses.size());
  cost.stack = std::max(cost.stack, stack_of(controller, numbers, statuses));
}

// ---- the library's loops

long numbers_of(const std::vector<Gains>& rows) {
  long numbers = 0;
  for (const design::RealMatrix& matrix : rows.empty() ? Gains{} : rows.front())
    numbers += static_cast<long>(matrix.size()) * static_cast<long>(rows.size());
  return numbers;
}

// Numbers in flash: the constants of a filter.
long filter_constants(const Controller& controller) {
  const long nx = controller.size.nx, nu = controller.size.nu, ny = controller.size.ny;
  const long stages = static_cast<long>(controller.stage_starts.size());
  long numbers = stages * (nx * nx + nx * nu + ny * nx + (controller.has.feedthrough ? ny * nu : 0));
  numbers += nx + ny;  // the bounds
  if (!is_zero(controller.problem.estimator->x0)) numbers += nx;
  if (controller.filter == step::Filter::steady) return numbers + numbers_of(controller.filters);
  const design::OnlineSolution& online = *controller.solution.online;
  const long innovation = controller.keeps.innovation ? nx * nx + nx * ny : 0;
  const long noise = controller.filter == step::Filter::plain ? triangle(nx) : (nx + 1) * online.G.cols();
  return numbers + triangle(nx) + stages * (ny + (online.E.isIdentity(0) ? 0 : ny * ny) + innovation + noise);
}

// One output's innovation, and the check that it is finite.
long innovation_cost(const Controller& controller) {
  return controller.size.nx + (controller.has.feedthrough ? controller.size.nu : 0) + 1;
}

// What the filters that carry P do besides: decorrelated outputs, and what cross noise keeps.
long online_cost(const Controller& controller) {
  long cost = 0;
  const design::RealMatrix& E = controller.solution.online->E;
  for (int i = 0; i < E.rows(); ++i)
    for (int j = 0; j < i; ++j) cost += E(i, j) != 0;
  return cost + (controller.keeps.innovation ? controller.size.ny * (innovation_cost(controller) - 1) : 0);
}

// Multiply-adds, lone operations and divisions of update and predict, zeros and ones included.
long filter_cost(const Controller& controller) {
  const long nx = controller.size.nx, ny = controller.size.ny;
  const long state = nx * (nx + controller.size.nu + (controller.keeps.innovation ? ny : 0));
  const long checks = 2 * (2 * nx + 2);  // of the state, after update and after predict
  const long squares = controller.has.gate ? 3 : 0;  // ν² and gate² S
  const long innovations = ny * (innovation_cost(controller) + squares);
  const long common = state + checks + innovations;
  switch (controller.filter) {
    case step::Filter::steady: return common + nx * ny;
    case step::Filter::plain:
      return common + online_cost(controller) + ny * (nx * nx + 3 * nx + triangle(nx) + 1) + nx * nx * nx +
             nx * triangle(nx) + 3 * nx;
    case step::Filter::ud: {
      const long columns = nx + controller.solution.online->G.cols(), strict = triangle(nx - 1);
      const long factors = 3 * strict + 8 * nx + 1;
      return common + online_cost(controller) + ny * factors + nx * strict + 2 * nx * (columns + 1) +
             strict * (2 * columns + 1) + strict + 3 * nx;
    }
    default: return 0;
  }
}

long filter_code(const Controller& controller) {
  switch (controller.filter) {
    case step::Filter::steady: return rates(controller).code.steady;
    case step::Filter::plain: return rates(controller).code.plain;
    case step::Filter::ud: return rates(controller).code.ud;
    default: return rates(controller).code.steady / 4;  // the control law alone
  }
}

// The frames of the deepest calls, and work[].
long filter_stack(const Controller& controller) {
  const long nx = controller.size.nx, ny = controller.size.ny, real = bytes_of_real(controller);
  switch (controller.filter) {
    case step::Filter::steady: return rates(controller).frame.steady + real * std::max(nx, ny);
    case step::Filter::plain: return rates(controller).frame.plain + real * std::max(nx * nx, nx + ny);
    case step::Filter::ud:
      return rates(controller).frame.ud +
             real * std::max((nx + 2) * (nx + controller.solution.online->G.cols()), nx + ny);
    default: return rates(controller).frame.steady / 2;
  }
}

long initial_state_bytes(const Controller& controller, long ram) {
  return controller.keeps.any ? std::min(30 + 2 * ram, 300L) : 0;
}

}  // namespace

CodeCost cost_of_linear_form(const Controller& controller) {
  const TracedLinear traced = trace_linear(controller);
  CodeCost cost;
  for (const TracedFunction* function : {&traced.control, &traced.advance}) add_function(cost, controller, *function);
  CodeCost aside;  // for the sample that is not as the others
  for (const TracedFunction* function : {&traced.control_fault, &traced.hear}) add_function(aside, controller, *function);
  if (controller.is_predictor) {
    add_function(aside, controller, traced.advance);  // compilers put it into both of its callers
    cost.stack = std::max(cost.stack, 8 + bytes_of_real(controller) * controller.size.ny);  // heard[], return address
  }
  cost.ram = state_bytes(controller);
  cost.flash += aside.flash + rates(controller).software.numbers + initial_state_bytes(controller, cost.ram);
  return cost;
}

CodeCost cost_of_unrolled(const Controller& controller) {
  const TracedController traced = trace_controller(controller);
  const Rates& bytes = rates(controller);
  CodeCost cost;
  for (const TracedFunction* function : {&traced.update, &traced.control, &traced.predict})
    add_function(cost, controller, *function);
  if (controller.has.gate) {
    CodeCost aside;  // for the output that is not as expected
    add_function(aside, controller, trace_weigh(controller));
    for (const Eigen::VectorXd* values : {&controller.bounds.innovation, &controller.gate.widen, &controller.gate.narrow})
      if (!is_same_for_all(*values)) aside.flash += bytes_of_real(controller) * controller.size.ny;
    cost.flash += aside.flash;
  }
  cost.ram = state_bytes(controller);
  const long initial_state = initial_state_bytes(controller, cost.ram);
  const long entries = static_cast<long>(controller::changing_places(controller.laws, controller.target.is_double).size() * controller.laws.size() +
                                         controller::changing_places(controller.filters, controller.target.is_double).size() * controller.filters.size());
  const bool divides = controller.has.filter && controller.filter != step::Filter::steady;
  cost.flash += bytes.software.numbers + (divides ? bytes.software.division : 0) + initial_state +
                   bytes_of_real(controller) * entries;
  return cost;
}

CodeCost cost_of_compact(const Controller& controller) {
  CodeCost cost;
  long numbers = 0;
  if (controller.has.filter) {
    cost.multiply_adds += filter_cost(controller);
    numbers += filter_constants(controller);
  }
  if (controller.has.regulator) {
    const Gains& law = controller.laws.front();
    cost.multiply_adds += static_cast<long>(law[0].size() + law[1].size() + law[2].size()) + controller.size.nu;
    numbers += numbers_of(controller.laws) + controller.size.nu * (controller.problem.limits ? 2 : 0);
  }
  cost.ram = state_bytes(controller);
  cost.flash = filter_code(controller) + bytes_of_real(controller) * numbers;
  cost.stack = filter_stack(controller);
  return cost;
}

}  // namespace lqg::emit
