/* SPDX-License-Identifier: MIT */
/* The balancing robot but for its hardware: when it may drive, what it does in a sample, and when it has to stop.
 *
 *     WAITING ── held upright and still for a second ──▶ READY ── let go: it moves ──▶ BALANCING
 *        ▲                                                │                                │
 *        └───────────── laid down, or blind ──────────────┴── fallen, lifted, blind, late ─┘
 *
 * Motors are off but in BALANCING. While a hand holds the body the wheels cannot do what the controller expects, and
 * within a few samples it would believe to fall: so it does not drive before it is let go. */
#ifndef BALANCER_H
#define BALANCER_H

#include "balancing_robot.h"
#include "hardware.h"

typedef enum { BALANCER_WAITING, BALANCER_READY, BALANCER_BALANCING } balancer_state_t;

/* Why it does not drive. */
typedef enum {
    BALANCER_NEW,    /* it has been switched on, or laid down */
    BALANCER_FALLEN, /* the body is too far from upright, or moves as if it were: held wheels look like that */
    BALANCER_LIFTED, /* the voltage has been at its limit for half a second: the wheels turn in the air */
    BALANCER_BLIND,  /* a sensor has been silent for a tenth of a second */
    BALANCER_LATE    /* five samples in a row took longer than the sample time */
} balancer_reason_t;

typedef struct {
    balancing_robot_t loop;
    balancer_state_t state;
    balancer_reason_t reason;
    unsigned still;                  /* samples that it has been held upright and still */
    float gyro_sum, gyro_offset;     /* rad/s; the offset is the mean of the second of waiting */
    float zero;                      /* rad: the wheels' mean angle when it became ready */
    float turn;                      /* rad: by how much the right wheel was ahead then */
    float voltage;                   /* V, of the last sample */
    unsigned limited, blind, late;   /* such samples in a row */
    unsigned in_time;                /* samples since the last that was late */
    sensors_t sensors;               /* of the last sample */
    unsigned long samples, overruns; /* since the start */
} balancer_t;

/* Waits; the motors are off. */
void balancer_init(balancer_t *self);

/* One sample, BALANCING_ROBOT_SAMPLE_TIME after the last: sensors, update, control, motors; then, off the critical
 * path, the prediction. */
void balancer_run_sample(balancer_t *self);

/* The last sample ended when the next one was due already. */
void balancer_note_overrun(balancer_t *self);

/* What it does, or what it waits for; a constant string. */
const char *balancer_text(const balancer_t *self);

#endif
