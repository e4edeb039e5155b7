/* two_mass: two masses, spring and damper
 *
 * Made by lqgen 0.2.0 from two_mass.toml with the SHA-256
 * 46860654c241d4662f7925e59e28b72728299719d8f3760ea0a0858f9525b9e5.
 * Do not edit: change the design and run lqgen again. This file is yours: use it under any licence.
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
 * Kalman filter, filter form (u[k] is made of the outputs up to y[k]),
 * with its constant gain; of samples:
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
 *   x̂ begins anew when it reaches, in size: 1.1e+12, 1.1e+12, 1.1e+12, 1.1e+12
 *   an innovation is not believed from, in size: 2.199e+12, 2.199e+12
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
 * One sample takes 45 multiply-adds and 36 bytes of RAM. By arm-none-eabi-gcc 12.2 at -O2, for a
 * Cortex-M4F, at most 1427 bytes of flash and 36 bytes of stack.
 * Style: unrolled. Arithmetic: plain. Digits of the design: 100.
 */
#ifndef TWO_MASS_H
#define TWO_MASS_H

#include <math.h>

#include "lqg/arithmetic.h"
#include "lqg/status.h"
#include "lqg/version.h"

#if LQG_HEADER_FORMAT != 3
#error "two_mass.h was made by lqgen 0.2.0, which this TinyLQG does not know: run the lqgen of this TinyLQG on two_mass.toml again."
#endif

#define TWO_MASS_NX 4  /* states */
#define TWO_MASS_NU 1  /* inputs */
#define TWO_MASS_NY 2  /* outputs */
#define TWO_MASS_X_BOUNDS {1099511627776.0f, 1099511627776.0f, 1099511627776.0f, 1099511627776.0f}  /* x̂ stays below them in size, or begins anew */
#define TWO_MASS_RECOVERY_SAMPLES 570  /* after a fault has ended its effect is below the noise */
#define TWO_MASS_SAMPLE_TIME 0.5f  /* s between two samples */

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

/* The whole state of the controller: no pointers inside, may be copied. Begin it with two_mass_init. */
typedef struct {
    float x[TWO_MASS_NX];  /* x̂, the estimate: of this sample after update, of the next after predict */
    float widening[TWO_MASS_NY];  /* how much wider than its σ the gate is, squared: more while an output is left out */
    unsigned long resets;  /* how often it began anew, since init; after ULONG_MAX comes 0 */
    unsigned long gated[TWO_MASS_NY];  /* how often the gate left an output out */
} two_mass_t;

LQG_STRICT_BEGIN
#if defined __GNUC__ && !defined __clang__
#pragma GCC optimize ("no-schedule-insns", "no-tree-ter", "no-tree-pre")  /* as written: few values wait in registers */
#endif

/* x̂ = x0; nothing applied yet. */
static inline void two_mass_init(two_mass_t *self)
{
    static const two_mass_t initial = {
        {0.0f, 0.0f, 0.0f, 0.0f},
        {4.0f, 32.0f},
        0,
        {0}
    };

    *self = initial;
}

/* Begins anew, but for what was counted, and counts it: the state was not within its bounds. */
#ifdef __GNUC__
__attribute__((noinline))
#endif
static lqg_status_t two_mass_reset(two_mass_t *self, lqg_status_t status)
{
    const unsigned long resets = self->resets + 1;
    unsigned long gated[TWO_MASS_NY];

    for (int i = 0; i < TWO_MASS_NY; i++)
        gated[i] = self->gated[i];
    two_mass_init(self);
    self->resets = resets;
    for (int i = 0; i < TWO_MASS_NY; i++)
        self->gated[i] = gated[i];
    return status | LQG_STATE_RESET;
}

/* Whether output i is used, whose innovation is not as expected: it is not where that is not believable, or beyond
 * 300 σ √widening, σ² = S. The widening is 1 as long as all is well, and what was left out too often is heard
 * again. */
#ifdef __GNUC__
__attribute__((noinline, cold))
#endif
static int two_mass_weigh(two_mass_t *self, lqg_status_t *status, int i, float innovation, float S)
{
    LQG_STRICT_BODY
    const float widening = self->widening[i];
    const float variance = S;

    /* the widening, at least 1 */
    const float wide = 1.0f < widening ? widening : 1.0f;
    const float width = wide < 1.2089258e+24f ? wide : 1.2089258e+24f;

    /* 0 < S, |innovation| below its limit, innovation² ≤ gate² S widening */
    const int believable = fabsf(innovation) < 2199023255552.0f;
    const lqg_status_t fault = believable ? LQG_OK
        : (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(i));
    const int usable = fault == LQG_OK;
    const int beyond = 90000.0f * variance * width < innovation * innovation;
    const int gated = usable && beyond;
    const int used = usable && !beyond;

    /* it widens or narrows */
    const float next_width = (used ? 0.72558594f : 1.5f) * width;
    const float wide_a = 1.0f < next_width ? next_width : 1.0f;

    self->widening[i] = wide_a < 1.2089258e+24f ? wide_a : 1.2089258e+24f;

    self->gated[i] += gated ? 1 : 0;
    *status |= fault | (gated ? LQG_OUTPUT_GATED : LQG_OK);
    return used;
}

/* x̂ ← x̂ + L (y − C x̂)
 *
 * y  in: the outputs, in their units. An output that is not finite, absurd or more than 300 σ off is taken as having come as expected.
 *
 * Status: LQG_OUTPUT_REJECTED, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
static inline lqg_status_t two_mass_update(two_mass_t *self, const float y[TWO_MASS_NY])
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;
    const float x_0 = self->x[0];
    const float x_1 = self->x[1];
    const float x_2 = self->x[2];
    const float x_3 = self->x[3];
    const float widening_0 = self->widening[0];
    const float widening_1 = self->widening[1];
    const float y_0 = y[0];
    const float y_1 = y[1];

    /* output 0, dy1 [m]: innovation = y − C x̂, 0 if it is not used */
    const float measured_dy1 = y_0 - x_0;
    int usable_dy1 = measured_dy1 * measured_dy1 < 302.56482f && !(1.0f < widening_0);
    if (!usable_dy1)
        usable_dy1 = two_mass_weigh(self, &status, 0, measured_dy1, 0.0033618314f);
    const float innovation_dy1 = usable_dy1 ? measured_dy1 : 0.0f;

    /* output 1, dy2 [m]: innovation = y − C x̂, 0 if it is not used */
    const float measured_dy2 = y_1 - x_2;
    int usable_dy2 = measured_dy2 * measured_dy2 < 122.89207f && !(1.0f < widening_1);
    if (!usable_dy2)
        usable_dy2 = two_mass_weigh(self, &status, 1, measured_dy2, 0.0013654674f);
    const float innovation_dy2 = usable_dy2 ? measured_dy2 : 0.0f;

    /* x̂ ← x̂ + L innovation */
    const float posterior_0 = x_0 + 0.7008788f * innovation_dy1 + 0.03500962f * innovation_dy2;
    self->x[0] = posterior_0;
    const float sum = posterior_0 * posterior_0;
    const float posterior_1 = x_1 + 0.8304034f * innovation_dy1 - 0.105838105f * innovation_dy2;
    self->x[1] = posterior_1;
    const float sum_a = sum + posterior_1 * posterior_1;
    const float posterior_2 = x_2 + 0.03500962f * innovation_dy1 + 0.26355246f * innovation_dy2;
    self->x[2] = posterior_2;
    const float sum_b = sum_a + posterior_2 * posterior_2;
    const float posterior_3 = x_3 + 0.17161791f * innovation_dy1 + 0.078661025f * innovation_dy2;
    self->x[3] = posterior_3;
    const float sum_c = sum_b + posterior_3 * posterior_3;

    if (!(sum_c < 1.2089258e+24f))
        return two_mass_reset(self, status);
    return status;
}

/* u = −K x̂, within its limits
 *
 * u  out: the inputs, in their units: finite, whatever came in
 *
 * Status: LQG_INPUT_LIMITED. */
static inline lqg_status_t two_mass_control(const two_mass_t *self, float u[TWO_MASS_NU])
{
    LQG_STRICT_BODY
    const float x_0 = self->x[0];
    const float x_1 = self->x[1];
    const float x_2 = self->x[2];
    const float x_3 = self->x[3];

    /* u = −K x̂ */
    const float law_0 = -(2.4226158f * x_0) - 2.1417978f * x_1 + 0.33327204f * x_2
        - 1.9239638f * x_3;
    const int finite_0 = law_0 - law_0 == 0.0f;
    const float demand_0 = finite_0 ? law_0 : 0.0f;
    u[0] = demand_0;

    return (!finite_0 ? LQG_INPUT_LIMITED : LQG_OK);
}

/* x̂ ← A x̂ + B u: from this sample to the next.
 *
 * u  in: what was applied, in its units; not what was asked for, where the two differ
 *
 * Status: LQG_STATE_RESET. */
static inline lqg_status_t two_mass_predict(two_mass_t *self, const float u[TWO_MASS_NU])
{
    LQG_STRICT_BODY
    const float x_0 = self->x[0];
    const float x_1 = self->x[1];
    const float x_2 = self->x[2];
    const float x_3 = self->x[3];
    const float u_0 = u[0];

    /* x̂ ← A x̂ + B u */
    const float next_0 = 0.9877046f * x_0 + 0.4974466f * x_1 + 0.012295422f * x_2
        + 0.002553408f * x_3 + 0.12465904f * u_0;
    self->x[0] = next_0;
    const float sum = next_0 * next_0;
    const float next_1 = -(0.048467956f * x_0) + 0.9857659f * x_1 + 0.048467956f * x_2
        + 0.0142341405f * x_3 + 0.4974466f * u_0;
    self->x[1] = next_1;
    const float sum_a = sum + next_1 * next_1;
    const float next_2 = 0.061477114f * x_0 + 0.01276704f * x_1 + 0.9385229f * x_2
        + 0.48723295f * x_3 + 0.0017048119f * u_0;
    self->x[2] = next_2;
    const float sum_b = sum_a + next_2 * next_2;
    const float next_3 = 0.24233977f * x_0 + 0.0711707f * x_1 - 0.24233977f * x_2
        + 0.9288293f * x_3 + 0.01276704f * u_0;
    self->x[3] = next_3;
    const float sum_c = sum_b + next_3 * next_3;

    const lqg_status_t status = LQG_OK;
    if (!(sum_c < 1.2089258e+24f))
        return two_mass_reset(self, status);
    return status;
}

/* One sample: update, control and predict, for an actuator that applies u as it is. */
static inline lqg_status_t two_mass_step(two_mass_t *self, const float y[TWO_MASS_NY], float u[TWO_MASS_NU])
{
    lqg_status_t status = two_mass_update(self, y);

    status |= two_mass_control(self, u);
    status |= two_mass_predict(self, u);
    return status;
}

/* The update by dy1 alone, for a sensor with a rate of its own; any number of predictions may lie between two.
 * An approximation: its gain is the best in the company of the other outputs only.
 *
 * y_dy1  in: the output, in m. One that is not finite, absurd or more than 300 σ off is left out.
 *
 * Status: LQG_OUTPUT_REJECTED, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
static inline lqg_status_t two_mass_update_dy1(two_mass_t *self, const float y_dy1)
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;
    const float x_0 = self->x[0];
    const float x_1 = self->x[1];
    const float x_2 = self->x[2];
    const float x_3 = self->x[3];
    const float widening_0 = self->widening[0];
    const float y = y_dy1;

    /* output 0, dy1 [m]: innovation = y − C x̂, 0 if it is not used */
    const float measured_dy1 = y - x_0;
    int usable_dy1 = measured_dy1 * measured_dy1 < 302.56482f && !(1.0f < widening_0);
    if (!usable_dy1)
        usable_dy1 = two_mass_weigh(self, &status, 0, measured_dy1, 0.0033618314f);
    const float innovation_dy1 = usable_dy1 ? measured_dy1 : 0.0f;

    /* x̂ ← x̂ + L innovation */
    const float posterior_0 = x_0 + 0.7008788f * innovation_dy1;
    self->x[0] = posterior_0;
    const float sum = posterior_0 * posterior_0;
    const float posterior_1 = x_1 + 0.8304034f * innovation_dy1;
    self->x[1] = posterior_1;
    const float sum_a = sum + posterior_1 * posterior_1;
    const float posterior_2 = x_2 + 0.03500962f * innovation_dy1;
    self->x[2] = posterior_2;
    const float sum_b = sum_a + posterior_2 * posterior_2;
    const float posterior_3 = x_3 + 0.17161791f * innovation_dy1;
    self->x[3] = posterior_3;
    const float sum_c = sum_b + posterior_3 * posterior_3;

    if (!(sum_c < 1.2089258e+24f))
        return two_mass_reset(self, status);
    return status;
}

/* The update by dy2 alone, for a sensor with a rate of its own; any number of predictions may lie between two.
 * An approximation: its gain is the best in the company of the other outputs only.
 *
 * y_dy2  in: the output, in m. One that is not finite, absurd or more than 300 σ off is left out.
 *
 * Status: LQG_OUTPUT_REJECTED, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
static inline lqg_status_t two_mass_update_dy2(two_mass_t *self, const float y_dy2)
{
    LQG_STRICT_BODY
    lqg_status_t status = LQG_OK;
    const float x_0 = self->x[0];
    const float x_1 = self->x[1];
    const float x_2 = self->x[2];
    const float x_3 = self->x[3];
    const float widening_1 = self->widening[1];
    const float y = y_dy2;

    /* output 1, dy2 [m]: innovation = y − C x̂, 0 if it is not used */
    const float measured_dy2 = y - x_2;
    int usable_dy2 = measured_dy2 * measured_dy2 < 122.89207f && !(1.0f < widening_1);
    if (!usable_dy2)
        usable_dy2 = two_mass_weigh(self, &status, 1, measured_dy2, 0.0013654674f);
    const float innovation_dy2 = usable_dy2 ? measured_dy2 : 0.0f;

    /* x̂ ← x̂ + L innovation */
    const float posterior_0 = x_0 + 0.03500962f * innovation_dy2;
    self->x[0] = posterior_0;
    const float sum = posterior_0 * posterior_0;
    const float posterior_1 = x_1 - 0.105838105f * innovation_dy2;
    self->x[1] = posterior_1;
    const float sum_a = sum + posterior_1 * posterior_1;
    const float posterior_2 = x_2 + 0.26355246f * innovation_dy2;
    self->x[2] = posterior_2;
    const float sum_b = sum_a + posterior_2 * posterior_2;
    const float posterior_3 = x_3 + 0.078661025f * innovation_dy2;
    self->x[3] = posterior_3;
    const float sum_c = sum_b + posterior_3 * posterior_3;

    if (!(sum_c < 1.2089258e+24f))
        return two_mass_reset(self, status);
    return status;
}

/* How far the outputs are from what is expected, y − C x̂ and the steady variance of each:
 * to be called before update by those who watch the health of sensors and model.
 *
 * y           in: the outputs, in their units
 * innovation  out: y less what is expected
 * S           out: the variances; innovation²/S is 1 in the mean as long as the model holds
 */
static inline void two_mass_innovation(const two_mass_t *self, const float y[TWO_MASS_NY],
    float innovation[TWO_MASS_NY], float S[TWO_MASS_NY])
{
    LQG_STRICT_BODY
    const float x_0 = self->x[0];
    const float x_2 = self->x[2];
    const float y_0 = y[0];
    const float y_1 = y[1];

    /* output 0, dy1 [m]: innovation = y − C x̂ */
    const float innovation_dy1 = y_0 - x_0;
    innovation[0] = innovation_dy1;

    /* output 1, dy2 [m]: innovation = y − C x̂ */
    const float innovation_dy2 = y_1 - x_2;
    innovation[1] = innovation_dy2;

    S[0] = 0.0033618314f;
    S[1] = 0.0013654674f;
}

/* The update by some of the outputs, for sensors with rates of their own; any number of predictions may lie between two.
 * An approximation: the gains are the best in the company of all outputs.
 *
 * y     in: the outputs, in their units; those that are not used are not looked at
 * used  in: which of them are there, a bit each: 1ul << TWO_MASS_Y_DY1
 *
 * Status: LQG_OUTPUT_REJECTED, of those that are used, LQG_OUTPUT_GATED, LQG_STATE_RESET. */
static inline lqg_status_t two_mass_partial_update(two_mass_t *self, const float y[TWO_MASS_NY], unsigned long used)
{
    LQG_STRICT_BODY
    float there[TWO_MASS_NY], innovation[TWO_MASS_NY], S[TWO_MASS_NY];
    lqg_status_t rejected = LQG_OK;

    for (int i = 0; i < TWO_MASS_NY; i++)
        there[i] = used >> i & 1ul ? y[i] : (float)INFINITY;  /* left out */
    two_mass_innovation(self, there, innovation, S);
    const float innovation_0 = innovation[0];
    const float innovation_1 = innovation[1];
    if ((used & 1ul) != 0ul && !(fabsf(innovation_0) < 2199023255552.0f))
        rejected |= (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(0));
    if ((used & 2ul) != 0ul && !(fabsf(innovation_1) < 2199023255552.0f))
        rejected |= (LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(1));

    const lqg_status_t status = two_mass_update(self, there);
    return (status & ~(LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BITS)) | rejected;
}

/* x̂ ← x, by hand.
 *
 * x  in: the state, in its units
 *
 * Status: LQG_STATE_RESET, when x is not within TWO_MASS_X_BOUNDS. */
static inline lqg_status_t two_mass_set_state(two_mass_t *self, const float x[TWO_MASS_NX])
{
    LQG_STRICT_BODY
    const float x_0 = x[0];
    const float x_1 = x[1];
    const float x_2 = x[2];
    const float x_3 = x[3];

    /* Σ x² in units of a bound */
    const float sum = x_0 * x_0;
    const float sum_a = sum + x_1 * x_1;
    const float sum_b = sum_a + x_2 * x_2;
    const float sum_c = sum_b + x_3 * x_3;

    self->x[0] = x_0;
    self->x[1] = x_1;
    self->x[2] = x_2;
    self->x[3] = x_3;

    const lqg_status_t status = LQG_OK;
    if (!(sum_c < 1.2089258e+24f))
        return two_mass_reset(self, status);
    return status;
}

LQG_STRICT_END

#endif
