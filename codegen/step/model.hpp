// SPDX-License-Identifier: MIT
// The constants and the state of one controller, for any scalar.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "step/equations.hpp"
#include "step/scalar.hpp"

namespace lqg::step {

template <class S>
using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;
template <class S>
using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;

enum class Filter { none, steady, plain, ud };

// z = [u; F x] + G m within [low, high]: rows 0 … nu − 1 are u of this sample.
template <class S>
struct LimitedLaw {
  int nu = 0;
  unsigned iterations = 0;  // changes of the set of active limits, at most
  Matrix<S> F;              // (rows − nu) × nx
  Matrix<S> G;              // rows × rows
  Vector<S> scale;          // 1/√G_ii
  Vector<S> low, high;      // rows, infinite where there is none
  Vector<S> tolerance;      // rows: a smaller violation is none
  Vector<S> u_step;         // nu, or empty
};

// What the caller's numbers are where those of the model are 0; each vector is empty where all of it is 0.
template <class S>
struct OperatingPoint {
  Vector<S> x, u, y, r;  // nx, nu, ny, nr
};

// Absent parts have no rows or no columns: C without a filter, K without a regulator, D and M when they are zero.
template <class S>
struct Model {
  Filter filter = Filter::none;
  bool predictor_form = false;  // control before update
  int nx = 0, nu = 0, ny = 0;
  Matrix<S> A, B;  // x⁺ = A x + B u
  Matrix<S> C, D;  // y = C x + D u; of the decorrelated outputs E y when P is carried
  Matrix<S> L;     // nx × ny, steady
  Matrix<S> M;     // nx × ny: what the innovation (steady) or the residual (online) tells of w
  Matrix<S> E;     // ny × ny unit lower triangular, online
  Vector<S> V;     // ny, online
  S gate = S(0);   // σ: an innovation beyond it leaves its output out, as a spike or a gate; 0: any is let in
  Vector<S> gate_start, gate_widen,
      gate_narrow;         // ny, with a gate: how much wider it is, squared, and by what a sample changes that
  Vector<S> variance;      // ny, steady, with a gate: of the innovations
  Matrix<S> A_free, W;     // nx × nx, online: P⁺ = A_free P A_freeᵀ + W
  Matrix<S> G;             // nx × nq, ud: W = G diag(w) Gᵀ
  Vector<S> w;             // nq, ud
  Vector<S> y_min, y_max;  // ny, or empty: what a sensor can say at all
  Vector<S> nu_limit;  // ny, of the outputs whose C this is: an innovation that is not below it is left out; or empty
  std::vector<int> x_bound;  // nx: the estimate stays below 2^x_bound, or begins anew; empty: it has to be finite
  Matrix<S> to_estimate, of_estimate;  // T, T⁻¹, nx × nx: the filter keeps z in the place of x, x̂ = T z; or empty
  Vector<S> x0;                        // nx
  Vector<S> u0;                        // nu, or empty: the input that acts at the start, else 0
  std::vector<S> P0;                   // plain: lower triangle, row by row
  std::vector<S> U0, D0;               // ud: strict upper triangle, column by column; diagonal
  int delayed = 0;                     // the last of the nx states are this many inputs on their way, the oldest first
  Matrix<S> K;                         // nu × nz: over z = [x; ξ; u of the sample before where the law gives a change]
  Vector<S> u_min, u_max;              // nu, or empty: no limits
  bool has_finite_law = false;         // what the law asks for is known to be finite: nobody has to look
  Vector<S> law_begun;                 // nu, or empty: the sums of the law so far: as x̂, where K has no x̂ any more;
                                       // of an extended filter u + K x of the operating point
  Vector<S> prediction_begun;          // nx, or empty: likewise A x̂, where A is 0
  // A law with a memory.
  int nr = 0;                 // references
  Matrix<S> Nbar;             // nu × nr, or no columns
  bool gives_change = false;  // −K z + Nbar r is u[k] − u[k−1]
  Vector<S> u_step;           // nu: largest |u[k] − u[k−1]|, or empty
  LimitedLaw<S> foreseen;     // or no rows: u_min, u_max and u_step are clipped at; with rows they are not there
  std::vector<int> integral;  // the output that each ξ integrates,
  std::vector<int> wanted;    // and which r it has to follow
  Vector<S> error_limit;      // nxi: an r − y that is not below it does not count; or empty
  std::vector<int> xi_bound;  // nxi: as x_bound
  Matrix<S> H;                // nxi × nu: ξ + H (u − v) is ξ where u was applied in place of v
  Matrix<S> H_input;          // nxi × nu: ξ + H_input (u − v) makes the law give u, or nearly, where it gave v
  S T = S(0);                 // s, the sample time, of ξ⁺ = ξ + T (r − y)
  OperatingPoint<S> point;    // of x, u and y, which are deviations; only r of the state is in the plant's own units
  // An extended filter: A, C and what follows of them are made in each sample, of its equations. D says whether h needs
  // an input.
  std::shared_ptr<const Equations<S>> equations;
  Vector<S> linearised_at;  // nx: the outputs are y − h there, and C the Jacobian; or empty: they are C x + D u
};

// No gate is wider, squared: then it lets everything in that is believable.
constexpr int widest_gate_exponent = 80;
constexpr double widest_gate = 0x1p80;

// |value| < limit; where there are no limits, value is finite.
template <class S>
auto is_believable(const Vector<S>& limits, int i, const S& value) {
  return limits.size() ? is_less(absolute(value), S(limits(i))) : is_finite(value);
}

// D u needs the last input in every update.
template <class S>
bool has_feedthrough(const Model<S>& model) {
  return model.filter != Filter::none && model.D.cols() > 0;
}

// The law begins with the last input.
template <class S>
bool continues(const Model<S>& model) {
  return model.gives_change || model.u_step.size() > 0 || model.foreseen.u_step.size() > 0;
}

// P is carried along.
template <class S>
bool carries_covariance(const Model<S>& model) {
  return model.filter == Filter::plain || model.filter == Filter::ud;
}

template <class S>
struct State {
  Vector<S> x;           // nx
  std::vector<S> P;      // plain
  std::vector<S> U, D;   // ud
  Vector<S> u;           // nu: the input that acts; kept when D ≠ 0, and where the law begins with it
  Vector<S> widening;    // ny, with a gate: its threshold is this in units of gate² S, 1 at least
  Vector<S> innovation;  // ny: what predict still needs of the last outputs; kept when M ≠ 0
  Vector<S> r;           // nr: what the outputs should be, in the plant's own units
  Vector<S> xi;          // nxi: ξ, the integral of r − y
  Vector<S> error;       // nxi: r − y of this sample, which predict adds to ξ
  Vector<S> demand;      // nu: what the law asked for; kept where there is a ξ to correct
};

// Lower triangle row by row: P(i, j) = P(j, i).
inline int triangle(int i, int j) { return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i; }

// Strict upper triangle column by column: U(i, j), i < j.
inline int strict_triangle(int i, int j) { return j * (j - 1) / 2 + i; }

template <class S>
State<S> initial_state(const Model<S>& model) {
  State<S> state;
  state.x = model.x0;
  state.P = model.P0;
  state.U = model.U0;
  state.D = model.D0;
  const auto zeros = [](Eigen::Index size) { return Vector<S>(Vector<S>::Constant(size, S(0))); };
  const auto nxi = static_cast<Eigen::Index>(model.integral.size());
  state.u = zeros(has_feedthrough(model) || continues(model) ? model.nu : 0);
  if (state.u.size() && model.u0.size()) state.u = model.u0;
  state.widening = model.gate_start;
  state.innovation = zeros(model.M.cols());
  state.r = model.point.r.size() ? model.point.r : zeros(model.nr);
  state.xi = state.error = zeros(nxi);
  state.demand = zeros(nxi ? model.nu : 0);
  return state;
}

// After a fault: as at the start, but for what is asked of the loop.
template <class S>
void begin_anew(const Model<S>& model, State<S>& state) {
  const Vector<S> r = state.r;
  state = initial_state(model);
  state.r = r;
}

enum class Event {
  output_rejected,
  innovation_not_positive,
  input_limited,
  state_reset,
  reference_not_finite,
  output_gated,
  covariance_reset,
  not_optimal,     // not all limits could be kept, and u is clipped
  first_rejected,  // and seven more behind it: which outputs were rejected
};

// Which one of several a value is: that of a state, an input, an output, of the integral or the reference of one; an
// entry of a vector or a matrix; the entry of a row that is independent of row `without`. `of` is what it is one of, if
// that is not clear: the "P" of "the squares up to P_00".
struct Place {
  enum class Kind { single, state, input, output, integral, reference, entry };
  Kind kind = Kind::single;
  int i = -1, j = -1;
  const char* of = "";
  int without = -1;
};
inline Place of_state(int i, const char* of = "") { return {Place::Kind::state, i, -1, of, -1}; }
inline Place of_input(int i, const char* of = "") { return {Place::Kind::input, i, -1, of, -1}; }
inline Place of_output(int i, const char* of = "") { return {Place::Kind::output, i, -1, of, -1}; }
inline Place of_integral(int i, const char* of = "") { return {Place::Kind::integral, i, -1, of, -1}; }
inline Place of_reference(int i, const char* of = "") { return {Place::Kind::reference, i, -1, of, -1}; }
inline Place of_entry(int i, int j = -1, const char* of = "") { return {Place::Kind::entry, i, j, of, -1}; }
inline Place of_entry_without(int without, int i, int j) { return {Place::Kind::entry, i, j, "", without}; }
// What a number is that is no gain.
enum class Quantity {
  u_min,
  u_max,
  u_step,
  y_min,
  y_max,
  innovation_limit,
  innovation_limit_squared,
  innovation_variance,
  gate,
  gate_squared,
  gate_widen,
  gate_narrow,
  threshold,
  error_limit,
  sample_time,
  point_x,
  point_u,
  point_y
};
// How many outputs are told apart, all from the last on together.
inline constexpr int told_rejections = 8;

// That output i was the one.
inline Event rejection_of(int i) {
  return static_cast<Event>(static_cast<int>(Event::first_rejected) + (i < told_rejections ? i : told_rejections - 1));
}

// The bits of all of these.
inline unsigned all_rejections() {
  return ((1u << told_rejections) - 1) << static_cast<unsigned>(Event::first_rejected) |
         1u << static_cast<unsigned>(Event::output_rejected);
}

// Who listens to a step. This one only keeps the events; the printer of C keeps names and equations.
struct Listener {
  unsigned events = 0;

  // A new block of the algorithm: its equation, the output it belongs to (−1: none), and what follows the equation.
  template <class Text>
  void section(const Text&, int = -1, const char* = "") {}
  // `value` is called `base`, of a place.
  template <class Value>
  void name(const Value&, const char*, const Place& = {}) {}
  // Likewise, if it is called anything: a value that only one other is made of may stay without a name.
  template <class Value>
  void hint(const Value&, const char*, const Place& = {}) {}
  // `value`, which is such a number of signal i (−1: of all) unless it depends on the state.
  template <class S>
  S constant(const S& value, Quantity, int = -1) const {
    return value;
  }
  void raise(Event event, bool happened) {
    if (happened) events |= 1u << static_cast<unsigned>(event);
  }
  // Output i was not believable.
  void reject(int i, bool rejected) {
    raise(Event::output_rejected, rejected);
    raise(rejection_of(i), rejected);
  }
  // Says that output i was left out unless it is usable; returns whether it is.
  bool accept(bool usable, int i) {
    reject(i, !usable);
    return usable;
  }
  // Likewise; if the innovation is believable, it is its variance that is not positive.
  bool accept(bool usable, bool believable, int i) {
    raise(Event::innovation_not_positive, believable && !usable);
    reject(i, !believable);
    return usable;
  }
  // `condition`, and that the event did not happen in this call.
  bool without(Event event, bool condition) const {
    return condition && !(events >> static_cast<unsigned>(event) & 1u);
  }
  // A gate left the output out, which is counted.
  void gate(bool gated, int) { raise(Event::output_gated, gated); }
  // Whether output i, of the innovation nu, is used: at once where it is as `expected`, else as `otherwise` finds.
  template <class S, class Variance, class Otherwise>
  bool weigh(bool expected, int, const S&, Variance, Otherwise otherwise) {
    return expected || otherwise();
  }
};

}  // namespace lqg::step
