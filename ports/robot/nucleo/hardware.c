/* SPDX-License-Identifier: MIT */
/* The robot on a Nucleo-F401RE. The sensor's x points forward, its y to the left, its z up. */
#include "../hardware.h"

#include <math.h>

#include "mpu6050.h"
#include "stm32f401.h"
#include "wheels.h"

static int sees; /* the sensor has answered last time */

/* A program that hangs is reset after 20 ms, and while the processor is in reset the motors have no current. It runs at
 * 32 kHz / 4. It cannot be stopped any more: while a debugger holds the program, too. */
static void start_watchdog(void)
{
    IWDG->kr = IWDG_START;
    IWDG->kr = IWDG_UNLOCK;
    IWDG->pr = 0;
    IWDG->rlr = 160;
    IWDG->kr = IWDG_FEED;
}

void hardware_start(void)
{
    wheels_start();
    mpu6050_start_bus();
    sees = mpu6050_start() == 0;
    start_watchdog();
}

void hardware_read(sensors_t *sensors)
{
    mpu6050_t reading;

    IWDG->kr = IWDG_FEED;
    wheels_read(&sensors->left, &sensors->right);
    sees = (sees || mpu6050_start() == 0) && mpu6050_read(&reading) == 0;
    sensors->gyro = sees ? reading.rate[1] : NAN;
    sensors->tilt = sees ? atan2f(-reading.acceleration[0], reading.acceleration[2]) : NAN;
}

void hardware_drive(float left, float right)
{
    wheels_drive(left, right);
}

void hardware_stop(void)
{
    wheels_release();
}

/* Called by the start-up code after a fault. */
void stop_outputs(void);

void stop_outputs(void)
{
    wheels_release();
}
