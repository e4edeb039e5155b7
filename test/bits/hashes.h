/* SPDX-License-Identifier: MIT */
/* What a controller has computed, in two numbers. */
#ifndef TEST_HASHES_H
#define TEST_HASHES_H

#include "hash.h"

typedef struct {
    unsigned long long bits; /* of every bit */
    unsigned long long
        values; /* the same with −0 as 0: in the sign of zeros the two styles may differ, as straight-line
                                * code leaves 0·x out */
} hashes_t;

#endif
