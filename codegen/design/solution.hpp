// SPDX-License-Identifier: MIT
// What the design engine found, in many digits: every number here rounds correctly to `double` and to `float`.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "design/problem.hpp"
#include "design/real.hpp"

namespace lqg::design {

using Poles = std::vector<std::complex<double>>;  // by falling |z|, then by falling imaginary part

// The plant at the sample instants as the filter knows it: x⁺ = A x + B u + G w, y = C x + D u + v. After the plant's
// own states come those of sampled/added_states: disturbances of inputs, and outputs on their way. With a delay of q
// samples or a part of them, the q inputs on their way are the last states, the oldest first, and D is part of C.
// With plant.dropout C x is what it is in the mean.
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

// How far a loop is from instability; empty where there is no such place.
struct Margins {
  std::optional<double> gain_dB, phase_deg, disk;
  std::optional<double> gain_up_dB, gain_down_dB;  // how far the gain may rise and fall; gain_dB is the lesser
  std::optional<double> delay_samples;             // what a delay may add
  std::optional<double> crossover;  // rad a sample: where the gain is 1 and the phase margin is the least
};

// Of the loop at work, with its noises: root mean squares, in the signals' units.
struct Rms {
  std::vector<double> x, u,
      y;  // of the sampled plant's states, 0 of disturbances; of y as it is measured, with its noise
};

// What keeping only some entries of a gain costs.
struct StructureReport {
  RealMatrix full;  // the gain without structure
  Poles full_poles;
  double cost_ratio = 1;  // of the structured gain's cost to the full one's
  Margins full_margins;   // at the plant's inputs
};

// What white parameters cost, beside the design that does not know of them.
struct WhiteReport {
  std::optional<double> cost_nominal;  // per sample (second), of this design where no parameter is random
  RealMatrix K_unaware;                // of a regulator alone: its gain without white parameters
  Margins margins_unaware;             // at the plant's inputs, likewise
  double growth = 0,
         growth_unaware = 0;  // of the second moments in a sample, of this design and of that; < 1: they settle
  std::optional<double> cost_unaware;  // of that design under the white parameters; empty: without bound
};

// z⁺ = A z + B y, u = C z + D y: the best of a given order that was found, a local minimum of E[xᵀQx + 2xᵀNu + uᵀRu].
// z are its estimates of the plant's states `estimates`: T has rows of the identity there. T = E[x zᵀ] E[z zᵀ]⁻¹: the
// best linear estimate of x that z allows, from which C T z is what the outputs should be. With z and y it is
// x̂ = `estimate` z + `heard` y. x over the states of MeasuredPlant.
struct CompensatorSolution {
  RealMatrix A, B, C, D;
  RealMatrix T, expected, estimate, heard;
  RealMatrix P;               // covariance of x − T z, over the plant's own states
  RealMatrix of_state, keep;  // z of a state x: of_state x + keep z, where keep is of an input that is a state
  std::vector<int> estimates;
  RealMatrix A_continuous, B_continuous, C_continuous;  // of a continuous cost: ż = A z + B y, u = C z, beside its z
  Poles poles;                                          // of A
  Real cost;                                            // a sample; with a continuous cost a second
  int starts = 0, reached = 0;                          // that were tried, that ended in this minimum
  double curvature = 0;                                 // the least one off the orbit beside the largest
  std::optional<double>
      full_cost;  // of LQG, whose order is that of the plant, without white parameters: no cost is less
  std::optional<double> held_cost_per_second;  // of a continuous cost: with u held and y sampled, as it is emitted
};

// u = −K z + Nbar r, z = [x; ξ of `integral`; u[k−1] with `input_rate`: then Δu is what the law gives];
// X: J = z₀ᵀXz₀. Without a cost (placed poles) `cost` and X are empty. Of a plant with disturbances J is the cost
// beyond that of cancelling them: their rows of X, and those of outputs on their way, are 0.
struct RegulatorSolution {
  SampledCost cost;                    // over x and u; of a delayed plant over all of its states
  RealMatrix Q_final;                  // nx × nx with a horizon, else empty
  RealMatrix K, X;                     // with a horizon: the gain that is held at its end, and X of that step
  Poles poles;                         // of z⁺ = A z + B u under u = −K z
  std::vector<RealMatrix> K_schedule;  // with a horizon or stages: K of step 0, 1, …; K from its end on
  RealMatrix X0;                       // the cost to go from step 0, with a schedule
  RealMatrix Nx, Nu, Nbar;  // with `track`: the set point (x, u) of r; Nbar = Nu + (Kx − Kξ Γ) Nx, over all r
  RealMatrix Gamma;         // with `integral`: ξ + Γ x is what of ξ the model does not explain; or empty
  RealMatrix H;             // with Γ: ξ + H (u − v) keeps it true where u was applied in place of v
  std::optional<StructureReport> structure;
};

// With recovery P_prior, P_posterior and S are those of the error under the noise alone; L and M are of a larger P.
// The steady filter: x̂ ← x̂ + L(y − Cx̂ − Du), L = P_prior Cᵀ S⁻¹, S = C P_prior Cᵀ + V;
// x̂ ← A x̂ + B u + M(y − Cx̂⁻ − Du), M = G Swv S⁻¹, so that L_predictor = A L + M.
struct EstimatorSolution {
  SampledNoise noise;
  RealMatrix L, M, L_predictor;
  RealMatrix P_prior, P_posterior, S;
  RealMatrix L_continuous,
      P_continuous;  // of the unsampled filter x̂' = A x̂ + B u + L (y − Cx̂ − Du), with noise that is continuous
  Poles poles;       // of A − L_predictor C
  std::vector<RealMatrix> L_schedule, M_schedule;  // of sample 0, 1, …; L and M from the end on
  std::optional<StructureReport> structure;
  RealMatrix fictitious;  // with recovery: what the gain takes for noise beside G W Gᵀ, nx × nx; or empty
};

// The same filter prepared for scalar updates with P carried on line: V = E⁻¹ diag(V) E⁻ᵀ is made diagonal by
// y' = E y, and w is freed of its part that y' tells: x⁺ = A x + B u + M(y' − C x − D u) + w', x and C x after the
// update.
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

// A law that foresees limits: z = [−K; F] s + G m, m_i ≥ 0 where z_i = low_i, ≤ 0 where z_i = high_i, else 0; s = [x;
// u[k−1] with `input_rate`; r]. The first nu rows are u of this sample, whether they have limits or not. What no input
// can move is left out.
struct LimitedRows {
  RealMatrix F;      // (rows − nu) × ns
  RealMatrix G;      // rows × rows
  RealVector scale;  // 1/√G_ii
  RealVector low, high;
  RealVector tolerance;
  std::vector<std::optional<Real>> price;  // of soft rows, as the target has it
  std::vector<bool> is_cheaper;            // than the design asks for
  std::vector<int> sample;                 // in which sample each is
  std::vector<std::string> names;          // "wheel_rate", "change of voltage"
};

// From step `from` on: what replaces the plant, the noise, the cost and the online filter (if they are there).
// With stages, K, L and all that is steady are those of the last one.
struct StageSolution {
  int from = 0;
  SampledPlant plant;
  std::optional<SampledNoise> noise;
  std::optional<SampledCost> cost;
  std::optional<OnlineSolution> online;
};

// The loop with the controller's numbers as the target holds them, around the exact plant.
struct RoundedLoop {
  Poles poles;
  std::optional<double> cost_per_sample;
  Margins at_input, at_output;
};

// What recovery with this q makes of the loop.
struct RecoveryPoint {
  double q = 0;
  Margins at_input;                       // to six digits; none: with this q there is no steady loop
  std::optional<double> cost_per_sample;  // under the noise alone
};

// Margin against cost: without recovery, with the q of the design, and with some around it.
struct RecoveryReport {
  double q = 0;
  std::vector<RecoveryPoint> points;  // by rising q, the first one is 0
};

// The closed loop of plant, filter and regulator.
struct LoopSolution {
  Poles poles;
  std::optional<double> cost_per_sample;
  std::optional<double> cost_per_second;  // of the continuous cost
  Margins at_input;        // gain and phase: the smallest over the inputs, one opened at a time; disk: all at once,
  Margins at_output;       // symmetric, (S − T)/2; likewise over the outputs that the filter uses
  std::optional<Rms> rms;  // with noise
  std::optional<RoundedLoop> rounded;
  std::optional<RecoveryReport> recovery;
};

struct Numerics {
  unsigned digits = 0;   // with which the last of the two runs was made
  double condition = 0;  // of the worst-conditioned equation that was solved
};

// What the filter begins with, over all states of its model.
struct FilterStart {
  RealMatrix x0, P0;  // nx × 1, nx × nx
};

struct Solution {
  SampledPlant plant;
  std::optional<FilterStart> start;  // with an estimator
  std::optional<RegulatorSolution> regulator;
  std::optional<SampledNoise> noise;           // with an estimator that has noise, before any stage
  std::optional<EstimatorSolution> estimator;  // empty beside `online` where the filter never becomes steady
  std::optional<OnlineSolution> online;        // with Gain::online only
  std::vector<StageSolution> stages;           // by rising `from`
  // In place of regulator and estimator, which are then those of LQG without white parameters, to compare with.
  std::optional<CompensatorSolution> compensator;
  std::optional<WhiteReport> white;     // with white parameters and a regulator
  std::optional<LimitedRows> foreseen;  // with limits that are foreseen
  LoopSolution loop;
  Numerics numerics;
};

}  // namespace lqg::design
