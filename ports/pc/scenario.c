/* SPDX-License-Identifier: MIT */
#include "scenario.h"

#include <math.h>

#include "noise.h"

#define DEGREES (180.0 / 3.14159265358979323846)

const robot_t scenario_start = {0.0, 3.0 / DEGREES, 0.0, 0.0};

/* The encoder counts degrees of the wheel against the body; the gyroscope has 1 °/s rms of noise, and a gap. */
void scenario_read_sensors(const robot_t *robot, double seconds, float y[BALANCING_ROBOT_NY])
{
    y[BALANCING_ROBOT_Y_ENCODER] = (float)(floor((robot->wheel - robot->pitch) * DEGREES + 0.5) / DEGREES);
    y[BALANCING_ROBOT_Y_GYRO] = (float)(robot->pitch_rate + noise_normal() / DEGREES);
    if (seconds > 7.0 && seconds < 7.1)
        y[BALANCING_ROBOT_Y_GYRO] = NAN;
}

/* A torque that pushes the body for a tenth of a second, and some that always shakes it. */
double scenario_push(double seconds)
{
    return (seconds > 4.0 && seconds < 4.1 ? 0.15 : 0.0) + 0.005 * noise_normal();
}

int scenario_stands(const robot_t *robot)
{
    return fabs(robot->pitch) * DEGREES < 2.0 && fabs(robot->wheel) < 0.5;
}
