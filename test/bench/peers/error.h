/* SPDX-License-Identifier: MIT */
/* How far a contestant's last u is from that of a filter in double, relative to the largest entry, in millionths: the
 * same answers are asked for before anything is compared. */
#ifndef BENCH_PEER_ERROR_H
#define BENCH_PEER_ERROR_H

#include "peer.h"

static float size_of(float number)
{
    return number < 0 ? -number : number;
}

static unsigned error_of(const float u[NU])
{
    float largest = 0, error = 0;

    for (unsigned i = 0; i < NU; i++) {
        const float off = size_of(u[i] - u_end[i]);

        largest = largest > size_of(u_end[i]) ? largest : size_of(u_end[i]);
        error = error > off || error != error ? error : off;
    }
    return largest > 0 && error < largest ? (unsigned)(1e6f * error / largest) : 1000000;
}

#endif
