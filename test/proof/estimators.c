/* SPDX-License-Identifier: MIT */
/* The library's own estimators, with states, samples and results of the caller's functions of any bits, in
 * any order. */
#include <stddef.h>

#include "unknown.h"
#include "lqg/lqg.h"

enum { NX = 3, NY = 2, NQ = 1 };

volatile int any_int;
volatile lqg_real any_real;

static const lqg_real A[9] = {1, 0.1f, 0, 0, 1, 0.1f, 0, 0, 0.9f}, C[6] = {1, 0, 0, 0, 1, 0.5f},
                      V[2] = {0.1f, 0.2f};
static const lqg_real E[4] = {1, 0, 0.5f, 1}, G[3] = {0, 0, 1}, w[1] = {0.01f},
                      M[6] = {0, 0, 0.1f, 0, 0, 0.1f};
static const lqg_real x0[3] = {1, 2, 3}, d0[3] = {1, 1, 1}, U0[3] = {0}, limits[3] = {10, 10, 10},
                      scale[3] = {1 / 16.0f, 1 / 64.0f, 0.25f};

static void say_anything(lqg_real v[], unsigned length)
{
    for (unsigned i = 0; i < length; i++)
        v[i] = any_real;
}

static void look_at(const lqg_real x[])
{
    for (unsigned i = 0; i < NX; i++) {
        /*@ check estimate_finite: \is_finite(x[i]); */
    }
}

static void any_f(void *context, lqg_real next[], lqg_real jacobian[], const lqg_real x[], const lqg_real u[])
{
    (void)context, (void)x, (void)u;
    say_anything(next, NX);
    say_anything(jacobian, NX * NX);
}

static void any_h(void *context, lqg_real y[], lqg_real jacobian[], const lqg_real x[], const lqg_real u[])
{
    (void)context, (void)x, (void)u;
    say_anything(y, NY);
    say_anything(jacobian, NY * NX);
}

static const lqg_kalman_ud_t kalman = {{NX, 0, NY, A, NULL, C, NULL}, E, V, NQ, G, w, M, A, x0, U0, d0, scale, limits};
static const lqg_ekf_t ekf = {NX, NY, NQ, any_f, any_h, NULL, NULL, V, G, w, x0, U0, d0};
static const lqg_rls_t rls = {NX, 0.9f, 1, x0, d0, limits};

/* The filter has bounds: 16, 64 and 4. */
static void look_at_bounded(const lqg_real x[])
{
    for (unsigned i = 0; i < NX; i++) {
        /*@ check estimate_bounded: -1 < x[i] * scale[i] < 1; */
    }
}

static void call_kalman(lqg_real x[], lqg_real U[], lqg_real d[], lqg_real innovation[],
                        const lqg_watch_t *watch)
{
    lqg_real y[NY], work[LQG_KALMAN_UD_WORK(NX, NY, NQ)];
    const unsigned i = any_int ? 1 : 0;
    say_anything(y, NY);
    if (any_int)
        lqg_kalman_ud_update_watched(&kalman, x, U, d, NULL, innovation, y, watch, work);
    else if (any_int)
        lqg_kalman_ud_update_output(&kalman, x, U, d, NULL, innovation, i, y[i], watch, work);
    else
        lqg_kalman_ud_predict(&kalman, x, U, d, NULL, innovation, NULL, work);
    look_at_bounded(x);
}

static void call_ekf(lqg_real x[], lqg_real U[], lqg_real d[], const lqg_watch_t *watch)
{
    lqg_real y[NY], work[LQG_EKF_WORK(NX, NY, NQ)];
    say_anything(y, NY);
    if (any_int)
        lqg_ekf_update(&ekf, x, U, d, y, NULL, watch, work);
    else
        lqg_ekf_predict(&ekf, x, U, d, NULL, work);
}

static void call_rls(lqg_real theta[], lqg_real U[], lqg_real d[])
{
    lqg_real phi[NX], work[LQG_RLS_WORK(NX)];
    say_anything(phi, NX);
    lqg_rls_update(&rls, theta, U, d, phi, any_real, work);
}

/* One call, on a state of any bits. */
static void call_any(int which)
{
    static const lqg_real widen[NY] = {1.5f, 1.5f}, narrow[NY] = {0.75f, 0.75f};
    lqg_real x[NX], U[LQG_KALMAN_UD_U(NX)], d[NX], innovation[NY], nu[NY], s[NY], widening[NY];
    unsigned char used[NY];
    unsigned long gated[NY] = {0};
    const lqg_watch_t watch = {used, any_real, gated, nu, s, widening, widen, narrow, NULL};

    say_anything(x, NX);
    say_anything(U, LQG_KALMAN_UD_U(NX));
    say_anything(d, NX);
    say_anything(widening, NY);
    say_anything(innovation, NY);
    for (unsigned i = 0; i < NY; i++)
        used[i] = (unsigned char)any_int;
    if (which == 0)
        call_kalman(x, U, d, innovation, &watch);
    else if (which == 1)
        call_ekf(x, U, d, &watch);
    else
        call_rls(x, U, d);
    look_at(x);
}

/* As each state is any, one call of each stands for all sequences of calls. */
int main(void)
{
    call_any(0);
    call_any(1);
    call_any(2);
    return 0;
}
