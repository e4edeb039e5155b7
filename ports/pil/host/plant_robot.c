/* SPDX-License-Identifier: MIT */
#include <stdio.h>

#include "../../pc/robot.h"
#include "../../pc/scenario.h"
#include "plant.h"

#define DEGREES (180.0 / 3.14159265358979323846)

const char plant_place[] = "the robot here";
const char plant_quantity[] = "pitch [°]";

static robot_t robot;

static double time_of(unsigned k)
{
    return k * (double)controller_sample_time;
}

unsigned plant_samples(double seconds)
{
    return (unsigned)((seconds > 0 ? seconds : 10) / (double)controller_sample_time + 0.5);
}

void plant_read_sensors(unsigned k, float y[CONTROLLER_NY])
{
    if (k == 0)
        robot = scenario_start;
    scenario_read_sensors(&robot, time_of(k), y);
}

double plant_value(void)
{
    return robot.pitch * DEGREES;
}

void plant_apply(unsigned k, const float u[CONTROLLER_NU])
{
    robot_run(&robot, (double)u[0], scenario_push(time_of(k)), (double)controller_sample_time);
}

int plant_report(double seconds)
{
    const int stands = scenario_stands(&robot);

    printf("  After %.1f s the robot %s: pitch %.2f degrees, %.1f cm from where it began.\n", seconds,
           stands ? "stands" : "HAS FALLEN", robot.pitch * DEGREES, robot.wheel * 4.0);
    return stands;
}
