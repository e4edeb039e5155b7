/* SPDX-License-Identifier: MIT */
/* One controller twice from the same state: NAME_step there, the calls of a sample here. To be included by what
 * describe.cmake of test/bits makes of the controller's header, which says NAME, UPPER_NAME and what the controller
 * does. FUNCTION_OF(NAME) becomes the function that returns how many samples differed. Included once for each
 * controller, all of one REAL. */
#include "hostile.h"

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)
#define SIZE(part) JOIN(UPPER_NAME, part)

result_t FUNCTION_OF(NAME)(void);

#if defined UPDATES || defined ADVANCES

static lqg_status_t OF(make_calls)(OF(t) * self, const REAL y[], REAL u[])
{
#if defined ADVANCES && defined PREDICTS
    lqg_status_t status = OF(control)(self, u);
    return status | OF(advance)(self, y);
#elif defined ADVANCES
    lqg_status_t status = OF(control)(self, y, u);
    return status | OF(advance)(self);
#elif defined CONTROLS && defined PREDICTS
    lqg_status_t status = OF(control)(self, u);
    status |= OF(update)(self, y);
    return status | OF(predict)(self, u);
#elif defined CONTROLS
    lqg_status_t status = OF(update)(self, y);
    status |= OF(control)(self, u);
    return status | OF(predict)(self, u);
#else
    lqg_status_t status = OF(update)(self, y);
#ifdef HAS_INPUT
    return status | OF(predict)(self, u);
#else
    (void)u;
    return status | OF(predict)(self);
#endif
#endif
}

static lqg_status_t OF(make_step)(OF(t) * self, const REAL y[], REAL u[])
{
#if defined CONTROLS || defined HAS_INPUT
    return OF(step)(self, y, u);
#else
    (void)u;
    return OF(step)(self, y);
#endif
}

result_t FUNCTION_OF(NAME)(void)
{
    OF(t) stepped, called;
    REAL y[SIZE(NY)];
#if defined CONTROLS || defined HAS_INPUT
    REAL u_stepped[SIZE(NU)] = {0}, u_called[SIZE(NU)] = {0};
    const int nu = SIZE(NU);
#else
    REAL u_stepped[1] = {0}, u_called[1] = {0};
    const int nu = 1;
#endif
    hostility_t hostility = {1, 0};
    result_t result = {0, 0, 0};

    OF(init)(&stepped);
    for (unsigned sample = 0; sample < HOSTILE_SAMPLES; sample++) {
        begin_sample(&hostility, sample);
        draw_hostile(&hostility, y, SIZE(NY));
#ifdef REFERS
        draw_hostile(&hostility, stepped.r, SIZE(NR));
#endif
#ifndef CONTROLS
        draw_all(&hostility, u_stepped, nu);
        for (int i = 0; i < nu; i++)
            u_called[i] = u_stepped[i];
#endif
        if (flips(&hostility))
            flip(&hostility, &stepped, sizeof stepped);
        called = stepped;
        const lqg_status_t one = OF(make_step)(&stepped, y, u_stepped), other = OF(make_calls)(&called, y, u_called);
        bool same = one == other && same_reals(u_stepped, u_called, nu);
#define HASH_MEMBER(name) same = same && same_bytes(stepped.name, called.name, sizeof stepped.name);
#define COUNTER_MEMBER(name) same = same && same_bytes(&stepped.name, &called.name, sizeof stepped.name);
        MEMBERS COUNTERS
#undef HASH_MEMBER
#undef COUNTER_MEMBER
            result.differences += !same;
        result.seen |= one;
        result.honest += one == LQG_OK;
    }
    return result;
}

#else

/* A regulator alone has one call a sample. */
result_t FUNCTION_OF(NAME)(void)
{
    const result_t none = {0, HOSTILE_SAMPLES, LQG_STATE_RESET};
    return none;
}

#endif

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
#undef REFERS
#undef HAS_INPUT
#undef PREDICTS
#undef COUNTS_RESETS
