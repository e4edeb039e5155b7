/* SPDX-License-Identifier: MIT */
#include "covariance.h"

LQG_STRICT_BEGIN

/* A c with fewer entries than one of these many that are not zero is looked at entry by entry. */
enum { SPARSE = 3 };

/* to[k stride] ← P_k,column for all k: along a row of the triangle as far as the diagonal, then down the column. */
static void gather_column(const lqg_real P[], unsigned nx, unsigned column, lqg_real to[], unsigned stride)
{
    const lqg_real *from = P + LQG_TRIANGLE(column);

    for (unsigned k = 0; k < column; k++) {
        *to = *from++;
        to += stride;
    }
    for (unsigned k = column; k < nx; k++) {
        *to = *from;
        from += k + 1;
        to += stride;
    }
}

/* ------------------------------------------------------------------------------------------------- f = P cᵀ */

/* One c_k after the other: row k, then column k, for those that are not zero. */
static void add_columns(const lqg_real P[], unsigned nx, const lqg_real c[], lqg_real f[])
{
    LQG_STRICT_BODY
    for (unsigned k = 0; k < nx; k++) {
        const lqg_real c_k = c[k];
        const lqg_real *from = P + LQG_TRIANGLE(k);

        if (c_k == 0)
            continue;
        for (unsigned j = 0; j < k; j++)
            f[j] = multiply_add(from[j], c_k, f[j]);
        from += k;
        for (unsigned j = k; j < nx; j++) {
            f[j] = multiply_add(*from, c_k, f[j]);
            from += j + 1;
        }
    }
}

/* Two rows of the triangle at a time, the first of an odd number alone: P_jk is part of f_j, and of f_k. */
static void add_rows(const lqg_real P[], unsigned nx, const lqg_real c[], lqg_real f[])
{
    LQG_STRICT_BODY
    if (nx % 2 == 1)
        f[0] = multiply_add(P[0], c[0], f[0]);
    for (unsigned j = nx % 2; j < nx; j += 2) {
        const lqg_real *row = P + LQG_TRIANGLE(j), *next_row = row + j + 1;
        const lqg_real c_j = c[j], next_c = c[j + 1];
        lqg_real sum = 0, next_sum = 0;

        for (unsigned k = 0; k < j; k++) {
            const lqg_real P_jk = row[k], next_P = next_row[k], c_k = c[k];
            sum = multiply_add(P_jk, c_k, sum);
            next_sum = multiply_add(next_P, c_k, next_sum);
            f[k] = multiply_add(next_P, next_c, multiply_add(P_jk, c_j, f[k]));
        }
        next_sum = multiply_add(next_row[j], c_j, next_sum);
        f[j] = multiply_add(next_row[j], next_c, multiply_add(row[j], c_j, sum));
        f[j + 1] = multiply_add(next_row[j + 1], next_c, next_sum);
    }
}

void lqg_covariance_project(const lqg_real P[], unsigned nx, const lqg_real c[], lqg_real f[])
{
    unsigned entries = 0;

    for (unsigned k = 0; k < nx; k++) {
        entries += c[k] != 0 ? 1u : 0u;
        f[k] = 0;
    }
    if (entries * SPARSE < nx)
        add_columns(P, nx, c, f);
    else
        add_rows(P, nx, c, f);
}

/* Two rows of the triangle at a time, the first of an odd number alone. */
void lqg_covariance_correct(lqg_real P[], lqg_real x[], unsigned nx, const lqg_real f[], lqg_real inverse,
                            lqg_real innovation)
{
    LQG_STRICT_BODY
    if (nx % 2 == 1) {
        const lqg_real gain = f[0] * inverse;

        x[0] = multiply_add(gain, innovation, x[0]);
        P[0] = multiply_subtract(gain, f[0], P[0]);
    }
    for (unsigned j = nx % 2; j < nx; j += 2) {
        lqg_real *row = P + LQG_TRIANGLE(j), *next_row = row + j + 1;
        const lqg_real gain = f[j] * inverse, next_gain = f[j + 1] * inverse;

        x[j] = multiply_add(gain, innovation, x[j]);
        x[j + 1] = multiply_add(next_gain, innovation, x[j + 1]);
        for (unsigned l = 0; l <= j; l++) {
            const lqg_real f_l = f[l], P_jl = row[l], next_P = next_row[l];
            row[l] = multiply_subtract(gain, f_l, P_jl);
            next_row[l] = multiply_subtract(next_gain, f_l, next_P);
        }
        next_row[j + 1] = multiply_subtract(next_gain, f[j + 1], next_row[j + 1]);
    }
}

/* ------------------------------------------------------------------------- P ← A P Aᵀ + W, A with all entries */

/* Two rows of a matrix by two columns. */
typedef struct {
    lqg_real a1, a2, b1, b2;
} tile_t;

/* sum + [a; b] [v1 v2]: rows a and b of `length`; the columns' entries are `stride` apart. */
static inline tile_t add_tile(tile_t sum, const lqg_real a[], const lqg_real b[], const lqg_real v1[],
                              const lqg_real v2[], unsigned stride, unsigned length)
{
    LQG_STRICT_BODY
    for (const lqg_real *end = a + length; a != end;) {
        const lqg_real a_k = *a++, b_k = *b++;
        sum.a1 = multiply_add(*v1, a_k, sum.a1);
        sum.a2 = multiply_add(*v2, a_k, sum.a2);
        sum.b1 = multiply_add(*v1, b_k, sum.b1);
        sum.b2 = multiply_add(*v2, b_k, sum.b2);
        v1 += stride;
        v2 += stride;
    }
    return sum;
}

static inline unsigned smaller(unsigned a, unsigned b)
{
    return a < b ? a : b;
}

/* PA ← P Aᵀ, two rows at a time. The last of an odd number is computed twice. columns[2 nx] is scratch. */
static void multiply_dense(const lqg_real P[], unsigned nx, const lqg_real A[], lqg_real PA[], lqg_real columns[])
{
    const tile_t nothing = {0, 0, 0, 0};

    for (unsigned j = 0; j < nx; j += 2) {
        const unsigned next_j = smaller(j + 1, nx - 1);
        gather_column(P, nx, j, columns, 1);
        gather_column(P, nx, next_j, columns + nx, 1);
        for (unsigned i = 0; i < nx; i += 2) {
            const unsigned next_i = smaller(i + 1, nx - 1);
            const tile_t sum = add_tile(nothing, A + i * nx, A + next_i * nx, columns, columns + nx, 1, nx);
            PA[j * nx + i] = sum.a1;
            PA[j * nx + next_i] = sum.b1;
            PA[next_j * nx + i] = sum.a2;
            PA[next_j * nx + next_i] = sum.b2;
        }
    }
}

/* P ← A PA + W, of rows i and i + 1 the columns j and j + 1. On the diagonal P_i,i+1 is left out. */
static void add_dense(lqg_real P[], unsigned nx, const lqg_real A[], const lqg_real W[], const lqg_real PA[])
{
    for (unsigned i = 0; i < nx; i += 2) {
        const unsigned next_i = smaller(i + 1, nx - 1), row = LQG_TRIANGLE(i), next_row = LQG_TRIANGLE(next_i);
        for (unsigned j = 0; j <= i; j += 2) {
            const unsigned next_j = smaller(j + 1, next_i);
            tile_t sum = {W[row + j], W[next_row + j], W[row + next_j], W[next_row + next_j]};
            sum = add_tile(sum, A + j * nx, A + next_j * nx, PA + i, PA + next_i, nx, nx);
            P[row + j] = sum.a1;
            if (next_j <= i)
                P[row + next_j] = sum.b1;
            P[next_row + j] = sum.a2;
            P[next_row + next_j] = sum.b2;
        }
    }
}

/* ----------------------------------------------------------------- P ← A P Aᵀ + W, A with the entries of a pattern */

/* Four columns of a row. */
typedef struct {
    lqg_real at0, at1, at2, at3;
} four_t;

enum { FOUR = 4 };

/* sum + a [v0 v1 v2 v3], a row that has `entries` in `columns`; the rows of v are `stride` apart. */
static inline four_t add_sparse_row(four_t sum, const lqg_real a[], const unsigned char columns[], unsigned entries,
                                    const lqg_real v[], unsigned stride)
{
    LQG_STRICT_BODY
    for (const unsigned char *end = columns + entries; columns != end;) {
        const lqg_real a_k = *a++;
        const lqg_real *v_k = v + *columns++ * stride;
        sum.at0 = multiply_add(v_k[0], a_k, sum.at0);
        sum.at1 = multiply_add(v_k[1], a_k, sum.at1);
        sum.at2 = multiply_add(v_k[2], a_k, sum.at2);
        sum.at3 = multiply_add(v_k[3], a_k, sum.at3);
    }
    return sum;
}

/* PA ← P Aᵀ, four rows at a time; the last four may be computed twice. columns[4 nx] is scratch. */
static void multiply_sparse(const lqg_real P[], unsigned nx, const lqg_real A[], const unsigned char pattern[],
                            lqg_real PA[], lqg_real columns[])
{
    const four_t nothing = {0, 0, 0, 0};

    for (unsigned j = 0; j < nx; j += FOUR) {
        const unsigned first = smaller(j, nx - FOUR);
        const lqg_real *a = A;
        const unsigned char *at = pattern;
        lqg_real *to = PA + first * nx;

        for (unsigned r = 0; r < FOUR; r++)
            gather_column(P, nx, first + r, columns + r, FOUR);
        for (unsigned i = 0; i < nx; i++) {
            const unsigned entries = *at++;
            const four_t sum = add_sparse_row(nothing, a, at, entries, columns, FOUR);
            a += entries;
            at += entries;
            to[i] = sum.at0;
            to[nx + i] = sum.at1;
            to[2 * nx + i] = sum.at2;
            to[3 * nx + i] = sum.at3;
        }
    }
}

/* P ← A PA + W, four rows at a time: of column j those that are not above the diagonal. */
static void add_sparse(lqg_real P[], unsigned nx, const lqg_real A[], const unsigned char pattern[], const lqg_real W[],
                       const lqg_real PA[])
{
    for (unsigned i = 0; i < nx; i += FOUR) {
        const unsigned first = smaller(i, nx - FOUR), row0 = LQG_TRIANGLE(first), row1 = row0 + first + 1,
                       row2 = row1 + first + 2, row3 = row2 + first + 3;
        const lqg_real *a = A;
        const unsigned char *at = pattern;

        for (unsigned j = 0; j < first + FOUR; j++) {
            const unsigned entries = *at++;
            const four_t noise = {W[row0 + j], W[row1 + j], W[row2 + j], W[row3 + j]};
            const four_t sum = add_sparse_row(noise, a, at, entries, PA + first, nx);
            a += entries;
            at += entries;
            if (j <= first)
                P[row0 + j] = sum.at0;
            if (j <= first + 1)
                P[row1 + j] = sum.at1;
            if (j <= first + 2)
                P[row2 + j] = sum.at2;
            P[row3 + j] = sum.at3;
        }
    }
}

void lqg_covariance_predict(lqg_real P[], unsigned nx, const lqg_real A[], const unsigned char pattern[],
                            const lqg_real W[], lqg_real work[])
{
    lqg_real *columns = work + nx * nx;

    if (pattern) {
        multiply_sparse(P, nx, A, pattern, work, columns);
        add_sparse(P, nx, A, pattern, W, work);
    } else {
        multiply_dense(P, nx, A, work, columns);
        add_dense(P, nx, A, W, work);
    }
}

LQG_STRICT_END
