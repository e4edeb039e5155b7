/* two_mass: many instances side by side; two masses, spring and damper
 *
 * Made by lqgen 0.2.0 from two_mass.toml with the SHA-256
 * 46860654c241d4662f7925e59e28b72728299719d8f3760ea0a0858f9525b9e5.
 * Do not edit: change the design and run lqgen again. This file is yours: use it under any licence.
 *
 * For simulators, Monte Carlo and reinforcement learning on a PC. One call steps so many instances of
 * two_mass_t, the lanes, each with outputs, inputs and a state of its own. The last index of each array is
 * the lane: neighbouring lanes are one vector of the processor.
 *
 * What is called when:
 *
 *   once               two_mass_batch_init(&batch)                 all lanes at the start
 *   each sample        two_mass_batch_step(&batch, y, u, status)   y was measured; u for the actuators
 *   one lane           two_mass_batch_get(&batch, lane, &loop)     its state, for all functions of two_mass.h
 *                      two_mass_batch_set(&batch, lane, &loop)     and back
 *
 * Each lane has the bits of two_mass_step: those of its state, of u and of its status.
 * The loop over the lanes is the text of two_mass_step without its branches. A lane in which one would be
 * taken is computed again by two_mass_step itself, from its state before the sample:
 *
 *   an output is further from its expected value than usual, or was so shortly before
 *   the state leaves its bounds
 *
 * It costs as much as two_mass_step and some copying; the other lanes do not.
 *
 * The compiler makes vectors of the loop, as wide as its options allow: -mavx2 or -march=native on x86-64.
 * GCC and clang need -O2 besides.
 */
#ifndef TWO_MASS_BATCH_H
#define TWO_MASS_BATCH_H

#include "two_mass.h"

/* Instances in a batch, a constant: the same in all files that share one. 16 floats are two vectors of AVX2. Define it
 * before this file is included to have another number; a multiple of 16 suits all processors. */
#ifndef TWO_MASS_BATCH_LANES
#define TWO_MASS_BATCH_LANES 16
#endif
#if TWO_MASS_BATCH_LANES < 1
#error "TWO_MASS_BATCH_LANES: expected a positive number of lanes."
#endif

/* The lanes of a loop do not depend on each other. `omp simd` says the same, but needs -fopenmp-simd, and where that is
 * missing -Wall warns; these need no option. */
#ifndef LQG_LANES
#if defined __clang__
#define LQG_LANES _Pragma("clang loop vectorize(assume_safety)")
#elif defined __GNUC__
#define LQG_LANES _Pragma("GCC ivdep")
#elif defined _MSC_VER
#define LQG_LANES __pragma(loop(ivdep))
#elif defined _OPENMP
#define LQG_LANES _Pragma("omp simd")
#else
#define LQG_LANES
#endif
#endif

/* The states of all lanes, each field as in two_mass_t. It has no pointers and may be copied. Initialise it with
 * two_mass_batch_init. */
typedef struct {
    /* estimate x̂: of this sample after update, of the next one after predict */
    float x[TWO_MASS_NX][TWO_MASS_BATCH_LANES];
    /* w ≥ 1, widening of the gate: it grows while the output is rejected */
    float widening[TWO_MASS_NY][TWO_MASS_BATCH_LANES];
    unsigned long resets[TWO_MASS_BATCH_LANES];  /* resets of the state since init; wraps to 0 */
    unsigned long gated[TWO_MASS_NY][TWO_MASS_BATCH_LANES];  /* how often the gate has rejected an output; wraps to 0 */
} two_mass_batch_t;

LQG_STRICT_BEGIN
/* Lanes become vectors, and nothing else does: of other products and sums GCC 12 would make fused ones. Where it has to
 * keep the flags of exceptions, which nobody reads here, it does not compute both sides of a choice. */
#if defined __GNUC__ && !defined __clang__
#pragma GCC optimize ("tree-loop-vectorize", "no-tree-slp-vectorize", "vect-cost-model=unlimited", "no-trapping-math")
#endif

/* The state of one lane.
 *
 * lane  in: 0 … TWO_MASS_BATCH_LANES − 1
 * one   out: its state */
static inline void two_mass_batch_get(const two_mass_batch_t *self, int lane, two_mass_t *one)
{
    for (int i = 0; i < TWO_MASS_NX; i++) {
        one->x[i] = self->x[i][lane];
    }
    for (int i = 0; i < TWO_MASS_NY; i++) {
        one->widening[i] = self->widening[i][lane];
    }
    one->resets = self->resets[lane];
    for (int i = 0; i < TWO_MASS_NY; i++) {
        one->gated[i] = self->gated[i][lane];
    }
}

/* Sets the state of one lane.
 *
 * lane  in: 0 … TWO_MASS_BATCH_LANES − 1
 * one   in: its state, as two_mass_init or the calls of a sample left it */
static inline void two_mass_batch_set(two_mass_batch_t *self, int lane, const two_mass_t *one)
{
    for (int i = 0; i < TWO_MASS_NX; i++) {
        self->x[i][lane] = one->x[i];
    }
    for (int i = 0; i < TWO_MASS_NY; i++) {
        self->widening[i][lane] = one->widening[i];
    }
    self->resets[lane] = one->resets;
    for (int i = 0; i < TWO_MASS_NY; i++) {
        self->gated[i][lane] = one->gated[i];
    }
}

/* All lanes as two_mass_init leaves one. */
static inline void two_mass_batch_init(two_mass_batch_t *self)
{
    two_mass_t one;

    two_mass_init(&one);
    for (int lane = 0; lane < TWO_MASS_BATCH_LANES; lane++) {
        two_mass_batch_set(self, lane, &one);
    }
}

/* The sample of one lane again, by two_mass_step, from the state before it. */
#ifdef __GNUC__
__attribute__((noinline, cold))
#endif
static lqg_status_t two_mass_batch_redo(two_mass_batch_t *self, const two_mass_batch_t *before, int lane,
    float y[TWO_MASS_NY][TWO_MASS_BATCH_LANES], float u[TWO_MASS_NU][TWO_MASS_BATCH_LANES])
{
    two_mass_t one;
    float y_of_lane[TWO_MASS_NY];
    float u_of_lane[TWO_MASS_NU];
    lqg_status_t status;

    for (int i = 0; i < TWO_MASS_NX; i++) {
        self->x[i][lane] = before->x[i][lane];
    }
    two_mass_batch_get(self, lane, &one);
    for (int i = 0; i < TWO_MASS_NY; i++) {
        y_of_lane[i] = y[i][lane];
    }
    status = two_mass_step(&one, y_of_lane, u_of_lane);
    two_mass_batch_set(self, lane, &one);
    for (int i = 0; i < TWO_MASS_NU; i++) {
        u[i][lane] = u_of_lane[i];
    }
    return status;
}

/* One sample of each lane, as two_mass_step:
 * x̂ ← x̂ + L (y − C x̂),  u = −K x̂,  x̂ ← A x̂ + B u
 *
 * y       in: the outputs of each lane, in their units: y[TWO_MASS_Y_DY1][lane]
 * u       out: the inputs of each lane, in their units, always finite: u[TWO_MASS_U_FORCE][lane]
 * status  out: what two_mass_step returns, of each lane
 *
 * The arrays and the batch must not overlap. What is read only is not const: in C an array of arrays would then need a
 * cast. */
static inline void two_mass_batch_step(two_mass_batch_t *self, float y[TWO_MASS_NY][TWO_MASS_BATCH_LANES],
    float u[TWO_MASS_NU][TWO_MASS_BATCH_LANES], lqg_status_t status[TWO_MASS_BATCH_LANES])
{
    LQG_STRICT_BODY
    two_mass_batch_t before;  /* what the sample overwrites */
    unsigned unusual[TWO_MASS_BATCH_LANES];  /* 1 in a lane that takes two_mass_step */
    unsigned unusual_lanes = 0u;

    LQG_LANES
    for (int lane = 0; lane < TWO_MASS_BATCH_LANES; lane++) {
        /* the state before the sample */
        before.x[0][lane] = self->x[0][lane];
        before.x[1][lane] = self->x[1][lane];
        before.x[2][lane] = self->x[2][lane];
        before.x[3][lane] = self->x[3][lane];

        const float x_dy1 = self->x[0][lane];
        const float x_v1 = self->x[1][lane];
        const float x_dy2 = self->x[2][lane];
        const float x_v2 = self->x[3][lane];
        const float widening_dy1 = self->widening[0][lane];
        const float widening_dy2 = self->widening[1][lane];
        const float y_dy1 = y[0][lane];
        const float y_dy2 = y[1][lane];

        /* output 0, dy1 [m]: innovation = y − C x̂, 0 if it is not used */
        const float raw_innovation_dy1 = y_dy1 - x_dy1;
        const bool usable_dy1 = ((raw_innovation_dy1 * raw_innovation_dy1)
            < TWO_MASS_THRESHOLD_DY1) & !(1.0f < widening_dy1);
        const float innovation_dy1 = usable_dy1 ? raw_innovation_dy1 : 0.0f;

        /* output 1, dy2 [m]: innovation = y − C x̂, 0 if it is not used */
        const float raw_innovation_dy2 = y_dy2 - x_dy2;
        const bool usable_dy2 = ((raw_innovation_dy2 * raw_innovation_dy2)
            < TWO_MASS_THRESHOLD_DY2) & !(1.0f < widening_dy2);
        const float innovation_dy2 = usable_dy2 ? raw_innovation_dy2 : 0.0f;

        /* x̂ ← x̂ + L innovation;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
        const float posterior_dy1 = x_dy1 + (0.7008788f * innovation_dy1)
            + (0.03500962f * innovation_dy2);
        const float squares_to_x_dy1 = posterior_dy1 * posterior_dy1;
        const float posterior_v1 = x_v1 + (0.8304034f * innovation_dy1)
            - (0.105838105f * innovation_dy2);
        const float squares_to_x_v1 = squares_to_x_dy1 + (posterior_v1 * posterior_v1);
        const float posterior_dy2 = x_dy2 + (0.03500962f * innovation_dy1)
            + (0.26355246f * innovation_dy2);
        const float squares_to_x_dy2 = squares_to_x_v1 + (posterior_dy2 * posterior_dy2);
        const float posterior_v2 = x_v2 + (0.17161791f * innovation_dy1)
            + (0.078661025f * innovation_dy2);
        const float squares_to_x_v2 = squares_to_x_dy2 + (posterior_v2 * posterior_v2);

        /* u = −K x̂ */
        const float law_force = -(2.4226158f * posterior_dy1) - (2.1417978f * posterior_v1)
            + (0.33327204f * posterior_dy2) - (1.9239638f * posterior_v2);
        u[0][lane] = law_force;

        /* x̂ ← A x̂ + B u;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
        const float next_dy1 = (0.9877046f * posterior_dy1) + (0.4974466f * posterior_v1)
            + (0.012295422f * posterior_dy2) + (0.002553408f * posterior_v2)
            + (0.12465904f * law_force);
        self->x[0][lane] = next_dy1;
        const float squares_to_x_dy1_2 = next_dy1 * next_dy1;
        const float next_v1 = -(0.048467956f * posterior_dy1) + (0.9857659f * posterior_v1)
            + (0.048467956f * posterior_dy2) + (0.0142341405f * posterior_v2)
            + (0.4974466f * law_force);
        self->x[1][lane] = next_v1;
        const float squares_to_x_v1_2 = squares_to_x_dy1_2 + (next_v1 * next_v1);
        const float next_dy2 = (0.061477114f * posterior_dy1) + (0.01276704f * posterior_v1)
            + (0.9385229f * posterior_dy2) + (0.48723295f * posterior_v2) + (0.0017048119f * law_force);
        self->x[2][lane] = next_dy2;
        const float squares_to_x_dy2_2 = squares_to_x_v1_2 + (next_dy2 * next_dy2);
        const float next_v2 = (0.24233977f * posterior_dy1) + (0.0711707f * posterior_v1)
            - (0.24233977f * posterior_dy2) + (0.9288293f * posterior_v2) + (0.01276704f * law_force);
        self->x[3][lane] = next_v2;
        const float squares_to_x_v2_2 = squares_to_x_dy2_2 + (next_v2 * next_v2);

        status[lane] = LQG_OK;

        /* nothing is unusual: no output is weighed, and the state is within its bounds all the time */
        const bool usual = usable_dy1 & usable_dy2 & (squares_to_x_v2
            < TWO_MASS_TWO_TO_80) & (squares_to_x_v2_2 < TWO_MASS_TWO_TO_80);
        unusual[lane] = usual ? 0u : 1u;
        unusual_lanes |= unusual[lane];
    }

    for (int lane = 0; (unusual_lanes != 0u) && (lane < TWO_MASS_BATCH_LANES); lane++) {
        if (unusual[lane] != 0u) {
            status[lane] = two_mass_batch_redo(self, &before, lane, y, u);
        }
    }
}

LQG_STRICT_END

#endif
