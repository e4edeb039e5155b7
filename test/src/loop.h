/* SPDX-License-Identifier: MIT */
/* The three filters behind one face, with a regulator, so that a test can be made of all of them. */
#ifndef TEST_LOOP_H
#define TEST_LOOP_H

#include "model.h"

enum { STEADY, PLAIN, UD, FILTERS };

/* One closed loop. The descriptions point into `online` and `gains`: not to be copied, but its state may be.
 * */
typedef struct {
    unsigned filter;
    const model_t *model;
    online_t online;
    lqg_real gains[MAX_NX * MAX_NY], K[MAX_NU * MAX_NX], u_min[MAX_NU], u_max[MAX_NU];
    lqg_loop_steady_t steady;
    lqg_loop_plain_t plain;
    lqg_loop_ud_t ud;
    state_t state;
} loop_t;

/* A regulator with K = [0.2 0.2 …] and |u| ≤ 1; the steady filter has gains of 0.25. Everything not begun is
 * 0. */
void make_loop(loop_t *loop, const model_t *model, unsigned filter, lqg_form_t form);

void loop_init(loop_t *loop);
lqg_status_t loop_update(loop_t *loop, const lqg_real y[]);
lqg_status_t loop_control(loop_t *loop, lqg_real u[]);
lqg_status_t loop_predict(loop_t *loop, const lqg_real u[]);
lqg_status_t loop_step(loop_t *loop, const lqg_real y[], lqg_real u[]);

/* `used` and `watch` as the library's. */
lqg_status_t loop_partial_update(loop_t *loop, const lqg_real y[], unsigned long used, const lqg_watch_t *watch);

/* make_loop, and some samples. */
void make_running_loop(loop_t *loop, const model_t *model, unsigned filter);

/* The state alone is the same, to the bit; scratch is not looked at. */
int same_state(const state_t *a, const state_t *b);

int all_finite(const state_t *state);

#endif
