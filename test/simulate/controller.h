/* SPDX-License-Identifier: MIT */
/* Reads what record_runs wrote of a controller and runs its compiled header beside it. Included once for each
 * controller, which ../bits/describe.cmake describes by macros. */
#include "replay.h"

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)
#define SIZE(part) JOIN(UPPER_NAME, part)

/* What firmware reads: x̂, which a filter that keeps z makes of it. */
#ifdef ESTIMATES
#define READ_ESTIMATE(self, x) OF(estimate)(self, x)
#else
#define READ_ESTIMATE(self, x) memcpy(x, self->x, sizeof x)
#endif

static int OF(replay_sample)(OF(t) * self, FILE *file)
{
    lqg_status_t status = LQG_OK;
    REAL x[SIZE(NX)], expected_x[SIZE(NX)];
#ifdef HAS_INPUT
    REAL u[SIZE(NU)], expected_u[SIZE(NU)];
#endif
#if defined UPDATES || defined ADVANCES
    REAL y[SIZE(NY)];
#endif

#ifdef REFERS
    READ(file, self->r);
#endif
#if defined UPDATES || defined ADVANCES
    READ(file, y);
#else
    READ(file, x);
#endif
#ifdef HAS_INPUT
    READ(file, expected_u);
    memcpy(u, expected_u, sizeof u);
#endif
    READ(file, expected_x);

#if defined ADVANCES && defined PREDICTS
    status |= OF(control)(self, u);
    OF(estimate)(self, x);
    status |= OF(advance)(self, y);
#elif defined ADVANCES
    status |= OF(control)(self, y, u);
    OF(estimate)(self, x);
    status |= OF(advance)(self);
#elif defined UPDATES && defined CONTROLS && defined PREDICTS
    READ_ESTIMATE(self, x);
    status |= OF(control)(self, u);
    status |= OF(update)(self, y);
    status |= OF(predict)(self, u);
#elif defined UPDATES
#ifdef PREDICTS
    READ_ESTIMATE(self, x);
#endif
    status |= OF(update)(self, y);
#ifndef PREDICTS
    READ_ESTIMATE(self, x);
#endif
#ifdef CONTROLS
    status |= OF(control)(self, u);
#endif
#ifdef HAS_INPUT
    status |= OF(predict)(self, u);
#else
    status |= OF(predict)(self);
#endif
#else
    status |= OF(control)(self, x, u);
#endif
#ifdef HAS_INPUT
    if (!ARE_EQUAL(u, expected_u))
        return 0;
#endif
    return ARE_EQUAL(x, expected_x) && (double)status == read_number(file);
}

static int OF(replay_run)(int run, FILE *file)
{
    const int samples = (int)read_number(file);
    OF(t) self;

    OF(init)(&self);
    for (int k = 0; k < samples; k++)
        if (!OF(replay_sample)(&self, file)) {
            printf("run %d, sample %d: the simulation shows something else than the compiled header\n", run, k);
            return 0;
        }
    const double resets = read_number(file);
#ifdef COUNTS_RESETS
    if ((double)self.resets != resets) {
        printf("run %d: %g resets in the simulation, %lu in the compiled header\n", run, resets, self.resets);
        return 0;
    }
#endif
    return samples > 0 && resets >= 0;
}

/* 0: in every sample of the file the compiled header gives what the simulation has shown. */
int FUNCTION_OF(NAME)(FILE *file);
int FUNCTION_OF(NAME)(FILE *file)
{
    const int runs = (int)read_number(file);

    for (int run = 1; run <= runs; run++)
        if (!OF(replay_run)(run, file))
            return 1;
    return runs > 0 ? 0 : 1;
}

#undef PASTE
#undef JOIN
#undef OF
#undef SIZE
#undef NAME
#undef UPPER_NAME
#undef MEMBERS
#undef COUNTERS
#undef UPDATES
#undef CONTROLS
#undef ADVANCES
#undef ESTIMATES
#undef READ_ESTIMATE
#undef REFERS
#undef HAS_INPUT
#undef PREDICTS
#undef COUNTS_RESETS
