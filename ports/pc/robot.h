/* SPDX-License-Identifier: MIT */
/* The balancing robot as physics has it, not as the design sees it: nonlinear, in continuous time. */
#ifndef ROBOT_H
#define ROBOT_H

typedef struct {
    double wheel, pitch;           /* rad: mean angle of the wheels; 0 is upright */
    double wheel_rate, pitch_rate; /* rad/s */
} robot_t;

/* Lets `seconds` pass at a constant motor voltage [V], while a torque [N m] pushes the body. */
void robot_run(robot_t *robot, double voltage, double push, double seconds);

#endif
