// SPDX-License-Identifier: MIT
#include "design/gains/pole_placement.hpp"

#include <algorithm>
#include <cstdio>

#include "design/checks/rounding_artefacts.hpp"
#include "design/checks/well_posed.hpp"

namespace lqg::design {

namespace {

using Complex = std::complex<double>;

std::string key_of(const WantedPoles& wanted, const std::string& section) {
  return section + (wanted.continuous ? ".continuous_poles" : ".poles");
}

std::string text_of(const Complex& pole) {
  char text[64];
  if (pole.imag() == 0)
    std::snprintf(text, sizeof text, "%.6g", pole.real());
  else
    std::snprintf(text, sizeof text, "[%.6g, %.6g]", pole.real(), pole.imag());
  return text;
}

bool is_stable(const WantedPoles& wanted, const Complex& pole) {
  if (wanted.continuous) return pole.real() < 0;
  const Real re = pole.real(), im = pole.imag();
  return re * re + im * im < 1;
}

// The poles with an imaginary part ≥ 0 in the z plane: z = e^(sT).
std::vector<ComplexReal> upper_half(const WantedPoles& wanted, double sample_time) {
  std::vector<ComplexReal> poles;
  for (const Complex& pole : wanted.values) {
    if (pole.imag() < 0) continue;
    const Real re = pole.real(), im = pole.imag();
    const Real size = exp(re * sample_time), angle = im * sample_time;
    poles.push_back(!wanted.continuous ? ComplexReal{re, im}
                    : pole.imag() == 0 ? ComplexReal{size, Real(0)}
                                       : ComplexReal{size * cos(angle), size * sin(angle)});
  }
  return poles;
}

std::vector<ComplexReal> with_conjugates(const std::vector<ComplexReal>& upper) {
  std::vector<ComplexReal> poles;
  for (const ComplexReal& pole : upper) {
    poles.push_back(pole);
    if (!pole.im.is_zero()) poles.push_back({pole.re, -pole.im});
  }
  return poles;
}

// The first pole that is wanted more often than `inputs` times.
const Complex* repeated_pole(const WantedPoles& wanted, std::size_t inputs) {
  for (const Complex& pole : wanted.values) {
    const auto count = std::count(wanted.values.begin(), wanted.values.end(), pole);
    if (static_cast<std::size_t>(count) > inputs) return &pole;
  }
  return nullptr;
}

// K for (A, B), which is reachable.
PlacedGain placed(const WantedPoles& wanted, const std::string& section, double sample_time, const RealMatrix& A,
                  const RealMatrix& B, const PlacementChoice* earlier, Findings& findings) {
  PlacedGain result;
  const std::vector<ComplexReal> upper = upper_half(wanted, sample_time);
  const std::optional<PlacementChoice> choice = earlier ? *earlier : choose_placement(A, B, upper);
  const std::optional<RealMatrix> gain = choice ? place(A, B, upper, *choice) : std::nullopt;
  const std::size_t inputs = choice ? choice->inputs.size() : static_cast<std::size_t>(B.cols());
  const Complex* repeated = inputs > 1 ? repeated_pole(wanted, inputs) : nullptr;
  if (gain && !repeated) {
    result.gain = *gain;
    result.choice = *choice;
    result.poles = with_conjugates(upper);
    return result;
  }
  result.may_want_digits = !repeated;
  add_error(findings, key_of(wanted, section),
            repeated ? text_of(*repeated) + " is wanted more than " + std::to_string(inputs) +
                           " times, once for each independent " + (section == "observer" ? "output" : "input")
                     : "there are no independent eigenvectors for these poles: repeat fewer of them");
  return result;
}

}  // namespace

void check_wanted_poles(const WantedPoles& wanted, const std::string& section, Eigen::Index states,
                        const std::string& of_which, Findings& findings) {
  const std::string key = key_of(wanted, section);
  if (static_cast<Eigen::Index>(wanted.values.size()) != states)
    add_error(findings, key,
              "expected " + std::to_string(states) + " poles, one for each state" + of_which + ", found " +
                  std::to_string(wanted.values.size()));
  for (auto pole = wanted.values.begin(); pole != wanted.values.end(); ++pole) {
    if (std::find(wanted.values.begin(), pole, *pole) != pole) continue;
    const auto own = std::count(wanted.values.begin(), wanted.values.end(), *pole);
    const auto other = std::count(wanted.values.begin(), wanted.values.end(), std::conj(*pole));
    if (own > other) add_error(findings, key, text_of(*pole) + " lacks its conjugate");
    if (is_stable(wanted, *pole)) continue;
    add_error(findings, key,
              text_of(*pole) + " is not stable: expected " +
                  (wanted.continuous ? "a negative real part" : "an absolute value below 1"));
  }
}

PlacedGain place_regulator(const Problem& problem, const SampledPlant& plant, const PlacementChoice* choice,
                           Findings& findings) {
  const WantedPoles& wanted = *problem.regulator->poles;
  PlacedGain result;
  check_wanted_poles(wanted, "pole_placement", plant.A.rows(),
                     problem.plant.delay > 0 ? " and each input on its way" : "", findings);
  if (!has_error(findings)) result.may_want_digits = !check_reachable(problem, plant, findings);
  if (!has_error(findings)) check_placement_is_no_artefact(problem, findings);
  if (has_error(findings)) return result;
  return placed(wanted, "pole_placement", problem.plant.sample_time, plant.A, plant.B, choice, findings);
}

PlacedGain place_observer(const Problem& problem, const Samples& samples, const PlacementChoice* choice,
                          Findings& findings) {
  const SampledPlant plant = own_plant(samples);
  const WantedPoles& wanted = *problem.estimator->poles;
  const bool filtered = problem.estimator->form == Form::filter;
  const RealMatrix seen = filtered ? multiply(plant.C, plant.A) : plant.C;
  PlacedGain result;
  check_wanted_poles(wanted, "observer", plant.A.rows(), "", findings);
  if (!has_error(findings)) result.may_want_digits = !check_observable(problem, plant, seen, findings);
  if (!has_error(findings)) check_observer_is_no_artefact(problem, findings);
  if (has_error(findings)) return result;
  result =
      placed(wanted, "observer", problem.plant.sample_time, plant.A.transpose(), seen.transpose(), choice, findings);
  result.gain.transposeInPlace();
  result.poles.resize(static_cast<std::size_t>(samples.plant.A.rows()), {Real(0), Real(0)});
  return result;
}

EstimatorSolution observer_of(const SampledPlant& plant, Form form, const RealMatrix& own_gain) {
  EstimatorSolution observer;
  const bool filtered = form == Form::filter;
  RealMatrix gain = zeros(plant.A.rows(), own_gain.cols());
  gain.topRows(own_gain.rows()) = own_gain;
  const RealMatrix none = zeros(gain.rows(), gain.cols());
  observer.L = filtered ? gain : none;
  observer.M = filtered ? none : gain;
  observer.L_predictor = filtered ? multiply(plant.A, gain) : gain;
  return observer;
}

}  // namespace lqg::design
