/* What the prover knows nothing about, and what in the proof stands for "the sum of v, and of more, is finite". */
#ifndef PROOF_UNKNOWN_H
#define PROOF_UNKNOWN_H

#include "finite.h"
#include "lqg/arithmetic.h"

extern volatile int any_int; /* each reading may give anything */

/* Every v_i is finite. May say no when they are, but never yes when one is not. */
static inline int perhaps_all_finite(const lqg_real v[], unsigned length)
{
    for (unsigned i = 0; i < length; i++)
        if (!FINITE(v[i]))
            return 0;
    return any_int != 0;
}

#endif
