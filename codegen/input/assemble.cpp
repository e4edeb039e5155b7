#include "input/assemble.hpp"

#include <limits>

namespace lqg::input {
namespace {

Eigen::MatrixXd zero_or(const Values& values, const std::string& key, int rows, int columns) {
  const Eigen::MatrixXd* matrix = values.matrix(key);
  return matrix != nullptr ? *matrix : Eigen::MatrixXd::Zero(rows, columns);
}

Eigen::MatrixXd identity_or(const Values& values, const std::string& key, int size) {
  const Eigen::MatrixXd* matrix = values.matrix(key);
  return matrix != nullptr ? *matrix : Eigen::MatrixXd::Identity(size, size);
}

// Names of the file, or "x0", "x1" …
std::vector<design::Signal> signals(const Values& values, const std::string& key, const char* letter,
                                    int count) {
  const auto found = values.signals.find(key);
  if (found != values.signals.end()) return found->second;
  std::vector<design::Signal> result;
  for (int i = 0; i < count; ++i) result.push_back({letter + std::to_string(i), ""});
  return result;
}

design::Plant plant(const Values& values) {
  const int nx = values.sizes.at(Size::nx);
  const int nu = values.sizes.at(Size::nu);
  const int ny = values.sizes.at(Size::ny);
  design::Plant result;
  const bool discrete = values.text("plant.domain") == "discrete";
  result.domain = discrete ? design::Domain::discrete : design::Domain::continuous;
  result.sample_time = values.numbers.at("plant.sample_time");
  result.A = *values.matrix("plant.A");
  result.B = zero_or(values, "plant.B", nx, nu);
  result.C = zero_or(values, "plant.C", ny, nx);
  result.D = zero_or(values, "plant.D", ny, nu);
  result.G = identity_or(values, "plant.G", nx);
  result.states = signals(values, "plant.states", "x", nx);
  result.inputs = signals(values, "plant.inputs", "u", nu);
  result.outputs = signals(values, "plant.outputs", "y", ny);
  return result;
}

design::Regulator regulator(const Values& values, const design::Plant& plant) {
  design::Regulator result;
  result.Q = *values.matrix("lqr.Q");
  result.R = *values.matrix("lqr.R");
  result.N = zero_or(values, "lqr.N", static_cast<int>(plant.A.rows()), static_cast<int>(plant.B.cols()));
  const std::string cost = values.text("lqr.cost");
  const bool discrete = cost.empty() ? plant.domain == design::Domain::discrete : cost == "discrete";
  result.cost = cost == "continuous" ? design::Cost::continuous
                : discrete           ? design::Cost::discrete
                                     : design::Cost::sampled;
  return result;
}

design::Estimator estimator(const Values& values, const design::Plant& plant) {
  const int nx = static_cast<int>(plant.A.rows());
  design::Estimator result;
  result.W = *values.matrix("kalman.process_noise");
  result.V = *values.matrix("kalman.measurement_noise");
  result.Swv = zero_or(values, "kalman.cross_noise", static_cast<int>(plant.G.cols()),
                       static_cast<int>(plant.C.rows()));
  const std::string noise = values.text("kalman.noise");
  const bool discrete = noise.empty() ? plant.domain == design::Domain::discrete : noise == "discrete";
  result.noise = discrete ? design::Noise::discrete : design::Noise::continuous;
  const auto says = [&](const char* key, const char* word) { return values.text(key) == word; };
  result.gain = says("kalman.gain", "online") ? design::Gain::online : design::Gain::steady;
  result.form = says("kalman.form", "predictor") ? design::Form::predictor : design::Form::filter;
  result.covariance = says("kalman.covariance", "plain") ? design::Covariance::plain : design::Covariance::ud;
  result.x0 = zero_or(values, "kalman.initial_state", nx, 1).col(0);
  result.P0 = identity_or(values, "kalman.initial_covariance", nx);
  return result;
}

design::Limits limits(const Values& values) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd* lower = values.matrix("limits.u_min");
  const Eigen::MatrixXd* upper = values.matrix("limits.u_max");
  const int nu = values.sizes.at(Size::nu);
  design::Limits result;
  result.u_min = lower != nullptr ? Eigen::VectorXd(lower->col(0)) : Eigen::VectorXd::Constant(nu, -infinity);
  result.u_max = upper != nullptr ? Eigen::VectorXd(upper->col(0)) : Eigen::VectorXd::Constant(nu, infinity);
  return result;
}

design::Code code(const Values& values) {
  design::Code result;
  const std::string style = values.text("code.style");
  if (values.text("code.real") == "double") result.real = design::Scalar::float64;
  if (values.text("code.arithmetic") == "fused") result.arithmetic = design::Arithmetic::fused;
  if (style == "unrolled") result.style = design::Style::unrolled;
  if (style == "compact") result.style = design::Style::compact;
  const auto flash = values.numbers.find("code.flash");
  if (flash != values.numbers.end()) result.flash = static_cast<long>(flash->second);
  return result;
}

}  // namespace

design::Problem assemble(const Values& values) {
  design::Problem problem;
  problem.name = values.text("name");
  problem.brief = values.text("brief");
  problem.plant = plant(values);
  if (values.has("lqr")) problem.regulator = regulator(values, problem.plant);
  if (values.has("kalman")) problem.estimator = estimator(values, problem.plant);
  if (values.has("limits")) problem.limits = limits(values);
  problem.code = code(values);
  return problem;
}

}  // namespace lqg::input
