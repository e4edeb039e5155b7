/* SPDX-License-Identifier: MIT */
/* The control law. */
#include "lqg/lqr.h"

#include "kernel.h"

LQG_STRICT_BEGIN

lqg_status_t lqg_lqr_control(const lqg_lqr_t *lqr, const lqg_real x[], lqg_real u[])
{
    LQG_ASSERT(lqr && lqr->nx >= 1 && lqr->nu >= 1 && lqr->K && x && u);
    lqg_status_t status = LQG_OK;

    for (unsigned i = 0; i < lqr->nu; i++) {
        const lqg_real law = subtract_row_product(0, lqr->K, i, lqr->nx, x);
        lqg_real limited = is_finite(law) ? law : 0;
        if (lqr->u_min)
            limited = limited < lqr->u_min[i] ? lqr->u_min[i] : limited;
        if (lqr->u_max)
            limited = limited > lqr->u_max[i] ? lqr->u_max[i] : limited;
        status |= limited == law ? LQG_OK : LQG_INPUT_LIMITED;
        u[i] = limited;
    }
    return status;
}

LQG_STRICT_END
