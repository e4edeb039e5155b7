/* A controller, called in any order, for ever, with anything. HEADER, NAME and UPPER_NAME are its own; U_MIN
 * and U_MAX its limits, if it has some. */
#include "anything.h"

enum { NX = SIZE(NX), NY = SIZE(NY) };
#ifdef HAS_NU
enum { NU = SIZE(NU) };
#endif

static const lqg_real bound[NX] = SIZE(X_BOUNDS);

/* More than what init leaves: any estimate within its bounds, any number of resets. So the prover need not find out step
 * by step how far they get. */
static void begin_anywhere(OF(t) * loop)
{
    for (int i = 0; i < NX; i++) {
        const lqg_real anywhere = any_real;
        if (!BELOW(anywhere, bound[i]))
            stop();
        loop->x[i] = anywhere;
    }
    loop->resets = any_count;
}

static void look_at_state(const OF(t) * loop)
{
    for (int i = 0; i < NX; i++) {
        /*@ check state_bounded: -bound[i] < loop->x[i] < bound[i]; */
    }
}

/* After a prediction: an update's own result is looked at then. */
static void look_at_covariance(const OF(t) * loop)
{
#ifdef HAS_P
    for (int i = 0; i < NX; i++) {
        /*@ check covariance_bounded: \abs(loop->P[i * (i + 1) / 2 + i]) < bound[i] * bound[i]; */
    }
#endif
#ifdef HAS_d
    for (int i = 0; i < NX; i++) {
        /*@ check covariance_bounded: \abs(loop->d[i]) < bound[i] * bound[i]; */
    }
#endif
#ifdef HAS_U
    for (int i = 0; i < NX * (NX - 1) / 2; i++) {
        /*@ check factors_finite: \is_finite(loop->U[i]); */
    }
#endif
    (void)loop;
}

#ifdef HAS_control
static void look_at_input(const lqg_real u[])
{
#ifdef U_MIN
    const double low[] = U_MIN, high[] = U_MAX;
#endif
    for (int i = 0; i < NU; i++) {
        /*@ check input_finite: \is_finite(u[i]); */
#ifdef U_MIN
        /*@ check input_limited: low[i] <= u[i] <= high[i]; */
#endif
    }
}
#endif

/* One of the calls, with anything. */
static void call_any(OF(t) * loop)
{
        const int call = any_int;
    lqg_real y[NY];
        say_anything(y, NY);
#ifdef HAS_NU
    lqg_real u[NU];
        say_anything(u, NU);
#endif

    if (call == 0)
        OF(update)(loop, y);
    if (call == 1) {
#ifdef HAS_NU
        OF(predict)(loop, u);
#else
        OF(predict)(loop);
#endif
        look_at_covariance(loop);
    }
#ifdef HAS_control
    if (call == 2) {
        OF(control)(loop, u);
            look_at_input(u);
    }
#endif
#ifdef HAS_set_state
    lqg_real x[NX];
    say_anything(x, NX);
    if (call == 3)
        OF(set_state)(loop, x);
#endif
#ifdef HAS_partial_update
    if (call == 5)
        OF(partial_update)(loop, y, any_count);
#endif
#ifdef HAS_set_input
    if (call == 4)
        OF(set_input)(loop, u);
#endif
}

int main(void)
{
    OF(t) loop;

    OF(init)(&loop);
    look_at_state(&loop);
    begin_anywhere(&loop);
#ifdef LAST_ROWS
    /*@ loop widen_hints "all", LAST_ROWS; */
#endif
    while (any_int) {
#ifdef HAS_NR
        say_anything(loop.r, SIZE(NR));
#endif
        call_any(&loop);
        look_at_state(&loop);
    }
    return 0;
}
