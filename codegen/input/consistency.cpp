// SPDX-License-Identifier: MIT
#include "input/consistency.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "design/numeric/digits.hpp"
#include "input/definite.hpp"
#include "input/disturbances.hpp"
#include "input/matrices.hpp"
#include "input/scenarios.hpp"

namespace lqg::input {
namespace {

bool has_any(const Values& values, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (values.has(key)) return true;
  return false;
}

void check_tables(const Values& values, Report& report) {
  const bool regulates = has_any(values, {"lqr", "pole_placement"});
  const bool estimates = has_any(values, {"kalman", "observer"});
  if (!regulates && !estimates) report.error("lqr", "expected [lqr], [kalman] or both, found neither");
  if (values.has("limits") && !regulates) report.error("limits", "needs [lqr]");
  if (values.has("require") && !regulates) report.error("require", "needs [lqr]");
  if (values.has("lqr") && values.has("pole_placement"))
    report.error("pole_placement", "expected [lqr] or [pole_placement], found both");
  if (values.has("kalman") && values.has("observer"))
    report.error("observer", "expected [kalman] or [observer], found both");
  if (values.tables.count("limits") != 0 &&
      !has_any(values, {"limits.u_min", "limits.u_max", "limits.u_rate", "limits.states", "limits.outputs",
                        "limits.output_rates"}))
    report.error("limits", "expected u_min, u_max or another limit, found none");
  if (values.tables.count("plant") == 0) return;
  for (const char* key : {"lqr", "pole_placement", "kalman.disturbance"})
    if (values.has(key) && !values.has_inputs())
      report.error(key, values.has("plant.f") ? "needs plant.inputs" : "needs plant.B");
  for (const char* key : {"kalman", "observer", "lqr.Q_output", "lqr.bryson.outputs", "lqr.integral", "lqr.track"})
    if (values.has(key) && !values.has_outputs())
      report.error(key, values.has("plant.f") ? "needs plant.h" : "needs plant.C");
}

// Nothing is said of a table that is not there.
void check_one_of(const Values& values, const std::string& table, const Alternatives& several, Report& report) {
  const auto& [rule, keys, need] = several;
  std::string first, list;
  for (const std::string& key : keys) {
    list += (list.empty() ? "" : key == keys.back() ? " or " : ", ") + key;
    if (!values.has(table + "." + key)) continue;
    if (!first.empty())
      report.error(table + "." + key, "says again what " + table + "." + first + " says: expected one of the two");
    first = key;
  }
  if (first.empty() && need == Need::required)
    report.error(table + "." + keys.front(), keys.size() == 1 ? "missing" : "missing: expected " + list);
}

void check_alternatives(const Values& values, Report& report) {
  const auto check_all = [&](const Alternatives& several) {
    for (const std::string& table : values.tables_like(several.table)) check_one_of(values, table, several, report);
  };
  for (const Alternatives& several : alternatives()) check_all(several);
  if (values.has("lqr.bryson") && values.has("lqr.R"))
    report.error("lqr.R", "says again what lqr.bryson says: expected one of the two");
  else if (!values.has("lqr.bryson"))
    check_all({"lqr", {"R"}, Need::required});
}

bool requires_of_loop(const Values& values) {
  return has_any(values, {"require.gain_margin_dB", "require.phase_margin_deg", "require.disk_margin",
                          "require.delay_margin", "require.max_pole"});
}

// A key that means something only beside another one.
void check_companions(const Values& values, Report& report) {
  const auto needs = [&](const char* key, bool good, const char* what) {
    if (values.has(key) && !good) report.error(key, std::string("needs ") + what);
  };
  const bool schedule = values.text("kalman.gain") == "schedule";
  needs("lqr.anti_windup", values.has("lqr.integral"), "lqr.integral");
  needs("lqr.Q_final", values.number("lqr.horizon", 0) > 0, "lqr.horizon > 0");
  needs("kalman.horizon", schedule || values.number("kalman.horizon", 0) == 0, "kalman.gain = \"schedule\"");
  const std::string gain = values.text("kalman.gain");
  needs("kalman.structure", gain.empty() || gain == "steady", "kalman.gain = \"steady\"");
  needs("kalman.recovery", has_any(values, {"lqr", "pole_placement"}),
        "[lqr] or [pole_placement]: without a regulator there is no loop");
  for (const char* key : {"kalman.integrator", "kalman.wraps"})
    needs(key, gain == "extended", "kalman.gain = \"extended\"");
  needs("kalman.integrator", values.text("plant.domain") != "discrete",
        "plant.domain = \"continuous\": plant.f of a discrete plant is the step itself");
  needs("kalman.recovery", gain != "online" && gain != "extended",
        "kalman.gain = \"steady\" or \"schedule\": a covariance that is carried with noise that is not there would not "
        "be that of the error");
  needs("kalman.recovery", !values.has("kalman.structure"),
        "a gain without kalman.structure: that gain is the best one for the noise itself");
  needs("kalman.recovery", values.text("kalman.recovery") != "auto" || requires_of_loop(values),
        "a margin or max_pole in [require] for \"auto\": without one there is nothing to meet");
  for (const std::string& stage : values.tables_of("stage")) {
    for (const char* key : {".A", ".B", ".C", ".D"})
      needs((stage + key).c_str(), !values.has("plant.f"), "a plant of matrices: plant.f is one for all samples");
    for (const char* key : {".Q", ".R", ".N"}) needs((stage + key).c_str(), values.has("lqr"), "[lqr]");
    for (const char* key : {".process_noise", ".measurement_noise"})
      needs((stage + key).c_str(), values.has("kalman"), "[kalman]");
  }
  if (values.has("pole_placement")) needs("stage", false, "[lqr]: poles are placed for one plant");
  if (values.has("observer")) needs("stage", false, "[kalman]: poles are placed for one plant");
}

// The periods that an input is on its way; rather a bound than more than can be counted.
double periods_of_delay(const Values& values) {
  const double periods = values.number("plant.delay", 0) / values.number("plant.sample_time", 1);
  const double whole = std::round(periods);
  return std::abs(periods - whole) <= 1e-9 * periods ? whole : std::ceil(periods);
}

// Inputs on their way are states of the controller's model.
void check_delay(const Values& values, Report& report) {
  const double nx = values.sizes.at(Size::nx), nu = values.sizes.at(Size::nu), periods = periods_of_delay(values);
  if (nx > 0 && nu > 0 && nx + periods * nu > most_signals)
    report.error("plant.delay", "expected at most " + std::to_string(most_signals) +
                                    " states together with the inputs on their way, found " + shown(nx + periods * nu));
}

// All in the left half-plane, and some outside of the unit circle: meant for s.
void check_plane_of_poles(const Values& values, Report& report) {
  for (const char* table : {"pole_placement", "observer"}) {
    const auto found = values.poles.find(std::string(table) + ".poles");
    if (found == values.poles.end()) continue;
    const auto& poles = found->second;
    const bool all_left = std::all_of(poles.begin(), poles.end(), [](const auto& pole) { return pole.real() < 0; });
    const auto outside = std::find_if(poles.begin(), poles.end(), [](const auto& pole) { return std::abs(pole) >= 1; });
    if (all_left && outside != poles.end())
      report.error(found->first, "expected poles z inside of the unit circle, found " + shown(outside->real()) +
                                     (outside->imag() == 0 ? "" : " ± " + shown(std::abs(outside->imag())) + "j") +
                                     "; poles s of the continuous plane go to `continuous_poles`");
  }
}

// A pole for every state, and of a regulator for every input on its way, too.
void check_number_of_poles(const Values& values, Report& report) {
  const double nx = values.sizes.at(Size::nx), nu = values.sizes.at(Size::nu);
  for (const std::string& table : {std::string("pole_placement"), std::string("observer")})
    for (const std::string& key : {table + ".poles", table + ".continuous_poles"}) {
      const auto found = values.poles.find(key);
      if (found == values.poles.end() || nx < 1) continue;
      const double on_their_way = table == "observer" ? 0 : periods_of_delay(values) * std::max(0.0, nu);
      const double count = static_cast<double>(found->second.size());
      if (count != nx + on_their_way)
        report.error(key, "expected " + shown(nx + on_their_way) + " poles, one for each state" +
                              (on_their_way > 0 ? " and each input on its way" : "") + ", found " + shown(count));
    }
}

// No more outputs can be held than there are inputs.
void check_held_outputs(const Values& values, Report& report) {
  const int nu = values.sizes.at(Size::nu);
  for (const char* key : {"lqr.track", "lqr.integral.outputs"}) {
    const auto held = values.indices.find(key);
    if (held != values.indices.end() && nu > 0 && static_cast<int>(held->second.size()) > nu)
      report.error(key, "expected at most as many outputs as inputs (" + std::to_string(nu) + "), found " +
                            std::to_string(held->second.size()));
  }
}

void check_numbers(const Values& values, Report& report) {
  const double decay = values.number("lqr.decay", 1);
  if (decay < 1 && values.text("lqr.cost") != "continuous")
    report.error("lqr.decay", "expected a number ≥ 1, found " + shown(decay));
  const double periods = values.number("plant.delay", 0) / values.number("plant.sample_time", 1);
  if (values.text("plant.domain") == "discrete" && std::abs(periods - std::round(periods)) > 1e-9 * periods)
    report.error("plant.delay", "expected whole periods with a discrete plant, found " + shown(periods) + " periods");
  double before = 0;
  for (const std::string& stage : values.tables_of("stage")) {
    const double from = values.number(stage + ".from", before + 1);
    if (from <= before) report.error(stage + ".from", "expected more than " + shown(before) + ", found " + shown(from));
    before = from;
  }
}

void check_domain(const Values& values, Report& report) {
  if (values.tables.count("plant") != 0 && !values.has("plant.domain"))
    report.note("plant.domain", "missing, taken for \"continuous\"");
  if (values.text("plant.domain") != "discrete") return;
  const std::string cost = values.text("lqr.cost");
  if (!cost.empty() && cost != "discrete")
    report.error("lqr.cost", "expected \"discrete\" with a discrete plant, found \"" + cost + "\"");
  if (values.text("kalman.noise") == "continuous")
    report.error("kalman.noise", "expected \"discrete\" with a discrete plant, found \"continuous\"");
}

// Correlation times make densities of variances.
void check_correlation_times(const Values& values, Report& report) {
  const char* const keys[] = {"kalman.process_correlation_time", "kalman.measurement_correlation_time"};
  const std::string noise = values.text("kalman.noise");
  const bool discrete = noise.empty() ? values.text("plant.domain") == "discrete" : noise == "discrete";
  for (const char* key : keys)
    if (values.has(key) && discrete) report.error(key, "needs kalman.noise = \"continuous\"");
  if (values.has("kalman.cross_noise") && values.has(keys[0]) != values.has(keys[1]))
    report.error("kalman.cross_noise", "needs both correlation times or none");
}

// Keys that stand in the file for nothing.
void note_unused(const Values& values, Report& report) {
  const bool estimates = has_any(values, {"kalman", "observer"});
  const bool sees = has_any(values, {"lqr.Q_output", "lqr.bryson.outputs", "lqr.integral", "lqr.track"});
  if (values.has("plant.C") && !estimates && !sees)
    report.note("plant.C", "not used without [kalman]: u = −K x of the measured states");
  for (const char* key : {"plant.G", "plant.H"})
    if (values.has(key) && !values.has("kalman")) report.note(key, "not used without [kalman]");
  const std::string gain = values.text("kalman.gain");
  if (values.text("kalman.covariance") == "plain" && gain != "online" && gain != "extended")
    report.note("kalman.covariance", "not used without gain = \"online\" or \"extended\"");
}

// With all digits that its entries have.
design::ExactMatrix symmetric(const design::ExactMatrix& Q) {
  const design::RealMatrix* exact = Q.exact();
  if (exact == nullptr) return symmetrised(Q);
  const design::Digits scope(design::exact_digits);
  return design::ExactMatrix::of(*exact + (exact->transpose() - *exact) / design::Real(2));
}

// False, and nothing reported, when there is no such matrix.
bool make_symmetric(Values& values, const std::string& key, Report& report) {
  const auto found = values.matrices.find(key);
  if (found == values.matrices.end()) return false;
  const Asymmetry worst = worst_asymmetry(found->second);
  const std::string row = std::to_string(worst.row);
  const std::string column = std::to_string(worst.column);
  const std::string entry = "[" + row + "][" + column + "] = " + shown(found->second(worst.row, worst.column));
  const std::string mirror = "[" + column + "][" + row + "] = " + shown(found->second(worst.column, worst.row));
  if (worst.size > symmetry_tolerance) {
    report.error(key, "expected a symmetric matrix, found " + entry + " and " + mirror);
    return false;
  }
  if (worst.size > 0) report.note(key, "symmetrised: found " + entry + " and " + mirror);
  found->second = symmetric(found->second);
  return true;
}

// True for a matrix that is there, symmetric and definite as it must be.
bool check_weight(Values& values, const std::string& key, bool strictly, Report& report) {
  if (!make_symmetric(values, key, report)) return false;
  const auto culprit = indefinite(values.matrices[key], strictly);
  if (!culprit) return true;
  const std::string wanted =
      strictly ? "expected a positive definite matrix" : "expected a positive semidefinite matrix";
  report.error(key, wanted + ", found " + *culprit);
  return false;
}

void check_joint(const Values& values, const std::string& first, const std::string& cross, const std::string& second,
                 const std::string& layout, Report& report) {
  const Eigen::MatrixXd* N = values.matrix(cross);
  const Eigen::MatrixXd* Q = values.matrix(first);
  const Eigen::MatrixXd* R = values.matrix(second);
  if (N == nullptr || N->rows() != Q->rows() || N->cols() != R->rows()) return;
  if (const auto culprit = indefinite(joint(*Q, *N, *R), false))
    report.error(cross, "expected " + layout + " positive semidefinite, found " + *culprit);
}

void check_definiteness(Values& values, Report& report) {
  const bool Q = check_weight(values, "lqr.Q", false, report);
  const bool R = check_weight(values, "lqr.R", false, report);
  if (Q && R) check_joint(values, "lqr.Q", "lqr.N", "lqr.R", "[Q N; Nᵀ R]", report);
  const bool W = check_weight(values, "kalman.process_noise", false, report);
  const bool helped = values.has("plant.H");  // noise on every output may come from H, too
  const bool V = check_weight(values, "kalman.measurement_noise", !helped, report);
  if (W && V)
    check_joint(values, "kalman.process_noise", "kalman.cross_noise", "kalman.measurement_noise", "[W Swv; Swvᵀ V]",
                report);
  for (const char* key :
       {"lqr.Q_output", "lqr.Q_final", "lqr.integral.Q", "lqr.input_rate", "kalman.initial_covariance"})
    check_weight(values, key, false, report);
  for (const std::string& stage : values.tables_of("stage")) {
    for (const char* key : {".Q", ".R", ".process_noise"}) check_weight(values, stage + key, false, report);
    check_weight(values, stage + ".measurement_noise", !helped, report);
  }
}

// min < max in every entry, with −∞ and +∞ for a list that is absent.
void check_range(const Values& values, const std::string& table, const std::string& low, const std::string& high,
                 const std::string& signal, Report& report) {
  const Eigen::MatrixXd* lower = values.matrix(table + low);
  const Eigen::MatrixXd* upper = values.matrix(table + high);
  const long count = lower != nullptr ? lower->rows() : upper != nullptr ? upper->rows() : 0;
  if (lower != nullptr && upper != nullptr && lower->rows() != upper->rows()) return;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (long i = 0; i < count; ++i) {
    const double least = lower != nullptr ? (*lower)(i, 0) : -infinity;
    const double most = upper != nullptr ? (*upper)(i, 0) : infinity;
    if (least < most) continue;
    report.error(table + (upper != nullptr ? high : low), "expected " + low + " < " + high + ", found " + shown(least) +
                                                              " and " + shown(most) + " for " + signal + " " +
                                                              std::to_string(i));
  }
}

// What means something only where limits are foreseen, and blocks that are the horizon.
void check_horizon(const Values& values, Report& report) {
  const double horizon = values.number("limits.horizon", 0);
  for (const char* key :
       {"limits.blocks", "limits.states", "limits.outputs", "limits.output_rates", "limits.price", "limits.iterations"})
    if (values.has(key) && horizon == 0) report.error(key, "needs limits.horizon > 0: only then limits are foreseen");
  const auto blocks = values.indices.find("limits.blocks");
  if (horizon == 0 || blocks == values.indices.end()) return;
  const long sum = std::accumulate(blocks->second.begin(), blocks->second.end(), 0L);
  if (static_cast<double>(sum) != horizon)
    report.error("limits.blocks", "expected lengths that add up to limits.horizon = " + shown(horizon) + ", found " +
                                      std::to_string(sum));
}

// u_rate > 0, and what is between two limits is something.
void check_limits(const Values& values, Report& report) {
  if (const Eigen::MatrixXd* rate = values.matrix("limits.u_rate"))
    for (int i = 0; i < rate->rows(); ++i)
      if (!((*rate)(i, 0) > 0))
        report.error("limits.u_rate",
                     "expected numbers > 0, found " + shown((*rate)(i, 0)) + " for input " + std::to_string(i));
  check_range(values, "limits.", "u_min", "u_max", "input", report);
  check_horizon(values, report);
  check_range(values, "kalman.", "output_min", "output_max", "output", report);
}

}  // namespace

void check_consistency(Values& values, Report& report) {
  check_tables(values, report);
  check_alternatives(values, report);
  check_companions(values, report);
  check_numbers(values, report);
  check_delay(values, report);
  check_added_states(values, report);
  check_plane_of_poles(values, report);
  check_number_of_poles(values, report);
  check_held_outputs(values, report);
  check_domain(values, report);
  check_correlation_times(values, report);
  check_definiteness(values, report);
  check_limits(values, report);
  check_scenarios(values, report);
  note_unused(values, report);
}

}  // namespace lqg::input
