/* SPDX-License-Identifier: MIT */
/* The rest of the README's firmware: sensors and actuators that a test can look at. */
#include <math.h>

#include "unity.h"

void read_sensors(float y[2]);
void write_actuators(const float u[1]);
void start(void);
void every_sample(void);

static float measured[2], applied;

void setUp(void) {}

void tearDown(void) {}

void read_sensors(float y[2])
{
    y[0] = measured[0];
    y[1] = measured[1];
}

void write_actuators(const float u[1])
{
    applied = u[0];
}

static void test_program_pushes_the_masses_back_also_when_a_sensor_fails(void)
{
    start();
    measured[0] = 1.0f;
    measured[1] = 1.0f;
    every_sample();
    TEST_ASSERT_TRUE(applied < 0.0f);
    measured[1] = NAN;
    every_sample();
    TEST_ASSERT_TRUE(applied < 0.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_program_pushes_the_masses_back_also_when_a_sensor_fails);
    return UNITY_END();
}
