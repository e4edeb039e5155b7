/* SPDX-License-Identifier: MIT */
/* race NAME=CONTESTANT.so…: all contestants of a model in one process of this PC, in turns. Each round runs all samples
 * of each of them, another one first; what a round says is its time over that of the first NAME in the same round, so
 * that whatever else the PC does meets all alike. Prints "NAME NS RATIO ERROR": medians of all rounds, ns of a sample;
 * ERROR as in loop.h. The measurements are those of the contestant's own loop,
 * recorded before: the plant costs no time. */
#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "loop.h"

enum { SAMPLES = sizeof w_in / sizeof w_in[0], MOST = 16, ROUNDS = 201, ROUND_NS = 200000 };

typedef struct {
    const char *name;
    void (*init)(void);
    void (*sample)(void *unused, const float y[NY], float u[NU]);
    float y[SAMPLES][NY], u[NU];
    double ns[ROUNDS], ratio[ROUNDS];
} contestant_t;

static contestant_t contestants[MOST];

static int load(contestant_t *contestant, char *argument)
{
    char *equals = strchr(argument, '=');
    void *library = equals ? dlopen(equals + 1, RTLD_NOW | RTLD_LOCAL) : NULL;

    if (!library) {
        fprintf(stderr, "race: expected NAME=CONTESTANT.so, found %s\n", argument);
        return 0;
    }
    *equals = '\0';
    contestant->name = argument;
    *(void **)&contestant->init = dlsym(library, "peer_init");
    *(void **)&contestant->sample = dlsym(library, "peer_sample");
    return contestant->init && contestant->sample;
}

static void run_loop(contestant_t *contestant)
{
    float x[NX] = {0};

    contestant->init();
    for (unsigned k = 0; k < SAMPLES; k++) {
        measure_plant(x, v_in[k], contestant->y[k]);
        contestant->sample(NULL, contestant->y[k], contestant->u);
        move_plant(x, contestant->u, w_in[k]);
    }
}

static double now(void)
{
    struct timespec time;

    (void)clock_gettime(CLOCK_MONOTONIC, &time);
    return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

/* ns of a sample: all samples, `times` over, each time from the start. */
static double time_of(contestant_t *contestant, unsigned times)
{
    const double start = now();

    for (unsigned i = 0; i < times; i++) {
        contestant->init();
        for (unsigned k = 0; k < SAMPLES; k++)
            contestant->sample(NULL, contestant->y[k], contestant->u);
    }
    return (now() - start) / times / SAMPLES;
}

static int ascending(const void *a, const void *b)
{
    const double first = *(const double *)a, second = *(const double *)b;

    return (first > second) - (first < second);
}

static double median(double values[ROUNDS])
{
    qsort(values, ROUNDS, sizeof values[0], ascending);
    return values[ROUNDS / 2];
}

int main(int argc, char *argv[])
{
    const int count = argc - 1;
    unsigned times[MOST];

    if (count < 1 || count > MOST)
        return 2;
    for (int i = 0; i < count; i++) {
        if (!load(&contestants[i], argv[1 + i]))
            return 2;
        run_loop(&contestants[i]);
        times[i] = 1 + (unsigned)(ROUND_NS / (SAMPLES * time_of(&contestants[i], 3)));
    }
    for (int round = 0; round < ROUNDS; round++) {
        for (int i = 0; i < count; i++) {
            const int next = (i + round) % count;

            contestants[next].ns[round] = time_of(&contestants[next], times[next]);
        }
        for (int i = 0; i < count; i++)
            contestants[i].ratio[round] = contestants[i].ns[round] / contestants[0].ns[round];
    }
    for (int i = 0; i < count; i++)
        printf("%s %.1f %.3f %u\n", contestants[i].name, median(contestants[i].ns), median(contestants[i].ratio),
               error_of(contestants[i].u));
    return 0;
}
