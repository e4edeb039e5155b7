/* SPDX-License-Identifier: MIT */
/* TinyLQG @VERSION@ in one file: Kalman filter and LQR for microcontrollers, and the two together.
 *
 *     #include "tinylqg.h"              wherever it is needed
 *
 *     #define LQG_IMPLEMENTATION        and in one C or C++ file, first
 *     #include "tinylqg.h"
 *
 * This file is put together from the folders include/ and src/ of TinyLQG: change those, not this. A controller that
 * lqgen made includes "lqg/lqg.h" and others: the folder lqg beside this file has them, each one line that leads here.
 * Options, the same wherever this file is included: LQG_REAL_DOUBLE, LQG_FUSED; see below.
 *
 * MIT licence: at the end of this file.
 */
