/* SPDX-License-Identifier: MIT */
/* Instructions of a sample of one contestant, the median of all samples, and how far its last u is from that of a
 * filter in double, relative to the largest entry: the same answers are asked for before anything is compared. */
#include "../counter.h"
#include "../results.h"
#include "peer.h"

enum { SAMPLES = sizeof w_in / sizeof w_in[0], STACK_WORDS = 16384 };

/* Eigen names malloc for matrices that are larger than these: nobody gets any memory. */
void *_sbrk(int bytes);
void *_sbrk(int bytes)
{
    (void)bytes;
    return (void *)-1;
}

static uint32_t stack[STACK_WORDS] __attribute__((aligned(16)));
static unsigned counts[SAMPLES];

static float size_of(float number)
{
    return number < 0 ? -number : number;
}

/* In millionths. */
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

int main(void)
{
    float x[NX] = {0}, y[NY], u[NU];

    start_counting();
    peer_init();
    for (unsigned k = 0; k < SAMPLES; k++) {
        const uint32_t none = ticks_of_call(NULL, NULL, NULL, do_nothing, stack + STACK_WORDS);

        measure_plant(x, v_in[k], y);
        counts[k] = instructions_in(ticks_of_call(NULL, y, u, (function *)peer_sample, stack + STACK_WORDS)) -
                    instructions_in(none) + 1;
        move_plant(x, u, w_in[k]);
    }
    print("instructions", median(counts, SAMPLES));
    print("error", error_of(u));
    return 0;
}
