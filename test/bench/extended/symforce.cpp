// SPDX-License-Identifier: MIT
// What SymForce writes for the model, see symforce_code.py; PREDICT may name its other prediction.
#define _DEFAULT_SOURCE /* M_PI of newlib */
#include "peer.h"

#include "constants.h"
#include "predict_staged.h"
#include "predict_whole.h"
#include "update.h"

#ifndef PREDICT
#define PREDICT PredictWhole
#endif

template <int rows>
using Vector = Eigen::Matrix<real_t, rows, 1>;

// In flash, where the compiler sees them.
template <int rows>
static const Vector<rows>& vector_of(const real_t (&numbers)[rows]) {
  return *reinterpret_cast<const Vector<rows>*>(numbers);
}

static Vector<NX> x;
static Vector<NX*(NX + 1) / 2> P;

void peer_init(void) {
  x = vector_of(X0);
  P.setZero();
  for (int i = 0; i < NX; ++i) P(i * (i + 3) / 2) = P0[i];
}

__attribute__((flatten)) void peer_sample(const real_t u[NU], const real_t y[NY]) {
  Vector<NX> corrected;
  Vector<NX*(NX + 1) / 2> corrected_P;
  sym::Update<real_t>(x, P, vector_of(constants), vector_of(V), Eigen::Map<const Vector<NY>>(y), &corrected,
                      &corrected_P);
  sym::PREDICT<real_t>(corrected, corrected_P, Eigen::Map<const Vector<NU>>(u), vector_of(constants), vector_of(W), &x,
                       &P);
}

void peer_estimate(real_t to[NX], real_t to_P[NX][NX]) {
  for (int i = 0; i < NX; ++i) {
    to[i] = x(i);
    for (int j = 0; j <= i; ++j) to_P[i][j] = to_P[j][i] = P(i * (i + 1) / 2 + j);
  }
}
