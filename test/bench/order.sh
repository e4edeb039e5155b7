#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What the order of statements costs on three pipelines: cycles of one step, estimated by LLVM's model of the core, once
# with the statements in the order in which lqgen writes them, once moved by GCC, and as emitted: lqgen decides by the
# number of values that are in use at once. Below 1 the emitted order is the better one of the two.
#
#   test/bench/order.sh [core]… [--update]      prints the table; --update writes it to order.md, too
#
# A core is one of cortex-m4, cortex-m7 and cortex-m55; without any it is all three. The models are those of peers/,
# each with a constant gain, in its cheapest form, and with the covariance carried along. Code is GCC's at -O2, the
# listing of step from its first instruction to its return; branches to what happens seldom are not taken, comparisons
# that LLVM has no model of cost nothing. Debian's packages: gcc-arm-none-eabi libnewlib-arm-none-eabi llvm-19 (or
# another version).
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"
bench=$lqg_root/test/bench
# shellcheck source-path=SCRIPTDIR source=peers/build.sh
source "$bench/peers/build.sh"

update='' cores=()
for argument in "$@"; do
  case $argument in
    --update) update=yes ;;
    -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;;
    cortex-m4 | cortex-m7 | cortex-m55) cores+=("$argument") ;;
    *) lqg_stop "no core $argument: expected cortex-m4, cortex-m7 or cortex-m55" ;;
  esac
done
[ ${#cores[@]} -gt 0 ] || cores=(cortex-m4 cortex-m7 cortex-m55)
lqg_find_lqgen
mca=$(compgen -c llvm-mca | sort -V | tail -n 1)
[ -n "$mca" ] || lqg_stop "no llvm-mca: install Debian's package llvm"
lqg_has_command arm-none-eabi-gcc || lqg_stop "no arm-none-eabi-gcc: install Debian's package gcc-arm-none-eabi"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
unmoved='"no-schedule-insns", "no-tree-ter", "no-tree-pre"' moved='"no-tree-ter", "no-tree-pre"'

# The instructions of step, from those that objdump prints, as llvm-mca reads them: a nop for a branch. Step may stand
# within the function that calls it, which otherwise is the shorter one of the two.
listing_of_step() {
  arm-none-eabi-objdump -d --no-show-raw-insn "$1" | awk '
    function end() {
      if (count > most) longest = lines
      most = count > most ? count : most
      lines = ""; count = inside = 0
    }
    /^[0-9a-f]+ </ { end(); inside = /<sample>|_step[.>]/ }
    inside && /^ *[0-9a-f]+:\t/ {
      sub(/^[^\t]*\t/, ""); sub(/[ \t]*[@;].*/, ""); gsub(/\t/, " ")
      if (/^\./) next
      if (/^bx lr/) { end(); next }
      last = sub(/, ?pc}/, "}")
      if (/^(b|bl|bx|cbn?z|b[a-z][a-z])(\.[nw])? /) $0 = "nop"
      sub(/\.[nw] /, " ")
      if (/^vmov\.f32 [^,]*, #/) sub(/#.*/, "#1.0")
      lines = lines $0 "\n"; ++count
      if (last) end()
    }
    END { end(); printf "%s", longest }'
}

# cycles <core> <header> <options of GCC, or nothing for what is emitted>
cycles() {
  local options triple=thumbv7em-none-eabihf
  case $1 in
    cortex-m4) options=(-mfpu=fpv4-sp-d16) ;;
    cortex-m7) options=(-mfpu=fpv5-sp-d16) ;;
    cortex-m55) options=() triple=thumbv8.1m.main-none-eabihf ;;
  esac
  sed "${3:+s/pragma GCC optimize (.*)/pragma GCC optimize ($3)/}" "$2" >"$folder/model.h"
  {
    echo '#include "model.h"'
    echo "lqg_status_t sample(${name}_t *self, const float *y, float *u) { return ${name}_step(self, y, u); }"
  } >"$folder/sample.c"
  arm-none-eabi-gcc -mthumb "-mcpu=$1" "${options[@]}" -mfloat-abi=hard -O2 "-I$lqg_root/include" \
    -c "$folder/sample.c" -o "$folder/sample.o"
  {
    printf '.syntax unified\n.thumb\n'
    listing_of_step "$folder/sample.o"
  } | "$mca" "-mtriple=$triple" "-mcpu=$1" -iterations=1 -skip-unsupported-instructions=lack-sched 2>/dev/null |
    awk '/^Total Cycles:/ { print $3 }'
}

print_row() {
  local core=$1 emitted kept free
  emitted=$(cycles "$core" "$here/$2.h" "")
  kept=$(cycles "$core" "$here/$2.h" "$unmoved")
  free=$(cycles "$core" "$here/$2.h" "$moved")
  awk -v model="$name" -v what="$3" -v emitted="$emitted" -v kept="$kept" -v free="$free" 'BEGIN {
    better = kept < free ? kept : free
    printf "| %s | %s | %d | %d | %d | %.2f |\n", model, what, kept, free, emitted, emitted / better
  }'
}

print_core() {
  local design name kind here=$folder shipped=$lqg_root/codegen/designs
  printf '\n### %s\n\n| model | gain | kept | moved | as emitted | over the better one |\n' "$1"
  echo '| --- | --- | ---: | ---: | ---: | ---: |'
  for design in "$bench"/peers/models/*.toml "$shipped"/{double_integrator,dc_motor,two_mass,quadrotor}.toml; do
    name=$(sed -n '/^[[:space:]]*name *= *"\([a-z0-9_]*\)".*/{s//\1/p;q}' "$design")
    kind=constant
    emit plain '' unrolled
    print_row "$1" plain constant
    emit cheapest 'realisation = "cheapest"' unrolled
    cmp -s <(code_of plain) <(code_of cheapest) || print_row "$1" cheapest 'constant, cheapest'
    kind=carried
    emit plain '' unrolled
    print_row "$1" plain carried
  done
}

print_all() {
  printf "# The order of statements\n\n"
  echo "Made by \`test/bench/order.sh --update\`, which says what is measured, with"
  echo "$(arm-none-eabi-gcc --version | head -n 1), lqgen $("$LQGEN" --version | head -n 1) and" \
    "$("$mca" --version | sed -n 's/.*LLVM version/LLVM/p')."
  for core in "${cores[@]}"; do print_core "$core"; done
}

if [ -n "$update" ]; then
  print_all | tee "$folder/order.md"
  mv "$folder/order.md" "$bench/order.md"
else
  print_all
fi
