/* SPDX-License-Identifier: MIT */
/* TinyLQG: Kalman filter and LQR for microcontrollers, and the two together. This header is the whole library.
 *
 * | header       | what                                            | functions                       |
 * | ------------ | ----------------------------------------------- | ------------------------------- |
 * | lqg/kalman.h | filters: constant gain, covariance, its factors | init, update, predict           |
 * | lqg/lqr.h    | u = −K x within limits                          | control                         |
 * | lqg/servo.h  | the same with integral action and references    | init, observe, control, advance |
 * | lqg/mpc.h    | u = −K x + v, limits foreseen                   | control, limit                  |
 * | lqg/loop.h   | filter and lqr in one call a sample             | init, step                      |
 * | lqg/ekf.h    | extended filter, for plants that are not linear | init, update, predict           |
 * | lqg/rls.h    | recursive least squares                         | init, update                    |
 * | lqg/status.h | what happened in a sample                       | status_text                     |
 *
 * lqg/functions.h has elementary functions, lqg_sinf … lqg_atan2f, lqg_sin … lqg_atan2, with the same bits everywhere.
 *
 * Conventions, said once for all functions:
 *
 *   Order        f(&description, &state, y, u, the rest): always the description first, then the state, then the
 *                plant's y and u. A description or a state in the place of another is an error of the compiler, or a
 *                warning.
 *   Description  A const struct of dimensions and pointers to matrices (lqg_kalman_ud_t, lqg_lqr_t …), never written
 *                to: it and its matrices may lie in flash and serve any number of loops.
 *   State        A struct of pointers into memory of the caller (lqg_kalman_ud_state_t …), begun by `init`.
 *                LQG_KALMAN_UD_STATE(state, nx, nu, ny, nw); defines it with its memory, static; for memory of your own
 *                    lqg_real memory[LQG_KALMAN_UD_MEMORY(nx, nu, ny, nw)];
 *                    lqg_kalman_ud_state_t state = LQG_KALMAN_UD_STATE_IN(memory, nx, nu, ny, nw);
 *                The memory holds no pointers: to save a state, copy its memory. Copies of the struct share it.
 *   Memory       Nothing is allocated, and nothing kept between calls, but what the caller passes.
 *   Matrices     Row-major, M_ij at M[i*columns + j]; triangles as lqg/kalman.h says.
 *   NULL         Only where a comment allows it.
 *   Aliasing     Arrays MUST NOT overlap unless a comment allows it. Inputs are never written to.
 *   Units        Any, as long as they belong together; y and u are those of the plant.
 *   MUST         Undefined behaviour if violated: not checked on the target. LQG_ASSERT checks it, see below.
 *   Failure      Nothing stops. The status says what was left out, limited or reset.
 *   Time         Loops have fixed lengths: the number of operations does not depend on the data. Those of lqg/mpc.h
 *                have bounds.
 *   A sample     Filter form: update(y), control(u), predict(u). Predictor form: control(u), update(y), predict(u).
 *
 * Interrupts and tasks. No function has memory of its own, so different states are independent:
 *
 * | a call for          | may interrupt a call for | because                                                 |
 * | ------------------- | ------------------------ | ------------------------------------------------------- |
 * | a state             | another state, any time  | nothing is shared but const descriptions                |
 * | a state             | the same state, never    | half-written arrays: call from one task or interrupt,   |
 * |                     |                          | or mask the interrupt around calls from elsewhere       |
 * | lqg_lqr_control     | anything                 | it has no state                                         |
 * | lqg_status_text     | anything                 | it has no state                                         |
 * | a write of r[i]     | the same state           | where the processor stores an lqg_real in one access:   |
 * |                     |                          | a float on 32 bits. A new r counts from the next        |
 * |                     |                          | observe or control on. Else, and for several r that     |
 * |                     |                          | belong together: mask the interrupt, or write r between |
 * |                     |                          | samples                                                 |
 * | a read of x, u or P | the same state, never    | as above: copy them after the sample, in its task       |
 *
 * Status, and what firmware does about it:
 *
 * | bit                         | in a single sample       | in every sample for long                               |
 * | --------------------------- | ------------------------ | ------------------------------------------------------ |
 * | LQG_OUTPUT_REJECTED         | nothing: x̂ is predicted | sensor or wire failed: LQG_OUTPUT_REJECTED_BIT(i) says |
 * |                             |                          | which; go to a state that is safe without it           |
 * | LQG_OUTPUT_GATED            | nothing                  | sensor, model or noise figures are wrong               |
 * | LQG_INNOVATION_NOT_POSITIVE | nothing: P is reset      | P0, W or V are wrong, or memory is                     |
 * | LQG_INPUT_LIMITED           | nothing                  | demand too large, actuator too weak, or u not finite   |
 * | LQG_NOT_OPTIMAL             | nothing: u is clipped    | more `iterations`; limits contradict each other        |
 * | LQG_STATE_RESET             | count it: the estimate   | u passed to predict is not what was applied, model     |
 * |                             | begins at x0             | wrong, or memory failed: go to the safe state          |
 * | LQG_REFERENCE_NOT_FINITE    | nothing: r counts as 0   | correct who writes r                                   |
 * | LQG_COVARIANCE_RESET        | count it                 | as LQG_STATE_RESET                                     |
 *
 * A watchdog, fed only while the loop works: a bad sample counts up by 4, a good one down by 1, so that it also notices
 * faults that come and go.
 *
 *     const lqg_status_t grave = LQG_OUTPUT_REJECTED | LQG_STATE_RESET | LQG_COVARIANCE_RESET;
 *     const lqg_status_t status = lqg_loop_ud_step(&loop, &state, y);
 *
 *     if ((status & grave) != LQG_OK)
 *         bad += 4;
 *     else if (bad > 0)
 *         bad -= 1;
 *     if (bad < LIMIT)                              LIMIT/4 bad samples in a row
 *         feed_watchdog();
 *     else
 *         go_to_safe_state();
 *
 * Options, to be defined for the whole program (-D…), library and firmware alike:
 *
 *   LQG_REAL_DOUBLE, LQG_FUSED   see lqg/arithmetic.h; where library and firmware differ, the program does not link.
 *   LQG_ASSERT(condition)        called by the library with what its callers MUST do: no NULL matrix, dimensions ≥ 1,
 *                                i < ny … Empty unless defined. For development:
 *                                -include assert.h -D'LQG_ASSERT(c)=assert(c)'
 */
#ifndef LQG_LQG_H
#define LQG_LQG_H

#include "lqg/arithmetic.h"
#include "lqg/ekf.h"
#include "lqg/functions.h"
#include "lqg/kalman.h"
#include "lqg/loop.h"
#include "lqg/lqr.h"
#include "lqg/mpc.h"
#include "lqg/rls.h"
#include "lqg/servo.h"
#include "lqg/status.h"
#include "lqg/version.h"

#endif
