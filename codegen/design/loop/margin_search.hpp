// SPDX-License-Identifier: MIT
// How the places of margins are looked for on the unit circle: on a grid of angles first, then in its cells.
#pragma once

#include <functional>
#include <vector>

#include "design/numeric/linear_algebra.hpp"
#include "design/numeric/response.hpp"

namespace lqg::design {

using Evaluate = std::function<Eigen::MatrixXcd(const Real&)>;  // T at an angle, rounded to double
using Function = std::function<Real(const Real&)>;              // of an angle

// T at the angles of the grid, and between them.
struct Search {
  Evaluate evaluate;
  std::vector<Real> angles;
  std::vector<Eigen::MatrixXcd> responses;
};

// How exactly a place is found: steps and ends as fractions of the cell.
struct Fineness {
  double step, end_of_root, end_of_extremum;
};
inline constexpr Fineness rough = {1e-4, 1e-7, 1e-3}, as_far_as_double_goes = {1e-4, 1e-10, 1e-6},
                          exact = {1e-14, 1e-14, 1e-10};

Real pi();

// Angles in (0, π): as dense around every pole as it is close to the circle, 8 to an octave from both ends. These
// begin far inside of the pole that is nearest to ±1, for zeros may be nearer.
std::vector<Real> search_angles(const std::vector<ComplexReal>& poles);

// Powers of two of a real pole's distance are there twice, but for rounding. A cell between two such angles has no
// width, and neither of the two cells beside it need have the minimum of both.
std::vector<Real> without_near_ones(std::vector<Real> angles);

Search search_with(const Evaluate& evaluate, const std::vector<Real>& angles);

// A root of f between low and high, where its signs differ: secant steps, halving where they would leave the
// bracket. The last step is shorter than `fraction` of the bracket.
Real root_between(const Function& f, Real low, Real high, const Real& fraction);

// The difference quotient of f without its denominator.
Function slope_of(const Function& f, const Real& step);

}  // namespace lqg::design
