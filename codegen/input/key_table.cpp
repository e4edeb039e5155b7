// SPDX-License-Identifier: MIT
// The table of keys: what the reader of files accepts, and what reference, schema and manual page say of it.
#include "input/key_table.hpp"

namespace lqg::input {
namespace {

std::vector<KeyRule> keys_of_the_loop() {
  constexpr auto no = Size::none;
  constexpr auto nx = Size::nx;
  constexpr auto nu = Size::nu;
  constexpr auto ny = Size::ny;
  constexpr auto nw = Size::nw;
  constexpr auto integrals = Size::integrals;
  constexpr auto required = Need::required;
  constexpr auto optional = Need::optional;

  // clang-format off
  return {
      {"name", Type::identifier, no, no, required, {},
       "Name of the controller: a C identifier in lower case, at most 31 characters. All emitted names begin with it. "
       "Names of standard headers and of types of C and POSIX (`time`, `div`) are refused."},
      {"brief", Type::line, no, no, optional, {},
       "One line that says what the controller is. It is repeated in the emitted files.", "empty"},

      {"parameters", Type::parameters, no, no, optional, {},
       "Names for numbers, which expressions are over: each a number, an expression in quotes, or "
       "`{ value = 2.32, unit = \"ohm\" }`. Wherever a key takes a number it takes an expression in quotes, too: "
       "`A = [[0, 1], [0, \"-Kt*Ke/(R*J)\"]]`.",
       "none", "README.md#parameters-and-expressions"},

      {"plant", Type::table, no, no, required, {},
       "The plant: ẋ = A x + B u + G w (continuous) or x⁺ = A x + B u + G w (discrete), with y = C x + D u + H w + v. "
       "w is the process noise, v the measurement noise."},
      {"plant.domain", Type::word, no, no, optional, {"continuous", "discrete"},
       "`continuous`: the matrices are those of ẋ; lqgen samples them. `discrete`: they are those of x⁺.",
       "`\"continuous\"`, with a note"},
      {"plant.sample_time", Type::positive, no, no, required, {}, "Sampling period of the loop, in s."},
      {"plant.f", Type::formulas, nx, no, optional, {},
       "The plant as equations, in place of `A`, `B`, `C` and `D`: of each state its derivative, or its value in the "
       "next sample with a discrete plant, as a formula over states, inputs and parameters.",
       "the plant is linear", "README.md#plants-as-equations"},
      {"plant.h", Type::formulas, ny, no, optional, {},
       "Of each output its formula. Without it lqgen designs a regulator alone.", "no outputs",
       "README.md#plants-as-equations"},
      {"plant.A", Type::matrix, nx, nx, optional, {}, "System matrix. One of `A` and `f` is required."},
      {"plant.B", Type::matrix, nx, nu, optional, {},
       "Input matrix. Without it lqgen designs an estimator alone.", "no inputs"},
      {"plant.C", Type::matrix, ny, nx, optional, {},
       "Output matrix. Without it lqgen designs a regulator alone, u = −K x of measured states.", "no outputs"},
      {"plant.D", Type::matrix, ny, nu, optional, {}, "Feedthrough from u to y.", "0"},
      {"plant.G", Type::matrix, nx, nw, optional, {}, "Where the process noise w enters the states.", "identity"},
      {"plant.H", Type::matrix, ny, nw, optional, {}, "Where the process noise w enters the outputs.", "0"},
      {"plant.delay", Type::not_negative, no, no, optional, {},
       "Time in s from sampling y until u takes effect. With a discrete plant it is a whole number of periods. "
       "Inputs that have not yet taken effect become additional states, after those of the plant, the oldest first. "
       "D multiplies the input that acts.",
       "0", "README.md#what-a-delay-costs"},
      {"plant.output_delay", Type::vector, ny, no, optional, {},
       "Time in s by which each output comes late: whole periods of the sample time. What is on its way becomes "
       "additional states of the filter, after those of the plant, the newest first. Needs [kalman].",
       "0", "README.md#late-outputs"},
      {"plant.dropout", Type::vector, ny, no, optional, {},
       "Probability with which C x of each output is 0 in a sample, 0 to below 1, independent from sample to sample. "
       "The noise v of the output stays, and the controller is not told. Where it is told, let the output be NaN "
       "instead: it is left out then, and this key is not needed.",
       "0", "README.md#white-parameters"},
      {"plant.jitter", Type::positive, no, no, optional, {},
       "Root mean square in s by which each period differs from `sample_time`, independent from sample to sample, of a "
       "continuous plant.",
       "0", "README.md#white-parameters"},
      {"plant.states", Type::signals, nx, no, optional, {}, "Names of the states, with units: `\"angle [rad]\"`.",
       "`x0`, `x1`, …"},
      {"plant.inputs", Type::signals, nu, no, optional, {}, "Names of the inputs, with units.", "`u0`, `u1`, …"},
      {"plant.outputs", Type::signals, ny, no, optional, {}, "Names of the outputs, with units.", "`y0`, `y1`, …"},
      {"plant.operating_point", Type::table, no, no, optional, {},
       "Where the matrices are the linearisation of the plant, or where `f` and `h` are linearised: x, u and y of the "
       "design are deviations from this point. All the rest of the file, and all that firmware hands over and gets, is "
       "in the plant's own units: limits, ranges, initial states, references, y, u and x. Weights, noises and what "
       "[lqr.bryson] accepts are of deviations.",
       "x, u and y are those of the matrices", "README.md#operating-point"},
      {"plant.operating_point.states", Type::point, nx, no, optional, {},
       "The states there: numbers or formulas; of `plant.f` also `\"?\"` for what is found so that f = 0. "
       "`\"? 0.5\"` says where the search begins.", "0"},
      {"plant.operating_point.inputs", Type::point, nu, no, optional, {},
       "The inputs that keep the plant there, likewise.", "0"},
      {"plant.operating_point.outputs", Type::vector, ny, no, optional, {},
       "The outputs there, of a plant of matrices. References begin with them.", "0"},
      {"plant.operating_point.steady", Type::states, nx, no, optional, {},
       "Names of the states that are at rest there: whose f is 0, or with a discrete plant the state itself.", "all"},
      {"plant.steady", Type::states, nx, no, optional, {}, "The same as `operating_point.steady`.", "all"},

      {"lqr", Type::table, no, no, optional, {},
       "The regulator. It minimises J = Σ xᵀQx + uᵀRu + 2xᵀNu. [Q N; Nᵀ R] is positive semidefinite."},
      {"lqr.Q", Type::weight, nx, nx, optional, {},
       "Weight of the states. One of `Q`, `Q_output` and `bryson` is required."},
      {"lqr.Q_output", Type::weight, ny, ny, optional, {}, "Weight of the outputs y = C x + D u, instead of `Q`."},
      {"lqr.R", Type::weight, nu, nu, optional, {},
       "Weight of the inputs, required unless `bryson` is there. It may be singular if R + BᵀXB is not.", "required"},
      {"lqr.N", Type::matrix, nx, nu, optional, {}, "Weight of the products of states and inputs.", "0"},
      {"lqr.bryson", Type::table, no, no, optional, {},
       "Bryson's rule, instead of `Q` and `R`: the weights are computed from the largest acceptable values."},
      {"lqr.bryson.states", Type::positives, nx, no, optional, {},
       "Largest acceptable value of each state: Q = diag(1/x²). One of `states` and `outputs` is required."},
      {"lqr.bryson.outputs", Type::positives, ny, no, optional, {},
       "Largest acceptable value of each output: Q_output = diag(1/y²)."},
      {"lqr.bryson.inputs", Type::positives, nu, no, required, {},
       "Largest acceptable value of each input: R = rho diag(1/u²)."},
      {"lqr.bryson.rho", Type::positive, no, no, optional, {},
       "Factor of R: a larger one makes the loop slower and its inputs smaller.", "1"},
      {"lqr.cost", Type::word, no, no, optional, {"sampled", "discrete", "continuous"},
       "`sampled`: the weights apply to the continuous trajectory, with u held between samples. "
       "`discrete`: they apply to the samples. "
       "`continuous`: K comes from the continuous Riccati equation and is used without correction for sampling.",
       "`\"sampled\"` for a continuous plant, `\"discrete\"` for a discrete one"},
      {"lqr.decay", Type::not_negative, no, no, optional, {},
       "Prescribed decay α: all poles of the closed loop have |z| < 1/α, α ≥ 1. "
       "With `cost = \"continuous\"` they have real parts below −α, in 1/s, α ≥ 0.",
       "none"},
      {"lqr.settling_time", Type::positive, no, no, optional, {},
       "Time in s within which the slowest mode settles to 1 %, instead of `decay`.", "none"},
      {"lqr.horizon", Type::steps, no, no, optional, {},
       "Number of steps N of a finite horizon. The gains K[0] … K[N−1] are used in turn, then the last one is kept.",
       "0: infinite"},
      {"lqr.Q_final", Type::weight, nx, nx, optional, {}, "Weight of the state at the end of the horizon.", "0"},
      {"lqr.structure", Type::mask, nu, nx, optional, {},
       "Entries of K that may differ from 0: a matrix of 0 and 1, or for each input the names of the states that it "
       "may use, `[[\"angle\", \"speed\"]]`.",
       "all", "README.md#gains-with-a-structure"},
      {"lqr.integral", Type::table, no, no, optional, {},
       "Integral action: ξ⁺ = ξ + T (r − y) of some outputs, and u = −K [x; ξ]."},
      {"lqr.integral.outputs", Type::indices, ny, no, required, {},
       "The integrated outputs, by name or by number from 0; at most as many as there are inputs."},
      {"lqr.integral.Q", Type::weight, integrals, integrals, required, {},
       "Weight of ξ: of each sample with a discrete cost, of its integral over time with a sampled one. "
       "With a continuous cost ξ̇ = r − y."},
      {"lqr.track", Type::indices, ny, no, optional, {},
       "Outputs that follow a reference r by feed-forward, by name or by number from 0: u = −K (x̂ − Nx r) + Nu r. "
       "If there are more inputs than tracked outputs, the steady input with the least uᵀRu is used.",
       "none", "README.md#a-reference"},
      {"lqr.anti_windup", Type::word, no, no, optional, {"model", "conditioning"},
       "What limits ξ while u is at a limit. `model`: the plant's state; ξ integrates only what the model does not "
       "explain. `conditioning`: u itself; least overshoot, but possibly very slow.",
       "", "../src/README.md#a-law-with-a-memory"},
      {"lqr.input_rate", Type::weight, nu, nu, optional, {},
       "Weight of the change of u from sample to sample: Δu = −K [x; ξ; u[k−1]].", "none"},

      {"kalman", Type::table, no, no, optional, {}, "The Kalman filter."},
      {"kalman.process_noise", Type::weight, nw, nw, required, {},
       "W = E[w wᵀ], the covariance of the process noise: (unit of w)², or (unit of w)²/Hz with "
       "`noise = \"continuous\"`."},
      {"kalman.measurement_noise", Type::weight, ny, ny, required, {},
       "V = E[v vᵀ], the covariance of the measurement noise, units likewise. "
       "It is positive definite, or becomes so by H."},
      {"kalman.cross_noise", Type::matrix, nw, ny, optional, {}, "E[w vᵀ].", "0"},
      {"kalman.noise", Type::word, no, no, optional, {"discrete", "continuous"},
       "`discrete`: the covariances are those of samples, w is held between samples. "
       "`continuous`: they are power spectral densities.",
       "the plant's domain"},
      {"kalman.gain", Type::word, no, no, optional, {"steady", "schedule", "online", "extended"},
       "`steady`: the constant gain of the steady filter. `schedule`: a table of gains for the transient from P0, then "
       "the steady gain. `online`: the covariance is updated on the target in every sample. `extended`: likewise, over "
       "the equations `plant.f` and `plant.h`, linearised at the estimate.",
       "", "README.md#extended-kalman-filters"},
      {"kalman.integrator", Type::word, no, no, optional, {"rk4", "euler"},
       "How an extended filter goes over `plant.f` of a continuous plant from one sample to the next, with u held. "
       "`rk4`: one classical step of fourth order. `euler`: one step of first order. A takes the Jacobian of that "
       "very step.",
       "", "README.md#extended-kalman-filters"},
      {"kalman.wraps", Type::indices, ny, no, optional, {},
       "Outputs of an extended filter that are angles in rad, by name or by number from 0: y − h(x̂) is taken in "
       "[−π, π).",
       "none", "README.md#extended-kalman-filters"},
      {"kalman.form", Type::word, no, no, optional, {"filter", "predictor"},
       "`filter`: u[k] uses y[k]. `predictor`: u[k] uses y[k−1], which leaves one sample for the computation."},
      {"kalman.covariance", Type::word, no, no, optional, {"ud", "plain"},
       "Form of P with `gain = \"online\"` or `\"extended\"`. `ud`: factors U diag(d) Uᵀ, which stay positive "
       "definite. `plain`: P itself, which is cheaper."},
      {"kalman.initial_state", Type::vector, nx, no, optional, {},
       "x̂ before the first update. A tool whose initial state already includes y[0] begins with `predict`.",
       "0, or `plant.operating_point`"},
      {"kalman.initial_covariance", Type::weight, nx, nx, optional, {},
       "P0 = P(0|−1), the covariance of that x̂.", "identity"},
      {"kalman.process_correlation_time", Type::positives, nw, no, optional, {},
       "Correlation time of each process noise, in s, with `noise = \"continuous\"`. W then holds variances, and the "
       "density of w_i, w_j is 2 √(τi τj) times the entry of W. `cross_noise` is scaled by √(2 τ) of each noise that "
       "has a time.",
       "none"},
      {"kalman.measurement_correlation_time", Type::positives, ny, no, optional, {},
       "Correlation time of each measurement noise, in s; V is scaled in the same way.", "none"},
      {"kalman.disturbance", Type::walks, nu, no, optional, {},
       "Inputs beside which an unknown disturbance d acts, as a random walk that the filter estimates, too: "
       "`[\"voltage\"]`, or with its size in the input's unit per √s, `{ voltage = 0.5 }`. The law cancels it, "
       "u = −K x̂ − d̂, which leaves no steady error. A size that is not given is 0.1 % of the input's in a sample, "
       "0.001 u/√T: of `limits`, else of `lqr.bryson.inputs`.",
       "none", "README.md#disturbances-at-the-inputs"},
      {"kalman.horizon", Type::steps, no, no, optional, {},
       "Length of the table of gains with `gain = \"schedule\"`. 0: until the gain equals the steady one in the "
       "target's precision.",
       "0"},
      {"kalman.structure", Type::mask, nx, ny, optional, {},
       "Entries of L that may differ from 0: a matrix of 0 and 1, or for each state the names of the outputs that may "
       "correct it.",
       "all", "README.md#gains-with-a-structure"},
      {"kalman.recovery", Type::amount, no, no, optional, {"auto"},
       "Loop transfer recovery: L is the gain for noise q B Bᵀ at the inputs, beside `process_noise`. It raises "
       "margins and costs more effect of the noise. q is a power spectral density, (unit of an input)²/Hz, for each "
       "kind of `noise`; with a discrete plant it is the variance of a sample. `\"auto\"`: the smallest q of two "
       "digits with which the margins and `max_pole` of `[require]` are met. Not available with `gain = \"online\"` "
       "and `structure`.",
       "none", "tuning.md#margins-against-cost-kalmanrecovery"},
      {"kalman.gate", Type::not_negative, no, no, optional, {},
       "Gate in standard deviations: an output with a larger innovation is not used in that sample. The gate widens "
       "for an output that is rejected in successive samples.",
       "none", "../src/README.md"},
      {"kalman.spike", Type::threshold, no, no, optional, {},
       "Wide gate in standard deviations against absurd values, which are also kept out of the integrals. `inf`: every "
       "finite value up to the bounds is used. Not available with `[observer]`, with gain tables of several stages and "
       "with realisations of a constant gain that do not keep x̂.",
       "300"},
      {"kalman.output_min", Type::bounds, ny, no, optional, {},
       "Smallest value that each sensor can deliver, in its unit. A smaller one counts as missing.", "−inf"},
      {"kalman.output_max", Type::bounds, ny, no, optional, {},
       "Largest value that each sensor can deliver, in its unit. A larger one counts as missing.", "inf"},

      {"observer", Type::table, no, no, optional, {},
       "An observer with given poles, instead of [kalman]: those of A − L_predictor C, or of A − L C A with "
       "`form = \"filter\"`."},
      {"observer.poles", Type::poles, no, no, optional, {},
       "Poles in z, one for each state: numbers, or `[re, im]` and its conjugate."},
      {"observer.continuous_poles", Type::poles, no, no, optional, {},
       "Poles in s, in 1/s, instead of `poles`: z = e^(sT)."},
      {"observer.form", Type::word, no, no, optional, {"predictor", "filter"}, "As `kalman.form`."},

      {"pole_placement", Type::table, no, no, optional, {},
       "A regulator with given poles, instead of [lqr]: those of A − B K. With several inputs the eigenvectors are "
       "chosen well conditioned."},
      {"pole_placement.poles", Type::poles, no, no, optional, {},
       "Poles in z: numbers, or `[re, im]` and its conjugate. With a delay there is one more for each delayed input; "
       "it may be 0."},
      {"pole_placement.continuous_poles", Type::poles, no, no, optional, {},
       "Poles in s, in 1/s, instead of `poles`: z = e^(sT). No s maps to z = 0, so the poles of a delay move, too."},

      {"limits", Type::table, no, no, optional, {}, "Limits of the actuators."},
      {"limits.u_min", Type::bounds, nu, no, optional, {},
       "Smallest value of each input that `control` returns.", "−inf"},
      {"limits.u_max", Type::bounds, nu, no, optional, {},
       "Largest value of each input that `control` returns.", "inf"},
      {"limits.u_rate", Type::bounds, nu, no, optional, {},
       "Largest |u[k] − u[k−1]| / T of each input, per second.", "inf"},
      {"limits.horizon", Type::steps, no, no, optional, {},
       "Samples ahead in which limits are foreseen: u is the one with the smallest cost that keeps them (model "
       "predictive control), and −K x̂ as long as no limit is in the way. 0: u is clipped.", "0",
       "README.md#limits-that-are-foreseen"},
      {"limits.blocks", Type::counts, no, no, optional, {},
       "Lengths in samples, `horizon` in all, over which the change of the law is held; limits are looked at in the "
       "first sample of each.", "single steps with limits of rates, states or outputs, else 1, 1, 2, 4, 4, 8, 8, …"},
      {"limits.states", Type::ranges, nx, no, optional, {},
       "Limits of states within the horizon, in their units. They may be exceeded, at `price`."},
      {"limits.outputs", Type::ranges, ny, no, optional, {}, "Likewise of outputs, without their noise."},
      {"limits.output_rates", Type::ranges, ny, no, optional, {},
       "Likewise of the change of outputs from sample to sample, per second."},
      {"limits.price", Type::prices, no, no, optional, {},
       "Price of an excess e in the first sample of a block: price · e² is added to the cost. Of changes of inputs "
       "after the sample at hand, too.", "1e6"},
      {"limits.iterations", Type::whole, no, no, optional, {},
       "Changes of the set of active limits in one sample, at most. Where they are not enough, u is clipped, and the "
       "status says so.", "a proved bound where there is one, else a cap of 10 for each limited "
       "quantity; the header says which"},

      {"compensator", Type::table, no, no, optional, {},
       "A controller of a given number of states in place of filter and regulator: z⁺ = A z + B y, u = C z + D y with "
       "the least cost of [lqr] under the noises of [kalman]. `kalman.form` says whether u has D y of the same sample.",
       "none", "README.md#fewer-states"},
      {"compensator.order", Type::whole, no, no, required, {},
       "Number of its states, at most that of the plant with its inputs on their way."},

      {"uncertain", Type::tables, no, no, optional, {},
       "A white parameter γ: in each sample the plant has A + γ `A`, B + γ `B` and C + γ `C`, with E γ = 0 and "
       "E γ² = 1, independent from sample to sample and of other tables. Of a continuous plant these are the sampled "
       "matrices. One of `A`, `B` and `C` is required.",
       "none", "README.md#white-parameters"},
      {"uncertain.A", Type::matrix, nx, nx, optional, {}, "What γ adds to A.", "0"},
      {"uncertain.B", Type::matrix, nx, nu, optional, {}, "What γ adds to B.", "0"},
      {"uncertain.C", Type::matrix, ny, nx, optional, {}, "What γ adds to C.", "0"},

      {"stage", Type::tables, no, no, optional, {},
       "A time-varying plant: from step `from` on, these matrices replace those before. A key that is left out keeps "
       "its value of the stage before."},
      {"stage.from", Type::step, no, no, required, {},
       "Number of the first step of this stage; larger than in the stage before."},
      {"stage.A", Type::matrix, nx, nx, optional, {}, "As `plant.A`.", "unchanged"},
      {"stage.B", Type::matrix, nx, nu, optional, {}, "As `plant.B`.", "unchanged"},
      {"stage.C", Type::matrix, ny, nx, optional, {}, "As `plant.C`.", "unchanged"},
      {"stage.D", Type::matrix, ny, nu, optional, {}, "As `plant.D`.", "unchanged"},
      {"stage.G", Type::matrix, nx, nw, optional, {}, "As `plant.G`.", "unchanged"},
      {"stage.Q", Type::weight, nx, nx, optional, {}, "As `lqr.Q`.", "unchanged"},
      {"stage.R", Type::weight, nu, nu, optional, {}, "As `lqr.R`.", "unchanged"},
      {"stage.N", Type::matrix, nx, nu, optional, {}, "As `lqr.N`.", "unchanged"},
      {"stage.process_noise", Type::weight, nw, nw, optional, {}, "As `kalman.process_noise`.", "unchanged"},
      {"stage.measurement_noise", Type::weight, ny, ny, optional, {}, "As `kalman.measurement_noise`.", "unchanged"},
  };
  // clang-format on
}

std::vector<KeyRule> keys_of_the_code() {
  constexpr auto no = Size::none;
  constexpr auto optional = Need::optional;

  // clang-format off
  return {
      {"code", Type::table, no, no, optional, {}, "What the emitted code looks like."},
      {"code.real", Type::word, no, no, optional, {"float", "double"}, "Floating-point type of the controller."},
      {"code.arithmetic", Type::word, no, no, optional, {"plain", "fused"},
       "`plain`: every product and every sum is rounded; the result has the same bits on every target. `fused`: "
       "multiply-adds are fmaf() or fma(); the same bits on every target that has them in hardware."},
      {"code.style", Type::word, no, no, optional, {"auto", "unrolled", "compact"},
       "`unrolled`: straight-line code of this plant's structure. `compact`: loops; a filter that updates P as it is, "
       "and from 5 states on one with a constant gain, has loops of its own where they fit `flash`, else calls of the "
       "library's. A constant gain of few numbers stays straight-line code. "
       "`auto`: the fastest that fits `flash`."},
      {"code.realisation", Type::word, no, no, optional, {"physical", "folded", "modal", "cheapest"},
       "`physical`: the controller keeps x̂. `folded`, `modal`: it keeps other numbers, which takes fewer operations. "
       "`cheapest`: the one with the fewest multiply-adds. With `kalman.gain = \"online\"` `modal` keeps the state and "
       "the covariance in the coordinates of the plant's modes, for limits, gates and references as well.",
       "", "README.md#other-numbers-than-x̂"},
      {"code.updates", Type::word, no, no, optional, {"all", "each"},
       "`each`: also a function `NAME_update_OUTPUT` for each output, for sensors with their own rates. Without it "
       "`NAME_partial_update` updates with some of the outputs."},
      {"code.flash", Type::whole, no, no, optional, {},
       "Flash in bytes that code and constants of the controller may take.", "16384",
       "README.md#what-it-states-of-flash-and-stack"},
  };
  // clang-format on
}

std::vector<KeyRule> table_of_keys() {
  std::vector<KeyRule> all = keys_of_the_loop();
  for (const auto& more : {scenario_keys(), requirement_keys(), keys_of_the_code()}) append(all, more);
  return all;
}

}  // namespace

const std::vector<KeyRule>& key_rules() {
  static const std::vector<KeyRule> rules = table_of_keys();
  return rules;
}

const std::vector<Alternatives>& alternatives() {
  static const std::vector<Alternatives> all = {
      {"plant", {"A", "f"}, Need::required},
      {"lqr", {"Q", "Q_output", "bryson"}, Need::required},
      {"lqr.bryson", {"states", "outputs"}, Need::required},
      {"lqr", {"decay", "settling_time"}, Need::optional},
      {"observer", {"poles", "continuous_poles"}, Need::required},
      {"pole_placement", {"poles", "continuous_poles"}, Need::required},
      {"scenario.load", {"input", "state"}, Need::required},
      {"require.rms", {"state", "input", "output"}, Need::required},
  };
  return all;
}

}  // namespace lqg::input
