/* SPDX-License-Identifier: MIT */
/* A robot that is simulated on the processor that balances it, and what happens to it:
 *
 *     0.0 s   it lies on its face: no motor may turn
 *     1.0 s   a hand puts it upright, holds it, and lets go at 3.0 s
 *     5.0 s   a push, from which it recovers
 *     7.0 s   another that it cannot survive: it falls, and has to switch its motors off
 *     9.0 s   the hand again, until 10.5 s
 *    12.0 s   one sample takes longer than the sample time
 *    14.0 s   the end: the program leaves with status 0 if all of this went as it should, else with a bit for what did
 *             not */
#include "../hardware.h"

#include <math.h>

#include "../../pc/noise.h"
#include "../../pc/robot.h"
#include "../report.h"
#include "board.h"

#define DEGREES (180.0 / 3.14159265358979323846)
#define SAMPLE_TIME ((double)BALANCING_ROBOT_SAMPLE_TIME)

enum {
    DROVE_TOO_SOON = 1,
    NEVER_DROVE = 2,
    FELL_AT_THE_PUSH = 4,
    DROVE_WHEN_FALLEN = 8,
    DID_NOT_GET_UP = 16,
    DOES_NOT_STAND = 32
};

static robot_t robot;
static double voltage; /* V, mean of both motors */
static double turned;  /* rad: half of what the right wheel is ahead of the left one */
static unsigned long sample;
static int driven;   /* since the last sample */
static int failures; /* of the above */

static const double lying = 1.2;        /* rad */
static const double gyro_offset = 0.03; /* rad/s */

static int is_between(double from, double to)
{
    const double seconds = (double)sample * SAMPLE_TIME;

    return seconds >= from && seconds < to;
}

static void require(int condition, int failure)
{
    failures |= condition ? 0 : failure;
}

/* ---- what happens to it --------------------------------------------------------------------------------- */

static void hold(double pitch)
{
    robot.wheel += pitch - robot.pitch; /* its wheels turn with it, as a locked gear's */
    robot.pitch = pitch;
    robot.wheel_rate = robot.pitch_rate = 0.0;
}

/* The floor ends a fall. */
static void fall_no_further(void)
{
    if (fabs(robot.pitch) > lying)
        hold(robot.pitch > 0.0 ? lying : -lying);
}

static double push(void)
{
    const double shake = 0.005 * noise_normal();

    return shake + (is_between(5.0, 5.1) ? 0.15 : is_between(7.0, 7.3) ? 1.0 : 0.0);
}

static int is_held(void)
{
    return is_between(1.0, 3.0) || is_between(9.0, 10.5);
}

static void let_a_sample_pass(void)
{
    if (is_between(0.0, 1.0))
        hold(lying);
    else if (is_held())
        hold(0.01 * noise_normal() / 3.0);
    else
        robot_run(&robot, driven ? voltage : 0.0, push(), SAMPLE_TIME);
    fall_no_further();
}

static void judge(void)
{
    require(!(is_between(0.0, 3.0) && driven), DROVE_TOO_SOON);
    require(!(is_between(3.5, 7.0) && !driven), NEVER_DROVE);
    require(!(is_between(3.0, 7.0) && fabs(robot.pitch) > 0.4), FELL_AT_THE_PUSH);
    require(!(is_between(7.6, 10.5) && driven), DROVE_WHEN_FALLEN);
    require(!(is_between(11.0, 14.0) && !driven), DID_NOT_GET_UP);
    require(!(is_between(13.5, 14.0) && fabs(robot.pitch) * DEGREES > 3.0), DOES_NOT_STAND);
}

static void leave_at_the_end(void)
{
    if (!is_between(14.0, 1e9))
        return;
    report_number("failures ", failures);
    report_number("  pitch of the robot ", (long)(1e3 * robot.pitch));
    report_text(" mrad\r\n");
    board_leave(failures);
}

/* ---- the hardware --------------------------------------------------------------------------------------- */

void hardware_start(void)
{
    hold(lying);
}

void hardware_stop(void)
{
    driven = 0;
}

void hardware_drive(float left, float right)
{
    driven = 1;
    voltage = 0.5 * ((double)left + (double)right);
    turned += 0.05 * ((double)right - (double)left) * SAMPLE_TIME + 0.0002; /* the motors are not quite alike */
}

static float degrees_of(double angle)
{
    return (float)(floor(angle * DEGREES + 0.5) / DEGREES);
}

static void waste_a_sample(void)
{
    for (volatile unsigned i = 0; i < 1500000; i++)
        ;
}

/* A sample passes between two of its calls. */
void hardware_read(sensors_t *sensors)
{
    judge();
    leave_at_the_end();
    let_a_sample_pass();
    sample++;
    if (sample == 3000)
        waste_a_sample();
    sensors->left = degrees_of(robot.wheel - robot.pitch - turned);
    sensors->right = degrees_of(robot.wheel - robot.pitch + turned);
    sensors->gyro = (float)(robot.pitch_rate + gyro_offset + noise_normal() / DEGREES);
    sensors->tilt = (float)(robot.pitch + 0.01 * noise_normal());
}
