// SPDX-License-Identifier: MIT
#include "design/checks/well_posed.hpp"

#include "design/checks/mode_names.hpp"
#include "design/numeric/elimination.hpp"
#include "design/numeric/exact_reach.hpp"
#include "design/numeric/factor.hpp"
#include "design/numeric/modes.hpp"
#include "design/numeric/poles.hpp"
#include "design/sampled/augmentation.hpp"

namespace lqg::design {

namespace {

// The plant with names for all states of the deciding_equation: after its own an input on its way, ξ and u[k−1].
Plant with_regulated_states(const Problem& problem) {
  Plant plant = problem.plant;
  const auto name_of = [](const std::vector<Signal>& signals, Index i, const char* letter) {
    const std::size_t at = static_cast<std::size_t>(i);
    return at < signals.size() ? signals[at].name : letter + std::to_string(i);
  };
  const auto add_inputs = [&](Index ago) {
    for (Index i = 0; i < plant.B.cols(); ++i)
      plant.states.push_back({name_of(plant.inputs, i, "u") + "[k-" + std::to_string(ago) + "]", ""});
  };
  if (!delay_of(plant).is_whole) add_inputs(delay_of(plant).samples);
  if (problem.regulator && problem.regulator->integral)
    for (const int output : problem.regulator->integral->outputs)
      plant.states.push_back({"integral of " + name_of(plant.outputs, output, "y"), ""});
  if (problem.regulator && problem.regulator->input_rate.size() > 0) add_inputs(1);
  return plant;
}

// The plant's own mode of one of the equation with the pincer's α.
Mode without_decay(const Problem& problem, Mode mode) {
  const Real decay = decay_of(problem);
  if (problem.regulator->cost == Cost::continuous) {
    mode.value.re -= decay;
  } else {
    mode.value.re /= decay;
    mode.value.im /= decay;
  }
  return mode;
}

bool is_too_slow(const Plant& plant, const Mode& mode, const Decay& decay) {
  const ComplexReal& value = mode.value;
  if (plant.domain == Domain::discrete) return on_or_outside_circle({decay.alpha * value.re, decay.alpha * value.im});
  return on_or_right_of_axis({value.re + decay.rate, value.im}, norm(real(plant.A)) + decay.rate);
}

Unreached unreached_modes_of(const Plant& plant, const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return plant.domain == Domain::continuous ? unreached_modes(real(A), real(B))
                                            : unreached_sampled_modes(real(A), real(B));
}

// Do s and r become one pole by sampling: (s − r)T = 2πjk with k ≠ 0, up to what typing rounded numbers
// explains?
bool become_one(const ComplexReal& s, const ComplexReal& r, double sample_time) {
  const Real near = 1e-9;
  const Real turns = (s.im - r.im) * sample_time / (8 * atan(Real(1)));
  return abs(turns) > 0.5 && abs(turns - round(turns)) <= near * abs(turns) &&
         abs(s.re - r.re) * sample_time <= near * abs(turns);
}

std::vector<ComplexReal> rough_poles(const Plant& plant) {
  const Digits enough(30);
  return eigenvalues(real(plant.A));
}

// Unstable modes (or all) that B reaches in continuous time and does not in the samples. With the numbers of a file no
// two poles become one exactly; where two nearly do, couplings down to 10^−6 count as lost. A held input is
// one more pole at s = 0.
std::vector<Mode> modes_lost_by_sampling(const Plant& plant, const RealMatrix& A, const RealMatrix& B, bool is_held,
                                         bool every_mode, const Real& alpha) {
  const Real weak = 1e-6;
  std::vector<ComplexReal> merged, poles = rough_poles(plant);
  const std::size_t count = poles.size();
  if (is_held) poles.push_back({Real(0), Real(0)});
  for (std::size_t i = 0; i < count; ++i)
    for (const ComplexReal& other : poles)
      if (become_one(poles[i], other, plant.sample_time)) merged.push_back(sampled_pole(poles[i], plant.sample_time));
  std::vector<Mode> lost;
  if (merged.empty()) return lost;
  const Real usual = is_held ? Real(plant.sample_time * largest_entry(real(plant.B))) : largest_entry(B);
  const RealMatrix reach = B.unaryExpr([&](const Real& b) { return abs(b) > weak * usual ? b : Real(0); });
  for (const Mode& mode : unreached_sampled_modes(A, reach, weak).modes)
    for (const ComplexReal& z : merged)
      if ((every_mode || on_or_outside_circle({alpha * z.re, alpha * z.im})) &&
          hypot(mode.value.re - z.re, mode.value.im - z.im) < 1e-6 * hypot(z.re, z.im)) {
        lost.push_back({z, mode.states});
        break;
      }
  return lost;
}

void add_once(Findings& findings, const std::string& key, const std::string& message) {
  for (const Finding& finding : findings)
    if (finding.key == key && finding.message == message) return;
  add_error(findings, key, message);
}

// (A, B), or (Aᵀ, Cᵀ) for what the outputs see: in the numbers of the file, and sampled.
struct Pair {
  Eigen::MatrixXd A, B;
  RealMatrix sampled_A, sampled_B;
  bool is_held;
};

struct Words {
  std::string key, none, weak, lost;
  bool every_mode = false;
  std::string decay_key = {}, slow = {};  // of a mode that is stable and slower than asked for
};

// Errors for unstable modes (or all) that B does not reach, or that it reaches no more by sampling. False when the
// digits in force see another number of modes than there are exactly.
bool check_pair(const Plant& plant, const Pair& pair, const Decay& decay, const Words& words, Findings& findings) {
  const Unreached unreached = unreached_modes_of(plant, pair.A, pair.B);
  const bool certain = unreached.dimension == pair.A.rows() - reached_dimension(pair.A, pair.B);
  for (const Mode& mode : unreached.modes)
    if (words.every_mode || is_too_slow(plant, mode, Decay()))
      add_once(findings, words.key, name_mode(plant, mode, true) + (certain ? words.none : words.weak));
    else if (is_too_slow(plant, mode, decay))
      add_once(findings, words.decay_key, name_mode(plant, mode, true) + words.slow);
  if (!certain || has_error(findings) || plant.domain == Domain::discrete) return certain;
  for (const Mode& mode :
       modes_lost_by_sampling(plant, pair.sampled_A, pair.sampled_B, pair.is_held, words.every_mode, decay.alpha))
    add_once(findings, "plant.sample_time", name_mode(plant, mode, false) + words.lost);
  return true;
}

}  // namespace

bool check_stabilisable(const Problem& problem, const SampledPlant& sampled, Findings& findings) {
  const Plant& plant = problem.plant;
  const Pair pair = {plant.A, plant.B, sampled.A, sampled.B, true};
  return check_pair(plant, pair, decay_per_mode(problem),
                    {"plant.B", " is reached by no input: the plant is not stabilisable",
                     " is reached too weakly by the inputs: the plant is hardly stabilisable",
                     " can be stabilised, but not with inputs held that long: the sample time matches its "
                     "oscillation",
                     false, problem.regulator->settling_time ? "lqr.settling_time" : "lqr.decay",
                     " is reached by no input, or too weakly, and is slower than asked for"},
                    findings);
}

bool check_detectable(const Problem& problem, const SampledPlant& sampled, Findings& findings) {
  const Plant& plant = problem.plant;
  const Pair pair = {plant.A.transpose(), plant.C.transpose(), sampled.A.transpose(), sampled.C.transpose(), false};
  return check_pair(plant, pair, Decay(),
                    {"plant.C", " is seen in no output: the plant is not detectable",
                     " is seen too weakly in the outputs: the plant is hardly detectable",
                     " can be seen, but not at these samples: the sample time matches its oscillation"},
                    findings);
}

bool check_disturbances(const Problem& filtered, Findings& findings) {
  const Plant& plant = filtered.plant;
  const Eigen::MatrixXd A = plant.A.transpose(), C = plant.C.transpose();
  const Unreached unseen = unreached_modes_of(plant, A, C);
  const bool certain = unseen.dimension == A.rows() - reached_dimension(A, C);
  for (const Mode& mode : unseen.modes)
    if (is_too_slow(plant, mode, Decay()))
      add_once(findings, "kalman.disturbance",
               name_mode(plant, mode, true) +
                   (certain ? " is seen in no output" : " is seen too weakly in the outputs") +
                   ": the outputs do not tell these disturbances; there are at most as many as outputs, and none where "
                   "the plant has a zero at z = 1 (s = 0) from the input to the outputs");
  return certain;
}

bool check_reachable(const Problem& problem, const SampledPlant& sampled, Findings& findings) {
  const Plant& plant = problem.plant;
  const bool certain =
      check_pair(plant, {plant.A, plant.B, sampled.A, sampled.B, true}, Decay(),
                 {"plant.B", " is reached by no input: its pole cannot be moved",
                  " is reached too weakly by the inputs: its pole can hardly be moved",
                  " cannot be moved with inputs held that long: the sample time matches its oscillation", true},
                 findings);
  if (has_error(findings)) return certain;
  for (const Mode& mode : unreached_sampled_modes(sampled.A, sampled.B).modes)
    add_once(findings, "plant.B", name_mode(plant, mode, false) + " is reached by no input: its pole cannot be moved");
  return certain;
}

bool check_observable(const Problem& problem, const SampledPlant& sampled, const RealMatrix& seen, Findings& findings) {
  const Plant& plant = problem.plant;
  const bool certain = check_pair(
      plant, {plant.A.transpose(), plant.C.transpose(), sampled.A.transpose(), sampled.C.transpose(), false}, Decay(),
      {"plant.C", " is seen in no output: its pole cannot be moved",
       " is seen too weakly in the outputs: its pole can hardly be moved",
       " cannot be seen at these samples: the sample time matches its oscillation", true},
      findings);
  if (has_error(findings)) return certain;
  for (const Mode& mode : unreached_sampled_modes(sampled.A.transpose(), seen.transpose()).modes)
    add_once(findings, "plant.C", name_mode(plant, mode, false) + " is not seen in time: its pole cannot be moved");
  return certain;
}

namespace {

// A pair whose modes on the stability limit all have to be reached, for X or P to be stabilising.
struct LimitPair {
  RealMatrix A, weight;  // weight: symmetric, or any columns that reach
  bool is_continuous;

  bool on_limit(const ComplexReal& value) const { return is_continuous ? on_axis(value, norm(A)) : on_circle(value); }
};

// Modes on the limit that carry no weight, or, as rounded numbers may have it, less than none: vᴴ weight v < 0.
std::vector<Mode> unweighted_on_limit(const LimitPair& pair) {
  std::vector<Mode> found;
  const Unreached unreached =
      pair.is_continuous ? unreached_modes(pair.A, pair.weight) : unreached_sampled_modes(pair.A, pair.weight);
  for (const Mode& mode : unreached.modes)
    if (pair.on_limit(mode.value)) found.push_back(mode);
  if (!found.empty() || pair.weight.rows() != pair.weight.cols() || positive_definite(pair.weight)) return found;
  for (const ComplexReal& value : eigenvalues(pair.A)) {
    if (value.im < 0 || !pair.on_limit(value)) continue;
    const LeftEigenvector v = left_eigenvector(pair.A, value);
    const RealMatrix own = transpose_congruence(v.re, pair.weight) + transpose_congruence(v.im, pair.weight);
    if (own(0, 0) < -no_coupling() * largest_entry(pair.weight)) found.push_back({value, v.states});
  }
  return found;
}

// (A − BR⁻¹Nᵀ)ᵀ and Q − NR⁻¹Nᵀ: with R > 0 its unobservable modes are the only ones that cost nothing. With a singular
// R those of (A, [Q N]) are some of them.
LimitPair weighted_modes(const RiccatiEquation& e, bool is_continuous) {
  if (!positive_definite(e.R)) return {e.A.transpose(), beside(e.Q, e.N), is_continuous};
  const RealMatrix weighed = *solve(e.R, e.N.transpose());
  return {(e.A - multiply(e.B, weighed)).transpose(), symmetric_part(e.Q - multiply(e.N, weighed)), is_continuous};
}

}  // namespace

void check_weights_on_limit(const Problem& problem, const RiccatiEquation& e, Findings& findings) {
  const bool is_continuous = problem.regulator->cost == Cost::continuous;
  for (const Mode& mode : unweighted_on_limit(weighted_modes(e, is_continuous)))
    add_once(findings, "lqr.Q",
             name_mode(with_regulated_states(problem), without_decay(problem, mode), is_continuous) +
                 " is on the stability limit and carries no weight: no stabilising gain is optimal");
}

namespace {

// (A − G Swv V⁻¹C, G(W − Swv V⁻¹Swvᵀ)Gᵀ): the noise that no output tells.
LimitPair untold_noise(const Samples& samples) {
  const SampledPlant plant = own_plant(samples);
  const SampledNoise& noise = *samples.noise;
  const RealMatrix told = *solve(noise.V, beside(plant.C, noise.Swv.transpose()));
  const Index nx = plant.A.rows(), nw = plant.G.cols();
  const RealMatrix free = plant.A - multiply(plant.G, multiply(noise.Swv, told.leftCols(nx)));
  RealMatrix own = congruence(plant.G, symmetric_part(noise.W - multiply(noise.Swv, told.rightCols(nw))));
  if (samples.fictitious.size() > 0) own += samples.fictitious.topLeftCorner(nx, nx);
  return {free, own, false};
}

}  // namespace

// vᴴP0 v of the left eigenvectors v of those modes, all together, has to be as large as their space.
void check_start(const Problem& problem, const Samples& samples, Findings& findings) {
  const LimitPair pair = untold_noise(samples);
  RealMatrix vectors(pair.A.rows(), 0);
  std::string modes;
  for (const Mode& mode : unreached_sampled_modes(pair.A, pair.weight).modes) {
    if (!on_or_outside_circle(mode.value)) continue;
    const LeftEigenvector v = left_eigenvector(pair.A, mode.value);
    vectors = beside(vectors, v.re);
    if (!mode.value.im.is_zero()) vectors = beside(vectors, v.im);
    modes += (modes.empty() ? "" : ", ") + name_mode(problem.plant, mode, false);
  }
  if (vectors.cols() == 0) return;
  const Index own = samples.own_states;
  const RealMatrix P0 = initial_covariance(*problem.estimator, samples).topLeftCorner(own, own);
  const RealMatrix known = transpose_congruence(vectors, P0);
  if (eliminated(known).rank < eliminated(transpose_multiply(vectors, vectors)).rank)
    add_error(findings, "kalman.initial_covariance",
              modes +
                  ": no process noise drives this, and in some direction of it P0 has no uncertainty: the gains never "
                  "become the steady ones");
}

void check_noise_on_limit(const Problem& problem, const Samples& samples, Findings& findings) {
  for (const Mode& mode : unweighted_on_limit(untold_noise(samples)))
    add_once(findings, "kalman.process_noise",
             name_mode(problem.plant, mode, false) +
                 " is on the stability limit and driven by no process noise: "
                 "no stable steady filter is optimal");
}

}  // namespace lqg::design
