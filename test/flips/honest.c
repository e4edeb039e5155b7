/* SPDX-License-Identifier: MIT */
/* Honest samples of a controller in closed loop with its plant, in laps: each begins with a plant at x0 and a draw from
 * P0, and has a silence, all outputs NaN, after a third of it. honest.py says how long both are at most: a silence is
 * halved until the loop survives it.
 *
 *     honest <samples>
 *
 * Exit status 0: outside the silences no output was left out, or no more of them than the design's own gate is to leave
 * out, and nothing began anew, by the statuses and by the controller's counters; 1: otherwise. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "closed_loop.h"

#define FAULTS (LQG_OUTPUT_REJECTED | LQG_INNOVATION_NOT_POSITIVE | LQG_STATE_RESET | LQG_COVARIANCE_RESET)

/* A state is back when it is no larger in the last sixth of a lap than so many times what it was in the one before the
 * silence: a robot that sways slowly is at 3 or 4. */
#define BACK 10

enum { SILENT_FROM = LAP / 3, SHOWN = 10, REHEARSED = 30, COUNTERS = sizeof counters / sizeof *counters };

struct tally {
    long laps, samples, heard, gated, faults;
    long beyond_u, lost; /* laps; lost: not back from the silence */
    double counted;      /* by the controllers */
    int shown;
};

/* ---- noise: normal numbers with their tails ---------------------------------------------------------------------- */

struct source {
    unsigned long long state;
    double second; /* of a pair; NaN: none is left */
};

/* SplitMix64, of period 2⁶⁴: G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators",
 * OOPSLA 2014. Between -1 and 1, never 0. */
static double uniform(struct source *source)
{
    unsigned long long bits = source->state += 0x9e3779b97f4a7c15ull;
    bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9ull;
    bits = (bits ^ bits >> 27) * 0x94d049bb133111ebull;
    bits ^= bits >> 31;
    return (double)(bits >> 11 | 1) / 4503599627370496.0 - 1;
}

/* The polar method: a point in the unit circle gives two, the largest of which can be 12. */
static double normal(struct source *source)
{
    const double second = source->second;
    double a, b, square;
    if (!isnan(second)) {
        source->second = (double)NAN;
        return second;
    }
    do {
        a = uniform(source);
        b = uniform(source);
        square = a * a + b * b;
    } while (square >= 1);
    const double scale = sqrt(-2 * log(square) / square);
    source->second = b * scale;
    return a * scale;
}

static void draw_start(double x[NX], struct source *source)
{
    double white[NX];
    for (int i = 0; i < NX; i++)
        white[i] = normal(source);
    for (int i = 0; i < NX; i++) {
        x[i] = start[i];
        for (int j = 0; j <= i; j++)
            x[i] += start_factor[i * NX + j] * white[j];
    }
}

static void draw_sample(struct drawn *now, struct source *source, int is_silent)
{
    double white[NX + NY];
    for (int i = 0; i < NX + NY; i++)
        white[i] = normal(source);
    colour(now, white);
    for (int i = 0; is_silent && i < NY; i++)
        now->noise[NX + i] = (double)NAN; /* and so is y */
    for (int j = 0; j < NU; j++)
        now->u[j] = uniform(source) / 2;
}

/* ---- what is asked ----------------------------------------------------------------------------------------------- */

/* All that the controller has counted since init. */
static double sum_of_counters(const struct loop *loop)
{
    double sum = 0;
    for (int c = 0; c < COUNTERS; c++)
        for (size_t i = 0; i < counters[c].size / counters[c].each; i++) {
            const size_t at = counters[c].offset + i * counters[c].each;
            unsigned long value;
            memcpy(&value, (const unsigned char *)&loop->controller + at, sizeof value);
            sum += (double)value;
        }
    return sum;
}

/* In a silence, and only there, outputs are to be told as not finite. */
static void judge(struct tally *tally, lqg_status_t status, int is_silent, int k)
{
    const lqg_status_t wrong = (status & (LQG_OUTPUT_GATED | FAULTS)) ^ (is_silent ? LQG_OUTPUT_REJECTED : LQG_OK);
    tally->samples++;
    tally->heard += !is_silent;
    if (!wrong)
        return;
    tally->gated += (wrong & LQG_OUTPUT_GATED) != 0;
    tally->faults += (wrong & FAULTS) != 0;
    if (tally->shown++ < SHOWN)
        printf("lap %ld, sample %d: status %u, %s\n", tally->laps, k, status, lqg_status_text(status));
}

struct extent {
    double before[NX], after[NX]; /* the largest |x| before the silence, and at the end of the lap */
};

static void extend(struct extent *extent, const double x[NX], int k)
{
    double *most = k >= LAP / 6 && k < SILENT_FROM ? extent->before : k >= LAP - LAP / 6 ? extent->after : NULL;
    for (int i = 0; most && i < NX; i++)
        most[i] = fmax(most[i], fabs(x[i]));
}

/* A plant without a regulator goes where it goes. */
static int is_back(const struct extent *extent)
{
    (void)extent;
#ifdef HAS_REGULATOR
    for (int i = 0; i < NX; i++)
        if (!(extent->after[i] <= BACK * extent->before[i]))
            return 0;
#endif
    return 1;
}

/* Ends where the plant is beyond what u can bring back: what follows is not honest. */
static void run_lap(struct tally *tally, struct source *source, int silence, long samples)
{
    const struct visitor nobody = {NULL, NULL};
    struct extent extent = {{0}, {0}};
    struct loop loop;
    struct drawn now;
    int is_beyond = 0, k;
    begin_loop(&loop);
    draw_start(loop.x, source);
    for (k = 0; k < LAP && k < samples && !is_beyond; k++) {
        const int is_silent = k >= SILENT_FROM && k < SILENT_FROM + silence;
        draw_sample(&now, source, is_silent);
        judge(tally, run_sample(&loop, &now, nobody), is_silent, k);
        extend(&extent, loop.x, k);
        is_beyond = is_beyond_u(&loop);
    }
    tally->beyond_u += is_beyond;
    tally->lost += is_beyond ? k > SILENT_FROM : k == LAP && !is_back(&extent);
    tally->counted += sum_of_counters(&loop);
    tally->laps++;
}

/* The longest silence that the loop survives, of those that come of halving. */
static int survived_silence(void)
{
    int silence = LONGEST_SILENCE, is_survived = 0;
    while (silence > 0 && !is_survived) {
        struct tally rehearsal = {0};
        struct source source = {2, (double)NAN};
        rehearsal.shown = SHOWN;
        while (rehearsal.laps < REHEARSED && !rehearsal.lost)
            run_lap(&rehearsal, &source, silence, LAP);
        is_survived = !rehearsal.lost;
        silence = is_survived ? silence : silence / 2;
    }
    return silence;
}

/* What the gate is to leave out of all that is heard, and five standard deviations of that number more. */
static double most_gated(const struct tally *tally)
{
    const double mean = GATED_SHARE * (double)NY * (double)tally->heard;
    return mean + 5 * sqrt(mean);
}

int main(int count, char *arguments[])
{
    struct tally tally = {0};
    struct source source = {1, (double)NAN};
    const long samples = count > 1 ? atol(arguments[1]) : LAP;
    const int silence = survived_silence();
    double most;

    while (tally.samples < samples)
        run_lap(&tally, &source, silence, samples - tally.samples);
    most = most_gated(&tally);
    printf(
        "%ld honest samples in %ld laps of %d, with a silence of %d each: gated in %ld, %.0f may be; "
        "other faults in %ld; counted by the controller: %.0f; laps beyond what u can bring back: %ld; not back "
        "from the silence: %ld\n",
        tally.samples, tally.laps, LAP, silence, tally.gated, most, tally.faults, tally.counted, tally.beyond_u,
        tally.lost);
    return (double)tally.gated > most || tally.counted > most || tally.faults;
}
