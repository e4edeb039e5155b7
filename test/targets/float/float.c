/* SPDX-License-Identifier: MIT */
/* What a target's float operations make of random numbers of every kind: prints a hash of the results for each
 * operation and each pair of kinds. The PC rounds as IEEE 754 says, so a target whose lines are the same does, too.
 *
 * A quotient below 2⁻¹²⁶ is not in the hashes: avr-libc rounds a few of them to the wrong neighbour. It is compared
 * with an integer division instead; the line with # counts those that differ, and one that is off by more than the last
 * bit gives exit status 1. */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { PAIRS = 1000, KINDS = 6, OPERATIONS = 5 };
enum { ADD, SUBTRACT, MULTIPLY, DIVIDE, COMPARE };

static const char *const kind_names[KINDS] = {"moderate", "normal", "denormal", "zero", "infinite", "nan"};
static const char operation_names[OPERATIONS] = {'+', '-', '*', '/', '<'};

#define SIGN UINT32_C(0x80000000)
#define INFINITE UINT32_C(0x7f800000)
#define LEAST_NORMAL UINT32_C(0x00800000)

static uint32_t seed;

static uint32_t draw16(void)
{
    seed = seed * UINT32_C(1664525) + UINT32_C(1013904223);
    return seed >> 16;
}

static uint32_t draw(unsigned kind)
{
    const uint32_t random = draw16() << 16 | draw16();

    switch (kind) {
        case 0:
            return (random & ~INFINITE) | (100 + draw16() % 56) << 23;
        case 1:
            return (random & ~INFINITE) | (1 + draw16() % 254) << 23;
        case 2:
            return random & ~INFINITE;
        case 3:
            return random & SIGN;
        case 4:
            return (random & SIGN) | INFINITE;
        default:
            return UINT32_C(0x7fc00000);
    }
}

static float float_of(uint32_t bits)
{
    float value;

    memcpy(&value, &bits, sizeof value);
    return value;
}

/* One NaN is as good as another. */
static uint32_t bits_of(float value)
{
    uint32_t bits;

    memcpy(&bits, &value, sizeof bits);
    return (bits & ~SIGN) > INFINITE ? UINT32_C(0x7fc00000) : bits;
}

static uint32_t operate(unsigned operation, float left, float right)
{
    const volatile float a = left, b = right; /* at run time, not by the compiler */

    switch (operation) {
        case ADD:
            return bits_of(a + b);
        case SUBTRACT:
            return bits_of(a - b);
        case MULTIPLY:
            return bits_of(a * b);
        case DIVIDE:
            return bits_of(a / b);
        default:
            return (uint32_t)((a < b) | (a > b) << 1 | (a <= b) << 2 | (a >= b) << 3 | (a == b) << 4 | (a != b) << 5);
    }
}

/* A finite number as significand · 2^(exponent − 149). */
static uint32_t split(uint32_t bits, int *exponent)
{
    const int stored = (int)((bits & INFINITE) >> 23);

    *exponent = stored ? stored - 1 : 0;
    return (bits & UINT32_C(0x007fffff)) | (stored ? LEAST_NORMAL : 0);
}

/* a/b in units of 2⁻¹⁴⁹ to the nearest, ties to even, where that is below 2²⁴; without its sign. */
static uint32_t small_quotient(uint32_t a, uint32_t b)
{
    int a_exponent, b_exponent;
    uint64_t numerator = split(a, &a_exponent), denominator = split(b, &b_exponent);
    const int shift = a_exponent - b_exponent + 149; /* the quotient is numerator/denominator · 2^shift units */

    if (shift >= 0)
        numerator = shift > 40 ? 0 : numerator << shift; /* above 40 the quotient is not small */
    else
        denominator = shift < -40 ? (uint64_t)1 << 63 : denominator << -shift;
    const uint64_t quotient = numerator / denominator, twice = 2 * (numerator % denominator);
    return (uint32_t)(quotient + (twice > denominator || (twice == denominator && (quotient & 1)) ? 1 : 0));
}

static uint32_t hash_of(uint32_t hash, uint32_t value)
{
    for (unsigned shift = 0; shift < 32; shift += 8)
        hash = (hash ^ ((value >> shift) & 0xff)) * UINT32_C(16777619);
    return hash;
}

static unsigned long small_quotients, differing, far_off;

static void check_small_quotient(uint32_t a, uint32_t b, uint32_t found)
{
    const uint32_t expected = small_quotient(a, b), magnitude = found & ~SIGN;
    const uint32_t distance = expected > magnitude ? expected - magnitude : magnitude - expected;

    small_quotients++;
    differing += distance != 0;
    far_off += distance > 1;
}

static uint32_t hash_of_pairs(unsigned operation, unsigned a_kind, unsigned b_kind)
{
    uint32_t hash = UINT32_C(2166136261);

    seed = 1 + 100 * (uint32_t)operation + 10 * (uint32_t)a_kind + b_kind;
    for (int i = 0; i < PAIRS; i++) {
        const uint32_t a = draw(a_kind), b = draw(b_kind);
        const uint32_t result = operate(operation, float_of(a), float_of(b));
        const int both_finite = a_kind < 3 && b_kind < 3;

        if (operation == DIVIDE && both_finite && (a & ~SIGN) && (result & ~SIGN) <= LEAST_NORMAL)
            check_small_quotient(a, b, result);
        else
            hash = hash_of(hash, result);
    }
    return hash;
}

int main(void)
{
    for (unsigned operation = 0; operation < OPERATIONS; operation++)
        for (unsigned a = 0; a < KINDS; a++)
            for (unsigned b = 0; b < KINDS; b++)
                printf("%s %c %s %08lx\n", kind_names[a], operation_names[operation], kind_names[b],
                       (unsigned long)hash_of_pairs(operation, a, b));
    printf("# of %lu quotients below 2^-126 %lu differ, %lu by more than the last bit\n", small_quotients, differing,
           far_off);
    return far_off ? 1 : 0;
}
