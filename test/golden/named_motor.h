/* named_motor: position of a DC motor, by its parameters
 *
 * Made by lqgen 0.2.0 from named_motor.toml with the SHA-256
 * d9bd4e01bb84b7986c95f8f28a8c34923de71be9a801c3fda0536d1fcef6478d.
 * Do not edit: change the design and run lqgen again. This file is yours: use it under any licence.
 *
 * What is called when:
 *
 *   once                   named_motor_init(&loop)                          at the start
 *   each sample            named_motor_control(&loop, u)                    u for the actuator
 *                          named_motor_update(&loop, y)                     y has been measured
 *                          named_motor_predict(&loop, u)                    the u that was applied
 *     or                   named_motor_step(&loop, y, u)                    all three in one call
 *   a sensor has failed    y[i] = NAN                                       that output is not used
 *   a sensor is slower     named_motor_partial_update(&loop, y, used)       instead of update
 *   to watch the sensors   named_motor_innovation(&loop, y, innovation, S)  before update
 *   in manual mode         named_motor_predict(&loop, u)                    after update, with the manual u; no control
 *   the state is known     named_motor_set_state(&loop, x)                  between predict and update
 *   after LQG_STATE_RESET  the same calls as before                         x̂ is that of init
 *
 * A status other than LQG_OK says what happened; each function lists its bits.
 *
 * Parameters:
 *
 *   J      3.2284e-06 kg*m^2
 *   b      3.5077e-06 N*m*s/rad
 *   Kt     0.0274 N*m/A
 *   Ke     0.0274 V*s/rad        = Kt
 *   R      4.0 ohm
 *   L      2.75e-06 H
 *   U      12.0 V
 *   load   0.001 N*m
 *   turn   6.283185307179586     = 2*pi
 *   lines  2000.0
 *
 * Numbers of the design file that expressions give:
 *
 *   plant.sample_time            0.001                  = 1/1000
 *   plant.A[1][1]                -1.0865134431916739    = -b/J
 *   plant.A[1][2]                8487.176310246563      = Kt/J
 *   plant.A[2][1]                -9963.636363636364     = -Ke/L
 *   plant.A[2][2]                -1454545.4545454546    = -R/L
 *   plant.B[2][0]                363636.36363636365     = 1/L
 *   plant.G[1][0]                -309750.9602279767     = -1/J
 *   lqr.Q[0]                     399.99999999999994     = 1/0.05^2
 *   lqr.Q[1]                     0.0011111111111111111  = 1/30^2
 *   lqr.R[0]                     0.006944444444444444   = 1/U^2
 *   kalman.process_noise[0]      1e-06                  = load^2
 *   kalman.measurement_noise[0]  8.224670334241132e-07  = (turn/lines)^2/12
 *   kalman.measurement_noise[1]  4e-04                  = 0.02^2
 *   limits.u_min[0]              -11.399999999999999    = -0.95*U
 *   limits.u_max[0]              11.399999999999999     = 0.95*U
 *
 * Plant, sampled every 0.001 s:  x⁺ = A x + B u + G w,  y = C x + D u + v
 *
 *   states   x[0] angle [rad], x[1] speed [rad/s], x[2] current [A]
 *   inputs   u[0] voltage [V]
 *   outputs  y[0] angle [rad], y[1] current [A]
 *
 *   A = [ 1.0  0.0009710018     5.66195e-06 ]
 *       [ 0.0     0.9425314     0.005499832 ]
 *       [ 0.0  -0.006456603  -3.7675385e-05 ]
 *   B = [ 0.0010388853 ]
 *       [     2.058891 ]
 *       [   0.23590602 ]
 *   C = [ 1.0  0.0  0.0 ]
 *       [ 0.0  0.0  1.0 ]
 *   D = [ 0.0 ]
 *       [ 0.0 ]
 *
 * Regulator  u = −K x̂:
 *
 *   K = [ 134.61151  0.39725438  0.0023175073 ]
 *   poles of A − B K: 0.4921 ± 0.1392i, 1.327e-10
 *   -11.399999999999999 ≤ u[0] ≤ 11.399999999999999
 *
 * Kalman filter, predictor form (u[k] depends on the outputs up to y[k−1]),
 * constant gain; covariances per sample:
 *
 *   G = [ -0.15186873 ]
 *       [  -300.76874 ]
 *       [    2.058891 ]
 *   W = E[w wᵀ] = [ 1e-06 ]
 *   V = E[v vᵀ] = [ 8.2246703e-07    0.0 ]
 *                 [           0.0  4e-04 ]
 *   L = [ 0.52430856  -0.0027482372 ]
 *       [   195.1308     -2.8019092 ]
 *       [ -1.3365823    0.019187234 ]
 *   L_predictor = [ 0.71377337  -0.0054687876 ]
 *                 [  183.90955     -2.6407819 ]
 *                 [ -1.2598317    0.018090092 ]
 *   poles of A − L_predictor C: 0.6053 ± 0.2643i, 0
 *   limit of |x̂_i| (reset when exceeded): 1.1e+12, 1.1e+12, 1.1e+12
 *   innovation limit: 2.199e+12, 2.199e+12
 *
 * Closed loop, opened at the plant's input:
 *
 *   gain margin         3.858 dB, up 3.858
 *   phase margin        30.22° at 362.1 rad/s
 *   delay margin        1.056 samples, 0.001056 s
 *   disk margin         0.4139
 *   cost per sample     2.295e-06
 *   cost per second     0.002331
 *
 * One sample takes 29 multiply-adds and 32 bytes of RAM. By arm-none-eabi-gcc 12.2 at -O2, for a
 * Cortex-M4F, at most 1200 bytes of flash and 84 bytes of stack.
 * Style: unrolled. Arithmetic: fused. Digits of the design: 100.
 */
#ifndef NAMED_MOTOR_H
#define NAMED_MOTOR_H

#include <math.h>
#include <stdbool.h>

#include "lqg/arithmetic.h"
#include "lqg/status.h"
#include "lqg/version.h"

#if LQG_HEADER_FORMAT != 3
#error "This file needs header format 3, the library has another one: regenerate it with the library's lqgen."
#endif

#if !LQG_HAS_FMAF && !defined LQG_SLOW_FUSED
#pragma message("named_motor: fused multiply-adds are slow here. Compile for a processor that has them (x86: -mfma), \
run lqgen with arithmetic = \"plain\", or define LQG_SLOW_FUSED.")
#endif

#define NAMED_MOTOR_NX 3  /* states */
#define NAMED_MOTOR_NU 1  /* inputs */
#define NAMED_MOTOR_NY 2  /* outputs */
/* Limit of |x̂_i|: the state is reset when it is reached. */
#define NAMED_MOTOR_X_BOUNDS { \
    1099511627776.0f,  /* 2^40: angle [rad] */ \
    1099511627776.0f,  /* 2^40: speed [rad/s] */ \
    1099511627776.0f  /* 2^40: current [A] */ \
}
#define NAMED_MOTOR_RECOVERY_SAMPLES 540  /* samples after a fault until its effect is below the noise */
#define NAMED_MOTOR_SAMPLE_TIME 0.001f  /* s, plant.sample_time */

/* Limits, bounds and thresholds of the code below, each with its unit and origin. */
#define NAMED_MOTOR_U_MIN_VOLTAGE               (-11.4f)  /* V, limits.u_min = -11.399999999999999, rounded inwards */
#define NAMED_MOTOR_U_MAX_VOLTAGE               11.4f  /* V, limits.u_max = 11.399999999999999, rounded inwards */
#define NAMED_MOTOR_GATE_SQUARED                90000.0f          /* 300²: kalman.spike squared */
#define NAMED_MOTOR_INNOVATION_LIMIT            2199023255552.0f  /* 2^41: |innovation| is below it, or rejected */
#define NAMED_MOTOR_GATE_WIDEN                  1.5f              /* factor of w in a sample that rejects the output */
#define NAMED_MOTOR_GATE_NARROW                 0.43652344f       /* factor of w in a sample that uses the output */
#define NAMED_MOTOR_INNOVATION_LIMIT_ANGLE      2199023255552.0f  /* rad, 2^41: |innovation| is below it, or rejected */
#define NAMED_MOTOR_INNOVATION_VARIANCE_ANGLE   1.742713e-06f     /* rad², S = C P Cᵀ + V, steady */
#define NAMED_MOTOR_THRESHOLD_ANGLE             0.15684417f       /* rad², min(300² S, 2^82), for innovation² */
#define NAMED_MOTOR_INNOVATION_LIMIT_CURRENT    2199023255552.0f  /* A, 2^41: |innovation| is below it, or rejected */
#define NAMED_MOTOR_INNOVATION_VARIANCE_CURRENT 0.0004110613f     /* A², S = C P Cᵀ + V, steady */
#define NAMED_MOTOR_THRESHOLD_CURRENT           36.995518f        /* A², min(300² S, 2^82), for innovation² */
#define NAMED_MOTOR_TWO_TO_80                   1.2089258e+24f    /* 2^80 */

enum {
    NAMED_MOTOR_X_ANGLE = 0,  /* [rad] */
    NAMED_MOTOR_X_SPEED = 1,  /* [rad/s] */
    NAMED_MOTOR_X_CURRENT = 2  /* [A] */
};

enum {
    NAMED_MOTOR_U_VOLTAGE = 0  /* [V] */
};

enum {
    NAMED_MOTOR_Y_ANGLE = 0,  /* [rad] */
    NAMED_MOTOR_Y_CURRENT = 1  /* [A] */
};

/* The whole state of the controller. It has no pointers and may be copied. Initialise it with named_motor_init. */
typedef struct {
    float x[NAMED_MOTOR_NX];  /* estimate x̂: of this sample after update, of the next one after predict */
    float widening[NAMED_MOTOR_NY];  /* w ≥ 1, widening of the gate: it grows while the output is rejected */
    unsigned long resets;  /* resets of the state since init; wraps to 0 */
    unsigned long gated[NAMED_MOTOR_NY];  /* how often the gate has rejected an output; wraps to 0 */
} named_motor_t;

LQG_STRICT_BEGIN
#if defined __GNUC__ && !defined __clang__  /* loads numbers where they are needed */
#pragma GCC optimize ("no-tree-ter", "no-tree-pre")
#endif

/* Initial state: x̂ = x0, counters = 0. */
static inline void named_motor_init(named_motor_t *self)
{
    static const named_motor_t initial = {
        {0.0f, 0.0f, 0.0f},  /* x: the initial state x0 */
        {16384.0f, 1024.0f},  /* widening: of the variance of the first innovation, from P0, relative to S */
        0uL,  /* resets */
        {0}  /* gated */
    };

    *self = initial;
}

/* Called if the state is not within its bounds. Resets the state, keeps the counters, increments `resets`. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static lqg_status_t named_motor_reset(named_motor_t *self, lqg_status_t status)
{
    const unsigned long resets = self->resets + 1uL;
    unsigned long gated[NAMED_MOTOR_NY];

    for (int i = 0; i < NAMED_MOTOR_NY; i++) {
        gated[i] = self->gated[i];
    }
    named_motor_init(self);
    self->resets = resets;
    for (int i = 0; i < NAMED_MOTOR_NY; i++) {
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
static lqg_status_t named_motor_weigh(named_motor_t *self, int i, float innovation, float S)
{
    LQG_STRICT_BODY
    const float widening = self->widening[i];
    const float variance = S;

    /* the widening, at least 1 */
    const float width_or_1 = (1.0f < widening) ? widening : 1.0f;
    const float width = (width_or_1 < NAMED_MOTOR_TWO_TO_80) ? width_or_1 : NAMED_MOTOR_TWO_TO_80;

    /* 0 < S, |innovation| below its limit, innovation² ≤ gate² S widening */
    const bool believable = fabsf(innovation) < NAMED_MOTOR_INNOVATION_LIMIT;
    lqg_status_t fault = LQG_OK;
    if (!believable) {
        fault = (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(i));
    }
    const bool usable = fault == LQG_OK;
    const bool beyond = (NAMED_MOTOR_GATE_SQUARED * variance * width) < (innovation * innovation);
    const bool gated = usable && beyond;
    const bool used = usable && !beyond;

    /* it widens or narrows */
    const float next_width = (used ? NAMED_MOTOR_GATE_NARROW : NAMED_MOTOR_GATE_WIDEN) * width;
    const float next_width_or_1 = (1.0f < next_width) ? next_width : 1.0f;

    self->widening[i] = (next_width_or_1 < NAMED_MOTOR_TWO_TO_80) ? next_width_or_1
        : NAMED_MOTOR_TWO_TO_80;

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
static inline lqg_status_t named_motor_update(named_motor_t *self, const float y[NAMED_MOTOR_NY])
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;
    const float x_angle = self->x[0];
    const float x_speed = self->x[1];
    const float x_current = self->x[2];
    const float widening_angle = self->widening[0];
    const float widening_current = self->widening[1];
    const float y_angle = y[0];
    const float y_current = y[1];

    /* output 0, angle [rad]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_angle = y_angle - x_angle;
    int usable_angle = (((raw_innovation_angle * raw_innovation_angle)
        < NAMED_MOTOR_THRESHOLD_ANGLE) && !(1.0f < widening_angle)) ? 1 : 0;
    if (usable_angle == 0) {
        const lqg_status_t reason = named_motor_weigh(self, 0, raw_innovation_angle,
            NAMED_MOTOR_INNOVATION_VARIANCE_ANGLE);
        usable_angle = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float innovation_angle = (usable_angle != 0) ? raw_innovation_angle : 0.0f;

    /* output 1, current [A]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_current = y_current - x_current;
    int usable_current = (((raw_innovation_current * raw_innovation_current)
        < NAMED_MOTOR_THRESHOLD_CURRENT) && !(1.0f < widening_current)) ? 1 : 0;
    if (usable_current == 0) {
        const lqg_status_t reason = named_motor_weigh(self, 1, raw_innovation_current,
            NAMED_MOTOR_INNOVATION_VARIANCE_CURRENT);
        usable_current = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float innovation_current = (usable_current != 0) ? raw_innovation_current : 0.0f;

    /* x̂ ← x̂ + L innovation;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float posterior_angle = fmaf(0.0027482372f, -innovation_current, fmaf(0.52430856f,
        innovation_angle, x_angle));
    self->x[0] = posterior_angle;
    const float squares_to_x_angle = posterior_angle * posterior_angle;
    const float posterior_speed = fmaf(2.8019092f, -innovation_current, fmaf(195.1308f,
        innovation_angle, x_speed));
    self->x[1] = posterior_speed;
    const float squares_to_x_speed = fmaf(posterior_speed, posterior_speed, squares_to_x_angle);
    const float posterior_current = fmaf(0.019187234f, innovation_current, fmaf(1.3365823f,
        -innovation_angle, x_current));
    self->x[2] = posterior_current;
    const float squares_to_x_current = fmaf(posterior_current, posterior_current,
        squares_to_x_speed);

    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = NAMED_MOTOR_X_BOUNDS */
    if (!(squares_to_x_current < NAMED_MOTOR_TWO_TO_80)) {
        status = named_motor_reset(self, status);
    }
    return status;
}

/* u = −K x̂, limited
 *
 * u  out: the inputs, in their units: always finite and within the limits
 *
 * Status: LQG_INPUT_LIMITED (at a limit, or not finite and set to 0). */
static inline lqg_status_t named_motor_control(const named_motor_t *self, float u[NAMED_MOTOR_NU])
{
    LQG_STRICT_BODY
    const float x_angle = self->x[0];
    const float x_speed = self->x[1];
    const float x_current = self->x[2];

    /* u = −K x̂, within its limits */
    const float law_voltage = fmaf(0.0023175073f, -x_current, fmaf(0.39725438f, -x_speed,
        -(134.61151f * x_angle)));
    const bool finite_voltage = (law_voltage - law_voltage) == 0.0f;
    const float demand_voltage = finite_voltage ? law_voltage : 0.0f;
    const bool below_voltage = demand_voltage < NAMED_MOTOR_U_MIN_VOLTAGE;
    const bool above_voltage = NAMED_MOTOR_U_MAX_VOLTAGE < demand_voltage;
    const float limited_voltage = below_voltage ? NAMED_MOTOR_U_MIN_VOLTAGE
        : above_voltage ? NAMED_MOTOR_U_MAX_VOLTAGE : demand_voltage;
    u[0] = limited_voltage;

    lqg_status_t status = LQG_OK;
    if (!finite_voltage) {
        status |= LQG_INPUT_LIMITED;
    }
    if (below_voltage || above_voltage) {
        status |= LQG_INPUT_LIMITED;
    }
    return status;
}

/* From this sample to the next:  x̂ ← A x̂ + B u
 *
 * u  in: the input that was applied, in its units; not the demanded one, if they differ
 *
 * Status: LQG_STATE_RESET. */
static inline lqg_status_t named_motor_predict(named_motor_t *self, const float u[NAMED_MOTOR_NU])
{
    LQG_STRICT_BODY
    const float x_angle = self->x[0];
    const float x_speed = self->x[1];
    const float x_current = self->x[2];
    const float u_voltage = u[0];

    /* x̂ ← A x̂ + B u;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float next_angle = fmaf(0.0010388853f, u_voltage, fmaf(5.66195e-06f, x_current,
        fmaf(0.0009710018f, x_speed, x_angle)));
    self->x[0] = next_angle;
    const float squares_to_x_angle = next_angle * next_angle;
    const float next_speed = fmaf(2.058891f, u_voltage, fmaf(0.005499832f, x_current,
        0.9425314f * x_speed));
    self->x[1] = next_speed;
    const float squares_to_x_speed = fmaf(next_speed, next_speed, squares_to_x_angle);
    const float next_current = fmaf(0.23590602f, u_voltage, fmaf(3.7675385e-05f, -x_current,
        -(0.006456603f * x_speed)));
    self->x[2] = next_current;
    const float squares_to_x_current = fmaf(next_current, next_current, squares_to_x_speed);

    lqg_status_t status = LQG_OK;
    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = NAMED_MOTOR_X_BOUNDS */
    if (!(squares_to_x_current < NAMED_MOTOR_TWO_TO_80)) {
        status = named_motor_reset(self, status);
    }
    return status;
}

/* One sample: control, update, predict; assumes that the actuator applies u as it is.
 * Here the three are one text, which keeps the state in registers;
 * bits and status are those of the calls. */
static inline lqg_status_t named_motor_step(named_motor_t *self, const float y[NAMED_MOTOR_NY], float u[NAMED_MOTOR_NU])
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;
    const float x_angle = self->x[0];
    const float x_speed = self->x[1];
    const float x_current = self->x[2];
    const float widening_angle = self->widening[0];
    const float widening_current = self->widening[1];
    const float y_angle = y[0];
    const float y_current = y[1];

    /* u = −K x̂, within its limits */
    const float law_voltage = fmaf(0.0023175073f, -x_current, fmaf(0.39725438f, -x_speed,
        -(134.61151f * x_angle)));
    const bool finite_voltage = (law_voltage - law_voltage) == 0.0f;
    const float demand_voltage = finite_voltage ? law_voltage : 0.0f;
    const bool below_voltage = demand_voltage < NAMED_MOTOR_U_MIN_VOLTAGE;
    const bool above_voltage = NAMED_MOTOR_U_MAX_VOLTAGE < demand_voltage;
    const float limited_voltage = below_voltage ? NAMED_MOTOR_U_MIN_VOLTAGE
        : above_voltage ? NAMED_MOTOR_U_MAX_VOLTAGE : demand_voltage;
    u[0] = limited_voltage;

    /* output 0, angle [rad]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_angle = y_angle - x_angle;
    int usable_angle = (((raw_innovation_angle * raw_innovation_angle)
        < NAMED_MOTOR_THRESHOLD_ANGLE) && !(1.0f < widening_angle)) ? 1 : 0;
    if (usable_angle == 0) {
        const lqg_status_t reason = named_motor_weigh(self, 0, raw_innovation_angle,
            NAMED_MOTOR_INNOVATION_VARIANCE_ANGLE);
        usable_angle = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float innovation_angle = (usable_angle != 0) ? raw_innovation_angle : 0.0f;

    /* output 1, current [A]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_current = y_current - x_current;
    int usable_current = (((raw_innovation_current * raw_innovation_current)
        < NAMED_MOTOR_THRESHOLD_CURRENT) && !(1.0f < widening_current)) ? 1 : 0;
    if (usable_current == 0) {
        const lqg_status_t reason = named_motor_weigh(self, 1, raw_innovation_current,
            NAMED_MOTOR_INNOVATION_VARIANCE_CURRENT);
        usable_current = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float innovation_current = (usable_current != 0) ? raw_innovation_current : 0.0f;

    /* x̂ ← x̂ + L innovation;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    float posterior_angle = fmaf(0.0027482372f, -innovation_current, fmaf(0.52430856f,
        innovation_angle, x_angle));
    const float squares_to_x_angle = posterior_angle * posterior_angle;
    float posterior_speed = fmaf(2.8019092f, -innovation_current, fmaf(195.1308f, innovation_angle,
        x_speed));
    const float squares_to_x_speed = fmaf(posterior_speed, posterior_speed, squares_to_x_angle);
    float posterior_current = fmaf(0.019187234f, innovation_current, fmaf(1.3365823f,
        -innovation_angle, x_current));
    const float squares_to_x_current = fmaf(posterior_current, posterior_current,
        squares_to_x_speed);

    if (!finite_voltage) {
        status |= LQG_INPUT_LIMITED;
    }
    if (below_voltage || above_voltage) {
        status |= LQG_INPUT_LIMITED;
    }
    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = NAMED_MOTOR_X_BOUNDS */
    if (!(squares_to_x_current < NAMED_MOTOR_TWO_TO_80)) {
        status = named_motor_reset(self, status);
        posterior_angle = self->x[0];
        posterior_speed = self->x[1];
        posterior_current = self->x[2];
    }

    /* x̂ ← A x̂ + B u;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float next_angle = fmaf(0.0010388853f, limited_voltage, fmaf(5.66195e-06f,
        posterior_current, fmaf(0.0009710018f, posterior_speed, posterior_angle)));
    self->x[0] = next_angle;
    const float squares_to_x_angle_2 = next_angle * next_angle;
    const float next_speed = fmaf(2.058891f, limited_voltage, fmaf(0.005499832f, posterior_current,
        0.9425314f * posterior_speed));
    self->x[1] = next_speed;
    const float squares_to_x_speed_2 = fmaf(next_speed, next_speed, squares_to_x_angle_2);
    const float next_current = fmaf(0.23590602f, limited_voltage, fmaf(3.7675385e-05f,
        -posterior_current, -(0.006456603f * posterior_speed)));
    self->x[2] = next_current;
    const float squares_to_x_current_2 = fmaf(next_current, next_current, squares_to_x_speed_2);

    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = NAMED_MOTOR_X_BOUNDS */
    if (!(squares_to_x_current_2 < NAMED_MOTOR_TWO_TO_80)) {
        status = named_motor_reset(self, status);
    }
    return status;
}

/* Monitors sensors and model: the innovations y − C x̂ and their variances in the steady state. Call it before
 * named_motor_update.
 *
 * y           in: the outputs, in their units
 * innovation  out: the innovations
 * S           out: their variances: innovation²/S is 1 on average if the model is right
 */
static inline void named_motor_innovation(const named_motor_t *self, const float y[NAMED_MOTOR_NY],
    float innovation[NAMED_MOTOR_NY], float S[NAMED_MOTOR_NY])
{
    LQG_STRICT_BODY
    const float x_angle = self->x[0];
    const float x_current = self->x[2];
    const float y_angle = y[0];
    const float y_current = y[1];

    /* output 0, angle [rad]: innovation = y − C x̂ */
    const float innovation_angle = y_angle - x_angle;
    innovation[0] = innovation_angle;

    /* output 1, current [A]: innovation = y − C x̂ */
    const float innovation_current = y_current - x_current;
    innovation[1] = innovation_current;

    S[0] = NAMED_MOTOR_INNOVATION_VARIANCE_ANGLE;
    S[1] = NAMED_MOTOR_INNOVATION_VARIANCE_CURRENT;
}

/* The update by some of the outputs, for sensors with their own rates. Any number of predictions may lie between two
 * updates.
 * An approximation: the gains are optimal only when all outputs are used together.
 *
 * y     in: the outputs, in their units; those that are not used are not read
 * used  in: one bit for each output that is used: 1uL << NAMED_MOTOR_Y_ANGLE
 *
 * Status: as named_motor_update, of the outputs that are used. */
static inline lqg_status_t named_motor_partial_update(named_motor_t *self, const float y[NAMED_MOTOR_NY],
    unsigned long used)
{
    LQG_STRICT_BODY
    float there[NAMED_MOTOR_NY];
    float innovation[NAMED_MOTOR_NY];
    float S[NAMED_MOTOR_NY];
    unsigned long bit = 1uL;
    lqg_status_t rejected = LQG_OK;
    lqg_status_t status;

    for (int i = 0; i < NAMED_MOTOR_NY; i++) {
        there[i] = ((used & bit) != 0uL) ? y[i] : (float)INFINITY;  /* left out */
        bit <<= 1u;
    }
    named_motor_innovation(self, there, innovation, S);
    const float innovation_angle = innovation[0];
    const float innovation_current = innovation[1];
    if (((used & 1uL) != 0uL)
        && (!(fabsf(innovation_angle) < NAMED_MOTOR_INNOVATION_LIMIT_ANGLE))) {
        rejected |= (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(0));
    }
    if (((used & 2uL) != 0uL)
        && (!(fabsf(innovation_current) < NAMED_MOTOR_INNOVATION_LIMIT_CURRENT))) {
        rejected |= (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(1));
    }

    status = named_motor_update(self, there);
    return (status & ~(LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BITS)) | rejected;
}

/* x̂ ← x, set from outside.
 *
 * x  in: the state, in its units
 *
 * Status: LQG_STATE_RESET, if x is not within NAMED_MOTOR_X_BOUNDS. */
static inline lqg_status_t named_motor_set_state(named_motor_t *self, const float x[NAMED_MOTOR_NX])
{
    LQG_STRICT_BODY
    const float x_angle = x[0];
    const float x_speed = x[1];
    const float x_current = x[2];

    /* x̂ ← x;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float squares_to_x_angle = x_angle * x_angle;
    const float squares_to_x_speed = fmaf(x_speed, x_speed, squares_to_x_angle);
    const float squares_to_x_current = fmaf(x_current, x_current, squares_to_x_speed);

    self->x[0] = x_angle;
    self->x[1] = x_speed;
    self->x[2] = x_current;

    lqg_status_t status = LQG_OK;
    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = NAMED_MOTOR_X_BOUNDS */
    if (!(squares_to_x_current < NAMED_MOTOR_TWO_TO_80)) {
        status = named_motor_reset(self, status);
    }
    return status;
}

LQG_STRICT_END

#endif
