/* SPDX-License-Identifier: MIT */
/* TinyLQG: what happened in a sample. */
#ifndef LQG_STATUS_H
#define LQG_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* A set of the bits below. Whatever is set, the loop goes on: the state is finite, and so is u, within its
 * limits. The statuses of several calls are joined by |. */
typedef unsigned lqg_status;

#define LQG_OK 0u                       /* nothing to report */
#define LQG_OUTPUT_NOT_FINITE 1u        /* an output was NaN, infinite or absurd: it was left out */
#define LQG_OUTPUT_GATED 2u             /* an output was too unlikely: it was left out */
#define LQG_INNOVATION_NOT_POSITIVE 4u  /* C P Cᵀ + V of an output was not positive: it was left out, P begins anew */
#define LQG_INPUT_LIMITED 8u            /* an input was at its limit, or not finite and set to 0 */
#define LQG_STATE_RESET 16u             /* the state left its bounds: it begins anew, as after init */
#define LQG_REFERENCE_NOT_FINITE 32u    /* a reference was NaN or infinite: it counted as 0 */
#define LQG_COVARIANCE_RESET 64u        /* P could not be a covariance: it begins anew, the estimate stays */

/* The gravest of the bits as a sentence in English, without full stop or line end; a constant string. */
const char *lqg_status_text(lqg_status status);

#ifdef __cplusplus
}
#endif

#endif
