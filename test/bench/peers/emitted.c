/* SPDX-License-Identifier: MIT */
/* The controller that lqgen emits, with all its checks. */
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
    (void)OF(step)(&self, y, u);
}
