/* double_integrator: mass on a frictionless axis
 *
 * Made by lqgen 0.2.0 from double_integrator.toml with the SHA-256
 * 9735ad7912f2b8fda1a8144a1e4e7cb6b5e0d8dc3f96c5e226f711c04c46fd48.
 * Do not edit: change the design and run lqgen again. This file is yours: use it under any licence.
 *
 * What is called when:
 *
 *   once                   double_integrator_init(&loop)                          at the start
 *   each sample            double_integrator_update(&loop, y)                     y has been measured
 *                          double_integrator_control(&loop, u)                    u for the actuator
 *                          double_integrator_predict(&loop, u)                    the u that was applied
 *     or                   double_integrator_step(&loop, y, u)                    all three in one call
 *   a sensor has failed    y[i] = NAN                                             that output is not used
 *   to watch the sensors   double_integrator_innovation(&loop, y, innovation, S)  before update
 *   in manual mode         double_integrator_predict(&loop, u)
 *                            after update, with the manual u; no control
 *   the state is known     double_integrator_set_state(&loop, x)                  between predict and update
 *   after LQG_STATE_RESET  the same calls as before                               x̂ is that of init
 *
 * A status other than LQG_OK says what happened; each function lists its bits.
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
 * Kalman filter, filter form (u[k] depends on the outputs up to y[k]),
 * covariance updated on line as a lower triangle; covariances per sample, gain in the steady state:
 *
 *   G = [ 5e-05 ]
 *       [  0.01 ]
 *   W = E[w wᵀ] = [ 1.0 ]
 *   V = E[v vᵀ] = [ 1e-06 ]
 *   L = [ 0.36 ]
 *       [  8.0 ]
 *   poles of A − L_predictor C: 0.78 ± 0.1778i
 *   limit of |x̂_i| (reset when exceeded): 4.295e+09, 4.295e+09
 *   innovation limit: 8.59e+09
 *
 * Closed loop, opened at the plant's input:
 *
 *   gain margin         14.08 dB, up 14.08
 *   phase margin        44.95° at 21.77 rad/s
 *   delay margin        3.603 samples, 0.03603 s
 *   disk margin         0.7929
 *   cost per sample     0.09448
 *
 * One sample takes 30 multiply-adds and 36 bytes of RAM. By arm-none-eabi-gcc 12.2 at -O2, for a
 * Cortex-M4F, at most 1232 bytes of flash and 48 bytes of stack.
 * Style: unrolled. Arithmetic: plain. Digits of the design: 100.
 */
#ifndef DOUBLE_INTEGRATOR_H
#define DOUBLE_INTEGRATOR_H

#include <math.h>
#include <stdbool.h>

#include "lqg/arithmetic.h"
#include "lqg/status.h"
#include "lqg/version.h"

#if LQG_HEADER_FORMAT != 3
#error "This file needs header format 3, the library has another one: regenerate it with the library's lqgen."
#endif

#define DOUBLE_INTEGRATOR_NX 2  /* states */
#define DOUBLE_INTEGRATOR_NU 1  /* inputs */
#define DOUBLE_INTEGRATOR_NY 1  /* outputs */
/* Limit of |x̂_i|: the state is reset when it is reached. */
#define DOUBLE_INTEGRATOR_X_BOUNDS { \
    4294967296.0f,  /* 2^32: position [m] */ \
    4294967296.0f  /* 2^32: speed [m/s] */ \
}
#define DOUBLE_INTEGRATOR_RECOVERY_SAMPLES 980  /* samples after a fault until its effect is below the noise */
#define DOUBLE_INTEGRATOR_SAMPLE_TIME 0.01f  /* s, plant.sample_time */

/* Limits, bounds and thresholds of the code below, each with its unit and origin. */
#define DOUBLE_INTEGRATOR_U_MIN_ACCELERATION     (-10.0f)        /* m/s^2, limits.u_min = -10.0 */
#define DOUBLE_INTEGRATOR_U_MAX_ACCELERATION     10.0f           /* m/s^2, limits.u_max = 10.0 */
#define DOUBLE_INTEGRATOR_GATE_SQUARED           90000.0f        /* 300²: kalman.spike squared */
#define DOUBLE_INTEGRATOR_INNOVATION_LIMIT       8589934592.0f   /* 2^33: |innovation| is below it, or rejected */
#define DOUBLE_INTEGRATOR_GATE_WIDEN             1.5f            /* factor of w in a sample that rejects the output */
#define DOUBLE_INTEGRATOR_GATE_NARROW            0.75f           /* factor of w in a sample that uses the output */
#define DOUBLE_INTEGRATOR_LIMIT_SQUARED_POSITION 7.378698e+19f   /* m², 2^66: the innovation limit squared */
#define DOUBLE_INTEGRATOR_TWO_TO_64              1.8446744e+19f  /* 2^64 */
#define DOUBLE_INTEGRATOR_TWO_TO_80              1.2089258e+24f  /* 2^80 */

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

/* The whole state of the controller. It has no pointers and may be copied. Initialise it with double_integrator_init.
 * */
typedef struct {
    float x[DOUBLE_INTEGRATOR_NX];  /* estimate x̂: of this sample after update, of the next one after predict */
    float P[3];  /* covariance of the error of x̂: lower triangle, P_ij at [i*(i+1)/2 + j] */
    float widening[DOUBLE_INTEGRATOR_NY];  /* w ≥ 1, widening of the gate: it grows while the output is rejected */
    unsigned long resets;  /* resets of the state since init; wraps to 0 */
    unsigned long covariance_resets;  /* resets of P alone since init; wraps to 0 */
    unsigned long gated[DOUBLE_INTEGRATOR_NY];  /* how often the gate has rejected an output; wraps to 0 */
} double_integrator_t;

LQG_STRICT_BEGIN
#if defined __GNUC__ && !defined __clang__  /* loads numbers where they are needed */
#pragma GCC optimize ("no-tree-ter", "no-tree-pre")
#endif

/* Initial state: x̂ = x0, its covariance P = P0, counters = 0. */
static inline void double_integrator_init(double_integrator_t *self)
{
    static const double_integrator_t initial = {
        {0.0f, 0.0f},  /* x: the initial state x0 */
        {0.01f, 0.0f, 0.01f},  /* P: the initial covariance P0 */
        {1.0f},  /* widening: of the variance of the first innovation, from P0, relative to S */
        0uL,  /* resets */
        0uL,  /* covariance_resets */
        {0}  /* gated */
    };

    *self = initial;
}

/* Called if the state is not within its bounds. Resets the state, keeps the counters, increments `resets`. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static lqg_status_t double_integrator_reset(double_integrator_t *self, lqg_status_t status)
{
    const unsigned long resets = self->resets + 1uL;
    const unsigned long covariance_resets = self->covariance_resets;
    unsigned long gated[DOUBLE_INTEGRATOR_NY];

    for (int i = 0; i < DOUBLE_INTEGRATOR_NY; i++) {
        gated[i] = self->gated[i];
    }
    double_integrator_init(self);
    self->resets = resets;
    self->covariance_resets = covariance_resets;
    for (int i = 0; i < DOUBLE_INTEGRATOR_NY; i++) {
        self->gated[i] = gated[i];
    }
    return status | LQG_STATE_RESET;
}

/* Called if x̂ or P is not within its bounds, or P cannot be a covariance. Resets P to P0 and
 * increments `covariance_resets`. If x̂ is not within its bounds either, double_integrator_reset resets the whole
 * state. */
#ifdef __GNUC__
__attribute__((noinline, cold))
#endif
static lqg_status_t double_integrator_recover(double_integrator_t *self, lqg_status_t status)
{
    LQG_STRICT_BODY
    lqg_status_t outcome = status | LQG_COVARIANCE_RESET;
    const float x_position = self->x[0];
    const float x_speed = self->x[1];

    /* x̂ within its bounds;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float squares_to_x_position = x_position * x_position;
    const float squares_to_x_speed = squares_to_x_position + (x_speed * x_speed);

    self->P[0] = 0.01f;
    self->P[1] = 0.0f;
    self->P[2] = 0.01f;

    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = DOUBLE_INTEGRATOR_X_BOUNDS */
    if (squares_to_x_speed < DOUBLE_INTEGRATOR_TWO_TO_64) {
        self->covariance_resets++;
    } else {
        outcome = double_integrator_reset(self, status);
    }
    return outcome;
}

/* Decides whether an output is used whose innovation is larger than usual.
 * It is rejected if |innovation| is not below its limit, or innovation² > (300)² S w. The widening w is 1 in normal
 * operation; it grows while the output is rejected, so that the output is used again if it was right.
 *
 * i           in: the output
 * innovation  in: its innovation
 * S           in: the variance of the innovation
 *
 * Returns LQG_OK if it is used, else the reason why it is not. */
#ifdef __GNUC__
__attribute__((noinline, cold))
#endif
static lqg_status_t double_integrator_weigh(double_integrator_t *self, int i, float innovation, float S)
{
    LQG_STRICT_BODY
    const float widening = self->widening[i];
    const float variance = S;

    /* the widening, at least 1 */
    const float width_or_1 = (1.0f < widening) ? widening : 1.0f;
    const float width = (width_or_1 < DOUBLE_INTEGRATOR_TWO_TO_80) ? width_or_1
        : DOUBLE_INTEGRATOR_TWO_TO_80;

    /* 0 < S, |innovation| below its limit, innovation² ≤ gate² S widening */
    const bool believable = fabsf(innovation) < DOUBLE_INTEGRATOR_INNOVATION_LIMIT;
    lqg_status_t fault = LQG_OK;
    if (!(believable && (0.0f < variance))) {
        if (believable) {
            fault = LQG_INNOVATION_NOT_POSITIVE;
        } else {
            fault = (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(i));
        }
    }
    const bool usable = fault == LQG_OK;
    const bool beyond = (DOUBLE_INTEGRATOR_GATE_SQUARED * variance * width) < (innovation
        * innovation);
    const bool gated = usable && beyond;
    const bool used = usable && !beyond;

    /* it widens or narrows */
    const float next_width = (used ? DOUBLE_INTEGRATOR_GATE_NARROW
        : gated ? DOUBLE_INTEGRATOR_GATE_WIDEN : 1.0f) * width;
    const float next_width_or_1 = (1.0f < next_width) ? next_width : 1.0f;

    self->widening[i] = (next_width_or_1 < DOUBLE_INTEGRATOR_TWO_TO_80) ? next_width_or_1
        : DOUBLE_INTEGRATOR_TWO_TO_80;

    lqg_status_t status = LQG_OK;
    if (gated) {
        self->gated[i]++;
    }
    status |= fault;
    if (gated) {
        status |= LQG_OUTPUT_GATED;
    }
    return status;
}

/* x̂ ← x̂ + L (y − C x̂),  L = P Cᵀ S⁻¹,  P ← P − L C P
 *
 * y  in: the outputs, in their units. An output that is not finite, or further than 300 σ from its expected value
 *        is not used in this sample.
 *
 * Status: LQG_OUTPUT_REJECTED, LQG_OUTPUT_GATED, LQG_INNOVATION_NOT_POSITIVE, LQG_COVARIANCE_RESET, LQG_STATE_RESET. */
static inline lqg_status_t double_integrator_update(double_integrator_t *self, const float y[DOUBLE_INTEGRATOR_NY])
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;
    const float x_position = self->x[0];
    const float x_speed = self->x[1];
    const float P_00 = self->P[0];
    const float P_10 = self->P[1];
    const float P_11 = self->P[2];
    const float widening_position = self->widening[0];
    const float y_position = y[0];

    /* output 0, position [m]: cov(x̂, y) = P Cᵀ,  S = C P Cᵀ + V */
    const float variance_position = 1e-06f + P_00;

    /* output 0, position [m]: innovation = y − C x̂; a gain of 0 leaves the output out */
    const float raw_innovation_position = y_position - x_position;
    const float gate_square_position = DOUBLE_INTEGRATOR_GATE_SQUARED * variance_position;
    const float threshold_position = (gate_square_position
        < DOUBLE_INTEGRATOR_LIMIT_SQUARED_POSITION) ? gate_square_position
        : DOUBLE_INTEGRATOR_LIMIT_SQUARED_POSITION;
    int usable_position = (((raw_innovation_position * raw_innovation_position)
        < threshold_position) && !(1.0f < widening_position)) ? 1 : 0;
    if (usable_position == 0) {
        const lqg_status_t reason = double_integrator_weigh(self, 0, raw_innovation_position,
            variance_position);
        usable_position = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float reciprocal_position = (usable_position != 0) ? (1.0f / variance_position) : 0.0f;
    const float innovation_position = (usable_position != 0) ? raw_innovation_position : 0.0f;

    /* output 0, position [m]: L = P Cᵀ / S,  x̂ ← x̂ + L innovation,  P ← P − L (P Cᵀ)ᵀ */
    const float gain_speed_position = P_10 * reciprocal_position;
    const float x_speed_position = x_speed + (gain_speed_position * innovation_position);
    self->x[1] = x_speed_position;
    const float P_11_position = P_11 - (gain_speed_position * P_10);
    self->P[2] = P_11_position;
    const float P_10_position = P_10 - (gain_speed_position * P_00);
    self->P[1] = P_10_position;
    const float gain_position_position = P_00 * reciprocal_position;
    const float x_position_position = x_position + (gain_position_position * innovation_position);
    self->x[0] = x_position_position;
    const float P_00_position = P_00 - (gain_position_position * P_00);
    self->P[0] = P_00_position;

    /* x̂ within its bounds;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float squares_to_x_position = x_position_position * x_position_position;
    const float squares_to_x_speed = squares_to_x_position + (x_speed_position * x_speed_position);

    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = DOUBLE_INTEGRATOR_X_BOUNDS */
    if (!(squares_to_x_speed < DOUBLE_INTEGRATOR_TWO_TO_64)
        || ((status & LQG_INNOVATION_NOT_POSITIVE) != 0u)) {
        status = double_integrator_recover(self, status);
    }
    return status;
}

/* u = −K x̂, limited
 *
 * u  out: the inputs, in their units: always finite and within the limits
 *
 * Status: LQG_INPUT_LIMITED (at a limit, or not finite and set to 0). */
static inline lqg_status_t double_integrator_control(const double_integrator_t *self, float u[DOUBLE_INTEGRATOR_NU])
{
    LQG_STRICT_BODY
    const float x_position = self->x[0];
    const float x_speed = self->x[1];

    /* u = −K x̂, within its limits */
    const float law_acceleration = -(589.38544f * x_position) - (68.209404f * x_speed);
    const bool finite_acceleration = (law_acceleration - law_acceleration) == 0.0f;
    const float demand_acceleration = finite_acceleration ? law_acceleration : 0.0f;
    const bool below_acceleration = demand_acceleration < DOUBLE_INTEGRATOR_U_MIN_ACCELERATION;
    const bool above_acceleration = DOUBLE_INTEGRATOR_U_MAX_ACCELERATION < demand_acceleration;
    const float limited_acceleration = below_acceleration ? DOUBLE_INTEGRATOR_U_MIN_ACCELERATION
        : above_acceleration ? DOUBLE_INTEGRATOR_U_MAX_ACCELERATION : demand_acceleration;
    u[0] = limited_acceleration;

    lqg_status_t status = LQG_OK;
    if (!finite_acceleration) {
        status |= LQG_INPUT_LIMITED;
    }
    if (below_acceleration || above_acceleration) {
        status |= LQG_INPUT_LIMITED;
    }
    return status;
}

/* From this sample to the next:  x̂ ← A x̂ + B u,  P ← A P Aᵀ + G W Gᵀ
 *
 * u  in: the input that was applied, in its units; not the demanded one, if they differ
 *
 * Status: LQG_COVARIANCE_RESET, LQG_STATE_RESET. */
static inline lqg_status_t double_integrator_predict(double_integrator_t *self, const float u[DOUBLE_INTEGRATOR_NU])
{
    LQG_STRICT_BODY
    const float x_position = self->x[0];
    const float x_speed = self->x[1];
    const float P_00 = self->P[0];
    const float P_10 = self->P[1];
    const float P_11 = self->P[2];
    const float u_acceleration = u[0];

    /* x̂ ← A x̂ + B u;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float next_position = x_position + (0.01f * x_speed) + (5e-05f * u_acceleration);
    self->x[0] = next_position;
    const float squares_to_x_position = next_position * next_position;
    const float next_speed = x_speed + (0.01f * u_acceleration);
    self->x[1] = next_speed;
    const float squares_to_x_speed = squares_to_x_position + (next_speed * next_speed);

    /* P ← A P Aᵀ + G W Gᵀ, lower triangle;  squares_to_P_kk adds P_kk */
    const float AP_00 = P_00 + (0.01f * P_10);
    const float AP_01 = P_10 + (0.01f * P_11);
    const float prior_P_00 = 2.5e-09f + AP_00 + (0.01f * AP_01);
    self->P[0] = prior_P_00;
    const float squares_to_P_00 = squares_to_x_speed + prior_P_00;
    const float prior_P_10 = 5e-07f + P_10 + (0.01f * P_11);
    self->P[1] = prior_P_10;
    const float prior_P_11 = 1e-04f + P_11;
    self->P[2] = prior_P_11;
    const float squares_to_P_11 = squares_to_P_00 + prior_P_11;

    lqg_status_t status = LQG_OK;
    /* Σ (x_i/b_i)² + P_ii/b_i² < 1 in units of a power of two, b = DOUBLE_INTEGRATOR_X_BOUNDS; no P_ii < 0 */
    if (!((squares_to_P_11 < DOUBLE_INTEGRATOR_TWO_TO_64) && !(prior_P_00 < 0.0f)
        && !(prior_P_11 < 0.0f))) {
        status = double_integrator_recover(self, status);
    }
    return status;
}

/* One sample: update, control, predict; assumes that the actuator applies u as it is.
 * Here the three are one text, which keeps the state in registers;
 * bits and status are those of the calls. */
static inline lqg_status_t double_integrator_step(double_integrator_t *self, const float y[DOUBLE_INTEGRATOR_NY],
    float u[DOUBLE_INTEGRATOR_NU])
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;
    const float x_position = self->x[0];
    const float x_speed = self->x[1];
    const float P_00 = self->P[0];
    const float P_10 = self->P[1];
    const float P_11 = self->P[2];
    const float widening_position = self->widening[0];
    const float y_position = y[0];

    /* output 0, position [m]: cov(x̂, y) = P Cᵀ,  S = C P Cᵀ + V */
    const float variance_position = 1e-06f + P_00;

    /* output 0, position [m]: innovation = y − C x̂; a gain of 0 leaves the output out */
    const float raw_innovation_position = y_position - x_position;
    const float gate_square_position = DOUBLE_INTEGRATOR_GATE_SQUARED * variance_position;
    const float threshold_position = (gate_square_position
        < DOUBLE_INTEGRATOR_LIMIT_SQUARED_POSITION) ? gate_square_position
        : DOUBLE_INTEGRATOR_LIMIT_SQUARED_POSITION;
    int usable_position = (((raw_innovation_position * raw_innovation_position)
        < threshold_position) && !(1.0f < widening_position)) ? 1 : 0;
    if (usable_position == 0) {
        const lqg_status_t reason = double_integrator_weigh(self, 0, raw_innovation_position,
            variance_position);
        usable_position = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float reciprocal_position = (usable_position != 0) ? (1.0f / variance_position) : 0.0f;
    const float innovation_position = (usable_position != 0) ? raw_innovation_position : 0.0f;

    /* output 0, position [m]: L = P Cᵀ / S,  x̂ ← x̂ + L innovation,  P ← P − L (P Cᵀ)ᵀ */
    const float gain_speed_position = P_10 * reciprocal_position;
    float x_speed_position = x_speed + (gain_speed_position * innovation_position);
    float P_11_position = P_11 - (gain_speed_position * P_10);
    float P_10_position = P_10 - (gain_speed_position * P_00);
    const float gain_position_position = P_00 * reciprocal_position;
    float x_position_position = x_position + (gain_position_position * innovation_position);
    float P_00_position = P_00 - (gain_position_position * P_00);

    /* x̂ within its bounds;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float squares_to_x_position = x_position_position * x_position_position;
    const float squares_to_x_speed = squares_to_x_position + (x_speed_position * x_speed_position);

    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = DOUBLE_INTEGRATOR_X_BOUNDS */
    if (!(squares_to_x_speed < DOUBLE_INTEGRATOR_TWO_TO_64)
        || ((status & LQG_INNOVATION_NOT_POSITIVE) != 0u)) {
        self->x[0] = x_position_position;
        self->x[1] = x_speed_position;
        status = double_integrator_recover(self, status);
        x_position_position = self->x[0];
        x_speed_position = self->x[1];
        P_00_position = self->P[0];
        P_10_position = self->P[1];
        P_11_position = self->P[2];
    }

    /* u = −K x̂, within its limits */
    const float law_acceleration = -(589.38544f * x_position_position)
        - (68.209404f * x_speed_position);
    const bool below_acceleration = law_acceleration < DOUBLE_INTEGRATOR_U_MIN_ACCELERATION;
    const bool above_acceleration = DOUBLE_INTEGRATOR_U_MAX_ACCELERATION < law_acceleration;
    const float limited_acceleration = below_acceleration ? DOUBLE_INTEGRATOR_U_MIN_ACCELERATION
        : above_acceleration ? DOUBLE_INTEGRATOR_U_MAX_ACCELERATION : law_acceleration;
    u[0] = limited_acceleration;

    /* x̂ ← A x̂ + B u;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float next_position = x_position_position + (0.01f * x_speed_position)
        + (5e-05f * limited_acceleration);
    self->x[0] = next_position;
    const float squares_to_x_position_2 = next_position * next_position;
    const float next_speed = x_speed_position + (0.01f * limited_acceleration);
    self->x[1] = next_speed;
    const float squares_to_x_speed_2 = squares_to_x_position_2 + (next_speed * next_speed);

    /* P ← A P Aᵀ + G W Gᵀ, lower triangle;  squares_to_P_kk adds P_kk */
    const float AP_00 = P_00_position + (0.01f * P_10_position);
    const float AP_01 = P_10_position + (0.01f * P_11_position);
    const float prior_P_00 = 2.5e-09f + AP_00 + (0.01f * AP_01);
    self->P[0] = prior_P_00;
    const float squares_to_P_00 = squares_to_x_speed_2 + prior_P_00;
    const float prior_P_10 = 5e-07f + P_10_position + (0.01f * P_11_position);
    self->P[1] = prior_P_10;
    const float prior_P_11 = 1e-04f + P_11_position;
    self->P[2] = prior_P_11;
    const float squares_to_P_11 = squares_to_P_00 + prior_P_11;

    if (below_acceleration || above_acceleration) {
        status |= LQG_INPUT_LIMITED;
    }
    /* Σ (x_i/b_i)² + P_ii/b_i² < 1 in units of a power of two, b = DOUBLE_INTEGRATOR_X_BOUNDS; no P_ii < 0 */
    if (!((squares_to_P_11 < DOUBLE_INTEGRATOR_TWO_TO_64) && !(prior_P_00 < 0.0f)
        && !(prior_P_11 < 0.0f))) {
        status = double_integrator_recover(self, status);
    }
    return status;
}

/* Monitors sensors and model: the innovations y − C x̂ and their variances C P Cᵀ + V. Call it before
 * double_integrator_update.
 *
 * y           in: the outputs, in their units
 * innovation  out: the innovations
 * S           out: their variances: innovation²/S is 1 on average if the model is right
 */
static inline void double_integrator_innovation(const double_integrator_t *self, const float y[DOUBLE_INTEGRATOR_NY],
    float innovation[DOUBLE_INTEGRATOR_NY], float S[DOUBLE_INTEGRATOR_NY])
{
    LQG_STRICT_BODY
    const float x_position = self->x[0];
    const float P_00 = self->P[0];
    const float y_position = y[0];

    /* output 0, position [m]: innovation = y − C x̂ */
    const float innovation_position = y_position - x_position;
    innovation[0] = innovation_position;

    /* output 0, position [m]: S = C P Cᵀ + V */
    const float variance_position = 1e-06f + P_00;
    S[0] = variance_position;
}

/* x̂ ← x, set from outside; its covariance does not change.
 *
 * x  in: the state, in its units
 *
 * Status: LQG_STATE_RESET, if x is not within DOUBLE_INTEGRATOR_X_BOUNDS. */
static inline lqg_status_t double_integrator_set_state(double_integrator_t *self, const float x[DOUBLE_INTEGRATOR_NX])
{
    LQG_STRICT_BODY
    const float x_position = x[0];
    const float x_speed = x[1];

    /* x̂ ← x;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float squares_to_x_position = x_position * x_position;
    const float squares_to_x_speed = squares_to_x_position + (x_speed * x_speed);

    self->x[0] = x_position;
    self->x[1] = x_speed;

    lqg_status_t status = LQG_OK;
    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = DOUBLE_INTEGRATOR_X_BOUNDS */
    if (!(squares_to_x_speed < DOUBLE_INTEGRATOR_TWO_TO_64)) {
        status = double_integrator_reset(self, status);
    }
    return status;
}

LQG_STRICT_END

#endif
