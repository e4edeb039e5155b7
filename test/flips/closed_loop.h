/* SPDX-License-Identifier: MIT */
/* A controller in closed loop with its plant, sample by sample. plant.h, which closed_loop.py writes, has both. */
#ifndef LQG_TEST_CLOSED_LOOP_H
#define LQG_TEST_CLOSED_LOOP_H

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "lqg/status.h"

struct member {
    const char *name;
    size_t offset, size, each;
    int is_real;
};

#include "plant.h"

struct loop {
    OF(t) controller;
    double x[NX];
    real u[NU + 1]; /* that acts */
};

/* At the start, with the plant at its operating point. */
static void begin_loop(struct loop *loop)
{
    memset(loop, 0, sizeof *loop);
    OF(init)(&loop->controller);
    for (int j = 0; j < NU; j++)
        loop->u[j] = (real)u_point[j];
}

/* What is drawn for a sample: of G w and v, and u of an estimator alone. */
struct drawn {
    double noise[NX + NY], u[NU + 1];
};

/* Of numbers of variance 1 what has the covariance of G w and v. */
static void colour(struct drawn *now, const double white[NX + NY])
{
    for (int i = 0; i < NX + NY; i++) {
        now->noise[i] = 0;
        for (int j = 0; j <= i; j++)
            now->noise[i] += factor[i * (NX + NY) + j] * white[j];
    }
}

static void measure(const struct loop *loop, const struct drawn *now, real y[NY])
{
    for (int i = 0; i < NY; i++) {
        double sum = now->noise[NX + i];
        for (int j = 0; j < NX; j++)
            sum += C[i * NX + j] * loop->x[j];
        for (int j = 0; j < NU; j++)
            sum += D[i * NU + j] * ((double)loop->u[j] - u_point[j]);
        y[i] = (real)(y_point[i] + sum);
    }
}

static void advance_plant(struct loop *loop, const struct drawn *now)
{
    double next[NX];
    for (int i = 0; i < NX; i++) {
        next[i] = now->noise[i];
        for (int j = 0; j < NX; j++)
            next[i] += A[i * NX + j] * loop->x[j];
        for (int j = 0; j < NU; j++)
            next[i] += B[i * NU + j] * ((double)loop->u[j] - u_point[j]);
    }
    memcpy(loop->x, next, sizeof next);
}

/* Who is asked before the first call of a sample, phase 0, and behind the first and the second one, 1 and 2. */
struct visitor {
    void (*visit)(struct loop *loop, int phase, const void *of);
    const void *of;
};

static void visit(struct loop *loop, int phase, struct visitor visitor)
{
    if (visitor.visit)
        visitor.visit(loop, phase, visitor.of);
}

#if !defined KEEPS_Z || defined IS_PREDICTOR
static lqg_status_t choose_input(struct loop *loop, const struct drawn *now)
{
#ifdef HAS_REGULATOR
    (void)now;
    return OF(control)(&loop->controller, loop->u);
#else
    for (int j = 0; j < NU; j++)
        loop->u[j] = (real)(u_point[j] + now->u[j]);
    return LQG_OK;
#endif
}
#endif

/* Filter form: y is sampled while the last u acts; predictor form: while the new one does. */
#ifdef KEEPS_Z
static lqg_status_t run_controller(struct loop *loop, const struct drawn *now, struct visitor visitor)
{
    lqg_status_t status = LQG_OK;
    real y[NY];
    visit(loop, 0, visitor);
#ifdef IS_PREDICTOR
    status |= choose_input(loop, now);
    visit(loop, 1, visitor);
    visit(loop, 2, visitor);
    measure(loop, now, y);
    status |= OF(advance)(&loop->controller, y);
#else
    measure(loop, now, y);
    status |= OF(control)(&loop->controller, y, loop->u);
    visit(loop, 1, visitor);
    visit(loop, 2, visitor);
    status |= OF(advance)(&loop->controller);
#endif
    return status;
}
#else
static lqg_status_t run_controller(struct loop *loop, const struct drawn *now, struct visitor visitor)
{
    lqg_status_t status = LQG_OK;
    real y[NY];
    visit(loop, 0, visitor);
#ifdef IS_PREDICTOR
    status |= choose_input(loop, now);
    visit(loop, 1, visitor);
#endif
    measure(loop, now, y);
    status |= OF(update)(&loop->controller, y);
#ifdef IS_PREDICTOR
    visit(loop, 2, visitor);
#else
    visit(loop, 1, visitor);
    status |= choose_input(loop, now);
    visit(loop, 2, visitor);
#endif
#ifdef HAS_INPUT
    status |= OF(predict)(&loop->controller, loop->u);
#else
    status |= OF(predict)(&loop->controller);
#endif
    return status;
}
#endif

/* The status is that of all calls together. */
static lqg_status_t run_sample(struct loop *loop, const struct drawn *now, struct visitor visitor)
{
    const lqg_status_t status = run_controller(loop, now, visitor);
    advance_plant(loop, now);
    return status;
}

/* |w · x| of an unstable mode, wᵀA = λ wᵀ, grows by |λ| a sample, and all that u can do against it within its limits is
 * less. */
static int is_beyond_u(const struct loop *loop)
{
    for (int m = 0; m < MODES; m++) {
        const double *re = &mode_re[m * NX], *im = &mode_im[m * NX];
        double x_re = 0, x_im = 0, against = 0;
        for (int i = 0; i < NX; i++) {
            x_re += re[i] * loop->x[i];
            x_im += im[i] * loop->x[i];
        }
        for (int j = 0; j < NU; j++) {
            double u_re = 0, u_im = 0;
            for (int i = 0; i < NX; i++) {
                u_re += re[i] * B[i * NU + j];
                u_im += im[i] * B[i * NU + j];
            }
            against += hypot(u_re, u_im) * fmax(fabs(u_min[j] - u_point[j]), fabs(u_max[j] - u_point[j]));
        }
        if ((mode_size[m] - 1) * hypot(x_re, x_im) > against)
            return 1;
    }
    return 0;
}

#endif
