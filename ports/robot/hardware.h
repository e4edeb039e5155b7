/* SPDX-License-Identifier: MIT */
/* What the robot is made of, to the program that balances it: simulated/ and nucleo/ have it. */
#ifndef HARDWARE_H
#define HARDWARE_H

/* Forward is positive: a wheel that rolls forward, a body that tips forward. What could not be measured is NaN. */
typedef struct {
    float left, right; /* rad: angles of the wheels against the body, from any zero */
    float gyro;        /* rad/s of the body, with whatever offset the sensor has */
    float tilt;        /* rad from upright, as gravity shows it: right only while nothing is accelerated */
} sensors_t;

/* All of it, with the motors off. */
void hardware_start(void);

/* Called once in every sample; takes at most a quarter of it. */
void hardware_read(sensors_t *sensors);

/* Volts at the motors. */
void hardware_drive(float left, float right);

/* The motors get no current; also after a fault, from any state. */
void hardware_stop(void);

#endif
