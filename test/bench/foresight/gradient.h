/* SPDX-License-Identifier: MIT */
/* The projected fast gradient method over all inputs of the horizon, with restarts: Y. Nesterov 1983; S. Richter, C. N.
 * Jones, M. Morari: Computational complexity certification for real-time MPC with input constraints. IEEE Transactions
 * on Automatic Control 57 (2012), 1391–1403; B. O'Donoghue, E. Candès: Adaptive restart for accelerated gradient
 * schemes. Foundations of Computational Mathematics 15 (2015), 715–732. */
#ifndef BENCH_GRADIENT_H
#define BENCH_GRADIENT_H

#include "counted.h"

enum { GRADIENT_CAP = 20000, ALL = HORIZON * NU, AHEAD = (HORIZON - 1) * STATES };

/* J/2 = ½ uᵀHu + uᵀE x + …; limited states: C u + D x */
static struct {
    double H[ALL * ALL], E[ALL * NX], C[(AHEAD + 1) * ALL], D[(AHEAD + 1) * NX];
    double largest; /* eigenvalue of H, and what the price adds */
} condensed;

static double gradient_u[ALL];

/* Adds Mᵀ W M of the rows [x; u] of a sample, of inputs and of the state. */
static void add_cost(const double of_u[], const double of_x[], const double weight[], int rows)
{
    add_congruence(condensed.H, of_u, weight, of_u, rows, ALL, ALL);
    add_congruence(condensed.E, of_u, weight, of_x, rows, ALL, NX);
}

static void advance_rows(double to[], const double from[], int columns, int sample)
{
    for (int i = 0; i < NX; i++)
        for (int j = 0; j < columns; j++) {
            double sum = columns == ALL && j / NU == sample ? B[i * NU + j % NU] : 0;
            for (int l = 0; l < NX; l++)
                sum += A[i * NX + l] * from[l * columns + j];
            to[i * columns + j] = sum;
        }
}

/* By the power method. */
static double largest_eigenvalue(void)
{
    double v[ALL], size = 0;

    for (int i = 0; i < ALL; i++)
        v[i] = 1 + i % 7;
    for (int n = 0; n < 3000; n++) {
        double next[ALL] = {0}, rows[AHEAD + 1] = {0};
        add_product(next, 1, condensed.H, v, ALL, ALL);
        add_product(rows, 1, condensed.C, v, AHEAD, ALL);
        for (int i = 0; i < AHEAD; i++)
            rows[i] *= price[i % EACH];
        add_transposed(next, 1, condensed.C, rows, AHEAD, ALL);
        size = 0;
        for (int i = 0; i < ALL; i++)
            size += next[i] * next[i];
        size = sqrt(size);
        for (int i = 0; i < ALL; i++)
            v[i] = next[i] / size;
    }
    return size * (1 + 1e-6);
}

static void begin_gradient(void)
{
    static double of_u[(NX + NU) * ALL], of_x[(NX + NU) * NX], next_u[NX * ALL], next_x[NX * NX];
    double weight[(NX + NU) * (NX + NU)];

    for (int i = 0; i < NX + NU; i++)
        for (int j = 0; j < NX + NU; j++)
            weight[i * (NX + NU) + j] = i < NX   ? j < NX ? Q[i * NX + j] : N[i * NU + j - NX]
                                          : j < NX ? N[j * NU + i - NX]
                                                 : R[(i - NX) * NU + j - NX];
    for (int i = 0; i < NX; i++)
        of_x[i * (NX + 1)] = 1;
    for (int k = 0; k < HORIZON; k++) {
        for (int i = 0; i < NU; i++) {
            memset(&of_u[(NX + i) * ALL], 0, ALL * sizeof *of_u);
            of_u[(NX + i) * ALL + k * NU + i] = 1;
        }
        for (int i = 0; k > 0 && i < STATES; i++) {
            memcpy(&condensed.C[((k - 1) * STATES + i) * ALL], &of_u[limited_state[i] * ALL], ALL * sizeof *of_u);
            memcpy(&condensed.D[((k - 1) * STATES + i) * NX], &of_x[limited_state[i] * NX], NX * sizeof *of_x);
        }
        add_cost(of_u, of_x, weight, NX + NU);
        advance_rows(next_u, of_u, ALL, k);
        advance_rows(next_x, of_x, NX, k);
        memcpy(of_u, next_u, sizeof next_u);
        memcpy(of_x, next_x, sizeof next_x);
    }
    add_cost(of_u, of_x, X, NX);
    condensed.largest = largest_eigenvalue();
}

static void forget_gradient(void)
{
    memset(gradient_u, 0, sizeof gradient_u);
}

/* The gradient of J/2 at u; h: its part of x, ahead: limited states without u. */
static void slope_at(double slope[ALL], const double u[ALL], const double h[ALL], const double ahead[AHEAD + 1])
{
    double excess[AHEAD + 1];

    memcpy(slope, h, sizeof *slope * ALL);
    add_product(slope, 1, condensed.H, u, ALL, ALL);
    memcpy(excess, ahead, sizeof excess);
    add_product(excess, 1, condensed.C, u, AHEAD, ALL);
    for (int i = 0; i < AHEAD; i++)
        excess[i] = price[i % EACH] * (excess[i] - within(excess[i], x_low[i % EACH], x_high[i % EACH]));
    add_transposed(slope, 1, condensed.C, excess, AHEAD, ALL);
}

static int run_gradient(const double x[NX], const double optimum[NU])
{
    struct arrival arrival = {0, 0};
    double at[ALL], h[ALL] = {0}, ahead[AHEAD + 1] = {0}, t = 1;

    add_product(h, 1, condensed.E, x, ALL, NX);
    add_product(ahead, 1, condensed.D, x, AHEAD, NX);
    memcpy(at, gradient_u, sizeof at);
    for (int n = 0; n < GRADIENT_CAP; n++) {
        const double t_next = (1 + sqrt(1 + 4 * t * t)) / 2, momentum = (t - 1) / t_next;
        double slope[ALL], uphill = 0;
        slope_at(slope, at, h, ahead);
        t = t_next;
        for (int i = 0; i < ALL; i++) {
            const double u = within(fma(-1 / condensed.largest, slope[i], at[i]), u_low[i % NU], u_high[i % NU]);
            const double step = u - gradient_u[i];
            uphill = fma(at[i] - u, step, uphill);
            at[i] = fma(momentum, step, u);
            gradient_u[i] = u;
        }
        if (uphill > 0) {
            t = 1;
            memcpy(at, gradient_u, sizeof at);
        }
        if (has_arrived(&arrival, gradient_u, optimum))
            return 1;
    }
    return 0;
}

#endif
