// SPDX-License-Identifier: MIT
#include "emit/plan/code_cost.hpp"

#include <algorithm>
#include <set>

#include "controller/gains.hpp"
#include "controller/model_of.hpp"
#include "controller/state_fields.hpp"
#include "emit/plan/function_cost.hpp"
#include "emit/plan/instructions.hpp"
#include "emit/plan/library_cost.hpp"
#include "emit/plan/sizes.hpp"
#include "emit/plan/straight_line_cost.hpp"
#include "emit/recorded/linear_traced.hpp"
#include "emit/recorded/row_pattern.hpp"
#include "emit/recorded/shared_covariance.hpp"
#include "emit/recorded/steady_products.hpp"
#include "emit/recorded/traced.hpp"

namespace lqg::emit {

namespace {

// ---- straight-line code

// What GCC puts into two loops: this many values at most, of 70 that it counts a little differently. The constants are
// there once.
constexpr long most_inlined = 80;
constexpr long bytes_of_call = 16, bytes_of_column_loops = 220, bytes_of_observation = 40;
constexpr long bytes_of_correction = 100, bytes_of_projection = 100, bytes_of_column = 56, bytes_of_loop_registers = 40;
constexpr long bytes_of_product = 56, bytes_of_rows = 40, stack_of_rows = 64;
// Of a function with loops over n states: its registers, and what they do not hold. All of them where coefficients fill
// those that no call keeps.
long bytes_of_saved_registers(long n, bool is_full, bool is_double) {
  return (is_full ? 124 : std::min(12 * n - 8, 60 + 9 * n / 2)) + (is_double ? 64 : 0);
}

// What a compiler does not do as it is counted here; most of it where P is carried as it is, in double.
long with_margin(const Controller& controller, long bytes) {
  if (controller.filter == step::Filter::steady && !controller.target.is_double && !controller.linear)
    return bytes + bytes / (controller.target.is_fused ? 64 : 32);
  const bool is_hard = controller.filter == step::Filter::plain && controller.target.is_double;
  return bytes + bytes / 16 + (is_hard ? bytes / 32 : 0);
}

Listing listing_of(const TracedFunction& function, const trace::Printer& printer, bool is_weigh, int ny) {
  const std::vector<trace::Node>& nodes = function.graph->nodes();
  Listing listing{nodes, {}, {}, function.stores, function.statuses};
  listing.stores.insert(listing.stores.end(), function.stores_if_sound.begin(), function.stores_if_sound.end());
  if (function.before) {
    const TracedRecovery& before = *function.before;
    listing.stores.insert(listing.stores.end(), before.stores.begin(), before.stores.end());
    listing.ends.insert(listing.ends.end(), before.statuses.begin(), before.statuses.end());
    listing.ends.push_back(before.finite);
    for (int i = function.graph->rest(); i < static_cast<int>(nodes.size()); ++i)
      listing.read_again +=
          nodes[static_cast<std::size_t>(i)].op == trace::Op::resumed && printer.needs(i) && !printer.is_read_late(i);
    listing.written_before += static_cast<long>(before.recovers.size());
  }
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
    listing.needed.push_back(printer.needs(i));
    listing.declared.push_back(printer.needs(i) && printer.is_declared(i));
  }
  if (function.finite >= 0) listing.ends.push_back(function.finite);
  listing.is_fused = function.graph->target().is_fused;
  listing.asks = !function.asked.empty();
  listing.answers = is_weigh;
  listing.is_alone = ny == 1;
  return listing;
}

Listing listing_of(const Controller& controller, const TracedFunction& function, bool is_weigh = false) {
  Listing listing = listing_of(function, printer_of(function), is_weigh, controller.size.ny);
  if (carries_covariance(controller))
    listing.carries = controller.filter == step::Filter::plain ? Carried::plain_covariance : Carried::factors;
  return listing;
}

// Its own flash and frame; its operations are added to `cost`.
FunctionCost add_function(CodeCost& cost, const Controller& controller, const TracedFunction& function,
                          bool is_weigh = false) {
  if (!function.graph) return {};
  const Listing listing = listing_of(controller, function, is_weigh);
  const FunctionCost own = controller.target.is_double ? cost_in_double(listing) : cost_in_float(listing);
  cost.multiply_adds += printer_of(function).operations().total();
  cost.values_at_once = std::max(cost.values_at_once, values_at_once(listing));
  cost.flash += own.flash;
  return own;
}

// The same of a step that is the text of these calls.
FunctionCost add_step(CodeCost& cost, const Controller& controller, const TracedFunction& step,
                      std::initializer_list<const TracedFunction*> calls) {
  std::vector<Listing> listings;
  for (const TracedFunction* call : calls)
    if (call->graph) listings.push_back(listing_of(controller, *call));
  const Listing listing = listing_of(controller, step);
  const FunctionCost own = cost_of_step(listing, listings, controller.target.is_double);
  cost.instructions = instructions_of(listing, controller.target.is_double);
  cost.values_at_once = values_at_once(listing);
  cost.multiply_adds += printer_of(step).operations().total();
  cost.flash += own.flash;
  return own;
}

// NAME_init and NAME_reset.
struct Beginning {
  long flash = 0, stack = 0;
};

Beginning beginning_of(const Controller& controller) {
  if (!controller.keeps.any) return {};
  long values = 0, not_zero = 0;
  for (const Field& field : state_fields(controller)) {
    values += field.count;
    for (const double value : field.initial) not_zero += value != 0;
  }
  const long bytes = state_bytes(controller), references = controller.size.nr;
  const long kept = controller.has.gate ? controller.size.ny : 0;
  // GCC clears what it holds for mostly zeros; {0} for more than one counts as such.
  const bool is_cleared = kept > 1 || not_zero < values / 4, is_short = bytes <= (is_cleared ? 28 : 64);
  Beginning beginning;
  beginning.flash = 20 + 2 * kept + 28 + 12 * (kept + references);
  if (kept == 1 && references == 0 && is_short && !is_cleared && !carries_covariance(controller))
    beginning.flash -= 32;  // no loop
  // A loop sets the floats of a gate.
  const long set = controller.target.is_double ? not_zero : std::max(0L, not_zero - kept);
  if (is_cleared)
    beginning.flash += 11 * set + (is_short ? 0 : bytes_of_memset);
  else
    beginning.flash += bytes + (is_short ? 0 : bytes_of_memcpy);
  const bool fits_registers = kept == 1 && references <= 1 && bytes <= 28 && !carries_covariance(controller);
  if ((kept > 0 || !is_short) && !fits_registers)
    beginning.stack = aligned(4 * (kept + references)) +
                      (kept <= 4   ? 16
                       : kept <= 8 ? 24
                                   : 32) +
                      (is_short ? 0 : stack_of_memset);
  return beginning;
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

// Multiply-adds, lone operations and divisions of update and predict; zeros and ones included, but for those that a
// pattern of A leaves out.
long filter_cost(const Controller& controller) {
  const long nx = controller.size.nx, ny = controller.size.ny, in_pattern = entries_of(row_pattern(controller, 0));
  const long A = in_pattern > 0 ? in_pattern : nx * nx;
  const long state = A + nx * (controller.size.nu + (controller.keeps.innovation ? ny : 0));
  const long checks = 2 * (2 * nx + 2);              // of the state, after update and after predict
  const long squares = controller.has.gate ? 3 : 0;  // ν² and gate² S
  const long innovations = ny * (innovation_cost(controller) + squares);
  const long common = state + checks + innovations;
  switch (controller.filter) {
    case step::Filter::steady: return common + nx * ny;
    case step::Filter::plain:
      return common + online_cost(controller) + ny * (nx * nx + 3 * nx + triangle(nx) + 1) + nx * A + A * (nx + 1) / 2 +
             3 * nx;
    case step::Filter::ud: {
      const long columns = nx + controller.solution.online->G.cols(), strict = triangle(nx - 1);
      const long factors = 3 * strict + 8 * nx + 1;
      return common + online_cost(controller) + ny * factors + A * (nx - 1) / 2 + 2 * nx * (columns + 1) +
             strict * (2 * columns + 1) + strict + 3 * nx;
    }
    default: return 0;
  }
}

}  // namespace

CodeCost cost_of_linear_form(const Controller& controller) {
  const TracedLinear traced = trace_linear(controller);
  const Beginning beginning = beginning_of(controller);
  const bool is_small = controller.size.nz < 3;  // GCC has all of it in registers
  const long calls = controller.target.is_double ? stack_of_double + (is_small ? 16 : 32) : 0;
  CodeCost cost, aside;  // aside: for the sample that is not as the others
  const long step = add_step(cost, controller, traced.step, {&traced.control, &traced.advance}).stack;
  const long advance = add_function(aside, controller, traced.advance).stack;
  const long control_fault = add_function(aside, controller, traced.control_fault).stack;
  long hear = add_function(aside, controller, traced.hear).stack;
  if (controller.is_predictor && !is_small)
    hear += 24 + bytes_of_real(controller) * controller.size.ny;  // heard[], return address
  cost.ram = state_bytes(controller);
  // NAME_step_fault, called last, keeps self and the status while it calls.
  constexpr long stack_of_fault = 36, flash_of_fault = 48;
  const long fault = stack_of_fault + std::max({advance, control_fault, hear, beginning.stack});
  cost.stack = controller.target.is_double ? step + calls : std::max(step, fault);
  aside.flash += flash_of_fault;
  aside.flash -= aside.flash / 8;                                   // for size: they are cold
  if (controller.is_predictor) aside.flash += is_small ? 20 : 160;  // control and advance_fault
  cost.flash =
      with_margin(controller, cost.flash + aside.flash) + beginning.flash + bytes_of_software_floats(controller, false);
  return cost;
}

CodeCost cost_of_unrolled(const Controller& controller) {
  const TracedController traced = trace_controller(controller);
  const Beginning beginning = beginning_of(controller);
  const long calls = controller.target.is_double ? stack_of_double : 0;
  CodeCost cost, aside;  // aside: for the output or the sample that is not as expected
  const long weigh = controller.has.gate ? add_function(aside, controller, trace_weigh(controller), true).stack : 0;
  const long recover =
      carries_covariance(controller) ? add_function(aside, controller, trace_begin_covariance(controller)).stack : 0;
  // Kept for the integrals.
  const long heard = (controller.target.is_fused ? 8 : 4) * (controller.size.nxi + controller.size.nr);
  // A fused law waits for its test.
  const long tested = controller.target.is_fused && controller.has.regulator ? 16 : 0;
  // It waits for what it calls: NAME_weigh, and in the middle NAME_reset or NAME_recover, which may call that.
  const long step =
      controller.has.filter
          ? add_step(cost, controller, traced.step, {&traced.update, &traced.control, &traced.predict}).stack + heard +
                tested
          : add_function(cost, controller, traced.control).stack;
  if (!controller.has.filter)
    cost.instructions = instructions_of(listing_of(controller, traced.control), controller.target.is_double);
  cost.ram = state_bytes(controller);
  cost.stack = step + std::max(weigh + calls, recover + std::max(calls, beginning.stack));
  const auto entries = [&](const std::vector<Gains>& gains) {
    return static_cast<long>(controller::changing_places(gains, controller.target.is_double).size() * gains.size());
  };
  long tables = entries(controller.laws) + entries(controller.filters);
  if (controller.has.gate)
    for (const Eigen::VectorXd* values :
         {&controller.bounds.innovation, &controller.gate.widen, &controller.gate.narrow})
      if (!is_same_for_all(*values)) tables += controller.size.ny;
  const long counters = 28 * controller.keeps.sample + 124 * controller.keeps.gain_row;
  cost.flash = with_margin(controller, cost.flash + aside.flash + counters) + beginning.flash +
               bytes_of_real(controller) * tables +
               bytes_of_software_floats(controller, carries_covariance(controller));
  if (!controller::is_extended(controller)) return cost;
  const CostOfFunctions called =
      cost_of_functions({&traced.update, &traced.predict, &traced.step}, controller.target.is_double);
  cost.flash += called.flash;
  cost.stack += called.stack;
  cost.instructions.clear();  // what is known of them was not measured with calls of functions
  return cost;
}

CodeCost cost_of_shared(const Controller& controller) {
  const Beginning beginning = beginning_of(controller);
  const long ny = controller.size.ny, nx = controller.size.nx,
             calls = controller.target.is_double ? stack_of_double : 0;
  CodeCost cost, aside;  // aside: for the output or the sample that is not as expected
  // Its flash once, its operations `times`; the frame.
  const auto add = [&](const TracedFunction& function, long times) {
    CodeCost once;
    const long stack = add_function(once, controller, function).stack;
    cost.flash += once.flash;
    cost.multiply_adds += times * once.multiply_adds;
    cost.values_at_once = std::max(cost.values_at_once, once.values_at_once);
    return stack;
  };
  const long weigh = controller.has.gate ? add_function(aside, controller, trace_weigh(controller), true).stack : 0;
  const long recover = add_function(aside, controller, trace_begin_covariance(controller)).stack;
  // A function with loops in place of its straight lines.
  const auto add_loops = [&](const TracedFunction& function, long times, long bytes) {
    CodeCost once;
    add_function(once, controller, function);
    cost.flash += bytes + (controller.target.is_double ? bytes / 2 : 0);
    cost.multiply_adds += times * once.multiply_adds;
    return bytes_of_loop_registers;
  };
  const bool is_in_loops = controller.sharing == controller::Sharing::entries;
  long part = is_in_loops ? add_loops(trace_correction(controller), ny, bytes_of_correction)
                          : add(trace_correction(controller), ny),
       projected = 0, use = 0;
  for (int i = 0; i < ny; ++i) {
    use = std::max(use, add(trace_use(controller, i), 1));
    projected += is_projected(controller, i);
    if (controller.size.nxi) cost.flash += bytes_of_observation;
  }
  if (projected > 0)
    part = std::max(part, is_in_loops ? add_loops(trace_projection(controller), projected, bytes_of_projection)
                                      : add(trace_projection(controller), projected));
  if (takes_columns(controller)) cost.flash += bytes_of_column;
  add(trace_end_of_update(controller), 1);
  const long update = aligned(bytes_of_real(controller) * (nx + 1)) + (controller.target.is_double ? 0 : 8) + use +
                      std::max(part, weigh);
  const long control = controller.has.regulator ? add(trace_regulator(controller), 1) : 0;
  long predict = 0, tables = 0;
  if (loops_over_columns(controller)) {
    long rows = 0;
    bool is_full = false;
    for (const auto& [first, end] : blocks_of_rows(controller)) {
      CodeCost block;
      rows = std::max(rows, add_function(block, controller, trace_rows(controller, first, end)).stack);
      const bool is_in_both_loops = block.multiply_adds + nx + 3 * (end - first) < most_inlined;
      is_full = is_full || !is_in_both_loops || block.multiply_adds > 3 * nx;
      cost.flash += !is_in_both_loops             ? block.flash + 2 * bytes_of_call
                    : controller.target.is_double ? 7 * block.flash / 4
                                                  : 5 * block.flash / 4;
      cost.multiply_adds += (2 * nx - first) * block.multiply_adds;
      cost.values_at_once = std::max(cost.values_at_once, block.values_at_once);
    }
    cost.flash += bytes_of_column_loops;
    tables += triangle(nx) + nx;
    predict = aligned(bytes_of_real(controller) * (nx * nx + 2 * nx)) +
              bytes_of_saved_registers(nx, is_full, controller.target.is_double) + rows;
    predict = std::max(predict, add(trace_end_of_predict(controller), 1));
  } else {
    predict = add(trace_prediction(controller), 1);
  }
  cost.flash += ny * (2 * bytes_of_call);
  if (projected > 0) tables += ny * nx;
  for (const auto* gains : {&controller.laws, &controller.filters})
    tables +=
        static_cast<long>(controller::changing_places(*gains, controller.target.is_double).size() * gains->size());
  if (controller.has.gate)
    for (const Eigen::VectorXd* values :
         {&controller.bounds.innovation, &controller.gate.widen, &controller.gate.narrow})
      if (!is_same_for_all(*values)) tables += ny;
  cost.ram = state_bytes(controller);
  cost.stack = std::max({update + calls, control + calls, predict + calls, recover + std::max(calls, beginning.stack)});
  const long counters = 28 * (controller.keeps.sample + controller.keeps.gain_row);
  const long code = cost.flash + aside.flash + counters;
  cost.flash = (controller.target.is_double ? with_margin(controller, code) : code + code / 32) + beginning.flash +
               bytes_of_real(controller) * tables + bytes_of_software_floats(controller, true);
  return cost;
}

CodeCost cost_of_products(const Controller& controller) {
  const SteadyProducts products = steady_products(controller);
  const Beginning beginning = beginning_of(controller);
  const long calls = controller.target.is_double ? stack_of_double : 0, real = bytes_of_real(controller);
  CodeCost cost, aside;  // aside: for the output or the sample that is not as expected
  const long weigh = controller.has.gate ? add_function(aside, controller, trace_weigh(controller), true).stack : 0;
  const long innovate = add_function(cost, controller, trace_innovate(controller, products)).stack;
  const long end = add_function(cost, controller, trace_end_of_steady_update(controller, products)).stack;
  const long law = controller.has.regulator ? add_function(cost, controller, trace_law(controller, products)).stack : 0;
  const long predict = add_function(cost, controller, trace_steady_predict(controller, products)).stack;
  std::set<int> heights;
  long entries = 0;
  for (const Product* product : {&products.C, &products.L, &products.K, &products.A, &products.B}) {
    for (const int height : heights_of_blocks(*product)) heights.insert(height);
    entries += static_cast<long>(product->matrix.size());
    cost.flash += is_in_loop(*product) ? bytes_of_product : 0;
  }
  for (const int height : heights) cost.flash += bytes_of_rows + (controller.target.is_double ? 60 : 24) * height;
  cost.multiply_adds += entries;
  cost.ram = state_bytes(controller);
  const long sums = aligned(real * (controller.size.nx + controller.size.ny));
  cost.stack = sums + std::max({innovate, end, law, predict}) + stack_of_rows +
               std::max(weigh + calls, std::max(calls, beginning.stack));
  cost.flash = with_margin(controller, cost.flash + aside.flash) + beginning.flash + real * entries +
               bytes_of_software_floats(controller, false);
  return cost;
}

CodeCost cost_of_compact(const Controller& controller) {
  CodeCost cost = cost_of_loops(controller);
  if (controller.has.filter) cost.multiply_adds += filter_cost(controller);
  if (controller.has.regulator) {
    const Gains& law = controller.laws.front();
    cost.multiply_adds += static_cast<long>(law[0].size() + law[1].size() + law[2].size()) + controller.size.nu;
  }
  cost.ram = state_bytes(controller);
  return cost;
}

}  // namespace lqg::emit
