/* A controller, called in any order, for ever, with anything. HEADER, NAME and UPPER_NAME are its own; U_MIN and U_MAX
 * its limits, if it has some. */
#include <math.h>

#include "unknown.h"
#include HEADER

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)
#define SIZE(part) JOIN(UPPER_NAME, part)

enum { NX = SIZE(NX), NY = SIZE(NY), NU = SIZE(NU), UPDATE = 0, CONTROL = 1, PREDICT = 2 };

volatile int any_int;
volatile lqg_real any_real;

/* Whatever a fused multiply-add may be. */
float fmaf(float a, float b, float c)
{
    (void)a, (void)b, (void)c;
    return (float)any_real;
}

double fma(double a, double b, double c)
{
    (void)a, (void)b, (void)c;
    return (double)any_real;
}

static void say_anything(lqg_real v[], int length)
{
    for (int i = 0; i < length; i++)
        v[i] = any_real;
}

static void look_at_state(const OF(t) * loop)
{
    for (int i = 0; i < NX; i++) {
        /*@ check state_finite: \is_finite(loop->x[i]); */
    }
}

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

int main(void)
{
    OF(t) loop;
    lqg_real y[NY], u[NU];

    OF(init)(&loop);
    while (any_int) {
        const int call = any_int;
        say_anything(y, NY);
        say_anything(u, NU);
        if (call == UPDATE)
            OF(update)(&loop, y);
        if (call == CONTROL) {
            OF(control)(&loop, u);
            look_at_input(u);
        }
        if (call == PREDICT)
            OF(predict)(&loop, u);
        look_at_state(&loop);
    }
    return 0;
}
