// SPDX-License-Identifier: MIT
// The best that we could make of Eigen, matrices of fixed sizes: nothing is computed into a temporary first, S is
// factored as L Lᵀ in place of inverted, and of P only one triangle is computed, which the other mirrors. eigen.cpp is
// faster on small plants; of both the better one stands in the tables.
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

static void mirror() { P.triangularView<Eigen::StrictlyLower>() = P.transpose(); }

static void correct(const Matrix<NY, 1>& innovation) {
  const auto C_ = of<NY, NX>(C);
  Matrix<NY, NX> CP;
  CP.noalias() = C_.lazyProduct(P);
  Matrix<NY, NY> S = of<NY, NY>(V);
  S.triangularView<Eigen::Lower>() += CP.lazyProduct(C_.transpose());
  const Eigen::LLT<Eigen::Ref<Matrix<NY, NY>>> factored(S);
  Matrix<NY, 1> weighed = innovation;
  factored.matrixL().solveInPlace(weighed);
  factored.matrixL().solveInPlace(CP);
  x.noalias() += CP.transpose().lazyProduct(weighed);
  P.triangularView<Eigen::Upper>() -= CP.transpose().lazyProduct(CP);
  mirror();
}
#endif

void peer_init(void) {
  x.setZero();
#ifdef CARRIED
  P = of<NX, NX>(P0);
#endif
}

void peer_sample(void*, const float y[NY], float u[NU]) {
  Eigen::Map<Matrix<NU, 1>> input(u);
  Matrix<NY, 1> innovation = Eigen::Map<const Matrix<NY, 1>>(y);
  innovation.noalias() -= of<NY, NX>(C).lazyProduct(x);
#ifdef CARRIED
  correct(innovation);
#else
  x.noalias() += of<NX, NY>(L).lazyProduct(innovation);
#endif
  input.noalias() = -of<NU, NX>(K).lazyProduct(x);
  Matrix<NX, 1> next;
  next.noalias() = of<NX, NX>(A).lazyProduct(x);
  next.noalias() += of<NX, NU>(B).lazyProduct(input);
  x = next;
#ifdef CARRIED
  Matrix<NX, NX> AP;
  AP.noalias() = of<NX, NX>(A).lazyProduct(P);
  P = of<NX, NX>(W);
  P.triangularView<Eigen::Upper>() += AP.lazyProduct(of<NX, NX>(A).transpose());
  mirror();
#endif
}
