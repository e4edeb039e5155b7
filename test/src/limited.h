/* SPDX-License-Identifier: MIT */
/* Random problems with limits, the same as those of mpc_reference.py. */
#ifndef TEST_LIMITED_H
#define TEST_LIMITED_H

#include <float.h>
#include <math.h>

#include "lqg/mpc.h"

#ifdef LQG_REAL_DOUBLE
#define EPSILON DBL_EPSILON
#define LARGEST DBL_MAX
#else
#define EPSILON FLT_EPSILON
#define LARGEST FLT_MAX
#endif

enum { MAX_ROWS = 16, MAX_V = 8, MAX_U = 2 };

/* What is special about a problem: limits of inputs alone; soft limits of their changes; soft limits of anything; each
 * limit twice; two that are nearly the same; limits that are infinite; limits that leave one value. */
typedef enum { BOX, RATES, SOFT, EQUAL_ROWS, NEARLY_SINGULAR, INFINITE, EQUAL_LIMITS, KINDS } kind_t;

/* low ≤ f + M w + e ≤ high, to minimise wᵀw + Σ e_i²/soft_i; e_i = 0 where soft_i is 0. */
typedef struct {
    unsigned nu, nv, rows;
    double f[MAX_ROWS], M[MAX_ROWS][MAX_V], soft[MAX_ROWS], low[MAX_ROWS], high[MAX_ROWS];
} problem_t;

problem_t random_problem(kind_t kind, unsigned seed);

/* The problem as the library has it: x = f. */
typedef struct {
    lqg_real f[MAX_ROWS], F[MAX_ROWS * MAX_ROWS], K[MAX_U * MAX_ROWS], G[MAX_ROWS * MAX_ROWS], scale[MAX_ROWS];
    lqg_real low[MAX_ROWS], high[MAX_ROWS], tolerance[MAX_ROWS];
    lqg_mpc_t mpc;
} description_t;

void describe(const problem_t *problem, description_t *out);

/* A state over memory that begins as garbage, and the row behind it that must stay what it is. */
typedef struct {
    lqg_real memory[LQG_MPC_MEMORY(MAX_ROWS) + 1];
    unsigned char set[LQG_MPC_SET(MAX_ROWS) + 1];
    lqg_mpc_state_t state;
} scratch_t;

void begin_scratch(scratch_t *scratch, const lqg_mpc_t *mpc, const lqg_real u_applied[]);

/* Nothing beside the memory of this description was written to. */
int is_scratch_intact(const scratch_t *scratch, const lqg_mpc_t *mpc);

#endif
