#!/bin/sh
# SPDX-License-Identifier: MIT
# run.sh <mcu> <program.elf>: runs a program that has board.c in simavr, prints what it writes to UART 0, and ends with
# its exit status; 99 when it ended without one.

# simavr shows the UART in green, each line with a dot in place of its line feed.
said=$(simavr -m "$1" -f 16000000 "$2" 2>&1 | sed 's/\x1b\[[0-9;]*m//g; s/\r\{0,1\}$//; s/\.$//')
status=$(printf '%s\n' "$said" | sed -n 's/^exit status \([0-9]*\)$/\1/p' | tail -n 1)
printf '%s\n' "$said" | sed '/^exit status/d; /^Loaded /d'
[ -n "$status" ] || echo "$2 ended without an exit status: it crashed, or has no board.c"
exit "${status:-99}"
