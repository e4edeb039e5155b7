/* SPDX-License-Identifier: MIT */
/* Any filter's state as arrays that a test can compare and copy, and the library's calls over them. */
#ifndef TEST_STATES_H
#define TEST_STATES_H

#include "lqg/lqg.h"

enum { MAX_NX = 4, MAX_NU = 1, MAX_NY = 2 };

/* What a status says of an output that is rejected. */
#define REJECTED(i) (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(i))

/* The state of any of the filters, and scratch for all of them. */
typedef struct {
    lqg_real x[MAX_NX], P[LQG_TRIANGLE(MAX_NX)], U[LQG_STRICT_TRIANGLE(MAX_NX)], d[MAX_NX];
    lqg_real u_applied[MAX_NU], innovation[MAX_NY], widening[MAX_NY];
    unsigned long gated[MAX_NY];
    lqg_real work[LQG_KALMAN_UD_WORK(MAX_NX, MAX_NY, MAX_NX)];
} state_t;

static inline lqg_kalman_steady_state_t steady_state(state_t *s)
{
    const lqg_kalman_steady_state_t state = {s->x, s->u_applied, s->innovation, {s->widening, s->gated}, s->work};
    return state;
}

static inline lqg_kalman_plain_state_t plain_state(state_t *s)
{
    const lqg_kalman_plain_state_t state = {s->x, s->P, s->u_applied, s->innovation, {s->widening, s->gated}, s->work};
    return state;
}

static inline lqg_kalman_ud_state_t ud_state(state_t *s)
{
    const lqg_kalman_ud_state_t state = {s->x,   s->U, s->d, s->u_applied, s->innovation, {s->widening, s->gated},
                                         s->work};
    return state;
}

static inline void steady_init(const lqg_kalman_steady_t *kalman, state_t *s)
{
    lqg_kalman_steady_state_t state = steady_state(s);
    lqg_kalman_steady_init(kalman, &state);
}

static inline lqg_status_t steady_update(const lqg_kalman_steady_t *kalman, state_t *s, const lqg_real y[])
{
    lqg_kalman_steady_state_t state = steady_state(s);
    return lqg_kalman_steady_update(kalman, &state, y);
}

static inline lqg_status_t steady_partial_update(const lqg_kalman_steady_t *kalman, state_t *s, const lqg_real y[],
                                                 unsigned long used, const lqg_watch_t *watch)
{
    lqg_kalman_steady_state_t state = steady_state(s);
    return lqg_kalman_steady_partial_update(kalman, &state, y, used, watch);
}

static inline lqg_status_t steady_update_output(const lqg_kalman_steady_t *kalman, state_t *s, lqg_real y_i, unsigned i,
                                                const lqg_watch_t *watch)
{
    lqg_kalman_steady_state_t state = steady_state(s);
    return lqg_kalman_steady_update_output(kalman, &state, &y_i, i, watch);
}

static inline lqg_status_t steady_predict(const lqg_kalman_steady_t *kalman, state_t *s, const lqg_real u[])
{
    lqg_kalman_steady_state_t state = steady_state(s);
    return lqg_kalman_steady_predict(kalman, &state, u);
}

static inline void plain_init(const lqg_kalman_plain_t *kalman, state_t *s)
{
    lqg_kalman_plain_state_t state = plain_state(s);
    lqg_kalman_plain_init(kalman, &state);
}

static inline lqg_status_t plain_update(const lqg_kalman_plain_t *kalman, state_t *s, const lqg_real y[])
{
    lqg_kalman_plain_state_t state = plain_state(s);
    return lqg_kalman_plain_update(kalman, &state, y);
}

static inline lqg_status_t plain_partial_update(const lqg_kalman_plain_t *kalman, state_t *s, const lqg_real y[],
                                                unsigned long used, const lqg_watch_t *watch)
{
    lqg_kalman_plain_state_t state = plain_state(s);
    return lqg_kalman_plain_partial_update(kalman, &state, y, used, watch);
}

static inline lqg_status_t plain_update_output(const lqg_kalman_plain_t *kalman, state_t *s, lqg_real y_i, unsigned i,
                                               const lqg_watch_t *watch)
{
    lqg_kalman_plain_state_t state = plain_state(s);
    return lqg_kalman_plain_update_output(kalman, &state, &y_i, i, watch);
}

static inline lqg_status_t plain_predict(const lqg_kalman_plain_t *kalman, state_t *s, const lqg_real u[])
{
    lqg_kalman_plain_state_t state = plain_state(s);
    return lqg_kalman_plain_predict(kalman, &state, u);
}

static inline void ud_init(const lqg_kalman_ud_t *kalman, state_t *s)
{
    lqg_kalman_ud_state_t state = ud_state(s);
    lqg_kalman_ud_init(kalman, &state);
}

static inline lqg_status_t ud_update(const lqg_kalman_ud_t *kalman, state_t *s, const lqg_real y[])
{
    lqg_kalman_ud_state_t state = ud_state(s);
    return lqg_kalman_ud_update(kalman, &state, y);
}

static inline lqg_status_t ud_partial_update(const lqg_kalman_ud_t *kalman, state_t *s, const lqg_real y[],
                                             unsigned long used, const lqg_watch_t *watch)
{
    lqg_kalman_ud_state_t state = ud_state(s);
    return lqg_kalman_ud_partial_update(kalman, &state, y, used, watch);
}

static inline lqg_status_t ud_update_output(const lqg_kalman_ud_t *kalman, state_t *s, lqg_real y_i, unsigned i,
                                            const lqg_watch_t *watch)
{
    lqg_kalman_ud_state_t state = ud_state(s);
    return lqg_kalman_ud_update_output(kalman, &state, &y_i, i, watch);
}

static inline lqg_status_t ud_predict(const lqg_kalman_ud_t *kalman, state_t *s, const lqg_real u[])
{
    lqg_kalman_ud_state_t state = ud_state(s);
    return lqg_kalman_ud_predict(kalman, &state, u);
}

#endif
