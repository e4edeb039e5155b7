/* SPDX-License-Identifier: MIT */
/* A program that is nothing but the controller in HEADER: what the linker brings for init and step, constants and
 * library functions included, is its flash. With CALLS it makes the calls of a sample instead; KEEPS_Z and ESTIMATES
 * are those of measure.c. The table of the functions itself, from which the linker starts, lies in a section of its
 * own. */
#include HEADER

#define PASTE(a, b) a##_##b
#define JOIN(a, b) PASTE(a, b)
#define OF(part) JOIN(NAME, part)

typedef void function(void);

extern function *const roots[];

__attribute__((section(".roots"))) function *const roots[] = {
    (function *)OF(init),
#if !defined CALLS
    (function *)OF(step),
#elif defined KEEPS_Z
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
