/* SPDX-License-Identifier: MIT */
#include "plant.h"

#include <math.h>

#include "kernel.h"

LQG_STRICT_BEGIN

void lqg_plant_begin(const lqg_plant_t *plant, const lqg_real x0[], lqg_real x[], lqg_real u_applied[],
                     lqg_real innovation[])
{
    lqg_begin(x, x0, plant->nx);
    lqg_begin(u_applied, NULL, plant->nu);
    lqg_begin(innovation, NULL, plant->ny);
}

lqg_real lqg_plant_innovation(const lqg_plant_t *plant, unsigned i, const lqg_real x[], const lqg_real u_applied[],
                              lqg_real y_i)
{
    const lqg_real without_x = subtract_row_product(y_i, plant->C, i, plant->nx, x);
    return plant->D ? subtract_row_product(without_x, plant->D, i, plant->nu, u_applied) : without_x;
}

lqg_real lqg_plant_decorrelate(const lqg_plant_t *plant, const lqg_real E[], unsigned i, const lqg_real y[],
                               const lqg_real before[])
{
    lqg_real sum = y[i];

    for (unsigned j = 0; E && j < i; j++)
        if (E[i * plant->ny + j] != 0)
            sum = multiply_add(E[i * plant->ny + j], is_finite(before[j]) ? y[j] : (lqg_real)NAN, sum);
    return sum;
}

lqg_real lqg_plant_decorrelate_alone(const lqg_plant_t *plant, const lqg_real E[], unsigned i, lqg_real y_i)
{
    int alone = 1;

    for (unsigned j = 0; E && j < i; j++)
        alone &= E[i * plant->ny + j] == 0;
    return alone ? y_i : (lqg_real)NAN;
}

void lqg_plant_keep_residuals(const lqg_plant_t *plant, const lqg_real x[], const lqg_real u_applied[],
                              const lqg_real y[], lqg_real innovation[])
{
    for (unsigned i = 0; i < plant->ny; i++) {
        const lqg_real residual = lqg_plant_innovation(plant, i, x, u_applied, y[i]);
        innovation[i] = innovation[i] != 0 ? residual : 0;
    }
}

/* Σ_j A_ij x_j of a row of which `pattern` says where it is not zero. */
static lqg_real add_sparse_product(const lqg_real A[], const unsigned char pattern[], const lqg_real x[])
{
    LQG_STRICT_BODY
    const unsigned char *end = next_row(pattern);
    lqg_real sum = 0;

    for (const unsigned char *column = pattern + 1; column != end; column++)
        sum = multiply_add(*A++, x[*column], sum);
    return sum;
}

void lqg_plant_predict(const lqg_plant_t *plant, const lqg_real M[], lqg_real x[], lqg_real u_applied[],
                       lqg_real innovation[], const lqg_real u[], lqg_real work[])
{
    const unsigned nx = plant->nx, nu = plant->nu, ny = plant->ny;
    const lqg_real *A = plant->A;
    const unsigned char *pattern = plant->pattern;

    for (unsigned i = 0; i < nx; i++) {
        lqg_real next = pattern ? add_sparse_product(A, pattern, x) : add_row_product(0, A, 0, nx, x);
        A += pattern ? *pattern : nx;
        pattern = pattern ? next_row(pattern) : NULL;
        next = add_row_product(next, plant->B, i, nu, u);
        work[i] = M ? add_row_product(next, M, i, ny, innovation) : next;
    }
    copy(x, work, nx);
    if (u_applied)
        copy(u_applied, u, nu);
    if (innovation)
        lqg_begin(innovation, NULL, ny);
}

LQG_STRICT_END
