/* SPDX-License-Identifier: MIT */
/* What the robot goes through in the demos: let go 3° off upright, pushed after four seconds, its gyroscope dead for a
 * moment after seven; with noise on sensors and torque. */
#ifndef SCENARIO_H
#define SCENARIO_H

#include "balancing_robot.h"
#include "robot.h"

/* How the robot is let go. */
extern const robot_t scenario_start;

/* What the sensors say of the robot. */
void scenario_read_sensors(const robot_t *robot, double seconds, float y[BALANCING_ROBOT_NY]);

/* The torque that disturbs the body [N m]. */
double scenario_push(double seconds);

/* Whether the robot is upright and where it began; NaN is neither. */
int scenario_stands(const robot_t *robot);

#endif
