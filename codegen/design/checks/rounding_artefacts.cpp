// SPDX-License-Identifier: MIT
#include "design/checks/rounding_artefacts.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>

#include "design/checks/mode_names.hpp"
#include "design/numeric/digits.hpp"
#include "design/numeric/factor.hpp"
#include "design/numeric/rounding_distance.hpp"
#include "design/rounding.hpp"
#include "design/sampled/noise.hpp"
#include "design/sampled/weights.hpp"

namespace lqg::design {

namespace {

using Eigen::MatrixXd;
using Complex = std::complex<double>;

// 500 units in the last place. Plants that were sampled or turned in double are within 15 of what they were meant to
// be, those that were meant to be reached not within 1e7.
constexpr double artefact = 500 * 2.220446049250313e-16;

// Poles no farther apart, beside the largest, may be one that rounding has split: up to (1e-16)^(1/4).
constexpr double split = 1e-3;

// [numbers − z on the leading diagonal of a square A]; `sizes` is what the numbers' roundings are relative to.
struct Pencil {
  Index states;
  MatrixXd numbers, sizes;
};

Pencil pencil(Index states, const MatrixXd& numbers) { return {states, numbers, numbers.cwiseAbs()}; }

MatrixXd side(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd all(a.rows(), a.cols() + b.cols());
  all << a, b;
  return all;
}

MatrixXd stack(const MatrixXd& a, const MatrixXd& b) { return side(a.transpose(), b.transpose()).transpose(); }

// Which modes are asked for: all, those on the limit (|z| = limit, Re s = limit), or those on it and beyond.
enum class Which { all, on, beyond };

struct Region {
  bool is_continuous;
  Which which = Which::all;
  double limit = 0;

  double excess(const Complex& value) const { return (is_continuous ? value.real() : std::abs(value)) - limit; }
  Complex on_limit(const Complex& value) const {
    return is_continuous ? Complex(limit, value.imag()) : value * (limit / std::abs(value));
  }
  // The value where it is asked for, or where rounding may have taken it from; false when that is nowhere.
  bool holds(Complex& value, double scale) const {
    if (which == Which::all || (which == Which::beyond && excess(value) >= 0)) return true;
    if (std::abs(excess(value)) > split * scale) return false;
    value = on_limit(value);
    return true;
  }
};

struct Artefact {
  Complex value;
  double share = 1;
  std::vector<Index> states;
};

// How far the numbers have to move at z; states of more than a millionth of the largest share take part.
Artefact distance_at(const Pencil& pencil, const Complex& z) {
  Eigen::MatrixXcd M = pencil.numbers.cast<Complex>();
  for (Index i = 0; i < pencil.states; ++i) M(i, i) -= z;
  const RoundingDistance distance = rounding_distance(M, pencil.sizes, 1e-6);
  Artefact result = {z, distance.share, {}};
  for (Index i = 0; i < pencil.states; ++i)
    if (distance.weights(i) > 1e-6 * distance.weights.maxCoeff()) result.states.push_back(i);
  return result;
}

// The nearest of this pole and, where it is near but no artefact, of the means of the poles around it: a multiple
// pole, which rounding scatters, is where their mean is.
Artefact nearest_around(const Pencil& pencil, const std::vector<Complex>& poles, const Complex& pole, const Complex& at,
                        const Region& region, double scale) {
  Artefact best = distance_at(pencil, at);
  if (best.share <= artefact || best.share > split) return best;
  std::vector<Complex> around = poles;
  const auto nearer = [&](const Complex& a, const Complex& b) { return std::abs(a - pole) < std::abs(b - pole); };
  std::stable_sort(around.begin(), around.end(), nearer);
  Complex sum = around.front();
  for (std::size_t k = 1; k < std::min<std::size_t>(4, around.size()); ++k) {
    if (std::abs(around[k] - pole) > split * scale) break;
    sum += around[k];
    Complex mean = sum / static_cast<double>(k + 1);
    if (!region.holds(mean, scale)) continue;
    const Artefact other = distance_at(pencil, mean);
    if (other.share < best.share) best = other;
  }
  return best;
}

std::vector<Complex> poles_of(const RealMatrix& A) {
  std::vector<Complex> poles;
  for (const ComplexReal& value : eigenvalues(A)) poles.emplace_back(to_double(value.re), to_double(value.im));
  return poles;
}

// One of each conjugate pair, and of what is one mode but for rounding.
std::vector<Artefact> artefacts(const Pencil& pencil, const RealMatrix& A, const Region& region) {
  const std::vector<Complex> poles = poles_of(A);
  double scale = 0;
  for (const Complex& pole : poles) scale = std::max(scale, std::abs(pole));
  std::vector<Artefact> found;
  for (const Complex& pole : poles) {
    Complex at = pole;
    if (pole.imag() < 0 || !region.holds(at, scale)) continue;
    const Artefact nearest = nearest_around(pencil, poles, pole, at, region, scale);
    const auto same = [&](const Artefact& other) { return std::abs(other.value - nearest.value) <= split * scale; };
    if (nearest.share <= artefact && std::none_of(found.begin(), found.end(), same)) found.push_back(nearest);
  }
  return found;
}

bool is_continuous(const Problem& problem) { return problem.plant.domain == Domain::continuous; }

double limit_of_stability(const Problem& problem) { return is_continuous(problem) ? 0 : 1; }

// Where the regulator's modes have to be beyond: the limit of stability, or that of a decay.
double limit_of_regulator(const Problem& problem) {
  const Decay decay = decay_per_mode(problem);
  return is_continuous(problem) ? to_double(-decay.rate) : to_double(1 / decay.alpha);
}

std::string name_of(const Problem& problem, const Artefact& mode) {
  return name_mode(problem.plant, {{Real(mode.value.real()), Real(mode.value.imag())}, mode.states},
                   is_continuous(problem));
}

// ": move every number of A and B by 4.1e-16 of itself (…), and none does"
std::string how_far(double share, const std::string& numbers, const std::string& then) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", std::max(share, 1e-17));
  return " only by the rounding of the file's numbers: move every number of " + numbers + " by " + text +
         " of itself (a double's last place is 2.2e-16), and " + then;
}

void add(Findings& findings, const Problem& problem, const std::string& key, const Artefact& mode,
         const std::string& text) {
  add_error(findings, key, name_of(problem, mode) + text);
}

Pencil reach_of(const Plant& plant) { return pencil(plant.A.rows(), side(plant.A, plant.B)); }

Pencil sight_of(const Plant& plant) { return pencil(plant.A.rows(), side(plant.A.transpose(), plant.C.transpose())); }

}  // namespace

void check_reach_is_no_artefact(const Problem& problem, Findings& findings) {
  const double stable = limit_of_stability(problem);
  const Region region = {is_continuous(problem), Which::beyond, limit_of_regulator(problem)};
  const Digits enough(50);
  for (const Artefact& mode : artefacts(reach_of(problem.plant), real(problem.plant.A), region)) {
    const bool is_slow = Region{region.is_continuous, Which::beyond, stable}.excess(mode.value) < -split;
    const std::string key = !is_slow ? "plant.B" : problem.regulator->settling_time ? "lqr.settling_time" : "lqr.decay";
    add(findings, problem, key, mode,
        " is reached by the inputs" + how_far(mode.share, "A and B", "no input reaches it: ") +
            (is_slow ? "it is slower than asked for" : "the plant is not stabilisable"));
  }
}

void check_sight_is_no_artefact(const Problem& problem, Findings& findings) {
  const Region region = {is_continuous(problem), Which::beyond, limit_of_stability(problem)};
  const Digits enough(50);
  for (const Artefact& mode : artefacts(sight_of(problem.plant), real(problem.plant.A), region))
    add(findings, problem, "plant.C", mode,
        " is seen in the outputs" + how_far(mode.share, "A and C", "no output sees it: the plant is not detectable"));
}

void check_placement_is_no_artefact(const Problem& problem, Findings& findings) {
  const Digits enough(50);
  for (const Artefact& mode : artefacts(reach_of(problem.plant), real(problem.plant.A), {is_continuous(problem)}))
    add(findings, problem, "plant.B", mode,
        " is reached by the inputs" + how_far(mode.share, "A and B", "no input reaches it: its pole cannot be moved"));
}

void check_observer_is_no_artefact(const Problem& problem, Findings& findings) {
  const Plant& plant = problem.plant;
  Pencil seen = sight_of(plant);
  if (!is_continuous(problem) && problem.estimator->form == Form::filter) {
    seen.numbers.rightCols(plant.C.rows()) = (plant.C * plant.A).transpose();
    seen.sizes.rightCols(plant.C.rows()) = (plant.C.cwiseAbs() * plant.A.cwiseAbs()).transpose();
  }
  const Digits enough(50);
  for (const Artefact& mode : artefacts(seen, real(plant.A), {is_continuous(problem)}))
    add(findings, problem, "plant.C", mode,
        " is seen in time" + how_far(mode.share, "A and C", "no output sees it: its pole cannot be moved"));
}

void check_set_points_are_no_artefact(const Problem& problem, const std::vector<int>& outputs, const std::string& key,
                                      Findings& findings) {
  const Plant& plant = problem.plant;
  const Index nx = plant.A.rows(), held = static_cast<Index>(outputs.size());
  MatrixXd CD(held, nx + plant.B.cols());
  for (Index i = 0; i < held; ++i)
    CD.row(i) << plant.C.row(outputs[static_cast<std::size_t>(i)]), plant.D.row(outputs[static_cast<std::size_t>(i)]);
  const Artefact zero =
      distance_at(pencil(nx, stack(side(plant.A, plant.B), CD)), Complex(is_continuous(problem) ? 0 : 1, 0));
  if (zero.share > artefact) return;
  add_error(findings, key,
            "constant inputs hold these outputs at a set point" +
                how_far(zero.share, "A, B, C and D",
                        "the plant has a zero at z = 1 (s = 0; " + name_states(plant, zero.states) +
                            ") from its inputs to them: no constant input holds them"));
}

namespace {

// A pencil, and the matrix whose eigenvalues are where it may lose rank.
struct Motion {
  Pencil pencil;
  RealMatrix A;
};

// [x; u]ᵀ [Aᵀ − z  Q  N; Bᵀ  Nᵀ  R] = 0: a motion that costs nothing. Without N nothing but x is in it.
Motion free_of_cost(const Plant& plant, const SampledCost& weights) {
  const MatrixXd Q = to_doubles(weights.Q);
  if (is_zero(weights.N)) return {pencil(plant.A.rows(), side(plant.A.transpose(), Q)), real(plant.A)};
  const MatrixXd N = to_doubles(weights.N), of_x = side(side(plant.A.transpose(), Q), N);
  const MatrixXd of_u = side(side(plant.B.transpose(), N.transpose()), to_doubles(weights.R));
  return {pencil(plant.A.rows(), stack(of_x, of_u)),
          real(plant.A) - multiply(real(plant.B), *solve(weights.R, weights.N.transpose()))};
}

// Nor does it show in an integral, which has a weight of its own.
void add_integrals(const Plant& plant, const std::vector<int>& outputs, Pencil& motion) {
  for (const int output : outputs) {
    MatrixXd seen(motion.numbers.rows(), 1);
    seen << plant.C.row(output).transpose(),
        plant.D.row(output).transpose().head(motion.numbers.rows() - plant.A.rows());
    motion = pencil(motion.states, side(motion.numbers, seen));
  }
}

// The motion's u is that of the plant's own time, and free to move.
bool may_move_inputs(const Problem& problem, const SampledCost& weights) {
  const Regulator& lqr = *problem.regulator;
  return positive_definite(weights.R) && lqr.input_rate.size() == 0 &&
         lqr.cost == (is_continuous(problem) ? Cost::continuous : Cost::discrete);
}

// [w; t]ᴴ [A − z  G W  G Swv; C  Swvᵀ  V] = 0: a motion that no noise drives. Without Swv nothing but w is in it.
Motion free_of_noise(const Plant& plant, const SampledNoise& noise) {
  const MatrixXd W = to_doubles(noise.W), GW = plant.G * W, sizes = plant.G.cwiseAbs() * W.cwiseAbs();
  if (is_zero(noise.Swv)) return {{plant.A.rows(), side(plant.A, GW), side(plant.A.cwiseAbs(), sizes)}, real(plant.A)};
  const MatrixXd S = to_doubles(noise.Swv);
  const MatrixXd of_y = side(side(plant.C, S.transpose()), to_doubles(noise.V));
  const Pencil motion = {
      plant.A.rows(), stack(side(side(plant.A, GW), plant.G * S), of_y),
      stack(side(side(plant.A.cwiseAbs(), sizes), plant.G.cwiseAbs() * S.cwiseAbs()), of_y.cwiseAbs())};
  const RealMatrix told = *solve(noise.V, real(plant.C));
  return {motion, real(plant.A) - multiply(multiply(real(plant.G), noise.Swv), told)};
}

// Of recovery: noise at the inputs as more columns of G.
void add_fictitious_noise(const Problem& problem, Plant& plant, SampledNoise& noise) {
  const RealMatrix q = Real(problem.estimator->recovery->q) * identity(plant.B.cols());
  noise.W = joint(noise.W, zeros(noise.W.rows(), q.rows()), q);
  noise.Swv = above(noise.Swv, zeros(q.rows(), noise.Swv.cols()));
  plant.G = side(plant.G, plant.B);
}

}  // namespace

void check_weights_are_no_artefact(const Problem& problem, Findings& findings) {
  const Digits enough(50);
  const SampledCost weights = weights_of(problem);
  if (!is_zero(weights.N) && !may_move_inputs(problem, weights)) return;
  Motion motion = free_of_cost(problem.plant, weights);
  if (problem.regulator->integral) add_integrals(problem.plant, problem.regulator->integral->outputs, motion.pencil);
  const Region region = {is_continuous(problem), Which::on, limit_of_regulator(problem)};
  for (const Artefact& mode : artefacts(motion.pencil, motion.A, region))
    add(findings, problem, "lqr.Q", mode,
        " carries a weight, or is off the stability limit," +
            how_far(mode.share, "A and Q", "it is on the limit without a weight: no stabilising gain is optimal"));
}

void check_noise_is_no_artefact(const Problem& problem, Findings& findings) {
  const Digits enough(50);
  SampledNoise noise = noise_of(problem);
  if (!is_zero(noise.Swv) && is_continuous(problem)) return;
  Plant plant = problem.plant;
  if (problem.estimator->recovery) add_fictitious_noise(problem, plant, noise);
  const Motion motion = free_of_noise(plant, noise);
  const Region region = {is_continuous(problem), Which::on, limit_of_stability(problem)};
  for (const Artefact& mode : artefacts(motion.pencil, motion.A, region))
    add(findings, problem, "kalman.process_noise", mode,
        " is driven by process noise, or is off the stability limit," +
            how_far(mode.share, "A, G and the noise",
                    "it is on the limit without noise: no stable steady filter is optimal"));
}

}  // namespace lqg::design
