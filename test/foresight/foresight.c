/* SPDX-License-Identifier: MIT */
/* The compiled header of a design whose limits are foreseen. plant.h, which foresight.py writes, has both.
 *
 *     foresight answers|conditions|starts NUMBER
 *
 * answers: prints random states, u[k−1] and references, each with u. conditions: every answer is the optimum by the
 * conditions of Karush, Kuhn and Tucker, as the problem is convex; it counts how many changes of the set of active
 * limits were needed. starts: how many random starts the loop settles from, and how many with the law clipped. */
#include <stdlib.h>

#include "draws.h"
#include "watched.h"

enum { LONGEST = 20000 }; /* samples of a loop */

/* ---- random states ------------------------------------------------------------------------------------- */

struct start {
    double x[NX], r[NR + 1];
};

/* x − Nx r is equally dear in all directions; the law goes 2^least to 2^most times as far as a limit, in the median. */
static void draw(struct start *start, double least, double most)
{
    const double scale = exp2(least + (most - least) * uniform());
    double white[NX];

    for (int i = 0; i < NX; i++)
        white[i] = normal();
    for (int j = 0; j < NR; j++) {
        double typical_r = 0;
        for (int i = 0; i < NX; i++)
            if (Nx[i * NR + j] != 0)
                typical_r = fmax(typical_r, typical[i] / fabs(Nx[i * NR + j]));
        start->r[j] = typical_r * normal();
    }
    for (int i = 0; i < NX; i++) {
        start->x[i] = 0;
        for (int j = 0; j < NX; j++)
            start->x[i] += scale * start_factor[i * NX + j] * white[j];
        for (int j = 0; j < NR; j++)
            start->x[i] += Nx[i * NR + j] * start->r[j];
    }
}

static void set_controller(OF(t) * controller, const struct start *start)
{
    OF(init)(controller);
    for (int i = 0; i < NX; i++)
        controller->x[i] = (real)start->x[i];
#if defined HAS_REFERENCES
    for (int j = 0; j < NR; j++)
        controller->r[j] = (real)start->r[j];
#endif
}

/* One answer; u[k−1] is anywhere within its limits. */
static void answer(OF(t) * controller, real last[NU], real u[NU])
{
    struct start start;

    draw(&start, -2, 4);
    set_controller(controller, &start);
    for (int i = 0; i < NU; i++)
        last[i] = 0;
#ifdef LIMITS_CHANGE
    for (int i = 0; i < NU; i++) {
        last[i] = (real)(u_min[i] + (u_max[i] - u_min[i]) * uniform());
        controller->u_applied[i] = last[i];
    }
#endif
    (void)OF(control)(controller, u);
}

static void print_answers(long number)
{
    for (long n = 0; n < number; n++) {
        OF(t) controller;
        real last[NU], u[NU];
        answer(&controller, last, u);
        for (int i = 0; i < NX; i++)
            printf("%.17g ", (double)controller.x[i]);
        for (int i = 0; i < NU; i++)
            printf("%.17g ", (double)last[i]);
#ifdef HAS_REFERENCES
        for (int j = 0; j < NR; j++)
            printf("%.17g ", (double)controller.r[j]);
#endif
        for (int i = 0; i < NU; i++)
            printf("%.17g%s", (double)u[i], i + 1 < NU ? " " : "\n");
    }
}

static int check_conditions(long number)
{
    seen.is_on = 1;
    for (long n = 0; n < number; n++) {
        OF(t) controller;
        real last[NU], u[NU];
        answer(&controller, last, u);
    }
    printf(
        "%lu states, %lu with an active limit: %u changes at most where %u may be, %lu given up; rounding is %.2g of "
        "what is allowed, %lu wrong\n",
        seen.states, seen.active, seen.most, LAW_LIMITS.iterations, seen.given_up, seen.residual, seen.wrong);
    return seen.wrong > 0 || seen.given_up > 0 || seen.active < seen.states / 4;
}

/* ---- closed loops -------------------------------------------------------------------------------------- */

/* What the rest costs, without limits. */
static double cost_of(const double x[NX], const double r[NR + 1])
{
    double from[NX], cost = 0;

    for (int i = 0; i < NX; i++) {
        from[i] = x[i];
        for (int j = 0; j < NR; j++)
            from[i] -= Nx[i * NR + j] * r[j];
    }
    for (int i = 0; i < NX; i++)
        for (int j = 0; j < NX; j++)
            cost += from[i] * X[i * NX + j] * from[j];
    return cost;
}

/* The law, clipped: the change of u first, then its size, which has priority. */
static void clip_law(const double x[NX], const double r[NR + 1], real u[NU])
{
    for (int i = 0; i < NU; i++) {
        double law = 0;
        for (int j = 0; j < NX; j++) {
            double from = x[j];
            for (int k = 0; k < NR; k++)
                from -= Nx[j * NR + k] * r[k];
            law -= K[i * NX + j] * from;
        }
        for (int k = 0; k < NR; k++)
            law += Nu[i * NR + k] * r[k];
#ifdef LIMITS_CHANGE
        law = fmin(fmax(law, (double)u[i] - u_change[i]), (double)u[i] + u_change[i]);
#endif
        u[i] = (real)fmin(fmax(law, u_min[i]), u_max[i]);
    }
}

static int settles(const struct start *start, int is_clipped)
{
    static const struct drawn nothing;
    static const struct visitor nobody;
    const double first = cost_of(start->x, start->r);
    struct loop loop;

    memset(&loop, 0, sizeof loop);
    set_controller(&loop.controller, start);
    memcpy(loop.x, start->x, sizeof loop.x);
    for (int k = 0; k < LONGEST; k++) {
        const double cost = cost_of(loop.x, start->r);
        if (cost < 1e-6 * first)
            return 1;
        if (!(cost < 1e6 * first))
            return 0;
        if (is_clipped) {
            clip_law(loop.x, start->r, loop.u);
            advance_plant(&loop, &nothing);
        } else {
            (void)run_sample(&loop, &nothing, nobody);
        }
    }
    return 0;
}

static int run_starts(long number)
{
    long with_foresight = 0, with_clipping = 0;

    for (long n = 0; n < number; n++) {
        struct start start;
        draw(&start, 0, 3);
        for (int i = 0; i < NX; i++)
            start.x[i] = fmin(fmax(start.x[i], state_limits[2 * i]), state_limits[2 * i + 1]);
        with_foresight += settles(&start, 0);
        with_clipping += settles(&start, 1);
    }
    printf("settled: foreseen %ld, clipped %ld of %ld\n", with_foresight, with_clipping, number);
    return with_foresight < with_clipping;
}

int main(int count, char **words)
{
    const long number = count > 2 ? strtol(words[2], NULL, 10) : 0;

    if (number > 0 && strcmp(words[1], "answers") == 0)
        print_answers(number);
    else if (number > 0 && strcmp(words[1], "conditions") == 0)
        return check_conditions(number);
    else if (number > 0 && strcmp(words[1], "starts") == 0)
        return run_starts(number);
    else
        return 2;
    return 0;
}
