/* loop: a loop of the tests
 *
 * Made by lqgen 0.1.0 from loop.toml with the SHA-256
 * 2a7cb457da75d3a642a253c518b1a753d3801c75703d6ad0cfb4a0257a24bb01.
 * Do not edit: change the design and run lqgen again. This file is yours: use it under any licence.
 *
 * Plant, sampled every 0.1 s:  x⁺ = A x + B u + G w,  y = C x + D u + v
 *
 *   states   x[0] position [m], x[1] speed [m/s]
 *   inputs   u[0] force [N]
 *   outputs  y[0] position [m]
 *
 *   A = [ 1.0  0.1 ]
 *       [ 0.0  1.0 ]
 *   B = [ 0.005 ]
 *       [   0.1 ]
 *   C = [ 1.0  0.0 ]
 *   D = [ 0.0 ]
 *
 * Regulator  u = −K x̂:
 *
 *   K of 6 samples from init on; the last one is held:
 *   K = [ 2.6733851  2.9866812 ]
 *   poles of A − B K: 0.844 ± 0.04891i
 *
 * Kalman filter, filter form (u[k] is made of the outputs up to y[k]),
 * with the gains of 5 samples from init on; the last one is held; of samples:
 *
 *   G = [ 0.005 ]
 *       [   0.1 ]
 *   W = E[w wᵀ] = [ 0.2 ]
 *   V = E[v vᵀ] = [ 0.01 ]
 *   L = [ 0.25828618 ]
 *       [  0.3851529 ]
 *   poles of A − L_predictor C: 0.8516 ± 0.1284i
 *   x̂ begins anew when it reaches, in size: 1.1e+12, 1.1e+12
 *   an innovation is not believed from, in size: 2.199e+12
 *
 * Closed loop, opened at the plant's input:
 *
 *   gain margin         11.02 dB, up 11.02
 *   phase margin        37.53° at 1.451 rad/s
 *   delay margin        4.515 samples, 0.4515 s
 *   disk margin         0.6552
 *   cost per sample     0.03466
 *
 * One sample takes 15 multiply-adds and 28 bytes of RAM; on a Cortex-M4F at -O2 about 790 bytes of
 * flash and 0 bytes of stack. Style: compact. Arithmetic: plain. Digits of the design: 100.
 */
#ifndef LOOP_H
#define LOOP_H

#include <stddef.h>

#include "lqg/lqg.h"

#ifdef LQG_REAL_DOUBLE
#error "loop.h computes in float: do not define LQG_REAL_DOUBLE for the library and for this file, or run lqgen with other options."
#endif
#ifdef LQG_FUSED
#error "loop.h uses plain arithmetic: do not define LQG_FUSED for the library and for this file, or run lqgen with other options."
#endif

#if LQG_HEADER_FORMAT != 2
#error "loop.h was made by lqgen 0.1.0, which this TinyLQG does not know: run the lqgen of this TinyLQG on loop.toml again."
#endif

#define LOOP_NX 2  /* states */
#define LOOP_NU 1  /* inputs */
#define LOOP_NY 1  /* outputs */
#define LOOP_X_BOUNDS {1099511627776.0f, 1099511627776.0f}  /* x̂ stays below them in size, or begins anew */
#define LOOP_RECOVERY_SAMPLES 580  /* after a fault has ended its effect is below the noise */
#define LOOP_SAMPLE_TIME 0.1f  /* s between two samples */

enum {
    LOOP_X_POSITION = 0,  /* [m] */
    LOOP_X_SPEED = 1  /* [m/s] */
};

enum {
    LOOP_U_FORCE = 0  /* [N] */
};

enum {
    LOOP_Y_POSITION = 0  /* [m] */
};

/* The whole state of the controller: no pointers inside, may be copied. Begin it with loop_init. */
typedef struct {
    float x[LOOP_NX];  /* x̂, the estimate: of this sample after update, of the next after predict */
    float widening[LOOP_NY];  /* how much wider than its σ the gate is, squared: more while an output is left out */
    unsigned sample;  /* how many samples are over; stops with the last that has gains of its own */
    unsigned gain_row;  /* the same for the filter's gains; 0 after a reset */
    unsigned long resets;  /* how often it began anew, since init; after ULONG_MAX comes 0 */
    unsigned long gated[LOOP_NY];  /* how often the gate left an output out */
} loop_t;

static const lqg_real LOOP_KALMAN_WIDENING[1] = {
    1.0f
};
static const lqg_real LOOP_KALMAN_WIDEN[1] = {
    1.5f
};
static const lqg_real LOOP_KALMAN_NARROW[1] = {
    0.7421875f
};
static const lqg_real LOOP_KALMAN_A[4] = {
    1.0f, 0.1f,
    0.0f, 1.0f
};
static const lqg_real LOOP_KALMAN_B[2] = {
    0.005f,
    0.1f
};
static const lqg_real LOOP_KALMAN_C[2] = {
    1.0f, 0.0f
};
static const lqg_real LOOP_KALMAN_S[5] = {
    0.029264254f,
    0.022639094f,
    0.018459931f,
    0.015583271f,
    0.013482289f
};
static const lqg_real LOOP_KALMAN_X_SCALE[2] = {
    9.094947e-13f, 9.094947e-13f
};
static const lqg_real LOOP_KALMAN_LIMIT[1] = {
    2199023255552.0f
};
static const lqg_real LOOP_KALMAN_L[10] = {
    0.6582862f,
    0.3851529f,
    0.5582862f,
    0.3851529f,
    0.4582862f,
    0.3851529f,
    0.3582862f,
    0.3851529f,
    0.25828618f,
    0.3851529f
};
static const lqg_kalman_steady_t LOOP_KALMAN = {
    {LOOP_NX, 1, LOOP_NY, LOOP_KALMAN_A, LOOP_KALMAN_B, LOOP_KALMAN_C, NULL},  /* nx, nu, ny, A, B, C, D */
    LOOP_KALMAN_L, NULL, NULL,  /* L, M, x0 */
    LOOP_KALMAN_X_SCALE, LOOP_KALMAN_LIMIT  /* x_scale, innovation_limit */
};
static const lqg_real LOOP_LQR_K[12] = {
    4.0100775f, 4.480022f,
    3.7427392f, 4.1813536f,
    3.4754007f, 3.8826854f,
    3.2080622f, 3.5840173f,
    2.9407237f, 3.2853494f,
    2.6733851f, 2.9866812f
};
static const lqg_lqr_t LOOP_LQR = {
    LOOP_NX, LOOP_NU, LOOP_LQR_K, NULL, NULL  /* nx, nu, K, u_min, u_max */
};

LQG_STRICT_BEGIN

/* x̂ = x0; nothing applied yet. */
static inline void loop_init(loop_t *self)
{
    lqg_kalman_steady_init(&LOOP_KALMAN, self->x, NULL, NULL);
    self->sample = 0;
    self->gain_row = 0;
    self->resets = 0;
    for (int i = 0; i < LOOP_NY; i++) {
        self->widening[i] = LOOP_KALMAN_WIDENING[i];
        self->gated[i] = 0;
    }
}

/* Begins anew, but for the time and what was counted, and counts it: the state was not within its bounds. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static lqg_status loop_reset(loop_t *self, lqg_status status)
{
    const unsigned sample = self->sample;
    const unsigned long resets = self->resets + 1;
    unsigned long gated[LOOP_NY];

    for (int i = 0; i < LOOP_NY; i++)
        gated[i] = self->gated[i];
    loop_init(self);
    self->sample = sample;
    self->resets = resets;
    for (int i = 0; i < LOOP_NY; i++)
        self->gated[i] = gated[i];
    return status | LQG_STATE_RESET;
}

/* x̂ ← x̂ + L (y − C x̂)
 *
 * y  in: the outputs, in their units. An output that is not finite, absurd or more than 300 σ off is taken as having come as expected.
 *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
static inline lqg_status loop_update(loop_t *self, const float y[LOOP_NY])
{
    lqg_real work[LQG_KALMAN_STEADY_WORK(LOOP_NX, LOOP_NY)];
    lqg_kalman_steady_t kalman = *&LOOP_KALMAN;
    kalman.L += (self->gain_row < 4 ? self->gain_row : 4) * (LOOP_NX * LOOP_NY);
    const lqg_watch_t watch = {NULL, 300.0f, self->gated, NULL, NULL, self->widening, LOOP_KALMAN_WIDEN, LOOP_KALMAN_NARROW, NULL};
    const lqg_status status = lqg_kalman_steady_update_watched(&kalman, self->x, NULL, NULL, y, LOOP_KALMAN_S + (self->gain_row < 4 ? self->gain_row : 4) * LOOP_NY, &watch, work);

    return status & LQG_STATE_RESET ? loop_reset(self, status) : status;
}

/* u = −K x̂, within its limits
 *
 * u  out: the inputs, in their units: finite, whatever came in
 *
 * Status: LQG_INPUT_LIMITED. */
static inline lqg_status loop_control(const loop_t *self, float u[LOOP_NU])
{
    lqg_lqr_t lqr = LOOP_LQR;
    lqr.K += (self->sample < 5 ? self->sample : 5) * 2;

    return lqg_lqr_control(&lqr, self->x, u);
}

/* x̂ ← A x̂ + B u: from this sample to the next.
 *
 * u  in: what was applied, in its units; not what was asked for, where the two differ
 *
 * Status: LQG_STATE_RESET. */
static inline lqg_status loop_predict(loop_t *self, const float u[LOOP_NU])
{
    lqg_real work[LQG_KALMAN_STEADY_WORK(LOOP_NX, LOOP_NY)];
    lqg_kalman_steady_t kalman = *&LOOP_KALMAN;
    kalman.L += (self->gain_row < 4 ? self->gain_row : 4) * (LOOP_NX * LOOP_NY);
    lqg_status status = lqg_kalman_steady_predict(&kalman, self->x, NULL, NULL, u, work);

    self->sample = self->sample < 5 ? self->sample + 1 : 5;
    self->gain_row = self->gain_row < 4 ? self->gain_row + 1 : 4;
    return status & LQG_STATE_RESET ? loop_reset(self, status) : status;
}

/* One sample: update, control and predict, for an actuator that applies u as it is. */
static inline lqg_status loop_step(loop_t *self, const float y[LOOP_NY], float u[LOOP_NU])
{
    lqg_status status = loop_update(self, y);

    status |= loop_control(self, u);
    status |= loop_predict(self, u);
    return status;
}

/* The update by position alone, for a sensor with a rate of its own; any number of predictions may lie between two.
 * There is no other: it is the update.
 *
 * y_position  in: the output, in m. One that is not finite, absurd or more than 300 σ off is left out.
 *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
static inline lqg_status loop_update_position(loop_t *self, const float y_position)
{
    return loop_update(self, &y_position);
}

/* How far the outputs are from what is expected, y − C x̂ and the steady variance of each:
 * to be called before update by those who watch the health of sensors and model.
 *
 * y   in: the outputs, in their units
 * nu  out: the innovations
 * S   out: the variances; nu²/S is 1 in the mean as long as the model holds
 */
static inline void loop_innovation(const loop_t *self, const float y[LOOP_NY],
    float nu[LOOP_NY], float S[LOOP_NY])
{
    LQG_STRICT_BODY
    const float variance = LOOP_KALMAN_S[(self->gain_row < 4 ? self->gain_row : 4) * LOOP_NY + 0];
    const float x_0 = self->x[0];
    const float y_0 = y[0];

    /* output 0, position [m]: innovation = y − C x̂ */
    const float innovation_position = y_0 - x_0;
    nu[0] = innovation_position;

    S[0] = variance;
}

/* x̂ ← x, by hand.
 *
 * x  in: the state, in its units
 *
 * Status: LQG_STATE_RESET, when x is not within LOOP_X_BOUNDS. */
static inline lqg_status loop_set_state(loop_t *self, const float x[LOOP_NX])
{
    LQG_STRICT_BODY
    const float x_0 = x[0];
    const float x_1 = x[1];

    /* Σ x² in units of a bound */
    const float sum = x_0 * x_0;
    const float sum_a = sum + x_1 * x_1;

    self->x[0] = x_0;
    self->x[1] = x_1;

    const lqg_status status = LQG_OK;
    if (!(sum_a < 1.2089258e+24f))
        return loop_reset(self, status);
    return status;
}

LQG_STRICT_END

#endif
