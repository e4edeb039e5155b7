/* SPDX-License-Identifier: MIT */
/* Start-up of a Cortex-M without an operating system. What the program writes with putchar(), and what
 * main() returns, goes to the PC by semihosting: an emulator or a debugger has to be there. */
#include <stdint.h>
#include <stdio.h>

int main(void);
void reset(void);
void board_leave(int status);

extern uint32_t stack_top[], data_start[], data_end[], bss_start[], bss_end[]; /* link.ld */
extern const uint32_t data_load[];

/* Arm, "Semihosting for AArch32 and AArch64", sections 7.6 and 7.19 */
enum { SYS_WRITEC = 0x03, SYS_EXIT_EXTENDED = 0x20, APPLICATION_EXIT = 0x20026, FAULT_STATUS = 99 };

static void ask_host(int operation, const void *argument)
{
    register int r0 __asm__("r0") = operation;
    register const void *r1 __asm__("r1") = argument;

    __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

/* Instead of the C library's: no buffers, no heap. */
int putchar(int character)
{
    const char byte = (char)character;

    ask_host(SYS_WRITEC, &byte);
    return (unsigned char)byte;
}

void board_leave(int status)
{
    const uint32_t reason[2] = {APPLICATION_EXIT, (uint32_t)status};

    for (;;)
        ask_host(SYS_EXIT_EXTENDED, reason);
}

/* What has to be done before a program that failed stops: nothing, unless it says so itself. */
void stop_outputs(void);

__attribute__((weak)) void stop_outputs(void) {}

static void fault(void)
{
    stop_outputs();
    board_leave(FAULT_STATUS);
}

/* Who wants them has his own, by Arm's usual names. */
__attribute__((weak, alias("fault"))) void SVC_Handler(void);
__attribute__((weak, alias("fault"))) void PendSV_Handler(void);
__attribute__((weak, alias("fault"))) void SysTick_Handler(void);

static void start_fpu(void)
{
#if defined __ARM_FP || defined __ARM_FEATURE_MVE
    volatile uint32_t *const coprocessor_access = (volatile uint32_t *)0xE000ED88u; /* CPACR */

    *coprocessor_access |= 0xFu << 20;
    __asm__ volatile("dsb\n\tisb" ::: "memory");
#endif
}

void reset(void)
{
    const uint32_t *from = data_load;

    start_fpu();
    for (uint32_t *to = data_start; to < data_end; to++)
        *to = *from++;
    for (uint32_t *to = bss_start; to < bss_end; to++)
        *to = 0;
    board_leave(main());
}

/* Initial stack pointer, reset, NMI and the faults; the interrupts of the core. */
typedef union {
    uint32_t *stack;
    void (*handler)(void);
} vector;

__attribute__((used, section(".vectors"))) static const vector vectors[16] = {
    {.stack = stack_top},
    {.handler = reset},
    {.handler = fault},
    {.handler = fault},
    {.handler = fault},
    {.handler = fault},
    {.handler = fault},
    [11] = {.handler = SVC_Handler},
    [14] = {.handler = PendSV_Handler},
    [15] = {.handler = SysTick_Handler},
};
