/* loop: a loop of the tests
 *
 * Made by lqgen 0.1.0 from loop.toml with the SHA-256
 * 62075178948272a5868ebe9401f15fdf38a03de11551a3b42350f51777bd70b1.
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
 *   B = [ 0.005000000000000001 ]
 *       [                  0.1 ]
 *   C = [ 1.0  0.0 ]
 *   D = [ 0.0 ]
 *
 * Regulator  u = −K [x̂; ξ]:
 *
 *   K of 6 samples from init on; the last one is held:
 *   K = [ 4.0  3.0  -2.0 ]
 *   ξ⁺ = ξ + T (r − y) of position; ξ ← ξ + H (u − what the law asked for) with the u that was applied
 *   H = [ 0.3 ]
 *   poles of A − B K: 0.844 ± 0.04891i
 *   -0.6 ≤ u[0] ≤ 0.5
 *
 * Kalman filter, predictor form (u[k] is made of the outputs up to y[k−1]),
 * with the gains of 5 samples from init on; the last one is held; of samples:
 *
 *   G = [ 0.005000000000000001 ]
 *       [                  0.1 ]
 *   W = E[w wᵀ] = [ 0.2 ]
 *   V = E[v vᵀ] = [ 0.01 ]
 *   E[w vᵀ] = [ 0.01 ]
 *   L = [ 0.23512024755829347 ]
 *       [  0.3146334259707735 ]
 *   M = [ 0.0038243987622085334 ]
 *       [   0.07648797524417066 ]
 *   L_predictor = [  0.2704079889175794 ]
 *                 [ 0.39112140121494415 ]
 *   poles of A − L_predictor C: 0.8648 ± 0.1443i
 *   x̂ begins anew when it reaches, in size: 1.845e+19, 1.845e+19
 *   an innovation is not believed from, in size: 3.689e+19
 *
 * Closed loop, opened at the plant's input:
 *
 *   gain margin         7.726 dB, up 7.726
 *   phase margin        33.58° at 1.415 rad/s
 *   delay margin        4.144 samples, 0.4144 s
 *   disk margin         0.5635
 *   cost per sample     0.03626
 *
 * One sample takes 25 multiply-adds and 80 bytes of RAM; on a Cortex-M4F at -O2 about 4081 bytes of
 * flash and 132 bytes of stack. Style: compact. Arithmetic: plain. Digits of the design: 100.
 */
#ifndef LOOP_H
#define LOOP_H

#include <math.h>
#include <stddef.h>

#include "lqg/lqg.h"

#ifndef LQG_REAL_DOUBLE
#error "loop.h computes in double: define LQG_REAL_DOUBLE for the library and for this file, or run lqgen with other options."
#endif
#ifdef LQG_FUSED
#error "loop.h uses plain arithmetic: do not define LQG_FUSED for the library and for this file, or run lqgen with other options."
#endif

#if LQG_HEADER_FORMAT != 2
#error "loop.h was made by lqgen 0.1.0, which this TinyLQG does not know: run the lqgen of this TinyLQG on loop.toml again."
#endif

#if defined __SIZEOF_DOUBLE__ && __SIZEOF_DOUBLE__ < 8
#error "loop.h computes in double, which has less than 64 bits here: run lqgen with --real float."
#endif

#define LOOP_NX 2  /* states */
#define LOOP_NU 1  /* inputs */
#define LOOP_NY 1  /* outputs */
#define LOOP_NR 1  /* references */
#define LOOP_X_BOUNDS {18446744073709551616.0, 18446744073709551616.0}  /* x̂ stays below them in size, or begins anew */
#define LOOP_RECOVERY_SAMPLES 1500  /* after a fault has ended its effect is below the noise */
#define LOOP_SAMPLE_TIME 0.1  /* s between two samples */

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

enum {
    LOOP_R_POSITION = 0  /* [m] */
};

/* The whole state of the controller: no pointers inside, may be copied. Begin it with loop_init. */
typedef struct {
    double x[LOOP_NX];  /* x̂, the estimate: of this sample after update, of the next after predict */
    double widening[LOOP_NY];  /* how much wider than its σ the gate is, squared: more while an output is left out */
    double innovation[LOOP_NY];  /* what predict has yet to hear of the last outputs */
    double r[LOOP_NR];  /* what the outputs should be: write it at any time */
    double xi[1];  /* ξ, the integral of r − y */
    double error[1];  /* r − y of this sample, which predict adds to ξ */
    double demand[LOOP_NU];  /* what the law asked for, before its limits */
    unsigned sample;  /* how many samples are over; stops with the last that has gains of its own */
    unsigned gain_row;  /* the same for the filter's gains; 0 after a reset */
    unsigned long resets;  /* how often it began anew, since init; after ULONG_MAX comes 0 */
    unsigned long gated[LOOP_NY];  /* how often the gate left an output out */
} loop_t;

static const lqg_real LOOP_KALMAN_WIDENING[1] = {
    1.0
};
static const lqg_real LOOP_KALMAN_WIDEN[1] = {
    1.5
};
static const lqg_real LOOP_KALMAN_NARROW[1] = {
    0.76953125
};
static const lqg_real LOOP_KALMAN_A[4] = {
    1.0, 0.1,
    0.0, 1.0
};
static const lqg_real LOOP_KALMAN_B[2] = {
    0.005000000000000001,
    0.1
};
static const lqg_real LOOP_KALMAN_C[2] = {
    1.0, 0.0
};
static const lqg_real LOOP_KALMAN_S[5] = {
    0.027406289148909704,
    0.021510939006219566,
    0.017702882705168236,
    0.015040313625548031,
    0.01307395047140057
};
static const lqg_real LOOP_KALMAN_X_SCALE[2] = {
    5.421010862427522e-20, 5.421010862427522e-20
};
static const lqg_real LOOP_KALMAN_LIMIT[1] = {
    36893488147419103232.0
};
static const lqg_real LOOP_KALMAN_L[10] = {
    0.6351202475582935,
    0.3146334259707735,
    0.5351202475582936,
    0.3146334259707735,
    0.4351202475582935,
    0.3146334259707735,
    0.3351202475582935,
    0.3146334259707735,
    0.23512024755829347,
    0.3146334259707735
};
static const lqg_real LOOP_KALMAN_M[10] = {
    0.0038243987622085334,
    0.07648797524417066,
    0.0038243987622085334,
    0.07648797524417066,
    0.0038243987622085334,
    0.07648797524417066,
    0.0038243987622085334,
    0.07648797524417066,
    0.0038243987622085334,
    0.07648797524417066
};
static const lqg_kalman_steady_t LOOP_KALMAN = {
    {LOOP_NX, 1, LOOP_NY, LOOP_KALMAN_A, LOOP_KALMAN_B, LOOP_KALMAN_C, NULL},  /* nx, nu, ny, A, B, C, D */
    LOOP_KALMAN_L, LOOP_KALMAN_M, NULL,  /* L, M, x0 */
    LOOP_KALMAN_X_SCALE, LOOP_KALMAN_LIMIT  /* x_scale, innovation_limit */
};
static const lqg_real LOOP_SERVO_K[18] = {
    6.0, 4.5, -3.0,
    5.6, 4.199999999999999, -2.8,
    5.2, 3.9000000000000004, -2.6,
    4.8, 3.5999999999999996, -2.4,
    4.4, 3.3000000000000003, -2.2,
    4.0, 3.0, -2.0
};
static const lqg_real LOOP_SERVO_H[6] = {
    0.3,
    0.3,
    0.3,
    0.3,
    0.3,
    0.3
};
static const lqg_real LOOP_SERVO_H_INPUT[6] = {
    0.3333333333333333,
    0.35714285714285715,
    0.3846153846153846,
    0.4166666666666667,
    0.45454545454545453,
    0.5
};
static const unsigned LOOP_SERVO_OUTPUT[1] = {0};
static const unsigned LOOP_SERVO_REFERENCE[1] = {0};
static const lqg_real LOOP_SERVO_U_MIN[1] = {
    -0.6
};
static const lqg_real LOOP_SERVO_U_MAX[1] = {
    0.5
};
static const lqg_real LOOP_SERVO_XI_SCALE[1] = {
    5.421010862427522e-20
};
static const lqg_real LOOP_SERVO_ERROR_LIMIT[1] = {
    36893488147419103232.0
};
static const lqg_servo_t LOOP_SERVO = {
    LOOP_NX, LOOP_NU, 1, 1, 0, LOOP_SAMPLE_TIME,  /* nx, nu, nr, nxi, gives_change, T */
    LOOP_SERVO_K, NULL, LOOP_SERVO_H, NULL, LOOP_SERVO_OUTPUT, LOOP_SERVO_REFERENCE,  /* K, Nbar, H, H_input, output, reference */
    LOOP_SERVO_U_MIN, LOOP_SERVO_U_MAX, NULL, LOOP_SERVO_XI_SCALE, LOOP_SERVO_ERROR_LIMIT  /* u_min, u_max, u_step, xi_scale, error_limit */
};

LQG_STRICT_BEGIN

/* x̂ = x0, ξ = 0, r = 0; nothing applied yet. */
static inline void loop_init(loop_t *self)
{
    lqg_kalman_steady_init(&LOOP_KALMAN, self->x, NULL, self->innovation);
    lqg_servo_init(&LOOP_SERVO, self->xi, self->error, self->demand, NULL);
    for (int i = 0; i < LOOP_NR; i++)
        self->r[i] = 0;
    self->sample = 0;
    self->gain_row = 0;
    self->resets = 0;
    for (int i = 0; i < LOOP_NY; i++) {
        self->widening[i] = LOOP_KALMAN_WIDENING[i];
        self->gated[i] = 0;
    }
}

/* Begins anew, but for r and the time and what was counted, and counts it: the state was not within its bounds. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static lqg_status loop_reset(loop_t *self, lqg_status status)
{
    double r[LOOP_NR];
    const unsigned sample = self->sample;
    const unsigned long resets = self->resets + 1;
    unsigned long gated[LOOP_NY];

    for (int i = 0; i < LOOP_NR; i++)
        r[i] = self->r[i];
    for (int i = 0; i < LOOP_NY; i++)
        gated[i] = self->gated[i];
    loop_init(self);
    for (int i = 0; i < LOOP_NR; i++)
        self->r[i] = r[i];
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
static inline lqg_status loop_update(loop_t *self, const double y[LOOP_NY])
{
    lqg_real work[LQG_KALMAN_STEADY_WORK(LOOP_NX, LOOP_NY)];
    lqg_real observed[LOOP_NY];
    unsigned char heard[LOOP_NY];
    lqg_kalman_steady_t kalman = *&LOOP_KALMAN;
    kalman.L += (self->gain_row < 4 ? self->gain_row : 4) * (LOOP_NX * LOOP_NY);
    kalman.M += (self->gain_row < 4 ? self->gain_row : 4) * (LOOP_NX * LOOP_NY);
    const lqg_watch_t watch = {NULL, 300.0, self->gated, NULL, NULL, self->widening, LOOP_KALMAN_WIDEN, LOOP_KALMAN_NARROW, heard};
    const lqg_status status = lqg_kalman_steady_update_watched(&kalman, self->x, NULL, self->innovation, y, LOOP_KALMAN_S + (self->gain_row < 4 ? self->gain_row : 4) * LOOP_NY, &watch, work);

    for (int i = 0; i < LOOP_NY; i++)
        observed[i] = heard[i] ? y[i] : (lqg_real)NAN;
    lqg_servo_observe(&LOOP_SERVO, self->r, self->error, observed);
    return status & LQG_STATE_RESET ? loop_reset(self, status) : status;
}

/* u = −K [x̂; ξ], within its limits
 *
 * u  out: the inputs, in their units: finite and within the limits, whatever came in
 *
 * Status: LQG_REFERENCE_NOT_FINITE (such an r counts as 0), LQG_INPUT_LIMITED. */
static inline lqg_status loop_control(loop_t *self, double u[LOOP_NU])
{
    lqg_servo_t servo = LOOP_SERVO;
    servo.K += (self->sample < 5 ? self->sample : 5) * 3;
    servo.H += (self->sample < 5 ? self->sample : 5) * 1;

    return lqg_servo_control(&servo, self->x, self->r, self->xi, self->demand, NULL, u);
}

/* x̂ ← A x̂ + B u,  ξ ← ξ + H (u − what control asked for) + T (r − y): from this sample to the next.
 *
 * u  in: what was applied, in its units; not what was asked for, where the two differ
 *
 * Status: LQG_STATE_RESET. */
static inline lqg_status loop_predict(loop_t *self, const double u[LOOP_NU])
{
    lqg_real work[LQG_KALMAN_STEADY_WORK(LOOP_NX, LOOP_NY)];
    lqg_kalman_steady_t kalman = *&LOOP_KALMAN;
    kalman.L += (self->gain_row < 4 ? self->gain_row : 4) * (LOOP_NX * LOOP_NY);
    kalman.M += (self->gain_row < 4 ? self->gain_row : 4) * (LOOP_NX * LOOP_NY);
    lqg_servo_t servo = LOOP_SERVO;
    servo.K += (self->sample < 5 ? self->sample : 5) * 3;
    servo.H += (self->sample < 5 ? self->sample : 5) * 1;
    lqg_status status = lqg_kalman_steady_predict(&kalman, self->x, NULL, self->innovation, u, work);

    status |= lqg_servo_advance(&servo, self->xi, self->error, self->demand, NULL, u);
    self->sample = self->sample < 5 ? self->sample + 1 : 5;
    self->gain_row = self->gain_row < 4 ? self->gain_row + 1 : 4;
    return status & LQG_STATE_RESET ? loop_reset(self, status) : status;
}

/* One sample: control, update and predict, for an actuator that applies u as it is. */
static inline lqg_status loop_step(loop_t *self, const double y[LOOP_NY], double u[LOOP_NU])
{
    lqg_status status = loop_control(self, u);

    status |= loop_update(self, y);
    status |= loop_predict(self, u);
    return status;
}

/* The update by position alone, for a sensor with a rate of its own; any number of predictions may lie between two.
 * There is no other: it is the update.
 *
 * y_position  in: the output, in m. One that is not finite, absurd or more than 300 σ off is left out.
 *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
static inline lqg_status loop_update_position(loop_t *self, const double y_position)
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
static inline void loop_innovation(const loop_t *self, const double y[LOOP_NY],
    double nu[LOOP_NY], double S[LOOP_NY])
{
    LQG_STRICT_BODY
    const double variance = LOOP_KALMAN_S[(self->gain_row < 4 ? self->gain_row : 4) * LOOP_NY + 0];
    const double x_0 = self->x[0];
    const double y_0 = y[0];

    /* output 0, position [m]: innovation = y − C x̂ */
    const double innovation_position = y_0 - x_0;
    nu[0] = innovation_position;

    S[0] = variance;
}

/* x̂ ← x, by hand. loop_set_input may follow.
 *
 * x  in: the state, in its units
 *
 * Status: LQG_STATE_RESET, when x is not within LOOP_X_BOUNDS. */
static inline lqg_status loop_set_state(loop_t *self, const double x[LOOP_NX])
{
    LQG_STRICT_BODY
    const double x_0 = x[0];
    const double x_1 = x[1];

    /* Σ x² in units of a bound */
    const double sum = x_0 * x_0;
    const double sum_a = sum + x_1 * x_1;

    self->innovation[0] = 0.0;
    self->x[0] = x_0;
    self->x[1] = x_1;

    const lqg_status status = LQG_OK;
    if (!(sum_a < 3.402823669209385e+38))
        return loop_reset(self, status);
    return status;
}

/* The input was u, set by hand.
 * ξ becomes such that control goes on there: to be called before control.
 *
 * u  in: what was applied, in its units
 *
 * Status: LQG_REFERENCE_NOT_FINITE, LQG_STATE_RESET, when that is not finite. */
static inline lqg_status loop_set_input(loop_t *self, const double u[LOOP_NU])
{
    LQG_STRICT_BODY
    const double *const K = LOOP_SERVO_K + (self->sample < 5 ? self->sample : 5) * 3;
    const double *const H_input = LOOP_SERVO_H_INPUT + (self->sample < 5 ? self->sample : 5) * 1;
    const double K_00 = K[0];
    const double K_01 = K[1];
    const double K_02 = K[2];
    const double H_input_00 = H_input[0];
    const double x_0 = self->x[0];
    const double x_1 = self->x[1];
    const double r_0 = self->r[0];
    const double integral_0 = self->xi[0];
    const double u_0 = u[0];

    /* ξ ← ξ + H_input (u − what the law asks for): it asks for u next */
    const double law_0 = -(K_00 * x_0) - K_01 * x_1 - K_02 * integral_0;
    const double xi_0 = integral_0 + H_input_00 * (u_0 - law_0);
    self->xi[0] = xi_0;
    const double sum = xi_0 * xi_0;

    self->demand[0] = u_0;

    const lqg_status status = (!(r_0 - r_0 == 0.0) ? LQG_REFERENCE_NOT_FINITE : LQG_OK);
    if (!(u_0 - u_0 < 3.402823669209385e+38 - sum))
        return loop_reset(self, status);
    return status;
}

LQG_STRICT_END

#endif
