/* SPDX-License-Identifier: MIT */
/* The balancing robot without an operating system: SysTick, once a sample, runs the loop; what is left of the time goes
 * to the report. ROBOT_CLOCK is the processor's in Hz. */
#include "../balancer.h"
#include "../hardware.h"
#include "../report.h"
#include "board.h"

#define SYSTICK_CONTROL (*(volatile uint32_t *)0xE000E010u)
#define SYSTICK_RELOAD (*(volatile uint32_t *)0xE000E014u)
#define SYSTICK_CURRENT (*(volatile uint32_t *)0xE000E018u)
#define INTERRUPT_STATE (*(volatile uint32_t *)0xE000ED04u) /* ICSR */

enum { ENABLE = 1 << 0, INTERRUPT = 1 << 1, PROCESSOR_CLOCK = 1 << 2 };
enum { SYSTICK_PENDING = 1 << 26 };
enum { SAMPLES_OF_A_REPORT = 50 };

static balancer_t balancer;

void SysTick_Handler(void);

/* The next tick is pending already: this sample took too long. */
void SysTick_Handler(void)
{
    balancer_run_sample(&balancer);
    if (INTERRUPT_STATE & SYSTICK_PENDING)
        balancer_note_overrun(&balancer);
}

static void start_clock(void)
{
    SYSTICK_RELOAD = (uint32_t)((float)ROBOT_CLOCK * BALANCING_ROBOT_SAMPLE_TIME + 0.5f) - 1;
    SYSTICK_CURRENT = 0;
    SYSTICK_CONTROL = ENABLE | INTERRUPT | PROCESSOR_CLOCK;
}

/* As it was between two samples. */
static balancer_t snapshot(void)
{
    balancer_t copy;

    __asm__ volatile("cpsid i" ::: "memory");
    copy = balancer;
    __asm__ volatile("cpsie i" ::: "memory");
    return copy;
}

int main(void)
{
    unsigned long reported = 0;

    uart_start();
    hardware_start();
    balancer_init(&balancer);
    start_clock();
    for (;;) {
        const balancer_t now = snapshot();

        if (now.samples - reported >= SAMPLES_OF_A_REPORT) {
            reported = now.samples;
            report_balancer(&now);
        }
        __asm__ volatile("wfi");
    }
}
