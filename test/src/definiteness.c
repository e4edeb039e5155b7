/* SPDX-License-Identifier: MIT */
/* How often the covariance of a random filter loses its definiteness when it is carried as it is, in Joseph's
 * form, and as U diag(d) Uᵀ. Prints one table; fails when a UD filter is among the lost, or no other.
 *
 * A filter: 2 to 6 states, 1 or 2 outputs, A with a spectral radius of 0.5 to 1.02, all drawn; 300 samples.
 * Lost: after an update or a prediction a pivot of P, computed in double, is negative, or P is not finite. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "lqg/kalman.h"

enum { MAX_NX = 6, MAX_NY = 2, DESIGNS = 1000, SAMPLES = 300 };

/* What the rows of the table differ in: exponents of 10, drawn uniformly between a and b. */
typedef struct {
    const char *name;
    double V[2], W[2], P0[2];
    int all_noises; /* every state has a noise of its own; otherwise one noise drives them all */
} ensemble_t;

static const ensemble_t ensembles[] = {
    {"all states driven, ordinary sensors", {-2, 0}, {-2, 0}, {0, 0}, 1},
    {"one noise, ordinary sensors", {-2, 0}, {-2, 0}, {0, 0}, 0},
    {"one noise, precise sensors", {-8, -4}, {-2, 0}, {0, 0}, 0},
    {"all states driven, precise sensors", {-8, -4}, {-2, 0}, {0, 0}, 1},
    {"all states driven, ordinary sensors, start unknown", {-2, 0}, {-2, 0}, {6, 8}, 1},
};
enum { ENSEMBLES = sizeof ensembles / sizeof *ensembles };

typedef struct {
    unsigned nx, ny, nw;
    lqg_real A[MAX_NX * MAX_NX], C[MAX_NY * MAX_NX], V[MAX_NY], W[LQG_TRIANGLE(MAX_NX)];
    lqg_real G[MAX_NX * MAX_NX], w[MAX_NX], P0[LQG_TRIANGLE(MAX_NX)];
    lqg_real U0[LQG_STRICT_TRIANGLE(MAX_NX)], d0[MAX_NX];
} design_t;

static double draw(unsigned long *seed)
{
    *seed = (*seed * 1664525ul + 1013904223ul) & 0xfffffffful;
    return (double)(*seed >> 8) / 16777216.0;
}

static double draw_between(unsigned long *seed, double low, double high)
{
    return low + (high - low) * draw(seed);
}

static double draw_magnitude(unsigned long *seed, const double exponents[2])
{
    return pow(10, draw_between(seed, exponents[0], exponents[1]));
}

/* |A|₂ growth over 64 powers, which is the spectral radius near enough. */
static double spectral_radius(const double A[], unsigned nx)
{
    double v[MAX_NX], next[MAX_NX], log_growth = 0;
    for (unsigned i = 0; i < nx; i++)
        v[i] = 1 + i;
    for (unsigned step = 0; step < 64; step++) {
        double norm = 0;
        for (unsigned i = 0; i < nx; i++) {
            next[i] = 0;
            for (unsigned j = 0; j < nx; j++)
                next[i] += A[i * nx + j] * v[j];
            norm += next[i] * next[i];
        }
        norm = sqrt(norm);
        for (unsigned i = 0; i < nx; i++)
            v[i] = next[i] / norm;
        log_growth += step < 16 ? 0 : log(norm) / 48;
    }
    return exp(log_growth);
}

static void draw_plant(design_t *design, unsigned long *seed)
{
    double A[MAX_NX * MAX_NX];
    const unsigned nx = design->nx;
    for (unsigned i = 0; i < nx * nx; i++)
        A[i] = draw_between(seed, -1, 1);
    const double scale = draw_between(seed, 0.5, 1.02) / spectral_radius(A, nx);
    for (unsigned i = 0; i < nx * nx; i++)
        design->A[i] = (lqg_real)(A[i] * scale);
    for (unsigned i = 0; i < design->ny * nx; i++)
        design->C[i] = (lqg_real)draw_between(seed, -1, 1);
}

static void draw_noises(design_t *design, const ensemble_t *ensemble, unsigned long *seed)
{
    const unsigned nx = design->nx, nw = design->nw;
    for (unsigned i = 0; i < design->ny; i++)
        design->V[i] = (lqg_real)draw_magnitude(seed, ensemble->V);
    for (unsigned q = 0; q < nw; q++)
        design->w[q] = (lqg_real)draw_magnitude(seed, ensemble->W);
    for (unsigned i = 0; i < nx * nw; i++)
        design->G[i] = (lqg_real)(nw == 1 ? draw_between(seed, -1, 1) : i % nw == i / nw);
    for (unsigned i = 0; i < nx; i++)
        for (unsigned j = 0; j <= i; j++) {
            double sum = 0;
            for (unsigned q = 0; q < nw; q++)
                sum += (double)design->G[i * nw + q] * (double)design->w[q] * (double)design->G[j * nw + q];
            design->W[LQG_TRIANGLE(i) + j] = (lqg_real)sum;
        }
    for (unsigned i = 0; i < nx; i++)
        design->P0[LQG_TRIANGLE(i) + i] = design->d0[i] = (lqg_real)draw_magnitude(seed, ensemble->P0);
}

static void draw_design(design_t *design, const ensemble_t *ensemble, unsigned long *seed)
{
    memset(design, 0, sizeof *design);
    design->nx = 2 + (unsigned)(draw(seed) * 5);
    design->ny = 1 + (unsigned)(draw(seed) * 2);
    design->nw = ensemble->all_noises ? design->nx : 1;
    draw_plant(design, seed);
    draw_noises(design, ensemble, seed);
}

/* A pivot of P = U diag(pivots) Uᵀ is negative, or not a number. */
static int is_lost(const lqg_real P[], unsigned nx)
{
    double left[MAX_NX][MAX_NX];
    for (unsigned i = 0; i < nx; i++)
        for (unsigned j = 0; j <= i; j++)
            left[i][j] = left[j][i] = (double)P[LQG_TRIANGLE(i) + j];
    for (unsigned j = nx; j-- > 0;) {
        if (!(left[j][j] >= 0))
            return 1;
        for (unsigned i = 0; i < j; i++)
            for (unsigned k = 0; k < j && left[j][j] > 0; k++)
                left[i][k] -= left[i][j] * left[j][k] / left[j][j];
    }
    return 0;
}

static lqg_real entry(const lqg_real P[], unsigned i, unsigned j)
{
    return i < j ? P[LQG_TRIANGLE(j) + i] : P[LQG_TRIANGLE(i) + j];
}

/* P ← (I − L c) P (I − L c)ᵀ + v L Lᵀ, L = P cᵀ/s: nothing but congruences and a sum. */
static void joseph_update(lqg_real P[], unsigned nx, const lqg_real c[], lqg_real v)
{
    lqg_real f[MAX_NX], L[MAX_NX], M[MAX_NX][MAX_NX], s = v;
    for (unsigned i = 0; i < nx; i++) {
        f[i] = 0;
        for (unsigned j = 0; j < nx; j++)
            f[i] += entry(P, i, j) * c[j];
        s += c[i] * f[i];
    }
    for (unsigned i = 0; i < nx; i++)
        L[i] = f[i] / s;
    for (unsigned i = 0; i < nx; i++)
        for (unsigned j = 0; j < nx; j++)
            M[i][j] = entry(P, i, j) - L[i] * f[j];
    for (unsigned i = 0; i < nx; i++) {
        lqg_real M_c = 0;
        for (unsigned j = 0; j < nx; j++)
            M_c += M[i][j] * c[j];
        for (unsigned j = 0; j <= i; j++)
            P[LQG_TRIANGLE(i) + j] = M[i][j] - M_c * L[j] + v * L[i] * L[j];
    }
}

LQG_KALMAN_PLAIN_STATE(plain_state, MAX_NX, 0, MAX_NY);
LQG_KALMAN_UD_STATE(ud_state, MAX_NX, 0, MAX_NY, MAX_NX);

/* Joseph's update has plain's prediction. */
static int loses_P(const design_t *design, int joseph)
{
    const lqg_plant_t plant = {design->nx, 0, design->ny, design->A, NULL, design->C, NULL, NULL};
    const lqg_kalman_plain_t kalman = {plant, NULL,       design->V, design->W, NULL, NULL,
                                       NULL,  design->P0, NULL,      NULL,      NULL};
    const lqg_real y[MAX_NY] = {0};

    lqg_kalman_plain_init(&kalman, &plain_state);
    for (unsigned sample = 0; sample < SAMPLES; sample++) {
        lqg_status_t status = LQG_OK;
        for (unsigned i = 0; joseph && i < design->ny; i++)
            joseph_update(plain_state.P, design->nx, design->C + i * design->nx, design->V[i]);
        if (!joseph)
            status = lqg_kalman_plain_update(&kalman, &plain_state, y);
        if (status || is_lost(plain_state.P, design->nx))
            return 1;
        status = lqg_kalman_plain_predict(&kalman, &plain_state, NULL);
        if (status || is_lost(plain_state.P, design->nx))
            return 1;
    }
    return 0;
}

static int loses_factors(const design_t *design)
{
    const lqg_plant_t plant = {design->nx, 0, design->ny, design->A, NULL, design->C, NULL, NULL};
    const lqg_kalman_ud_t kalman = {plant, NULL, design->V,  design->nw, design->G, design->w, NULL,
                                    NULL,  NULL, design->U0, design->d0, NULL,      NULL,      NULL};
    const lqg_real y[MAX_NY] = {0};

    lqg_kalman_ud_init(&kalman, &ud_state);
    for (unsigned sample = 0; sample < SAMPLES; sample++) {
        lqg_status_t status = lqg_kalman_ud_update(&kalman, &ud_state, y);
        for (unsigned i = 0; i < design->nx; i++)
            if (!(ud_state.d[i] >= 0))
                return 1;
        status |= lqg_kalman_ud_predict(&kalman, &ud_state, NULL);
        for (unsigned i = 0; i < design->nx; i++)
            if (!(ud_state.d[i] >= 0))
                return 1;
        if (status)
            return 1;
    }
    return 0;
}

int main(void)
{
    unsigned long seed = 1;
    unsigned others = 0, factors = 0;

    printf("| of %d filters in %s, lost | plain | Joseph | UD |\n| --- | ---: | ---: | ---: |\n", DESIGNS,
           sizeof(lqg_real) == sizeof(float) ? "float" : "double");
    for (unsigned e = 0; e < ENSEMBLES; e++) {
        unsigned plain = 0, joseph = 0, ud = 0;
        for (unsigned i = 0; i < DESIGNS; i++) {
            design_t design;
            draw_design(&design, &ensembles[e], &seed);
            plain += loses_P(&design, 0) ? 1 : 0;
            joseph += loses_P(&design, 1) ? 1 : 0;
            ud += loses_factors(&design) ? 1 : 0;
        }
        printf("| %s | %u | %u | %u |\n", ensembles[e].name, plain, joseph, ud);
        others += plain + joseph;
        factors += ud;
    }
    return factors == 0 && others > 0 ? 0 : 1;
}
