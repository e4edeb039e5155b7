/* SPDX-License-Identifier: MIT */
/* TinyLQG: the elementary functions, without libm, with the same bits on every target. Method, errors and instructions:
 * src/README.md.
 *
 * | float                         | double                      | argument              | elsewhere               |
 * | ----------------------------- | --------------------------- | --------------------- | ----------------------- |
 * | lqg_sinf, lqg_cosf, lqg_tanf  | lqg_sin, lqg_cos, lqg_tan   | |x| ≤ LQG_ANGLE_MAX…  | NaN                     |
 * | lqg_sin_cosf(x, &sin, &cos)   | lqg_sin_cos                 | |x| ≤ LQG_ANGLE_MAX…  | NaN, both               |
 * | lqg_wrapf                     | lqg_wrap                    | |x| ≤ LQG_ANGLE_MAX…  | NaN                     |
 * | lqg_asinf, lqg_acosf          | lqg_asin, lqg_acos          | |x| ≤ 1               | NaN                     |
 * | lqg_atanf, lqg_atan2f(y, x)   | lqg_atan, lqg_atan2         | any, ±∞ too           |                         |
 * | lqg_sqrtf                     | lqg_sqrt                    | x ≥ 0                 | NaN; −0 for −0          |
 * | lqg_expf                      | lqg_exp                     | any, ±∞ too           | above the range +∞      |
 * | lqg_logf                      | lqg_log                     | x > 0                 | −∞ for ±0, NaN for less |
 * | lqg_tanhf                     | lqg_tanh                    | any, ±∞ too           |                         |
 *
 * Angles are in radians. `wrap` is the angle of −π < angle < π that differs by whole turns, for the innovation of an
 * angle; no float or double is π. Signs and infinities are those of C99's Annex F: atan2(±0, −0) = ±π, and so on.
 *
 * Errors are below 2 units in the last place of the result, near zeros of the function, too; sqrt is rounded correctly.
 * Results below the smallest normal number are rounded to the numbers that there are.
 * sin, tan, asin, atan, tanh and wrap are exactly odd, cos exactly even. |sin| ≤ 1, |cos| ≤ 1, |tanh| ≤ 1.
 *
 * NaN in, NaN out, and each NaN has the same bits. Any bits are allowed as arguments. No function has a status: a NaN
 * finds its way into the state of an emitted controller, whose check of its bounds begins anew.
 *
 * They are the same in plain and fused controllers (lqg/arithmetic.h): no multiply-add is fused. No table, no heap, no
 * globals; loops, in sqrt without an instruction for it, have a fixed number of turns.
 * Functions of double are there where double has 64 bits. */
#ifndef LQG_FUNCTIONS_H
#define LQG_FUNCTIONS_H

#include "lqg/functions_double.h"
#include "lqg/functions_float.h"

#endif
