// SPDX-License-Identifier: MIT
#include "design/sampled/delay.hpp"

namespace lqg::design {

namespace {

const double whole = 1e-9;  // of the periods: more than typing rounded numbers explains

}  // namespace

Delay delay_of(const Plant& plant) {
  Delay delay;
  if (!(plant.delay > 0)) return delay;
  const Real T = plant.sample_time, periods = Real(plant.delay) / T, nearest = floor(periods + 0.5);
  delay.is_whole = abs(periods - nearest) <= whole * periods;
  delay.samples = static_cast<Index>(delay.is_whole ? nearest : ceil(periods));
  delay.part = delay.is_whole ? T : Real(Real(plant.delay) - (delay.samples - 1) * T);
  return delay;
}

RealMatrix acting_inputs(Index nx, Index nu, Index nw, Index samples) {
  const Index on_their_way = samples * nu;
  RealMatrix select = zeros(nx + 2 * nu + nw, nx + on_their_way + nu + nw);
  select.topLeftCorner(nx, nx) = identity(nx);
  if (samples > 0) select.block(nx, nx, nu, nu) = identity(nu);
  const Index newer = samples > 0 ? nx + nu : nx;  // the next younger one on its way, or u itself
  select.block(nx + nu, newer, nu, nu) = identity(nu);
  select.bottomRightCorner(nw, nw) = identity(nw);
  return select;
}

RealMatrix with_inputs_on_their_way(const RealMatrix& moves, Index nu, Index samples) {
  const Index nx = moves.rows(), size = nx + samples * nu;
  RealMatrix result = zeros(size, size + nu);
  result.topRows(nx) = multiply(moves, acting_inputs(nx, nu, 0, samples));
  result.bottomRightCorner(size - nx, size - nx) = identity(size - nx);  // each moves up by one
  return result;
}

}  // namespace lqg::design
