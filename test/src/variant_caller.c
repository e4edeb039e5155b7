/* SPDX-License-Identifier: MIT */
/* A program that uses one function of the library. */
#include "lqg/lqg.h"

int main(void)
{
    const lqg_real K[1] = {2}, x[1] = {3};
    const lqg_lqr_t lqr = {1, 1, K, 0, 0};
    lqg_real u[1];
    return lqg_lqr_control(&lqr, x, u) == LQG_OK && u[0] == -6 ? 0 : 1;
}
