// SPDX-License-Identifier: MIT
// A control problem as a design file states it: the numbers of the file, nothing computed yet.
//
// Shapes and finiteness hold when a Problem leaves `input`; what the file left out has its default here:
// D = 0, G = I, H = 0, N = 0, cross noise = 0, x0 = 0, P0 = I. A matrix with no rows or columns says "there is none".
#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "design/equations_of_motion.hpp"
#include "design/exact_matrix.hpp"
#include "design/scenario.hpp"

namespace lqg::design {

struct Signal {
  std::string name;  // "dy1", or "x0" when the file names none
  std::string unit;  // "m"; empty when not given
};

enum class Domain { continuous, discrete };

// Where the linear plant is the plant: its x, u and y are deviations from these. In the plant's own units, as is what
// the file states beside it; when a Problem leaves `input`, its limits, ranges and initial state are deviations, too.
struct OperatingPoint {
  Eigen::VectorXd x, u, y;  // nx, nu, ny
  // Of Limits and Estimator, as the file states them.
  Eigen::VectorXd u_min, u_max, output_min, output_max;
  Eigen::MatrixXd states_range, outputs_range;
};

// ẋ = A x + B u + G w  (continuous)  or  x⁺ = A x + B u + G w  (discrete);  y = C x + D u + H w + v.
struct Plant {
  Domain domain = Domain::continuous;
  double sample_time = 0;        // s
  ExactMatrix A;                 // nx × nx
  ExactMatrix B;                 // nx × nu, nu may be 0: an estimator alone
  ExactMatrix C;                 // ny × nx, ny may be 0: a regulator alone
  ExactMatrix D;                 // ny × nu
  ExactMatrix G;                 // nx × nw
  ExactMatrix H;                 // ny × nw
  double delay = 0;              // s from sampling y to u taking effect; whole periods of a discrete plant
  Eigen::VectorXd output_delay;  // ny, s by which the filter hears each output late, whole periods; or empty: none
  Eigen::VectorXd dropout;       // ny, the probability that C x of an output is 0 in a sample; or empty: never
  double jitter = 0;             // s, rms of the deviation of each period from sample_time
  std::vector<Signal> states, inputs, outputs;
  std::optional<OperatingPoint> operating_point = {};  // not given: 0
  std::shared_ptr<const Equations> equations = {};     // of a plant that is stated so; A, B, C, D are its linearisation
};

// Wanted poles, conjugates side by side; `continuous`: of the s plane, mapped by z = e^(sT).
struct WantedPoles {
  std::vector<std::complex<double>> values;
  bool continuous = false;
};

enum class Cost { sampled, discrete, continuous };

// Largest acceptable values: Q = diag(1/x²) or Cᵀ diag(1/y²) C (with D: its cross terms too), R = rho diag(1/u²).
struct Bryson {
  Eigen::VectorXd states, outputs;  // one of them is empty
  Eigen::VectorXd inputs;
  double rho = 1;
};

// ξ⁺ = ξ + T (r − y) for these outputs; Q weighs ξ.
struct Integral {
  std::vector<int> outputs;
  ExactMatrix Q;
};

// Samples that may have gains of their own: of a horizon, of a schedule, until the last stage. More take hours.
constexpr int most_steps = 100000;

// J = Σ xᵀQx + uᵀRu + 2xᵀNu, of the samples or of the continuous trajectory.
enum class AntiWindup { model, conditioning };

struct Regulator {
  ExactMatrix Q, R, N;           // Q and R are empty where Q_output or bryson give them
  ExactMatrix Q_output;          // ny × ny instead of Q, or empty: yᵀ Q_output y with y = Cx + Du
  std::optional<Bryson> bryson;  // instead of Q and R
  Cost cost = Cost::sampled;
  std::optional<double> decay;          // α: every closed-loop pole inside |z| < 1/α, or left of −α 1/s
  std::optional<double> settling_time;  // s, to 1 %: α = 100^(T/ts), or ln(100)/ts
  int horizon = 0;                      // 0: infinite
  ExactMatrix Q_final;                  // nx × nx, or empty: 0
  Eigen::MatrixXd structure;            // nu × nx of 0 and 1, or empty: the entries of K that may differ from 0
  std::optional<Integral> integral;
  std::vector<int> track;                      // outputs that follow r by feed-forward
  AntiWindup anti_windup = AntiWindup::model;  // what ξ is made true to where a limit holds u: the state, or u
  ExactMatrix input_rate;                      // nu × nu, or empty: the weight on Δu, a sample
  std::optional<WantedPoles> poles;            // [pole_placement]: K has these poles; no weight is there then
};

// Placed poles need no weights.
inline bool has_cost(const std::optional<Regulator>& regulator) { return regulator && !regulator->poles; }

enum class Noise { discrete, continuous };
enum class Gain { steady, schedule, online };
enum class Form { filter, predictor };
enum class Covariance { ud, plain };

// What acts beside an input and wanders: u + d, where d is a random walk with d(t + 1 s) − d(t) of that size, rms.
struct InputDisturbance {
  int input = 0;
  double size = 0;  // unit of the input per √s, > 0
};

// Loop transfer recovery: the filter's gain is that of W and of noise q B Bᵀ at the plant's inputs, which is not there.
struct TransferRecovery {
  double q = 0;               // (unit of an input)²/Hz of a continuous plant, (unit of an input)² of a discrete one
  bool is_automatic = false;  // instead of q: the smallest one with which the loop has what is required of it
};

// How the filter goes over the equations of a continuous plant from one sample to the next, with u held.
enum class Integrator { rk4, euler };

// An extended filter: with Gain::online, over the equations of the plant, linearised at its own estimate.
struct Extended {
  Integrator integrator = Integrator::rk4;
  std::vector<int> wraps;       // outputs that are angles, in rad: their innovations lie in [−π, π)
  Eigen::VectorXd own_x0 = {};  // the initial state in the plant's own units, where that of the filter is a deviation
};

// E[w wᵀ] = W, E[v vᵀ] = V, E[w vᵀ] = Swv: covariances of samples, or power spectral densities.
struct Estimator {
  ExactMatrix W, V, Swv;
  Eigen::VectorXd process_correlation_time, measurement_correlation_time;  // s, or empty: W and V are densities
  Noise noise = Noise::continuous;
  Gain gain = Gain::steady;
  int horizon = 0;  // of a schedule; 0: until converged
  Form form = Form::filter;
  Covariance covariance = Covariance::ud;
  Eigen::VectorXd x0;
  ExactMatrix P0;
  double gate = 0;                         // σ; 0: none
  Eigen::VectorXd output_min, output_max;  // what a sensor can say at all, or empty; infinite: anything
  std::optional<double> spike;       // σ, or infinite for none; not given: that of the default where there can be one
  Eigen::MatrixXd structure;         // nx × ny of 0 and 1, or empty: the entries of L that may differ from 0
  std::optional<WantedPoles> poles;  // [observer]: L has these poles; no noise is there then
  std::vector<InputDisturbance> disturbance;  // estimated, too, and by the regulator cancelled; each input once
  std::optional<TransferRecovery> recovery;
  std::optional<Extended> extended;  // with a plant that has equations
};

// Placed poles need no noise.
inline bool has_noise(const std::optional<Estimator>& estimator) { return estimator && !estimator->poles; }

// Limits that may be exceeded, for price · excess², in units of the cost.
struct SoftLimits {
  Eigen::MatrixXd range;  // of each signal the smallest and the largest value, −∞ or +∞ where there is none; or empty
  Eigen::VectorXd price;  // of each signal, > 0
};

struct Limits {
  Eigen::VectorXd u_min, u_max;  // −∞ or +∞ where there is none
  Eigen::VectorXd u_rate;        // largest |u[k] − u[k−1]| / sample_time, or empty
  int horizon = 0;               // samples ahead in which limits are foreseen; 0: u is clipped
  std::vector<int> blocks;       // lengths in samples over which v of u = −K x + v is held, or empty: the usual ones
  SoftLimits states, outputs, output_rates;  // with a horizon; rates in units per second
  Eigen::VectorXd u_rate_price;              // nu; of changes that are not those of the sample at hand
  int iterations = 0;                        // changes of the set of active limits, at most; 0: as many as are needed
};

// Limits are foreseen, not only clipped at.
inline bool foresees(const std::optional<Limits>& limits) { return limits && limits->horizon > 0; }

// From step `from` on these are the plant, the weights and the noises; an empty one stays as it was in the stage
// before.
struct Stage {
  int from = 0;
  ExactMatrix A, B, C, D, G, Q, R, N, W, V;
};

// What the closed loop has to reach.
struct RmsRequirement {
  enum class Of { state, input, output } of = Of::state;
  int signal = 0;
  double most = 0;
};
struct Requirements {
  std::optional<double> gain_margin_dB, phase_margin_deg, disk_margin, max_pole;
  std::optional<double> delay_margin = {};  // s
  // In the scenario of that name; in each one without a name.
  std::string scenario = {};
  std::optional<double> overshoot = {};        // share of the step
  std::optional<double> settling_time = {};    // s
  std::optional<double> share_at_limits = {};  // of the samples
  std::vector<RmsRequirement> rms = {};
};

// What one white parameter γ of the file adds to the plant at its samples: A + γ A₁, B + γ B₁, C + γ C₁ with E γ = 0,
// E γ² = 1, in each sample independent of all others. Empty: 0.
struct Uncertain {
  ExactMatrix A, B, C;  // nx × nx, nx × nu, ny × nx
};

// A compensator of that many states in place of a filter and a law.
struct Order {
  int order = 0;
};

enum class Scalar { float32, float64 };
enum class Arithmetic { plain, fused };
enum class Style { automatic, unrolled, compact };
enum class Updates { all, each };                              // of all outputs at once, or of each alone, too
enum class Realisation { physical, folded, modal, cheapest };  // which numbers the controller keeps: x̂, or others

struct Code {
  Scalar real = Scalar::float32;
  Arithmetic arithmetic = Arithmetic::plain;
  Style style = Style::automatic;
  Realisation realisation = Realisation::physical;
  Updates updates = Updates::all;
  long flash = 16384;  // bytes
};

// A name of the file for a number, and a formula where it has one.
struct Parameter {
  std::string name;
  double value = 0;
  std::string unit, formula;  // as they are written, or empty
  bool is_set = false;        // on the command line, in place of what the file says
};

// A number of the file that is written as a formula.
struct Formula {
  std::string key;  // "plant.A[1][0]"
  std::string text;
  double value = 0;
};

struct Problem {
  std::string name;
  std::string brief;
  Plant plant;
  std::optional<Regulator> regulator;
  std::optional<Estimator> estimator;
  std::optional<Limits> limits;
  std::optional<Order> compensator;
  std::vector<Uncertain> uncertain;
  std::vector<Stage> stages;  // by rising `from`
  std::vector<Scenario> scenarios;
  Requirements requirements;
  Code code;
  std::vector<Parameter> parameters;
  std::vector<Formula> formulas;
};

// The plant has parameters that are random from sample to sample.
inline bool has_white_parameters(const Problem& problem) {
  return !problem.uncertain.empty() || problem.plant.jitter > 0 || (problem.plant.dropout.array() > 0).any();
}

// The controller is one optimum of its own, not a filter and a law that are designed apart: its order is given, or
// white parameters couple the two.
inline bool is_of_given_order(const Problem& problem) {
  return problem.compensator || (problem.regulator && problem.estimator && has_white_parameters(problem));
}

}  // namespace lqg::design
