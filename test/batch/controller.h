/* SPDX-License-Identifier: MIT */
/* One controller in many lanes, and each lane by itself: NAME_batch_step there, NAME_step here. To be included by what
 * describe.cmake of test/bits makes of the controller's header. FUNCTION_OF(NAME) becomes the function that returns how
 * many samples of a lane differed. Included once for each controller, all of one REAL. */
#include "hostile.h"
#ifdef BATCH_HEADER
#include BATCH_HEADER
#endif

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)
#define SIZE(part) JOIN(UPPER_NAME, part)
#define LANES SIZE(BATCH_LANES)

result_t FUNCTION_OF(NAME)(void);

#ifdef BATCH_HEADER

result_t FUNCTION_OF(NAME)(void)
{
    static OF(batch_t) batch;
    static OF(t) alone[LANES];
    static hostility_t hostilities[LANES];
    REAL y[SIZE(NY)][LANES], y_alone[SIZE(NY)];
#if defined CONTROLS || defined HAS_INPUT
    REAL u[SIZE(NU)][LANES] = {{0}}, u_alone[SIZE(NU)] = {0};
#endif
#ifdef REFERS
    REAL r[SIZE(NR)];
#endif
    lqg_status_t status[LANES];
    OF(t) got;
    result_t result = {0, 0, 0};

    OF(batch_init)(&batch);
    for (int lane = 0; lane < LANES; lane++) {
        OF(init)(&alone[lane]);
        hostilities[lane].seed = 1u + (unsigned)lane;
    }
    for (unsigned sample = 0; sample < HOSTILE_SAMPLES / LANES; sample++) {
        for (int lane = 0; lane < LANES; lane++) {
            hostility_t *const hostility = &hostilities[lane];

            begin_sample(hostility, sample);
            draw_hostile(hostility, y_alone, SIZE(NY));
            for (int i = 0; i < SIZE(NY); i++)
                y[i][lane] = y_alone[i];
#ifdef REFERS
            draw_hostile(hostility, r, SIZE(NR));
            for (int i = 0; i < SIZE(NR); i++)
                batch.r[i][lane] = alone[lane].r[i] = r[i];
#endif
#if !defined CONTROLS && defined HAS_INPUT
            draw_all(hostility, u_alone, SIZE(NU));
            for (int i = 0; i < SIZE(NU); i++)
                u[i][lane] = u_alone[i];
#endif
            if (sample % 8 == 0 && flips(hostility)) {
                flip(hostility, &alone[lane], sizeof alone[lane]);
                OF(batch_set)(&batch, lane, &alone[lane]);
            }
        }
#if defined CONTROLS || defined HAS_INPUT
        OF(batch_step)(&batch, y, u, status);
#else
        OF(batch_step)(&batch, y, status);
#endif
        for (int lane = 0; lane < LANES; lane++) {
            lqg_status_t expected;
            bool same = true;

            for (int i = 0; i < SIZE(NY); i++)
                y_alone[i] = y[i][lane];
#if defined CONTROLS || defined HAS_INPUT
            for (int i = 0; i < SIZE(NU); i++)
                u_alone[i] = u[i][lane];
            expected = OF(step)(&alone[lane], y_alone, u_alone);
            for (int i = 0; i < SIZE(NU); i++)
                same = same && same_bytes(&u_alone[i], &u[i][lane], sizeof u_alone[i]);
#else
            expected = OF(step)(&alone[lane], y_alone);
#endif
            OF(batch_get)(&batch, lane, &got);
#define HASH_MEMBER(name) same = same && same_bytes(got.name, alone[lane].name, sizeof got.name);
#define COUNTER_MEMBER(name) same = same && same_bytes(&got.name, &alone[lane].name, sizeof got.name);
            MEMBERS COUNTERS
#undef HASH_MEMBER
#undef COUNTER_MEMBER
                result.differences += !(same && status[lane] == expected);
            result.seen |= expected;
            result.honest += expected == LQG_OK;
        }
    }
    return result;
}

#else

/* A regulator alone has no batch. */
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
#undef LANES
#undef BATCH_HEADER
#undef NAME
#undef UPPER_NAME
#undef MEMBERS
#undef COUNTERS
#undef UPDATES
#undef CONTROLS
#undef ADVANCES
#undef REFERS
#undef HAS_INPUT
#undef PREDICTS
#undef COUNTS_RESETS
