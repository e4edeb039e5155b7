/* SPDX-License-Identifier: MIT */
/* The Kalman filter as a textbook has it, in double: all outputs at once, S inverted, nothing decorrelated.
 * Shares nothing with the library but the letters. Source: Anderson & Moore, Optimal Filtering (1979). */
#ifndef TEST_TEXTBOOK_H
#define TEST_TEXTBOOK_H

#include "model.h"

typedef struct {
    double x_prior[MAX_NX], P_prior[MAX_NX * MAX_NX]; /* x̂⁻, P⁻ */
    double x[MAX_NX], P[MAX_NX * MAX_NX];             /* x̂ and P after the update */
    double S[MAX_NY * MAX_NY], S_inverse[MAX_NY * MAX_NY];
    double L[MAX_NX * MAX_NY];           /* P⁻ Cᵀ S⁻¹ */
    double L_predictor[MAX_NX * MAX_NY]; /* (A P⁻ Cᵀ + E[w vᵀ]) S⁻¹ */
    double innovation[MAX_NY];
} textbook_t;

void textbook_init(const model_t *model, textbook_t *filter);

/* x̂ = x̂⁻ + L (y − C x̂⁻ − D u),  P = P⁻ − L S Lᵀ */
void textbook_update(const model_t *model, textbook_t *filter, const lqg_real y[], const lqg_real u_applied[]);

/* x̂⁻ = A x̂⁻ + B u + L_predictor innovation,  P⁻ = A P⁻ Aᵀ + W − L_predictor S L_predictorᵀ */
void textbook_predict(const model_t *model, textbook_t *filter, const lqg_real u[]);

#endif
