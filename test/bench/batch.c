/* SPDX-License-Identifier: MIT */
/* Nanoseconds that a sample of one instance takes, by NAME_step and by NAME_batch_step: the best of ROUNDS, in turn.
 * NAME, UPPER, REAL and, by HEADER, the controller are given; TOLD_U where u is an input. Prints both, and the share of
 * the samples in which nothing but a limit of u was to be reported. The instances stay in the first-level cache. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include HEADER

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)
#define SIZE(part) JOIN(UPPER, part)
#define LANES SIZE(BATCH_LANES)

enum { BATCHES = 4, SAMPLES = 256, ROUNDS = 200 };

static OF(t) alone[BATCHES][LANES];
static OF(batch_t) batches[BATCHES];
static REAL y_of_lanes[SAMPLES][SIZE(NY)][LANES], y_alone[SAMPLES][LANES][SIZE(NY)];
static REAL u_of_lanes[SIZE(NU)][LANES], u_alone[LANES][SIZE(NU)];
static lqg_status_t status[LANES];

static double now(void)
{
    struct timespec time;

    clock_gettime(CLOCK_MONOTONIC, &time);
    return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

/* Small noise, of which no output is rejected. */
static void draw_outputs(void)
{
    unsigned long long seed = 1;

    for (int k = 0; k < SAMPLES; k++)
        for (int i = 0; i < SIZE(NY); i++)
            for (int lane = 0; lane < LANES; lane++) {
                seed = seed * 6364136223846793005u + 1442695040888963407u;
                y_of_lanes[k][i][lane] = (REAL)1e-4 * ((REAL)(seed >> 48) / 32768 - 1);
                y_alone[k][lane][i] = y_of_lanes[k][i][lane];
            }
}

static double time_alone(void)
{
    const double start = now();

    for (int k = 0; k < SAMPLES; k++)
        for (int b = 0; b < BATCHES; b++)
            for (int lane = 0; lane < LANES; lane++)
                status[lane] = OF(step)(&alone[b][lane], y_alone[k][lane], u_alone[lane]);
    return (now() - start) / ((double)SAMPLES * BATCHES * LANES);
}

static double time_batches(long *good)
{
    const double start = now();
    double time;

    for (int k = 0; k < SAMPLES; k++)
        for (int b = 0; b < BATCHES; b++)
            OF(batch_step)(&batches[b], y_of_lanes[k], u_of_lanes, status);
    time = (now() - start) / ((double)SAMPLES * BATCHES * LANES);
    for (int lane = 0; lane < LANES; lane++)
        *good += (status[lane] & ~LQG_INPUT_LIMITED) == LQG_OK;
    return time;
}

static int same_states(void)
{
    OF(t) got;

    for (int b = 0; b < BATCHES; b++)
        for (int lane = 0; lane < LANES; lane++) {
            OF(batch_get)(&batches[b], lane, &got);
            if (got.resets != alone[b][lane].resets || u_of_lanes[0][lane] != u_alone[lane][0])
                return 0;
        }
    return 1;
}

int main(void)
{
    double best_alone = 1e9, best_batch = 1e9;
    long good = 0;

    draw_outputs();
    for (int b = 0; b < BATCHES; b++) {
        OF(batch_init)(&batches[b]);
        for (int lane = 0; lane < LANES; lane++)
            OF(init)(&alone[b][lane]);
    }
    for (int round = 0; round < ROUNDS; round++) {
        const double one = time_alone(), other = time_batches(&good);

        best_alone = one < best_alone ? one : best_alone;
        best_batch = other < best_batch ? other : best_batch;
    }
    if (!same_states()) {
        fprintf(stderr, "the two find another u or other resets\n");
        return EXIT_FAILURE;
    }
    printf("%.3f %.3f %.3f\n", best_alone, best_batch, (double)good / ((double)ROUNDS * LANES));
    return EXIT_SUCCESS;
}
