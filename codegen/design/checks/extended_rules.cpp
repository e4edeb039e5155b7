// SPDX-License-Identifier: MIT
#include "design/checks/extended_rules.hpp"

#include "design/numeric/linear_algebra.hpp"

namespace lqg::design {

namespace {

struct ExtendedRule {
  const char* key;
  bool is_broken;
  const char* expected;
};

void check_plant_beside_extended(const Problem& problem, Findings& findings) {
  const Plant& plant = problem.plant;
  const bool is_late = plant.output_delay.size() > 0 && !plant.output_delay.isZero(0);
  const ExtendedRule rules[] = {
      {"plant.delay", plant.delay > 0, "expected none: inputs on their way are no states of plant.f"},
      {"plant.output_delay", is_late, "expected none: outputs on their way are no states of plant.f"},
      {"plant.dropout", (plant.dropout.array() > 0).any(),
       "expected none: an output that is NaN is left out, and P knows of it"},
      {"plant.jitter", plant.jitter > 0, "expected none: P is that of equal periods"},
      {"plant.H", !plant.H.isZero(0), "expected zeros: the noise of the outputs would be that of the states, too"},
      {"uncertain", !problem.uncertain.empty(), "expected none: say it as process noise"},
      {"stage", !problem.stages.empty(), "expected none: what changes is in plant.f"},
      {"compensator.order", problem.compensator.has_value(), "expected none: the filter has the states of plant.f"}};
  for (const ExtendedRule& rule : rules)
    if (rule.is_broken) add_error(findings, rule.key, std::string("with kalman.gain = \"extended\" ") + rule.expected);
}

void check_extended_filter(const Problem& problem, Findings& findings) {
  const Estimator& kalman = *problem.estimator;
  const ExtendedRule rules[] = {
      {"kalman.form", kalman.form == Form::predictor, "expected \"filter\""},
      {"kalman.cross_noise", !kalman.Swv.isZero(0), "expected zeros"},
      {"kalman.disturbance", !kalman.disturbance.empty(),
       "expected none: write the disturbance as a state of plant.f, with process noise"},
      {"code.style", problem.code.style == Style::compact,
       "expected \"unrolled\" or \"auto\": the library's loops are of matrices"},
      {"code.realisation",
       problem.code.realisation != Realisation::physical && problem.code.realisation != Realisation::cheapest,
       "expected \"physical\": the states are those of plant.f"}};
  for (const ExtendedRule& rule : rules)
    if (rule.is_broken) add_error(findings, rule.key, std::string("with kalman.gain = \"extended\" ") + rule.expected);
  for (const int output : kalman.extended->wraps)
    if (output < 0 || output >= static_cast<int>(problem.plant.C.rows()))
      add_error(findings, "kalman.wraps", "expected outputs, by name or by number from 0");
}

// The law is that of a constant K.
void check_law_beside_extended(const Problem& problem, Findings& findings) {
  if (!problem.regulator) return;
  const Regulator& law = *problem.regulator;
  const ExtendedRule rules[] = {
      {"lqr.horizon", law.horizon > 0, "expected 0: the law is a constant K"},
      {"lqr.integral", law.integral.has_value(), "expected none: write ξ as a state of plant.f"},
      {"lqr.track", !law.track.empty(), "expected none: the law holds the operating point"},
      {"lqr.input_rate", law.input_rate.size() > 0, "expected none"},
      {"limits.horizon", foresees(problem.limits), "expected 0: u is clipped"}};
  for (const ExtendedRule& rule : rules)
    if (rule.is_broken) add_error(findings, rule.key, std::string("with kalman.gain = \"extended\" ") + rule.expected);
}

}  // namespace

void check_extended(const Problem& problem, Findings& findings) {
  if (!problem.estimator || !problem.estimator->extended) return;
  if (!problem.plant.equations)
    return add_error(findings, "kalman.gain", "\"extended\" needs plant.f and plant.h: the filter is of equations");
  check_plant_beside_extended(problem, findings);
  check_extended_filter(problem, findings);
  check_law_beside_extended(problem, findings);
}

}  // namespace lqg::design
