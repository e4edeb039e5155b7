/* SPDX-License-Identifier: MIT */
#include "model.h"

#include <string.h>

const model_t double_integrator = {
    .nx = 2,
    .nu = 1,
    .ny = 1,
    .A = {1, 0.1, 0, 1},
    .B = {0.005, 0.1},
    .C = {1, 0},
    .W = {0.0004, 0.006, 0.006, 0.12},
    .V = {0.01},
    .P0 = {1, 0, 0, 1},
};

/* Two masses with spring and damper, k = 0.1, b = 0.004, 1 kg and 0.2 kg, by semi-implicit Euler, T = 0.5 s.
 * */
const model_t two_mass = {
    .nx = 4,
    .nu = 1,
    .ny = 2,
    .A = {0.975, 0.499, 0.025, 0.001, -0.05, 0.998, 0.05, 0.002, 0.125, 0.005, 0.875, 0.495, 0.25, 0.01, -0.25, 0.99},
    .B = {0.25, 0.5, 0, 0},
    .C = {1, 0, 0, 0, 0, 0, 1, 0},
    .D = {0.1, -0.05},
    .W = {0.000625, 0.00125, 0, 0, 0.00125, 0.0025, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
    .V = {0.001, 0, 0, 0.001},
    .x0 = {0.5, 0, -0.5, 0},
    .P0 = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
};

const model_t correlated = {
    .nx = 3,
    .nu = 1,
    .ny = 2,
    .A = {0.9, 0.2, 0, -0.1, 0.8, 0.1, 0.05, 0, 0.7},
    .B = {0, 0.5, 1},
    .C = {1, 0, 0.5, 0, 1, -1},
    .D = {0, 0.25},
    .W = {0.02, 0.005, 0, 0.005, 0.03, 0, 0, 0, 0.01},
    .V = {0.04, 0.02, 0.02, 0.05},
    .x0 = {1, 2, 3},
    .P0 = {2, 0.5, 0, 0.5, 1, 0.25, 0, 0.25, 0.5},
};

const model_t cross_noise = {
    .nx = 2,
    .nu = 1,
    .ny = 2,
    .A = {0.95, 0.1, -0.2, 0.9},
    .B = {0.1, 1},
    .C = {1, 0, 1, 1},
    .W = {0.05, 0.01, 0.01, 0.04},
    .V = {0.1, 0.03, 0.03, 0.2},
    .S = {0.03, -0.02, 0.01, 0.04},
    .P0 = {1, 0.3, 0.3, 2},
};

const model_t random_walk = {
    .nx = 1,
    .ny = 1,
    .A = {1},
    .C = {1},
    .W = {0.25},
    .V = {1},
    .x0 = {3},
    .P0 = {4},
};

static void round_all(lqg_real to[], const double from[], unsigned length)
{
    for (unsigned i = 0; i < length; i++)
        to[i] = (lqg_real)from[i];
}

static int any_nonzero(const double values[], unsigned length)
{
    for (unsigned i = 0; i < length; i++)
        if (values[i] != 0)
            return 1;
    return 0;
}

/* P = U diag(d) Uᵀ, U unit upper triangular, full n × n. */
static void factorise_ud(const double P[], unsigned n, double U[], double d[])
{
    double left[MAX_NX * MAX_NX];
    memcpy(left, P, n * n * sizeof *P);
    memset(U, 0, n * n * sizeof *U);
    for (unsigned j = n; j-- > 0;) {
        d[j] = left[j * n + j] > 1e-14 ? left[j * n + j] : 0;
        for (unsigned i = 0; i < j; i++)
            U[i * n + j] = d[j] > 0 ? left[i * n + j] / d[j] : 0;
        U[j * n + j] = 1;
        for (unsigned i = 0; i < j; i++)
            for (unsigned k = 0; k < j; k++)
                left[i * n + k] -= d[j] * U[i * n + j] * U[k * n + j];
    }
}

/* E with E V Eᵀ = diag(v), E unit lower triangular: Gram–Schmidt of the unit vectors under V. */
static void diagonalise(const double V[], unsigned n, double E[], double v[])
{
    memset(E, 0, n * n * sizeof *E);
    for (unsigned i = 0; i < n; i++) {
        E[i * n + i] = 1;
        for (unsigned j = 0; j < i; j++) {
            double overlap = 0; /* of the unit vector i with row j of E */
            for (unsigned k = 0; k <= j; k++)
                overlap += V[i * n + k] * E[j * n + k];
            for (unsigned k = 0; k <= j; k++)
                E[i * n + k] -= overlap / v[j] * E[j * n + k];
        }
        v[i] = 0;
        for (unsigned k = 0; k <= i; k++)
            for (unsigned l = 0; l <= i; l++)
                v[i] += E[i * n + k] * V[k * n + l] * E[i * n + l];
    }
}

/* to = left · right, rows × inner times inner × columns; right transposed if it is stored as columns × inner.
 * */
static void multiply(double to[], const double left[], const double right[], unsigned rows, unsigned inner,
                     unsigned columns, int transposed)
{
    for (unsigned i = 0; i < rows; i++)
        for (unsigned j = 0; j < columns; j++) {
            to[i * columns + j] = 0;
            for (unsigned k = 0; k < inner; k++)
                to[i * columns + j] += left[i * inner + k] * right[transposed ? j * inner + k : k * columns + j];
        }
}

static void round_lower(lqg_real to[], const double from[], unsigned n)
{
    for (unsigned i = 0; i < n; i++)
        round_all(to + LQG_TRIANGLE(i), from + i * n, i + 1);
}

static void round_ud(lqg_real U[], lqg_real d[], const double P[], unsigned n)
{
    double full[MAX_NX * MAX_NX], diagonal[MAX_NX];
    factorise_ud(P, n, full, diagonal);
    round_all(d, diagonal, n);
    for (unsigned j = 0; j < n; j++)
        for (unsigned k = 0; k < j; k++)
            U[LQG_STRICT_TRIANGLE(j) + k] = (lqg_real)full[k * n + j];
}

void prepare_online(const model_t *model, online_t *to)
{
    const unsigned nx = model->nx, nu = model->nu, ny = model->ny;
    double E[MAX_NY * MAX_NY], v[MAX_NY], C[MAX_NY * MAX_NX], D[MAX_NY * MAX_NU];
    double M[MAX_NX * MAX_NY] = {0}, MC[MAX_NX * MAX_NX], A_free[MAX_NX * MAX_NX], W[MAX_NX * MAX_NX] = {0};
    double G[MAX_NX * MAX_NX], variances[MAX_NX];

    diagonalise(model->V, ny, E, v);
    multiply(C, E, model->C, ny, ny, nx, 0);
    multiply(D, E, model->D, ny, ny, nu, 0);
    multiply(M, model->S, E, nx, ny, ny, 1);
    for (unsigned i = 0; i < nx * ny; i++)
        M[i] /= v[i % ny];
    multiply(MC, M, C, nx, ny, nx, 0);
    for (unsigned i = 0; i < nx; i++)
        for (unsigned j = 0; j < nx; j++) {
            A_free[i * nx + j] = model->A[i * nx + j] - MC[i * nx + j];
            W[i * nx + j] = model->W[i * nx + j];
            for (unsigned k = 0; k < ny; k++)
                W[i * nx + j] -= M[i * ny + k] * v[k] * M[j * ny + k];
        }
    factorise_ud(W, nx, G, variances);

    round_all(to->A, model->A, nx * nx);
    round_all(to->B, model->B, nx * nu);
    round_all(to->C, C, ny * nx);
    round_all(to->D, D, ny * nu);
    round_all(to->E, E, ny * ny);
    round_all(to->V, v, ny);
    round_all(to->M, M, nx * ny);
    round_all(to->A_free, A_free, nx * nx);
    round_lower(to->W, W, nx);
    round_all(to->G, G, nx * nx);
    round_all(to->variances, variances, nx);
    round_all(to->x0, model->x0, nx);
    round_lower(to->P0, model->P0, nx);
    round_ud(to->U0, to->d0, model->P0, nx);

    const int crossed = any_nonzero(model->S, nx * ny);
    const lqg_plant_t plant = {
        nx, nu, ny, to->A, nu ? to->B : NULL, to->C, any_nonzero(model->D, ny * nu) ? to->D : NULL, NULL};
    const lqg_real *E_or_none = ny > 1 && model->V[1] != 0 ? to->E : NULL;
    const lqg_real *M_or_none = crossed ? to->M : NULL, *A_free_or_none = crossed ? to->A_free : NULL;

    const lqg_kalman_plain_t plain = {plant,  E_or_none, to->V, to->W, M_or_none, A_free_or_none,
                                      to->x0, to->P0,    NULL,  NULL,  NULL};
    const lqg_kalman_ud_t ud = {plant,          E_or_none, to->V,  nx,     to->G, to->variances, M_or_none,
                                A_free_or_none, to->x0,    to->U0, to->d0, NULL,  NULL,          NULL};
    to->plain = plain;
    to->ud = ud;
}

double ud_covariance(const lqg_real U[], const lqg_real d[], unsigned nx, unsigned i, unsigned j)
{
    double sum = 0;
    for (unsigned k = i > j ? i : j; k < nx; k++) {
        const double U_ik = i == k ? 1 : (double)U[LQG_STRICT_TRIANGLE(k) + i];
        const double U_jk = j == k ? 1 : (double)U[LQG_STRICT_TRIANGLE(k) + j];
        sum += U_ik * (double)d[k] * U_jk;
    }
    return sum;
}

double noise(unsigned long *seed)
{
    *seed = (*seed * 1664525ul + 1013904223ul) & 0xfffffffful;
    return (double)(*seed >> 16) / 32768.0 - 1.0;
}

void simulate(const model_t *model, double x[], const lqg_real u[], lqg_real y[], unsigned long *seed)
{
    const unsigned nx = model->nx, nu = model->nu, ny = model->ny;
    double next[MAX_NX];
    for (unsigned i = 0; i < nx; i++) {
        next[i] = 0.1 * noise(seed);
        for (unsigned j = 0; j < nx; j++)
            next[i] += model->A[i * nx + j] * x[j];
        for (unsigned j = 0; j < nu; j++)
            next[i] += model->B[i * nu + j] * (double)u[j];
    }
    memcpy(x, next, nx * sizeof *x);
    for (unsigned i = 0; i < ny; i++) {
        double sum = 0.1 * noise(seed);
        for (unsigned j = 0; j < nx; j++)
            sum += model->C[i * nx + j] * x[j];
        for (unsigned j = 0; j < nu; j++)
            sum += model->D[i * nu + j] * (double)u[j];
        y[i] = (lqg_real)sum;
    }
}
