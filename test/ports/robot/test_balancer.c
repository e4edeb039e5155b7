/* SPDX-License-Identifier: MIT */
/* When the robot may drive and when it has to stop, with the robot of ports/pc for hardware. */
#include <math.h>

#include "../../../ports/pc/robot.h"
#include "balancer.h"
#include "hardware.h"
#include "unity.h"

enum { SECOND = 250 }; /* samples */

static robot_t robot;
static sensors_t wrong; /* is added to what the sensors say */
static balancer_t balancer;
static float left_voltage, right_voltage;
static int has_current;
static int is_held, is_lifted; /* by a hand: it cannot tip; its wheels do not touch the ground, either */

void setUp(void);
void tearDown(void);

void hardware_start(void) {}

/* In the air the wheels run as fast as the voltage lets them: the motor's 0.468 V s/rad, and friction. */
static void let_a_sample_pass(void)
{
    const double voltage = has_current ? 0.5 * (double)(left_voltage + right_voltage) : 0.0;

    if (is_lifted)
        robot.wheel += 0.004 * voltage / 0.5;
    else if (!is_held)
        robot_run(&robot, voltage, 0.0, 0.004);
}

void hardware_read(sensors_t *sensors)
{
    let_a_sample_pass();
    sensors->left = (float)(robot.wheel - robot.pitch) + 3.0f + wrong.left;
    sensors->right = (float)(robot.wheel - robot.pitch) + 5.0f + wrong.right;
    sensors->gyro = (float)robot.pitch_rate + 0.02f + wrong.gyro;
    sensors->tilt = (float)robot.pitch + wrong.tilt;
}

void hardware_drive(float left, float right)
{
    left_voltage = left;
    right_voltage = right;
    has_current = 1;
}

void hardware_stop(void)
{
    has_current = 0;
}

static void run(unsigned samples)
{
    while (samples-- > 0)
        balancer_run_sample(&balancer);
}

static void run_late(unsigned samples)
{
    while (samples-- > 0) {
        run(1);
        balancer_note_overrun(&balancer);
    }
}

static void hold_upright(void)
{
    robot = (robot_t){0.0, 0.0, 0.0, 0.0};
    wrong = (sensors_t){0.0f, 0.0f, 0.0f, 0.0f};
    is_held = 1;
    is_lifted = 0;
}

static void start_to_balance(void)
{
    hold_upright();
    run(SECOND);
    TEST_ASSERT_EQUAL_INT(BALANCER_READY, balancer.state);
    is_held = 0;
    robot.pitch_rate = 0.15;
    run(2);
    TEST_ASSERT_EQUAL_INT(BALANCER_BALANCING, balancer.state);
    TEST_ASSERT_TRUE(has_current);
}

static void expect_stopped(balancer_reason_t reason)
{
    TEST_ASSERT_EQUAL_INT(BALANCER_WAITING, balancer.state);
    TEST_ASSERT_EQUAL_INT(reason, balancer.reason);
    TEST_ASSERT_FALSE(has_current);
}

void setUp(void)
{
    has_current = 1;
    balancer_init(&balancer);
}

void tearDown(void) {}

static void test_motors_are_off_from_the_start(void)
{
    expect_stopped(BALANCER_NEW);
}

static void test_is_ready_only_after_a_second_upright(void)
{
    hold_upright();
    run(SECOND - 1);
    expect_stopped(BALANCER_NEW);
    run(1);
    TEST_ASSERT_EQUAL_INT(BALANCER_READY, balancer.state);
}

static void test_second_begins_anew_after_a_jerk(void)
{
    hold_upright();
    wrong.gyro = 0.1f;
    run(SECOND - 1);
    wrong.gyro = 1.0f;
    run(1);
    hold_upright();
    run(SECOND - 1);
    expect_stopped(BALANCER_NEW);
    run(1);
    TEST_ASSERT_EQUAL_INT(BALANCER_READY, balancer.state);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.02f, balancer.gyro_offset);
}

static void test_second_begins_anew_after_a_stop(void)
{
    start_to_balance();
    run_late(5);
    expect_stopped(BALANCER_LATE);
    hold_upright();
    run(SECOND - 1);
    expect_stopped(BALANCER_LATE);
    run(1);
    TEST_ASSERT_EQUAL_INT(BALANCER_READY, balancer.state);
}

/* A firm hand, for ten seconds, with the noise of a gyroscope. */
static void test_does_not_drive_before_it_is_let_go(void)
{
    hold_upright();
    run(SECOND);
    for (int i = 0; i < 10 * SECOND; i++) {
        wrong.gyro = i % 3 == 0 ? 0.05f : -0.025f;
        run(1);
        TEST_ASSERT_EQUAL_INT(BALANCER_READY, balancer.state);
        TEST_ASSERT_FALSE(has_current);
    }
}

static void test_waits_again_when_it_is_laid_down_or_goes_blind_before_it_is_let_go(void)
{
    hold_upright();
    run(SECOND);
    wrong.tilt = 0.1f;
    run(1);
    expect_stopped(BALANCER_NEW);
    hold_upright();
    run(SECOND);
    wrong.gyro = NAN;
    run(1);
    expect_stopped(BALANCER_BLIND);
}

/* Even if something else has switched them on. */
static void test_motors_are_switched_off_in_every_sample_of_waiting(void)
{
    has_current = 1;
    run(1);
    expect_stopped(BALANCER_NEW);
}

static void test_never_drives_while_lying_shaken_or_blind(void)
{
    hold_upright();
    wrong.tilt = 0.2f;
    run(2 * SECOND);
    hold_upright();
    wrong.tilt = -0.2f;
    run(2 * SECOND);
    hold_upright();
    wrong.gyro = NAN;
    run(2 * SECOND);
    TEST_ASSERT_EQUAL_STRING("waits for its sensors", balancer_text(&balancer));
    hold_upright();
    wrong.tilt = NAN;
    run(2 * SECOND);
    hold_upright();
    wrong.left = INFINITY;
    run(2 * SECOND);
    expect_stopped(BALANCER_NEW);
}

/* What the gyroscope said while the robot was held still is its offset, and where the wheels were is 0: no voltage. */
static void test_offset_of_gyroscope_and_zero_of_wheels_are_taken_out(void)
{
    start_to_balance();
    run(8 * SECOND);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.02f, balancer.gyro_offset);
    TEST_ASSERT_FLOAT_WITHIN(1e-2f, 0.0f, balancer.voltage);
    TEST_ASSERT_FLOAT_WITHIN(1e-2f, 0.0f, left_voltage);
    TEST_ASSERT_FLOAT_WITHIN(1e-2f, 0.0f, right_voltage);
    TEST_ASSERT_FLOAT_WITHIN(1e-2f, 0.0f, (float)robot.wheel);
}

/* Tipping forward it drives forward. */
static void test_drives_under_the_body(void)
{
    start_to_balance();
    robot.pitch_rate = 1.0;
    run(1);
    TEST_ASSERT_TRUE(left_voltage > 0.5f);
    TEST_ASSERT_TRUE(right_voltage > 0.5f);
}

static void test_turns_back_when_one_wheel_runs_ahead(void)
{
    start_to_balance();
    run(SECOND);
    wrong.right += 0.2f;
    wrong.left -= 0.2f;
    run(1);
    TEST_ASSERT_TRUE(right_voltage < left_voltage);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 2.0f * balancer.voltage, left_voltage + right_voltage);
    wrong.right = 100.0f;
    wrong.left = -100.0f;
    run(1);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 2.0f, left_voltage - right_voltage);
}

static void test_stops_when_it_has_fallen(void)
{
    start_to_balance();
    robot.pitch_rate = 8.0;
    run(SECOND / 4);
    expect_stopped(BALANCER_FALLEN);
    TEST_ASSERT_TRUE(robot.pitch > 0.4);
    run(SECOND);
    expect_stopped(BALANCER_FALLEN);
    start_to_balance();
}

/* The wheels run away in the air, until at full voltage, the body as it was. */
static void test_stops_when_it_is_lifted(void)
{
    unsigned samples = 0;

    start_to_balance();
    run(SECOND); /* by then it knows how it stands */
    is_lifted = 1;
    robot.wheel += 0.1;
    for (; samples < 5 * SECOND && balancer.state == BALANCER_BALANCING; samples++)
        run(1);
    TEST_ASSERT_GREATER_OR_EQUAL_UINT(SECOND / 2, samples);
    expect_stopped(BALANCER_LIFTED);
}

/* Wheels that are held do not answer: it believes to fall. */
static void test_stops_when_its_wheels_are_held(void)
{
    start_to_balance();
    run(SECOND);
    is_held = 1;
    robot.pitch = 0.1;
    run(SECOND / 2);
    expect_stopped(BALANCER_FALLEN);
}

static void test_goes_on_without_gyroscope_for_a_moment_but_not_for_long(void)
{
    start_to_balance();
    run(SECOND);
    wrong.gyro = NAN;
    run(SECOND / 10 - 1);
    TEST_ASSERT_EQUAL_INT(BALANCER_BALANCING, balancer.state);
    TEST_ASSERT_TRUE(left_voltage - left_voltage >= 0.0f); /* finite */
    wrong.gyro = 0.0f;
    run(1);
    wrong.gyro = NAN;
    run(SECOND / 10 - 1);
    TEST_ASSERT_EQUAL_INT(BALANCER_BALANCING, balancer.state);
    run(1);
    expect_stopped(BALANCER_BLIND);
}

static void test_a_dead_encoder_is_no_number_at_the_motors(void)
{
    start_to_balance();
    run(SECOND);
    wrong.left = NAN;
    run(1);
    TEST_ASSERT_TRUE(left_voltage - left_voltage >= 0.0f);
    TEST_ASSERT_TRUE(right_voltage - right_voltage >= 0.0f);
    run(SECOND / 10);
    expect_stopped(BALANCER_BLIND);
}

static void test_stops_when_five_samples_in_a_row_are_late(void)
{
    start_to_balance();
    run_late(4);
    TEST_ASSERT_EQUAL_INT(BALANCER_BALANCING, balancer.state);
    run_late(1);
    expect_stopped(BALANCER_LATE);
    TEST_ASSERT_EQUAL_UINT(5, balancer.overruns);
}

static void test_single_late_samples_are_only_counted(void)
{
    start_to_balance();
    for (int i = 0; i < 20; i++) {
        run_late(1);
        run(1);
    }
    TEST_ASSERT_EQUAL_INT(BALANCER_BALANCING, balancer.state);
    TEST_ASSERT_EQUAL_UINT(20, balancer.overruns);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_motors_are_off_from_the_start);
    RUN_TEST(test_is_ready_only_after_a_second_upright);
    RUN_TEST(test_second_begins_anew_after_a_jerk);
    RUN_TEST(test_second_begins_anew_after_a_stop);
    RUN_TEST(test_does_not_drive_before_it_is_let_go);
    RUN_TEST(test_waits_again_when_it_is_laid_down_or_goes_blind_before_it_is_let_go);
    RUN_TEST(test_motors_are_switched_off_in_every_sample_of_waiting);
    RUN_TEST(test_never_drives_while_lying_shaken_or_blind);
    RUN_TEST(test_offset_of_gyroscope_and_zero_of_wheels_are_taken_out);
    RUN_TEST(test_drives_under_the_body);
    RUN_TEST(test_turns_back_when_one_wheel_runs_ahead);
    RUN_TEST(test_stops_when_it_has_fallen);
    RUN_TEST(test_stops_when_it_is_lifted);
    RUN_TEST(test_stops_when_its_wheels_are_held);
    RUN_TEST(test_goes_on_without_gyroscope_for_a_moment_but_not_for_long);
    RUN_TEST(test_a_dead_encoder_is_no_number_at_the_motors);
    RUN_TEST(test_stops_when_five_samples_in_a_row_are_late);
    RUN_TEST(test_single_late_samples_are_only_counted);
    return UNITY_END();
}
