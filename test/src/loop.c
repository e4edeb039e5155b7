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
    const lqg_kalman_steady_t kalman = {loop->online.plain.plant, loop->gains, loop->online.plain.M,
                                        loop->online.x0, NULL, NULL};
    loop->steady.kalman = kalman;
    loop->plain.kalman = loop->online.plain;
    loop->ud.kalman = loop->online.ud;
    loop->steady.lqr = loop->plain.lqr = loop->ud.lqr = lqr;
    loop->steady.form = loop->plain.form = loop->ud.form = form;
    loop_init(loop);
}

void loop_init(loop_t *loop)
{
    state_t *s = &loop->state;
    if (loop->filter == STEADY)
        lqg_kalman_steady_init(&loop->steady.kalman, s->x, s->u_applied, s->innovation);
    else if (loop->filter == PLAIN)
        lqg_kalman_plain_init(&loop->plain.kalman, s->x, s->P, s->u_applied, s->innovation);
    else
        lqg_kalman_ud_init(&loop->ud.kalman, s->x, s->U, s->d, s->u_applied, s->innovation);
}

lqg_status loop_update(loop_t *loop, const lqg_real y[])
{
    state_t *s = &loop->state;
    if (loop->filter == STEADY)
        return lqg_kalman_steady_update(&loop->steady.kalman, s->x, s->u_applied, s->innovation, y, s->work);
    if (loop->filter == PLAIN)
        return lqg_kalman_plain_update(&loop->plain.kalman, s->x, s->P, s->u_applied, s->innovation, y,
                                       s->work);
    return lqg_kalman_ud_update(&loop->ud.kalman, s->x, s->U, s->d, s->u_applied, s->innovation, y, s->work);
}

lqg_status loop_control(loop_t *loop, lqg_real u[])
{
    const lqg_status status = lqg_lqr_control(&loop->steady.lqr, loop->state.x, u);
    memcpy(loop->state.u_applied, u, loop->model->nu * sizeof *u);
    return status;
}

lqg_status loop_predict(loop_t *loop, const lqg_real u[])
{
    state_t *s = &loop->state;
    if (loop->filter == STEADY)
        return lqg_kalman_steady_predict(&loop->steady.kalman, s->x, s->u_applied, s->innovation, u, s->work);
    if (loop->filter == PLAIN)
        return lqg_kalman_plain_predict(&loop->plain.kalman, s->x, s->P, s->u_applied, s->innovation, u,
                                        s->work);
    return lqg_kalman_ud_predict(&loop->ud.kalman, s->x, s->U, s->d, s->u_applied, s->innovation, u, s->work);
}

lqg_status loop_step(loop_t *loop, const lqg_real y[], lqg_real u[])
{
    state_t *s = &loop->state;
    if (loop->filter == STEADY)
        return lqg_lqg_steady_step(&loop->steady, s->x, s->u_applied, s->innovation, y, u, s->work);
    if (loop->filter == PLAIN)
        return lqg_lqg_plain_step(&loop->plain, s->x, s->P, s->u_applied, s->innovation, y, u, s->work);
    return lqg_lqg_ud_step(&loop->ud, s->x, s->U, s->d, s->u_applied, s->innovation, y, u, s->work);
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
