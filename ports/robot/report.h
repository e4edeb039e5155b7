/* SPDX-License-Identifier: MIT */
/* A line of text over the serial port, for a person or a plotter. */
#ifndef REPORT_H
#define REPORT_H

#include "balancer.h"

void report_text(const char *text);
void report_number(const char *name, long number);

/* "balances pitch -3 mrad left 12 mm right 11 mm voltage 140 mV samples 2500 overruns 0": the pitch is the estimate,
 * and while it waits what gravity shows; left and right are the wheels' ways against the body; "?" is what could not be
 * measured. */
void report_balancer(const balancer_t *balancer);

#endif
