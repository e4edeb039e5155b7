/* SPDX-License-Identifier: MIT */
/* The textbook with the matrix functions of CMSIS-DSP, which has no filter of its own. */
#include "arm_math.h"
#include "peer.h"

#define MATRIX(name, rows, columns)                  \
    static float name##_entries[(rows) * (columns)]; \
    static arm_matrix_instance_f32 name = {rows, columns, name##_entries}
#define CONSTANT(name, rows, columns) \
    static const arm_matrix_instance_f32 name##_ = {rows, columns, (float *)(uintptr_t)name}

CONSTANT(A, NX, NX);
CONSTANT(B, NX, NU);
CONSTANT(C, NY, NX);
CONSTANT(K, NU, NX);
MATRIX(x, NX, 1);
MATRIX(Ax, NX, 1);
MATRIX(Bu, NX, 1);
MATRIX(correction, NX, 1);
MATRIX(innovation, NY, 1);
MATRIX(expected, NY, 1);
MATRIX(law, NU, 1);
#ifdef CARRIED
CONSTANT(W, NX, NX);
CONSTANT(V, NY, NY);
MATRIX(P, NX, NX);
MATRIX(AP, NX, NX);
MATRIX(APA, NX, NX);
MATRIX(A_transposed, NX, NX);
MATRIX(C_transposed, NX, NY);
MATRIX(PC, NX, NY);
MATRIX(PC_transposed, NY, NX);
MATRIX(CPC, NY, NY);
MATRIX(S, NY, NY);
MATRIX(S_inverse, NY, NY);
MATRIX(gain, NX, NY);
MATRIX(known, NX, NX);
#else
CONSTANT(L, NX, NY);
#endif

void peer_init(void)
{
    arm_fill_f32(0, x.pData, NX);
#ifdef CARRIED
    arm_copy_f32(P0, P.pData, NX * NX);
    (void)arm_mat_trans_f32(&A_, &A_transposed);
    (void)arm_mat_trans_f32(&C_, &C_transposed);
#endif
}

void peer_sample(void *unused, const float y[NY], float u[NU])
{
    (void)unused;
    (void)arm_mat_mult_f32(&C_, &x, &expected);
    arm_sub_f32(y, expected.pData, innovation.pData, NY);
#ifdef CARRIED
    (void)arm_mat_mult_f32(&P, &C_transposed, &PC);
    (void)arm_mat_mult_f32(&C_, &PC, &CPC);
    (void)arm_mat_add_f32(&CPC, &V_, &S);
    (void)arm_mat_inverse_f32(&S, &S_inverse);
    (void)arm_mat_mult_f32(&PC, &S_inverse, &gain);
    (void)arm_mat_mult_f32(&gain, &innovation, &correction);
    (void)arm_mat_trans_f32(&PC, &PC_transposed);
    (void)arm_mat_mult_f32(&gain, &PC_transposed, &known);
    (void)arm_mat_sub_f32(&P, &known, &P);
#else
    (void)arm_mat_mult_f32(&L_, &innovation, &correction);
#endif
    arm_add_f32(x.pData, correction.pData, x.pData, NX);
    (void)arm_mat_mult_f32(&K_, &x, &law);
    arm_negate_f32(law.pData, law.pData, NU);
    arm_copy_f32(law.pData, u, NU);
    (void)arm_mat_mult_f32(&A_, &x, &Ax);
    (void)arm_mat_mult_f32(&B_, &law, &Bu);
    (void)arm_mat_add_f32(&Ax, &Bu, &x);
#ifdef CARRIED
    (void)arm_mat_mult_f32(&A_, &P, &AP);
    (void)arm_mat_mult_f32(&AP, &A_transposed, &APA);
    (void)arm_mat_add_f32(&APA, &W_, &AP);
    (void)arm_mat_trans_f32(&AP, &APA);
    (void)arm_mat_add_f32(&AP, &APA, &P);
    arm_scale_f32(P.pData, 0.5f, P.pData, NX * NX); /* as in eigen.cpp */
#endif
}
