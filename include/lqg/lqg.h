/* SPDX-License-Identifier: MIT */
/* TinyLQG: Kalman filter and LQR for microcontrollers, and the two together. This header is the whole
 * library.
 *
 * Conventions, said once for all functions:
 *
 *   Memory       Nothing is allocated and nothing is kept between calls but what the caller passes. There is
 *                nothing to close.
 *   Description  A const struct of dimensions and pointers to matrices (lqg_kalman_ud_t, lqg_lqr_t …), never
 *                written to: it and its matrices may lie in flash and serve any number of loops.
 *   State        Arrays of the caller, begun by `init`. They hold no pointers and may be copied and compared
 *                byte by byte. One set of arrays is one loop; loops are independent, and functions may run in
 *                interrupts.
 *   Scratch      work[] has the length that its macro says; contents before and after a call mean nothing.
 *   Matrices     Row-major, M_ij at M[i*columns + j]; triangles as lqg/kalman.h says.
 *   NULL         Only where a comment allows it.
 *   Aliasing     Arrays MUST NOT overlap unless a comment allows it. Inputs are never written to.
 *   Units        Any, as long as they belong together; in and out they are those of the plant.
 *   MUST         Undefined behaviour if violated: it is not checked on the target.
 *   Failure      Never stops anything. The status says what was left out, limited or reset (lqg/status.h).
 *   Time         Loops have fixed lengths: the number of operations does not depend on the data.
 *   Order        Filter form: update(y), control(u), predict(u). Predictor form: control(u), update(y),
 *                predict(u).
 *   Options      LQG_REAL_DOUBLE and LQG_FUSED (lqg/arithmetic.h), the same for library and firmware, or it
 *                does not link.
 */
#ifndef LQG_LQG_H
#define LQG_LQG_H

#include "lqg/arithmetic.h"
#include "lqg/ekf.h"
#include "lqg/kalman.h"
#include "lqg/lqr.h"
#include "lqg/rls.h"
#include "lqg/servo.h"
#include "lqg/status.h"
#include "lqg/version.h"

#ifdef __cplusplus
extern "C" {
#endif

#define lqg_lqg_steady_step LQG_VARIANT(lqg_lqg_steady_step)
#define lqg_lqg_plain_step LQG_VARIANT(lqg_lqg_plain_step)
#define lqg_lqg_ud_step LQG_VARIANT(lqg_lqg_ud_step)

/* The order of the calls in a sample, and which estimate u is made of. */
typedef enum {
    LQG_FILTER_FORM,    /* u of this sample's y: update, control, predict */
    LQG_PREDICTOR_FORM  /* u ready before y comes: control, update, predict */
} lqg_form_t;

typedef struct {
    lqg_kalman_steady_t kalman;
    lqg_lqr_t lqr; /* nx, nu MUST be those of the plant */
    lqg_form_t form;
} lqg_lqg_steady_t;

typedef struct {
    lqg_kalman_plain_t kalman;
    lqg_lqr_t lqr; /* nx, nu MUST be those of the plant */
    lqg_form_t form;
} lqg_lqg_plain_t;

typedef struct {
    lqg_kalman_ud_t kalman;
    lqg_lqr_t lqr; /* nx, nu MUST be those of the plant */
    lqg_form_t form;
} lqg_lqg_ud_t;

/* One sample of the loop: update, control and predict in the order of the form, for an actuator that applies
 * u as it is. Where it does not, or where u should leave before the prediction is made, make the three calls
 * yourself.
 *
 * State and work[] are those of the filter, begun by its init.
 * y[ny]  in: what the sensors say
 * u[nu]  out: what to apply
 *
 * Status and cost: those of the three calls together. */
lqg_status lqg_lqg_steady_step(const lqg_lqg_steady_t *loop, lqg_real x[], lqg_real u_applied[],
                               lqg_real innovation[], const lqg_real y[], lqg_real u[], lqg_real work[]);

lqg_status lqg_lqg_plain_step(const lqg_lqg_plain_t *loop, lqg_real x[], lqg_real P[], lqg_real u_applied[],
                              lqg_real innovation[], const lqg_real y[], lqg_real u[], lqg_real work[]);

lqg_status lqg_lqg_ud_step(const lqg_lqg_ud_t *loop, lqg_real x[], lqg_real U[], lqg_real d[],
                           lqg_real u_applied[], lqg_real innovation[], const lqg_real y[], lqg_real u[],
                           lqg_real work[]);

#ifdef __cplusplus
}
#endif

#endif
