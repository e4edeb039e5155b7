/* SPDX-License-Identifier: MIT */
/* How far a contestant's answers are from those of the model's filter in double: the same answers are asked for before
 * anything is compared. */
#ifndef BENCH_EXTENDED_ANSWERS_H
#define BENCH_EXTENDED_ANSWERS_H

#include <math.h>

#include "peer.h"

static double larger(double a, double b)
{
    return a > b || a != a ? a : b;
}

/* Of x̂, in standard deviations of its error; of P_ij, relative to those of both. */
static double error_in_sample(unsigned k, real_t x[NX], real_t P[NX][NX])
{
    double error = 0;

    for (int i = 0; i < NX; i++) {
        const double variance = (double)P_expected[k][i * NX + i];

        error = larger(fabs((double)(x[i] - x_expected[k][i])) / sqrt(variance), error);
        for (int j = 0; j < NX; j++) {
            const double other = (double)P_expected[k][j * NX + j];

            error = larger(fabs((double)(P[i][j] - P_expected[k][i * NX + j])) / sqrt(variance * other), error);
        }
    }
    return error;
}

#endif
