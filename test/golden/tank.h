/* tank: level and temperature of a tank
 *
 * Made by lqgen 0.1.0 from tank.toml with the SHA-256
 * e0d8ecb82dd6855181e2e6bc087001021697d6f99dbe5047031df976b46b8e16.
 * Do not edit: change the design and run lqgen again. This file is yours: use it under any licence.
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
 *   ξ⁺ = ξ + T (r − y) of level; ξ ← ξ + H (u − what the law asked for) with the u that was applied
 *   H = [ 0.20487356  0.013735944 ]
 *   poles of A − B K: 0.8916, 0.7117, 0.4779
 *   -0.5 ≤ u[0] ≤ 1.0
 *   |change of u[0]| ≤ 0.5 per second
 *   -2.0 ≤ u[1] ≤ 6.0
 *   |change of u[1]| ≤ 4.0 per second
 *
 * Kalman filter, filter form (u[k] is made of the outputs up to y[k]),
 * with its constant gain; of samples:
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
 *   x̂ begins anew when it reaches, in size: 1.1e+12, 1.1e+12
 *   an innovation is not believed from, in size: 2.199e+12, 2.199e+12
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
 * Cortex-M4F, at most 1857 bytes of flash and 56 bytes of stack.
 * Style: unrolled. Arithmetic: fused. Digits of the design: 100.
 */
#ifndef TANK_H
#define TANK_H

#include <math.h>

#include "lqg/arithmetic.h"
#include "lqg/status.h"
#include "lqg/version.h"

#if LQG_HEADER_FORMAT != 2
#error "tank.h was made by lqgen 0.1.0, which this TinyLQG does not know: run the lqgen of this TinyLQG on tank.toml again."
#endif

#define TANK_NX 2  /* states */
#define TANK_NU 2  /* inputs */
#define TANK_NY 2  /* outputs */
#define TANK_NR 2  /* references */
#define TANK_X_BOUNDS {1099511627776.0f, 1099511627776.0f}  /* x̂ stays below them in size, or begins anew */
#define TANK_RECOVERY_SAMPLES 800  /* after a fault has ended its effect is below the noise */
#define TANK_SAMPLE_TIME 0.5f  /* s between two samples */

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

/* The whole state of the controller: no pointers inside, may be copied. Begin it with tank_init. */
typedef struct {
    float x[TANK_NX];  /* x̂, the estimate: of this sample after update, of the next after predict */
    float u_applied[TANK_NU];  /* the input that acts: of the last predict or control */
    float widening[TANK_NY];  /* how much wider than its σ the gate is, squared: more while an output is left out */
    float r[TANK_NR];  /* what the outputs should be: write it at any time */
    float xi[1];  /* ξ, the integral of r − y */
    float error[1];  /* r − y of this sample, which predict adds to ξ */
    float demand[TANK_NU];  /* what the law asked for, before its limits */
    unsigned long resets;  /* how often it began anew, since init; after ULONG_MAX comes 0 */
    unsigned long gated[TANK_NY];  /* how often the gate left an output out */
} tank_t;

LQG_STRICT_BEGIN
#if defined __GNUC__ && !defined __clang__
#pragma GCC optimize ("no-schedule-insns", "no-tree-ter", "no-tree-pre")  /* as written: few values wait in registers */
#endif

/* x̂ = x0, ξ = 0, r = 0; nothing applied yet. */
static inline void tank_init(tank_t *self)
{
    static const tank_t initial = {
        {0.0f, 0.0f},
        {0.0f, 0.0f},
        {32.0f, 1.0f},
        {0.0f, 0.0f},
        {0.0f},
        {0.0f},
        {0.0f, 0.0f},
        0,
        {0}
    };

    *self = initial;
}

/* Begins anew, but for r and what was counted, and counts it: the state was not within its bounds. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static lqg_status tank_reset(tank_t *self, lqg_status status)
{
    float r[TANK_NR];
    const unsigned long resets = self->resets + 1;
    unsigned long gated[TANK_NY];

    for (int i = 0; i < TANK_NR; i++)
        r[i] = self->r[i];
    for (int i = 0; i < TANK_NY; i++)
        gated[i] = self->gated[i];
    tank_init(self);
    for (int i = 0; i < TANK_NR; i++)
        self->r[i] = r[i];
    self->resets = resets;
    for (int i = 0; i < TANK_NY; i++)
        self->gated[i] = gated[i];
    return status | LQG_STATE_RESET;
}

/* Whether output i is used, whose innovation is not as expected: it is not where that is not believable, or beyond
 * 300 σ √w, σ² = S. w, the widening, is 1 as long as all is well, and what was left out too often is heard again. */
#ifdef __GNUC__
__attribute__((noinline, cold))
#endif
static int tank_weigh(tank_t *self, lqg_status *status, int i, float innovation, float S)
{
    LQG_STRICT_BODY
    const float widening = self->widening[i];

    /* w, at least 1 */
    const float width_or_1 = 1.0f < widening ? widening : 1.0f;
    const float width = width_or_1 < 1.2089258e+24f ? width_or_1 : 1.2089258e+24f;

    /* 0 < S, |innovation| below its limit, innovation² ≤ gate² S w */
    const int believable = fabsf(innovation) < 2199023255552.0f;
    const lqg_status fault = believable ? LQG_OK : LQG_OUTPUT_NOT_FINITE;
    const int usable = fault == LQG_OK;
    const int beyond = 90000.0f * S * width < innovation * innovation;
    const int gated = usable && beyond;
    const int used = usable && !beyond;

    /* w widens or narrows */
    const float next_width = (used ? 0.6064453f : 1.5f) * width;
    const float next_width_or_1 = 1.0f < next_width ? next_width : 1.0f;

    self->widening[i] = next_width_or_1 < 1.2089258e+24f ? next_width_or_1 : 1.2089258e+24f;

    self->gated[i] += gated ? 1 : 0;
    *status |= fault | (gated ? LQG_OUTPUT_GATED : LQG_OK);
    return used;
}

/* x̂ ← x̂ + L (y − C x̂)
 *
 * y  in: the outputs, in their units. An output that is not finite, absurd or more than 300 σ off is taken as having come as expected.
 *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
static inline lqg_status tank_update(tank_t *self, const float y[TANK_NY])
{
    LQG_STRICT_BODY
    lqg_status status = LQG_OK;
    const float x_level = self->x[0];
    const float x_temperature = self->x[1];
    const float widening_level = self->widening[0];
    const float widening_temperature = self->widening[1];
    const float r_level = self->r[0];
    const float y_level = y[0];
    const float y_temperature = y[1];

    /* output 0, level [m]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_level = y_level - x_level;
    int usable_level = raw_innovation_level * raw_innovation_level < 29.236143f
        && !(1.0f < widening_level);
    if (!usable_level)
        usable_level = tank_weigh(self, &status, 0, raw_innovation_level, 0.00032484604f);
    const float innovation_level = usable_level ? raw_innovation_level : 0.0f;

    /* output 1, temperature [K]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_temperature = y_temperature - x_temperature;
    int usable_temperature = raw_innovation_temperature * raw_innovation_temperature < 9022.168f
        && !(1.0f < widening_temperature);
    if (!usable_temperature)
        usable_temperature = tank_weigh(self, &status, 1, raw_innovation_temperature, 0.10024631f);
    const float innovation_temperature = usable_temperature ? raw_innovation_temperature : 0.0f;

    /* output 0, level [m]: r − y, which predict adds to ξ; 0 if the output is not used, or it is not believable */
    const float raw_error_level = r_level - y_level;
    const float error_level = usable_level && fabsf(raw_error_level) < 2199023255552.0f
        ? raw_error_level : 0.0f;
    self->error[0] = error_level;

    /* x̂ ← x̂ + L innovation;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float posterior_level = fmaf(0.38432372f, innovation_level, x_level);
    self->x[0] = posterior_level;
    const float squares_to_x_level = posterior_level * posterior_level;
    const float posterior_temperature = fmaf(0.20196564f, innovation_temperature, x_temperature);
    self->x[1] = posterior_temperature;
    const float squares_to_x_temperature = fmaf(posterior_temperature, posterior_temperature,
        squares_to_x_level);

    if (!(squares_to_x_temperature < 1.2089258e+24f))
        return tank_reset(self, status);
    return status;
}

/* u = −K [x̂; ξ] + Nbar r, within its limits
 *
 * u  out: the inputs, in their units: finite and within the limits, whatever came in
 *
 * Status: LQG_REFERENCE_NOT_FINITE (such an r counts as 0), LQG_INPUT_LIMITED. */
static inline lqg_status tank_control(tank_t *self, float u[TANK_NU])
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
    const int finite_r_temperature = r_temperature - r_temperature == 0.0f;
    const float reference_temperature = finite_r_temperature ? r_temperature : 0.0f;

    /* u = −K [x̂; ξ] + Nbar r, within its limits */
    const float law_inflow = fmaf(1.5403687f, -reference_temperature, fmaf(0.48933765f, xi_level,
        fmaf(0.12368507f, x_temperature, -(2.7711725f * x_level))));
    const int finite_inflow = law_inflow - law_inflow == 0.0f;
    const float demand_inflow = finite_inflow ? law_inflow : 0.0f;
    self->demand[0] = demand_inflow;
    const float highest_inflow = u_applied_inflow + 0.25f;
    const float lowest_inflow = u_applied_inflow - 0.25f;
    const int below_lowest_inflow = demand_inflow < lowest_inflow;
    const int above_highest_inflow = highest_inflow < demand_inflow;
    const float reached_inflow = below_lowest_inflow ? lowest_inflow
        : above_highest_inflow ? highest_inflow : demand_inflow;
    const int below_inflow = reached_inflow < -0.5f;
    const int above_inflow = 1.0f < reached_inflow;
    const float limited_inflow = below_inflow ? -0.5f : above_inflow ? 1.0f : reached_inflow;
    u[0] = limited_inflow;
    const float law_heating = fmaf(0.95490813f, reference_temperature, fmaf(0.45884758f, xi_level,
        fmaf(2.3978255f, -x_temperature, -(3.041702f * x_level))));
    const int finite_heating = law_heating - law_heating == 0.0f;
    const float demand_heating = finite_heating ? law_heating : 0.0f;
    self->demand[1] = demand_heating;
    const float highest_heating = u_applied_heating + 2.0f;
    const float lowest_heating = u_applied_heating - 2.0f;
    const int below_lowest_heating = demand_heating < lowest_heating;
    const int above_highest_heating = highest_heating < demand_heating;
    const float reached_heating = below_lowest_heating ? lowest_heating
        : above_highest_heating ? highest_heating : demand_heating;
    const int below_heating = reached_heating < -2.0f;
    const int above_heating = 6.0f < reached_heating;
    const float limited_heating = below_heating ? -2.0f : above_heating ? 6.0f : reached_heating;
    u[1] = limited_heating;

    return (!(r_level - r_level == 0.0f) ? LQG_REFERENCE_NOT_FINITE : LQG_OK)
        | (!finite_r_temperature ? LQG_REFERENCE_NOT_FINITE : LQG_OK)
        | (!finite_inflow ? LQG_INPUT_LIMITED : LQG_OK)
        | (below_lowest_inflow || above_highest_inflow ? LQG_INPUT_LIMITED : LQG_OK)
        | (below_inflow || above_inflow ? LQG_INPUT_LIMITED : LQG_OK)
        | (!finite_heating ? LQG_INPUT_LIMITED : LQG_OK)
        | (below_lowest_heating || above_highest_heating ? LQG_INPUT_LIMITED : LQG_OK)
        | (below_heating || above_heating ? LQG_INPUT_LIMITED : LQG_OK);
}

/* x̂ ← A x̂ + B u,  ξ ← ξ + H (u − what control asked for) + T (r − y): from this sample to the next.
 *
 * u  in: what was applied, in its units; not what was asked for, where the two differ
 *
 * Status: LQG_STATE_RESET. */
static inline lqg_status tank_predict(tank_t *self, const float u[TANK_NU])
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
    const float next_xi_level = fmaf(0.5f, error_level, fmaf(0.013735944f, u_heating
        - demand_heating, fmaf(0.20487356f, u_inflow - demand_inflow, xi_level)));
    self->xi[0] = next_xi_level;
    const float squares_to_xi_level = fmaf(next_xi_level, next_xi_level, squares_to_x_temperature);
    const float sum_to_u_heating = u_inflow + u_heating;

    self->error[0] = 0.0f;
    self->u_applied[0] = u_inflow;
    self->demand[0] = u_inflow;
    self->u_applied[1] = u_heating;
    self->demand[1] = u_heating;

    const lqg_status status = LQG_OK;
    if (!(sum_to_u_heating - sum_to_u_heating < 1.2089258e+24f - squares_to_xi_level))
        return tank_reset(self, status);
    return status;
}

/* One sample: update, control and predict, for an actuator that applies u as it is. */
static inline lqg_status tank_step(tank_t *self, const float y[TANK_NY], float u[TANK_NU])
{
    lqg_status status = tank_update(self, y);

    status |= tank_control(self, u);
    status |= tank_predict(self, u);
    return status;
}

/* The update by level alone, for a sensor with a rate of its own; any number of predictions may lie between two.
 * An approximation: its gain is the best in the company of the other outputs only.
 *
 * y_level  in: the output, in m. One that is not finite, absurd or more than 300 σ off is left out.
 *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
static inline lqg_status tank_update_level(tank_t *self, const float y_level)
{
    LQG_STRICT_BODY
    lqg_status status = LQG_OK;
    const float x_level = self->x[0];
    const float x_temperature = self->x[1];
    const float widening_level = self->widening[0];
    const float r_level = self->r[0];

    /* output 0, level [m]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_level = y_level - x_level;
    int usable_level = raw_innovation_level * raw_innovation_level < 29.236143f
        && !(1.0f < widening_level);
    if (!usable_level)
        usable_level = tank_weigh(self, &status, 0, raw_innovation_level, 0.00032484604f);
    const float innovation_level = usable_level ? raw_innovation_level : 0.0f;

    /* output 0, level [m]: r − y, which predict adds to ξ; 0 if the output is not used, or it is not believable */
    const float raw_error_level = r_level - y_level;
    const float error_level = usable_level && fabsf(raw_error_level) < 2199023255552.0f
        ? raw_error_level : 0.0f;
    self->error[0] = error_level;

    /* x̂ ← x̂ + L innovation;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float posterior_level = fmaf(0.38432372f, innovation_level, x_level);
    self->x[0] = posterior_level;
    const float squares_to_x_level = posterior_level * posterior_level;
    const float squares_to_x_temperature = fmaf(x_temperature, x_temperature, squares_to_x_level);

    if (!(squares_to_x_temperature < 1.2089258e+24f))
        return tank_reset(self, status);
    return status;
}

/* The update by temperature alone, for a sensor with a rate of its own; any number of predictions may lie between two.
 * An approximation: its gain is the best in the company of the other outputs only.
 *
 * y_temperature  in: the output, in K. One that is not finite, absurd or more than 300 σ off is left out.
 *
 * Status: LQG_OUTPUT_NOT_FINITE, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
static inline lqg_status tank_update_temperature(tank_t *self, const float y_temperature)
{
    LQG_STRICT_BODY
    lqg_status status = LQG_OK;
    const float x_level = self->x[0];
    const float x_temperature = self->x[1];
    const float widening_temperature = self->widening[1];

    /* output 1, temperature [K]: innovation = y − C x̂, 0 if it is not used */
    const float raw_innovation_temperature = y_temperature - x_temperature;
    int usable_temperature = raw_innovation_temperature * raw_innovation_temperature < 9022.168f
        && !(1.0f < widening_temperature);
    if (!usable_temperature)
        usable_temperature = tank_weigh(self, &status, 1, raw_innovation_temperature, 0.10024631f);
    const float innovation_temperature = usable_temperature ? raw_innovation_temperature : 0.0f;

    /* x̂ ← x̂ + L innovation;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float squares_to_x_level = x_level * x_level;
    const float posterior_temperature = fmaf(0.20196564f, innovation_temperature, x_temperature);
    self->x[1] = posterior_temperature;
    const float squares_to_x_temperature = fmaf(posterior_temperature, posterior_temperature,
        squares_to_x_level);

    if (!(squares_to_x_temperature < 1.2089258e+24f))
        return tank_reset(self, status);
    return status;
}

/* How far the outputs are from what is expected, y − C x̂ and the steady variance of each:
 * to be called before update by those who watch the health of sensors and model.
 *
 * y           in: the outputs, in their units
 * innovation  out: the innovations
 * S           out: the variances; innovation²/S is 1 in the mean as long as the model holds
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

    S[0] = 0.00032484604f;
    S[1] = 0.10024631f;
}

/* The update by some of the outputs, for sensors with rates of their own; any number of predictions may lie between two.
 * An approximation: the gains are the best in the company of all outputs.
 *
 * y     in: the outputs, in their units; those that are not used are not looked at
 * used  in: which of them are there, a bit each: 1ul << TANK_Y_LEVEL
 *
 * Status: LQG_OUTPUT_NOT_FINITE, of those that are used, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
static inline lqg_status tank_partial_update(tank_t *self, const float y[TANK_NY], unsigned long used)
{
    LQG_STRICT_BODY
    float there[TANK_NY], innovation[TANK_NY], S[TANK_NY];
    unsigned long lost = 0;

    for (int i = 0; i < TANK_NY; i++)
        there[i] = used >> i & 1ul ? y[i] : (float)INFINITY;  /* left out */
    tank_innovation(self, there, innovation, S);
    const float innovation_level = innovation[0];
    const float innovation_temperature = innovation[1];
    lost |= !(fabsf(innovation_level) < 2199023255552.0f) ? 1ul << 0 : 0ul;
    lost |= !(fabsf(innovation_temperature) < 2199023255552.0f) ? 1ul << 1 : 0ul;

    const lqg_status status = tank_update(self, there) & ~LQG_OUTPUT_NOT_FINITE;
    return used & lost ? status | LQG_OUTPUT_NOT_FINITE : status;
}

/* x̂ ← x, by hand. tank_set_input may follow.
 *
 * x  in: the state, in its units
 *
 * Status: LQG_STATE_RESET, when x is not within TANK_X_BOUNDS. */
static inline lqg_status tank_set_state(tank_t *self, const float x[TANK_NX])
{
    LQG_STRICT_BODY
    const float x_level = x[0];
    const float x_temperature = x[1];

    /* x̂ ← x;  squares_to_x_k = b_k² Σ (x̂_i/b_i)², i ≤ k, with the bounds b */
    const float squares_to_x_level = x_level * x_level;
    const float squares_to_x_temperature = fmaf(x_temperature, x_temperature, squares_to_x_level);

    self->x[0] = x_level;
    self->x[1] = x_temperature;

    const lqg_status status = LQG_OK;
    if (!(squares_to_x_temperature < 1.2089258e+24f))
        return tank_reset(self, status);
    return status;
}

/* The input was u, set by hand.
 * ξ becomes such that control goes on there: to be called before control.
 *
 * u  in: what was applied, in its units
 *
 * Status: LQG_REFERENCE_NOT_FINITE, LQG_STATE_RESET, when that is not finite. */
static inline lqg_status tank_set_input(tank_t *self, const float u[TANK_NU])
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
    const int finite_r_temperature = r_temperature - r_temperature == 0.0f;
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

    const lqg_status status = (!(r_level - r_level == 0.0f) ? LQG_REFERENCE_NOT_FINITE
        : LQG_OK) | (!finite_r_temperature ? LQG_REFERENCE_NOT_FINITE : LQG_OK);
    if (!(sum_to_u_heating - sum_to_u_heating < 1.2089258e+24f - squares_to_xi_level))
        return tank_reset(self, status);
    return status;
}

LQG_STRICT_END

#endif
