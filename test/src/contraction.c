/* SPDX-License-Identifier: MIT */
/* Prints a hash of every bit of 1000 samples of all filters and of the elementary functions, and whether the compiler
 * contracts a*b + c where nobody tells it not to. The same text is built with contraction and without it: the first
 * line must be the same, the second must not. Nothing but the library computes here with more than one rounding. */
#include <stdio.h>

#include "bits.h"
#include "contracted.h"
#include "hash.h"
#include "lqg/lqg.h"

/* A sum and a difference side by side, which GCC 12's vectorizer fuses in spite of -ffp-contract=off. */
LQG_STRICT_BEGIN
void sum_and_difference(lqg_real out[2], const lqg_real a[2], const lqg_real b[2], const lqg_real c[2]);
void sum_and_difference(lqg_real out[2], const lqg_real a[2], const lqg_real b[2], const lqg_real c[2])
{
    LQG_STRICT_BODY
    const lqg_real sum = a[0] * b[0] + c[0];
    const lqg_real difference = a[1] * b[1] - c[1];
    out[0] = sum;
    out[1] = difference;
}
LQG_STRICT_END

static unsigned long long hash_of_a_pair(unsigned long long hash)
{
    const double e = sizeof(lqg_real) == sizeof(float) ? 0x1p-20 : 0x1p-50;
    const lqg_real a[2] = {(lqg_real)(1 + e), (lqg_real)(1 + e)}, b[2] = {(lqg_real)(1 - e), (lqg_real)(1 - e)};
    const lqg_real c[2] = {-1, 1};
    lqg_real out[2];
    void (*volatile compute)(lqg_real *, const lqg_real *, const lqg_real *, const lqg_real *) = sum_and_difference;

    compute(out, a, b, c);
    return hash_bytes(hash, out, sizeof out);
}

int main(void)
{
    const unsigned long long filters = hash_of_all_filters();
    const unsigned long long functions = hash_of_all_functions() ^ hash_of_all_double_functions();

    printf("%016llx\n", hash_of_a_pair(filters ^ functions));
    printf("%s\n", is_contracted() ? "contracted" : "plain");
    return 0;
}
