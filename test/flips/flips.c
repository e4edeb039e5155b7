/* SPDX-License-Identifier: MIT */
/* Every bit of a controller's state, flipped once, in closed loop: after RECOVERY_SAMPLES the loop with the flip is
 * where its twin is that had none and hears the same noise. closed_loop.h has the loop.
 *
 *     flips [sample [list]]      sample: so many flips, evenly; 0: all
 *
 * Exit status 0: all flips are forgotten, or the plant is beyond what u can bring back; 1: some are not. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "closed_loop.h"

/* The loops are apart by what the noise explains when no state differs by more standard deviations of its estimate. The
 * promise is made for one; three leave room for what P and the roundings add. */
#define DEVIATIONS 3

/* More samples are not kept: there a flip has to be forgotten sooner than is promised. */
enum { MOST_SAMPLES = 200000, PROMISED = RECOVERY_SAMPLES < MOST_SAMPLES ? RECOVERY_SAMPLES : MOST_SAMPLES };
enum { MEMBERS = sizeof members / sizeof *members, WATCHED = 200 }; /* samples after the promise */

/* So many samples in a row with a hundredth of the difference: it is followed no further. */
enum { QUIET_SAMPLES = 1000 };

/* A flip comes before the first call of a sample, or behind the first or second one. */
static const struct instant {
    int sample, phase;
} instants[] = {{0, 0}, {0, 1}, {40, 1}, {300, 2}};
enum {
    INSTANTS = sizeof instants / sizeof *instants,
    LAST_INSTANT = 300,
    SAMPLES = LAST_INSTANT + PROMISED + WATCHED + 1
};

static struct drawn drawn[SAMPLES];
static struct loop twin[SAMPLES + 1]; /* before each sample */

/* ---- noise: normal numbers as sums of twelve uniform ones
 * ------------------------------------------------------------ */

static double uniform(unsigned long long *seed)
{
    *seed = *seed * 6364136223846793005ull + 1442695040888963407ull;
    return (double)(*seed >> 11) / 9007199254740992.0 - 0.5;
}

static double normal(unsigned long long *seed)
{
    double sum = 0;
    for (int i = 0; i < 12; i++)
        sum += uniform(seed);
    return sum;
}

static void draw_all(void)
{
    unsigned long long seed = 1;
    for (int k = 0; k < SAMPLES; k++) {
        double white[NX + NY];
        for (int i = 0; i < NX + NY; i++)
            white[i] = normal(&seed);
        colour(&drawn[k], white);
        for (int j = 0; j < NU; j++)
            drawn[k].u[j] = uniform(&seed);
    }
}

/* ---- a flip ------------------------------------------------------------------------------------------------------ */

struct flip {
    const struct member *of;
    int number, bit;
    struct instant at;
};

struct moment {
    const struct flip *flip;
    int sample;
};

static void flip_bit(struct loop *loop, int phase, const void *of)
{
    const struct moment *now = of;
    const struct flip *flip = now->flip;
    if (!flip || flip->at.sample != now->sample || flip->at.phase != phase)
        return;
    unsigned char *byte = (unsigned char *)&loop->controller + flip->of->offset + (size_t)flip->number * flip->of->each;
    byte[flip->bit / 8] ^= (unsigned char)(1u << flip->bit % 8);
}

static void run(struct loop *loop, const struct flip *flip, int sample)
{
    const struct moment now = {flip, sample};
    const struct visitor visitor = {flip_bit, &now};
    run_sample(loop, &drawn[sample], visitor);
}

/* ---- what is asked
 * --------------------------------------------------------------------------------------------------- */

static real number_of(const struct loop *loop, const struct member *of, size_t i)
{
    real value;
    memcpy(&value, (const unsigned char *)&loop->controller + of->offset + i * of->each, sizeof value);
    return value;
}

static int is_finite(const struct loop *loop)
{
    for (int m = 0; m < MEMBERS; m++)
        for (size_t i = 0; members[m].is_real && i < members[m].size / members[m].each; i++)
            if (!isfinite(number_of(loop, &members[m], i)))
                return 0;
    return 1;
}

/* u is within its limits, but for their rounding. */
static int is_limited(const struct loop *loop)
{
    for (int j = 0; j < NU; j++)
        if (!isfinite(loop->u[j]) || (double)loop->u[j] < u_min[j] - 1e-6 * fabs(u_min[j]) ||
            (double)loop->u[j] > u_max[j] + 1e-6 * fabs(u_max[j]))
            return 0;
    return 1;
}

static int is_same(const struct loop *a, const struct loop *b)
{
    for (int m = 0; m < MEMBERS; m++)
        if (memcmp((const unsigned char *)&a->controller + members[m].offset,
                   (const unsigned char *)&b->controller + members[m].offset, members[m].size) != 0)
            return 0;
    return memcmp(a->x, b->x, sizeof a->x) == 0 && memcmp(a->u, b->u, sizeof a->u) == 0;
}

#ifndef KEEPS_Z
static void read_estimate(const struct loop *loop, real x[NX])
{
#ifdef KEEPS_MODES
    OF(estimate)(&loop->controller, x);
#else
    memcpy(x, loop->controller.x, sizeof loop->controller.x);
#endif
}
#endif

/* The plant's states and those of the estimate, in standard deviations: the largest difference. */
static double distance(const struct loop *a, const struct loop *b)
{
    double most = 0;
#ifndef KEEPS_Z
    real x_of_a[NX], x_of_b[NX];
    read_estimate(a, x_of_a);
    read_estimate(b, x_of_b);
#endif
    for (int i = 0; i < NX; i++) {
        if (is_lasting[i] != 0)
            continue;
        double apart = fabs(a->x[i] - b->x[i]);
#ifndef KEEPS_Z
        const double estimates = fabs((double)x_of_a[i] - (double)x_of_b[i]);
        if (!(estimates <= apart))
            apart = estimates;
#endif
        if (isnan(apart))
            return INFINITY;
        most = fmax(most, apart / within[i]);
    }
    return most;
}

/* u has no limit, and a wrong one has driven the plant to where its controller's own state may not be. */
static int is_beyond_bounds(const struct loop *loop)
{
    for (int i = 0; !HAS_LIMITS && i < NX; i++)
        if (!(fabs(loop->x[i]) < x_bound[i]))
            return 1;
    return 0;
}

enum outcome { FORGOTTEN, LATE, NEVER, UNSOUND, BEYOND_U, BEYOND_BOUNDS, OUTCOMES };
static const char *const words[OUTCOMES] = {"forgotten", "late",     "not forgotten",
                                            "unsound",   "beyond u", "beyond bounds"};

/* What becomes of one flip, and the samples until it is forgotten. */
static enum outcome follow(const struct flip *flip, int *samples)
{
    struct loop loop = twin[flip->at.sample];
    const int end = flip->at.sample + PROMISED + WATCHED;
    int quiet = 0;
    *samples = 0;
    for (int k = flip->at.sample; k < end; k++) {
        run(&loop, flip, k);
        if (!is_limited(&loop) ||
            (k > flip->at.sample && !is_finite(&loop))) /* a flip alone can make a number infinite */
            return UNSOUND;
        if (is_same(&loop, &twin[k + 1]))
            break;
        const double apart = distance(&loop, &twin[k + 1]);
        if (!(apart <= DEVIATIONS))
            *samples = k + 1 - flip->at.sample;
        quiet = apart <= DEVIATIONS / 100.0 ? quiet + 1 : 0;
        if (quiet == QUIET_SAMPLES)
            break;
        if (is_beyond_u(&loop))
            return BEYOND_U;
        if (is_beyond_bounds(&loop))
            return BEYOND_BOUNDS;
    }
    if (*samples <= PROMISED)
        return FORGOTTEN;
    return *samples < PROMISED + WATCHED ? LATE : NEVER;
}

static void run_twin(void)
{
    draw_all();
    begin_loop(&twin[0]);
    for (int k = 0; k < SAMPLES; k++) {
        twin[k + 1] = twin[k];
        run(&twin[k + 1], NULL, k);
    }
}

/* Without a flip the plant runs away, unstable and alone or beyond its limits: x̂ is rounded to more than is known of
 * it. */
static int runs_away(void)
{
    const double most = sizeof(real) == sizeof(float) ? 0x1p20 : 0x1p49;
    for (int k = 0; k < SAMPLES; k++)
        for (int i = 0; i < NX; i++)
            if (!(fabs(twin[k].x[i]) <= most * within[i]))
                return 1;
    return 0;
}

static void report(const struct flip *flip, enum outcome outcome, int samples)
{
    printf("%s: %s[%d], bit %d, before call %d of sample %d, after %d samples\n", words[outcome], flip->of->name,
           flip->number, flip->bit, flip->at.phase, flip->at.sample, samples);
}

int main(int count, char *arguments[])
{
    const long sample = count > 1 ? atol(arguments[1]) : 0;
    const int lists = count > 2 && atoi(arguments[2]);
    long all = 0, found[OUTCOMES] = {0}, every = 1, at = 0;
    int longest = 0, samples;

    run_twin();
    if (runs_away()) {
        printf("without a flip the plant runs away: nothing is asked\n");
        return 0;
    }
    for (int m = 0; m < MEMBERS; m++)
        all += (long)members[m].size * 8 * INSTANTS;
    if (sample && sample < all)
        every = (all + sample - 1) / sample;
    for (int m = 0; m < MEMBERS; m++)
        for (int number = 0; number < (int)(members[m].size / members[m].each); number++)
            for (int bit = 0; bit < (int)members[m].each * 8; bit++)
                for (int i = 0; i < INSTANTS; i++) {
                    const struct flip flip = {&members[m], number, bit, instants[i]};
                    if (at++ % every != 0)
                        continue;
                    const enum outcome outcome = follow(&flip, &samples);
                    found[outcome]++;
                    if (outcome == FORGOTTEN)
                        longest = samples > longest ? samples : longest;
                    else if (lists || outcome < BEYOND_U)
                        report(&flip, outcome, samples);
                }
    printf(
        "%ld flips forgotten, the last after %d of %d samples; %ld late, %ld never, %ld unsound; "
        "plants beyond what u can bring back: %ld, driven beyond their bounds by a u without limits: %ld\n",
        found[FORGOTTEN], longest, RECOVERY_SAMPLES, found[LATE], found[NEVER], found[UNSOUND], found[BEYOND_U],
        found[BEYOND_BOUNDS]);
    return found[LATE] || found[NEVER] || found[UNSOUND];
}
