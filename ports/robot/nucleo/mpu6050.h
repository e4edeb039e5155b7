/* SPDX-License-Identifier: MIT */
/* The MPU-6050, gyroscope and accelerometer, at I2C1: SCL on PB8, SDA on PB9, 381 kHz. */
#ifndef MPU6050_H
#define MPU6050_H

#include <stdint.h>

/* The bus and its pins. */
void mpu6050_start_bus(void);

/* Wakes the sensor. Returns 0, or −1: there is none. */
int mpu6050_start(void);

typedef struct {
    float acceleration[3]; /* g, along x, y, z */
    float rate[3];         /* rad/s, around x, y, z */
} mpu6050_t;

/* Takes 0.5 ms. Returns 0, or −1: it did not answer, and has to be started again. */
int mpu6050_read(mpu6050_t *reading);

#endif
