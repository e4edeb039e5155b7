/* SPDX-License-Identifier: MIT */
/* mcycle, whose lower 32 bits are enough. QEMU's counts the nanoseconds of its virtual time: with -icount shift=0 that
 * is one for each instruction. LQG_FREQUENCY is the processor's in Hz, where it is real. */
#include "board.h"

const uint32_t counter_mask = 0xFFFFFFFF;
const uint32_t counter_frequency = LQG_FREQUENCY;

void counter_start(void) {}

uint32_t counter_now(void)
{
    unsigned long cycles;

    __asm__ volatile(
        ".option push\n\t"
        ".option arch, +zicsr\n\t"
        "csrr %0, mcycle\n\t"
        ".option pop"
        : "=r"(cycles)
        :
        : "memory");
    return (uint32_t)cycles;
}
