/* The controller that target and host both run: for another design, its names here. Its `real` has to be float. */
#ifndef PIL_CONTROLLER_H
#define PIL_CONTROLLER_H

#include <stddef.h>

#include "balancing_robot.h"

enum { CONTROLLER_NX = BALANCING_ROBOT_NX, CONTROLLER_NU = BALANCING_ROBOT_NU, CONTROLLER_NY = BALANCING_ROBOT_NY };

/* It begins with its floats, whose bits the CRC is of; the count of resets behind them is wider on some targets. */
typedef balancing_robot_t controller_t;
enum { CONTROLLER_FLOATS = offsetof(controller_t, resets) / sizeof(float) };

static const char controller_name[] = "balancing_robot";
static const float controller_sample_time = BALANCING_ROBOT_SAMPLE_TIME;

/* SHA-256 of the design file: DESIGN_DIGEST comes from the build, as "0x54,0xd4,…". */
static const unsigned char controller_digest[32] = {DESIGN_DIGEST};

static inline void controller_init(controller_t *loop)
{
    balancing_robot_init(loop);
}

static inline lqg_status controller_update(controller_t *loop, const float *y)
{
    return balancing_robot_update(loop, y);
}

static inline lqg_status controller_control(controller_t *loop, float *u)
{
    return balancing_robot_control(loop, u);
}

static inline lqg_status controller_predict(controller_t *loop, const float *u)
{
    return balancing_robot_predict(loop, u);
}

#endif
