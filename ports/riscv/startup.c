/* SPDX-License-Identifier: MIT */
/* Start-up of a RISC-V without an operating system. What the program writes to stdout, and what main()
 * returns, goes to the PC by semihosting: an emulator or a debugger has to be there. */
#include <stdint.h>
#include <stdio.h>

int main(void);
void reset(void);
void board_leave(int status);
void start(void);
void fault(void);

extern uint64_t data_start[], data_end[], bss_start[], bss_end[]; /* link.ld */
extern const uint64_t data_load[];

/* The calls are Arm's: "Semihosting for AArch32 and AArch64", sections 7.6 and 7.19; how they are made: "RISC-V
 * Semihosting", section 2. */
enum { SYS_WRITEC = 0x03, SYS_EXIT_EXTENDED = 0x20, APPLICATION_EXIT = 0x20026, FAULT_STATUS = 99 };

static void ask_host(uintptr_t operation, const void *argument)
{
    register uintptr_t a0 __asm__("a0") = operation;
    register const void *a1 __asm__("a1") = argument;

    /* three instructions of full length in one page, by which the host knows the call */
    __asm__ volatile(
        ".option push\n\t"
        ".option norvc\n\t"
        ".balign 16\n\t"
        "slli zero, zero, 0x1f\n\t"
        "ebreak\n\t"
        "srai zero, zero, 7\n\t"
        ".option pop"
        : "+r"(a0)
        : "r"(a1)
        : "memory");
}

/* Picolibc's way to an output of one's own: no buffers, no heap. */
static int put_character(char character, FILE *file)
{
    (void)file;
    ask_host(SYS_WRITEC, &character);
    return (unsigned char)character;
}

static FILE to_host = FDEV_SETUP_STREAM(put_character, NULL, NULL, _FDEV_SETUP_WRITE);
FILE *const stdout = &to_host;

void board_leave(int status)
{
    const uintptr_t reason[2] = {APPLICATION_EXIT, (uintptr_t)status};

    for (;;)
        ask_host(SYS_EXIT_EXTENDED, reason);
}

__attribute__((aligned(4))) void fault(void)
{
    board_leave(FAULT_STATUS);
}

/* Memory is ready for C only after this; `reset` has set the stack. */
void start(void)
{
    const uint64_t *from = data_load;

    for (uint64_t *to = data_start; to < data_end; to++)
        *to = *from++;
    for (uint64_t *to = bss_start; to < bss_end; to++)
        *to = 0;
    board_leave(main());
}

/* The first instruction: global pointer, stack, traps, FPU. */
__attribute__((naked, used, section(".reset"))) void reset(void)
{
    __asm__ volatile(
        ".option push\n\t"
        ".option norelax\n\t"
        ".option arch, +zicsr\n\t"
        "la gp, global_pointer\n\t"
        "la sp, stack_top\n\t"
        "la t0, fault\n\t"
        "csrw mtvec, t0\n\t"
#ifdef __riscv_flen
        "li t0, 0x2000\n\t" /* mstatus.FS: initial */
        "csrs mstatus, t0\n\t"
        "csrw fcsr, zero\n\t"
#endif
        "j start\n\t"
        ".option pop");
}
