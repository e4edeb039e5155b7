/* SPDX-License-Identifier: MIT */
/* The library's own estimators, with states, samples and results of the caller's functions of any bits, in
 * any order. */
#include <stddef.h>

#include "unknown.h"
#include "lqg/lqg.h"

enum { NX = 3, NY = 2, NW = 1 };

volatile int any_int;
volatile lqg_real any_real;

static const lqg_real A[9] = {1, 0.1f, 0, 0, 1, 0.1f, 0, 0, 0.9f}, C[6] = {1, 0, 0, 0, 1, 0.5f}, V[2] = {0.1f, 0.2f};
static const lqg_real E[4] = {1, 0, 0.5f, 1}, G[3] = {0, 0, 1}, W[1] = {0.01f}, M[6] = {0, 0, 0.1f, 0, 0, 0.1f};
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

static const lqg_real widen[NY] = {1.5f, 1.5f}, narrow[NY] = {0.75f, 0.75f};
static lqg_gate_t gate = {3, NULL, widen, narrow}; /* of any width */
static const lqg_kalman_ud_t kalman = {
    {NX, 0, NY, A, NULL, C, NULL}, E, V, NW, G, W, M, A, x0, U0, d0, scale, limits, &gate};
static const lqg_ekf_t ekf = {NX, NY, NW, any_f, any_h, NULL, NULL, V, G, W, x0, U0, d0, &gate};
static const lqg_rls_t rls = {NX, 0.9f, 1, x0, d0, limits};

/* The filter has bounds: 16, 64 and 4. */
static void look_at_bounded(const lqg_real x[])
{
    for (unsigned i = 0; i < NX; i++) {
        /*@ check estimate_bounded: -1 < x[i] * scale[i] < 1; */
    }
}

static void call_kalman(lqg_kalman_ud_state_t *state, unsigned long used, const lqg_watch_t *watch)
{
    lqg_real y[NY];
    const unsigned i = any_int ? 1 : 0;
    say_anything(y, NY);
    if (any_int)
        lqg_kalman_ud_partial_update(&kalman, state, y, used, watch);
    else if (any_int)
        lqg_kalman_ud_update_output(&kalman, state, &y[i], i, watch);
    else
        lqg_kalman_ud_predict(&kalman, state, NULL);
    look_at_bounded(state->x);
}

static void call_ekf(lqg_ekf_state_t *state, unsigned long used, const lqg_watch_t *watch)
{
    lqg_real y[NY];
    say_anything(y, NY);
    if (any_int)
        lqg_ekf_partial_update(&ekf, state, y, NULL, used, watch);
    else
        lqg_ekf_predict(&ekf, state, NULL);
}

static void call_rls(lqg_rls_state_t *state)
{
    lqg_real phi[NX];
    say_anything(phi, NX);
    lqg_rls_update(&rls, state, any_real, phi);
}

/* One call, on a state of any bits. */
static void call_any(int which)
{
    lqg_real x[NX], U[LQG_STRICT_TRIANGLE(NX)], d[NX], innovation[NY], widening[NY];
    lqg_real told[NY], S[NY], work[LQG_EKF_WORK(NX, NY, NW)];
    unsigned char heard[NY];
    unsigned long gated[NY] = {0};
    const lqg_watch_t watch = {told, S, heard};
    const unsigned long used = (any_int ? 1ul : 0ul) | (any_int ? 2ul : 0ul);
    lqg_kalman_ud_state_t kalman_state = {x, U, d, NULL, innovation, {widening, gated}, work};
    lqg_ekf_state_t ekf_state = {x, U, d, {widening, gated}, work};
    lqg_rls_state_t rls_state = {x, U, d, work};

    gate.sigma = any_real;
    say_anything(x, NX);
    say_anything(U, LQG_STRICT_TRIANGLE(NX));
    say_anything(d, NX);
    say_anything(widening, NY);
    say_anything(innovation, NY);
    if (which == 0)
        call_kalman(&kalman_state, used, &watch);
    else if (which == 1)
        call_ekf(&ekf_state, used, &watch);
    else
        call_rls(&rls_state);
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
