/* The Kalman filter that carries its covariance as P = U diag(d) Uᵀ, U unit upper triangular. */
#include "kernel.h"
#include "plant.h"

LQG_STRICT_BEGIN

void lqg_kalman_ud_init(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[], lqg_real d[],
                        lqg_real u_applied[], lqg_real innovation[])
{
    const unsigned nx = kalman->plant.nx;

    lqg_plant_begin(&kalman->plant, kalman->x0, x, u_applied, innovation);
    copy(U, kalman->U0, LQG_STRICT_TRIANGLE(nx));
    copy(d, kalman->d0, nx);
}

static lqg_status reset_unless_finite(const lqg_kalman_ud_t *kalman, lqg_real sum, lqg_real x[], lqg_real U[],
                                      lqg_real d[], lqg_real u_applied[], lqg_real innovation[])
{
    if (is_finite(sum))
        return LQG_OK;

    lqg_kalman_ud_init(kalman, x, U, d, u_applied, innovation);
    return LQG_STATE_RESET;
}

/* v_j + Σ_{k<j} v_k U_kj, which is (v U)_j of a row v. */
static lqg_real row_times_U(const lqg_real v[], const lqg_real U[], unsigned j)
{
    lqg_real sum = v[j];
    for (unsigned k = 0; k < j; k++)
        sum = multiply_add(v[k], U[LQG_STRICT_TRIANGLE(j) + k], sum);
    return sum;
}

/* Bierman's update of U and d by an output with f = Uᵀ cᵀ and noise variance v. Column by column
 *
 *     g_j = d_j f_j,  α_j = α_{j−1} + f_j g_j,  d_j ← d_j α_{j−1}/α_j,  U_j ← U_j − (f_j/α_{j−1}) b,  b ← b +
 *     g_j U_j
 *
 * from α = v and b = 0. 1/α is carried along: one division a column, and f = 0 leaves all as it is, to the
 * bit. Returns 1/α, α = s at the end; f becomes b = P cᵀ of the prior P: the gain is b/s. */
static lqg_real update_factors(lqg_real U[], lqg_real d[], unsigned nx, lqg_real f[], lqg_real v)
{
    LQG_STRICT_BODY
    lqg_real *b = f; /* b_k takes the place of f_k, which column k was the last to need */
    lqg_real alpha = v, inverse = 1 / v;

    for (unsigned j = 0; j < nx; j++) {
        const lqg_real f_j = f[j], g_j = d[j] * f_j;
        const lqg_real next = multiply_add(f_j, g_j, alpha);
        const lqg_real ratio = alpha / next;
        const lqg_real lambda = f_j * inverse;

        d[j] = d[j] * ratio;
        for (unsigned k = 0; k < j; k++) {
            lqg_real *U_kj = &U[LQG_STRICT_TRIANGLE(j) + k];
            const lqg_real old = *U_kj;
            *U_kj = multiply_subtract(lambda, b[k], old);
            b[k] = multiply_add(g_j, old, b[k]);
        }
        b[j] = g_j;
        inverse = inverse * ratio;
        alpha = next;
    }
    return inverse;
}

/* Takes output i, y_i, into x̂, U and d, or leaves it out and says why. f[nx] is scratch. */
static lqg_status update_output(const lqg_kalman_ud_t *kalman, unsigned i, lqg_real x[], lqg_real U[],
                                lqg_real d[], const lqg_real u_applied[], lqg_real y_i, lqg_real f[])
{
    LQG_STRICT_BODY
    const unsigned nx = kalman->plant.nx;
    const lqg_real *c = kalman->plant.C + i * nx;

    const lqg_real innovation = lqg_plant_innovation(&kalman->plant, i, x, u_applied, y_i);
    const int usable = is_finite(innovation);
    const lqg_real nu = usable ? innovation : 0;

    /* f = Uᵀ cᵀ; with f = 0 the output is left out */
    for (unsigned j = 0; j < nx; j++) {
        const lqg_real f_j = row_times_U(c, U, j);
        f[j] = usable ? f_j : 0;
    }
    const lqg_real inverse = update_factors(U, d, nx, f, kalman->V[i]);

    /* gain = b / s,  x̂ ← x̂ + gain ν */
    for (unsigned j = 0; j < nx; j++)
        x[j] = multiply_add(f[j] * inverse, nu, x[j]);
    return usable ? LQG_OK : LQG_OUTPUT_NOT_FINITE;
}

lqg_status lqg_kalman_ud_update(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[], lqg_real d[],
                                lqg_real u_applied[], lqg_real innovation[], const lqg_real y[],
                                lqg_real work[])
{
    const lqg_plant_t *plant = &kalman->plant;
    const lqg_real *outputs = lqg_plant_decorrelate(plant, kalman->E, y, work + plant->nx);
    lqg_status status = LQG_OK;

    for (unsigned i = 0; i < plant->ny; i++) {
        const lqg_status left_out = update_output(kalman, i, x, U, d, u_applied, outputs[i], work);
        status |= left_out;
        if (kalman->M)
            innovation[i] = left_out ? 0 : 1;
    }
    if (kalman->M)
        lqg_plant_keep_residuals(plant, x, u_applied, outputs, innovation);

    return status | reset_unless_finite(kalman, add_all(0, x, plant->nx), x, U, d, u_applied, innovation);
}

/* T = [A U | G], nx × (nx + nq): with the weights [d | w] of its columns, A P Aᵀ + G diag(w) Gᵀ = T
 * diag(weight) Tᵀ. */
static void stack_factors(const lqg_kalman_ud_t *kalman, const lqg_real U[], lqg_real T[])
{
    const unsigned nx = kalman->plant.nx, nq = kalman->nq;
    const lqg_real *A = kalman->M ? kalman->A_free : kalman->plant.A;

    for (unsigned i = 0; i < nx; i++) {
        for (unsigned j = 0; j < nx; j++)
            *T++ = row_times_U(A + i * nx, U, j);
        for (unsigned q = 0; q < nq; q++)
            *T++ = kalman->G[i * nq + q];
    }
}

/* Thornton's modified weighted Gram–Schmidt: U and d with T diag(weight) Tᵀ = U diag(d) Uᵀ. From the last row
 * of T up,
 *
 *     v = weight t_i,  d_i = t_i·v,  U_ji = t_j·v / d_i,  t_j ← t_j − U_ji t_i  for the rows j < i
 *
 * A d_i so small that 1/d_i overflows is nothing to be taken out of other rows: U_ji = 0. T[rows × columns]
 * is destroyed; v[columns] is scratch. */
static void orthogonalise(lqg_real U[], lqg_real d[], unsigned rows, unsigned columns, lqg_real T[],
                          const lqg_real weight[], lqg_real v[])
{
    LQG_STRICT_BODY
    for (unsigned i = rows; i-- > 0;) {
        const lqg_real *t_i = T + i * columns;
        for (unsigned k = 0; k < columns; k++)
            v[k] = weight[k] * t_i[k];
        d[i] = add_row_product(0, T, i, columns, v);

        const lqg_real reciprocal = 1 / d[i];
        const lqg_real inverse = is_finite(reciprocal) ? reciprocal : 0;
        for (unsigned j = 0; j < i; j++) {
            const lqg_real U_ji = add_row_product(0, T, j, columns, v) * inverse;
            U[LQG_STRICT_TRIANGLE(i) + j] = U_ji;
            for (unsigned k = 0; k < columns; k++)
                T[j * columns + k] = multiply_subtract(U_ji, t_i[k], T[j * columns + k]);
        }
    }
}

lqg_status lqg_kalman_ud_predict(const lqg_kalman_ud_t *kalman, lqg_real x[], lqg_real U[], lqg_real d[],
                                 lqg_real u_applied[], lqg_real innovation[], const lqg_real u[],
                                 lqg_real work[])
{
    const unsigned nx = kalman->plant.nx, columns = nx + kalman->nq;
    lqg_real *weight = work, *v = work + columns, *T = work + 2 * columns;

    lqg_plant_predict(&kalman->plant, kalman->M, x, u_applied, innovation, u, work);

    /* U diag(d) Uᵀ ← A U diag(d) Uᵀ Aᵀ + G diag(w) Gᵀ */
    stack_factors(kalman, U, T);
    copy(weight, d, nx);
    copy(weight + nx, kalman->w, kalman->nq);
    orthogonalise(U, d, nx, columns, T, weight, v);

    lqg_real sum = add_all(0, x, nx);
    for (unsigned i = nx; i-- > 1;)
        sum = add_all(sum + d[i], U + LQG_STRICT_TRIANGLE(i), i);
    sum += d[0]; /* its column of U is empty, and U may be NULL */
    return reset_unless_finite(kalman, sum, x, U, d, u_applied, innovation);
}

LQG_STRICT_END
