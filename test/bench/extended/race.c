/* SPDX-License-Identifier: MIT */
/* race NAME=CONTESTANT.so…: all contestants of a model in one process of this PC, in turns. Each round runs all samples
 * of each of them, another one first; what a round says is its time over that of the first NAME in the same round.
 * Prints "NAME NS RATIO ERROR": medians of all rounds, ns of a sample; ERROR as in answers.h. */
#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "answers.h"

enum { MOST = 16, ROUNDS = 201, TIMES = 4 };

typedef struct {
    const char *name;
    void (*init)(void);
    void (*sample)(const real_t u[NU], const real_t y[NY]);
    void (*estimate)(real_t x[NX], real_t P[NX][NX]);
    double ns[ROUNDS], ratio[ROUNDS], error;
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
    *(void **)&contestant->estimate = dlsym(library, "peer_estimate");
    return contestant->init && contestant->sample && contestant->estimate;
}

static void compare(contestant_t *contestant)
{
    real_t x[NX], P[NX][NX];

    contestant->init();
    for (unsigned k = 0; k < SAMPLES; k++) {
        contestant->sample(u_in[k], y_in[k]);
        contestant->estimate(x, P);
        contestant->error = larger(error_in_sample(k, x, P), contestant->error);
    }
}

static double now(void)
{
    struct timespec time;

    (void)clock_gettime(CLOCK_MONOTONIC, &time);
    return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

/* ns of a sample: all samples, a few times over, each time from the start. */
static double time_of(contestant_t *contestant)
{
    const double start = now();

    for (unsigned i = 0; i < TIMES; i++) {
        contestant->init();
        for (unsigned k = 0; k < SAMPLES; k++)
            contestant->sample(u_in[k], y_in[k]);
    }
    return (now() - start) / TIMES / SAMPLES;
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

    if (count < 1 || count > MOST)
        return 2;
    for (int i = 0; i < count; i++) {
        if (!load(&contestants[i], argv[1 + i]))
            return 2;
        compare(&contestants[i]);
    }
    for (int round = 0; round < ROUNDS; round++) {
        for (int i = 0; i < count; i++) {
            const int next = (i + round) % count;

            contestants[next].ns[round] = time_of(&contestants[next]);
        }
        for (int i = 0; i < count; i++)
            contestants[i].ratio[round] = contestants[i].ns[round] / contestants[0].ns[round];
    }
    for (int i = 0; i < count; i++)
        printf("%s %.1f %.3f %.2e\n", contestants[i].name, median(contestants[i].ns), median(contestants[i].ratio),
               contestants[i].error);
    return 0;
}
