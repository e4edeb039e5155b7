// SPDX-License-Identifier: MIT
#include "design/checks/order_rules.hpp"

#include <cmath>
#include <functional>

#include "design/numeric/poles.hpp"
#include "design/sampled/added_states.hpp"
#include "design/sampled/delay.hpp"
#include "design/sampled/reference.hpp"

namespace lqg::design {

namespace {

void check_dropout(const Problem& problem, Findings& findings) {
  const Plant& plant = problem.plant;
  if (plant.dropout.size() > 0 && !problem.estimator)
    return add_error(findings, "plant.dropout", "needs [kalman]: a regulator of measured states has no outputs");
  for (Index i = 0; i < plant.dropout.size(); ++i)
    if (!(plant.dropout(i) >= 0 && plant.dropout(i) < 1))
      add_error(findings, "plant.dropout",
                "expected a probability from 0 to below 1, found " + short_number(plant.dropout(i)) + " for output " +
                    std::to_string(i));
}

void check_jitter(const Problem& problem, Findings& findings) {
  const Plant& plant = problem.plant;
  if (plant.jitter == 0) return;
  if (plant.domain == Domain::discrete)
    add_error(findings, "plant.jitter",
              "needs plant.domain = \"continuous\": what a period does to the samples of a "
              "discrete plant is not known; say it as [[uncertain]]");
  if (plant.delay > 0)
    add_error(findings, "plant.jitter",
              "needs a plant without plant.delay: expected none of the two, or the sum of "
              "their effects as [[uncertain]]");
  if (plant.jitter >= plant.sample_time)
    add_error(findings, "plant.jitter",
              "expected less than plant.sample_time, " + short_number(plant.sample_time) + ", found " +
                  short_number(plant.jitter));
  if (!problem.regulator && plant.B.cols() > 0)
    add_error(findings, "plant.jitter",
              "needs [lqr] where the plant has inputs: what u adds is not known without a law");
}

void check_table(const Problem& problem, std::size_t i, Findings& findings) {
  const Uncertain& of = problem.uncertain[i];
  const std::string table = "uncertain[" + std::to_string(i) + "]";
  const auto says = [](const Eigen::MatrixXd& a) { return a.size() > 0 && !a.isZero(0); };
  if (!says(of.A) && !says(of.B) && !says(of.C))
    return add_error(findings, table, "expected A, B or C with an entry that is not 0");
  if (says(of.B) && !problem.regulator)
    add_error(findings, table + ".B", "needs [lqr]: what u adds is not known without a law");
  if (says(of.B) && problem.plant.delay > 0)
    add_error(findings, table + ".B", "needs a plant without plant.delay: model it as states of a discrete plant");
  if (says(of.C) && !problem.estimator)
    add_error(findings, table + ".C", "needs [kalman]: a regulator of measured states has no outputs");
  if (says(of.B) && says(of.C) && problem.estimator && problem.estimator->form == Form::filter)
    add_error(findings, table,
              "expected form = \"predictor\", or B and C in two tables: in filter form u answers y at once, and the "
              "square of γ would act");
}

// One thing that does not go together with `what`.
struct Rule {
  bool is_broken;
  const char* key;
  const char* why;
};

void check_rules(const std::vector<Rule>& rules, const std::string& what, Findings& findings) {
  for (const Rule& rule : rules)
    if (rule.is_broken) add_error(findings, rule.key, "does not go together with " + what + ": " + rule.why);
}

std::vector<Rule> rules_of_any(const Problem& problem) {
  return {
      {!problem.stages.empty(), "stage", "the optimum is one of a plant that does not change"},
      {problem.regulator && problem.regulator->poles, "pole_placement", "it has a cost to minimise, expected [lqr]"},
      {problem.estimator && problem.estimator->poles, "observer", "it counts with noises, expected [kalman]"}};
}

std::vector<Rule> rules_of_regulator(const Problem& problem) {
  const Regulator& lqr = *problem.regulator;
  return {{lqr.horizon > 0, "lqr.horizon", "the optimum is one of the long run"},
          {lqr.decay.has_value(), "lqr.decay", "the cost decides on the poles"},
          {lqr.settling_time.has_value(), "lqr.settling_time", "the cost decides on the poles"},
          {lqr.structure.size() > 0, "lqr.structure", "the optimum uses all that there is"},
          {lqr.integral.has_value(), "lqr.integral", "model what is to be integrated as a state of the plant"},
          {lqr.input_rate.size() > 0, "lqr.input_rate", "model the last input as a state of the plant"},
          {foresees(problem.limits), "limits.horizon", "limits are foreseen with the certain model"}};
}

std::vector<Rule> rules_of_estimator(const Problem& problem) {
  const Estimator& kalman = *problem.estimator;
  return {{kalman.gain != Gain::steady, "kalman.gain", "expected \"steady\""},
          {kalman.structure.size() > 0, "kalman.structure", "the optimum uses all that there is"},
          {kalman.recovery.has_value(), "kalman.recovery", "it is a recipe for the filter of LQG"},
          {!kalman.disturbance.empty(), "kalman.disturbance", "model the disturbance as a state of the plant"},
          {late_output_count(problem) > 0, "plant.output_delay", "model it as states of a discrete plant"}};
}

std::vector<Rule> rules_of_compensator(const Problem& problem) {
  const Estimator& kalman = *problem.estimator;
  return {
      {problem.limits.has_value(), "limits", "it does not hear of the input that was applied"},
      {kalman.gate > 0, "kalman.gate", "it keeps no covariance to compare outputs with"},
      {kalman.spike && std::isfinite(*kalman.spike), "kalman.spike", "it keeps no covariance to compare outputs with"},
      {kalman.output_min.size() > 0, "kalman.output_min", "it has no updates of single outputs"},
      {kalman.output_max.size() > 0, "kalman.output_max", "it has no updates of single outputs"},
      {problem.code.style == Style::compact, "code.style", "the library's loops are of a filter and a law"},
      {!problem.regulator->track.empty(), "lqr.track", "its law follows no reference"}};
}

// Noise of the outputs that the integral of the cost meets again.
bool answers_noise_of_period(const Problem& problem) {
  return problem.plant.domain == Domain::continuous && problem.regulator->cost == Cost::sampled &&
         problem.estimator->form == Form::filter && (!problem.plant.H.isZero(0) || !problem.estimator->Swv.isZero(0));
}

void check_continuous(const Problem& problem, Findings& findings) {
  if (problem.regulator->cost != Cost::continuous) return;
  if (has_white_parameters(problem))
    add_error(findings, "lqr.cost", "white parameters are those of the samples: expected \"sampled\" or \"discrete\"");
  if (problem.estimator && problem.estimator->noise != Noise::continuous)
    add_error(findings, "kalman.noise", "the continuous compensator counts with densities: expected \"continuous\"");
}

// Of the plant with its inputs on their way, and the last input where y tells it.
int states_of(const Problem& problem) {
  const Plant& plant = problem.plant;
  const Index own = plant.A.rows() + delay_of(plant).samples * plant.B.cols();
  const bool remembers = problem.estimator->form == Form::filter && plant.delay == 0 && !plant.D.isZero(0);
  return static_cast<int>(own + (remembers ? plant.B.cols() : 0));
}

void check_order(const Problem& problem, Findings& findings) {
  if (!has_cost(problem.regulator) || !has_noise(problem.estimator))
    return add_error(findings, "compensator.order", "needs [lqr] with weights and [kalman] with noises");
  const int order = problem.compensator->order, most = states_of(problem);
  if (order < 1 || order > most)
    add_error(findings, "compensator.order",
              "expected 1 to " + std::to_string(most) + ", the states of the plant" +
                  (most > problem.plant.A.rows() ? " and the inputs that it remembers" : "") + ", found " +
                  std::to_string(order));
}

}  // namespace

void check_order_and_white(const Problem& problem, Findings& findings) {
  check_dropout(problem, findings);
  check_jitter(problem, findings);
  for (std::size_t i = 0; i < problem.uncertain.size(); ++i) check_table(problem, i, findings);
  if (!problem.compensator && !has_white_parameters(problem)) return;
  const std::string what = problem.compensator ? "[compensator]" : "white parameters";
  check_rules(rules_of_any(problem), what, findings);
  if (has_error(findings)) return;
  if (problem.compensator) check_order(problem, findings);
  if (problem.regulator) check_rules(rules_of_regulator(problem), what, findings);
  if (problem.estimator) check_rules(rules_of_estimator(problem), what, findings);
  if (problem.regulator) check_continuous(problem, findings);
  if (has_error(findings) || !is_of_given_order(problem)) return;
  check_rules(rules_of_compensator(problem), what, findings);
  if (answers_noise_of_period(problem))
    add_error(findings, "kalman.form",
              "expected \"predictor\": with noise in the outputs that acts on the states, too, u of the same y would "
              "meet it again within the period");
}

}  // namespace lqg::design
