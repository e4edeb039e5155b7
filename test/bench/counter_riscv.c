/* SPDX-License-Identifier: MIT */
/* minstret, which counts instructions by definition; in QEMU it does with -icount shift=0, and with another shift their
 * time in ns. */
#include "counter.h"

#if __riscv_xlen == 64
#define STORE "sd"
#define LOAD "ld"
#else
#define STORE "sw"
#define LOAD "lw"
#endif

__asm__(
    ".global ticks_of_call, do_nothing, do_nothing_a_thousand_times\n"
    ".option push\n"
    ".option arch, +zicsr\n"
    "ticks_of_call:\n"
    "    addi sp, sp, -32\n"
    "    " STORE
    " ra, 0(sp)\n"
    "    " STORE
    " s0, 8(sp)\n"
    "    " STORE
    " s1, 16(sp)\n"
    "    mv s0, sp\n"
    "    mv sp, a4\n"
    "    csrr s1, minstret\n"
    "    jalr a3\n"
    "    csrr a0, minstret\n"
    "    mv sp, s0\n"
    "    sub a0, a0, s1\n"
    "    " LOAD
    " ra, 0(sp)\n"
    "    " LOAD
    " s0, 8(sp)\n"
    "    " LOAD
    " s1, 16(sp)\n"
    "    addi sp, sp, 32\n"
    "    ret\n"
    "do_nothing_a_thousand_times:\n"
    ".rept 1000\n"
    "    nop\n"
    ".endr\n"
    "do_nothing:\n"
    "    ret\n"
    ".option pop\n");

void start_counting(void) {}

unsigned instructions_in(uint32_t ticks)
{
    return ticks;
}
