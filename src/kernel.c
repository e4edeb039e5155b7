/* SPDX-License-Identifier: MIT */
/* What is needed in many places, and not in every sample. */
#include "kernel.h"

LQG_STRICT_BEGIN

void lqg_begin(lqg_real to[], const lqg_real from[], unsigned length)
{
    for (unsigned i = 0; to && i < length; i++)
        to[i] = from ? from[i] : 0;
}

LQG_STRICT_END
