/* SPDX-License-Identifier: MIT */
/* What each sample took. */
#ifndef TIMING_H
#define TIMING_H

#include "protocol.h"
#include "target.h"

enum { TIMING_UPDATE, TIMING_CONTROL, TIMING_PREDICT, TIMING_ALL, TIMING_ROUND_TRIP, TIMING_ROWS };

typedef struct {
    unsigned count;
    double *rows[TIMING_ROWS]; /* `count` numbers each: of `unit`, and µs of the round trip */
    const char *unit;     /* "cycles", emulated "instructions"; "ticks" of a counter that is too coarse for these */
    double ticks_of_unit; /* ticks of the target's counter for one of them, > 0 */
    double frequency;     /* Hz of the processor; 0: emulated */
} timing_t;

/* Emulated: the counter's ticks are turned into instructions by what the target measured of a thousand of them. Returns
 * 0, or −1: no memory. */
int timing_start(timing_t *timing, unsigned count, const pil_hello_t *hello, int emulated);
void timing_end(timing_t *timing);

void timing_add(timing_t *timing, unsigned sample, const answer_t *answer);

/* The first `count` samples as a table on standard output. */
void timing_print(const timing_t *timing, unsigned count);

/* Every sample, comma-separated. Returns 0, or −1 if it cannot be written. */
int timing_write_csv(const timing_t *timing, unsigned count, const char *path);

#endif
