/* What a proof of a controller begins with: the controller in HEADER and its names, and anything. To be included by the one
 * file with main(). */
#ifndef PROOF_ANYTHING_H
#define PROOF_ANYTHING_H

#include <math.h>

#include "unknown.h"
#include HEADER

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)
#define SIZE(part) JOIN(UPPER_NAME, part)

volatile int any_int;
volatile unsigned long any_count;
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

/* So that the prover does without the specification of its own. */
float fabsf(float a)
{
    return a < 0 ? -a : a;
}

double fabs(double a)
{
    return a < 0 ? -a : a;
}

static void say_anything(lqg_real v[], int length)
{
    for (int i = 0; i < length; i++)
        v[i] = any_real;
}

#endif
