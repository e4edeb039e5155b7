// A control problem as a design file states it: the doubles of the file, nothing computed yet.
//
// Shapes and finiteness hold when a Problem leaves `input`; what the file left out has its default here:
// D = 0, G = I, N = 0, cross noise = 0, x0 = 0, P0 = I. A matrix with no rows or columns says "there is none".
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace lqg::design {

struct Signal {
  std::string name;  // "dy1", or "x0" when the file names none
  std::string unit;  // "m"; empty when not given
};

enum class Domain { continuous, discrete };

// ẋ = A x + B u + G w  (continuous)  or  x⁺ = A x + B u + G w  (discrete);  y = C x + D u + v.
struct Plant {
  Domain domain = Domain::continuous;
  double sample_time = 0;  // s
  Eigen::MatrixXd A;       // nx × nx
  Eigen::MatrixXd B;       // nx × nu, nu may be 0: an estimator alone
  Eigen::MatrixXd C;       // ny × nx, ny may be 0: a regulator alone
  Eigen::MatrixXd D;       // ny × nu
  Eigen::MatrixXd G;       // nx × nw
  std::vector<Signal> states, inputs, outputs;
};

enum class Cost { sampled, discrete, continuous };

// J = Σ xᵀQx + uᵀRu + 2xᵀNu, of the samples or of the continuous trajectory.
struct Regulator {
  Eigen::MatrixXd Q, R, N;
  Cost cost = Cost::sampled;
};

enum class Noise { discrete, continuous };
enum class Gain { steady, online };
enum class Form { filter, predictor };
enum class Covariance { ud, plain };

// E[w wᵀ] = W, E[v vᵀ] = V, E[w vᵀ] = Swv: covariances of samples, or power spectral densities.
struct Estimator {
  Eigen::MatrixXd W, V, Swv;
  Noise noise = Noise::continuous;
  Gain gain = Gain::steady;
  Form form = Form::filter;
  Covariance covariance = Covariance::ud;
  Eigen::VectorXd x0;
  Eigen::MatrixXd P0;
};

struct Limits {
  Eigen::VectorXd u_min, u_max;  // −∞ or +∞ where there is none
};

enum class Scalar { float32, float64 };
enum class Arithmetic { plain, fused };
enum class Style { automatic, unrolled, compact };

struct Code {
  Scalar real = Scalar::float32;
  Arithmetic arithmetic = Arithmetic::plain;
  Style style = Style::automatic;
  long flash = 16384;  // bytes
};

struct Problem {
  std::string name;
  std::string brief;
  Plant plant;
  std::optional<Regulator> regulator;
  std::optional<Estimator> estimator;
  std::optional<Limits> limits;
  Code code;
};

}  // namespace lqg::design
