/* SPDX-License-Identifier: MIT */
/* Multiply-adds of a sample by four methods, on the same states: those of closed loops from random starts, in which a
 * limit is active. problem.h is of problem.py. Prints a row of the table for each method.
 *
 *     compare MODEL SAMPLES */
#include <stdio.h>

#include "../../foresight/draws.h"
#include "admm.h"
#include "gradient.h"

enum { LONGEST = 200 };

/* ---- states -------------------------------------------------------------------------------------------- */

struct sample {
    int is_first; /* of its loop */
    int is_active;
    double x[NX], optimum[HORIZON * NU];
    unsigned long single_steps, in_blocks;
};

/* Equally dear in all directions; in the median the law alone goes as far as a limit, up to four times as far. */
static void draw(double x[NX])
{
    const double scale = exp2(2 * uniform());
    double white[NX];

    for (int i = 0; i < NX; i++)
        white[i] = normal();
    for (int i = 0; i < NX; i++) {
        x[i] = 0;
        for (int j = 0; j < NX; j++)
            x[i] += scale * start_factor[i * NX + j] * white[j];
    }
}

static lqg_mpc_state_t *solved(const lqg_mpc_t *mpc, const double x[NX], unsigned long *count)
{
    static double memory[LQG_MPC_MEMORY(255)];
    static unsigned char set[LQG_MPC_SET(255)];
    static lqg_mpc_state_t state = LQG_MPC_STATE_IN(memory, set, NULL, 255);
    double u[NU];

    multiply_adds = 0;
    if (lqg_mpc_control(mpc, &state, x, u) & LQG_NOT_OPTIMAL)
        exit(1);
    *count = multiply_adds;
    return &state;
}

/* The optimum over the horizon; whether a limit is active. */
static int find_optimum_ahead(struct sample *sample)
{
    const lqg_mpc_state_t *state = solved(&single_steps, sample->x, &sample->single_steps);
    unsigned length = 0;

    for (unsigned i = 0; i < single_steps.rows; i++)
        length += state->side[i] != 0;
    for (int i = 0; i < HORIZON * NU; i++) {
        const unsigned row = (unsigned)input_row[i];
        sample->optimum[i] = state->side[row] ? limit_of(state, row) : foreseen(&single_steps, state, length, row);
    }
    return length > 0;
}

static long fill(struct sample samples[], long wanted)
{
    long count = 0, k = LONGEST;
    double x[NX];

    while (count < wanted) {
        struct sample *now = &samples[count];
        if (k >= LONGEST) {
            draw(x);
            k = 0;
        }
        now->is_first = k++ == 0;
        memcpy(now->x, x, sizeof x);
        now->is_active = find_optimum_ahead(now);
        (void)solved(&in_blocks, x, &now->in_blocks);
        memset(x, 0, sizeof x);
        add_product(x, 1, A, now->x, NX, NX);
        add_product(x, 1, B, now->optimum, NX, NU);
        if (now->is_active)
            count++;
        else
            k = LONGEST; /* it settles */
    }
    return count;
}

/* ---- methods ------------------------------------------------------------------------------------------- */

struct result {
    double mean, worst, share_left; /* multiply-adds; share of samples that the cap has ended */
};

typedef int method(const double x[NX], const double optimum[NU]);

static struct result measure(method *run, void (*forget)(void), int is_warm, const struct sample samples[], long count)
{
    struct result result = {0, 0, 0};

    for (long n = 0; n < count; n++) {
        if (!is_warm || samples[n].is_first)
            forget();
        multiply_adds = 0;
        result.share_left += !run(samples[n].x, samples[n].optimum);
        result.mean += (double)multiply_adds;
        result.worst = fmax(result.worst, (double)multiply_adds);
    }
    result.mean /= (double)count;
    result.share_left /= (double)count;
    return result;
}

/* The share of ρ with the smallest mean, of nine. */
static struct result best_admm(int is_warm, const struct sample samples[], long count, double *best_share)
{
    struct result best = {INFINITY, INFINITY, 1};

    for (int i = -6; i <= 2; i++) {
        begin_admm(pow(10, i / 2.0));
        const struct result now = measure(run_admm, forget_admm, is_warm, samples, count);
        if (now.mean < best.mean) {
            best = now;
            *best_share = pow(10, i / 2.0);
        }
    }
    return best;
}

static void print_row(const char *model, const char *name, struct result result)
{
    printf("| %s | %s | %.0f | %.0f |", model, name, result.mean, result.worst);
    if (result.share_left > 0)
        printf(" %.1f %% |\n", 100 * result.share_left);
    else
        printf(" |\n");
}

static void print_exact(const char *model, const char *name, int is_in_blocks, const struct sample samples[],
                        long count)
{
    struct result result = {0, 0, 0};

    for (long n = 0; n < count; n++) {
        const double sum = (double)(is_in_blocks ? samples[n].in_blocks : samples[n].single_steps);
        result.mean += sum / (double)count;
        result.worst = fmax(result.worst, sum);
    }
    print_row(model, name, result);
}

int main(int arguments, char **words)
{
    const long wanted = arguments > 2 ? strtol(words[2], NULL, 10) : 0;
    struct sample *samples = wanted > 0 ? calloc((size_t)wanted + 1, sizeof *samples) : NULL;
    const char *model = words[1];
    double share = 0;
    char name[100];

    if (!samples)
        return 2;
    const long count = fill(samples, wanted);
    struct result result = best_admm(0, samples, count, &share);
    snprintf(name, sizeof name, "ADMM, cold, ρ %.3g", share);
    print_row(model, name, result);
    result = best_admm(1, samples, count, &share);
    snprintf(name, sizeof name, "ADMM, warm, ρ %.3g", share);
    print_row(model, name, result);
    begin_gradient();
    print_row(model, "fast gradient, cold", measure(run_gradient, forget_gradient, 0, samples, count));
    print_row(model, "fast gradient, warm", measure(run_gradient, forget_gradient, 1, samples, count));
    print_exact(model, "TinyLQG, single steps, exact", 0, samples, count);
    if (HAS_BLOCKS)
        print_exact(model, "TinyLQG, in blocks, exact", 1, samples, count);
    free(samples);
    return 0;
}
