#include "input/consistency.hpp"

#include <cmath>
#include <limits>

#include "input/definite.hpp"

namespace lqg::input {
namespace {

bool has_any(const Values& values, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (values.has(key)) return true;
  return false;
}

void check_tables(const Values& values, Report& report) {
  if (!has_any(values, {"lqr", "kalman", "observer", "pole_placement"}))
    report.error("lqr", "expected [lqr], [kalman] or both, found neither");
  if (values.has("limits") && !has_any(values, {"lqr", "pole_placement"}))
    report.error("limits", "needs [lqr]");
  if (values.tables.count("limits") != 0 &&
      !has_any(values, {"limits.u_min", "limits.u_max", "limits.u_rate"}))
    report.error("limits", "expected u_min, u_max or both, found neither");
  if (values.tables.count("plant") == 0) return;
  if (values.has("lqr") && !values.has("plant.B")) report.error("lqr", "needs plant.B");
  if (values.has("kalman") && !values.has("plant.C")) report.error("kalman", "needs plant.C");
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

// Keys that stand in the file for nothing.
void note_unused(const Values& values, Report& report) {
  const bool estimates = has_any(values, {"kalman", "observer"});
  if (values.has("plant.C") && !estimates)
    report.note("plant.C", "not used without [kalman]: u = −K x of the measured states");
  if (values.has("plant.G") && !estimates) report.note("plant.G", "not used without [kalman]");
  if (values.text("kalman.covariance") == "plain" && values.text("kalman.gain") != "online")
    report.note("kalman.covariance", "not used with gain = \"steady\"");
}

// False, and nothing reported, when there is no such matrix.
bool make_symmetric(Values& values, const std::string& key, Report& report) {
  const auto found = values.matrices.find(key);
  if (found == values.matrices.end()) return false;
  const Asymmetry worst = worst_asymmetry(found->second);
  const std::string row = std::to_string(worst.row);
  const std::string column = std::to_string(worst.column);
  const std::string entry =
      "[" + row + "][" + column + "] = " + shown(found->second(worst.row, worst.column));
  const std::string mirror =
      "[" + column + "][" + row + "] = " + shown(found->second(worst.column, worst.row));
  if (worst.size > symmetry_tolerance) {
    report.error(key, "expected a symmetric matrix, found " + entry + " and " + mirror);
    return false;
  }
  if (worst.size > 0) report.note(key, "symmetrised: found " + entry + " and " + mirror);
  found->second = symmetrised(found->second);
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

void check_joint(const Values& values, const std::string& first, const std::string& cross,
                 const std::string& second, const std::string& layout, Report& report) {
  const Eigen::MatrixXd* N = values.matrix(cross);
  const Eigen::MatrixXd* Q = values.matrix(first);
  const Eigen::MatrixXd* R = values.matrix(second);
  if (N == nullptr || N->rows() != Q->rows() || N->cols() != R->rows()) return;
  if (const auto culprit = indefinite(joint(*Q, *N, *R), false))
    report.error(cross, "expected " + layout + " positive semidefinite, found " + *culprit);
}

void check_definiteness(Values& values, Report& report) {
  const bool Q = check_weight(values, "lqr.Q", false, report);
  const bool R = check_weight(values, "lqr.R", true, report);
  if (Q && R) check_joint(values, "lqr.Q", "lqr.N", "lqr.R", "[Q N; Nᵀ R]", report);
  const bool W = check_weight(values, "kalman.process_noise", false, report);
  const bool V = check_weight(values, "kalman.measurement_noise", true, report);
  if (W && V)
    check_joint(values, "kalman.process_noise", "kalman.cross_noise", "kalman.measurement_noise",
                "[W Swv; Swvᵀ V]", report);
  check_weight(values, "kalman.initial_covariance", false, report);
}

// u_min < u_max in every entry, with −∞ and +∞ for a list that is absent.
void check_limits(const Values& values, Report& report) {
  const Eigen::MatrixXd* lower = values.matrix("limits.u_min");
  const Eigen::MatrixXd* upper = values.matrix("limits.u_max");
  const long count = lower != nullptr ? lower->rows() : upper != nullptr ? upper->rows() : 0;
  if (lower != nullptr && upper != nullptr && lower->rows() != upper->rows()) return;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (long i = 0; i < count; ++i) {
    const double u_min = lower != nullptr ? (*lower)(i, 0) : -infinity;
    const double u_max = upper != nullptr ? (*upper)(i, 0) : infinity;
    if (u_min < u_max) continue;
    const std::string key = upper != nullptr ? "limits.u_max" : "limits.u_min";
    report.error(key, "expected u_min < u_max, found " + shown(u_min) + " and " + shown(u_max) +
                          " for input " + std::to_string(i));
  }
}

}  // namespace

void check_consistency(Values& values, Report& report) {
  check_tables(values, report);
  check_domain(values, report);
  check_definiteness(values, report);
  check_limits(values, report);
  note_unused(values, report);
}

}  // namespace lqg::input
