/* two_mass: two masses, spring and damper
 *
 * Made by lqgen 0.2.0 from two_mass.toml with the SHA-256
 * 46860654c241d4662f7925e59e28b72728299719d8f3760ea0a0858f9525b9e5.
 * Do not edit: change the design and run lqgen again. This file is yours: use it under any licence.
 *
 * What is called when:
 *
 *   once                   two_mass_init(&loop)                          at the start
 *   each sample            two_mass_update(&loop, y)                     y has been measured
 *                          two_mass_control(&loop, u)                    u for the actuator
 *                          two_mass_predict(&loop, u)                    the u that was applied
 *     or                   two_mass_step(&loop, y, u)                    all three in one call
 *   a sensor has failed    y[i] = NAN                                    that output is not used
 *   a sensor is slower     two_mass_partial_update(&loop, y, used)       instead of update
 *   to watch the sensors   two_mass_innovation(&loop, y, innovation, S)  before update
 *   in manual mode         two_mass_predict(&loop, u)                    after update, with the manual u; no control
 *   the state is known     two_mass_set_state(&loop, x)                  between predict and update
 *   after LQG_STATE_RESET  the same calls as before                      x̂ is that of init
 *
 * A status other than LQG_OK says what happened; each function lists its bits.
 *
 * Plant, sampled every 0.5 s:  x⁺ = A x + B u + G w,  y = C x + D u + v
 *
 *   states   x[0] dy1 [m], x[1] v1 [m/s], x[2] dy2 [m], x[3] v2 [m/s]
 *   inputs   u[0] force [N]
 *   outputs  y[0] dy1 [m], y[1] dy2 [m]
 *
 *   A = [    0.9877046   0.4974466  0.012295422   0.002553408 ]
 *       [ -0.048467956   0.9857659  0.048467956  0.0142341405 ]
 *       [  0.061477114  0.01276704    0.9385229    0.48723295 ]
 *       [   0.24233977   0.0711707  -0.24233977     0.9288293 ]
 *   B = [   0.12465904 ]
 *       [    0.4974466 ]
 *       [ 0.0017048119 ]
 *       [   0.01276704 ]
 *   C = [ 1.0  0.0  0.0  0.0 ]
 *       [ 0.0  0.0  1.0  0.0 ]
 *   D = [ 0.0 ]
 *       [ 0.0 ]
 *
 * Regulator  u = −K x̂:
 *
 *   K = [ 2.4226158  2.1417978  -0.33327204  1.9239638 ]
 *   poles of A − B K: 0.7867 ± 0.3256i, 0.438 ± 0.3274i
 *
 * Kalman filter, filter form (u[k] depends on the outputs up to y[k]),
 * constant gain; covariances per sample:
 *
 *   G = [   0.12465904 ]
 *       [    0.4974466 ]
 *       [ 0.0017048119 ]
 *       [   0.01276704 ]
 *   W = E[w wᵀ] = [ 0.01 ]
 *   V = E[v vᵀ] = [ 0.001    0.0 ]
 *                 [   0.0  0.001 ]
 *   L = [  0.7008788    0.03500962 ]
 *       [  0.8304034  -0.105838105 ]
 *       [ 0.03500962    0.26355246 ]
 *       [ 0.17161791   0.078661025 ]
 *   poles of A − L_predictor C: 0.7867 ± 0.3256i, 0.4374 ± 0.3276i
 *   limit of |x̂_i| (reset when exceeded): 1.1e+12, 1.1e+12, 1.1e+12, 1.1e+12
 *   innovation limit: 2.199e+12, 2.199e+12
 *
 * Closed loop, opened at the plant's input:
 *
 *   gain margin         6.125 dB, up 6.125, down 8.568
 *   phase margin        21.89° at 1.561 rad/s
 *   delay margin        0.4895 samples, 0.2447 s
 *   disk margin         0.3849
 *   cost per sample     0.00816
 *   cost per second     0.01635
 *
 * One sample takes 44 multiply-adds and 36 bytes of RAM. By arm-none-eabi-gcc 12.2 at -O2, for a
 * Cortex-M4F, at most 1405 bytes of flash and 52 bytes of stack.
 * Style: unrolled. Arithmetic: plain. Digits of the design: 100.
 */
#ifndef TWO_MASS_H
#define TWO_MASS_H

#include <math.h>
#include <stdbool.h>

#include "lqg/arithmetic.h"
#include "lqg/status.h"
#include "lqg/version.h"

#if LQG_HEADER_FORMAT != 3
#error "This file needs header format 3, the library has another one: regenerate it with the library's lqgen."
#endif

#define TWO_MASS_NX 4  /* states */
#define TWO_MASS_NU 1  /* inputs */
#define TWO_MASS_NY 2  /* outputs */
/* Limit of |x̂_i|: the state is reset when it is reached. */
#define TWO_MASS_X_BOUNDS { \
    1099511627776.0f,  /* 2^40: dy1 [m] */ \
    1099511627776.0f,  /* 2^40: v1 [m/s] */ \
    1099511627776.0f,  /* 2^40: dy2 [m] */ \
    1099511627776.0f  /* 2^40: v2 [m/s] */ \
}
#define TWO_MASS_RECOVERY_SAMPLES 570  /* samples after a fault until its effect is below the noise */
#define TWO_MASS_SAMPLE_TIME 0.5f  /* s, plant.sample_time */

/* Limits, bounds and thresholds of the code below, each with its unit and origin. */
#define TWO_MASS_GATE_SQUARED            90000.0f          /* 300²: kalman.spike squared */
#define TWO_MASS_INNOVATION_LIMIT        2199023255552.0f  /* 2^41: |innovation| is below it, or rejected */
#define TWO_MASS_GATE_WIDEN              1.5f              /* factor of w in a sample that rejects the output */
#define TWO_MASS_GATE_NARROW             0.72558594f       /* factor of w in a sample that uses the output */
#define TWO_MASS_INNOVATION_LIMIT_DY1    2199023255552.0f  /* m, 2^41: |innovation| is below it, or rejected */
#define TWO_MASS_INNOVATION_VARIANCE_DY1 0.0033618314f     /* m², S = C P Cᵀ + V, steady */
#define TWO_MASS_THRESHOLD_DY1           302.56482f        /* m², min(300² S, 2^82), for innovation² */
#define TWO_MASS_INNOVATION_LIMIT_DY2    2199023255552.0f  /* m, 2^41: |innovation| is below it, or rejected */
#define TWO_MASS_INNOVATION_VARIANCE_DY2 0.0013654674f     /* m², S = C P Cᵀ + V, steady */
#define TWO_MASS_THRESHOLD_DY2           122.89207f        /* m², min(300² S, 2^82), for innovation² */
#define TWO_MASS_TWO_TO_80               1.2089258e+24f    /* 2^80 */

enum {
    TWO_MASS_X_DY1 = 0,  /* [m] */
    TWO_MASS_X_V1 = 1,  /* [m/s] */
    TWO_MASS_X_DY2 = 2,  /* [m] */
    TWO_MASS_X_V2 = 3  /* [m/s] */
};

enum {
    TWO_MASS_U_FORCE = 0  /* [N] */
};

enum {
    TWO_MASS_Y_DY1 = 0,  /* [m] */
    TWO_MASS_Y_DY2 = 1  /* [m] */
};

/* The whole state of the controller. It has no pointers and may be copied. Initialise it with two_mass_init. */
typedef struct {
    float x[TWO_MASS_NX];  /* estimate x̂: of this sample after update, of the next one after predict */
    float widening[TWO_MASS_NY];  /* w ≥ 1, widening of the gate: it grows while the output is rejected */
    unsigned long resets;  /* resets of the state since init; wraps to 0 */
    unsigned long gated[TWO_MASS_NY];  /* how often the gate has rejected an output; wraps to 0 */
} two_mass_t;

LQG_STRICT_BEGIN
#if defined __GNUC__ && !defined __clang__  /* loads numbers where they are needed */
#pragma GCC optimize ("no-tree-ter", "no-tree-pre")
#endif

/* Initial state: x̂ = x0, counters = 0. */
static inline void two_mass_init(two_mass_t *self)
{
    static const two_mass_t initial = {
        {0.0f, 0.0f, 0.0f, 0.0f},  /* x: the initial state x0 */
        {4.0f, 32.0f},  /* widening: of the variance of the first innovation, from P0, relative to S */
        0uL,  /* resets */
        {0}  /* gated */
    };

    *self = initial;
}

/* Called if the state is not within its bounds. Resets the state, keeps the counters, increments `resets`. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static lqg_status_t two_mass_reset(two_mass_t *self, lqg_status_t status)
{
    const unsigned long resets = self->resets + 1uL;
    unsigned long gated[TWO_MASS_NY];

    for (int i = 0; i < TWO_MASS_NY; i++) {
        gated[i] = self->gated[i];
    }
    two_mass_init(self);
    self->resets = resets;
    for (int i = 0; i < TWO_MASS_NY; i++) {
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
static lqg_status_t two_mass_weigh(two_mass_t *self, int i, float innovation, float S)
{
    LQG_STRICT_BODY
    const float widening = self->widening[i];
    const float variance = S;

    /* the widening, at least 1 */
    const float width_or_1 = (1.0f < widening) ? widening : 1.0f;
    const float width = (width_or_1 < TWO_MASS_TWO_TO_80) ? width_or_1 : TWO_MASS_TWO_TO_80;

    /* 0 < S, |innovation| below its limit, innovation² ≤ gate² S widening */
    const bool believable = fabsf(innovation) < TWO_MASS_INNOVATION_LIMIT;
    lqg_status_t fault = LQG_OK;
    if (!believable) {
        fault = (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(i));
    }
    const bool usable = fault == LQG_OK;
    const bool beyond = (TWO_MASS_GATE_SQUARED * variance * width) < (innovation * innovation);
    const bool gated = usable && beyond;
    const bool used = usable && !beyond;

    /* it widens or narrows */
    const float next_width = (used ? TWO_MASS_GATE_NARROW : TWO_MASS_GATE_WIDEN) * width;
    const float next_width_or_1 = (1.0f < next_width) ? next_width : 1.0f;

    self->widening[i] = (next_width_or_1 < TWO_MASS_TWO_TO_80) ? next_width_or_1
        : TWO_MASS_TWO_TO_80;

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
static inline lqg_status_t two_mass_update(two_mass_t *self, const float y[TWO_MASS_NY])
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;
    const float x_dy1 = self->x[0];
    const float x_v1 = self->x[1];
    const float x_dy2 = self->x[2];
    const float x_v2 = self->x[3];
    const float widening_dy1 = self->widening[0];
    const float widening_dy2 = self->widening[1];
    const float y_dy1 = y[0];
    const float y_dy2 = y[1];

    /* output 0, dy1 [m]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_dy1 = y_dy1 - x_dy1;
    int usable_dy1 = (((raw_innovation_dy1 * raw_innovation_dy1) < TWO_MASS_THRESHOLD_DY1)
        && !(1.0f < widening_dy1)) ? 1 : 0;
    if (usable_dy1 == 0) {
        const lqg_status_t reason = two_mass_weigh(self, 0, raw_innovation_dy1,
            TWO_MASS_INNOVATION_VARIANCE_DY1);
        usable_dy1 = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float innovation_dy1 = (usable_dy1 != 0) ? raw_innovation_dy1 : 0.0f;

    /* output 1, dy2 [m]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_dy2 = y_dy2 - x_dy2;
    int usable_dy2 = (((raw_innovation_dy2 * raw_innovation_dy2) < TWO_MASS_THRESHOLD_DY2)
        && !(1.0f < widening_dy2)) ? 1 : 0;
    if (usable_dy2 == 0) {
        const lqg_status_t reason = two_mass_weigh(self, 1, raw_innovation_dy2,
            TWO_MASS_INNOVATION_VARIANCE_DY2);
        usable_dy2 = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float innovation_dy2 = (usable_dy2 != 0) ? raw_innovation_dy2 : 0.0f;

    /* x̂ ← x̂ + L innovation;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float posterior_dy1 = x_dy1 + (0.7008788f * innovation_dy1)
        + (0.03500962f * innovation_dy2);
    self->x[0] = posterior_dy1;
    const float squares_to_x_dy1 = posterior_dy1 * posterior_dy1;
    const float posterior_v1 = x_v1 + (0.8304034f * innovation_dy1)
        - (0.105838105f * innovation_dy2);
    self->x[1] = posterior_v1;
    const float squares_to_x_v1 = squares_to_x_dy1 + (posterior_v1 * posterior_v1);
    const float posterior_dy2 = x_dy2 + (0.03500962f * innovation_dy1)
        + (0.26355246f * innovation_dy2);
    self->x[2] = posterior_dy2;
    const float squares_to_x_dy2 = squares_to_x_v1 + (posterior_dy2 * posterior_dy2);
    const float posterior_v2 = x_v2 + (0.17161791f * innovation_dy1)
        + (0.078661025f * innovation_dy2);
    self->x[3] = posterior_v2;
    const float squares_to_x_v2 = squares_to_x_dy2 + (posterior_v2 * posterior_v2);

    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = TWO_MASS_X_BOUNDS */
    if (!(squares_to_x_v2 < TWO_MASS_TWO_TO_80)) {
        status = two_mass_reset(self, status);
    }
    return status;
}

/* u = −K x̂
 *
 * u  out: the inputs, in their units: always finite
 *
 * Status: LQG_INPUT_LIMITED (not finite and set to 0). */
static inline lqg_status_t two_mass_control(const two_mass_t *self, float u[TWO_MASS_NU])
{
    LQG_STRICT_BODY
    const float x_dy1 = self->x[0];
    const float x_v1 = self->x[1];
    const float x_dy2 = self->x[2];
    const float x_v2 = self->x[3];

    /* u = −K x̂ */
    const float law_force = -(2.4226158f * x_dy1) - (2.1417978f * x_v1) + (0.33327204f * x_dy2)
        - (1.9239638f * x_v2);
    const bool finite_force = (law_force - law_force) == 0.0f;
    const float demand_force = finite_force ? law_force : 0.0f;
    u[0] = demand_force;

    lqg_status_t status = LQG_OK;
    if (!finite_force) {
        status |= LQG_INPUT_LIMITED;
    }
    return status;
}

/* From this sample to the next:  x̂ ← A x̂ + B u
 *
 * u  in: the input that was applied, in its units; not the demanded one, if they differ
 *
 * Status: LQG_STATE_RESET. */
static inline lqg_status_t two_mass_predict(two_mass_t *self, const float u[TWO_MASS_NU])
{
    LQG_STRICT_BODY
    const float x_dy1 = self->x[0];
    const float x_v1 = self->x[1];
    const float x_dy2 = self->x[2];
    const float x_v2 = self->x[3];
    const float u_force = u[0];

    /* x̂ ← A x̂ + B u;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float next_dy1 = (0.9877046f * x_dy1) + (0.4974466f * x_v1) + (0.012295422f * x_dy2)
        + (0.002553408f * x_v2) + (0.12465904f * u_force);
    self->x[0] = next_dy1;
    const float squares_to_x_dy1 = next_dy1 * next_dy1;
    const float next_v1 = -(0.048467956f * x_dy1) + (0.9857659f * x_v1) + (0.048467956f * x_dy2)
        + (0.0142341405f * x_v2) + (0.4974466f * u_force);
    self->x[1] = next_v1;
    const float squares_to_x_v1 = squares_to_x_dy1 + (next_v1 * next_v1);
    const float next_dy2 = (0.061477114f * x_dy1) + (0.01276704f * x_v1) + (0.9385229f * x_dy2)
        + (0.48723295f * x_v2) + (0.0017048119f * u_force);
    self->x[2] = next_dy2;
    const float squares_to_x_dy2 = squares_to_x_v1 + (next_dy2 * next_dy2);
    const float next_v2 = (0.24233977f * x_dy1) + (0.0711707f * x_v1) - (0.24233977f * x_dy2)
        + (0.9288293f * x_v2) + (0.01276704f * u_force);
    self->x[3] = next_v2;
    const float squares_to_x_v2 = squares_to_x_dy2 + (next_v2 * next_v2);

    lqg_status_t status = LQG_OK;
    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = TWO_MASS_X_BOUNDS */
    if (!(squares_to_x_v2 < TWO_MASS_TWO_TO_80)) {
        status = two_mass_reset(self, status);
    }
    return status;
}

/* One sample: update, control, predict; assumes that the actuator applies u as it is.
 * Here the three are one text, which keeps the state in registers;
 * bits and status are those of the calls. */
static inline lqg_status_t two_mass_step(two_mass_t *self, const float y[TWO_MASS_NY], float u[TWO_MASS_NU])
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;
    const float x_dy1 = self->x[0];
    const float x_v1 = self->x[1];
    const float x_dy2 = self->x[2];
    const float x_v2 = self->x[3];
    const float widening_dy1 = self->widening[0];
    const float widening_dy2 = self->widening[1];
    const float y_dy1 = y[0];
    const float y_dy2 = y[1];

    /* output 0, dy1 [m]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_dy1 = y_dy1 - x_dy1;
    int usable_dy1 = (((raw_innovation_dy1 * raw_innovation_dy1) < TWO_MASS_THRESHOLD_DY1)
        && !(1.0f < widening_dy1)) ? 1 : 0;
    if (usable_dy1 == 0) {
        const lqg_status_t reason = two_mass_weigh(self, 0, raw_innovation_dy1,
            TWO_MASS_INNOVATION_VARIANCE_DY1);
        usable_dy1 = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float innovation_dy1 = (usable_dy1 != 0) ? raw_innovation_dy1 : 0.0f;

    /* output 1, dy2 [m]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_dy2 = y_dy2 - x_dy2;
    int usable_dy2 = (((raw_innovation_dy2 * raw_innovation_dy2) < TWO_MASS_THRESHOLD_DY2)
        && !(1.0f < widening_dy2)) ? 1 : 0;
    if (usable_dy2 == 0) {
        const lqg_status_t reason = two_mass_weigh(self, 1, raw_innovation_dy2,
            TWO_MASS_INNOVATION_VARIANCE_DY2);
        usable_dy2 = (reason == LQG_OK) ? 1 : 0;
        status |= reason;
    }
    const float innovation_dy2 = (usable_dy2 != 0) ? raw_innovation_dy2 : 0.0f;

    /* x̂ ← x̂ + L innovation;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    float posterior_dy1 = x_dy1 + (0.7008788f * innovation_dy1) + (0.03500962f * innovation_dy2);
    const float squares_to_x_dy1 = posterior_dy1 * posterior_dy1;
    float posterior_v1 = x_v1 + (0.8304034f * innovation_dy1) - (0.105838105f * innovation_dy2);
    const float squares_to_x_v1 = squares_to_x_dy1 + (posterior_v1 * posterior_v1);
    float posterior_dy2 = x_dy2 + (0.03500962f * innovation_dy1) + (0.26355246f * innovation_dy2);
    const float squares_to_x_dy2 = squares_to_x_v1 + (posterior_dy2 * posterior_dy2);
    float posterior_v2 = x_v2 + (0.17161791f * innovation_dy1) + (0.078661025f * innovation_dy2);
    const float squares_to_x_v2 = squares_to_x_dy2 + (posterior_v2 * posterior_v2);

    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = TWO_MASS_X_BOUNDS */
    if (!(squares_to_x_v2 < TWO_MASS_TWO_TO_80)) {
        status = two_mass_reset(self, status);
        posterior_dy1 = self->x[0];
        posterior_v1 = self->x[1];
        posterior_dy2 = self->x[2];
        posterior_v2 = self->x[3];
    }

    /* u = −K x̂ */
    const float law_force = -(2.4226158f * posterior_dy1) - (2.1417978f * posterior_v1)
        + (0.33327204f * posterior_dy2) - (1.9239638f * posterior_v2);
    u[0] = law_force;

    /* x̂ ← A x̂ + B u;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float next_dy1 = (0.9877046f * posterior_dy1) + (0.4974466f * posterior_v1)
        + (0.012295422f * posterior_dy2) + (0.002553408f * posterior_v2)
        + (0.12465904f * law_force);
    self->x[0] = next_dy1;
    const float squares_to_x_dy1_2 = next_dy1 * next_dy1;
    const float next_v1 = -(0.048467956f * posterior_dy1) + (0.9857659f * posterior_v1)
        + (0.048467956f * posterior_dy2) + (0.0142341405f * posterior_v2)
        + (0.4974466f * law_force);
    self->x[1] = next_v1;
    const float squares_to_x_v1_2 = squares_to_x_dy1_2 + (next_v1 * next_v1);
    const float next_dy2 = (0.061477114f * posterior_dy1) + (0.01276704f * posterior_v1)
        + (0.9385229f * posterior_dy2) + (0.48723295f * posterior_v2) + (0.0017048119f * law_force);
    self->x[2] = next_dy2;
    const float squares_to_x_dy2_2 = squares_to_x_v1_2 + (next_dy2 * next_dy2);
    const float next_v2 = (0.24233977f * posterior_dy1) + (0.0711707f * posterior_v1)
        - (0.24233977f * posterior_dy2) + (0.9288293f * posterior_v2) + (0.01276704f * law_force);
    self->x[3] = next_v2;
    const float squares_to_x_v2_2 = squares_to_x_dy2_2 + (next_v2 * next_v2);

    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = TWO_MASS_X_BOUNDS */
    if (!(squares_to_x_v2_2 < TWO_MASS_TWO_TO_80)) {
        status = two_mass_reset(self, status);
    }
    return status;
}

/* Monitors sensors and model: the innovations y − C x̂ and their variances in the steady state. Call it before
 * two_mass_update.
 *
 * y           in: the outputs, in their units
 * innovation  out: the innovations
 * S           out: their variances: innovation²/S is 1 on average if the model is right
 */
static inline void two_mass_innovation(const two_mass_t *self, const float y[TWO_MASS_NY],
    float innovation[TWO_MASS_NY], float S[TWO_MASS_NY])
{
    LQG_STRICT_BODY
    const float x_dy1 = self->x[0];
    const float x_dy2 = self->x[2];
    const float y_dy1 = y[0];
    const float y_dy2 = y[1];

    /* output 0, dy1 [m]: innovation = y − C x̂ */
    const float innovation_dy1 = y_dy1 - x_dy1;
    innovation[0] = innovation_dy1;

    /* output 1, dy2 [m]: innovation = y − C x̂ */
    const float innovation_dy2 = y_dy2 - x_dy2;
    innovation[1] = innovation_dy2;

    S[0] = TWO_MASS_INNOVATION_VARIANCE_DY1;
    S[1] = TWO_MASS_INNOVATION_VARIANCE_DY2;
}

/* The update by some of the outputs, for sensors with their own rates. Any number of predictions may lie between two
 * updates.
 * An approximation: the gains are optimal only when all outputs are used together.
 *
 * y     in: the outputs, in their units; those that are not used are not read
 * used  in: one bit for each output that is used: 1uL << TWO_MASS_Y_DY1
 *
 * Status: as two_mass_update, of the outputs that are used. */
static inline lqg_status_t two_mass_partial_update(two_mass_t *self, const float y[TWO_MASS_NY], unsigned long used)
{
    LQG_STRICT_BODY
    float there[TWO_MASS_NY];
    float innovation[TWO_MASS_NY];
    float S[TWO_MASS_NY];
    unsigned long bit = 1uL;
    lqg_status_t rejected = LQG_OK;
    lqg_status_t status;

    for (int i = 0; i < TWO_MASS_NY; i++) {
        there[i] = ((used & bit) != 0uL) ? y[i] : (float)INFINITY;  /* left out */
        bit <<= 1u;
    }
    two_mass_innovation(self, there, innovation, S);
    const float innovation_dy1 = innovation[0];
    const float innovation_dy2 = innovation[1];
    if (((used & 1uL) != 0uL) && (!(fabsf(innovation_dy1) < TWO_MASS_INNOVATION_LIMIT_DY1))) {
        rejected |= (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(0));
    }
    if (((used & 2uL) != 0uL) && (!(fabsf(innovation_dy2) < TWO_MASS_INNOVATION_LIMIT_DY2))) {
        rejected |= (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(1));
    }

    status = two_mass_update(self, there);
    return (status & ~(LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BITS)) | rejected;
}

/* x̂ ← x, set from outside.
 *
 * x  in: the state, in its units
 *
 * Status: LQG_STATE_RESET, if x is not within TWO_MASS_X_BOUNDS. */
static inline lqg_status_t two_mass_set_state(two_mass_t *self, const float x[TWO_MASS_NX])
{
    LQG_STRICT_BODY
    const float x_dy1 = x[0];
    const float x_v1 = x[1];
    const float x_dy2 = x[2];
    const float x_v2 = x[3];

    /* x̂ ← x;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float squares_to_x_dy1 = x_dy1 * x_dy1;
    const float squares_to_x_v1 = squares_to_x_dy1 + (x_v1 * x_v1);
    const float squares_to_x_dy2 = squares_to_x_v1 + (x_dy2 * x_dy2);
    const float squares_to_x_v2 = squares_to_x_dy2 + (x_v2 * x_v2);

    self->x[0] = x_dy1;
    self->x[1] = x_v1;
    self->x[2] = x_dy2;
    self->x[3] = x_v2;

    lqg_status_t status = LQG_OK;
    /* Σ (x_i/b_i)² < 1 in units of a power of two, b = TWO_MASS_X_BOUNDS */
    if (!(squares_to_x_v2 < TWO_MASS_TWO_TO_80)) {
        status = two_mass_reset(self, status);
    }
    return status;
}

LQG_STRICT_END

#endif
