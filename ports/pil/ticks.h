/* SPDX-License-Identifier: MIT */
/* What a counter says of a step: for the target, and for the test of it. */
#ifndef PIL_TICKS_H
#define PIL_TICKS_H

#include <stdint.h>

/* Ticks between two readings of a counter that wraps at mask + 1, less those that measuring takes by itself. A step
 * that took less than that counts 0. `mask` is 2ⁿ − 1, n of 1 to 32. Of a step that takes more than `mask` ticks whole
 * turns are lost. */
static inline uint32_t pil_ticks(uint32_t before, uint32_t after, uint32_t mask, uint32_t ticks_of_frame)
{
    const uint32_t ticks = (after - before) & mask;

    return ticks > ticks_of_frame ? ticks - ticks_of_frame : 0;
}

#endif
