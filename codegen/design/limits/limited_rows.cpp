// SPDX-License-Identifier: MIT
#include "design/limits/limited_rows.hpp"

#include <algorithm>

#include "design/numeric/factor.hpp"
#include "design/numeric/ziv_test.hpp"

namespace lqg::design {

namespace {

// z = of_x x₀ + of_v v over the v of all blocks.
struct Foreseen {
  RealMatrix of_x, of_v;
};

Foreseen row_of(const Foreseen& all, Index i) { return {all.of_x.row(i), all.of_v.row(i)}; }

Foreseen combined(const RealMatrix& c, const Foreseen& x, const RealMatrix& d, const Foreseen& u) {
  return {multiply(c, x.of_x) + multiply(d, u.of_x), multiply(c, x.of_v) + multiply(d, u.of_v)};
}

Foreseen change(const Foreseen& now, const Foreseen& before) {
  return {now.of_x - before.of_x, now.of_v - before.of_v};
}

// x and u sample by sample.
class Prediction {
 public:
  explicit Prediction(const LimitedProblem& problem)
      : problem_(problem), nu_(problem.B.cols()),
        x_{identity(problem.A.rows()), zeros(problem.A.rows(), nu_ * static_cast<Index>(problem.blocks.size()))} {
    enter(0);
  }
  const Foreseen& x() const { return x_; }
  const Foreseen& u() const { return u_; }
  void advance(Index next_block) {
    x_ = combined(problem_.A, x_, problem_.B, u_);
    enter(next_block);
  }

 private:
  void enter(Index block) {
    u_ = {-multiply(problem_.K, x_.of_x), -multiply(problem_.K, x_.of_v)};
    for (Index i = 0; i < nu_; ++i) u_.of_v(i, block * nu_ + i) += 1;
  }

  const LimitedProblem& problem_;
  Index nu_;
  Foreseen x_, u_;
};

// The rows, one after the other.
struct Rows {
  std::vector<Foreseen> z;
  std::vector<Real> low, high;
  std::vector<std::optional<Real>> price;
  std::vector<int> sample;
  std::vector<std::string> names;

  void add(const Foreseen& row, const Real& least, const Real& most, const std::optional<Real>& cost, int when,
           const std::string& name) {
    z.push_back(row);
    names.push_back(name);
    low.push_back(least);
    high.push_back(most);
    price.push_back(cost);
    sample.push_back(when);
  }
};

bool has_limit(const Real& low, const Real& high) { return isfinite(low) || isfinite(high); }

// More than rounding of v moves it.
bool can_be_moved(const Foreseen& z) {
  const Real size = largest_entry(z.of_v);
  return !size.is_zero() && size > negligible(0.6) * largest_entry(z.of_x);
}

void add_quantities(const LimitedProblem& problem, const Prediction& now, const Prediction* before, int sample,
                    Rows& rows) {
  for (const LimitedQuantity& quantity : problem.quantities) {
    if (!has_limit(quantity.low, quantity.high) || (quantity.is_change && !before)) continue;
    Foreseen z = combined(quantity.c, now.x(), quantity.d, now.u());
    if (quantity.is_change) z = change(z, combined(quantity.c, before->x(), quantity.d, before->u()));
    if (can_be_moved(z))
      rows.add(z, quantity.low, quantity.high, quantity.price, sample,
               (quantity.is_change ? "change of " : "") + quantity.name);
  }
}

std::string name_of_input(const LimitedProblem& problem, Index i) {
  const std::size_t at = static_cast<std::size_t>(i);
  return at < problem.inputs.size() ? problem.inputs[at] : "u" + std::to_string(i);
}

void add_inputs(const LimitedProblem& problem, const Prediction& now, const Prediction* before, int sample,
                Rows& rows) {
  for (Index i = 0; i < problem.B.cols(); ++i)
    if (!before || has_limit(problem.u_min(i), problem.u_max(i)))
      rows.add(row_of(now.u(), i), problem.u_min(i), problem.u_max(i), {}, sample, name_of_input(problem, i));
  for (Index i = 0; before && i < problem.u_step.size(); ++i)
    if (isfinite(problem.u_step(i)))
      rows.add(change(row_of(now.u(), i), row_of(before->u(), i)), -problem.u_step(i), problem.u_step(i),
               problem.step_price(i), sample, "change of " + name_of_input(problem, i));
}

Rows rows_of(const LimitedProblem& problem) {
  Rows rows;
  Prediction now(problem);
  std::optional<Prediction> before;
  int sample = 0;
  for (Index block = 0; block < static_cast<Index>(problem.blocks.size()); ++block) {
    add_inputs(problem, now, before ? &*before : nullptr, sample, rows);
    add_quantities(problem, now, before ? &*before : nullptr, sample, rows);
    const int length = problem.blocks[static_cast<std::size_t>(block)];
    const bool is_last = block + 1 == static_cast<Index>(problem.blocks.size());
    for (int k = 0; k < length && !is_last; ++k, ++sample) {
      if (k + 1 == length) before.emplace(now);
      now.advance(k + 1 == length ? block + 1 : block);
    }
  }
  return rows;
}

// Σ α²ᵏ over the samples of a block.
Real cost_of_block(const Real& decay, int first, int length) {
  Real sum = 0;
  for (int k = first; k < first + length; ++k) sum += pow(decay, 2 * k);
  return sum;
}

// N diag(Σ α²ᵏ weight)⁻¹ Nᵀ: what v costs is that of every sample of its block.
std::optional<RealMatrix> gram_matrix(const LimitedProblem& problem, const RealMatrix& N) {
  const Index nu = problem.B.cols();
  if (!positive_definite(problem.weight)) return {};
  const std::optional<RealMatrix> inverse = solve(problem.weight, identity(nu));
  if (!inverse) return {};
  RealMatrix G = zeros(N.rows(), N.rows());
  int first = 0;
  for (std::size_t block = 0; block < problem.blocks.size(); ++block) {
    const RealMatrix part = N.middleCols(static_cast<Index>(block) * nu, nu);
    G += congruence(part, symmetric_part(*inverse)) / cost_of_block(problem.decay, first, problem.blocks[block]);
    first += problem.blocks[block];
  }
  return G;
}

// A share of the range; of the one limit where there is no other, or where both are the same.
Real tolerance_of(const Real& low, const Real& high, const Real& share) {
  if (isfinite(low) && isfinite(high) && low < high) return share * (high - low);
  return share * (isfinite(low) ? abs(low) : isfinite(high) ? abs(high) : Real(0));
}

}  // namespace

std::vector<int> default_blocks(int horizon, bool has_single_steps) {
  static constexpr int growing[] = {1, 1, 2, 4, 4};
  std::vector<int> blocks;
  for (int left = horizon; left > 0; left -= blocks.back()) {
    const int wanted = has_single_steps ? 1 : blocks.size() < std::size(growing) ? growing[blocks.size()] : 8;
    blocks.push_back(std::min(wanted, left));
  }
  return blocks;
}

std::optional<LimitedRows> limited_rows(const LimitedProblem& problem) {
  const Rows rows = rows_of(problem);
  const Index count = static_cast<Index>(rows.z.size()), nu = problem.B.cols();
  RealMatrix N = zeros(count, nu * static_cast<Index>(problem.blocks.size()));
  LimitedRows result;
  result.F = zeros(count - nu, problem.A.rows());
  for (Index i = 0; i < count; ++i) {
    const Foreseen& z = rows.z[static_cast<std::size_t>(i)];
    N.row(i) = z.of_v;
    if (i >= nu) result.F.row(i - nu) = z.of_x;
  }
  const std::optional<RealMatrix> G = gram_matrix(problem, N);
  if (!G) return {};
  result.G = *G;
  result.scale = result.low = result.high = result.tolerance = zeros(count, 1);
  result.sample = rows.sample;
  result.names = rows.names;
  for (Index i = 0; i < count; ++i) {
    const std::size_t at = static_cast<std::size_t>(i);
    Real& diagonal = result.G(i, i);
    const Real added = rows.price[at] ? std::max<Real>(1 / *rows.price[at], problem.softness * diagonal)
                                      : Real(problem.softening * diagonal);
    result.is_cheaper.push_back(rows.price[at] && added > 1 / *rows.price[at]);
    result.price.push_back(rows.price[at] ? std::optional<Real>(1 / added) : std::nullopt);
    diagonal += added;
    result.scale(i) = 1 / sqrt(diagonal);
    result.low(i) = rows.low[at];
    result.high(i) = rows.high[at];
    result.tolerance(i) = tolerance_of(rows.low[at], rows.high[at], problem.tolerance);
  }
  return result;
}

bool passes_ziv_test(const LimitedRows& coarse, LimitedRows& fine, unsigned coarse_digits) {
  const bool F = passes_ziv_test(coarse.F, fine.F, coarse_digits), G = passes_ziv_test(coarse.G, fine.G, coarse_digits);
  const bool scale = passes_ziv_test(coarse.scale, fine.scale, coarse_digits);
  return F && G && scale && coarse.sample == fine.sample;
}

}  // namespace lqg::design
