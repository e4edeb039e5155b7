// SPDX-License-Identifier: MIT
// In doubles: downhill to a minimum, also from a compensator that does not stabilise.
#pragma once

#include "design/order/closed_loop.hpp"

namespace lqg::design::order {

using Family = LoopFamily<double>;
using Point = LoopPoint<double>;

// The same compensator in coordinates z in which P_zz and S_zz, both with a small part of their mean added, are equal
// and diagonal.
Matrix<double> balanced(const Family& family, const Point& point);

// An orthonormal basis of the tangents of the orbit of similarities.
Matrix<double> orbit_basis(const Family& family, const Matrix<double>& Theta);

// Newton steps within a radius that is learned (J. J. Moré, D. C. Sorensen, "Computing a trust region step", SIAM
// Journal on Scientific and Statistical Computing 4 (1983), 553–572), across the orbit. A step that is not stable is
// refused, and the cost always falls. Ends after `most` steps or where a step would gain less than `least_gain` of the
// cost.
Point descend(const Family& family, Point point, int most, double least_gain);

// From any Θ: the problem made so easy that Θ is stable in it, then harder step by step, Θ following its minimum.
struct Continued {
  Point point;           // a minimum, where it is stable
  double ease = 0;       // else: the least ease (see eased) at which there is a compensator
  Matrix<double> Theta;  // that one
};
Continued continued(const Family& family, const Matrix<double>& Theta);

}  // namespace lqg::design::order
