/* SPDX-License-Identifier: MIT */
/* What a proof of a controller begins with: the controller in NAME_proof.h, its names, and anything. */
#ifndef PROOF_ANYTHING_H
#define PROOF_ANYTHING_H

#include <math.h>

#include "unknown.h"
#include HEADER

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(PROOF_NAME, part)
#define SIZE(part) JOIN(PROOF_UPPER_NAME, part)

/* A controller without a memory has no type. */
#ifdef PROOF_HAS_LOOP
#define LOOP OF(t) * loop
#else
#define LOOP void *loop
#endif

#ifndef PROOF_TRIED
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
#endif

static void say_anything(lqg_real v[], int length)
{
    for (int i = 0; i < length; i++)
        v[i] = any_real;
}

/* An array of anything. */
#define ANYTHING(name, length) \
    lqg_real name[length];     \
    say_anything(name, length)

#endif
