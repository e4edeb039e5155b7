// SPDX-License-Identifier: MIT
#include "input/assemble.hpp"

#include <limits>

#include "design/rounding.hpp"
#include "input/disturbances.hpp"
#include "input/scenarios.hpp"

namespace lqg::input {
namespace {

using design::ExactMatrix;

ExactMatrix zero_or(const Values& values, const std::string& key, int rows, int columns) {
  const ExactMatrix* matrix = values.matrix(key);
  return matrix != nullptr ? *matrix : ExactMatrix(Eigen::MatrixXd::Zero(rows, columns));
}

// 0 × 0 when there is none.
ExactMatrix empty_or(const Values& values, const std::string& key) {
  const ExactMatrix* matrix = values.matrix(key);
  return matrix != nullptr ? *matrix : ExactMatrix();
}

// Of what is made of zeros and ones, or is no part of the design's own numbers.
Eigen::MatrixXd doubles_or_empty(const Values& values, const std::string& key) {
  const Eigen::MatrixXd* matrix = values.matrix(key);
  return matrix != nullptr ? *matrix : Eigen::MatrixXd();
}

Eigen::VectorXd vector_or_empty(const Values& values, const std::string& key) {
  const Eigen::MatrixXd* matrix = values.matrix(key);
  return matrix != nullptr ? Eigen::VectorXd(matrix->col(0)) : Eigen::VectorXd();
}

ExactMatrix identity_or(const Values& values, const std::string& key, int size) {
  const ExactMatrix* matrix = values.matrix(key);
  return matrix != nullptr ? *matrix : ExactMatrix(Eigen::MatrixXd::Identity(size, size));
}

// Names of the file, or "x0", "x1" …
std::vector<design::Signal> signals(const Values& values, const std::string& key, const char* letter, int count) {
  const auto found = values.signals.find(key);
  if (found != values.signals.end()) return found->second;
  std::vector<design::Signal> result;
  for (int i = 0; i < count; ++i) result.push_back({letter + std::to_string(i), ""});
  return result;
}

// What is left out is 0.
std::optional<design::OperatingPoint> operating_point(const Values& values, const design::Plant& plant) {
  const std::string table = "plant.operating_point";
  if (!values.has(table)) return std::nullopt;
  const auto part = [&](const char* key, Eigen::Index size) {
    return Eigen::VectorXd(zero_or(values, table + key, static_cast<int>(size), 1).col(0));
  };
  design::OperatingPoint point;
  point.x = part(".states", plant.A.rows());
  point.u = part(".inputs", plant.B.cols());
  point.y = part(".outputs", plant.C.rows());
  return point;
}

// With all digits.
void linearise(const design::Linearisation& linearisation, design::Plant& plant) {
  plant.A = design::ExactMatrix::of(linearisation.A);
  plant.B = design::ExactMatrix::of(linearisation.B);
  plant.C = design::ExactMatrix::of(linearisation.C);
  plant.D = design::ExactMatrix::of(linearisation.D);
}

design::Plant plant(const Values& values) {
  const int nx = values.sizes.at(Size::nx);
  const int nu = values.sizes.at(Size::nu);
  const int ny = values.sizes.at(Size::ny);
  design::Plant result;
  const bool discrete = values.text("plant.domain") == "discrete";
  result.domain = discrete ? design::Domain::discrete : design::Domain::continuous;
  result.sample_time = values.numbers.at("plant.sample_time");
  result.equations = values.equations;
  if (values.linearisation) {
    linearise(*values.linearisation, result);
  } else {
    result.A = zero_or(values, "plant.A", nx, nx);  // of equations without a linearisation 0
    result.B = zero_or(values, "plant.B", nx, nu);
    result.C = zero_or(values, "plant.C", ny, nx);
    result.D = zero_or(values, "plant.D", ny, nu);
  }
  result.G = identity_or(values, "plant.G", nx);
  result.H = zero_or(values, "plant.H", ny, static_cast<int>(result.G.cols()));
  result.delay = values.number("plant.delay", 0);
  result.output_delay = vector_or_empty(values, "plant.output_delay");
  result.dropout = vector_or_empty(values, "plant.dropout");
  result.jitter = values.number("plant.jitter", 0);
  result.states = signals(values, "plant.states", "x", nx);
  result.inputs = signals(values, "plant.inputs", "u", nu);
  result.outputs = signals(values, "plant.outputs", "y", ny);
  result.operating_point = operating_point(values, result);
  return result;
}

std::optional<double> optional_number(const Values& values, const std::string& key) {
  const auto found = values.numbers.find(key);
  return found == values.numbers.end() ? std::nullopt : std::optional<double>(found->second);
}

std::vector<int> indices(const Values& values, const std::string& key) {
  const auto found = values.indices.find(key);
  return found == values.indices.end() ? std::vector<int>() : found->second;
}

int whole(const Values& values, const std::string& key) { return static_cast<int>(values.number(key, 0)); }

design::Bryson bryson(const Values& values) {
  design::Bryson result;
  result.states = vector_or_empty(values, "lqr.bryson.states");
  result.outputs = vector_or_empty(values, "lqr.bryson.outputs");
  result.inputs = vector_or_empty(values, "lqr.bryson.inputs");
  result.rho = values.number("lqr.bryson.rho", 1);
  return result;
}

design::Regulator regulator(const Values& values, const design::Plant& plant) {
  design::Regulator result;
  result.Q = empty_or(values, "lqr.Q");
  result.R = empty_or(values, "lqr.R");
  result.N = zero_or(values, "lqr.N", static_cast<int>(plant.A.rows()), static_cast<int>(plant.B.cols()));
  result.Q_output = empty_or(values, "lqr.Q_output");
  if (values.has("lqr.bryson")) result.bryson = bryson(values);
  const std::string cost = values.text("lqr.cost");
  const bool discrete = cost.empty() ? plant.domain == design::Domain::discrete : cost == "discrete";
  result.cost = cost == "continuous" ? design::Cost::continuous
                : discrete           ? design::Cost::discrete
                                     : design::Cost::sampled;
  result.decay = optional_number(values, "lqr.decay");
  result.settling_time = optional_number(values, "lqr.settling_time");
  result.horizon = whole(values, "lqr.horizon");
  result.Q_final = empty_or(values, "lqr.Q_final");
  result.structure = doubles_or_empty(values, "lqr.structure");
  if (values.has("lqr.integral"))
    result.integral = design::Integral{indices(values, "lqr.integral.outputs"), *values.matrix("lqr.integral.Q")};
  result.track = indices(values, "lqr.track");
  if (values.text("lqr.anti_windup") == "conditioning") result.anti_windup = design::AntiWindup::conditioning;
  result.input_rate = empty_or(values, "lqr.input_rate");
  return result;
}

design::WantedPoles wanted_poles(const Values& values, const std::string& table) {
  const auto sampled = values.poles.find(table + ".poles");
  if (sampled != values.poles.end()) return {sampled->second, false};
  return {values.poles.at(table + ".continuous_poles"), true};
}

// No weights, but poles.
design::Regulator placed_regulator(const Values& values, const design::Plant& plant) {
  design::Regulator result;
  result.N = Eigen::MatrixXd::Zero(plant.A.rows(), plant.B.cols());
  result.cost = design::Cost::discrete;
  result.poles = wanted_poles(values, "pole_placement");
  return result;
}

std::vector<design::InputDisturbance> disturbances(const Values& values) {
  std::vector<design::InputDisturbance> result;
  const Eigen::MatrixXd* sizes = values.matrix("kalman.disturbance");
  for (const int input : indices(values, "kalman.disturbance")) {
    const double given = sizes != nullptr ? (*sizes)(static_cast<Eigen::Index>(result.size()), 0) : 0;
    result.push_back({input, given > 0 ? given : default_disturbance(values, input).value_or(0)});
  }
  return result;
}

design::Estimator estimator(const Values& values, const design::Plant& plant) {
  const int nx = static_cast<int>(plant.A.rows());
  design::Estimator result;
  result.W = *values.matrix("kalman.process_noise");
  result.V = *values.matrix("kalman.measurement_noise");
  result.Swv =
      zero_or(values, "kalman.cross_noise", static_cast<int>(plant.G.cols()), static_cast<int>(plant.C.rows()));
  const std::string noise = values.text("kalman.noise");
  const bool discrete = noise.empty() ? plant.domain == design::Domain::discrete : noise == "discrete";
  result.noise = discrete ? design::Noise::discrete : design::Noise::continuous;
  const auto says = [&](const char* key, const char* word) { return values.text(key) == word; };
  const bool is_extended = says("kalman.gain", "extended");
  result.gain = is_extended || says("kalman.gain", "online") ? design::Gain::online
                : says("kalman.gain", "schedule")            ? design::Gain::schedule
                                                             : design::Gain::steady;
  if (is_extended)
    result.extended =
        design::Extended{says("kalman.integrator", "euler") ? design::Integrator::euler : design::Integrator::rk4,
                         values.has("kalman.wraps") ? indices(values, "kalman.wraps") : std::vector<int>()};
  result.horizon = whole(values, "kalman.horizon");
  result.process_correlation_time = vector_or_empty(values, "kalman.process_correlation_time");
  result.measurement_correlation_time = vector_or_empty(values, "kalman.measurement_correlation_time");
  result.gate = values.number("kalman.gate", 0);
  if (values.has("kalman.output_min") || values.has("kalman.output_max")) {
    const auto bounds = [&](const char* key, double none) {
      const Eigen::VectorXd given = vector_or_empty(values, key);
      return given.size() ? given : Eigen::VectorXd(Eigen::VectorXd::Constant(plant.C.rows(), none));
    };
    constexpr double infinity = std::numeric_limits<double>::infinity();
    result.output_min = bounds("kalman.output_min", -infinity);
    result.output_max = bounds("kalman.output_max", infinity);
  }
  if (values.has("kalman.spike")) result.spike = values.number("kalman.spike", 0);
  result.structure = doubles_or_empty(values, "kalman.structure");
  if (values.has("kalman.recovery"))
    result.recovery = design::TransferRecovery{values.number("kalman.recovery", 0), says("kalman.recovery", "auto")};
  result.form = says("kalman.form", "predictor") ? design::Form::predictor : design::Form::filter;
  result.covariance = says("kalman.covariance", "plain") ? design::Covariance::plain : design::Covariance::ud;
  result.x0 = zero_or(values, "kalman.initial_state", nx, 1).col(0);
  result.P0 = identity_or(values, "kalman.initial_covariance", nx);
  result.disturbance = disturbances(values);
  return result;
}

// No noise, but poles.
design::Estimator observer(const Values& values, const design::Plant& plant) {
  const Eigen::Index nx = plant.A.rows();
  design::Estimator result;
  result.noise = design::Noise::discrete;
  result.form = values.text("observer.form") == "filter" ? design::Form::filter : design::Form::predictor;
  result.x0 = Eigen::VectorXd::Zero(nx);
  result.P0 = Eigen::MatrixXd::Identity(nx, nx);
  result.poles = wanted_poles(values, "observer");
  return result;
}

// Of each of these signals.
Eigen::VectorXd prices(const Values& values, Size size) {
  constexpr double usual = 1e6;
  const std::vector<std::string> names = signal_names(values, size);
  Eigen::VectorXd result =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(names.size()), values.number("limits.price", usual));
  const auto named = values.named.find("limits.price");
  for (std::size_t i = 0; i < names.size() && named != values.named.end(); ++i)
    if (const auto price = named->second.find(names[i]); price != named->second.end())
      result(static_cast<Eigen::Index>(i)) = price->second;
  return result;
}

design::SoftLimits soft_limits(const Values& values, const std::string& key, Size size) {
  return {doubles_or_empty(values, key), prices(values, size)};
}

design::Limits limits(const Values& values) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Eigen::MatrixXd* lower = values.matrix("limits.u_min");
  const Eigen::MatrixXd* upper = values.matrix("limits.u_max");
  const int nu = values.sizes.at(Size::nu);
  design::Limits result;
  result.u_min = lower != nullptr ? Eigen::VectorXd(lower->col(0)) : Eigen::VectorXd::Constant(nu, -infinity);
  result.u_max = upper != nullptr ? Eigen::VectorXd(upper->col(0)) : Eigen::VectorXd::Constant(nu, infinity);
  result.u_rate = vector_or_empty(values, "limits.u_rate");
  result.horizon = values.has("limits.horizon") ? whole(values, "limits.horizon") : 0;
  if (result.horizon == 0) return result;
  if (const auto blocks = values.indices.find("limits.blocks"); blocks != values.indices.end())
    result.blocks = blocks->second;
  result.states = soft_limits(values, "limits.states", Size::nx);
  result.outputs = soft_limits(values, "limits.outputs", Size::ny);
  result.output_rates = soft_limits(values, "limits.output_rates", Size::ny);
  result.u_rate_price = prices(values, Size::nu);
  if (values.has("limits.iterations")) result.iterations = whole(values, "limits.iterations");
  return result;
}

std::vector<design::Stage> stages(const Values& values) {
  std::vector<design::Stage> result;
  for (const std::string& table : values.tables_of("stage")) {
    design::Stage stage;
    stage.from = whole(values, table + ".from");
    for (const auto& [key, matrix] :
         {std::pair("A", &stage.A), std::pair("B", &stage.B), std::pair("C", &stage.C), std::pair("D", &stage.D),
          std::pair("G", &stage.G), std::pair("Q", &stage.Q), std::pair("R", &stage.R), std::pair("N", &stage.N),
          std::pair("process_noise", &stage.W), std::pair("measurement_noise", &stage.V)})
      *matrix = empty_or(values, table + "." + key);
    result.push_back(stage);
  }
  return result;
}

std::vector<design::Uncertain> uncertain(const Values& values) {
  std::vector<design::Uncertain> result;
  for (const std::string& table : values.tables_of("uncertain"))
    result.push_back({empty_or(values, table + ".A"), empty_or(values, table + ".B"), empty_or(values, table + ".C")});
  return result;
}

design::Requirements requirements(const Values& values) {
  design::Requirements result;
  result.gain_margin_dB = optional_number(values, "require.gain_margin_dB");
  result.phase_margin_deg = optional_number(values, "require.phase_margin_deg");
  result.disk_margin = optional_number(values, "require.disk_margin");
  result.max_pole = optional_number(values, "require.max_pole");
  result.delay_margin = optional_number(values, "require.delay_margin");
  result.scenario = values.text("require.scenario");
  result.overshoot = optional_number(values, "require.overshoot");
  result.settling_time = optional_number(values, "require.settling_time");
  result.share_at_limits = optional_number(values, "require.share_at_limits");
  for (const std::string& table : values.tables_of("require.rms")) {
    using Of = design::RmsRequirement::Of;
    const auto [key, of] = values.has(table + ".state")   ? std::pair(".state", Of::state)
                           : values.has(table + ".input") ? std::pair(".input", Of::input)
                                                          : std::pair(".output", Of::output);
    result.rms.push_back({of, static_cast<int>(values.number(table + key, 0)), values.numbers.at(table + ".value")});
  }
  return result;
}

design::Code code(const Values& values) {
  design::Code result;
  const std::string style = values.text("code.style");
  if (values.text("code.real") == "double") result.real = design::Scalar::float64;
  if (values.text("code.arithmetic") == "fused") result.arithmetic = design::Arithmetic::fused;
  if (style == "unrolled") result.style = design::Style::unrolled;
  if (style == "compact") result.style = design::Style::compact;
  const std::string realisation = values.text("code.realisation");
  if (realisation == "folded") result.realisation = design::Realisation::folded;
  if (realisation == "modal") result.realisation = design::Realisation::modal;
  if (realisation == "cheapest") result.realisation = design::Realisation::cheapest;
  if (values.text("code.updates") == "each") result.updates = design::Updates::each;
  result.flash = static_cast<long>(values.number("code.flash", static_cast<double>(result.flash)));
  return result;
}

}  // namespace

design::Problem assemble(const Values& values) {
  design::Problem problem;
  problem.name = values.text("name");
  problem.brief = values.text("brief");
  problem.plant = plant(values);
  if (values.has("lqr")) problem.regulator = regulator(values, problem.plant);
  if (values.has("pole_placement")) problem.regulator = placed_regulator(values, problem.plant);
  if (values.has("kalman")) problem.estimator = estimator(values, problem.plant);
  if (values.has("observer")) problem.estimator = observer(values, problem.plant);
  if (values.has("limits")) problem.limits = limits(values);
  if (values.has("compensator")) problem.compensator = design::Order{whole(values, "compensator.order")};
  problem.uncertain = uncertain(values);
  problem.stages = stages(values);
  problem.scenarios = scenarios(values);
  problem.requirements = requirements(values);
  problem.code = code(values);
  return problem;
}

void begin_at_operating_point(const Values& values, design::Problem& problem) {
  const auto& point = problem.plant.operating_point;
  if (point && problem.estimator && !values.has("kalman.initial_state")) problem.estimator->x0 = point->x;
}

}  // namespace lqg::input
