/* SPDX-License-Identifier: MIT */
#include "factors.h"

LQG_STRICT_BEGIN

/* v_j + Σ_{k<j} v_k U_kj, which is (v U)_j of a row v. */
static lqg_real row_times_U(const lqg_real v[], const lqg_real U[], unsigned j)
{
    lqg_real sum = v[j];
    for (unsigned k = 0; k < j; k++)
        sum = multiply_add(v[k], U[LQG_STRICT_TRIANGLE(j) + k], sum);
    return sum;
}

void lqg_factors_project(const lqg_real U[], unsigned nx, const lqg_real c[], int usable, lqg_real f[])
{
    for (unsigned j = 0; j < nx; j++) {
        const lqg_real f_j = row_times_U(c, U, j);
        f[j] = usable ? f_j : 0;
    }
}

lqg_real lqg_factors_variance(const lqg_real d[], unsigned nx, const lqg_real f[], lqg_real V)
{
    LQG_STRICT_BODY
    lqg_real s = V;
    for (unsigned j = 0; j < nx; j++) {
        const lqg_real g_j = d[j] * f[j];
        s = multiply_add(f[j], g_j, s);
    }
    return s;
}

/* Column by column
 *
 *     g_j = d_j f_j,  α_j = α_{j−1} + f_j g_j,  d_j ← d_j α_{j−1}/α_j,  U_j ← U_j − (f_j/α_{j−1}) b,  b ← b +
 *     g_j U_j
 *
 * from α = V and b = 0. 1/α is carried along: one division a column. */
lqg_real lqg_factors_update(lqg_real U[], lqg_real d[], unsigned nx, lqg_real f[], lqg_real V)
{
    LQG_STRICT_BODY
    lqg_real *b = f; /* b_k takes the place of f_k, which column k was the last to need */
    lqg_real alpha = V, inverse = 1 / V;

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

/* T_i = A_i U of a row that has `entries` in `columns`. */
static void add_sparse_row(const lqg_real U[], unsigned nx, const lqg_real a[], const unsigned char columns[],
                           unsigned entries, lqg_real T_i[])
{
    LQG_STRICT_BODY
    lqg_begin(T_i, NULL, nx);
    for (unsigned n = 0; n < entries; n++)
        T_i[columns[n]] = a[n];
    for (unsigned n = 0; n < entries; n++) {
        const unsigned k = columns[n];
        for (unsigned j = k + 1; j < nx; j++)
            T_i[j] = multiply_add(a[n], U[LQG_STRICT_TRIANGLE(j) + k], T_i[j]);
    }
}

/* T = [A U | G], nx × (nx + nw): with the weights [d | W] of its columns, A P Aᵀ + G diag(W) Gᵀ = T
 * diag(weight) Tᵀ. */
static void stack_factors(const lqg_real U[], unsigned nx, const lqg_real A[], const unsigned char pattern[],
                          unsigned nw, const lqg_real G[], lqg_real T[])
{
    for (unsigned i = 0; i < nx; i++) {
        if (pattern) {
            add_sparse_row(U, nx, A, pattern + 1, *pattern, T);
            A += *pattern;
            pattern += 1 + *pattern;
        } else {
            for (unsigned j = 0; j < nx; j++)
                T[j] = row_times_U(A, U, j);
            A += nx;
        }
        T += nx;
        for (unsigned q = 0; q < nw; q++)
            *T++ = G[i * nw + q];
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

void lqg_factors_predict(lqg_real U[], lqg_real d[], unsigned nx, const lqg_real A[], const unsigned char pattern[],
                         unsigned nw, const lqg_real G[], const lqg_real W[], lqg_real work[])
{
    const unsigned columns = nx + nw;
    lqg_real *weight = work, *v = work + columns, *T = work + 2 * columns;

    stack_factors(U, nx, A, pattern, nw, G, T);
    copy(weight, d, nx);
    copy(weight + nx, W, nw);
    orthogonalise(U, d, nx, columns, T, weight, v);
}

LQG_STRICT_END
