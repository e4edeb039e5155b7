// What the design engine found, in many digits: every number here rounds correctly to `double` and to `float`.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "design/finding.hpp"
#include "design/problem.hpp"
#include "design/real.hpp"

namespace lqg::design {

using Poles = std::vector<std::complex<double>>;  // by falling |z|, then by falling imaginary part

// The plant at the sample instants: x⁺ = A x + B u + G w, y = C x + D u + v.
struct SampledPlant {
  RealMatrix A, B, C, D, G;
};

// Covariances of the sampled noise: w is nw × 1 (nx × 1 with G = I where continuous noise was sampled).
struct SampledNoise {
  RealMatrix W, V, Swv;
};

// J = Σ xᵀQx + uᵀRu + 2xᵀNu over the samples. With Cost::continuous the weights of the file.
struct SampledCost {
  RealMatrix Q, R, N;
};

// u = −K x;  X: J = x₀ᵀXx₀.
struct RegulatorSolution {
  SampledCost cost;
  RealMatrix K, X;
  Poles poles;  // of A − BK
};

// The steady filter: x̂ ← x̂ + L(y − Cx̂ − Du), L = P_prior Cᵀ S⁻¹, S = C P_prior Cᵀ + V;
// x̂ ← A x̂ + B u + M(y − Cx̂⁻ − Du), M = G Swv S⁻¹, so that L_predictor = A L + M.
struct EstimatorSolution {
  SampledNoise noise;
  RealMatrix L, M, L_predictor;
  RealMatrix P_prior, P_posterior, S;
  Poles poles;  // of A − L_predictor C
};

// The same filter prepared for scalar updates with P carried on line: V = E⁻¹ diag(V) E⁻ᵀ is made diagonal by
// y' = E y, and w is freed of its part that y' tells: x⁺ = A x + B u + M(y' − C x − D u) + w', x and C x after the update.
struct OnlineSolution {
  RealMatrix E;       // ny × ny, unit lower triangular
  RealMatrix C, D;    // E C, E D
  RealVector V;       // ny, > 0
  RealMatrix M;       // nx × ny: G Swv Eᵀ diag(V)⁻¹
  RealMatrix A_free;  // nx × nx: A − M C; P⁺ = A_free P A_freeᵀ + W
  RealMatrix W;       // nx × nx: G W Gᵀ − M diag(V) Mᵀ
  RealMatrix G;       // nx × nq: W = G diag(w) Gᵀ, zero columns left out
  RealVector w;       // nq, > 0
  RealMatrix P0;      // nx × nx
  RealMatrix U0;      // nx × nx: P0 = U0 diag(D0) U0ᵀ, unit upper triangular
  RealVector D0;      // nx, ≥ 0
};

// The closed loop of plant, filter and regulator.
struct LoopSolution {
  Poles poles;
  std::optional<double> cost_per_sample;
  std::optional<double> cost_per_second;   // of the continuous cost
  std::optional<double> gain_margin_dB;    // the smallest over the inputs, one opened at a time
  std::optional<double> phase_margin_deg;  // likewise
  std::optional<double> disk_margin;       // all inputs at once, symmetric disk (S − T)/2
};

struct Numerics {
  unsigned digits = 0;      // with which the last of the two runs was made
  double condition = 0;     // of the worst-conditioned equation that was solved
};

struct Solution {
  SampledPlant plant;
  std::optional<RegulatorSolution> regulator;
  std::optional<EstimatorSolution> estimator;
  std::optional<OnlineSolution> online;  // with Gain::online only
  LoopSolution loop;
  Numerics numerics;
};

// Solves `problem`. Empty, with at least one error in `findings`, when the design is impossible; the culprit is named
// (mode, states that take part, key). Notes may come with a solution.
std::optional<Solution> solve(const Problem& problem, Findings& findings);

}  // namespace lqg::design
