/* SPDX-License-Identifier: MIT */
/* A firmware's main, with the plant in place of the hardware: the mass starts at rest, 10 mm away, and has to
 * be at 0 after 2 s. */
#include <math.h>

#include "double_integrator.h"

int main(void)
{
    const real T = DOUBLE_INTEGRATOR_SAMPLE_TIME;
    double_integrator_t loop;
    double_integrator_init(&loop);

    real position = (real)0.01, speed = 0;
    lqg_status_t status = LQG_OK;
    for (int k = 0; k < 200; ++k) {
        real y[DOUBLE_INTEGRATOR_NY], u[DOUBLE_INTEGRATOR_NU];
        y[0] = position;
        status |= double_integrator_step(&loop, y, u);
        position += T * speed + T * T / 2 * u[0];
        speed += T * u[0];
    }

    const int is_well = (status & ~(lqg_status_t)LQG_INPUT_LIMITED) == LQG_OK;
    return is_well && fabs((double)position) < 1e-5 ? 0 : 1;
}
