// SPDX-License-Identifier: MIT
// Whatever the bytes, the reader neither crashes nor leaves a trace of them that could harm: each finding is
// one line of UTF-8 with a place, and a problem without errors has the shapes that it promises.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "input/design_file.hpp"

namespace {

using namespace lqg;

void demand(bool condition) {
  if (!condition) std::abort();
}

void check_finding(const input::DesignFile& file, const design::Finding& finding) {
  const input::Location where = input::locate(file, finding.key);
  const std::string line = input::format("design.toml", where, finding);
  demand(where.line >= 0 && where.column >= 0 && !finding.message.empty());
  for (const char c : line) demand(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
}

void check_shapes(const design::Problem& problem) {
  const design::Plant& plant = problem.plant;
  const auto nx = plant.A.rows(), nu = plant.B.cols(), ny = plant.C.rows(), nw = plant.G.cols();
  const auto is = [](const Eigen::MatrixXd& matrix, Eigen::Index rows, Eigen::Index columns) {
    demand(matrix.rows() == rows && matrix.cols() == columns && matrix.allFinite());
  };
  // Empty where something else stands in its place: Q_output or bryson, poles that are placed, no noise.
  const auto is_or_empty = [&is](const Eigen::MatrixXd& matrix, Eigen::Index rows, Eigen::Index columns) {
    if (matrix.size() > 0) is(matrix, rows, columns);
  };
  is(plant.A, nx, nx), is(plant.B, nx, nu), is(plant.C, ny, nx), is(plant.D, ny, nu), is_or_empty(plant.G, nx, nw);
  demand(static_cast<Eigen::Index>(plant.states.size()) == nx && static_cast<Eigen::Index>(plant.inputs.size()) == nu);
  demand(static_cast<Eigen::Index>(plant.outputs.size()) == ny && plant.sample_time > 0 && !problem.name.empty());
  if (problem.regulator)
    is_or_empty(problem.regulator->Q, nx, nx), is_or_empty(problem.regulator->R, nu, nu),
        is_or_empty(problem.regulator->N, nx, nu);
  if (problem.estimator) {
    const design::Estimator& kalman = *problem.estimator;
    is_or_empty(kalman.W, nw, nw), is_or_empty(kalman.V, ny, ny), is_or_empty(kalman.Swv, nw, ny),
        is_or_empty(kalman.P0, nx, nx), is_or_empty(kalman.x0, nx, 1);
    demand(kalman.poles || kalman.V.size() > 0);
  }
  demand(problem.regulator || problem.estimator);
  if (problem.limits) demand(problem.limits->u_min.rows() == nu && problem.limits->u_max.rows() == nu);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const input::DesignFile file = input::parse_design(text);
  for (const design::Finding& finding : file.findings) check_finding(file, finding);
  demand(file.problem.has_value() != design::has_error(file.findings));
  if (file.problem) check_shapes(*file.problem);
  return 0;
}
