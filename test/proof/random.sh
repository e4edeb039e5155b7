#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Proves random designs in both styles; prints the first one that is not proved, and what was said of it. --try: without
# the prover, as prove.sh does.
#
#   test/proof/random.sh <random_design> <folder> <first seed> <last seed> [--try]
#
# LQGEN as for prove.sh. A design that lqgen refuses counts for nothing.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
random_design=$1 folder=$2 first=$3 last=$4
shift 4

mkdir -p "$folder"
proved=0
for ((seed = first; seed <= last; seed++)); do
  design=$folder/$seed.toml
  "$random_design" "$seed" >"$design"
  for style in unrolled compact; do
    status=0
    "$here/prove.sh" "$design" --style "$style" -o "$folder/$seed.$style" "$@" >"$folder/said.txt" 2>&1 || status=$?
    case $status in
      0) proved=$((proved + 1)) && echo "$seed: $(head -n 1 "$folder/said.txt")" ;;
      4) echo "$seed, $style: refused by lqgen" ;;
      *) cat "$folder/said.txt" >&2 && echo "$design, $style: exit status $status" >&2 && exit 1 ;;
    esac
  done
done
[ "$proved" -gt 0 ] || { echo "no design passed" >&2; exit 1; }
echo "$proved controllers passed"
