/* SPDX-License-Identifier: MIT */
#include "textbook.h"

#include <string.h>

void textbook_init(const model_t *model, textbook_t *filter)
{
    memcpy(filter->x_prior, model->x0, sizeof model->x0);
    memcpy(filter->P_prior, model->P0, sizeof model->P0);
}

/* Σ_kl left_ik P_kl right_jl */
static double congruence(const double left[], unsigned i, const double P[], const double right[], unsigned j,
                         unsigned n)
{
    double sum = 0;
    for (unsigned k = 0; k < n; k++)
        for (unsigned l = 0; l < n; l++)
            sum += left[i * n + k] * P[k * n + l] * right[j * n + l];
    return sum;
}

/* S = C P⁻ Cᵀ + V and its inverse, one or two outputs. */
static void innovation_covariance(const model_t *model, textbook_t *filter)
{
    const unsigned ny = model->ny;
    double *S = filter->S, *inverse = filter->S_inverse;
    for (unsigned i = 0; i < ny; i++)
        for (unsigned j = 0; j < ny; j++)
            S[i * ny + j] = congruence(model->C, i, filter->P_prior, model->C, j, model->nx) + model->V[i * ny + j];
    if (ny == 1) {
        inverse[0] = 1 / S[0];
        return;
    }
    const double determinant = S[0] * S[3] - S[1] * S[2];
    inverse[0] = S[3] / determinant;
    inverse[1] = -S[1] / determinant;
    inverse[2] = -S[2] / determinant;
    inverse[3] = S[0] / determinant;
}

/* gain = (F P⁻ Cᵀ + cross) S⁻¹, with F = I and no cross for the filter gain. */
static void gain(const model_t *model, textbook_t *filter, const double F[], const double cross[], double result[])
{
    const unsigned nx = model->nx, ny = model->ny;
    for (unsigned i = 0; i < nx; i++)
        for (unsigned j = 0; j < ny; j++) {
            double sum = 0;
            for (unsigned k = 0; k < ny; k++) {
                const double covariance = congruence(F, i, filter->P_prior, model->C, k, nx) + cross[i * ny + k];
                sum += covariance * filter->S_inverse[k * ny + j];
            }
            result[i * ny + j] = sum;
        }
}

static void innovate(const model_t *model, textbook_t *filter, const lqg_real y[], const lqg_real u[])
{
    for (unsigned i = 0; i < model->ny; i++) {
        filter->innovation[i] = (double)y[i];
        for (unsigned j = 0; j < model->nx; j++)
            filter->innovation[i] -= model->C[i * model->nx + j] * filter->x_prior[j];
        for (unsigned j = 0; j < model->nu; j++)
            filter->innovation[i] -= model->D[i * model->nu + j] * (double)u[j];
    }
}

/* x += gain innovation,  P −= gain S gainᵀ */
static void correct(const model_t *model, const textbook_t *filter, const double L[], double x[], double P[])
{
    const unsigned nx = model->nx, ny = model->ny;
    for (unsigned i = 0; i < nx; i++) {
        for (unsigned k = 0; k < ny; k++)
            x[i] += L[i * ny + k] * filter->innovation[k];
        for (unsigned j = 0; j < nx; j++)
            P[i * nx + j] -= congruence(L, i, filter->S, L, j, ny);
    }
}

void textbook_update(const model_t *model, textbook_t *filter, const lqg_real y[], const lqg_real u_applied[])
{
    const double none[MAX_NX * MAX_NY] = {0};
    double identity[MAX_NX * MAX_NX] = {0};
    for (unsigned i = 0; i < model->nx; i++)
        identity[i * model->nx + i] = 1;

    innovation_covariance(model, filter);
    gain(model, filter, identity, none, filter->L);
    gain(model, filter, model->A, model->S, filter->L_predictor);
    innovate(model, filter, y, u_applied);

    memcpy(filter->x, filter->x_prior, sizeof filter->x);
    memcpy(filter->P, filter->P_prior, sizeof filter->P);
    correct(model, filter, filter->L, filter->x, filter->P);
}

void textbook_predict(const model_t *model, textbook_t *filter, const lqg_real u[])
{
    const unsigned nx = model->nx;
    double x[MAX_NX], P[MAX_NX * MAX_NX];
    for (unsigned i = 0; i < nx; i++) {
        x[i] = 0;
        for (unsigned j = 0; j < nx; j++)
            x[i] += model->A[i * nx + j] * filter->x_prior[j];
        for (unsigned j = 0; j < model->nu; j++)
            x[i] += model->B[i * model->nu + j] * (double)u[j];
        for (unsigned j = 0; j < nx; j++)
            P[i * nx + j] = congruence(model->A, i, filter->P_prior, model->A, j, nx) + model->W[i * nx + j];
    }
    correct(model, filter, filter->L_predictor, x, P);
    memcpy(filter->x_prior, x, nx * sizeof *x);
    memcpy(filter->P_prior, P, nx * nx * sizeof *P);
}
