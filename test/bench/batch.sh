#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What a sample of one instance takes by NAME_step and by NAME_batch_step (lqgen --only batch), on this PC: nanoseconds
# and their ratio, with vectors of SSE2, AVX2 and AVX-512 where the processor has them. All programs run in turn, five
# times; the best of each counts. Of the two ways of one row the arithmetic and the options are the same, and u is.
#
#   test/bench/batch.sh             prints the tables
#   test/bench/batch.sh --update    writes batch.md, too
#
# LQGEN names an lqgen that is there already. FOLDER is where all work is done, default build/bench-batch.
# Needs gcc and python3; clang-19 gets a table of its own where it is installed.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"
bench=$lqg_root/test/bench folder=${FOLDER:-$lqg_root/build/bench-batch} designs=$lqg_root/codegen/designs
lqg_find_lqgen
mkdir -p "$folder"
rounds=5

# add <row> <design file> <option of lqgen>...: a row of the tables.
rows=()
add() {
  local here=$folder/$1 name
  mkdir -p "$here"
  name=$(sed -n 's/^name *= *"\(.*\)"/\1/p' "$2" | head -n 1)
  "$LQGEN" "$2" -o "$here" --quiet --only h,batch --style unrolled "${@:3}"
  echo "$name" >"$here/name"
  rows+=("$1")
}

vectors_of_processor() {
  echo sse2
  grep -q ' avx2 ' /proc/cpuinfo && echo avx2
  grep -q ' avx512f ' /proc/cpuinfo && echo avx512
  return 0
}

options() {
  case $1 in
    sse2) echo -msse2 ;;
    avx2) echo -mavx2 -mfma ;;
    avx512) echo -mavx512f -mavx512dq -mavx512vl -mfma -mprefer-vector-width=512 ;;
  esac
}

compile() {
  local compiler=$1 row=$2 vectors=$3 here=$folder/$2 name real=float
  name=$(<"$here/name")
  if grep -q "^    double " "$here/$name.h"; then real=double; fi
  # shellcheck disable=SC2046  # options are several words
  "$compiler" -std=gnu99 -O2 $(options "$vectors") -I"$lqg_root/include" -I"$here" -DNAME="$name" \
    -DUPPER="${name^^}" -DREAL=$real "-DHEADER=\"${name}_batch.h\"" "$bench/batch.c" -lm -o "$here/$compiler-$vectors"
}

# Each row: nanoseconds by one, by the batch, ratio, of each kind of vectors.
table() {
  local compiler=$1 row vectors kinds round
  kinds=$(vectors_of_processor | tr "\n" " ")
  for row in "${rows[@]}"; do
    for vectors in $kinds; do compile "$compiler" "$row" "$vectors"; done
  done
  : >"$folder/times"
  for ((round = 0; round < rounds; round++)); do
    for row in "${rows[@]}"; do
      for vectors in $kinds; do echo "$row $vectors $("$folder/$row/$compiler-$vectors")" >>"$folder/times"; done
    done
  done
  printf '\n## %s, -O2\n\n' "$("$compiler" --version | head -n 1)"
  awk -v kinds="$kinds" -v rows="${rows[*]}" '
    { key = $1 " " $2
      if (!(key in alone) || $3 < alone[key]) alone[key] = $3
      if (!(key in batch) || $4 < batch[key]) batch[key] = $4
      if ($5 < 0.98) { print "not all samples of " key " are usual: " $5 > "/dev/stderr"; failed = 1 } }
    END {
      count = split(kinds, kind, " "); split(rows, row, " ")
      head = "| design |"; line = "| --- |"
      for (k = 1; k <= count; k++) {
        head = head " " kind[k] ": one, ns | batch, ns | ratio |"
        line = line " ---: | ---: | ---: |"
      }
      print head; print line
      for (r = 1; r in row; r++) {
        out = "| " row[r] " |"
        for (k = 1; k <= count; k++) {
          key = row[r] " " kind[k]
          out = out sprintf(" %.1f | %.2f | %.1f |", alone[key], batch[key], alone[key] / batch[key])
        }
        print out
      }
      exit failed
    }' "$folder/times"
}

# The design again in a file of its own, with an option of [code] more.
with_code() {
  cat "$1"
  echo "$2"
}

make_rows() {
  local kind states
  add two_mass "$designs/two_mass.toml"
  add two_mass-double "$designs/two_mass.toml" --real double
  with_code "$designs/two_mass.toml" 'realisation = "modal"' >"$folder/modal.toml"
  add two_mass-modal "$folder/modal.toml"
  add integrating_servo "$lqg_root/test/designs/integrating_servo.toml"
  add balancing_robot "$designs/balancing_robot.toml"
  for kind in chain dense; do
    for states in 2 4 8 12; do
      python3 "$bench/sizes.py" "$kind" "$states" unrolled >"$folder/$kind-$states.toml"
      add "$kind-$states" "$folder/$kind-$states.toml"
    done
  done
}

print() {
  echo "# A batch beside single steps"
  echo
  echo "Made by \`test/bench/batch.sh --update\`, which says what the columns mean, on one core of a"
  echo "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)."
  echo "chain-N and dense-N are filters of N states that carry P, with a law."
  table gcc
  if lqg_has_command clang-19; then table clang-19; fi
}

make_rows
if [ "${1:-}" = --update ]; then
  print | tee "$folder/batch.md"
  cp "$folder/batch.md" "$bench/batch.md"
else
  print
fi
