/* Every bit of a controller's state, flipped once, in closed loop: after RECOVERY_SAMPLES the loop with the flip is where
 * its twin is that had none and hears the same noise. plant.h, which flips.py writes, has the plant and the controller.
 *
 *     flips [sample [list]]      sample: so many flips, evenly; 0: all
 *
 * Exit status 0: all flips are forgotten, or the plant is beyond what u can bring back; 1: some are not. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct member {
    const char *name;
    size_t offset, size, each;
    int is_real;
};

#include "plant.h"

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
enum { INSTANTS = sizeof instants / sizeof *instants, LAST_INSTANT = 300, SAMPLES = LAST_INSTANT + PROMISED + WATCHED + 1 };

struct loop {
    OF(t) controller;
    double x[NX];
    real u[NU + 1]; /* that acts */
};

/* What is drawn for a sample: of G w and v, and u of an estimator alone. */
struct drawn {
    double noise[NX + NY], u[NU + 1];
};

static struct drawn drawn[SAMPLES];
static struct loop twin[SAMPLES + 1]; /* before each sample */

/* ---- noise: normal numbers as sums of twelve uniform ones ------------------------------------------------------------ */

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
        for (int i = 0; i < NX + NY; i++) {
            drawn[k].noise[i] = 0;
            for (int j = 0; j <= i; j++)
                drawn[k].noise[i] += factor[i * (NX + NY) + j] * white[j];
        }
        for (int j = 0; j < NU; j++)
            drawn[k].u[j] = uniform(&seed);
    }
}

/* ---- one sample ------------------------------------------------------------------------------------------------------ */

static void measure(const struct loop *loop, const struct drawn *now, real y[NY])
{
    for (int i = 0; i < NY; i++) {
        double sum = now->noise[NX + i];
        for (int j = 0; j < NX; j++)
            sum += C[i * NX + j] * loop->x[j];
        for (int j = 0; j < NU; j++)
            sum += D[i * NU + j] * (double)loop->u[j];
        y[i] = (real)sum;
    }
}

static void advance_plant(struct loop *loop, const struct drawn *now)
{
    double next[NX];
    for (int i = 0; i < NX; i++) {
        next[i] = now->noise[i];
        for (int j = 0; j < NX; j++)
            next[i] += A[i * NX + j] * loop->x[j];
        for (int j = 0; j < NU; j++)
            next[i] += B[i * NU + j] * (double)loop->u[j];
    }
    memcpy(loop->x, next, sizeof next);
}

struct flip {
    const struct member *of;
    int number, bit;
    struct instant at;
};

static void flip_bit(struct loop *loop, const struct flip *flip, int sample, int phase)
{
    if (!flip || flip->at.sample != sample || flip->at.phase != phase)
        return;
    unsigned char *byte = (unsigned char *)&loop->controller + flip->of->offset + (size_t)flip->number * flip->of->each;
    byte[flip->bit / 8] ^= (unsigned char)(1u << flip->bit % 8);
}

#if !defined KEEPS_Z || defined IS_PREDICTOR
static void choose_input(struct loop *loop, const struct drawn *now)
{
#ifdef HAS_REGULATOR
    (void)now;
    OF(control)(&loop->controller, loop->u);
#else
    for (int j = 0; j < NU; j++)
        loop->u[j] = (real)now->u[j];
#endif
}
#endif

/* Filter form: y is sampled while the last u acts; predictor form: while the new one does. */
#ifdef KEEPS_Z
static void run_controller(struct loop *loop, const struct drawn *now, const struct flip *flip, int sample)
{
    real y[NY];
    flip_bit(loop, flip, sample, 0);
#ifdef IS_PREDICTOR
    choose_input(loop, now);
    flip_bit(loop, flip, sample, 1);
    flip_bit(loop, flip, sample, 2);
    measure(loop, now, y);
    OF(advance)(&loop->controller, y);
#else
    measure(loop, now, y);
    OF(control)(&loop->controller, y, loop->u);
    flip_bit(loop, flip, sample, 1);
    flip_bit(loop, flip, sample, 2);
    OF(advance)(&loop->controller);
#endif
}
#else
static void run_controller(struct loop *loop, const struct drawn *now, const struct flip *flip, int sample)
{
    real y[NY];
    flip_bit(loop, flip, sample, 0);
#ifdef IS_PREDICTOR
    choose_input(loop, now);
    flip_bit(loop, flip, sample, 1);
#endif
    measure(loop, now, y);
    OF(update)(&loop->controller, y);
#ifdef IS_PREDICTOR
    flip_bit(loop, flip, sample, 2);
#else
    flip_bit(loop, flip, sample, 1);
    choose_input(loop, now);
    flip_bit(loop, flip, sample, 2);
#endif
#ifdef HAS_INPUT
    OF(predict)(&loop->controller, loop->u);
#else
    OF(predict)(&loop->controller);
#endif
}
#endif

static void run_sample(struct loop *loop, const struct flip *flip, int sample)
{
    run_controller(loop, &drawn[sample], flip, sample);
    advance_plant(loop, &drawn[sample]);
}

/* ---- what is asked --------------------------------------------------------------------------------------------------- */

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
        if (memcmp((const unsigned char *)&a->controller + members[m].offset, (const unsigned char *)&b->controller + members[m].offset,
                   members[m].size) != 0)
            return 0;
    return memcmp(a->x, b->x, sizeof a->x) == 0 && memcmp(a->u, b->u, sizeof a->u) == 0;
}

/* The plant's states and those of the estimate, in standard deviations: the largest difference. */
static double distance(const struct loop *a, const struct loop *b)
{
    double most = 0;
    for (int i = 0; i < NX; i++) {
        if (is_lasting[i] != 0)
            continue;
        double apart = fabs(a->x[i] - b->x[i]);
#ifndef KEEPS_Z
        const double estimates = fabs((double)a->controller.x[i] - (double)b->controller.x[i]);
        if (!(estimates <= apart))
            apart = estimates;
#endif
        if (isnan(apart))
            return INFINITY;
        most = fmax(most, apart / within[i]);
    }
    return most;
}

/* |w · x| of an unstable mode, wᵀA = λ wᵀ, grows by |λ| a sample, and all that u can do against it within its limits is less. */
static int is_beyond_u(const struct loop *loop)
{
    for (int m = 0; m < MODES; m++) {
        const double *re = &mode_re[m * NX], *im = &mode_im[m * NX];
        double x_re = 0, x_im = 0, against = 0;
        for (int i = 0; i < NX; i++) {
            x_re += re[i] * loop->x[i];
            x_im += im[i] * loop->x[i];
        }
        for (int j = 0; j < NU; j++) {
            double u_re = 0, u_im = 0;
            for (int i = 0; i < NX; i++) {
                u_re += re[i] * B[i * NU + j];
                u_im += im[i] * B[i * NU + j];
            }
            against += hypot(u_re, u_im) * fmax(fabs(u_min[j]), fabs(u_max[j]));
        }
        if ((mode_size[m] - 1) * hypot(x_re, x_im) > against)
            return 1;
    }
    return 0;
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
static const char *const words[OUTCOMES] = {"forgotten", "late", "not forgotten", "unsound", "beyond u", "beyond bounds"};

/* What becomes of one flip, and the samples until it is forgotten. */
static enum outcome follow(const struct flip *flip, int *samples)
{
    struct loop loop = twin[flip->at.sample];
    const int end = flip->at.sample + PROMISED + WATCHED;
    int quiet = 0;
    *samples = 0;
    for (int k = flip->at.sample; k < end; k++) {
        run_sample(&loop, flip, k);
        if (!is_limited(&loop) || (k > flip->at.sample && !is_finite(&loop))) /* a flip alone can make a number infinite */
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
    memset(twin, 0, sizeof *twin);
    OF(init)(&twin[0].controller);
    for (int k = 0; k < SAMPLES; k++) {
        twin[k + 1] = twin[k];
        run_sample(&twin[k + 1], NULL, k);
    }
}

/* Without a flip the plant runs away, unstable and alone or beyond its limits: x̂ is rounded to more than is known of it. */
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
    printf("%s: %s[%d], bit %d, before call %d of sample %d, after %d samples\n", words[outcome], flip->of->name, flip->number,
           flip->bit, flip->at.phase, flip->at.sample, samples);
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
    printf("%ld flips forgotten, the last after %d of %d samples; %ld late, %ld never, %ld unsound; plants beyond what u can bring back: %ld, "
           "driven beyond their bounds by a u without limits: %ld\n",
           found[FORGOTTEN], longest, RECOVERY_SAMPLES, found[LATE], found[NEVER], found[UNSOUND], found[BEYOND_U], found[BEYOND_BOUNDS]);
    return found[LATE] || found[NEVER] || found[UNSOUND];
}
