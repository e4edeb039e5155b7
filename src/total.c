#include "total.h"

LQG_STRICT_BEGIN

void lqg_total_add(total_t *total, const lqg_real x[], const lqg_real scale[], unsigned length)
{
    LQG_STRICT_BODY
    for (unsigned i = 0; i < length; i++) {
        if (scale) {
            const lqg_real part = x[i] * scale[i];
            total->bounded = multiply_add(part, part, total->bounded);
        } else {
            total->others += x[i];
        }
    }
}

void lqg_total_add_variance(total_t *total, lqg_real variance, const lqg_real scale[], unsigned i)
{
    LQG_STRICT_BODY
    if (scale)
        total->bounded += absolute(variance) * scale[i] * scale[i];
    else
        total->others += variance;
}

LQG_STRICT_END
