/* SPDX-License-Identifier: MIT */
/* A program that is nothing but the controller in HEADER: what the linker brings for its four functions,
 * constants and library functions included, is its flash. The table of the functions itself, from which the
 * linker starts, lies in a section of its own. */
#include HEADER

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)

typedef void function(void);

extern function *const roots[];

__attribute__((section(".roots"))) function *const roots[] = {
    (function *)OF(init),
#ifdef KEEPS_Z
    (function *)OF(control),
    (function *)OF(advance),
#else
    (function *)OF(update),
#ifndef ESTIMATES
    (function *)OF(control),
#endif
    (function *)OF(predict),
#endif
};
