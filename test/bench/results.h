/* SPDX-License-Identifier: MIT */
/* What a measurement prints: lines that a shell can read as assignments, by putchar alone. */
#ifndef BENCH_RESULTS_H
#define BENCH_RESULTS_H

#include <stdio.h>
#include <stdlib.h>

static void print_number(unsigned number)
{
    if (number >= 10)
        print_number(number / 10);
    putchar((int)('0' + number % 10));
}

static void print(const char *name, unsigned number)
{
    while (*name)
        putchar(*name++);
    putchar('=');
    print_number(number);
    putchar('\n');
}

static int ascending(const void *a, const void *b)
{
    const unsigned first = *(const unsigned *)a, second = *(const unsigned *)b;

    return (first > second) - (first < second);
}

/* Of counts, which are sorted after it. */
static unsigned median(unsigned counts[], unsigned number)
{
    qsort(counts, number, sizeof counts[0], ascending);
    return counts[number / 2];
}

#endif
