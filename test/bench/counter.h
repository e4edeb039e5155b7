/* SPDX-License-Identifier: MIT */
/* Counts instructions, exactly, in an emulator that counts time by them: QEMU with -icount. */
#ifndef BENCH_COUNTER_H
#define BENCH_COUNTER_H

#include <stdint.h>

typedef void function(void);

void start_counting(void);

/* Calls f(object, signals, results) on the stack that ends at `top`; returns what has passed since before the call, in
 * the counter's own unit. */
uint32_t ticks_of_call(void *object, const void *signals, void *results, function *f, uint32_t *top);

/* What `ticks` are in instructions. */
unsigned instructions_in(uint32_t ticks);

void do_nothing(void);                  /* one instruction, the return */
void do_nothing_a_thousand_times(void); /* 1001 */

#endif
