/* SPDX-License-Identifier: MIT */
/* A hash of every bit that the library computes in 1000 samples of all its filters, in the variant it is
 * compiled in, and of the elementary functions, which are the same in all variants. */
#include "bits.h"

#include "hash.h"
#include "hash_functions.h"
#include "lqg/lqg.h"

enum { NX = 3, NU = 1, NY = 2 };

static const lqg_real A[9] = {0.9f, 0.3f, 0.01f, -0.2f, 0.85f, 0.1f, 0.05f, 0.07f, 0.7f};
static const lqg_real B[3] = {0.1f, 0.7f, 0.3f};
static const lqg_real C[6] = {1.1f, 0.2f, 0.3f, 0, 0.9f, -0.7f};
static const lqg_real D[2] = {0.3f, 0.1f};
static const lqg_real E[4] = {1, 0, -0.37f, 1};
static const lqg_real V[2] = {0.13f, 0.29f};
static const lqg_real W[6] = {0.11f, 0.03f, 0.23f, 0, 0, 0.17f};
static const lqg_real G[6] = {1, 0.1f, 0.3f, 1, 0, 0.7f}, variances[2] = {0.11f, 0.19f};
static const lqg_real M[6] = {0.03f, 0.01f, 0, 0.02f, 0, 0.01f};
static const lqg_real A_free[9] = {0.87f, 0.29f, 0, -0.2f, 0.83f, 0.1f, 0.05f, 0.07f, 0.69f};
static const lqg_real L[6] = {0.4f, 0.1f, 0.2f, 0.3f, -0.1f, 0.15f};
static const lqg_real x0[3] = {0.1f, -0.2f, 0.3f}, P0[6] = {1.1f, 0.2f, 0.9f, 0.1f, 0, 0.7f};
static const lqg_real U0[3] = {0.2f, 0.1f, 0}, d0[3] = {1, 0.9f, 0.7f};
static const lqg_real K[3] = {0.31f, 0.17f, -0.23f}, u_min[1] = {-0.9f}, u_max[1] = {0.9f};

static const lqg_real scale[3] = {1 / 1024.0f, 1 / 4096.0f, 1 / 1024.0f}, limit[2] = {1024, 1024};

#define PLANT {NX, NU, NY, A, B, C, D, NULL}
#define REGULATOR {NX, NU, K, u_min, u_max}
static const lqg_loop_steady_t steady = {{PLANT, L, M, x0, scale, limit, NULL, NULL}, REGULATOR, LQG_FILTER_FORM};
static const lqg_loop_plain_t plain = {
    {PLANT, E, V, W, M, A_free, x0, P0, scale, limit, NULL}, REGULATOR, LQG_FILTER_FORM};
static const lqg_loop_ud_t ud = {
    {PLANT, E, V, 2, G, variances, M, A_free, x0, U0, d0, scale, limit, NULL}, REGULATOR, LQG_PREDICTOR_FORM};

static const lqg_real P_limits[3] = {2, 3, 4};
static const lqg_rls_t rls = {NX, 0.93f, 0.7f, x0, d0, P_limits};

typedef struct {
    lqg_real x[NX], P[LQG_TRIANGLE(NX)], U[LQG_STRICT_TRIANGLE(NX)], d[NX];
    lqg_real u_applied[NU], innovation[NY], u[NU];
} state_t;

LQG_STRICT_BEGIN

/* Uniform in [−1, 1), a multiple of 2⁻¹⁵: exact in either scalar. */
static lqg_real draw(unsigned long *seed)
{
    LQG_STRICT_BODY
    *seed = (*seed * 1664525ul + 1013904223ul) & 0xfffffffful;
    return ((lqg_real)(*seed >> 16) - 32768) / 32768;
}

LQG_STRICT_END

unsigned long long hash_of_all_filters(void)
{
    static state_t s, p, f, e; /* zeros: every byte is hashed */
    lqg_real y[NY], work[LQG_KALMAN_UD_WORK(NX, NY, 2)];
    unsigned long long hash = NOTHING_HASHED;
    unsigned long seed = 1;

    lqg_loop_steady_state_t of_s = {{s.x, s.u_applied, s.innovation, {NULL, NULL}, work}, s.u};
    lqg_loop_plain_state_t of_p = {{p.x, p.P, p.u_applied, p.innovation, {NULL, NULL}, work}, p.u};
    lqg_loop_ud_state_t of_f = {{f.x, f.U, f.d, f.u_applied, f.innovation, {NULL, NULL}, work}, f.u};
    lqg_rls_state_t of_e = {e.x, e.U, e.d, work};

    lqg_loop_steady_init(&steady, &of_s);
    lqg_loop_plain_init(&plain, &of_p);
    lqg_loop_ud_init(&ud, &of_f);
    lqg_rls_init(&rls, &of_e);
    for (unsigned sample = 0; sample < 1000; sample++) {
        y[0] = draw(&seed);
        y[1] = draw(&seed);
        lqg_loop_steady_step(&steady, &of_s, y);
        lqg_loop_plain_step(&plain, &of_p, y);
        lqg_loop_ud_step(&ud, &of_f, y);
        lqg_rls_update(&rls, &of_e, y[0], f.x);
        hash = hash_bytes(hash, &s, sizeof s);
        hash = hash_bytes(hash, &p, sizeof p);
        hash = hash_bytes(hash, &f, sizeof f);
        hash = hash_bytes(hash, &e, sizeof e);
    }
    return hash;
}

unsigned long long hash_of_all_functions(void)
{
    return hash_float_functions();
}

#if LQG_HAS_DOUBLE
unsigned long long hash_of_all_double_functions(void)
{
    return hash_double_functions();
}
#endif
