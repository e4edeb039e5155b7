// SPDX-License-Identifier: MIT
#include "design/gains/schedule.hpp"

#include <algorithm>

#include "design/progress.hpp"
#include "design/rounding.hpp"

namespace lqg::design {

namespace {

// Of the noise that the gains are made for.
RealMatrix next_covariance(const Samples& samples, const EstimatorSolution& filter) {
  const RealMatrix P = next_error(samples, filter.L_predictor, filter.P_prior);
  return samples.fictitious.size() > 0 ? RealMatrix(P + samples.fictitious) : P;
}

bool round_alike(const Real& a, const Real& b, Scalar real) {
  return real == Scalar::float64 ? to_double(a) == to_double(b) : to_float(a) == to_float(b);
}

// The largest entry that each row of a gain has had.
class RowSizes {
 public:
  void take(const RealMatrix& gain) {
    sizes_.resize(static_cast<std::size_t>(gain.rows()));
    for (std::size_t i = 0; i < sizes_.size(); ++i)
      sizes_[i] = std::max<Real>(sizes_[i], largest_entry(gain.row(static_cast<Index>(i))));
  }
  const Real& of(Index row) const { return sizes_[static_cast<std::size_t>(row)]; }

 private:
  std::vector<Real> sizes_;
};

// A gain that tends to 0 has arrived when it is nothing beside what its row once was.
bool has_arrived(const RealMatrix& gain, const RealMatrix& steady, RowSizes& sizes, Scalar real) {
  sizes.take(gain);
  const Real rounding = real == Scalar::float64 ? ldexp(Real(1), -106) : ldexp(Real(1), -48);
  for (Index i = 0; i < gain.rows(); ++i) {
    const Real nothing = rounding * sizes.of(i);
    for (Index j = 0; j < gain.cols(); ++j)
      if (!round_alike(gain(i, j), steady(i, j), real) && abs(gain(i, j) - steady(i, j)) > nothing) return false;
  }
  return true;
}

// Appends the gains of sample k, of the covariance P before it; P is that of the next sample then.
void advance(const std::vector<SampledStage>& stages, int k, RealMatrix& P, GainSchedule& schedule) {
  report_progress("gains from the start on", k);
  const Samples& samples = stage_at(stages, k).samples;
  schedule.last = filter_of(samples, P);
  schedule.L.push_back(schedule.last.L);
  schedule.M.push_back(schedule.last.M);
  P = next_covariance(samples, schedule.last);
}

}  // namespace

GainSchedule gains_forward(const std::vector<SampledStage>& stages, const RealMatrix& P0, int count) {
  GainSchedule schedule;
  RealMatrix P = P0, error = P0, next = P0;
  for (int k = 0; k < count; ++k) {
    advance(stages, k, P, schedule);
    const Samples& samples = stage_at(stages, k).samples;
    if (samples.fictitious.size() == 0) continue;
    error = next;
    next = next_error(samples, schedule.last.L_predictor, error);
  }
  const Samples& last = stage_at(stages, count - 1).samples;
  if (last.fictitious.size() > 0) set_error(last, error, schedule.last);
  return schedule;
}

GainSchedule gains_until_steady(const std::vector<SampledStage>& stages, const RealMatrix& P0,
                                const EstimatorSolution& steady, Scalar real, int most) {
  GainSchedule schedule;
  RealMatrix P = P0;
  // A gain that swings passes the steady one; it does not stay there.
  const int enough = 2 * static_cast<int>(P0.rows()) + 10;
  std::size_t length = 0;
  RowSizes of_L, of_M;
  for (int k = 0, at_rest = 0; at_rest < enough; ++k) {
    advance(stages, k, P, schedule);
    const bool L_arrived = has_arrived(schedule.last.L, steady.L, of_L, real);
    const bool M_arrived = has_arrived(schedule.last.M, steady.M, of_M, real);
    const bool arrived = k >= last_change(stages) && L_arrived && M_arrived;
    at_rest = arrived ? at_rest + 1 : 0;
    if (!arrived) length = schedule.L.size();
    schedule.is_settled = static_cast<int>(length) <= most;
    if (!schedule.is_settled) break;
  }
  schedule.L.resize(length);
  schedule.M.resize(length);
  return schedule;
}

int most_gains(const Problem& problem, const EstimatorSolution& steady) {
  const Index tables = is_zero(steady.M) ? 1 : 2;
  const long bytes = (problem.code.real == Scalar::float64 ? 8 : 4) * static_cast<long>(tables * steady.L.size());
  return static_cast<int>(std::min<long>(most_steps, problem.code.flash / std::max<long>(bytes, 1)));
}

}  // namespace lqg::design
