// SPDX-License-Identifier: MIT
#include "design/checks/representable.hpp"

#include <cmath>

#include "design/numeric/linear_algebra.hpp"
#include "design/rounding.hpp"
#include "design/solution_matrices.hpp"

namespace lqg::design {

namespace {

struct Misfit {
  bool overflows = false, vanishes = false;
};

template <typename Round>
Misfit misfit(const Real* entries, Index count, Round round) {
  Misfit result;
  for (Index i = 0; i < count; ++i) {
    const auto rounded = round(entries[i]);
    result.overflows = result.overflows || !std::isfinite(rounded);
    result.vanishes = result.vanishes || (rounded == 0 && !entries[i].is_zero());
  }
  return result;
}

}  // namespace

void check_representable(const Solution& solution, Scalar real, Findings& findings) {
  for_each_matrix(solution, [&](const std::string& name, Place place, const auto& matrix) {
    const bool in_float = place == Place::target && real == Scalar::float32;
    const std::string scalar = in_float ? "float" : "double", key = name.substr(0, name.find('.'));
    const Misfit found =
        in_float ? misfit(matrix.data(), matrix.size(), to_float) : misfit(matrix.data(), matrix.size(), to_double);
    if (found.overflows) add_error(findings, key, name + " has an entry too large for " + scalar);
    if (!found.vanishes) return;
    if (name == "kalman.V" && place == Place::target)
      add_error(findings, "kalman.measurement_noise", "a variance is too small for " + scalar);
    else
      add_note(findings, key, name + " has an entry too small for " + scalar + ": it becomes 0");
  });
}

}  // namespace lqg::design
