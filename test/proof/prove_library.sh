#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Proves of the library's own estimators, of its law with limits, and of its elementary functions, what README.md says,
# by Frama-C's Eva; fails when it cannot.
#
#   test/proof/prove_library.sh <folder for scratch> [option of the preprocessor]…
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd) root=$here/../..
scratch=$1
shift
options=$*
source "$here/restate_library.sh"
stop() { echo "$*" >&2; exit 1; }

rm -rf "$scratch"
mkdir -p "$scratch"
restate_library "$scratch"
restate_functions "$scratch/functions"

# prove <driver> <number of its checks> <what is proved> <source>…; `parts` are more options of the preprocessor
prove() {
  local name=$1 checks=$2 proved=$3
  shift 3
  frama-c -eva -eva-precision 2 -eva-domains equality -eva-split-return full -eva-auto-loop-unroll 200 \
    -eva-min-loop-unroll 16 -warn-special-float none -machdep x86_64 \
    -cpp-extra-args="$parts -I$scratch -I$here -I$root/include -include unknown.h $options" "$here/$name.c" \
    "${@/#/$scratch/}" >"$scratch/$name.log" 2>&1 || stop "$(tail -n 20 "$scratch/$name.log")"

  grep -A 2 '^\[eva:alarm\]' "$scratch/$name.log" >&2 && stop "not proved; see $scratch/$name.log"
  grep -q "^  0 alarms generated" "$scratch/$name.log" || stop "not proved; see $scratch/$name.log"
  grep -Eq "Assertions +$checks valid +0 unknown +0 invalid +$checks total" "$scratch/$name.log" ||
    stop "not all checks were reached; see $scratch/$name.log"
  echo "$name: no undefined behaviour, $proved"
}

parts=
prove estimators 2 "estimates finite, those of the filter within its bounds" \
  {kalman_ud,ekf,rls,factors,gate,plant,bounds_check,kernel}.c
prove limits 1 "inputs finite and within their limits" {mpc,kernel}.c
prove functions 0 "with any bits of the arguments"
parts="-DPARTS -I$scratch/functions"
prove functions 2 "results within their limits"
