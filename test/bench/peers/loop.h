/* SPDX-License-Identifier: MIT */
/* The plant that a contestant controls, with the same noise for all of them: some controllers are unstable by
 * themselves and need its answer. And how far the last u is from that of a filter in double: the same answers are asked
 * for before anything is compared. */
#ifndef BENCH_PEER_LOOP_H
#define BENCH_PEER_LOOP_H

#include "peer.h"

static float row_product(const float matrix[], unsigned row, unsigned columns, const float vector[])
{
    float sum = 0;

    for (unsigned j = 0; j < columns; j++)
        sum += matrix[row * columns + j] * vector[j];
    return sum;
}

static void measure_plant(const float x[NX], const float v[NY], float y[NY])
{
    for (unsigned i = 0; i < NY; i++)
        y[i] = row_product(C, i, NX, x) + v[i];
}

static void move_plant(float x[NX], const float u[NU], const float w[NX])
{
    float next[NX];

    for (unsigned i = 0; i < NX; i++)
        next[i] = row_product(A, i, NX, x) + row_product(B, i, NU, u) + w[i];
    for (unsigned i = 0; i < NX; i++)
        x[i] = next[i];
}

static float size_of(float number)
{
    return number < 0 ? -number : number;
}

/* Relative to the largest entry, in millionths. */
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
