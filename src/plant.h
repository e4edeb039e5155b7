/* SPDX-License-Identifier: MIT */
/* What all filters do with the plant and with a watch, which MAY be NULL. Not for firmware. */
#ifndef LQG_PLANT_H
#define LQG_PLANT_H

#include "kernel.h"
#include "lqg/kalman.h"

#define lqg_plant_begin LQG_VARIANT(lqg_plant_begin)
#define lqg_plant_innovation LQG_VARIANT(lqg_plant_innovation)
#define lqg_plant_decorrelate LQG_VARIANT(lqg_plant_decorrelate)
#define lqg_plant_decorrelate_alone LQG_VARIANT(lqg_plant_decorrelate_alone)
#define lqg_plant_keep_residuals LQG_VARIANT(lqg_plant_keep_residuals)
#define lqg_plant_predict LQG_VARIANT(lqg_plant_predict)
#define lqg_watch_uses LQG_VARIANT(lqg_watch_uses)
#define lqg_watch_output LQG_VARIANT(lqg_watch_output)
#define lqg_watch_silence LQG_VARIANT(lqg_watch_silence)

/* x = x0 (NULL: 0), u_applied = 0, innovation = 0; the latter two where there are any. */
void lqg_plant_begin(const lqg_plant_t *plant, const lqg_real x0[], lqg_real x[], lqg_real u_applied[],
                     lqg_real innovation[]);

/* y_i − C_i x − D_i u */
lqg_real lqg_plant_innovation(const lqg_plant_t *plant, unsigned i, const lqg_real x[],
                              const lqg_real u_applied[], lqg_real y_i);

/* y'_i = y_i + Σ_j<i E_ij y_j, y_i itself when E is NULL. before[i] has the y'_j of the outputs before it, NaN for one that was
 * left out: what needs that one is NaN. Zeros of E keep the NaN of one output out of the others. */
lqg_real lqg_plant_decorrelate(const lqg_plant_t *plant, const lqg_real E[], unsigned i, const lqg_real y[],
                               const lqg_real before[]);

/* y'_i of y_i alone: y_i itself, or NaN where row i of E (MAY be NULL) needs other outputs. */
lqg_real lqg_plant_decorrelate_alone(const lqg_plant_t *plant, const lqg_real E[], unsigned i, lqg_real y_i);

/* innovation_i ← y'_i − C_i x − D_i u where innovation_i is 1 (output i was used); it stays 0 elsewhere. */
void lqg_plant_keep_residuals(const lqg_plant_t *plant, const lqg_real x[], const lqg_real u_applied[],
                              const lqg_real y[], lqg_real innovation[]);

/* x ← A x + B u + M innovation (M may be NULL),  u_applied ← u,  innovation ← 0. work[nx] is scratch. */
void lqg_plant_predict(const lqg_plant_t *plant, const lqg_real M[], lqg_real x[], lqg_real u_applied[],
                       lqg_real innovation[], const lqg_real u[], lqg_real work[]);

/* Output i is to be used. */
int lqg_watch_uses(const lqg_watch_t *watch, unsigned i);

LQG_STRICT_BEGIN

/* The innovation ν of output i, of a variance of s at least, is within the gate, which is no wider than its σ, and nobody looks:
 * there is nothing to write down but that it was heard. Most samples are like that. */
static inline int lqg_watch_expects(const lqg_watch_t *watch, unsigned i, lqg_real innovation, lqg_real s)
{
    LQG_STRICT_BODY
    if (!watch)
        return 1;
    if (watch->nu || watch->s || !watch->widening)
        return 0;
    if (!(innovation * innovation < watch->gate * watch->gate * s) || 1 < watch->widening[i])
        return 0;
    if (watch->heard)
        watch->heard[i] = 1;
    return 1;
}

LQG_STRICT_END

/* Writes down the innovation of output i, which is 0 if it is not believable, and its variance s. LQG_OUTPUT_GATED when
 * the gate leaves it out, which is counted and opens the gate. `opens`: one that is not believable does, too. */
lqg_status lqg_watch_output(const lqg_watch_t *watch, unsigned i, int believable, lqg_real innovation, lqg_real s,
                            int opens);

/* Output i was not used, which `opens` the gate of a constant gain. */
void lqg_watch_silence(const lqg_watch_t *watch, unsigned i, int opens);

#endif
