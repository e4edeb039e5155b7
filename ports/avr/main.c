/* SPDX-License-Identifier: MIT */
/* How long one sample of a controller takes on an AVR: prints the cycles of update, control and predict, the mean and
 * the most of 100 samples of small random outputs. Timer 1 counts them, eight at a time.
 *
 * The build defines HEADER "dc_motor.h", NAME dc_motor, NU and NY as DC_MOTOR_NU, DC_MOTOR_NY. */
#include <stdio.h>

#include <avr/io.h>

#include HEADER

#define JOINED(name, end) name##end
#define WITH_NAME(name, end) JOINED(name, end)
#define TEXT(name) #name
#define TEXT_OF(name) TEXT(name)

enum { SAMPLES = 100, CYCLES_A_TICK = 8 };

typedef struct {
    const char *name;
    unsigned long sum;
    unsigned most; /* ticks */
} record_t;

static void begin_measuring(void)
{
    TCNT1 = 0;
}

static void end_measuring(record_t *record)
{
    const unsigned ticks = TCNT1;

    record->sum += ticks;
    record->most = ticks > record->most ? ticks : record->most;
}

/* Uniform in [−0.01, 0.01). */
static float draw(unsigned long *seed)
{
    *seed = *seed * 1664525ul + 1013904223ul;
    return ((float)(*seed >> 16) - 32768.0f) * (0.01f / 32768.0f);
}

int main(void)
{
    static record_t update = {"update", 0, 0}, control = {"control", 0, 0}, predict = {"predict", 0, 0};
    const record_t *const records[] = {&update, &control, &predict};
    static WITH_NAME(NAME, _t) loop;
    static float y[NY], u[NU];
    unsigned long seed = 1;
    lqg_status_t status = LQG_OK;

    TCCR1A = 0;
    TCCR1B = 1 << CS11; /* clock/8 */
    WITH_NAME(NAME, _init)(&loop);
    for (int k = 0; k < SAMPLES; k++) {
        for (int i = 0; i < NY; i++)
            y[i] = draw(&seed);
        begin_measuring();
        status |= WITH_NAME(NAME, _update)(&loop, y);
        end_measuring(&update);
        begin_measuring();
        status |= WITH_NAME(NAME, _control)(&loop, u);
        end_measuring(&control);
        begin_measuring();
        status |= WITH_NAME(NAME, _predict)(&loop, u);
        end_measuring(&predict);
    }

    printf(TEXT_OF(NAME) ", %d bytes of state, cycles (mean, most):", (int)sizeof loop);
    for (int i = 0; i < 3; i++)
        printf(" %s %lu %lu", records[i]->name, records[i]->sum * CYCLES_A_TICK / SAMPLES,
               (unsigned long)records[i]->most * CYCLES_A_TICK);
    printf("\n");
    return status & LQG_STATE_RESET ? 1 : 0;
}
