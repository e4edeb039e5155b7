/* SPDX-License-Identifier: MIT */
/* Calls a controller with anything, from any state, to see that what is said to follow from its tests does. Compiled
 * with tried.h in place of unknown.h. */
#include "anything.h"

#define LOOK_AT_COVARIANCE(loop) (void)(loop)
#define look_at_input(u) (void)(u)
#define FILL(part) say_anything(state.part, (int)(sizeof state.part / sizeof state.part[0]))

enum { TIMES = 200000 };

#include "calls.h"

#ifdef PROOF_HAS_LOOP
static OF(t) state;

static void begin_anywhere(void)
{
#ifdef PROOF_KEEPS_x
    FILL(x);
#endif
#ifdef PROOF_KEEPS_z
    FILL(z);
#endif
#ifdef PROOF_KEEPS_P
    FILL(P);
#endif
#ifdef PROOF_KEEPS_U
    FILL(U);
#endif
#ifdef PROOF_KEEPS_d
    FILL(d);
#endif
#ifdef PROOF_KEEPS_xi
    FILL(xi);
#endif
#ifdef PROOF_KEEPS_r
    FILL(r);
#endif
}
#endif

int main(void)
{
    for (int i = 0; i < TIMES; i++) {
#ifdef PROOF_HAS_LOOP
        begin_anywhere();
        call_any(&state);
#else
        call_any(NULL);
#endif
    }
    return 0;
}
