/* SPDX-License-Identifier: MIT */
/* The motor that the README's second program turns: its own equations in steps of 1 µs, with a load that the design
 * does not know. */
#include <math.h>

#include "unity.h"

float read_encoder(void);
void write_voltage(float voltage);
void turn_to(float angle);
void start(void);
void every_millisecond(void);

static double angle, speed, torque, voltage;

void setUp(void)
{
    angle = speed = torque = voltage = 0;
    start();
}

void tearDown(void) {}

float read_encoder(void)
{
    const double step = 2 * 3.14159265358979 / 2000; /* of 2000 counts a turn */

    return (float)(step * floor(angle / step + 0.5));
}

void write_voltage(float to)
{
    voltage = (double)to;
}

static void run(int milliseconds)
{
    const double J = 3.2284e-6, K = 0.0274, b = 3.5077e-6, R = 4;

    for (int k = 0; k < milliseconds; k++) {
        every_millisecond();
        TEST_ASSERT_TRUE(fabs(voltage) <= 12);
        for (int i = 0; i < 1000; i++) {
            angle += 1e-6 * speed;
            speed += 1e-6 * (K * (voltage - K * speed) / R - b * speed - torque) / J;
        }
    }
}

static void test_servo_follows_its_reference(void)
{
    turn_to(1);
    run(1);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 12, voltage);
    run(400);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 1, angle);
    turn_to(-2);
    run(400);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, -2, angle);
}

static void test_load_is_overcome(void)
{
    torque = 0.02; /* N m: 3 V to hold it */
    turn_to(1);
    run(1000);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 1, angle);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_servo_follows_its_reference);
    RUN_TEST(test_load_is_overcome);
    return UNITY_END();
}
