/* double_integrator: mass on a frictionless axis
 *
 * Made by lqgen 0.2.0 from double_integrator.toml with the SHA-256
 * 9735ad7912f2b8fda1a8144a1e4e7cb6b5e0d8dc3f96c5e226f711c04c46fd48.
 * Do not edit: change the design and run lqgen again. This file is yours: use it under any licence.
 *
 * Plant, sampled every 0.01 s:  x⁺ = A x + B u + G w,  y = C x + D u + v
 *
 *   states   x[0] position [m], x[1] speed [m/s]
 *   inputs   u[0] acceleration [m/s^2]
 *   outputs  y[0] position [m]
 *
 *   A = [ 1.0  0.01 ]
 *       [ 0.0   1.0 ]
 *   B = [ 5e-05 ]
 *       [  0.01 ]
 *   C = [ 1.0  0.0 ]
 *   D = [ 0.0 ]
 *
 * Regulator  u = −K x̂:
 *
 *   K = [ 589.38544  68.209404 ]
 *   poles of A − B K: 0.9043, 0.3841
 *   -10.0 ≤ u[0] ≤ 10.0
 *
 * Kalman filter, filter form (u[k] is made of the outputs up to y[k]),
 * its covariance carried on line as a lower triangle; in the steady state, of samples:
 *
 *   G = [ 5e-05 ]
 *       [  0.01 ]
 *   W = E[w wᵀ] = [ 1.0 ]
 *   V = E[v vᵀ] = [ 1e-06 ]
 *   L = [ 0.36 ]
 *       [  8.0 ]
 *   poles of A − L_predictor C: 0.78 ± 0.1778i
 *   x̂ begins anew when it reaches, in size: 4.295e+09, 4.295e+09
 *   an innovation is not believed from, in size: 8.59e+09
 *
 * Closed loop, opened at the plant's input:
 *
 *   gain margin         14.08 dB, up 14.08
 *   phase margin        44.95° at 21.77 rad/s
 *   delay margin        3.603 samples, 0.03603 s
 *   disk margin         0.7929
 *   cost per sample     0.09448
 *
 * One sample takes 31 multiply-adds and 36 bytes of RAM. By arm-none-eabi-gcc 12.2 at -O2, for a
 * Cortex-M4F, at most 1186 bytes of flash and 24 bytes of stack.
 * Style: unrolled. Arithmetic: plain. Digits of the design: 100.
 */
#ifndef DOUBLE_INTEGRATOR_H
#define DOUBLE_INTEGRATOR_H

#include <math.h>

#include "lqg/arithmetic.h"
#include "lqg/status.h"
#include "lqg/version.h"

#if LQG_HEADER_FORMAT != 3
#error "double_integrator.h was made by lqgen 0.2.0, which this TinyLQG does not know: run the lqgen of this TinyLQG on double_integrator.toml again."
#endif

#define DOUBLE_INTEGRATOR_NX 2  /* states */
#define DOUBLE_INTEGRATOR_NU 1  /* inputs */
#define DOUBLE_INTEGRATOR_NY 1  /* outputs */
#define DOUBLE_INTEGRATOR_X_BOUNDS {4294967296.0f, 4294967296.0f}  /* x̂ stays below them in size, or begins anew */
#define DOUBLE_INTEGRATOR_RECOVERY_SAMPLES 980  /* after a fault has ended its effect is below the noise */
#define DOUBLE_INTEGRATOR_SAMPLE_TIME 0.01f  /* s between two samples */

enum {
    DOUBLE_INTEGRATOR_X_POSITION = 0,  /* [m] */
    DOUBLE_INTEGRATOR_X_SPEED = 1  /* [m/s] */
};

enum {
    DOUBLE_INTEGRATOR_U_ACCELERATION = 0  /* [m/s^2] */
};

enum {
    DOUBLE_INTEGRATOR_Y_POSITION = 0  /* [m] */
};

/* The whole state of the controller: no pointers inside, may be copied. Begin it with double_integrator_init. */
typedef struct {
    float x[DOUBLE_INTEGRATOR_NX];  /* x̂, the estimate: of this sample after update, of the next after predict */
    float P[3];  /* covariance of its error: lower triangle, row by row, P_ij at [i*(i+1)/2 + j] */
    float widening[DOUBLE_INTEGRATOR_NY];  /* how much wider than its σ the gate is, squared: more while an output is left out */
    unsigned long resets;  /* how often it began anew, since init; after ULONG_MAX comes 0 */
    unsigned long covariance_resets;  /* how often P alone began anew, likewise */
    unsigned long gated[DOUBLE_INTEGRATOR_NY];  /* how often the gate left an output out */
} double_integrator_t;

LQG_STRICT_BEGIN
#if defined __GNUC__ && !defined __clang__
#pragma GCC optimize ("no-schedule-insns", "no-tree-ter", "no-tree-pre")  /* as written: few values wait in registers */
#endif

/* x̂ = x0, its covariance P0; nothing applied yet. */
static inline void double_integrator_init(double_integrator_t *self)
{
    static const double_integrator_t initial = {
        {0.0f, 0.0f},
        {0.01f, 0.0f, 0.01f},
        {1.0f},
        0,
        0,
        {0}
    };

    *self = initial;
}

/* Begins anew, but for what was counted, and counts it: the state was not within its bounds. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static lqg_status_t double_integrator_reset(double_integrator_t *self, lqg_status_t status)
{
    const unsigned long resets = self->resets + 1;
    const unsigned long covariance_resets = self->covariance_resets;
    unsigned long gated[DOUBLE_INTEGRATOR_NY];

    for (int i = 0; i < DOUBLE_INTEGRATOR_NY; i++)
        gated[i] = self->gated[i];
    double_integrator_init(self);
    self->resets = resets;
    self->covariance_resets = covariance_resets;
    for (int i = 0; i < DOUBLE_INTEGRATOR_NY; i++)
        self->gated[i] = gated[i];
    return status | LQG_STATE_RESET;
}

/* After a sample that left x̂ or P beyond its bounds, or P no covariance: P begins anew, and is counted. Where x̂
 * is not within its bounds either, all begins anew. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static lqg_status_t double_integrator_recover(double_integrator_t *self, lqg_status_t status)
{
    LQG_STRICT_BODY
    const float x_0 = self->x[0];
    const float x_1 = self->x[1];

    /* Σ x̂² in units of a bound */
    const float sum = x_0 * x_0;
    const float sum_a = sum + x_1 * x_1;

    self->P[0] = 0.01f;
    self->P[1] = 0.0f;
    self->P[2] = 0.01f;

    if (!(sum_a < 1.8446744e+19f))
        return double_integrator_reset(self, status);
    self->covariance_resets++;
    return status | LQG_COVARIANCE_RESET;
}

/* Whether output i is used, whose innovation is not as expected: it is not where that is not believable, or beyond
 * 300 σ √widening, σ² = S. The widening is 1 as long as all is well, and what was left out too often is heard
 * again. */
#ifdef __GNUC__
__attribute__((noinline, cold))
#endif
static int double_integrator_weigh(double_integrator_t *self, lqg_status_t *status, int i, float innovation, float S)
{
    LQG_STRICT_BODY
    const float widening = self->widening[i];
    const float variance = S;

    /* the widening, at least 1 */
    const float wide = 1.0f < widening ? widening : 1.0f;
    const float width = wide < 1.2089258e+24f ? wide : 1.2089258e+24f;

    /* 0 < S, |innovation| below its limit, innovation² ≤ gate² S widening */
    const int believable = fabsf(innovation) < 8589934592.0f;
    const lqg_status_t fault = believable && 0.0f < variance ? LQG_OK : believable
        ? LQG_INNOVATION_NOT_POSITIVE : (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(i));
    const int usable = fault == LQG_OK;
    const int beyond = 90000.0f * variance * width < innovation * innovation;
    const int gated = usable && beyond;
    const int used = usable && !beyond;

    /* it widens or narrows */
    const float next_width = (used ? 0.75f : gated ? 1.5f : 1.0f) * width;
    const float wide_a = 1.0f < next_width ? next_width : 1.0f;

    self->widening[i] = wide_a < 1.2089258e+24f ? wide_a : 1.2089258e+24f;

    self->gated[i] += gated ? 1 : 0;
    *status |= fault | (gated ? LQG_OUTPUT_GATED : LQG_OK);
    return used;
}

/* x̂ ← x̂ + L (y − C x̂),  L = P Cᵀ S⁻¹,  P ← P − L C P
 *
 * y  in: the outputs, in their units. An output that is not finite, absurd or more than 300 σ off is left out of this sample.
 *
 * Status: LQG_OUTPUT_REJECTED, LQG_OUTPUT_GATED, LQG_INNOVATION_NOT_POSITIVE, LQG_COVARIANCE_RESET, LQG_STATE_RESET. */
static inline lqg_status_t double_integrator_update(double_integrator_t *self, const float y[DOUBLE_INTEGRATOR_NY])
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;
    const float x_0 = self->x[0];
    const float x_1 = self->x[1];
    const float P_00 = self->P[0];
    const float P_10 = self->P[1];
    const float P_11 = self->P[2];
    const float widening_0 = self->widening[0];
    const float y_0 = y[0];

    /* output 0, position [m]: S = C P Cᵀ + V, P Cᵀ first */
    const float S_position = 1e-06f + P_00;

    /* output 0, position [m]: innovation = y − C x̂; a gain of 0 leaves the output out */
    const float measured_position = y_0 - x_0;
    const float shared_27 = 90000.0f * S_position;
    const float threshold_position = shared_27 < 7.378698e+19f ? shared_27 : 7.378698e+19f;
    int usable_position = measured_position * measured_position < threshold_position && !(1.0f < widening_0);
    if (!usable_position)
        usable_position = double_integrator_weigh(self, &status, 0, measured_position, S_position);
    const float reciprocal_position = usable_position ? 1.0f / S_position : 0.0f;
    const float innovation_position = usable_position ? measured_position : 0.0f;

    /* output 0, position [m]: L = P Cᵀ / S,  x̂ ← x̂ + L innovation,  P ← P − L (P Cᵀ)ᵀ */
    const float gain_1_position = P_10 * reciprocal_position;
    const float x_1_position = x_1 + gain_1_position * innovation_position;
    self->x[1] = x_1_position;
    const float P_11_position = P_11 - gain_1_position * P_10;
    self->P[2] = P_11_position;
    const float P_10_position = P_10 - gain_1_position * P_00;
    self->P[1] = P_10_position;
    const float gain_0_position = P_00 * reciprocal_position;
    const float x_0_position = x_0 + gain_0_position * innovation_position;
    self->x[0] = x_0_position;
    const float P_00_position = P_00 - gain_0_position * P_00;
    self->P[0] = P_00_position;

    /* Σ x̂² in units of a bound */
    const float sum = x_0_position * x_0_position;
    const float sum_a = sum + x_1_position * x_1_position;

    if (!(sum_a < 1.8446744e+19f) || status & LQG_INNOVATION_NOT_POSITIVE)
        return double_integrator_recover(self, status);
    return status;
}

/* u = −K x̂, within its limits
 *
 * u  out: the inputs, in their units: finite and within the limits, whatever came in
 *
 * Status: LQG_INPUT_LIMITED. */
static inline lqg_status_t double_integrator_control(const double_integrator_t *self, float u[DOUBLE_INTEGRATOR_NU])
{
    LQG_STRICT_BODY
    const float x_0 = self->x[0];
    const float x_1 = self->x[1];

    /* u = −K x̂, within its limits */
    const float law_0 = -(589.38544f * x_0) - 68.209404f * x_1;
    const int finite_0 = law_0 - law_0 == 0.0f;
    const float demand_0 = finite_0 ? law_0 : 0.0f;
    const int shared_30 = demand_0 < -10.0f;
    const int shared_31 = 10.0f < demand_0;
    const float limited_0 = shared_30 ? -10.0f : shared_31 ? 10.0f : demand_0;
    u[0] = limited_0;

    return (!finite_0 ? LQG_INPUT_LIMITED : LQG_OK) | (shared_30 || shared_31 ? LQG_INPUT_LIMITED : LQG_OK);
}

/* x̂ ← A x̂ + B u,  P ← A P Aᵀ + G W Gᵀ: from this sample to the next.
 *
 * u  in: what was applied, in its units; not what was asked for, where the two differ
 *
 * Status: LQG_COVARIANCE_RESET, LQG_STATE_RESET. */
static inline lqg_status_t double_integrator_predict(double_integrator_t *self, const float u[DOUBLE_INTEGRATOR_NU])
{
    LQG_STRICT_BODY
    const float x_0 = self->x[0];
    const float x_1 = self->x[1];
    const float P_00 = self->P[0];
    const float P_10 = self->P[1];
    const float P_11 = self->P[2];
    const float u_0 = u[0];

    /* x̂ ← A x̂ + B u */
    const float next_0 = x_0 + 0.01f * x_1 + 5e-05f * u_0;
    self->x[0] = next_0;
    const float sum = next_0 * next_0;
    const float next_1 = x_1 + 0.01f * u_0;
    self->x[1] = next_1;
    const float sum_a = sum + next_1 * next_1;

    /* P ← A P Aᵀ + G W Gᵀ, lower triangle */
    const float AP_00 = P_00 + 0.01f * P_10;
    const float AP_01 = P_10 + 0.01f * P_11;
    const float prior_00 = 2.5e-09f + AP_00 + 0.01f * AP_01;
    self->P[0] = prior_00;
    const float sum_b = sum_a + prior_00;
    const float prior_10 = 5e-07f + P_10 + 0.01f * P_11;
    self->P[1] = prior_10;
    const float prior_11 = 1e-04f + P_11;
    self->P[2] = prior_11;
    const float sum_c = sum_b + prior_11;

    const lqg_status_t status = LQG_OK;
    if (!(sum_c < 1.8446744e+19f && !(prior_00 < 0.0f) && !(prior_11 < 0.0f)))
        return double_integrator_recover(self, status);
    return status;
}

/* One sample: update, control and predict, for an actuator that applies u as it is. */
static inline lqg_status_t double_integrator_step(double_integrator_t *self, const float y[DOUBLE_INTEGRATOR_NY], float u[DOUBLE_INTEGRATOR_NU])
{
    lqg_status_t status = double_integrator_update(self, y);

    status |= double_integrator_control(self, u);
    status |= double_integrator_predict(self, u);
    return status;
}

/* The update by position alone, for a sensor with a rate of its own; any number of predictions may lie between two.
 * There is no other: it is the update.
 *
 * y_position  in: the output, in m. One that is not finite, absurd or more than 300 σ off is left out.
 *
 * Status: LQG_OUTPUT_REJECTED, LQG_OUTPUT_GATED, LQG_INNOVATION_NOT_POSITIVE, LQG_COVARIANCE_RESET, LQG_STATE_RESET. */
static inline lqg_status_t double_integrator_update_position(double_integrator_t *self, const float y_position)
{
    return double_integrator_update(self, &y_position);
}

/* How far the outputs are from what is expected, y − C x̂ and the variance of each, C P Cᵀ + V:
 * to be called before update by those who watch the health of sensors and model.
 *
 * y           in: the outputs, in their units
 * innovation  out: y less what is expected
 * S           out: the variances; innovation²/S is 1 in the mean as long as the model holds
 */
static inline void double_integrator_innovation(const double_integrator_t *self, const float y[DOUBLE_INTEGRATOR_NY],
    float innovation[DOUBLE_INTEGRATOR_NY], float S[DOUBLE_INTEGRATOR_NY])
{
    LQG_STRICT_BODY
    const float x_0 = self->x[0];
    const float P_00 = self->P[0];
    const float y_0 = y[0];

    /* output 0, position [m]: innovation = y − C x̂ */
    const float innovation_position = y_0 - x_0;
    innovation[0] = innovation_position;

    /* output 0, position [m]: S = C P Cᵀ + V */
    const float S_position = 1e-06f + P_00;
    S[0] = S_position;
}

/* x̂ ← x, by hand; its covariance stays.
 *
 * x  in: the state, in its units
 *
 * Status: LQG_STATE_RESET, when x is not within DOUBLE_INTEGRATOR_X_BOUNDS. */
static inline lqg_status_t double_integrator_set_state(double_integrator_t *self, const float x[DOUBLE_INTEGRATOR_NX])
{
    LQG_STRICT_BODY
    const float x_0 = x[0];
    const float x_1 = x[1];

    /* Σ x² in units of a bound */
    const float sum = x_0 * x_0;
    const float sum_a = sum + x_1 * x_1;

    self->x[0] = x_0;
    self->x[1] = x_1;

    const lqg_status_t status = LQG_OK;
    if (!(sum_a < 1.8446744e+19f))
        return double_integrator_reset(self, status);
    return status;
}

LQG_STRICT_END

#endif
