// SPDX-License-Identifier: MIT
#include "design/checks/mode_names.hpp"

#include "design/numeric/poles.hpp"
#include "design/sampled/augmentation.hpp"

namespace lqg::design {

std::string name_states(const Plant& plant, const std::vector<Index>& states) {
  const std::size_t most = 8;
  std::string text = states.size() == 1 ? "state " : "states ";
  for (std::size_t i = 0; i < states.size() && i < most; ++i) {
    const std::size_t state = static_cast<std::size_t>(states[i]);
    if (i > 0) text += ", ";
    text += state < plant.states.size() ? plant.states[state].name : "x" + std::to_string(state);
  }
  if (states.size() > most) text += " and " + std::to_string(states.size() - most) + " more";
  return text;
}

ComplexReal sampled_pole(const ComplexReal& s, double sample_time) {
  const Real size = exp(s.re * sample_time), angle = s.im * sample_time;
  return {size * cos(angle), size * sin(angle)};
}

namespace {

// s = ln(z)/T
ComplexReal continuous_pole(const ComplexReal& z, double sample_time) {
  return {log(hypot(z.re, z.im)) / sample_time, atan2(z.im, z.re) / sample_time};
}

}  // namespace

std::string name_mode(const Plant& plant, const Mode& mode, bool is_continuous) {
  const double T = plant.sample_time;
  const std::string states = name_states(plant, mode.states);
  if (plant.domain == Domain::discrete) return "the mode at z = " + short_complex(mode.value, 1) + " (" + states + ")";
  const ComplexReal s = is_continuous ? mode.value : continuous_pole(mode.value, T);
  const ComplexReal z = is_continuous ? sampled_pole(mode.value, T) : mode.value;
  return "the mode at s = " + short_complex(s, norm(real(plant.A))) + " (z = " + short_complex(z, 1) + "; " + states +
         ")";
}

Decay decay_per_mode(const Problem& problem) {
  const Real value = decay_of(problem), T = problem.plant.sample_time;
  if (problem.regulator->cost == Cost::continuous) return {exp(value * T), value};
  return {value, log(value) / T};
}

}  // namespace lqg::design
