/* SPDX-License-Identifier: MIT */
/* Runs a sketch on a simulated Uno until it has printed a line "end", and prints what it printed.
 *
 *     print_sketch SKETCH.elf
 *
 * Exit status 1: there was no such line within 30 s of the Uno's time. */
#include <stdio.h>
#include <string.h>

#include "uno.h"

int main(int argc, char **argv)
{
    avr_t *avr = uno_load(argc > 1 ? argv[1] : "");
    int is_well = 1;

    for (double seconds = 0.1; is_well && !strstr(uno_printed(), "end\n") && seconds < 30.0; seconds += 0.1)
        is_well = uno_run_until(avr, seconds) == 0;
    fputs(uno_printed(), stdout);
    return is_well && strstr(uno_printed(), "end\n") ? 0 : 1;
}
