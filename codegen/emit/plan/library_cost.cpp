// SPDX-License-Identifier: MIT
#include "emit/plan/library_cost.hpp"

#include <algorithm>

#include "controller/gains.hpp"
#include "controller/model_of.hpp"
#include "controller/state_fields.hpp"
#include "emit/plan/sizes.hpp"
#include "emit/recorded/row_pattern.hpp"

namespace lqg::emit {

namespace {

// Measured by test/bench/library_figures.sh, which prints them anew: bytes, of float, fused float, double, fused
// double.
struct Variants {
  long bytes[4];
  long of(const Controller& controller) const {
    return bytes[(controller.target.is_double ? 2 : 0) + (controller.target.is_fused ? 1 : 0)];
  }
};
struct FilterFigures {
  Variants flash;            // init, update and predict with all that they call
  long whole;                // update of all outputs, which is one call more
  Variants update, predict;  // the deepest reach of their stack
};
constexpr FilterFigures steady = {{{1764, 1732, 2396, 2400}}, 24, {{132, 132, 244, 244}}, {{112, 120, 152, 176}}};
constexpr FilterFigures plain = {{{4480, 4316, 6488, 6400}}, 24, {{184, 184, 332, 360}}, {{144, 152, 280, 312}}};
constexpr FilterFigures factored = {{{3576, 3480, 4784, 4784}}, 24, {{168, 176, 304, 328}}, {{144, 152, 248, 256}}};
constexpr Variants law_flash = {{200, 196, 280, 304}}, law_stack = {{36, 36, 100, 120}};
constexpr Variants servo_flash = {{1048, 1072, 1504, 1584}};  // beside a filter, with which it shares a function
constexpr Variants memory_flash = {{284, 324, 440, 448}};  // of these, where nothing is carried from sample to sample
constexpr Variants observe_flash = {{140, 140, 172, 172}};
constexpr Variants limit_flash = {{2632, 2564, 3420, 3436}}, limit_stack = {{104, 96, 232, 280}};
constexpr Variants servo_stack = {{88, 88, 196, 240}};

const FilterFigures& figures_of(step::Filter filter) {
  return filter == step::Filter::plain ? plain : filter == step::Filter::ud ? factored : steady;
}

long numbers_of(const std::vector<Gains>& rows) {
  long numbers = 0;
  for (const design::RealMatrix& matrix : rows.empty() ? Gains{} : rows.front())
    numbers += static_cast<long>(matrix.size()) * static_cast<long>(rows.size());
  return numbers;
}

// L and the variances; M where predict needs it.
long numbers_of_filters(const Controller& controller) {
  const long M = controller.keeps.innovation ? 0 : static_cast<long>(controller.filters.front()[1].size());
  return numbers_of(controller.filters) - M * static_cast<long>(controller.filters.size());
}

// Of A, and of A_free where predict needs it.
long entries_of_A(const Controller& controller, std::size_t start) {
  const long nx = controller.size.nx, entries = entries_of(row_pattern(controller, start));
  const bool has_A_free = controller.solution.online && controller.keeps.innovation;
  return (entries > 0 ? entries : nx * nx) * (has_A_free ? 2 : 1);
}

// Numbers in flash: the constants of a filter.
long filter_constants(const Controller& controller) {
  const long nx = controller.size.nx, nu = controller.size.nu, ny = controller.size.ny;
  const long stages = static_cast<long>(controller.stage_starts.size());
  long numbers = stages * (nx * nu + ny * nx + (controller.has.feedthrough ? ny * nu : 0));
  for (const std::size_t start : controller.stage_starts) numbers += entries_of_A(controller, start);
  numbers += nx + ny;  // the bounds
  if (controller.has.gate) numbers += 3 * ny + 16 / bytes_of_real(controller);
  if (controller.has.range) numbers += 2 * ny;
  if (!is_zero(controller.problem.estimator->x0)) numbers += nx;
  if (controller.filter == step::Filter::steady) return numbers + numbers_of_filters(controller);
  const design::OnlineSolution& online = *controller.solution.online;
  const long innovation = controller.keeps.innovation ? nx * ny : 0;
  const long noise = controller.filter == step::Filter::plain ? triangle(nx) : (nx + 1) * online.G.cols();
  return numbers + triangle(nx) + stages * (ny + (online.E.isIdentity(0) ? 0 : ny * ny) + innovation + noise);
}

// The arrays, and what points to them.
long constants_of(const Controller& controller) {
  long numbers = 0, bytes = 0;
  if (controller.has.filter) {
    numbers += filter_constants(controller);
    bytes += (controller.filter == step::Filter::steady ? 60 : 84) * static_cast<long>(controller.stage_starts.size());
    for (const std::size_t start : controller.stage_starts) bytes += aligned(size_of(row_pattern(controller, start)));
  }
  if (controller.has.regulator) {
    numbers += numbers_of(controller.laws) + controller.size.nu * (controller.problem.limits ? 2 : 0) +
               controller.size.nu * (controller.has.rate_limit ? 1 : 0) + 2 * controller.size.nxi;
    bytes += controller.has.servo ? 64 + 8 * controller.size.nxi : 20;
  }
  return bytes + bytes_of_real(controller) * numbers;
}

// r − y is that of the outputs that were heard.
bool is_watched(const Controller& controller) { return controller.size.nxi > 0; }
bool remembers(const Controller& controller) { return controller.size.nxi > 0 || controller.has.last_input; }

// Between the plant's own units and deviations: numbers of the operating point, where they are added or subtracted.
long conversions_of(const Controller& controller) {
  const controller::Point& point = controller.point;
  const auto count = [](const Eigen::VectorXd& part) { return static_cast<long>((part.array() != 0).count()); };
  const long inputs = (controller.has.filter ? 1 : 0) + (controller.has.regulator ? 1 : 0);
  const long references = (controller.has.regulator ? 1 : 0) + (controller.size.nxi > 0 ? 1 : 0);
  return count(point.y) + inputs * count(point.u) + references * count(point.r) +
         (controller.has.filter ? 0 : count(point.x));
}

// What is converted before a function of the library is called.
long bytes_of_deviations(const Controller& controller) {
  const long numbers = (controller.point.y.size() > 0 ? controller.size.ny : 0) +
                       (controller.point.r.size() > 0 ? controller.size.nr : 0) +
                       (!controller.has.filter && controller.point.x.size() > 0 ? controller.size.nx : 0);
  return aligned(bytes_of_real(controller) * numbers);
}

// The functions in the header.
long calls_of(const Controller& controller) {
  const long covariance = carries_covariance(controller) ? 1 : 0, ny = controller.has.gate ? controller.size.ny : 0;
  const long rows = controller.keeps.gain_row ? 1 : 0, laws = has_law_table(controller) ? 1 : 0,
             servo = controller.has.servo ? 1 : 0;
  const long init = 44 + 4 * ny + 16 * covariance + 40 * servo;
  const long reset = 40 + 14 * ny + 16 * covariance + 54 * servo + 4 * controller.size.nr;
  long bytes = init;
  if (controller.has.filter) {
    bytes += reset + 28 * covariance;
    bytes += (is_watched(controller) ? 148 : 64) + 12 * covariance + 82 * rows + (controller.has.range ? 60 : 0);
    bytes += 64 + 16 * covariance + (remembers(controller) ? 44 : 0) + 74 * rows + 40 * laws;
  }
  if (controller.has.regulator)
    bytes += 16 + 36 * servo + 60 * laws + (controller.has.feedthrough ? 40 : 0) +
             (controller.has.filter ? 0 : 120 + 80 * servo);
  constexpr long bytes_of_conversion = 18;
  return bytes + (controller.target.is_double ? 24 : 0) + bytes_of_conversion * conversions_of(controller);
}

long flash_of_library(const Controller& controller) {
  long bytes = 0;
  if (controller.has.filter)
    bytes += figures_of(controller.filter).flash.of(controller) +
             (is_watched(controller) ? 0 : figures_of(controller.filter).whole);
  if (controller.has.regulator && controller.has.servo)
    bytes += servo_flash.of(controller) - (remembers(controller) ? 0 : memory_flash.of(controller)) +
             (controller.size.nxi ? observe_flash.of(controller) : 0);
  else if (controller.has.regulator)
    bytes += law_flash.of(controller);
  return bytes;
}

// How long work[] is, in bytes.
long work_of(const Controller& controller) {
  const long nx = controller.size.nx, ny = controller.size.ny, real = bytes_of_real(controller);
  switch (controller.filter) {
    case step::Filter::steady: return aligned(real * std::max(nx, ny));
    case step::Filter::plain: return aligned(real * std::max(nx * nx + 4 * nx, nx + ny));
    case step::Filter::ud:
      return aligned(real * std::max((nx + 2) * (nx + controller.solution.online->G.cols()), nx + ny));
    default: return 0;
  }
}

// The frames in the header, and the deepest calls from them.
long stack_of_loops(const Controller& controller) {
  const long law = !controller.has.regulator ? 0
                   : controller.has.servo    ? 24 + servo_stack.of(controller)
                                             : law_stack.of(controller);
  const long tables =
      (controller.keeps.gain_row ? 56 : 0) + (has_law_table(controller) ? (controller.has.servo ? 64 : 24) : 0);
  if (!controller.has.filter)
    return law + tables + 24 + bytes_of_deviations(controller) +
           aligned(bytes_of_real(controller) * static_cast<long>(controller.solution.plant.C.rows()));
  const FilterFigures& figures = figures_of(controller.filter);
  const long ny = controller.size.ny, covariance = carries_covariance(controller) ? 8 : 0,
             real = bytes_of_real(controller);
  const long work = work_of(controller);
  const long update = work + (is_watched(controller) ? 76 : 40) + covariance + tables +
                      (controller.size.nxi ? aligned(real * ny) + aligned(ny) + 8 : 0) +
                      (controller.has.range ? aligned(real * ny) : 0);
  const long deviations = bytes_of_deviations(controller);
  const long predict = (controller.point.u.size() > 0 ? aligned(real * controller.size.nu) : 0) + work + 16 +
                       covariance + (remembers(controller) ? 8 : 0) + tables;
  const long whole = is_watched(controller) ? 0 : figures.whole - 8;
  return std::max({law + deviations, update + deviations + whole + figures.update.of(controller),
                   predict + figures.predict.of(controller)});
}

}  // namespace

long bytes_of_software_floats(const Controller& controller, bool divides) {
  if (!controller.target.is_double) return 0;
  const long sums = 888, products = 596, products_and_quotients = 1060, comparisons = 272, fused = 32, bridges = 24;
  return sums + (divides ? products_and_quotients : products) + comparisons + bridges +
         (controller.target.is_fused ? fused : 0);
}

void add_foresight(const Controller& controller, bool is_in_loops, CodeCost& cost) {
  if (!controller.has.foresight) return;
  const design::LimitedRows& limits = *controller.solution.foreseen;
  const long rows = static_cast<long>(limits.G.rows()), ns = static_cast<long>(limits.F.cols());
  const long numbers = static_cast<long>(limits.F.size()) + rows * rows + 4 * rows +
                       (controller.has.rate_limit ? controller.size.nu : 0);
  const bool copies = controller.has.input_change || controller.size.nr > 0;
  constexpr long description = 48, control = 220, frame = 48, frame_beside_loops = 104, check = 1;
  cost.flash += limit_flash.of(controller) + bytes_of_real(controller) * numbers + description + control +
                bytes_of_software_floats(controller, true) -
                bytes_of_software_floats(controller, carries_covariance(controller)) + (copies ? 20 * ns : 0);
  const long memory = bytes_of_real(controller) * (7 * rows + rows * (rows - 1) / 2 + (copies ? ns : 0)) + 2 * rows;
  // In straight-line code control is part of step; loops have a frame of their own that is gone by then.
  const long solver = aligned(memory) + limit_stack.of(controller) + (copies ? 4 * bytes_of_real(controller) : 0);
  cost.stack = is_in_loops ? std::max(cost.stack, solver + frame_beside_loops) : cost.stack + solver + frame;
  cost.multiply_adds += static_cast<long>(limits.F.size()) + check * rows;
  cost.instructions.clear();
}

CodeCost cost_of_loops(const Controller& controller) {
  CodeCost cost;
  const long calls = calls_of(controller);
  cost.flash = flash_of_library(controller) + calls + calls / 6 + constants_of(controller) + bytes_of_memset +
               bytes_of_software_floats(controller, carries_covariance(controller));
  cost.stack = stack_of_loops(controller) + 8;
  return cost;
}

}  // namespace lqg::emit
