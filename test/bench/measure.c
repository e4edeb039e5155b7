/* What the controller in HEADER costs on a Cortex-M4F: instructions executed and stack used by each of its
 * functions, for the reference samples in VECTORS. NAME and UPPER_NAME are its names, REAL its scalar; ESTIMATES
 * says that it has no input.
 *
 * Made for QEMU with -icount shift=8, where every instruction takes 256 ns of virtual time: SysTick, at 25 MHz,
 * then counts instructions. On a board it would count cycles. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include HEADER
#include VECTORS /* y_in, u_out */

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)
#define SIZE(part) JOIN(UPPER_NAME, part)

enum { SAMPLES = sizeof y_in / sizeof y_in[0], NY = SIZE(NY) };

/* ---- the instruments --------------------------------------------------------------------------------- */

#define SYSTICK_CONTROL (*(volatile uint32_t *)0xE000E010u)
#define SYSTICK_RELOAD (*(volatile uint32_t *)0xE000E014u)
#define SYSTICK_CURRENT (*(volatile uint32_t *)0xE000E018u)

enum { SYSTICK_MASK = 0xFFFFFF, TICKS_OF_TEN = 64 /* instructions: 2560 ns */ };
enum { STACK_WORDS = 4096, UNTOUCHED = 0x5AA5C33C };

typedef void function(void);

/* Calls f(object, signals) on the stack that ends at `top`; returns the ticks that it took. */
uint32_t ticks_of_call(void *object, const void *signals, function *f, uint32_t *top);
void do_nothing(void);
void do_nothing_a_hundred_times(void);

__asm__(".syntax unified\n"
        ".thumb_func\n"
        "ticks_of_call:\n"
        "    push {r4-r6, lr}\n"
        "    mov r4, sp\n"
        "    mov sp, r3\n"
        "    ldr r5, =0xE000E018\n"
        "    ldr r6, [r5]\n"
        "    blx r2\n"
        "    ldr r0, [r5]\n"
        "    mov sp, r4\n"
        "    subs r0, r6, r0\n"
        "    bic r0, r0, #0xFF000000\n"
        "    pop {r4-r6, pc}\n"
        ".ltorg\n"
        ".thumb_func\n"
        "do_nothing_a_hundred_times:\n"
        ".rept 100\n"
        "    nop\n"
        ".endr\n"
        ".thumb_func\n"
        "do_nothing:\n"
        "    bx lr\n");

typedef struct {
    unsigned instructions, stack;
} cost_t;

static cost_t cost_of(function *f, void *object, const void *signals)
{
    static uint32_t stack[STACK_WORDS];
    unsigned untouched = 0;

    for (unsigned i = 0; i < STACK_WORDS; i++)
        stack[i] = UNTOUCHED;

    const uint32_t frame = ticks_of_call(NULL, NULL, do_nothing, stack + STACK_WORDS);
    const uint32_t ticks = ticks_of_call(object, signals, f, stack + STACK_WORDS);

    while (untouched < STACK_WORDS && stack[untouched] == UNTOUCHED)
        untouched++;
    return (cost_t){
        .instructions = 1 + (10 * (ticks - frame) + TICKS_OF_TEN / 2) / TICKS_OF_TEN, /* 1: do_nothing's own */
        .stack = 4 * (STACK_WORDS - untouched),
    };
}

static void start_counting(void)
{
    SYSTICK_RELOAD = SYSTICK_MASK;
    SYSTICK_CURRENT = 0;
    SYSTICK_CONTROL = 5; /* on, with the processor's clock */
}

static int counts_right(void)
{
    return cost_of(do_nothing_a_hundred_times, NULL, NULL).instructions == 101;
}

/* ---- the samples ------------------------------------------------------------------------------------- */

enum { UPDATE, CONTROL, PREDICT, FUNCTIONS };

typedef struct {
    unsigned instructions[SAMPLES]; /* of the last run */
    unsigned most, stack;           /* of all runs */
} record_t;

static record_t records[FUNCTIONS];

static unsigned larger(unsigned a, unsigned b)
{
    return a > b ? a : b;
}

static void measure(record_t *record, unsigned sample, function *f, void *object, const void *signals)
{
    const cost_t cost = cost_of(f, object, signals);

    record->instructions[sample] = cost.instructions;
    record->most = larger(record->most, cost.instructions);
    record->stack = larger(record->stack, cost.stack);
}

/* All samples; output `left_out` is missing in every third, or none where there is no such output. */
static void run(unsigned left_out)
{
    OF(t) self;
    REAL y[NY];
#ifndef ESTIMATES
    REAL u[SIZE(NU)];
#endif

    OF(init)(&self);
    for (unsigned k = 0; k < SAMPLES; k++) {
        for (unsigned i = 0; i < NY; i++)
            y[i] = i == left_out && k % 3 == 1 ? (REAL)NAN : y_in[k][i];
        measure(&records[UPDATE], k, (function *)OF(update), &self, y);
#ifdef ESTIMATES
        measure(&records[PREDICT], k, (function *)OF(predict), &self, NULL);
#else
        measure(&records[CONTROL], k, (function *)OF(control), &self, u);
        measure(&records[PREDICT], k, (function *)OF(predict), &self, u_out[k]);
#endif
    }
}

/* ---- the report -------------------------------------------------------------------------------------- */

static void print_number(unsigned number)
{
    if (number >= 10)
        print_number(number / 10);
    putchar((int)('0' + number % 10));
}

static void print(const char *name, unsigned number)
{
    while (*name)
        putchar(*name++);
    putchar('=');
    print_number(number);
    putchar('\n');
}

static int ascending(const void *a, const void *b)
{
    const unsigned first = *(const unsigned *)a, second = *(const unsigned *)b;

    return (first > second) - (first < second);
}

static unsigned median(record_t *record)
{
    qsort(record->instructions, SAMPLES, sizeof record->instructions[0], ascending);
    return record->instructions[SAMPLES / 2];
}

/* Lines that a shell can read as assignments. */
int main(void)
{
    start_counting();
    if (!counts_right())
        return 1;

    for (unsigned left_out = 0; left_out < NY; left_out++)
        run(left_out);
    run(NY); /* the last, whose instructions stay in the records: the samples as they are */
    print("update", median(&records[UPDATE]));
    print("control", median(&records[CONTROL]));
    print("predict", median(&records[PREDICT]));
    print("most_update", records[UPDATE].most);
    print("most_control", records[CONTROL].most);
    print("most_predict", records[PREDICT].most);
    print("stack", larger(larger(records[UPDATE].stack, records[CONTROL].stack), records[PREDICT].stack));
    print("ram", sizeof(OF(t)));
    return 0;
}
