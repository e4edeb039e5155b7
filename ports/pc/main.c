/* SPDX-License-Identifier: MIT */
/* The balancing robot in closed loop: the emitted controller, in float, against the nonlinear robot with noisy sensors.
 *
 *     balancing_robot_demo [PICTURE.svg]
 *
 * What happens to the robot is in scenario.c. Exit status 0: it stood to the end, and the picture was written. */
#include <stdio.h>

#include "balancing_robot.h"
#include "chart.h"
#include "robot.h"
#include "scenario.h"

#define PI 3.14159265358979323846
#define DEGREES (180.0 / PI)

enum { SAMPLES = 2500 }; /* ten seconds */

typedef struct {
    double pitch[SAMPLES], pitch_estimate[SAMPLES]; /* ° */
    double way[SAMPLES];                            /* cm */
    double voltage[SAMPLES];                        /* V */
    int limited, left_out, resets;                  /* samples with these bits in their status */
} record_t;

static record_t record;

static int count(lqg_status_t status, lqg_status_t bit)
{
    return (status & bit) != 0;
}

/* Ten seconds of what the firmware would do every BALANCING_ROBOT_SAMPLE_TIME. */
static robot_t run_loop(robot_t robot)
{
    balancing_robot_t loop;

    balancing_robot_init(&loop);
    for (int k = 0; k < SAMPLES; k++) {
        const double seconds = k * (double)BALANCING_ROBOT_SAMPLE_TIME;
        float y[BALANCING_ROBOT_NY], u[BALANCING_ROBOT_NU];
        lqg_status_t status;

        scenario_read_sensors(&robot, seconds, y);
        status = balancing_robot_update(&loop, y);
        status |= balancing_robot_control(&loop, u);
        record.pitch[k] = robot.pitch * DEGREES;
        record.pitch_estimate[k] = (double)loop.x[BALANCING_ROBOT_X_PITCH] * DEGREES;
        record.way[k] = robot.wheel * 4.0;
        record.voltage[k] = (double)u[0];
        status |= balancing_robot_predict(&loop, u);
        record.limited += count(status, LQG_INPUT_LIMITED);
        record.left_out += count(status, LQG_OUTPUT_REJECTED);
        record.resets += count(status, LQG_STATE_RESET);
        robot_run(&robot, (double)u[0], scenario_push(seconds), (double)BALANCING_ROBOT_SAMPLE_TIME);
    }
    return robot;
}

static int show(const char *picture)
{
    const chart_curve_t curves[] = {{"pitch [°] (behind it: the estimate)", record.pitch, record.pitch_estimate},
                                    {"way [cm]", record.way, NULL},
                                    {"voltage [V]", record.voltage, NULL}};
    const int curve_count = (int)(sizeof curves / sizeof curves[0]);

    for (int i = 0; i < curve_count; i++)
        chart_print(&curves[i], SAMPLES, (double)BALANCING_ROBOT_SAMPLE_TIME);
    printf(
        "\n  Let go at 3 degrees, pushed at 4 s, gyroscope dead from 7.0 s to 7.1 s.\n"
        "  Of %d samples: %d with the voltage at its limit, %d with an output left out, %d with a reset.\n",
        SAMPLES, record.limited, record.left_out, record.resets);
    if (!picture)
        return 0;
    if (chart_write_svg(picture, "Balancing robot, emitted controller, nonlinear plant", curves, curve_count, SAMPLES,
                        (double)BALANCING_ROBOT_SAMPLE_TIME)) {
        fprintf(stderr, "%s cannot be written\n", picture);
        return -1;
    }
    printf("  Picture: %s\n", picture);
    return 0;
}

int main(int argc, char **argv)
{
    const robot_t end = run_loop(scenario_start);
    const int stands = scenario_stands(&end);
    const int shown = show(argc > 1 ? argv[1] : NULL);

    printf("  After %.0f s the robot %s: pitch %.2f degrees, %.1f cm from where it began.\n",
           (double)SAMPLES * (double)BALANCING_ROBOT_SAMPLE_TIME, stands ? "stands" : "HAS FALLEN", end.pitch * DEGREES,
           end.wheel * 4.0);
    return stands && shown == 0 ? 0 : 1;
}
