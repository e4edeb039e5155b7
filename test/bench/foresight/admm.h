/* SPDX-License-Identifier: MIT */
/* The alternating direction method of multipliers as TinyMPC has it: an LQR over the horizon for a copy of inputs and
 * states that has no limits, with gains and inverses that are known beforehand, a projection of the other copy, and
 * multipliers between them. K. Nguyen, S. Schoedel, A. Alavilli, B. Plancher, Z. Manchester: TinyMPC: model-predictive
 * control on resource-constrained microcontrollers. ICRA 2024.
 *
 * TinyMPC has one gain for all samples, that of R + ρI and Q + ρI for ever, which is another cost. Here each sample has
 * its own, and the horizon ends with X: so the optimum is that of the problem. A sample takes as many multiply-adds. */
#ifndef BENCH_ADMM_H
#define BENCH_ADMM_H

#include "counted.h"

enum { ADMM_CAP = 5000 };

static struct {
    double rho_u[NU], rho_x;
    double K[HORIZON][NU * NX], inverse[HORIZON][NU * NU], closed[HORIZON][NX * NX];
} cache;

static struct {
    double w[HORIZON * NU], y[HORIZON * NU];     /* inputs within their limits, multipliers */
    double s[HORIZON * EACH], g[HORIZON * EACH]; /* limited states, likewise */
    double d[HORIZON * NU], x[(HORIZON + 1) * NX], u[HORIZON * NU];
} admm;

/* What one sample back makes of P, the cost of the rest. */
static void go_back(int k, double P[NX * NX])
{
    double S[NU * NU], right[NU * NX], next[NX * NX];

    memcpy(S, R, sizeof S);
    for (int i = 0; i < NU; i++)
        S[i * (NU + 1)] += cache.rho_u[i];
    add_congruence(S, B, P, B, NX, NU, NU);
    invert(cache.inverse[k], S, NU);
    for (int i = 0; i < NU * NX; i++)
        right[i] = N[i % NX * NU + i / NX];
    add_congruence(right, B, P, A, NX, NU, NX);
    for (int i = 0; i < NU * NX; i++) {
        cache.K[k][i] = 0;
        for (int l = 0; l < NU; l++)
            cache.K[k][i] += cache.inverse[k][i / NX * NU + l] * right[l * NX + i % NX];
    }
    memcpy(cache.closed[k], A, sizeof cache.closed[k]);
    for (int i = 0; i < NX * NX; i++)
        for (int l = 0; l < NU; l++)
            cache.closed[k][i] -= B[i / NX * NU + l] * cache.K[k][l * NX + i % NX];
    memcpy(next, Q, sizeof next);
    for (int i = 0; k > 0 && i < STATES; i++)
        next[limited_state[i] * (NX + 1)] += cache.rho_x;
    add_congruence(next, A, P, A, NX, NX, NX);
    for (int i = 0; i < NX * NX; i++)
        for (int l = 0; l < NU; l++)
            next[i] -= right[l * NX + i / NX] * cache.K[k][l * NX + i % NX];
    memcpy(P, next, sizeof next);
}

/* ρ as a share of what an input costs over its range, W = R + BᵀXB, in the mean of the inputs. */
static void begin_admm(double share)
{
    double W[NU * NU], P[NX * NX], size = 0;

    memcpy(W, R, sizeof W);
    add_congruence(W, B, X, B, NX, NU, NU);
    for (int i = 0; i < NU; i++)
        size += W[i * (NU + 1)] * pow(u_high[i] - u_low[i], 2) / NU;
    for (int i = 0; i < NU; i++)
        cache.rho_u[i] = share * size / pow(u_high[i] - u_low[i], 2);
    cache.rho_x = share * size / pow(x_high[0] - x_low[0], 2);
    memcpy(P, X, sizeof P);
    for (int k = HORIZON; k-- > 0;)
        go_back(k, P);
}

static void forget_admm(void)
{
    memset(&admm, 0, sizeof admm);
}

/* d of each sample, from what pulls u and x towards their copies. */
static void pass_backward(void)
{
    double p[NX] = {0};

    for (int k = HORIZON; k-- > 0;) {
        double pull[NU], sum[NU], next[NX] = {0};
        for (int i = 0; i < NU; i++)
            sum[i] = pull[i] = cache.rho_u[i] * (admm.w[k * NU + i] - admm.y[k * NU + i]);
        add_transposed(sum, 1, B, p, NX, NU);
        memset(&admm.d[k * NU], 0, sizeof pull);
        add_product(&admm.d[k * NU], 1, cache.inverse[k], sum, NU, NU);
        for (int i = 0; k > 0 && i < STATES; i++)
            next[limited_state[i]] = cache.rho_x * (admm.s[k * STATES + i] - admm.g[k * STATES + i]);
        add_transposed(next, 1, cache.closed[k], p, NX, NX);
        add_transposed(next, -1, cache.K[k], pull, NU, NX);
        memcpy(p, next, sizeof p);
    }
}

static void pass_forward(void)
{
    for (int k = 0; k < HORIZON; k++) {
        const double *x = &admm.x[k * NX];
        double *u = &admm.u[k * NU], *next = &admm.x[(k + 1) * NX];
        memcpy(u, &admm.d[k * NU], NU * sizeof *u);
        add_product(u, -1, cache.K[k], x, NU, NX);
        memset(next, 0, NX * sizeof *next);
        add_product(next, 1, A, x, NX, NX);
        add_product(next, 1, B, u, NX, NU);
    }
}

/* Inputs to within their limits; states as far as the price of their excess goes. */
static void project(void)
{
    for (int i = 0; i < HORIZON * NU; i++) {
        const double free = admm.u[i] + admm.y[i];
        admm.w[i] = within(free, u_low[i % NU], u_high[i % NU]);
        admm.y[i] = free - admm.w[i];
    }
    for (int k = 1; k < HORIZON; k++)
        for (int i = 0; i < STATES; i++) {
            const double free = admm.x[k * NX + limited_state[i]] + admm.g[k * STATES + i];
            const double limit = within(free, x_low[i], x_high[i]);
            admm.s[k * STATES + i] = limit + cache.rho_x * (free - limit) / (cache.rho_x + price[i]);
            admm.g[k * STATES + i] = free - admm.s[k * STATES + i];
        }
}

/* Whether it arrives. */
static int run_admm(const double x[NX], const double optimum[NU])
{
    struct arrival arrival = {0, 0};

    memcpy(admm.x, x, NX * sizeof *x);
    for (int n = 0; n < ADMM_CAP; n++) {
        pass_backward();
        pass_forward();
        project();
        if (has_arrived(&arrival, admm.w, optimum))
            return 1;
    }
    return 0;
}

#endif
