/* SPDX-License-Identifier: MIT */
/* Multiply-adds, counted one by one: those of the library's solver, which computes fused here, and of the others. */
#ifndef BENCH_COUNTED_H
#define BENCH_COUNTED_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

static unsigned long multiply_adds;

static double counted_fma(double a, double b, double c)
{
    multiply_adds++;
    return fma(a, b, c);
}

#define fma counted_fma
#include "../../../src/mpc.c" /* lqg_mpc_control; compiled with LQG_REAL_DOUBLE and LQG_FUSED */

#include "problem.h"

/* y ← y + s M v, M rows × columns */
static void add_product(double y[], double s, const double M[], const double v[], int rows, int columns)
{
    for (int i = 0; i < rows; i++) {
        double sum = 0;
        for (int j = 0; j < columns; j++)
            sum = fma(M[i * columns + j], v[j], sum);
        y[i] += s * sum;
    }
}

/* y ← y + s Mᵀ v, M rows × columns */
static void add_transposed(double y[], double s, const double M[], const double v[], int rows, int columns)
{
    for (int j = 0; j < columns; j++) {
        double sum = 0;
        for (int i = 0; i < rows; i++)
            sum = fma(M[i * columns + j], v[i], sum);
        y[j] += s * sum;
    }
}

/* C ← C + Aᵀ W B, A n × a, W n × n, B n × b; of what is known beforehand. */
static void add_congruence(double C[], const double A[], const double W[], const double B[], int n, int a, int b)
{
    for (int i = 0; i < a; i++)
        for (int k = 0; k < n; k++) {
            double sum = 0;
            for (int l = 0; l < n; l++)
                sum += A[l * a + i] * W[l * n + k];
            for (int j = 0; j < b; j++)
                C[i * b + j] += sum * B[k * b + j];
        }
}

/* The inverse of a symmetric positive definite M. */
static void invert(double inverse[], const double M[], int n)
{
    double left[NU * NU];

    memcpy(left, M, sizeof(double) * (size_t)(n * n));
    for (int i = 0; i < n * n; i++)
        inverse[i] = i % (n + 1) == 0;
    for (int k = 0; k < n; k++) {
        const double pivot = left[k * n + k];
        for (int j = 0; j < n; j++) {
            left[k * n + j] /= pivot;
            inverse[k * n + j] /= pivot;
        }
        for (int i = 0; i < n; i++) {
            const double factor = i == k ? 0 : left[i * n + k];
            for (int j = 0; j < n; j++) {
                left[i * n + j] -= factor * left[k * n + j];
                inverse[i * n + j] -= factor * inverse[k * n + j];
            }
        }
    }
}

static double within(double value, double low, double high)
{
    return fmin(fmax(value, low), high);
}

static const double *const u_low = single_steps_low, *const u_high = single_steps_high;

#define ACCURACY 1e-3 /* of the range of each input */

enum { STAYS = 10, EACH = STATES ? STATES : 1 };

/* When an iteration has arrived: u of this sample is near the optimum, which a target does not know, and stays there.
 * What it takes to see that does not count. */
struct arrival {
    int nearby;
    unsigned long counted;
};

static int has_arrived(struct arrival *arrival, const double u[NU], const double optimum[NU])
{
    int is_near = 1;

    for (int i = 0; i < NU; i++)
        is_near &= fabs(u[i] - optimum[i]) <= ACCURACY * (u_high[i] - u_low[i]);
    if (is_near && arrival->nearby == 0)
        arrival->counted = multiply_adds;
    arrival->nearby = is_near ? arrival->nearby + 1 : 0;
    if (arrival->nearby <= STAYS)
        return 0;
    multiply_adds = arrival->counted;
    return 1;
}

#endif
