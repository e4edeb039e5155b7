#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# No combination of a compiler's options is accepted and wrong: either it is refused when lqg/check.h or a controller is
# compiled, or lqg_arithmetic_check() finds it, or controllers and library compute every bit as expected, with outputs
# that are NaN left out.
#
#   options.sh <build> sample <compiler>              those of sample.txt: each has to end as it says there
#   options.sh <build> pairs <compiler> <options>     these options with each of options.txt that the compiler knows,
#                                                     and with each two of them
#
# <build> is a build with tests. Prints how each combination ends; status 1 if one is wrong, or ends otherwise than
# expected.
set -euo pipefail
folder=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$folder/../.." && pwd)
build=$(cd "$1" && pwd)
mode=$2 compiler=$3
command -v "$compiler" >/dev/null || { echo "Not found: $compiler"; exit 0; }
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

# Constant gain; plain covariance; UD factors and limits; compact; a gate, fused.
controllers=(
  "two_mass plain unrolled float"
  "double_integrator plain unrolled float"
  "balancing_robot plain unrolled double"
  "oven plain compact float"
  "gated fused unrolled float"
)

# One source for each controller, the list of them, and the bits that they have to have.
describe_controllers() {
  local name arithmetic style real line
  for line in "${controllers[@]}"; do
    read -r name arithmetic style real <<<"$line"
    {
      echo "#define REAL $real"
      echo "#define FUNCTION_OF(name) FUNCTION(name)"
      echo "#define FUNCTION(name) name##_${arithmetic}_${style}_$real"
      [ "$real" = float ] || echo "#define LQG_REAL_DOUBLE"
      [ "$arithmetic" = plain ] || echo "#define LQG_FUSED"
      echo "#include \"$build/test/bits/controllers/${name}_${style}_$real.h\""
    } >"$work/$name.c"
    echo "CONTROLLER($name, $arithmetic, $style, $real)" >>"$work/controllers.h"
    grep "^$line " "$root/test/bits/hashes.txt" >>"$work/expected"
  done
  cat >"$work/check.c" <<'END'
#include <stdio.h>

#include "lqg/check.h"

int main(void)
{
    const char *wrong = lqg_arithmetic_check();
    if (wrong)
        puts(wrong);
    return wrong != NULL;
}
END
}

# make_program <program> <source>…: with the options; false if the compiler or the linker refuses.
make_program() {
  local program=$1 here=$work/objects linked=()
  shift
  rm -rf "$here"
  mkdir "$here"
  (cd "$here" && "$compiler" "${options[@]}" -w "-I$root/include" "-I$root/test/bits" "-I$root/test/src" "-I$work" \
    -c "$@") >"$work/log" 2>&1 || return 1
  [[ " ${options[*]} " != *" -x c++ "* ]] || linked=(-x none)
  "$compiler" "${options[@]}" "${linked[@]}" "$here"/*.o -lm -o "$work/$program" >"$work/log" 2>&1
}

# ends: how the combination of the array options ends: refused, found, right or wrong.
ends() {
  local sources=()
  make_program check "$work/check.c" || { echo refused; return; }
  "$work/check" >"$work/log" || { echo found; return; }
  for line in "${controllers[@]}"; do
    sources+=("$work/${line%% *}.c")
  done
  make_program bits "${sources[@]}" "$root/test/bits/main.c" "$root"/src/*.c || { echo refused; return; }
  "$work/bits" | grep -v contracted >"$work/bits.txt" || true
  make_program library "$root/test/src/print_bits.c" "$root/test/src/bits.c" "$root"/src/*.c ||
    { echo refused; return; }
  "$work/library" >"$work/library.txt" || true
  if cmp -s "$work/bits.txt" "$work/expected" && cmp -s "$work/library.txt" "$work/library_expected"; then
    echo right
  else
    echo wrong
  fi
}

declare -A count=([refused]=0 [found]=0 [right]=0 [wrong]=0)
failed=0

# judge <options> [expected]
judge() {
  local end
  read -r -a options <<<"$1"
  end=$(ends)
  count[$end]=$((count[$end] + 1))
  if [ "$end" = wrong ] || [ "${2:-$end}" != "$end" ]; then
    failed=$((failed + 1))
    echo "FAILED: $compiler $1: $end${2:+, expected $2}"
    diff "$work/bits.txt" "$work/expected" || true
  else
    echo "$end: $compiler $1"
  fi
}

sample() {
  local of expected combination
  while IFS='|' read -r of expected combination; do
    if [ "$(xargs <<<"$of")" = "$compiler" ]; then
      judge "$(xargs <<<"$combination")" "$(xargs <<<"$expected")"
    fi
  done < <(grep -v '^#' "$folder/sample.txt")
}

# Of options.txt those that the compiler takes.
known_options() {
  local option
  while read -r option; do
    read -r -a options <<<"$option"
    if "$compiler" "${options[@]}" -Werror -fsyntax-only -x c /dev/null 2>/dev/null; then
      echo "$option"
    fi
  done < <(grep -v '^#' "$folder/options.txt")
}

pairs() {
  local first second all
  mapfile -t all < <(known_options)
  for first in "${!all[@]}"; do
    judge "$1 ${all[first]}"
    for ((second = 0; second < ${#all[@]}; second++)); do
      [ "$first" = "$second" ] || judge "$1 ${all[first]} ${all[second]}"
    done
  done
}

describe_controllers
options=(-O0 -std=c99 -ffp-contract=off)
make_program library "$root/test/src/print_bits.c" "$root/test/src/bits.c" "$root"/src/*.c
"$work/library" >"$work/library_expected"
case $mode in
  sample) sample ;;
  pairs) pairs "$4" ;;
esac
total=$((count[refused] + count[found] + count[right] + count[wrong]))
echo "$compiler${4:+ $4}: $total combinations: ${count[right]} right, ${count[refused]} refused," \
  "${count[found]} found by the check, ${count[wrong]} wrong"
[ "$total" -gt 0 ] && [ "$failed" = 0 ]
