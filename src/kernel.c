/* SPDX-License-Identifier: MIT */
/* What is needed in many places, and not in every sample. */
#include "kernel.h"

#if defined LQG_FUSED && !defined LQG_SLOW_FUSED
#if (defined LQG_REAL_DOUBLE && !LQG_HAS_FMA) || (!defined LQG_REAL_DOUBLE && !LQG_HAS_FMAF)
#pragma message( \
    "TinyLQG: LQG_FUSED without the instruction is slow. Compile for a processor that has it (x86: -mfma), \
leave out LQG_FUSED, or define LQG_SLOW_FUSED.")
#endif
#endif

LQG_STRICT_BEGIN

void lqg_begin(lqg_real to[], const lqg_real from[], unsigned length)
{
    for (unsigned i = 0; to && i < length; i++)
        to[i] = from ? from[i] : 0;
}

LQG_STRICT_END
