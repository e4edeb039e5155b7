/* SPDX-License-Identifier: MIT */
/* SysTick, which counts down at MEGAHERTZ, the processor's clock in the emulated machine. With -icount shift=8 an
 * instruction takes 256 ns, four ticks and more, so that the rounded quotient is exact, up to two million of them. On a
 * board it would count cycles. */
#include "counter.h"

#define SYSTICK_CONTROL (*(volatile uint32_t *)0xE000E010u)
#define SYSTICK_RELOAD (*(volatile uint32_t *)0xE000E014u)
#define SYSTICK_CURRENT (*(volatile uint32_t *)0xE000E018u)

enum { SYSTICK_MASK = 0xFFFFFF };

/* The lower 24 bits of the first result are the ticks. */
uint32_t difference_of_call(void *object, const void *signals, void *results, function *f, uint32_t *top);

__asm__(
    ".global do_nothing, do_nothing_a_thousand_times\n"
    ".syntax unified\n"
    ".thumb_func\n"
    "difference_of_call:\n"
    "    push {r4-r7, lr}\n"
    "    ldr r7, [sp, #20]\n" /* top */
    "    mov r4, sp\n"
    "    mov sp, r7\n"
    "    ldr r5, =0xE000E018\n"
    "    ldr r6, [r5]\n"
    "    blx r3\n"
    "    ldr r0, [r5]\n"
    "    mov sp, r4\n"
    "    subs r0, r6, r0\n"
    "    pop {r4-r7, pc}\n"
    ".ltorg\n"
    ".thumb_func\n"
    "do_nothing_a_thousand_times:\n"
    ".rept 1000\n"
    "    nop\n"
    ".endr\n"
    ".thumb_func\n"
    "do_nothing:\n"
    "    bx lr\n");

void start_counting(void)
{
    SYSTICK_RELOAD = SYSTICK_MASK;
    SYSTICK_CURRENT = 0;
    SYSTICK_CONTROL = 5; /* on, with the processor's clock */
}

uint32_t ticks_of_call(void *object, const void *signals, void *results, function *f, uint32_t *top)
{
    return difference_of_call(object, signals, results, f, top) & SYSTICK_MASK;
}

/* An instruction is 256 ns, or 256 MEGAHERTZ / 1000 = 32 MEGAHERTZ / 125 ticks. */
unsigned instructions_in(uint32_t ticks)
{
    return (125 * ticks + 16 * MEGAHERTZ) / (32 * MEGAHERTZ);
}
