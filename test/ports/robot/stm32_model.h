/* SPDX-License-Identifier: MIT */
/* The STM32F401 of the robot, as far as its firmware uses it, by ST's RM0368: strict, so that what the manual forbids
 * is a complaint. At its pins: an MPU-6050, two encoders, two motors behind a TB6612FNG. */
#ifndef STM32_MODEL_H
#define STM32_MODEL_H

#include <stdint.h>

/* The robot as its sensors see it, to be set by the test. */
typedef struct {
    double pitch, pitch_rate; /* rad, rad/s */
    double left, right;       /* rad: the wheels against the body, forward positive */
    int sensor_is_dead;       /* it does not acknowledge its address */
} world_t;

extern world_t world;

/* Registers, by address from 0x40000000 on and in the core's own space from 0xE000E000 on. */
uint32_t stm32_read(uint32_t address);
void stm32_write(uint32_t address, uint32_t value);

/* V at the motors, forward positive; 0 where they have no current. */
void stm32_motors(double *left, double *right);

/* Begins a sample: what has happened since the last one. */
typedef struct {
    unsigned fed;       /* times that the watchdog was fed */
    double bus_seconds; /* that the I²C bus was busy */
} stm32_sample_t;

stm32_sample_t stm32_begin_sample(void);

/* s between two ticks of SysTick, and that the watchdog waits; 0: not started. */
double stm32_sample_time(void);
double stm32_watchdog_time(void);

/* What has been said at the serial port since the last call, ended by '\0'. */
const char *stm32_serial(void);

/* Complaints so far; each is printed. */
extern unsigned stm32_complaints;

#endif
