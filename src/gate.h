/* SPDX-License-Identifier: MIT */
/* Which outputs are used, and what is told of them. Not for firmware. */
#ifndef LQG_GATE_H
#define LQG_GATE_H

#include "kernel.h"
#include "lqg/kalman.h"

#define lqg_gate_weigh LQG_VARIANT(lqg_gate_weigh)

/* A gate, what it remembers, and who watches. gate and watch MAY be NULL. */
typedef struct {
    const lqg_gate_t *gate;
    const lqg_gate_state_t *state;
    const lqg_watch_t *watch;
} gatekeeper_t;

/* Tells and remembers the innovation of output i, which is 0 if it is not plausible, and its variance s.
 * LQG_OUTPUT_GATED when the gate leaves it out. `opens`: the gate opens also for one that is not plausible. */
lqg_status_t lqg_gate_weigh(const gatekeeper_t *keeper, unsigned i, int plausible, lqg_real innovation, lqg_real s,
                            int opens);

/* What a caller MUST give of a gate, and of what it remembers. */
static inline void check_gate(const lqg_gate_t *gate, const lqg_gate_state_t *state)
{
    (void)gate;
    (void)state;
    LQG_ASSERT(!gate || gate->sigma > 0);
    LQG_ASSERT(!gate || !gate->widen || (gate->narrow && state->widening));
}

/* widening = start, where there is one; 0 counts as 1. */
static inline void begin_widening(const lqg_gate_t *gate, const lqg_gate_state_t *state, unsigned ny)
{
    lqg_begin(state->widening, gate ? gate->start : NULL, ny);
}

/* Output i was not to be used, which `opens` the gate of a constant gain: as one that is not plausible, unreported. */
static inline void skip(const gatekeeper_t *keeper, unsigned i, int opens)
{
    if (keeper->gate || keeper->watch)
        (void)lqg_gate_weigh(keeper, i, 0, 0, 0, opens);
}

/* What the status says of output i. */
static inline lqg_status_t rejected(unsigned i)
{
    return LQG_OUTPUT_REJECTED | LQG_OUTPUT_REJECTED_BIT(i);
}

/* `used` for the output after the one whose bit was the lowest; outputs from the 33rd on are used. */
static inline unsigned long after_lowest(unsigned long used)
{
    return (used >> 1) | 0x80000000uL;
}

LQG_STRICT_BEGIN

/* The innovation of output i, of a variance of s at least, is within the narrowest gate, and nobody asks for it: there
 * is nothing to tell but that it was heard. Most samples are like that. */
static inline int is_expected(const gatekeeper_t *keeper, unsigned i, lqg_real innovation, lqg_real s)
{
    LQG_STRICT_BODY
    const lqg_gate_t *gate = keeper->gate;
    const lqg_watch_t *watch = keeper->watch;

    if (watch && (watch->innovation || watch->S))
        return 0;
    if (gate &&
        (!(innovation * innovation < gate->sigma * gate->sigma * s) || (gate->widen && 1 < keeper->state->widening[i])))
        return 0;
    if (watch && watch->heard)
        watch->heard[i] = 1;
    return 1;
}

LQG_STRICT_END

#endif
