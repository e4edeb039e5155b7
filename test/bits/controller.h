/* SPDX-License-Identifier: MIT */
/* Every bit of 1000 samples of one controller. To be included by what describe.cmake makes of the controller's header:
 * it says NAME and UPPER_NAME, which of UPDATES, CONTROLS, ADVANCES and REFERS the controller does, whether it
 * HAS_INPUT, and MEMBERS, a HASH_MEMBER(name) for each part of its state. FUNCTION_OF(NAME) becomes the function that
 * runs it. Included once for each controller, all of one REAL. */
#include "samples.h"

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)
#define SIZE(part) JOIN(UPPER_NAME, part)

static hashes_t OF(hash_state)(hashes_t hashes, const OF(t) * self)
{
#define HASH_MEMBER(name) hashes = hash_reals(hashes, self->name, sizeof self->name);
    MEMBERS
#undef HASH_MEMBER
    return hashes;
}

static hashes_t OF(hash_sample)(hashes_t hashes, OF(t) * self, source_t *source)
{
    lqg_status_t status = LQG_OK;
#if defined CONTROLS || defined HAS_INPUT
    REAL u[SIZE(NU)];
#endif

#ifdef REFERS
    draw_all(source, self->r, SIZE(NR));
#endif
#if defined UPDATES || defined ADVANCES
    REAL y[SIZE(NY)];
    draw_all(source, y, SIZE(NY));
    fail_some(source, y, SIZE(NY));
#else
    REAL x[SIZE(NX)];
    draw_all(source, x, SIZE(NX));
#endif
#ifdef UPDATES
    status |= OF(update)(self, y);
    hashes = OF(hash_state)(hashes, self);
#endif
#if defined ADVANCES
    status |= OF(step)(self, y, u);
#elif defined CONTROLS && defined UPDATES
    status |= OF(control)(self, u);
    status |= OF(predict)(self, u);
#elif defined CONTROLS
    status |= OF(control)(self, x, u);
#elif defined HAS_INPUT
    draw_all(source, u, SIZE(NU));
    status |= OF(predict)(self, u);
#else
    status |= OF(predict)(self);
#endif
#ifdef CONTROLS
    hashes = hash_reals(hashes, u, sizeof u);
#endif
    return OF(hash_state)(hash_status(hashes, status), self);
}

hashes_t FUNCTION_OF(NAME)(void);
hashes_t FUNCTION_OF(NAME)(void)
{
    OF(t) self;
    source_t source = {1, 0};
    hashes_t hashes = {NOTHING_HASHED, NOTHING_HASHED};

    OF(init)(&self);
    for (unsigned sample = 0; sample < 1000; sample++) {
        source.halvings = sample / 50;
        hashes = OF(hash_sample)(hashes, &self, &source);
    }
    return hashes;
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
#undef REFERS
#undef HAS_INPUT
#undef PREDICTS
#undef COUNTS_RESETS
