/* SPDX-License-Identifier: MIT */
/* What stands for the plant: the robot of ports/pc, simulated (plant_robot.c); for any other design the samples of its
 * own test, NAME_test.c, which hear nothing of u (plant_samples.c). */
#ifndef PIL_PLANT_H
#define PIL_PLANT_H

#include "controller.h"

extern const char plant_place[];    /* "the robot here": where the other half of the loop is */
extern const char plant_quantity[]; /* "pitch [°]": what plant_value is */

/* So many samples are in these seconds, or in a run whose length nobody has said, 0. */
unsigned plant_samples(double seconds);

/* y of sample k; then the u that came of it. They are asked for in order, from 0 on. */
void plant_read_sensors(unsigned k, float y[CONTROLLER_NY]);
void plant_apply(unsigned k, const float u[CONTROLLER_NU]);

/* Of the sample that was read last. */
double plant_value(void);

/* Says how the plant is after these seconds, on standard output. Returns whether that is well. */
int plant_report(double seconds);

#endif
