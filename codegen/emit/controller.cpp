#include "emit/controller.hpp"

#include <algorithm>

#include "emit/model_of.hpp"
#include "emit/traced.hpp"

namespace lqg::emit {

namespace {

// Estimates for a Cortex-M4F at -O2, fitted to what the compiler made of the designs in designs/
// (test/bench/run.sh prints the true figures).
constexpr long bytes_per_operation = 4, bytes_per_constant = 4, bytes_per_access = 4, bytes_per_call = 40;
constexpr long library_bytes_steady = 700, library_bytes_plain = 1300, library_bytes_ud = 1700;
constexpr long registers = 28, bytes_of_frame = 100;

long bytes_of_real(const Controller& controller) { return controller.is_double() ? 8 : 4; }

struct Cost {
  long operations = 0, flash = 0, stack = 0;
};

Cost cost_of(const TracedFunction& function, const Controller& controller) {
  if (!function.graph) return {};
  const trace::Operations count = trace::Printer(*function.graph, function.results()).operations();
  const long instructions = count.total() + 2 * count.selections + (controller.is_fused() ? 0 : count.multiply_adds);
  const long accesses = 2 * static_cast<long>(function.stores.size());
  return {count.total(),
          bytes_per_call + bytes_per_operation * instructions + bytes_per_access * accesses +
              bytes_per_constant * 2 * count.constants,
          bytes_of_frame + bytes_of_real(controller) * std::max(0L, accesses / 2 - registers)};
}

long state_bytes(const Controller& controller) {
  if (!controller.has_filter()) return 0;
  const long nx = controller.nx();
  long reals = nx;
  if (controller.filter() != step::Filter::steady) reals += nx * (nx + 1) / 2;
  if (controller.keeps_input()) reals += controller.nu();
  if (controller.keeps_innovation()) reals += controller.ny();
  return reals * bytes_of_real(controller);
}

Figures unrolled_figures(const Controller& controller) {
  const TracedController traced = trace_controller(controller);
  Figures figures;
  for (const TracedFunction* function : {&traced.update, &traced.control, &traced.predict}) {
    const Cost cost = cost_of(*function, controller);
    figures.multiply_adds += cost.operations;
    figures.flash += cost.flash;
    figures.stack = std::max(figures.stack, cost.stack);
  }
  figures.ram = state_bytes(controller);
  return figures;
}

// What the library's loops do, zeros and ones included (lqg/kalman.h, lqg/lqr.h), and the numbers they read.
Figures compact_figures(const Controller& controller) {
  const long nx = controller.nx(), nu = controller.nu(), ny = controller.ny();
  Figures figures;
  long numbers = 0, work = 0;
  if (controller.has_regulator()) {
    figures.multiply_adds += nu * nx;
    numbers += nu * (nx + 2);
  }
  if (controller.has_filter()) {
    figures.multiply_adds += nx * (nx + nu);
    numbers += nx * (nx + nu) + ny * nx + nx;
  }
  switch (controller.filter()) {
    case step::Filter::none: break;
    case step::Filter::steady:
      figures.multiply_adds += 2 * nx * ny;
      numbers += nx * ny;
      work = std::max(nx, ny);
      figures.flash = library_bytes_steady;
      break;
    case step::Filter::plain:
      figures.multiply_adds += ny * (3 * nx * nx + 9 * nx) / 2 + (3 * nx * nx * nx + nx * nx) / 2;
      numbers += ny + nx * (nx + 1);
      work = std::max(nx * nx, nx + ny);
      figures.flash = library_bytes_plain;
      break;
    case step::Filter::ud: {
      const long nq = controller.solution.online->G.cols();
      figures.multiply_adds += ny * (3 * nx * nx + 13 * nx) / 2 + nx * nx * (nx - 1) / 2 + nx * (nx + 1) * (nx + nq);
      numbers += ny + nx * nq + nq + nx * (nx + 1) / 2;
      work = std::max((nx + 2) * (nx + nq), nx + ny);
      figures.flash = library_bytes_ud;
      break;
    }
  }
  figures.ram = state_bytes(controller);
  figures.flash += bytes_of_real(controller) * numbers + 3 * bytes_per_call;
  figures.stack = bytes_of_frame + bytes_of_real(controller) * work;
  return figures;
}

}  // namespace

step::Filter Controller::filter() const {
  if (!problem.estimator) return step::Filter::none;
  if (problem.estimator->gain == design::Gain::steady) return step::Filter::steady;
  return problem.estimator->covariance == design::Covariance::ud ? step::Filter::ud : step::Filter::plain;
}

bool Controller::keeps_input() const { return has_filter() && !is_zero(solution.plant.D); }

bool Controller::keeps_innovation() const {
  return has_filter() && !is_zero(solution.online ? solution.online->M : solution.estimator->M);
}

std::optional<Controller> make_controller(design::Problem problem, design::Solution solution, Source source,
                                          design::Findings& findings) {
  Controller controller{std::move(problem), std::move(solution), std::move(source), {}, {}};
  const design::Code& code = controller.problem.code;
  const Figures unrolled = unrolled_figures(controller), compact = compact_figures(controller);
  const bool prefers_unrolled = unrolled.flash <= code.flash || unrolled.flash <= compact.flash;
  controller.style = code.style != design::Style::automatic ? code.style
                     : prefers_unrolled                      ? design::Style::unrolled
                                                             : design::Style::compact;
  controller.figures = controller.style == design::Style::unrolled ? unrolled : compact;
  if (controller.figures.flash > code.flash) {
    findings.push_back({code.style == design::Style::automatic ? design::Severity::error : design::Severity::note,
                        "code.flash",
                        "expected at least " + std::to_string(controller.figures.flash) +
                            " bytes, which the controller takes, found " + std::to_string(code.flash)});
    if (code.style == design::Style::automatic) return std::nullopt;
  }
  return controller;
}

}  // namespace lqg::emit
