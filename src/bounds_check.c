#include "bounds_check.h"

LQG_STRICT_BEGIN

void lqg_bounds_check_add(bounds_check_t *check, const lqg_real x[], const lqg_real scale[], unsigned length)
{
    LQG_STRICT_BODY
    for (unsigned i = 0; i < length; i++) {
        if (scale) {
            const lqg_real part = x[i] * scale[i];
            check->bounded = multiply_add(part, part, check->bounded);
        } else {
            check->others += x[i];
        }
    }
}

void lqg_bounds_check_add_variance(bounds_check_t *check, lqg_real variance, const lqg_real scale[], unsigned i)
{
    LQG_STRICT_BODY
    if (scale)
        check->bounded += absolute(variance) * scale[i] * scale[i];
    else
        check->others += variance;
}

LQG_STRICT_END
