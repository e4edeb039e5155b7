#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Proves of the library's own estimators what README.md says, by Frama-C's Eva; fails when it cannot.
#
#   test/proof/prove_library.sh <folder for scratch> [option of the preprocessor]…
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd) root=$here/../..
scratch=$1
shift
source "$here/restate_library.sh"
stop() { echo "$*" >&2; exit 1; }

rm -rf "$scratch"
mkdir -p "$scratch"
restate_library "$scratch"
frama-c -eva -eva-precision 2 -eva-domains equality -eva-split-return full -eva-auto-loop-unroll 200 \
  -eva-min-loop-unroll 16 -warn-special-float none -machdep x86_64 \
  -cpp-extra-args="-I$scratch -I$here -I$root/include -include unknown.h $*" "$here/estimators.c" \
  "$scratch"/{kalman_ud,ekf,rls,factors,gate,plant,bounds_check,kernel}.c >"$scratch/eva.log" 2>&1 ||
  stop "$(tail -n 20 "$scratch/eva.log")"

grep -A 2 '^\[eva:alarm\]' "$scratch/eva.log" >&2 && stop "not proved; see $scratch/eva.log"
grep -q "^  0 alarms generated" "$scratch/eva.log" || stop "not proved; see $scratch/eva.log"
grep -Eq "Assertions +2 valid +0 unknown +0 invalid +2 total" "$scratch/eva.log" ||
  stop "not all checks were reached; see $scratch/eva.log"
echo "estimators: no undefined behaviour, estimates finite, those of the filter within its bounds"
