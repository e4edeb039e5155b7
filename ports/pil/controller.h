/* SPDX-License-Identifier: MIT */
/* The controller that target and host both run. The build says which (design.cmake): CONTROLLER_HEADER, CONTROLLER and
 * CONTROLLER_IN_CAPITALS are "two_mass.h", two_mass and TWO_MASS. Its `real` is float, and it has a filter and a
 * regulator. */
#ifndef PIL_CONTROLLER_H
#define PIL_CONTROLLER_H

#include <math.h>
#include <stddef.h>

#include "lqg/arithmetic.h"
#include "lqg/status.h"
#include "lqg/version.h"

/* On a machine of 64 bits an odd number of floats had padding behind it, of no stated bits. */
#pragma pack(push, 4)
#include CONTROLLER_HEADER
#pragma pack(pop)

#define CONTROLLER_JOIN_NOW(a, b) a##b
#define CONTROLLER_JOIN(a, b) CONTROLLER_JOIN_NOW(a, b)
#define CONTROLLER_OF(name) CONTROLLER_JOIN(CONTROLLER, name)
#define CONTROLLER_CONSTANT(name) CONTROLLER_JOIN(CONTROLLER_IN_CAPITALS, name)
#define CONTROLLER_TEXT_NOW(name) #name
#define CONTROLLER_TEXT(name) CONTROLLER_TEXT_NOW(name)

enum {
    CONTROLLER_NX = CONTROLLER_CONSTANT(_NX),
    CONTROLLER_NU = CONTROLLER_CONSTANT(_NU),
    CONTROLLER_NY = CONTROLLER_CONSTANT(_NY)
};

/* It begins with its floats, whose bits the CRC is of; the count of resets behind them is wider on some targets. */
typedef CONTROLLER_OF(_t) controller_t;
enum { CONTROLLER_FLOATS = offsetof(controller_t, resets) / sizeof(float) };

static const char controller_name[] = CONTROLLER_TEXT(CONTROLLER);
static const float controller_sample_time = CONTROLLER_CONSTANT(_SAMPLE_TIME);

/* SHA-256 of the design file: DESIGN_DIGEST comes from the build, as "0x54,0xd4,…". */
static const unsigned char controller_digest[32] = {DESIGN_DIGEST};

static inline void controller_init(controller_t *loop)
{
    CONTROLLER_OF(_init)(loop);
}

static inline lqg_status_t controller_update(controller_t *loop, const float *y)
{
    return CONTROLLER_OF(_update)(loop, y);
}

static inline lqg_status_t controller_control(controller_t *loop, float *u)
{
    return CONTROLLER_OF(_control)(loop, u);
}

static inline lqg_status_t controller_predict(controller_t *loop, const float *u)
{
    return CONTROLLER_OF(_predict)(loop, u);
}

#endif
