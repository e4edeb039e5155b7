/* SPDX-License-Identifier: MIT */
/* TinyLQG: what happened in a sample. What firmware does about each bit: the table in lqg/lqg.h. */
#ifndef LQG_STATUS_H
#define LQG_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* A set of the bits below. Whatever is set, the loop goes on: the state is finite, and so is u, within its limits. The
 * statuses of several calls are joined by |. */
typedef unsigned lqg_status_t;

#define LQG_OK                      ((lqg_status_t)0u)  /* nothing to report */
#define LQG_OUTPUT_REJECTED         ((lqg_status_t)1u)  /* an output was NaN, infinite or absurd: not used */
#define LQG_OUTPUT_GATED            ((lqg_status_t)2u)  /* an output was too unlikely: not used */
#define LQG_INNOVATION_NOT_POSITIVE ((lqg_status_t)4u)  /* C P Cᵀ + V of an output was not positive: not used, P anew */
#define LQG_INPUT_LIMITED           ((lqg_status_t)8u)  /* an input was at its limit, or not finite and set to 0 */
#define LQG_STATE_RESET             ((lqg_status_t)16u) /* the state left its bounds: reset, as by init */
#define LQG_REFERENCE_NOT_FINITE    ((lqg_status_t)32u) /* a reference was NaN or infinite: it counted as 0 */
#define LQG_COVARIANCE_RESET        ((lqg_status_t)64u) /* P could not be a covariance: P reset, the estimate kept */
#define LQG_NOT_OPTIMAL             ((lqg_status_t)128u) /* no optimum within the limits: u is the law's, clipped */

/* With LQG_OUTPUT_REJECTED: bits 8 … 15 say which outputs. Output i has bit 8 + i; from the eighth on all share the
 * last. */
#define LQG_OUTPUT_REJECTED_BIT(i) ((lqg_status_t)(0x100u << (((unsigned)(i) < 7u) ? (unsigned)(i) : 7u)))
#define LQG_OUTPUT_REJECTED_BITS   ((lqg_status_t)0xff00u) /* all of them */

/* The gravest of the bits as a sentence in English, without full stop or line end; a constant string. */
const char *lqg_status_text(lqg_status_t status);

#ifdef __cplusplus
}
#endif

#endif
