// SPDX-License-Identifier: MIT
#include "emit/text/extended_description.hpp"

#include "emit/text/wording.hpp"
#include "trace/wrap.hpp"

namespace lqg::emit {

namespace {

std::string signal_lines(const char* what, const std::string& array, const std::vector<design::Signal>& signals) {
  std::string line;
  for (std::size_t i = 0; i < signals.size(); ++i)
    line += (i ? ", " : "") + array + "[" + std::to_string(i) + "] " + name_with_unit(signals[i]);
  return signals.empty() ? "" : "  " + trace::wrap(what + line, 6, 96) + "\n";
}

std::string integration_in_words(const Controller& controller) {
  if (controller.problem.plant.domain == design::Domain::discrete) return "";
  return controller.problem.estimator->extended->integrator == design::Integrator::euler
             ? "x̂ goes on by one step of Euler's, with u held.\n"
             : "x̂ goes on by one classical Runge-Kutta step of fourth order, with u held.\n";
}

std::string wraps_in_words(const Controller& controller) {
  std::string names;
  for (const int output : controller.problem.estimator->extended->wraps)
    names += (names.empty() ? "" : ", ") + controller.problem.plant.outputs[static_cast<std::size_t>(output)].name;
  return names.empty() ? "" : "  angles, whose y − h(x̂) is taken in [−π, π): " + names + "\n";
}

}  // namespace

std::string describe_extended_plant(const Controller& controller) {
  const design::Plant& plant = controller.problem.plant;
  const bool is_discrete = plant.domain == design::Domain::discrete;
  const std::string out = "\nPlant, sampled every " + number(design::Real(plant.sample_time), true) +
                          " s:  " + (is_discrete ? "x⁺ = f(x, u) + G w" : "ẋ = f(x, u)") + ",  y = h(x, u) + v\n\n";
  return out + signal_lines("states   ", "x", plant.states) + signal_lines("inputs   ", "u", plant.inputs) +
         signal_lines("outputs  ", "y", plant.outputs);
}

std::string describe_extended_filter(const Controller& controller) {
  const bool is_double = controller.target.is_double;
  std::string out =
      "\nExtended Kalman filter (u[k] depends on the outputs up to y[k]), covariance updated on line as\n" +
      std::string(controller.filter == step::Filter::ud ? "U diag(d) Uᵀ" : "a lower triangle") +
      ". All outputs of a sample are linearised at the estimate before them.\n" + integration_in_words(controller) +
      "Covariances per sample:\n\n";
  if (const auto& noise = controller.solution.noise) {
    out += matrix_lines("G", controller.solution.plant.G, is_double);
    out += matrix_lines("W = E[w wᵀ]", noise->W, is_double) + matrix_lines("V = E[v vᵀ]", noise->V, is_double);
  }
  return out + wraps_in_words(controller);
}

}  // namespace lqg::emit
