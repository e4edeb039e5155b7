/* SPDX-License-Identifier: MIT */
/* TIMER0 of the nRF51822, at the processor's 16 MHz: the nRF51 has no SysTick. Nordic, "nRF51 Series Reference Manual",
 * chapter 18. */
#include "board.h"

#define TIMER 0x40008000u
#define REGISTER(offset) (*(volatile uint32_t *)(TIMER + (offset)))

#define START REGISTER(0x000)
#define CLEAR REGISTER(0x00C)
#define CAPTURE REGISTER(0x040)
#define MODE REGISTER(0x504)
#define BITS REGISTER(0x508)
#define PRESCALER REGISTER(0x510)
#define CAPTURED REGISTER(0x540)

enum { TIMER_MODE = 0, BITS_32 = 3 };

const uint32_t counter_mask = 0xFFFFFFFF;
const uint32_t counter_frequency = LQG_FREQUENCY;

void counter_start(void)
{
    MODE = TIMER_MODE;
    BITS = BITS_32;
    PRESCALER = 0;
    CLEAR = 1;
    START = 1;
}

uint32_t counter_now(void)
{
    CAPTURE = 1;
    return CAPTURED;
}
