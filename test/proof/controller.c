/* SPDX-License-Identifier: MIT */
/* A controller, called in any order, for ever, with anything: "calls.h" is made of its header by calls.awk. */
#include "anything.h"

#if defined PROOF_KEEPS_x || defined PROOF_BOUNDS
enum { NX = SIZE(NX) };
#endif
/* The estimate, or z of it that a filter keeps in its place, within bounds as well. */
#if defined PROOF_BOUNDS && defined PROOF_KEEPS_z
#define KEPT z
static const lqg_real bound[NX] = SIZE(Z_BOUNDS);
#elif defined PROOF_BOUNDS
#define KEPT x
static const lqg_real bound[NX] = SIZE(X_BOUNDS);
#endif

/* More than what init leaves: any estimate within its bounds, any number of resets. So the prover need not find out
 * step by step how far they get. */
static void begin_anywhere(LOOP)
{
#ifdef PROOF_BOUNDS
    for (int i = 0; i < NX; i++) {
        const lqg_real anywhere = any_real;
        if (!BELOW(anywhere, bound[i]))
            stop();
        loop->KEPT[i] = anywhere;
    }
#endif
#ifdef PROOF_KEEPS_resets
    loop->resets = any_count;
#endif
#ifdef PROOF_KEEPS_covariance_resets
    loop->covariance_resets = any_count;
#endif
    (void)loop;
}

static void look_at_state(LOOP)
{
#if defined PROOF_BOUNDS
    for (int i = 0; i < NX; i++) {
        /*@ check state_bounded: -bound[i] < loop->KEPT[i] < bound[i]; */
    }
#elif defined PROOF_KEEPS_x
    for (int i = 0; i < NX; i++) {
        /*@ check state_finite: \is_finite(loop->x[i]); */
    }
#endif
#if defined PROOF_KEEPS_z && !defined PROOF_BOUNDS
    for (int i = 0; i < SIZE(NZ); i++) {
        /*@ check state_finite: \is_finite(loop->z[i]); */
    }
#endif
    (void)loop;
}

/* After a prediction: an update's own result is looked at then. */
#if defined PROOF_BOUNDS && (defined PROOF_KEEPS_P || defined PROOF_KEEPS_d)
static void look_at_covariance(LOOP)
{
#ifdef PROOF_KEEPS_P
    for (int i = 0; i < NX; i++) {
        /*@ check covariance_bounded: \abs(loop->P[i * (i + 1) / 2 + i]) < bound[i] * bound[i]; */
    }
#endif
#ifdef PROOF_KEEPS_d
    for (int i = 0; i < NX; i++) {
        /*@ check covariance_bounded: \abs(loop->d[i]) < bound[i] * bound[i]; */
    }
#endif
#ifdef PROOF_KEEPS_U
    for (int i = 0; i < NX * (NX - 1) / 2; i++) {
        /*@ check factors_finite: \is_finite(loop->U[i]); */
    }
#endif
}
#define LOOK_AT_COVARIANCE(loop) look_at_covariance(loop)
#else
#define LOOK_AT_COVARIANCE(loop) (void)(loop)
#endif

#ifdef PROOF_GIVES_INPUT
static void look_at_input(const lqg_real u[])
{
#ifdef PROOF_U_MIN
    const double low[] = PROOF_U_MIN, high[] = PROOF_U_MAX;
#endif
    for (int i = 0; i < SIZE(NU); i++) {
        /*@ check input_finite: \is_finite(u[i]); */
#ifdef PROOF_U_MIN
        /*@ check input_limited: low[i] <= u[i] <= high[i]; */
#endif
    }
}
#endif

#include "calls.h"

int main(void)
{
#ifdef PROOF_HAS_LOOP
    OF(t) state, *const loop = &state;

    OF(init)(loop);
#else
    void *const loop = 0;
#endif
    look_at_state(loop);
    begin_anywhere(loop);
    /* Not unrolled: one state stands for all that come back. */
#ifdef PROOF_LAST_ROWS
    /*@ loop unroll 1; loop widen_hints "all", PROOF_LAST_ROWS; */
#else
    /*@ loop unroll 1; */
#endif
    while (any_int) {
#ifdef PROOF_KEEPS_r
        say_anything(loop->r, SIZE(NR));
#endif
        call_any(loop);
        /*@ slevel merge; */;
        look_at_state(loop);
    }
    return 0;
}
