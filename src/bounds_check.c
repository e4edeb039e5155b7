/* SPDX-License-Identifier: MIT */
#include "bounds_check.h"

LQG_STRICT_BEGIN

void lqg_bounds_check_add(bounds_check_t *check, const lqg_real x[], const lqg_real scale[], unsigned length)
{
    LQG_STRICT_BODY
    if (!scale) {
        add_finite(check, x, length);
        return;
    }
    lqg_real sum = check->bounded;
    for (unsigned i = 0; i < length; i++) {
        const lqg_real part = x[i] * scale[i];
        sum = multiply_add(part, part, sum);
    }
    check->bounded = sum;
}

LQG_STRICT_END
