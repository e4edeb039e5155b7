/* SPDX-License-Identifier: MIT */
/* Prints a line for each controller of controllers.h, "<design> <arithmetic> <style> <real> <bits> <values>" by
 * hashes.h, and whether the compiler contracts a*b + c where nobody tells it not to. */
#include <stdio.h>

#include "contracted.h"
#include "hashes.h"

#define CONTROLLER(name, arithmetic, style, real) hashes_t name##_##arithmetic##_##style##_##real(void);
#include "controllers.h"
#undef CONTROLLER

/* With nothing but putchar(), which is all that small targets have. */
static void print(const char *text)
{
    while (*text)
        putchar(*text++);
}

static void print_hash(unsigned long long hash)
{
    for (int shift = 60; shift >= 0; shift -= 4)
        putchar("0123456789abcdef"[hash >> shift & 15u]);
}

static void print_line(const char *controller, hashes_t hashes)
{
    print(controller);
    print_hash(hashes.bits);
    putchar(' ');
    print_hash(hashes.values);
    putchar('\n');
}

int main(void)
{
#define CONTROLLER(name, arithmetic, style, real) \
    print_line(#name " " #arithmetic " " #style " " #real " ", name##_##arithmetic##_##style##_##real());
#include "controllers.h"
#undef CONTROLLER
    print(is_contracted() ? "contracted\n" : "not contracted\n");
    return 0;
}
