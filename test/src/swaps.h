/* SPDX-License-Identifier: MIT */
/* One of everything, for the calls of swaps.cmake. */
#ifndef TEST_SWAPS_H
#define TEST_SWAPS_H

#include "lqg/lqg.h"

extern const lqg_kalman_steady_t steady;
extern lqg_kalman_steady_state_t steady_state;
extern const lqg_kalman_plain_t plain;
extern lqg_kalman_plain_state_t plain_state;
extern const lqg_kalman_ud_t ud;
extern lqg_kalman_ud_state_t ud_state;
extern const lqg_ekf_t ekf;
extern lqg_ekf_state_t ekf_state;
extern const lqg_rls_t rls;
extern lqg_rls_state_t rls_state;
extern const lqg_servo_t servo;
extern lqg_servo_state_t servo_state;
extern const lqg_loop_ud_t loop;
extern lqg_loop_ud_state_t loop_state;
extern const lqg_lqr_t lqr;

extern const lqg_gate_t gate;
extern const lqg_watch_t watch;
extern const lqg_real x[4], y[2], r[1], phi[4], y_i;
extern lqg_real u[1];
extern unsigned i;
extern unsigned long used;

void call(void);

#endif
