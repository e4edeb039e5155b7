/* A controller that keeps z in place of x̂, called in any order, for ever, with anything. HEADER, NAME and UPPER_NAME
 * are its own; HEARS_FIRST: u is made of this sample's outputs. */
#include "anything.h"

enum { NX = SIZE(NX), NY = SIZE(NY), NU = SIZE(NU), NZ = SIZE(NZ) };

static void look_at_state(const OF(t) * loop)
{
    for (int i = 0; i < NZ; i++) {
        /*@ check state_finite: \is_finite(loop->z[i]); */
    }
}

static void control(OF(t) * loop, const lqg_real y[])
{
    lqg_real u[NU];

#ifdef HEARS_FIRST
    OF(control)(loop, y, u);
#else
    (void)y;
    OF(control)(loop, u);
#endif
    for (int i = 0; i < NU; i++) {
        /*@ check input_finite: \is_finite(u[i]); */
    }
}

static void advance(OF(t) * loop, const lqg_real y[])
{
#ifdef HEARS_FIRST
    (void)y;
    OF(advance)(loop);
#else
    OF(advance)(loop, y);
#endif
}

/* One of the calls, with anything. */
static void call_any(OF(t) * loop)
{
    const int call = any_int;
    lqg_real x[NX], y[NY];

    say_anything(x, NX);
    say_anything(y, NY);
    if (call == 0)
        control(loop, y);
    if (call == 1)
        advance(loop, y);
    if (call == 2)
        OF(set_state)(loop, x);
    if (call == 3)
        OF(estimate)(loop, x);
}

int main(void)
{
    OF(t) loop;

    OF(init)(&loop);
    while (any_int) {
        call_any(&loop);
        look_at_state(&loop);
    }
    return 0;
}
