#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The worst sample of the shipped designs whose limits are foreseen: instructions of NAME_control in float.
#
#   test/bench/foresight/worst.sh              prints the table
#   test/bench/foresight/worst.sh --update     writes worst.md, too
#   test/bench/foresight/worst.sh --check      the Cortex-M4F at -Os alone: fails where a figure is more than 2 % above
#                                              worst.md
#
# Of random states, a million by default (STATES), from a quarter to 16 times as far as the limits, the PC finds the 32
# that take the most multiply-adds; bits are the same on all targets. In these, and in 32 in which no limit is in the
# way, QEMU counts the instructions of a core, exactly: the most of each. Fewer states can only find less.
#
# LQGEN names an lqgen that is there already, in a build folder. FOLDER is where all work is done, default
# build/bench-worst. Needs gcc, python3 and what test/bench/run.sh needs for these cores.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../../../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../../codegen/cmake/setup.sh"
bench=$lqg_root/test/bench here=$lqg_root/test/bench/foresight
folder=${FOLDER:-$lqg_root/build/bench-worst} states=${STATES:-1000000}
# shellcheck source-path=SCRIPTDIR source=../cores.sh
source "$bench/cores.sh"
record=$here/worst.md names=(two_mass_limits slewing_servo quadrotor_tilt)
ways=("cortex-m4f -O2" "cortex-m4f -Os" "cortex-m33 -O2" "cortex-m7 -O2" "cortex-m55 -O2" "rv32f -O2")

task=print
case ${1:-} in
  --update | --check) task=${1#--} ;;
  -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;;
  '') ;;
  *) lqg_stop "expected --update or --check, found $1" ;;
esac
[ "$task" != check ] || ways=("cortex-m4f -Os")
lqg_find_lqgen

find_states() {
  local name
  for name in "${names[@]}"; do
    mkdir -p "$folder/$name"
    (cd "$folder/$name" && python3 -B "$here/worst.py" "$(dirname "$LQGEN")/.." "$lqg_root/codegen/designs/$name.toml" \
      "$states") || lqg_stop "no states of $name"
  done
}

# measure <name> <core> <level>: sets idle and most.
measure() {
  local name=$1 options=("$3" -std=c99) arithmetic=() work=$folder/$1/$2$3
  select_core "$2"
  rm -rf "$work"
  mkdir -p "$work"
  ! grep -q '^arithmetic *= *"fused"' "$lqg_root/codegen/designs/$name.toml" || arithmetic=(-DLQG_FUSED)
  (cd "$work" && "${compiler[@]}" "${arithmetic[@]}" "-DMEGAHERTZ=$megahertz" -I"$folder/$name" "-DHEADER=\"$name.h\"" \
    "-DNAME=$name" "-DUPPER_NAME=${name^^}" -DREAL=float -c "$here/worst_on_target.c" "$bench/counter_$family.c" \
    "$startup" "$lqg_root"/src/{mpc,kernel}.c && "${compiler[@]}" ./*.o "${linked[@]}" -lm -o worst.elf)
  timeout 300 "${machine[@]}" "$work/worst.elf" >"$work/measured" || lqg_stop "$core, $name: the measurement failed"
  # shellcheck disable=SC1091  # it has just been made
  source "$work/measured"
}

table() {
  local name way core level idle most
  echo "| core | design | no limit in the way | worst |"
  echo "| --- | --- | ---: | ---: |"
  for way in "${ways[@]}"; do
    read -r core level <<<"$way"
    for name in "${names[@]}"; do
      measure "$name" "$core" "$level"
      echo "| $core, $level | $name | $idle | $most |"
    done
  done
}

absent=$(for way in "${ways[@]}"; do options=() && select_core "${way% *}" && missing_tools; done)
if [ -n "$absent" ]; then
  [ "$task" = check ] || lqg_stop "Not found:$absent"
  echo "Nothing to compare: no$absent" && exit
fi

compilers() {
  for way in "cortex-m4f" "rv32f"; do
    options=() && select_core "$way" && "${compiler[0]}" --version | head -n 1
  done
}
mkdir -p "$folder"
find_states
table | tee "$folder/table.md"
case $task in
  update)
    {
      printf '# The worst sample of designs whose limits are foreseen\n\n'
      printf "Instructions of control, in float. Made by \`test/bench/foresight/worst.sh --update\`, which says what\n"
      printf 'the columns mean, with %d states of each design.\n\n' "$states"
      compilers | sed 's/^/- /' && echo
      cat "$folder/table.md"
    } >"$record"
    ;;
  check)
    grep -qF "$(compilers | head -n 1)" "$record" || { echo "Nothing to compare: another compiler" && exit; }
    awk -F ' *[|] *' 'NR == FNR { if ($5 + 0 > 0) { idle[$2 $3] = $4; most[$2 $3] = $5 } next }
      $5 + 0 > 0 && (!(($2 $3) in most) || $4 > 1.02 * idle[$2 $3] || $5 > 1.02 * most[$2 $3]) {
        print "More than the record has: " $0; failed = 1
      }
      END { exit failed }' "$record" "$folder/table.md" ||
      lqg_stop "If it is meant: test/bench/foresight/worst.sh --update"
    ;;
esac
