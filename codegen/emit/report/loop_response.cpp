// SPDX-License-Identifier: MIT
#include "emit/report/loop_response.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <memory>

#include "design/loop/margin_search.hpp"
#include "design/loop/open_loop.hpp"
#include "design/numeric/response.hpp"

namespace lqg::emit {

namespace {

using Eigen::MatrixXcd;
using Answer = std::function<MatrixXcd(double)>;

// L at an angle.
Answer answer_of(const Controller& controller) {
  const design::Digits digits(50);
  const design::OpenLoop loop = design::open_at_inputs(design::measured_plant(controller.problem, controller.solution),
                                                       design::compensator(controller.problem, controller.solution));
  auto response = std::make_shared<design::Response>(loop.A, loop.B, loop.C);
  return [response](double angle) { return response->roughly_at(design::Real(angle)); };
}

// Even in their logarithm from far below the slowest pole, and dense around every pole.
std::vector<double> angles_for(const design::Poles& poles) {
  const double nyquist_angle = std::acos(-1.0);
  constexpr int even = 240;
  constexpr double beside_1 = 1e-9;
  double slowest = nyquist_angle / 10;
  std::vector<design::ComplexReal> many;
  for (const Complex& pole : poles) {
    if (std::abs(pole) > 1e-3) slowest = std::min(slowest, std::max(std::abs(std::log(pole)), 1e-6));
    // A pole that a double cannot tell from ±1 has no frequency that a picture could show.
    if (std::abs(pole - 1.0) > beside_1 && std::abs(pole + 1.0) > beside_1)
      many.push_back({design::Real(pole.real()), design::Real(pole.imag())});
  }
  const double low = slowest / 30;
  std::vector<double> out;
  for (int k = 0; k < even; ++k) out.push_back(low * std::pow(nyquist_angle / low, k / (even - 1.0)));
  out.back() = nyquist_angle;
  for (const design::Real& angle : design::search_angles(many))
    if (angle > low && angle < nyquist_angle) out.push_back(design::to_double(angle));
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end(), [](double a, double b) { return b - a < 1e-3 * a; }), out.end());
  return out;
}

MatrixXcd complementary(const MatrixXcd& L) {
  return (MatrixXcd::Identity(L.rows(), L.cols()) + L).partialPivLu().solve(L);
}

// L of one loop while the others are closed: T_ii = L/(1 + L).
Complex loop_of(const MatrixXcd& T, Eigen::Index i) {
  const Complex t = T(i, i);
  return t / (1.0 - t);
}

std::vector<double> singular_values(const MatrixXcd& matrix) {
  const Eigen::VectorXd values = Eigen::JacobiSVD<MatrixXcd>(matrix).singularValues();
  return {values.begin(), values.end()};
}

void add_singular_values(const MatrixXcd& L, const MatrixXcd& T, LoopResponse& out) {
  out.of_L.push_back(singular_values(L));
  out.of_S.push_back(singular_values(MatrixXcd::Identity(L.rows(), L.cols()) - T));
  out.of_T.push_back(singular_values(T));
}

}  // namespace

std::optional<LoopResponse> loop_response(const Controller& controller) {
  const design::Margins& margins = controller.solution.loop.at_input;
  if (!controller.solution.regulator || !(margins.disk || margins.phase_deg || margins.gain_dB)) return std::nullopt;
  const design::Digits digits(50);
  const Answer answer = answer_of(controller);
  LoopResponse out;
  out.sample_time = controller.problem.plant.sample_time;
  out.angles = angles_for(controller.solution.loop.poles);
  out.loops.resize(static_cast<std::size_t>(controller.size.nu));
  for (std::size_t i = 0; i < out.loops.size(); ++i) {
    out.loops[i].angles = out.angles;
    out.loops[i].at = [answer, i, is_alone = out.loops.size() == 1](double angle) {
      const MatrixXcd L = answer(angle);
      return is_alone ? L(0, 0) : loop_of(complementary(L), static_cast<Eigen::Index>(i));
    };
  }
  for (const double angle : out.angles) {
    const MatrixXcd L = answer(angle);
    if (out.loops.size() == 1) {
      out.loops[0].L.push_back(L(0, 0));
      continue;
    }
    const MatrixXcd T = complementary(L);
    for (std::size_t i = 0; i < out.loops.size(); ++i)
      out.loops[i].L.push_back(loop_of(T, static_cast<Eigen::Index>(i)));
    add_singular_values(L, T, out);
  }
  return out;
}

std::vector<double> places(const LoopCurve& loop, const std::function<double(Complex)>& function) {
  std::vector<double> out;
  for (std::size_t k = 0; k + 1 < loop.L.size(); ++k) {
    double low = loop.angles[k], high = loop.angles[k + 1];
    const double at_low = function(loop.L[k]);
    if (!(at_low * function(loop.L[k + 1]) < 0)) continue;
    for (int i = 0; i < 40; ++i) {
      const double middle = (low + high) / 2;
      (function(loop.at(middle)) * at_low > 0 ? low : high) = middle;
    }
    out.push_back((low + high) / 2);
  }
  return out;
}

}  // namespace lqg::emit
