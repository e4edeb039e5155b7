/* SPDX-License-Identifier: MIT */
/* The sketch BalancingRobot on a simulated Uno, with the nonlinear robot of ports/pc on its pins: encoders, an MPU-6050
 * with an offset and noise, a motor driver, a battery. One motor is weaker than the other, and its wheel
 * drags.
 *
 *     balance BalancingRobot.elf
 *
 * Exit status 0: the robot started when it was held upright and not before, stood through a push and a gap of its
 * gyroscope, ran straight, missed no period, and stopped its motors when it was knocked over. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "noise.h"
#include "robot.h"
#include "uno.h"

enum {
    ENCODER_LEFT_A = 2,
    ENCODER_RIGHT_A = 3,
    ENCODER_LEFT_B = 4,
    ENCODER_RIGHT_B = 5,
    STANDBY = 11,
    A1 = 15,
    A2 = 16
};
enum { ACCEL_XOUT_H = 0x3b, ACCEL_ZOUT_H = 0x3f, GYRO_YOUT_H = 0x45 };

#define DEGREES 57.29577951308232
static const double dt = 0.00025;         /* s, of the physics */
static const double battery = 7.4;        /* V */
static const double gyro_offset = 1.7;    /* °/s */
static const double gyro_noise = 0.1;     /* °/s rms */
static const double weak_motor = 0.95;    /* the left one */
static const double dragging_wheel = 0.1; /* V that it costs the left one */

/* What happens, in s. */
static const double stood_up = 3.0, let_go_by = 4.0, pushed = 8.0, gap = 10.0, knocked_over = 13.0, end = 15.0;

static uno_i2c_device mpu = {.address = 0x68};
static robot_t robot;
static double turn; /* rad: how far the right wheel is ahead, half of it */

static void set_word(int address, double value)
{
    const int word = (int)lrint(fmax(-32768.0, fmin(32767.0, value)));

    mpu.registers[address] = (uint8_t)(word >> 8 & 0xff);
    mpu.registers[address + 1] = (uint8_t)(word & 0xff);
}

static void set_encoder(avr_t *avr, int a, int b, double angle)
{
    const int quarter = (int)floor(angle * DEGREES * 2.0) & 3; /* A changes every degree, B in between */

    uno_set_input(avr, b, quarter >= 2);
    uno_set_input(avr, a, quarter == 1 || quarter == 2);
}

static void set_sensors(avr_t *avr, double seconds)
{
    const double wheel = robot.wheel - robot.pitch;

    mpu.silent = seconds > gap && seconds < gap + 0.05;
    set_word(GYRO_YOUT_H, 65.5 * (robot.pitch_rate * DEGREES + gyro_offset + gyro_noise * noise_normal()));
    set_word(ACCEL_XOUT_H, -16384.0 * sin(robot.pitch));
    set_word(ACCEL_ZOUT_H, 16384.0 * cos(robot.pitch));
    set_encoder(avr, ENCODER_LEFT_A, ENCODER_LEFT_B, wheel - turn);
    set_encoder(avr, ENCODER_RIGHT_A, ENCODER_RIGHT_B, wheel + turn);
    uno_set_analog(avr, 0, battery / 3.0);
}

static double motor_voltage(const avr_t *avr, int forward, int backward, int pwm)
{
    return battery * (uno_output(avr, forward) - uno_output(avr, backward)) * uno_duty(avr, pwm);
}

static double push(double seconds)
{
    if (seconds > knocked_over && seconds < knocked_over + 0.3)
        return 2.0;
    return (seconds > pushed && seconds < pushed + 0.1 ? 0.15 : 0.0) + 0.005 * noise_normal();
}

/* The hand that holds the robot: tilted, then upright, until the motors are on. */
static int is_held(double seconds, int is_on)
{
    static int was_let_go;

    was_let_go |= is_on && seconds > stood_up;
    if (was_let_go)
        return 0;
    const robot_t held = {0.0, seconds < stood_up ? 0.5 : 0.02, 0.0, 0.0};
    robot = held;
    return 1;
}

static void move_robot(const avr_t *avr, double seconds)
{
    const double left = weak_motor * motor_voltage(avr, 6, 7, 9), right = motor_voltage(avr, A1, A2, 10);

    if (is_held(seconds, uno_output(avr, STANDBY)) || fabs(robot.pitch) > 1.5)
        return; /* in the hand, or on the floor */
    robot_run(&robot, 0.5 * (left + right), push(seconds), dt);
    turn += dt * 0.5 * (right - left + dragging_wheel) / 0.468; /* the motor's back EMF is 0.468 V s/rad */
}

typedef struct {
    int too_early;           /* motors on before the robot was held upright */
    double started, stopped; /* s; 0: never */
    double most_pitch, most_turn, last_pitch, last_wheel;
} record_t;

static void observe(record_t *record, const avr_t *avr, double seconds)
{
    const int is_on = uno_output(avr, STANDBY);

    record->too_early |= is_on && seconds < stood_up;
    if (is_on && record->started <= 0.0)
        record->started = seconds;
    if (!is_on && record->started > 0.0 && record->stopped <= 0.0)
        record->stopped = seconds;
    if (seconds > knocked_over)
        return;
    record->most_pitch = fmax(record->most_pitch, record->started > 0.0 ? fabs(robot.pitch) : 0.0);
    record->most_turn = fmax(record->most_turn, fabs(turn));
    record->last_pitch = robot.pitch;
    record->last_wheel = robot.wheel;
}

static int expect(int is_true, const char *what)
{
    if (!is_true)
        printf("NOT TRUE: %s\n", what);
    return is_true;
}

int main(int argc, char **argv)
{
    avr_t *avr = uno_load(argc > 1 ? argv[1] : "");
    record_t record = {0};
    int is_well = 1;

    uno_connect(avr, &mpu);
    for (double seconds = 0.0; is_well && seconds < end; seconds += dt) {
        set_sensors(avr, seconds);
        is_well = uno_run_until(avr, seconds + dt) == 0;
        move_robot(avr, seconds);
        observe(&record, avr, seconds);
    }

    printf(
        "%sstarted at %.2f s, stopped at %.2f s; pitch at most %.1f degrees, %.2f at the end; %.1f cm away, wheels at "
        "most %.1f degrees apart\n",
        uno_printed(), record.started, record.stopped, record.most_pitch * DEGREES, record.last_pitch * DEGREES,
        record.last_wheel * 4.0, 2.0 * record.most_turn * DEGREES);
    is_well &= expect(is_well, "the sketch ran to the end");
    is_well &= expect(!record.too_early, "the motors waited for the robot to be upright");
    is_well &= expect(record.started > stood_up && record.started < let_go_by, "the motors started then");
    is_well &= expect(record.most_pitch < 0.3, "the robot stood through push and gap");
    is_well &=
        expect(fabs(record.last_pitch) < 0.05 && fabs(record.last_wheel) < 0.5, "it came to rest near its start");
    is_well &= expect(record.most_turn < 0.1, "it ran straight");
    is_well &= expect(record.stopped > knocked_over && record.stopped < knocked_over + 1.0,
                      "the motors stopped after the fall");
    is_well &= expect(!strstr(uno_printed(), "late"), "no period was missed");
    return is_well ? 0 : 1;
}
