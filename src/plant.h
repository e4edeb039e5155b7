/* SPDX-License-Identifier: MIT */
/* What all filters do with the plant. Not for firmware. */
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

/* x = x0 (NULL: 0), u_applied = 0, innovation = 0; the latter two where there are any. */
void lqg_plant_begin(const lqg_plant_t *plant, const lqg_real x0[], lqg_real x[], lqg_real u_applied[],
                     lqg_real innovation[]);

/* y_i − C_i x − D_i u */
lqg_real lqg_plant_innovation(const lqg_plant_t *plant, unsigned i, const lqg_real x[], const lqg_real u_applied[],
                              lqg_real y_i);

/* y'_i = y_i + Σ_j<i E_ij y_j, y_i itself when E is NULL. before[i] has the y'_j of the outputs before it, NaN for one
 * that was left out: what needs that one is NaN. Zeros of E keep the NaN of one output out of the others. */
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

/* Where the next row begins in a pattern. */
static inline const unsigned char *next_row(const unsigned char *row)
{
    return row + 1 + row[0];
}

/* What a caller MUST give of a plant and of what a filter remembers: nothing, unless LQG_ASSERT checks it. */
static inline void check_plant(const lqg_plant_t *plant, const lqg_real x[], const lqg_real u_applied[])
{
    (void)plant;
    (void)x;
    (void)u_applied;
    LQG_ASSERT(plant->nx >= 1 && plant->ny >= 1);
    LQG_ASSERT(plant->A && plant->C && (plant->B || !plant->nu));
    LQG_ASSERT(!plant->pattern || (plant->nx >= 4 && plant->nx <= 255));
    LQG_ASSERT(x && (u_applied || !plant->D || !plant->nu));
}

#endif
