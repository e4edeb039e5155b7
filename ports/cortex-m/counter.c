/* SPDX-License-Identifier: MIT */
/* SysTick, with the processor's clock: 24 bits, counting down. The cycle counter of the debug unit would have 32 bits,
 * but not every core has one, and QEMU's does not move. LQG_FREQUENCY is the processor's in Hz, where it is real. */
#include "board.h"

#define SYSTICK_CONTROL (*(volatile uint32_t *)0xE000E010u)
#define SYSTICK_RELOAD (*(volatile uint32_t *)0xE000E014u)
#define SYSTICK_CURRENT (*(volatile uint32_t *)0xE000E018u)

enum { ENABLE = 1 << 0, PROCESSOR_CLOCK = 1 << 2 };

const uint32_t counter_mask = 0xFFFFFF;
const uint32_t counter_frequency = LQG_FREQUENCY;

void counter_start(void)
{
    SYSTICK_RELOAD = 0xFFFFFF;
    SYSTICK_CURRENT = 0;
    SYSTICK_CONTROL = ENABLE | PROCESSOR_CLOCK;
}

uint32_t counter_now(void)
{
    return 0xFFFFFF - SYSTICK_CURRENT;
}
