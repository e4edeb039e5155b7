/* tank: level and temperature of a tank
 *
 * Made by lqgen 0.2.0 from tank.toml with the SHA-256
 * e0d8ecb82dd6855181e2e6bc087001021697d6f99dbe5047031df976b46b8e16.
 * Do not edit: change the design and run lqgen again. This file is yours: use it under any licence.
 *
 * What is called when:
 *
 *   once                   tank_init(&loop)                          at the start
 *   a new reference        loop.r[i] = …                             at any time between two calls
 *   each sample            tank_update(&loop, y)                     y has been measured
 *                          tank_control(&loop, u)                    u for the actuator
 *                          tank_predict(&loop, u)                    the u that was applied
 *     or                   tank_step(&loop, y, u)                    all three in one call
 *   a sensor has failed    y[i] = NAN                                that output is not used
 *   a sensor is slower     tank_partial_update(&loop, y, used)       instead of update
 *   to watch the sensors   tank_innovation(&loop, y, innovation, S)  before update
 *   in manual mode         tank_predict(&loop, u)                    after update, with the manual u; no control
 *   the state is known     tank_set_state(&loop, x)                  between predict and update
 *   manual to automatic    tank_set_input(&loop, u)                  the last manual input: bumpless transfer
 *   after LQG_STATE_RESET  the same calls as before                  x̂ is that of init, r is kept
 *
 * A status other than LQG_OK says what happened; each function lists its bits.
 *
 * Plant, sampled every 0.5 s:  x⁺ = A x + B u + G w,  y = C x + D u + v
 *
 *   states   x[0] level [m], x[1] temperature [K]
 *   inputs   u[0] inflow [m/s], u[1] heating [kW]
 *   outputs  y[0] level [m], y[1] temperature [K]
 *
 *   A = [ 0.99004984        0.0 ]
 *       [        0.0  0.9753099 ]
 *   B = [  0.19900332         0.0 ]
 *       [ -0.29628107  0.12345044 ]
 *   C = [ 1.0  0.0 ]
 *       [ 0.0  1.0 ]
 *   D = [ 0.0  0.0 ]
 *       [ 0.0  0.0 ]
 *
 * Regulator  u = −K [x̂; ξ] + Nbar r:
 *
 *   K = [ 2.7711725  -0.12368507  -0.48933765 ]
 *       [  3.041702    2.3978255  -0.45884758 ]
 *   Nbar = [ 0.0  -1.5403687 ]
 *          [ 0.0  0.95490813 ]
 *   ξ⁺ = ξ + T (r − y) of level
 *   anti-windup: ξ ← ξ + H (u − demand), u: what was applied, demand: what the law asked for
 *   H = [ 0.20487356  0.013735944 ]
 *   poles of A − B K: 0.8916, 0.7117, 0.4779
 *   -0.5 ≤ u[0] ≤ 1.0
 *   |change of u[0]| ≤ 0.5 per second
 *   -2.0 ≤ u[1] ≤ 6.0
 *   |change of u[1]| ≤ 4.0 per second
 *
 * Kalman filter, filter form (u[k] depends on the outputs up to y[k]),
 * constant gain; covariances per sample:
 *
 *   G = [ 1.0  0.0 ]
 *       [ 0.0  1.0 ]
 *   W = E[w wᵀ] = [ 4.9503316e-05           0.0 ]
 *                 [           0.0  0.0048770574 ]
 *   V = E[v vᵀ] = [ 2e-04   0.0 ]
 *                 [   0.0  0.08 ]
 *   L = [ 0.38432372         0.0 ]
 *       [        0.0  0.20196564 ]
 *   poles of A − L_predictor C: 0.7783, 0.6096
 *   limit of |x̂_i| (reset when exceeded): 1.1e+12, 1.1e+12
 *   innovation limit: 2.199e+12, 2.199e+12
 *   limit of |ξ_i| (reset when exceeded): 1.1e+12
 *
 * Closed loop, opened at the plant's input:
 *
 *   gain margin         22.81 dB, up 22.81
 *   phase margin        60.04° at 0.65 rad/s
 *   delay margin        3.224 samples, 1.612 s
 *   disk margin         1.101
 *   cost per sample     0.01391
 *   cost per second     0.03053
 *
 * One sample takes 41 multiply-adds and 60 bytes of RAM. By arm-none-eabi-gcc 12.2 at -O2, for a
 * Cortex-M4F, at most 1734 bytes of flash and 116 bytes of stack.
 * Style: unrolled. Arithmetic: fused. Digits of the design: 100.
 */
#ifndef TANK_H
#define TANK_H

#include <math.h>
#include <stdbool.h>

#include "lqg/arithmetic.h"
#include "lqg/status.h"
#include "lqg/version.h"

#if LQG_HEADER_FORMAT != 3
#error "This file needs header format 3, the library has another one: regenerate it with the library's lqgen."
#endif

#if !LQG_HAS_FMAF && !defined LQG_SLOW_FUSED
#pragma message("tank: fused multiply-adds are slow here. Compile for a processor that has them (x86: -mfma), \
run lqgen with arithmetic = \"plain\", or define LQG_SLOW_FUSED.")
#endif

#define TANK_NX 2  /* states */
#define TANK_NU 2  /* inputs */
#define TANK_NY 2  /* outputs */
#define TANK_NR 2  /* references */
/* Limit of |x̂_i|: the state is reset when it is reached. */
#define TANK_X_BOUNDS { \
    1099511627776.0f,  /* 2^40: level [m] */ \
    1099511627776.0f  /* 2^40: temperature [K] */ \
}
#define TANK_RECOVERY_SAMPLES 800  /* samples after a fault until its effect is below the noise */
#define TANK_SAMPLE_TIME 0.5f  /* s, plant.sample_time */

/* Limits, bounds and thresholds of the code below, each with its unit and origin. */
#define TANK_U_MIN_INFLOW                    (-0.5f)           /* m/s, limits.u_min = -0.5 */
#define TANK_U_MAX_INFLOW                    1.0f              /* m/s, limits.u_max = 1.0 */
#define TANK_U_STEP_INFLOW                   0.25f  /* m/s, limits.u_rate = 0.5 times sample_time, rounded down */
#define TANK_U_MIN_HEATING                   (-2.0f)           /* kW, limits.u_min = -2.0 */
#define TANK_U_MAX_HEATING                   6.0f              /* kW, limits.u_max = 6.0 */
#define TANK_U_STEP_HEATING                  2.0f  /* kW, limits.u_rate = 4.0 times sample_time, rounded down */
#define TANK_ERROR_LIMIT_LEVEL               2199023255552.0f  /* m, 2^41: |r − y| is below it, or not integrated */
#define TANK_GATE_SQUARED                    90000.0f          /* 300²: kalman.spike squared */
#define TANK_INNOVATION_LIMIT                2199023255552.0f  /* 2^41: |innovation| is below it, or rejected */
#define TANK_GATE_WIDEN                      1.5f              /* factor of w in a sample that rejects the output */
#define TANK_GATE_NARROW                     0.6064453f        /* factor of w in a sample that uses the output */
#define TANK_INNOVATION_LIMIT_LEVEL          2199023255552.0f  /* m, 2^41: |innovation| is below it, or rejected */
#define TANK_INNOVATION_VARIANCE_LEVEL       0.00032484604f    /* m², S = C P Cᵀ + V, steady */
#define TANK_THRESHOLD_LEVEL                 29.236143f        /* m², min(300² S, 2^82), for innovation² */
#define TANK_INNOVATION_LIMIT_TEMPERATURE    2199023255552.0f  /* K, 2^41: |innovation| is below it, or rejected */
#define TANK_INNOVATION_VARIANCE_TEMPERATURE 0.10024631f       /* K², S = C P Cᵀ + V, steady */
#define TANK_THRESHOLD_TEMPERATURE           9022.168f         /* K², min(300² S, 2^82), for innovation² */
#define TANK_TWO_TO_80                       1.2089258e+24f    /* 2^80 */

enum {
    TANK_X_LEVEL = 0,  /* [m] */
    TANK_X_TEMPERATURE = 1  /* [K] */
};

enum {
    TANK_U_INFLOW = 0,  /* [m/s] */
    TANK_U_HEATING = 1  /* [kW] */
};

enum {
    TANK_Y_LEVEL = 0,  /* [m] */
    TANK_Y_TEMPERATURE = 1  /* [K] */
};

enum {
    TANK_R_LEVEL = 0,  /* [m] */
    TANK_R_TEMPERATURE = 1  /* [K] */
};

/* The whole state of the controller. It has no pointers and may be copied. Initialise it with tank_init. */
typedef struct {
    float x[TANK_NX];  /* estimate x̂: of this sample after update, of the next one after predict */
    float u_applied[TANK_NU];  /* input that acts: of the last predict or control */
    float widening[TANK_NY];  /* w ≥ 1, widening of the gate: it grows while the output is rejected */
    float r[TANK_NR];  /* references: write them at any time between two calls */
    float xi[1];  /* ξ, integral of r − y */
    float error[1];  /* r − y of this sample; predict integrates it */
    float demand[TANK_NU];  /* u of the law, before the limits */
    unsigned long resets;  /* resets of the state since init; wraps to 0 */
    unsigned long gated[TANK_NY];  /* how often the gate has rejected an output; wraps to 0 */
} tank_t;

LQG_STRICT_BEGIN
#if defined __GNUC__ && !defined __clang__  /* loads numbers where they are needed */
#pragma GCC optimize ("no-tree-ter", "no-tree-pre")
#endif

/* Initial state: x̂ = x0, ξ = 0, r = 0, last input = 0, counters = 0. */
static inline void tank_init(tank_t *self)
{
    static const tank_t initial = {
        {0.0f, 0.0f},  /* x: the initial state x0 */
        {0.0f, 0.0f},  /* u_applied */
        {32.0f, 1.0f},  /* widening: of the variance of the first innovation, from P0, relative to S */
        {0.0f, 0.0f},  /* r */
        {0.0f},  /* xi */
        {0.0f},  /* error */
        {0.0f, 0.0f},  /* demand */
        0uL,  /* resets */
        {0}  /* gated */
    };

    *self = initial;
}

/* Called if the state is not within its bounds. Resets the state, keeps the counters and r, increments `resets`. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static lqg_status_t tank_reset(tank_t *self, lqg_status_t status)
{
    float r[TANK_NR];
    const unsigned long resets = self->resets + 1uL;
    unsigned long gated[TANK_NY];

    for (int i = 0; i < TANK_NR; i++) {
        r[i] = self->r[i];
    }
    for (int i = 0; i < TANK_NY; i++) {
        gated[i] = self->gated[i];
    }
    tank_init(self);
    for (int i = 0; i < TANK_NR; i++) {
        self->r[i] = r[i];
    }
    self->resets = resets;
    for (int i = 0; i < TANK_NY; i++) {
        self->gated[i] = gated[i];
    }
    return status | LQG_STATE_RESET;
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
__attribute__((noinline))
#endif
static lqg_status_t tank_weigh(tank_t *self, int i, float innovation, float S)
{
    LQG_STRICT_BODY
    const float widening = self->widening[i];
    const float variance = S;

    /* the widening, at least 1 */
    const float width_or_1 = (1.0f < widening) ? widening : 1.0f;
    const float width = (width_or_1 < TANK_TWO_TO_80) ? width_or_1 : TANK_TWO_TO_80;

    /* 0 < S, |innovation| below its limit, innovation² ≤ gate² S widening */
    const bool believable = fabsf(innovation) < TANK_INNOVATION_LIMIT;
    lqg_status_t fault = LQG_OK;
    if (!believable) {
        fault = (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(i));
    }
    const bool usable = fault == LQG_OK;
    const bool beyond = (TANK_GATE_SQUARED * variance * width) < (innovation * innovation);
    const bool gated = usable && beyond;
    const bool used = usable && !beyond;

    /* it widens or narrows */
    const float next_width = (used ? TANK_GATE_NARROW : TANK_GATE_WIDEN) * width;
    const float next_width_or_1 = (1.0f < next_width) ? next_width : 1.0f;

    self->widening[i] = (next_width_or_1 < TANK_TWO_TO_80) ? next_width_or_1 : TANK_TWO_TO_80;

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

/* x̂ ← x̂ + L (y − C x̂)
 *
 * y  in: the outputs, in their units. An output that is not finite, or further than 300 σ from its expected value
 *        counts as equal to its expected value: its innovation is 0.
 *
 * Status: LQG_OUTPUT_REJECTED, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
static inline lqg_status_t tank_update(tank_t *self, const float y[TANK_NY])
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;
    const float x_level = self->x[0];
    const float x_temperature = self->x[1];
    const float widening_level = self->widening[0];
    const float widening_temperature = self->widening[1];
    const float r_level = self->r[0];
    const float y_level = y[0];
    const float y_temperature = y[1];

    /* output 0, level [m]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_level = y_level - x_level;
    int usable_level = (((raw_innovation_level * raw_innovation_level) < TANK_THRESHOLD_LEVEL)
        && !(1.0f < widening_level)) ? 1 : 0;
    if (usable_level == 0) {
        const lqg_status_t reason = tank_weigh(self, 0, raw_innovation_level,
            TANK_INNOVATION_VARIANCE_LEVEL);
        usable_level = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float innovation_level = (usable_level != 0) ? raw_innovation_level : 0.0f;

    /* output 1, temperature [K]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_temperature = y_temperature - x_temperature;
    int usable_temperature = (((raw_innovation_temperature * raw_innovation_temperature)
        < TANK_THRESHOLD_TEMPERATURE) && !(1.0f < widening_temperature)) ? 1 : 0;
    if (usable_temperature == 0) {
        const lqg_status_t reason = tank_weigh(self, 1, raw_innovation_temperature,
            TANK_INNOVATION_VARIANCE_TEMPERATURE);
        usable_temperature = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float innovation_temperature = (usable_temperature != 0) ? raw_innovation_temperature
        : 0.0f;

    /* output 0, level [m]: r − y, which predict adds to ξ; 0 if the output is not used, or it is not believable */
    const float raw_error_level = r_level - y_level;
    const float error_level = ((usable_level != 0)
        && (fabsf(raw_error_level) < TANK_ERROR_LIMIT_LEVEL)) ? raw_error_level : 0.0f;
    self->error[0] = error_level;

    /* x̂ ← x̂ + L innovation;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float posterior_level = fmaf(0.38432372f, innovation_level, x_level);
    self->x[0] = posterior_level;
    const float squares_to_x_level = posterior_level * posterior_level;
    const float posterior_temperature = fmaf(0.20196564f, innovation_temperature, x_temperature);
    self->x[1] = posterior_temperature;
    const float squares_to_x_temperature = fmaf(posterior_temperature, posterior_temperature,
        squares_to_x_level);

    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = TANK_X_BOUNDS */
    if (!(squares_to_x_temperature < TANK_TWO_TO_80)) {
        status = tank_reset(self, status);
    }
    return status;
}

/* u = −K [x̂; ξ] + Nbar r, limited
 *
 * u  out: the inputs, in their units: always finite and within the limits
 *
 * Status: LQG_REFERENCE_NOT_FINITE (such an r counts as 0), LQG_INPUT_LIMITED (at a limit, or not finite and set to 0).
 * */
static inline lqg_status_t tank_control(tank_t *self, float u[TANK_NU])
{
    LQG_STRICT_BODY
    const float x_level = self->x[0];
    const float x_temperature = self->x[1];
    const float u_applied_inflow = self->u_applied[0];
    const float u_applied_heating = self->u_applied[1];
    const float r_level = self->r[0];
    const float r_temperature = self->r[1];
    const float xi_level = self->xi[0];

    /* the references r, 0 for one that is not finite */
    const bool finite_r_temperature = (r_temperature - r_temperature) == 0.0f;
    const float reference_temperature = finite_r_temperature ? r_temperature : 0.0f;

    /* u = −K [x̂; ξ] + Nbar r, within its limits */
    const float law_inflow = fmaf(1.5403687f, -reference_temperature, fmaf(0.48933765f, xi_level,
        fmaf(0.12368507f, x_temperature, -(2.7711725f * x_level))));
    const bool finite_inflow = (law_inflow - law_inflow) == 0.0f;
    const float demand_inflow = finite_inflow ? law_inflow : 0.0f;
    self->demand[0] = demand_inflow;
    const float highest_inflow = u_applied_inflow + TANK_U_STEP_INFLOW;
    const float lowest_inflow = u_applied_inflow - TANK_U_STEP_INFLOW;
    const bool below_lowest_inflow = demand_inflow < lowest_inflow;
    const bool above_highest_inflow = highest_inflow < demand_inflow;
    const float reached_inflow = below_lowest_inflow ? lowest_inflow
        : above_highest_inflow ? highest_inflow : demand_inflow;
    const bool below_inflow = reached_inflow < TANK_U_MIN_INFLOW;
    const bool above_inflow = TANK_U_MAX_INFLOW < reached_inflow;
    const float limited_inflow = below_inflow ? TANK_U_MIN_INFLOW
        : above_inflow ? TANK_U_MAX_INFLOW : reached_inflow;
    u[0] = limited_inflow;
    const float law_heating = fmaf(0.95490813f, reference_temperature, fmaf(0.45884758f, xi_level,
        fmaf(2.3978255f, -x_temperature, -(3.041702f * x_level))));
    const bool finite_heating = (law_heating - law_heating) == 0.0f;
    const float demand_heating = finite_heating ? law_heating : 0.0f;
    self->demand[1] = demand_heating;
    const float highest_heating = u_applied_heating + TANK_U_STEP_HEATING;
    const float lowest_heating = u_applied_heating - TANK_U_STEP_HEATING;
    const bool below_lowest_heating = demand_heating < lowest_heating;
    const bool above_highest_heating = highest_heating < demand_heating;
    const float reached_heating = below_lowest_heating ? lowest_heating
        : above_highest_heating ? highest_heating : demand_heating;
    const bool below_heating = reached_heating < TANK_U_MIN_HEATING;
    const bool above_heating = TANK_U_MAX_HEATING < reached_heating;
    const float limited_heating = below_heating ? TANK_U_MIN_HEATING
        : above_heating ? TANK_U_MAX_HEATING : reached_heating;
    u[1] = limited_heating;

    lqg_status_t status = LQG_OK;
    if (!((r_level - r_level) == 0.0f)) {
        status |= LQG_REFERENCE_NOT_FINITE;
    }
    if (!finite_r_temperature) {
        status |= LQG_REFERENCE_NOT_FINITE;
    }
    if (!finite_inflow) {
        status |= LQG_INPUT_LIMITED;
    }
    if (below_lowest_inflow || above_highest_inflow) {
        status |= LQG_INPUT_LIMITED;
    }
    if (below_inflow || above_inflow) {
        status |= LQG_INPUT_LIMITED;
    }
    if (!finite_heating) {
        status |= LQG_INPUT_LIMITED;
    }
    if (below_lowest_heating || above_highest_heating) {
        status |= LQG_INPUT_LIMITED;
    }
    if (below_heating || above_heating) {
        status |= LQG_INPUT_LIMITED;
    }
    return status;
}

/* From this sample to the next:  x̂ ← A x̂ + B u,
 *                              ξ ← ξ + H (u − demand) + T (r − y)
 *
 * u  in: the input that was applied, in its units; not the demanded one, if they differ
 *
 * Status: LQG_STATE_RESET. */
static inline lqg_status_t tank_predict(tank_t *self, const float u[TANK_NU])
{
    LQG_STRICT_BODY
    const float x_level = self->x[0];
    const float x_temperature = self->x[1];
    const float xi_level = self->xi[0];
    const float error_level = self->error[0];
    const float demand_inflow = self->demand[0];
    const float demand_heating = self->demand[1];
    const float u_inflow = u[0];
    const float u_heating = u[1];

    /* x̂ ← A x̂ + B u;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float next_level = fmaf(0.19900332f, u_inflow, 0.99004984f * x_level);
    self->x[0] = next_level;
    const float squares_to_x_level = next_level * next_level;
    const float next_temperature = fmaf(0.12345044f, u_heating, fmaf(0.29628107f, -u_inflow,
        0.9753099f * x_temperature));
    self->x[1] = next_temperature;
    const float squares_to_x_temperature = fmaf(next_temperature, next_temperature,
        squares_to_x_level);

    /* ξ ← ξ + H (u − what the law asked for) + T (r − y) */
    const float next_xi_level = fmaf(TANK_SAMPLE_TIME, error_level, fmaf(0.013735944f, u_heating
        - demand_heating, fmaf(0.20487356f, u_inflow - demand_inflow, xi_level)));
    self->xi[0] = next_xi_level;
    const float squares_to_xi_level = fmaf(next_xi_level, next_xi_level, squares_to_x_temperature);
    const float sum_to_u_heating = u_inflow + u_heating;

    self->error[0] = 0.0f;
    self->u_applied[0] = u_inflow;
    self->demand[0] = u_inflow;
    self->u_applied[1] = u_heating;
    self->demand[1] = u_heating;

    lqg_status_t status = LQG_OK;
    /* Σ (x_i/b_i)² + (ξ_i/c_i)² < 1 in units of a power of two, b = TANK_X_BOUNDS, c: limits of ξ; the rest is finite
     * */
    if (!((sum_to_u_heating - sum_to_u_heating) < (TANK_TWO_TO_80 - squares_to_xi_level))) {
        status = tank_reset(self, status);
    }
    return status;
}

/* One sample: update, control, predict; assumes that the actuator applies u as it is.
 * Here the three are one text, which keeps the state in registers;
 * bits and status are those of the calls. */
static inline lqg_status_t tank_step(tank_t *self, const float y[TANK_NY], float u[TANK_NU])
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;
    const float x_level = self->x[0];
    const float x_temperature = self->x[1];
    const float widening_level = self->widening[0];
    const float widening_temperature = self->widening[1];
    float r_level = self->r[0];
    const float y_level = y[0];
    const float y_temperature = y[1];

    /* output 0, level [m]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_level = y_level - x_level;
    int usable_level = (((raw_innovation_level * raw_innovation_level) < TANK_THRESHOLD_LEVEL)
        && !(1.0f < widening_level)) ? 1 : 0;
    if (usable_level == 0) {
        const lqg_status_t reason = tank_weigh(self, 0, raw_innovation_level,
            TANK_INNOVATION_VARIANCE_LEVEL);
        usable_level = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float innovation_level = (usable_level != 0) ? raw_innovation_level : 0.0f;

    /* output 1, temperature [K]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_temperature = y_temperature - x_temperature;
    int usable_temperature = (((raw_innovation_temperature * raw_innovation_temperature)
        < TANK_THRESHOLD_TEMPERATURE) && !(1.0f < widening_temperature)) ? 1 : 0;
    if (usable_temperature == 0) {
        const lqg_status_t reason = tank_weigh(self, 1, raw_innovation_temperature,
            TANK_INNOVATION_VARIANCE_TEMPERATURE);
        usable_temperature = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float innovation_temperature = (usable_temperature != 0) ? raw_innovation_temperature
        : 0.0f;

    /* output 0, level [m]: r − y, which predict adds to ξ; 0 if the output is not used, or it is not believable */
    const float raw_error_level = r_level - y_level;
    float error_level = ((usable_level != 0) && (fabsf(raw_error_level) < TANK_ERROR_LIMIT_LEVEL))
        ? raw_error_level : 0.0f;

    /* x̂ ← x̂ + L innovation;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    float posterior_level = fmaf(0.38432372f, innovation_level, x_level);
    const float squares_to_x_level = posterior_level * posterior_level;
    float posterior_temperature = fmaf(0.20196564f, innovation_temperature, x_temperature);
    const float squares_to_x_temperature = fmaf(posterior_temperature, posterior_temperature,
        squares_to_x_level);

    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = TANK_X_BOUNDS */
    if (!(squares_to_x_temperature < TANK_TWO_TO_80)) {
        status = tank_reset(self, status);
        posterior_level = self->x[0];
        posterior_temperature = self->x[1];
        r_level = self->r[0];
        error_level = self->error[0];
    }

    const float u_applied_inflow = self->u_applied[0];
    const float u_applied_heating = self->u_applied[1];
    const float r_temperature = self->r[1];
    const float xi_level = self->xi[0];

    /* the references r, 0 for one that is not finite */
    const bool finite_r_temperature = (r_temperature - r_temperature) == 0.0f;
    const float reference_temperature = finite_r_temperature ? r_temperature : 0.0f;

    /* u = −K [x̂; ξ] + Nbar r, within its limits */
    const float law_inflow = fmaf(1.5403687f, -reference_temperature, fmaf(0.48933765f, xi_level,
        fmaf(0.12368507f, posterior_temperature, -(2.7711725f * posterior_level))));
    const bool finite_inflow = (law_inflow - law_inflow) == 0.0f;
    const float demand_inflow = finite_inflow ? law_inflow : 0.0f;
    const float highest_inflow = u_applied_inflow + TANK_U_STEP_INFLOW;
    const float lowest_inflow = u_applied_inflow - TANK_U_STEP_INFLOW;
    const bool below_lowest_inflow = demand_inflow < lowest_inflow;
    const bool above_highest_inflow = highest_inflow < demand_inflow;
    const float reached_inflow = below_lowest_inflow ? lowest_inflow
        : above_highest_inflow ? highest_inflow : demand_inflow;
    const bool below_inflow = reached_inflow < TANK_U_MIN_INFLOW;
    const bool above_inflow = TANK_U_MAX_INFLOW < reached_inflow;
    const float limited_inflow = below_inflow ? TANK_U_MIN_INFLOW
        : above_inflow ? TANK_U_MAX_INFLOW : reached_inflow;
    u[0] = limited_inflow;
    self->u_applied[0] = limited_inflow;
    self->demand[0] = limited_inflow;
    const float law_heating = fmaf(0.95490813f, reference_temperature, fmaf(0.45884758f, xi_level,
        fmaf(2.3978255f, -posterior_temperature, -(3.041702f * posterior_level))));
    const bool finite_heating = (law_heating - law_heating) == 0.0f;
    const float demand_heating = finite_heating ? law_heating : 0.0f;
    const float highest_heating = u_applied_heating + TANK_U_STEP_HEATING;
    const float lowest_heating = u_applied_heating - TANK_U_STEP_HEATING;
    const bool below_lowest_heating = demand_heating < lowest_heating;
    const bool above_highest_heating = highest_heating < demand_heating;
    const float reached_heating = below_lowest_heating ? lowest_heating
        : above_highest_heating ? highest_heating : demand_heating;
    const bool below_heating = reached_heating < TANK_U_MIN_HEATING;
    const bool above_heating = TANK_U_MAX_HEATING < reached_heating;
    const float limited_heating = below_heating ? TANK_U_MIN_HEATING
        : above_heating ? TANK_U_MAX_HEATING : reached_heating;
    u[1] = limited_heating;
    self->u_applied[1] = limited_heating;
    self->demand[1] = limited_heating;

    /* x̂ ← A x̂ + B u;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float next_level = fmaf(0.19900332f, limited_inflow, 0.99004984f * posterior_level);
    self->x[0] = next_level;
    const float squares_to_x_level_2 = next_level * next_level;
    const float next_temperature = fmaf(0.12345044f, limited_heating, fmaf(0.29628107f,
        -limited_inflow, 0.9753099f * posterior_temperature));
    self->x[1] = next_temperature;
    const float squares_to_x_temperature_2 = fmaf(next_temperature, next_temperature,
        squares_to_x_level_2);

    /* ξ ← ξ + H (u − what the law asked for) + T (r − y) */
    const float next_xi_level = fmaf(TANK_SAMPLE_TIME, error_level, fmaf(0.013735944f,
        limited_heating - demand_heating, fmaf(0.20487356f, limited_inflow
        - demand_inflow, xi_level)));
    self->xi[0] = next_xi_level;
    const float squares_to_xi_level = fmaf(next_xi_level, next_xi_level,
        squares_to_x_temperature_2);
    const float sum_to_u_heating = limited_inflow + limited_heating;

    self->error[0] = 0.0f;

    if (!((r_level - r_level) == 0.0f)) {
        status |= LQG_REFERENCE_NOT_FINITE;
    }
    if (!finite_r_temperature) {
        status |= LQG_REFERENCE_NOT_FINITE;
    }
    if (!finite_inflow) {
        status |= LQG_INPUT_LIMITED;
    }
    if (below_lowest_inflow || above_highest_inflow) {
        status |= LQG_INPUT_LIMITED;
    }
    if (below_inflow || above_inflow) {
        status |= LQG_INPUT_LIMITED;
    }
    if (!finite_heating) {
        status |= LQG_INPUT_LIMITED;
    }
    if (below_lowest_heating || above_highest_heating) {
        status |= LQG_INPUT_LIMITED;
    }
    if (below_heating || above_heating) {
        status |= LQG_INPUT_LIMITED;
    }
    /* Σ (x_i/b_i)² + (ξ_i/c_i)² < 1 in units of a power of two, b = TANK_X_BOUNDS, c: limits of ξ; the rest is finite
     * */
    if (!((sum_to_u_heating - sum_to_u_heating) < (TANK_TWO_TO_80 - squares_to_xi_level))) {
        status = tank_reset(self, status);
    }
    return status;
}

/* Monitors sensors and model: the innovations y − C x̂ and their variances in the steady state. Call it before
 * tank_update.
 *
 * y           in: the outputs, in their units
 * innovation  out: the innovations
 * S           out: their variances: innovation²/S is 1 on average if the model is right
 */
static inline void tank_innovation(const tank_t *self, const float y[TANK_NY],
    float innovation[TANK_NY], float S[TANK_NY])
{
    LQG_STRICT_BODY
    const float x_level = self->x[0];
    const float x_temperature = self->x[1];
    const float y_level = y[0];
    const float y_temperature = y[1];

    /* output 0, level [m]: innovation = y − C x̂ */
    const float innovation_level = y_level - x_level;
    innovation[0] = innovation_level;

    /* output 1, temperature [K]: innovation = y − C x̂ */
    const float innovation_temperature = y_temperature - x_temperature;
    innovation[1] = innovation_temperature;

    S[0] = TANK_INNOVATION_VARIANCE_LEVEL;
    S[1] = TANK_INNOVATION_VARIANCE_TEMPERATURE;
}

/* The update by some of the outputs, for sensors with their own rates. Any number of predictions may lie between two
 * updates.
 * An approximation: the gains are optimal only when all outputs are used together.
 *
 * y     in: the outputs, in their units; those that are not used are not read
 * used  in: one bit for each output that is used: 1uL << TANK_Y_LEVEL
 *
 * Status: as tank_update, of the outputs that are used. */
static inline lqg_status_t tank_partial_update(tank_t *self, const float y[TANK_NY], unsigned long used)
{
    LQG_STRICT_BODY
    float there[TANK_NY];
    float innovation[TANK_NY];
    float S[TANK_NY];
    unsigned long bit = 1uL;
    lqg_status_t rejected = LQG_OK;
    lqg_status_t status;

    for (int i = 0; i < TANK_NY; i++) {
        there[i] = ((used & bit) != 0uL) ? y[i] : (float)INFINITY;  /* left out */
        bit <<= 1u;
    }
    tank_innovation(self, there, innovation, S);
    const float innovation_level = innovation[0];
    const float innovation_temperature = innovation[1];
    if (((used & 1uL) != 0uL) && (!(fabsf(innovation_level) < TANK_INNOVATION_LIMIT_LEVEL))) {
        rejected |= (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(0));
    }
    if (((used & 2uL) != 0uL)
        && (!(fabsf(innovation_temperature) < TANK_INNOVATION_LIMIT_TEMPERATURE))) {
        rejected |= (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(1));
    }

    status = tank_update(self, there);
    return (status & ~(LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BITS)) | rejected;
}

/* x̂ ← x, set from outside. Call tank_set_input after it, if the input is known.
 *
 * x  in: the state, in its units
 *
 * Status: LQG_STATE_RESET, if x is not within TANK_X_BOUNDS. */
static inline lqg_status_t tank_set_state(tank_t *self, const float x[TANK_NX])
{
    LQG_STRICT_BODY
    const float x_level = x[0];
    const float x_temperature = x[1];

    /* x̂ ← x;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float squares_to_x_level = x_level * x_level;
    const float squares_to_x_temperature = fmaf(x_temperature, x_temperature, squares_to_x_level);

    self->x[0] = x_level;
    self->x[1] = x_temperature;

    lqg_status_t status = LQG_OK;
    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = TANK_X_BOUNDS */
    if (!(squares_to_x_temperature < TANK_TWO_TO_80)) {
        status = tank_reset(self, status);
    }
    return status;
}

/* Tells the controller that the actuator applied u while it was not in charge (manual control).
 * ξ becomes such that the transfer to automatic is bumpless: the law demands u next.
 * Call it before control.
 *
 * u  in: the applied input, in its units
 *
 * Status: LQG_STATE_RESET, if the new state is not within its bounds;
 *         LQG_REFERENCE_NOT_FINITE. */
static inline lqg_status_t tank_set_input(tank_t *self, const float u[TANK_NU])
{
    LQG_STRICT_BODY
    const float x_level = self->x[0];
    const float x_temperature = self->x[1];
    const float r_level = self->r[0];
    const float r_temperature = self->r[1];
    const float xi_level = self->xi[0];
    const float u_inflow = u[0];
    const float u_heating = u[1];

    /* the references r, 0 for one that is not finite */
    const bool finite_r_temperature = (r_temperature - r_temperature) == 0.0f;
    const float reference_temperature = finite_r_temperature ? r_temperature : 0.0f;

    /* ξ ← ξ + H_input (u − what the law asks for): it asks for u next */
    const float law_inflow = fmaf(1.5403687f, -reference_temperature, fmaf(0.48933765f, xi_level,
        fmaf(0.12368507f, x_temperature, -(2.7711725f * x_level))));
    const float law_heating = fmaf(0.95490813f, reference_temperature, fmaf(0.45884758f, xi_level,
        fmaf(2.3978255f, -x_temperature, -(3.041702f * x_level))));
    const float next_xi_level = fmaf(1.0196784f, u_heating - law_heating, fmaf(1.0874352f, u_inflow
        - law_inflow, xi_level));
    self->xi[0] = next_xi_level;
    const float squares_to_xi_level = next_xi_level * next_xi_level;
    const float sum_to_u_heating = u_inflow + u_heating;

    self->u_applied[0] = u_inflow;
    self->demand[0] = u_inflow;
    self->u_applied[1] = u_heating;
    self->demand[1] = u_heating;

    lqg_status_t status = LQG_OK;
    if (!((r_level - r_level) == 0.0f)) {
        status |= LQG_REFERENCE_NOT_FINITE;
    }
    if (!finite_r_temperature) {
        status |= LQG_REFERENCE_NOT_FINITE;
    }
    /* Σ (ξ_i/c_i)² < 1 in units of a power of two, c: limits of ξ; the rest is finite */
    if (!((sum_to_u_heating - sum_to_u_heating) < (TANK_TWO_TO_80 - squares_to_xi_level))) {
        status = tank_reset(self, status);
    }
    return status;
}

LQG_STRICT_END

#endif
