/* SPDX-License-Identifier: MIT */
#include "gate.h"

LQG_STRICT_BEGIN

/* The widening, from 1 to 2⁸⁰ whatever it was: a NaN is 1. */
static lqg_real kept_width(lqg_real widening)
{
    LQG_STRICT_BODY
    const lqg_real widest = (lqg_real)1208925819614629174706176.0f; /* 2⁸⁰ */
    const lqg_real least = 1 < widening ? widening : 1;

    return least < widest ? least : widest;
}

/* |innovation| > sigma √(s widening). Widens or narrows the gate by that, and counts. */
static int is_gated(const gatekeeper_t *keeper, unsigned i, int plausible, lqg_real innovation, lqg_real s, int opens)
{
    LQG_STRICT_BODY
    const lqg_gate_t *gate = keeper->gate;
    lqg_real *widening = gate->widen ? &keeper->state->widening[i] : NULL;
    const lqg_real width = widening ? kept_width(*widening) : 1;
    const int gated = plausible && gate->sigma * gate->sigma * s * width < innovation * innovation;

    if (widening) {
        const lqg_real change = plausible && !gated ? gate->narrow[i] : gated || opens ? gate->widen[i] : 1;
        *widening = kept_width(change * width);
    }
    if (gated && keeper->state->gated)
        keeper->state->gated[i]++;
    return gated;
}

lqg_status_t lqg_gate_weigh(const gatekeeper_t *keeper, unsigned i, int plausible, lqg_real innovation, lqg_real s,
                            int opens)
{
    const lqg_watch_t *watch = keeper->watch;
    const int gated = keeper->gate && is_gated(keeper, i, plausible, innovation, s, opens);

    if (watch && watch->innovation)
        watch->innovation[i] = innovation;
    if (watch && watch->S)
        watch->S[i] = s;
    if (watch && watch->heard)
        watch->heard[i] = plausible && !gated;
    return gated ? LQG_OUTPUT_GATED : LQG_OK;
}

LQG_STRICT_END
