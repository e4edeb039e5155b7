// SPDX-License-Identifier: MIT
// The textbook in Eigen, matrices of fixed sizes: what a user of Eigen writes first. S is inverted, in closed form up
// to 4 × 4.
// Products of all sizes by coefficients, factors on the stack: nothing is allocated.
#define EIGEN_GEMM_TO_COEFFBASED_THRESHOLD 1000
#include <Eigen/Dense>

#include "peer.h"

template <int rows, int columns>
using Matrix = Eigen::Matrix<float, rows, columns, columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

template <int rows, int columns>
static Eigen::Map<const Matrix<rows, columns>> of(const float (&entries)[rows * columns]) {
  return Eigen::Map<const Matrix<rows, columns>>(entries);
}

static Matrix<NX, 1> x;
#ifdef CARRIED
static Matrix<NX, NX> P;
#endif

void peer_init(void) {
  x.setZero();
#ifdef CARRIED
  P = of<NX, NX>(P0);
#endif
}

void peer_sample(void*, const float y[NY], float u[NU]) {
  const Eigen::Map<const Matrix<NY, 1>> measured(y);
  Eigen::Map<Matrix<NU, 1>> input(u);
  const auto A_ = of<NX, NX>(A);
  const auto B_ = of<NX, NU>(B);
  const auto C_ = of<NY, NX>(C);
  const auto K_ = of<NU, NX>(K);
#ifdef CARRIED
  const Matrix<NX, NY> PCt = P * C_.transpose();
  const Matrix<NY, NY> S = C_ * PCt + of<NY, NY>(V);
  const Matrix<NX, NY> gain = PCt * S.inverse();
  x += gain * (measured - C_ * x);
  P -= gain * PCt.transpose();
#else
  x += of<NX, NY>(L) * (measured - C_ * x);
#endif
  input.noalias() = -(K_ * x);
  x = (A_ * x + B_ * input).eval();
#ifdef CARRIED
  const Matrix<NX, NX> predicted = A_ * P * A_.transpose() + of<NX, NX>(W);
  P = 0.5f * (predicted + predicted.transpose());  // without it P of two_mass is lost after 80 samples
#endif
}
