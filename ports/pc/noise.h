/* SPDX-License-Identifier: MIT */
/* Random numbers of a sensor, the same in every run. */
#ifndef NOISE_H
#define NOISE_H

/* Mean 0, variance 1. */
double noise_normal(void);

#endif
