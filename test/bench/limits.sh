#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What the library's law with limits, lqg/mpc.h, costs on a Cortex-M4F at -Os: two_mass with |u| ≤ 0.3 in six blocks.
#
#   test/bench/limits.sh <the program test_design_limits, which makes the tables> <folder for scratch>
#
# Instructions are counted by QEMU, exactly, over 20,000 states |x_i| < 2: the median while no limit is in the way, and
# the most of all. Flash is that of the law and its tables; RAM is its scratch. Fails where a figure exceeds its budget.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"
bench=$lqg_root/test/bench
source "$bench/cores.sh"
tables=$1 work=$2
budget_flash=2560 budget_ram=300 budget_idle=400 budget_most=9000

options=(-Os -std=c99)
select_core cortex-m4f
absent=$(missing_tools)
[ -z "$absent" ] || { echo "Nothing to compare: no$absent" && exit; }

rm -rf "$work"
mkdir -p "$work"
"$tables" tables >"$work/tables.h"
sources=("$bench/limits.c" "$bench/counter_$family.c" "$startup" "$lqg_root"/src/{mpc,kernel}.c)
(cd "$work" && "${compiler[@]}" "-DMEGAHERTZ=$megahertz" '-DTABLES="tables.h"' -I"$work" -I"$bench" -c "${sources[@]}")
"${compiler[@]}" "$work"/*.o "${linked[@]}" -lm -o "$work/limits.elf"
timeout 300 "${machine[@]}" "$work/limits.elf" >"$work/measured" || lqg_stop "the measurement failed"
# shellcheck disable=SC1091  # it has just been made
source "$work/measured"
flash=$({ "$size" -A "$work/mpc.o" && "$size" -A "$work/limits.o"; } |
  awk -v functions='lqg_mpc_control|limit_law|limit_of|foreseen|substitute|row_product|copy' '
    $1 ~ "^\\.(text.*(" functions ")|rodata\\.[a-zA-Z]*$)" { sum += $2 }
    END { print sum }')

echo "flash $flash bytes, RAM $ram bytes, instructions $idle while no limit is in the way, $most at most"
[ "$given_up" = 0 ] || lqg_stop "$given_up states were given up"
for figure in flash ram idle most; do
  budget=budget_$figure
  [ "${!figure}" -le "${!budget}" ] || lqg_stop "$figure exceeds ${!budget}"
done
