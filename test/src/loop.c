/* SPDX-License-Identifier: MIT */
#include "loop.h"

#include <string.h>

void make_loop(loop_t *loop, const model_t *model, unsigned filter, lqg_form_t form)
{
    memset(loop, 0, sizeof *loop);
    loop->filter = filter;
    loop->model = model;
    prepare_online(model, &loop->online);
    for (unsigned i = 0; i < MAX_NX * MAX_NY; i++)
        loop->gains[i] = 0.25f;
    for (unsigned i = 0; i < MAX_NX; i++)
        loop->K[i] = 0.2f;
    loop->u_min[0] = -1;
    loop->u_max[0] = 1;

    const lqg_lqr_t lqr = {model->nx, model->nu, loop->K, loop->u_min, loop->u_max};
    const lqg_kalman_steady_t kalman = {
        loop->online.plain.plant, loop->gains, loop->online.plain.M, loop->online.x0, NULL, NULL, NULL, NULL};
    loop->steady.kalman = kalman;
    loop->plain.kalman = loop->online.plain;
    loop->ud.kalman = loop->online.ud;
    loop->steady.lqr = loop->plain.lqr = loop->ud.lqr = lqr;
    loop->steady.form = loop->plain.form = loop->ud.form = form;
    loop_init(loop);
}

void loop_init(loop_t *loop)
{
    if (loop->filter == STEADY)
        steady_init(&loop->steady.kalman, &loop->state);
    else if (loop->filter == PLAIN)
        plain_init(&loop->plain.kalman, &loop->state);
    else
        ud_init(&loop->ud.kalman, &loop->state);
}

lqg_status_t loop_update(loop_t *loop, const lqg_real y[])
{
    if (loop->filter == STEADY)
        return steady_update(&loop->steady.kalman, &loop->state, y);
    if (loop->filter == PLAIN)
        return plain_update(&loop->plain.kalman, &loop->state, y);
    return ud_update(&loop->ud.kalman, &loop->state, y);
}

lqg_status_t loop_control(loop_t *loop, lqg_real u[])
{
    const lqg_status_t status = lqg_lqr_control(&loop->steady.lqr, loop->state.x, u);
    memcpy(loop->state.u_applied, u, loop->model->nu * sizeof *u);
    return status;
}

lqg_status_t loop_predict(loop_t *loop, const lqg_real u[])
{
    if (loop->filter == STEADY)
        return steady_predict(&loop->steady.kalman, &loop->state, u);
    if (loop->filter == PLAIN)
        return plain_predict(&loop->plain.kalman, &loop->state, u);
    return ud_predict(&loop->ud.kalman, &loop->state, u);
}

lqg_status_t loop_step(loop_t *loop, const lqg_real y[], lqg_real u[])
{
    lqg_loop_steady_state_t steady = {steady_state(&loop->state), u};
    lqg_loop_plain_state_t plain = {plain_state(&loop->state), u};
    lqg_loop_ud_state_t ud = {ud_state(&loop->state), u};

    if (loop->filter == STEADY)
        return lqg_loop_steady_step(&loop->steady, &steady, y);
    if (loop->filter == PLAIN)
        return lqg_loop_plain_step(&loop->plain, &plain, y);
    return lqg_loop_ud_step(&loop->ud, &ud, y);
}

lqg_status_t loop_partial_update(loop_t *loop, const lqg_real y[], unsigned long used, const lqg_watch_t *watch)
{
    if (loop->filter == STEADY)
        return steady_partial_update(&loop->steady.kalman, &loop->state, y, used, watch);
    if (loop->filter == PLAIN)
        return plain_partial_update(&loop->plain.kalman, &loop->state, y, used, watch);
    return ud_partial_update(&loop->ud.kalman, &loop->state, y, used, watch);
}

void make_running_loop(loop_t *loop, const model_t *model, unsigned filter)
{
    lqg_real y[MAX_NY], u[MAX_NU] = {0};
    double plant[MAX_NX] = {0};
    unsigned long seed = 3;

    make_loop(loop, model, filter, LQG_FILTER_FORM);
    for (unsigned sample = 0; sample < 5; sample++) {
        simulate(model, plant, u, y, &seed);
        loop_step(loop, y, u);
    }
}

int same_state(const state_t *a, const state_t *b)
{
    return memcmp(a->x, b->x, sizeof a->x) == 0 && memcmp(a->P, b->P, sizeof a->P) == 0 &&
           memcmp(a->U, b->U, sizeof a->U) == 0 && memcmp(a->d, b->d, sizeof a->d) == 0 &&
           memcmp(a->u_applied, b->u_applied, sizeof a->u_applied) == 0 &&
           memcmp(a->innovation, b->innovation, sizeof a->innovation) == 0;
}

static int finite_array(const lqg_real values[], unsigned length)
{
    for (unsigned i = 0; i < length; i++)
        if (!(values[i] - values[i] == 0))
            return 0;
    return 1;
}

int all_finite(const state_t *s)
{
    return finite_array(s->x, MAX_NX) && finite_array(s->P, LQG_TRIANGLE(MAX_NX)) &&
           finite_array(s->U, LQG_STRICT_TRIANGLE(MAX_NX)) && finite_array(s->d, MAX_NX) &&
           finite_array(s->u_applied, MAX_NU) && finite_array(s->innovation, MAX_NY);
}
