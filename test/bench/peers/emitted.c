/* SPDX-License-Identifier: MIT */
/* The controller that lqgen emits, with all its checks. KEEPS_Z and PREDICTS as in test/bench/measure.c. */
#include "peer.h"

#include HEADER

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)

static OF(t) self;

void peer_init(void)
{
    OF(init)(&self);
}

void peer_sample(void *unused, const float y[NY], float u[NU])
{
    (void)unused;
#if defined PREDICTS
    (void)OF(control)(&self, u);
    (void)OF(advance)(&self, y);
#elif defined KEEPS_Z
    (void)OF(control)(&self, y, u);
    (void)OF(advance)(&self);
#else
    (void)OF(update)(&self, y);
    (void)OF(control)(&self, u);
    (void)OF(predict)(&self, u);
#endif
}
