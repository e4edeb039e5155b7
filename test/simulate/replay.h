/* SPDX-License-Identifier: MIT */
/* Numbers of a file of record_runs, as REAL has them. */
#ifndef TEST_REPLAY_H
#define TEST_REPLAY_H

#include <stdio.h>
#include <string.h>

#include "lqg/status.h"

/* A file that ends too early gives numbers that no run has. */
static inline double read_number(FILE *file)
{
    double number;
    return fread(&number, sizeof number, 1, file) == 1 ? number : -1;
}

static inline void read_reals(FILE *file, REAL *values, int count)
{
    for (int i = 0; i < count; i++)
        values[i] = (REAL)read_number(file);
}

/* A zero is a zero, whatever its sign: straight-line code leaves 0·x out. */
static inline int are_equal(const REAL *found, const REAL *expected, int count)
{
    for (int i = 0; i < count; i++)
        if (!(found[i] == expected[i]))
            return 0;
    return 1;
}

#define COUNT(array) ((int)(sizeof(array) / sizeof(array)[0]))
#define READ(file, array) read_reals(file, array, COUNT(array))
#define ARE_EQUAL(found, expected) are_equal(found, expected, COUNT(found))

#endif
