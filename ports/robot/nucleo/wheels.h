/* SPDX-License-Identifier: MIT */
/* Motors behind a TB6612FNG, and their encoders.
 *
 *     left:  A1, A2 of the encoder on PA0, PA1 (TIM2);  AIN1 PB10, AIN2 PB4, PWMA PA8
 *     right: B1, B2 of the encoder on PA6, PA7 (TIM3);  BIN1 PB5,  BIN2 PB3, PWMB PA9
 *     STBY PA10: low, also when the processor is in reset, takes the current from both */
#ifndef WHEELS_H
#define WHEELS_H

/* The motors have no current, the encoders count from 0. */
void wheels_start(void);

/* rad, forward positive, each wheel against the body. To be called at least once in half a turn of a 16-bit counter. */
void wheels_read(float *left, float *right);

/* Volts, forward positive. */
void wheels_drive(float left, float right);

void wheels_release(void);

#endif
