// SPDX-License-Identifier: MIT
// What SymForce writes for the model, see symforce_code.py.
#include <utility>

#include "peer.h"

#include "model_code.h"

template <int rows>
using Vector = Eigen::Matrix<float, rows, 1>;

// In flash, where the compiler sees them.
static const auto& numbers = *reinterpret_cast<const Vector<sizeof entries / sizeof entries[0]>*>(entries);

struct State {
  Vector<NX> x;
#ifdef CARRIED
  Vector<NX*(NX + 1) / 2> P;
#endif
};
static State state;

#ifdef CARRIED
template <auto update>
static void correct(const State& from, float y, State& to) {
  update(from.x, from.P, numbers, y, &to.x, &to.P);
}
#endif

void peer_init(void) {
  state.x.setZero();
#ifdef CARRIED
  for (int i = 0, entry = 0; i < NX; ++i)
    for (int j = 0; j <= i; ++j) state.P(entry++) = P0[i * NX + j];
#endif
}

void peer_sample(void*, const float y[NY], float u[NU]) {
  State other;
  Vector<NU> input;
#ifdef CARRIED
  State *from = &state, *to = &other;
#define CORRECT(i)                                  \
  correct<sym::Update##i<float>>(*from, y[i], *to); \
  std::swap(from, to);
#include "corrections.h"
  sym::Predict<float>(from->x, from->P, numbers, &input, &to->x, &to->P);
  if (to != &state) state = *to;
#else
  sym::Update<float>(state.x, numbers, Eigen::Map<const Vector<NY>>(y), &other.x);
  sym::Predict<float>(other.x, numbers, &input, &state.x);
#endif
  Eigen::Map<Vector<NU>>{u} = input;
}
