/* The Kalman filter with constant gain. */
#include "kernel.h"
#include "plant.h"

LQG_STRICT_BEGIN

void lqg_kalman_steady_init(const lqg_kalman_steady_t *kalman, lqg_real x[], lqg_real u_applied[],
                            lqg_real innovation[])
{
    lqg_plant_begin(&kalman->plant, kalman->x0, x, u_applied, innovation);
}

static lqg_status reset_unless_finite(const lqg_kalman_steady_t *kalman, lqg_real x[], lqg_real u_applied[],
                                      lqg_real innovation[])
{
    LQG_STRICT_BODY
    if (is_finite(add_all(0, x, kalman->plant.nx)))
        return LQG_OK;

    lqg_kalman_steady_init(kalman, x, u_applied, innovation);
    return LQG_STATE_RESET;
}

/* innovation = y − C x̂ − D u, 0 where that is not finite: such an output counts as one that came as expected
 * */
static lqg_status innovate(const lqg_plant_t *plant, const lqg_real x[], const lqg_real u_applied[],
                           const lqg_real y[], lqg_real innovation[])
{
    lqg_status status = LQG_OK;

    for (unsigned i = 0; i < plant->ny; i++) {
        const lqg_real nu = lqg_plant_innovation(plant, i, x, u_applied, y[i]);
        const int usable = is_finite(nu);
        status |= usable ? LQG_OK : LQG_OUTPUT_NOT_FINITE;
        innovation[i] = usable ? nu : 0;
    }
    return status;
}

lqg_status lqg_kalman_steady_update(const lqg_kalman_steady_t *kalman, lqg_real x[], lqg_real u_applied[],
                                    lqg_real innovation[], const lqg_real y[], lqg_real work[])
{
    const lqg_plant_t *plant = &kalman->plant;
    lqg_real *nu = kalman->M ? innovation : work; /* predict needs them only for M */

    const lqg_status status = innovate(plant, x, u_applied, y, nu);

    /* x̂ ← x̂ + L innovation */
    for (unsigned j = 0; j < plant->nx; j++)
        x[j] = add_row_product(x[j], kalman->L, j, plant->ny, nu);

    return status | reset_unless_finite(kalman, x, u_applied, innovation);
}

lqg_status lqg_kalman_steady_predict(const lqg_kalman_steady_t *kalman, lqg_real x[], lqg_real u_applied[],
                                     lqg_real innovation[], const lqg_real u[], lqg_real work[])
{
    lqg_plant_predict(&kalman->plant, kalman->M, x, u_applied, innovation, u, work);
    return reset_unless_finite(kalman, x, u_applied, innovation);
}

LQG_STRICT_END
