/* SPDX-License-Identifier: MIT */
/* TinyLQG: filter and regulator together, one call a sample. Conventions: lqg/lqg.h.
 *
 *     static const lqg_loop_ud_t loop = {…};            in flash
 *     LQG_LOOP_UD_STATE(state, 4, 1, 2, 1);             its state: nx, nu, ny, nw
 *
 *     lqg_loop_ud_init(&loop, &state);                  once
 *     status = lqg_loop_ud_step(&loop, &state, y);      each sample; then apply state.u
 */
#ifndef LQG_LOOP_H
#define LQG_LOOP_H

#include "lqg/arithmetic.h"
#include "lqg/kalman.h"
#include "lqg/lqr.h"
#include "lqg/status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define lqg_loop_steady_init LQG_VARIANT(lqg_loop_steady_init)
#define lqg_loop_steady_step LQG_VARIANT(lqg_loop_steady_step)
#define lqg_loop_plain_init  LQG_VARIANT(lqg_loop_plain_init)
#define lqg_loop_plain_step  LQG_VARIANT(lqg_loop_plain_step)
#define lqg_loop_ud_init     LQG_VARIANT(lqg_loop_ud_init)
#define lqg_loop_ud_step     LQG_VARIANT(lqg_loop_ud_step)

/* The order of the calls in a sample, and which estimate u is made of. */
typedef enum {
    LQG_FILTER_FORM,   /* u of this sample's y: update, control, predict */
    LQG_PREDICTOR_FORM /* u ready before y comes: control, update, predict */
} lqg_form_t;

/* A loop, constant: may lie in flash. nx and nu of lqr MUST be those of the plant. */
typedef struct {
    lqg_kalman_steady_t kalman;
    lqg_lqr_t lqr;
    lqg_form_t form;
} lqg_loop_steady_t;

typedef struct {
    lqg_kalman_plain_t kalman;
    lqg_lqr_t lqr;
    lqg_form_t form;
} lqg_loop_plain_t;

typedef struct {
    lqg_kalman_ud_t kalman;
    lqg_lqr_t lqr;
    lqg_form_t form;
} lqg_loop_ud_t;

/* The filter's state and what is to be applied. */
typedef struct {
    lqg_kalman_steady_state_t kalman;
    lqg_real *u; /* nu, out */
} lqg_loop_steady_state_t;

typedef struct {
    lqg_kalman_plain_state_t kalman;
    lqg_real *u; /* nu, out */
} lqg_loop_plain_state_t;

typedef struct {
    lqg_kalman_ud_state_t kalman;
    lqg_real *u; /* nu, out */
} lqg_loop_ud_state_t;

/* A static state and its memory; numbers of reals; an initializer of a state over memory[LQG_…_MEMORY]. */
#define LQG_LOOP_STEADY_STATE(state, nx, nu, ny)                                                                     \
    static lqg_real state##_memory[LQG_LOOP_STEADY_MEMORY(nx, nu, ny)];                                              \
    static lqg_loop_steady_state_t state = LQG_LOOP_STEADY_STATE_IN(state##_memory, nx, nu, ny)
#define LQG_LOOP_STEADY_MEMORY(nx, nu, ny) (LQG_KALMAN_STEADY_MEMORY(nx, nu, ny) + (nu))
#define LQG_LOOP_STEADY_STATE_IN(memory, nx, nu, ny)                                                                 \
    {                                                                                                                \
        LQG_KALMAN_STEADY_STATE_IN(memory, nx, nu, ny), (memory) + LQG_KALMAN_STEADY_MEMORY(nx, nu, ny)              \
    }

#define LQG_LOOP_PLAIN_STATE(state, nx, nu, ny)                                                                      \
    static lqg_real state##_memory[LQG_LOOP_PLAIN_MEMORY(nx, nu, ny)];                                               \
    static lqg_loop_plain_state_t state = LQG_LOOP_PLAIN_STATE_IN(state##_memory, nx, nu, ny)
#define LQG_LOOP_PLAIN_MEMORY(nx, nu, ny) (LQG_KALMAN_PLAIN_MEMORY(nx, nu, ny) + (nu))
#define LQG_LOOP_PLAIN_STATE_IN(memory, nx, nu, ny)                                                                  \
    {                                                                                                                \
        LQG_KALMAN_PLAIN_STATE_IN(memory, nx, nu, ny), (memory) + LQG_KALMAN_PLAIN_MEMORY(nx, nu, ny)                \
    }

#define LQG_LOOP_UD_STATE(state, nx, nu, ny, nw)                                                                     \
    static lqg_real state##_memory[LQG_LOOP_UD_MEMORY(nx, nu, ny, nw)];                                              \
    static lqg_loop_ud_state_t state = LQG_LOOP_UD_STATE_IN(state##_memory, nx, nu, ny, nw)
#define LQG_LOOP_UD_MEMORY(nx, nu, ny, nw) (LQG_KALMAN_UD_MEMORY(nx, nu, ny, nw) + (nu))
#define LQG_LOOP_UD_STATE_IN(memory, nx, nu, ny, nw)                                                                 \
    {                                                                                                                \
        LQG_KALMAN_UD_STATE_IN(memory, nx, nu, ny, nw), (memory) + LQG_KALMAN_UD_MEMORY(nx, nu, ny, nw)              \
    }

/* The filter's init, and u = 0. */
void lqg_loop_steady_init(const lqg_loop_steady_t *loop, lqg_loop_steady_state_t *state);
void lqg_loop_plain_init(const lqg_loop_plain_t *loop, lqg_loop_plain_state_t *state);
void lqg_loop_ud_init(const lqg_loop_ud_t *loop, lqg_loop_ud_state_t *state);

/* One sample: update, control and predict in the order of the form, for an actuator that applies u as it is. Where it
 * does not, or where u should leave before the prediction, make the three calls yourself.
 *
 * y  in: the outputs; u is state->u
 *
 * Status and cost: those of the three calls together. */
lqg_status_t lqg_loop_steady_step(const lqg_loop_steady_t *loop, lqg_loop_steady_state_t *state,
                                  const lqg_real y[/* ny */]);
lqg_status_t lqg_loop_plain_step(const lqg_loop_plain_t *loop, lqg_loop_plain_state_t *state,
                                 const lqg_real y[/* ny */]);
lqg_status_t lqg_loop_ud_step(const lqg_loop_ud_t *loop, lqg_loop_ud_state_t *state, const lqg_real y[/* ny */]);

#ifdef __cplusplus
}
#endif

#endif
