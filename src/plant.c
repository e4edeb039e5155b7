#include "plant.h"

#include <math.h>

#include "kernel.h"

LQG_STRICT_BEGIN

void lqg_plant_begin(const lqg_plant_t *plant, const lqg_real x0[], lqg_real x[], lqg_real u_applied[],
                     lqg_real innovation[])
{
    begin(x, x0, plant->nx);
    begin(u_applied, NULL, plant->nu);
    begin(innovation, NULL, plant->ny);
}

lqg_real lqg_plant_innovation(const lqg_plant_t *plant, unsigned i, const lqg_real x[],
                              const lqg_real u_applied[], lqg_real y_i)
{
    const lqg_real without_x = subtract_row_product(y_i, plant->C, i, plant->nx, x);
    return plant->D ? subtract_row_product(without_x, plant->D, i, plant->nu, u_applied) : without_x;
}

const lqg_real *lqg_plant_decorrelate(const lqg_plant_t *plant, const lqg_real E[], const lqg_real y[],
                                      const lqg_watch_t *watch, lqg_real work[])
{
    const unsigned ny = plant->ny;
    if (!E)
        return y;

    for (unsigned i = 0; i < ny; i++) {
        work[i] = y[i];
        for (unsigned j = 0; j < i; j++)
            if (E[i * ny + j] != 0)
                work[i] =
                    multiply_add(E[i * ny + j], lqg_watch_uses(watch, j) ? y[j] : (lqg_real)NAN, work[i]);
    }
    return work;
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

void lqg_plant_predict(const lqg_plant_t *plant, const lqg_real M[], lqg_real x[], lqg_real u_applied[],
                       lqg_real innovation[], const lqg_real u[], lqg_real work[])
{
    const unsigned nx = plant->nx, nu = plant->nu, ny = plant->ny;

    for (unsigned i = 0; i < nx; i++) {
        lqg_real next = add_row_product(0, plant->A, i, nx, x);
        next = add_row_product(next, plant->B, i, nu, u);
        work[i] = M ? add_row_product(next, M, i, ny, innovation) : next;
    }
    copy(x, work, nx);
    if (u_applied)
        copy(u_applied, u, nu);
    begin(innovation, NULL, ny);
}

int lqg_watch_uses(const lqg_watch_t *watch, unsigned i)
{
    return !watch || !watch->used || watch->used[i];
}

/* w of output i, times the factor of this sample, within its bounds whatever it was. */
static void move_gate(const lqg_watch_t *watch, unsigned i, lqg_real factor)
{
    LQG_STRICT_BODY
    const lqg_real widest = (lqg_real)1208925819614629174706176.0f; /* 2⁸⁰ */
    const lqg_real next = factor * watch->widening[i], least = 1 < next ? next : 1;

    watch->widening[i] = least < widest ? least : widest;
}

lqg_status lqg_watch_output(const lqg_watch_t *watch, unsigned i, int believable, lqg_real innovation, lqg_real s,
                            int opens)
{
    LQG_STRICT_BODY
    if (!watch)
        return LQG_OK;

    /* |ν| > gate √(s w) */
    const lqg_real w = watch->widening ? watch->widening[i] : 1;
    const int gated = believable && watch->gate > 0 && innovation * innovation > watch->gate * watch->gate * s * w;
    if (watch->nu)
        watch->nu[i] = innovation;
    if (watch->s)
        watch->s[i] = s;
    if (watch->gated)
        watch->gated[i] += gated ? 1 : 0;
    if (watch->widening)
        move_gate(watch, i, believable && !gated ? watch->narrow[i] : gated || opens ? watch->widen[i] : 1);
    return gated ? LQG_OUTPUT_GATED : LQG_OK;
}

void lqg_watch_silence(const lqg_watch_t *watch, unsigned i)
{
    if (watch->widening)
        move_gate(watch, i, watch->widen[i]);
}

LQG_STRICT_END
