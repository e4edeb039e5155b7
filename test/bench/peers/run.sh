#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What one sample costs (update, u = −K x̂, predict) in float at -O2: what lqgen emits, beside what others make of the
# same model. Equal answers are checked first.
#
#   test/bench/peers/run.sh [core]… [model]… [DESIGN.toml]…     prints the tables
#   test/bench/peers/run.sh --update                            writes record.md and record.svg, too
#
# A core is one of cortex-m0, cortex-m3, cortex-m4f, cortex-m7 and x86-64; without any it is all five. A model is the
# name of a design file in models/ (plants of this benchmark's own) or in codegen/designs/, or a design file of the
# user's; without any it is all of models/ and five of the shipped ones. Limits, gates and requirements are left out,
# because the others have none; the filter is in filter form, once with a constant gain and once with the covariance
# carried along. What lqgen refuses in this form is left out, with a message.
#
# Contestants. TinyLQG: `step` of the emitted header in straight lines (plain), the same with fused multiply-adds where
# the hardware has them, its cheapest form (`realisation`), and its compact style. Eigen, fixed sizes: the better one of
# the textbook (eigen.cpp) and of what we could make of it (eigen_tuned.cpp). CMSIS-DSP's matrix functions (cmsis.c).
# SymForce, which writes C++ for this model as lqgen writes C (symforce_code.py). The compiler fuses multiply-adds of
# all but TinyLQG where it can. Only the emitted code checks anything: measurements, bounds, resets.
#
# Measures. Instructions: counted by QEMU, exactly; the median of 301 samples. Cycles: estimated for the Cortex-M4F,
# see cycles.py. Flash and RAM: what the linker brings for the two functions of a contestant. Stack: the deepest reach
# below the caller. x86-64: time of a sample as a ratio to that of TinyLQG's plain code, medians of 201 rounds in which
# all contestants take turns (race.c).
#
# LQGEN names an lqgen that is there already. FOLDER is where all work is done, default build/bench-peers; what has not
# changed since the last run there is not measured again, except for times. From nothing it takes some 20 minutes of
# processor time, and a minute for times alone. CMSIS-DSP, SymForce and the tools come from PyPI, by hash. Debian's
# packages: gcc-arm-none-eabi libnewlib-arm-none-eabi libstdc++-arm-none-eabi-newlib qemu-system-arm libeigen3-dev
# python3-venv g++.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../../../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../../codegen/cmake/setup.sh"
bench=$lqg_root/test/bench peers=$lqg_root/test/bench/peers folder=${FOLDER:-$lqg_root/build/bench-peers}
# shellcheck source-path=SCRIPTDIR source=../cores.sh
source "$bench/cores.sh"
# shellcheck source-path=SCRIPTDIR source=build.sh
source "$peers/build.sh"

peer_cores=(cortex-m0 cortex-m3 cortex-m4f cortex-m7 x86-64)
shipped=(double_integrator dc_motor two_mass balancing_robot quadrotor)

# ---- many things at once -----------------------------------------------------------------------------------------

running=0

start() {
  [ $running -lt "$(getconf _NPROCESSORS_ONLN)" ] || wait_for_one
  "$@" &
  running=$((running + 1))
}

wait_for_one() {
  wait -n || exit 1
  running=$((running - 1))
}

wait_for_all() {
  while [ $running -gt 0 ]; do
    wait_for_one
  done
}

# each_model <command> [argument]…: with design, name, kind and here; without what lqgen refuses once it is known.
each_model() {
  local design name kind here
  for design in "${designs[@]}"; do
    name=$(sed -n '/^[[:space:]]*name *= *"\([a-z0-9_]*\)".*/{s//\1/p;q}' "$design")
    for kind in constant carried; do
      here=$folder/models/$name-$kind
      mkdir -p "$here"
      "$@"
    done
  done
}

# ---- the measurement ---------------------------------------------------------------------------------------------

# measure_on_core <contestant>: its results as assignments.
measure_on_core() {
  local flags results error instructions traced off
  compile "$1"
  "${cxx[@]}" "$made.o" "$work/no_memory.o" "${linked[@]}" -Wl,-e,peer_sample,-u,peer_init "$library" -lm \
    -o "$made.footprint.elf"
  flags_of_model
  "${compiler[@]}" "${flags[@]}" -DWITH_SAMPLES -c "$peers/measure.c" -o "$made.measure.o"
  "${cxx[@]}" "$made.measure.o" "$work"/{counter,startup,no_memory}.o "$made.o" "${linked[@]}" "$library" -lm \
    -o "$made.elf"
  results=$(timeout 900 "${machine[@]}" "$made.elf") || lqg_stop "$core, $name, $kind: $1 does not end well"
  if [ "$core" = cortex-m4f ]; then
    results+=$'\n'$("$python" "$peers/cycles.py" "$made.elf")
  fi
  # shellcheck disable=SC1090  # it has just been made
  source <(echo "$results")
  [ "$error" -lt 1000 ] || lqg_stop "$core, $name, $kind: $1 answers something else, by $error millionths"
  off=$((20 * (${traced:-$instructions} - instructions)))
  [ "${off#-}" -lt "$instructions" ] || # more than 5 %
    lqg_stop "$core, $name, $kind, $1: QEMU counts $instructions instructions, cycles.py traces $traced"
  echo "$results"
  print_sections flash 'text|rodata|data|ARM.exidx' "$made.footprint.elf"
  print_sections ram 'data|bss' "$made.footprint.elf"
}

build_for_pc() {
  compile "$1"
  gcc -shared "$made.o" "$library" -lm -o "$made.so"
}

# renew <contestant> <command>: $made.txt, unless it stands for all that goes into it.
renew() {
  local made=$here/$core/$1 library key
  key=$(key_of "$1")
  [ "$key" != "$(cat "$made.key" 2>/dev/null)" ] || return 0
  "$2" "$1" >"$made.txt"
  echo "$key" >"$made.key"
}

measure_model() {
  local contestants contestant command=measure_on_core
  [ -e "$here/plain.h" ] || return 0
  [ "$core" != x86-64 ] || command=build_for_pc
  mkdir -p "$here/$core"
  contestants_of_core
  for contestant in "${contestants[@]}"; do
    start renew "$contestant" $command
  done
}

# print_results: lines "core model kind contestant measure value".
print_results() {
  local contestants contestant
  [ -e "$here/plain.h" ] || return 0
  contestants_of_core
  if [ "$core" = x86-64 ]; then
    print_race
    return
  fi
  for contestant in "${contestants[@]}"; do
    sed -n "s/^\([a-z]*\)=\(.*\)/$core $name $kind $contestant \1 \2/p" "$here/$core/$contestant.txt"
  done
}

print_race() {
  local flags contestant ns ratio error arguments=()
  flags_of_model
  gcc -O2 "${flags[@]}" -DWITH_SAMPLES "$peers/race.c" -ldl -o "$here/$core/race"
  for contestant in "${contestants[@]}"; do
    arguments+=("$contestant=$here/$core/$contestant.so")
  done
  "$here/$core/race" "${arguments[@]}" >"$here/$core/raced"
  while read -r contestant ns ratio error; do
    [ "$error" -lt 1000 ] || lqg_stop "$core, $name, $kind: $contestant answers something else, by $error millionths"
    echo "$core $name $kind $contestant ns $ns"
    echo "$core $name $kind $contestant ratio $ratio"
  done <"$here/$core/raced"
}

measure() {
  local core
  each_model start make_model
  wait_for_all
  for core in "${cores[@]}"; do
    select_target "$core"
    compile_once
    each_model measure_model
  done
  wait_for_all
  for core in "${cores[@]}"; do
    select_target "$core"
    each_model print_results
  done >"$folder/results.txt"
}

# ---- the command line --------------------------------------------------------------------------------------------

eigen_version() {
  sed -n 's/^#define EIGEN_\(WORLD\|MAJOR\|MINOR\)_VERSION \([0-9]*\)/\2/p' "$eigen/Eigen/src/Core/util/Macros.h" |
    paste -s -d .
}

print_versions() {
  echo "Made by \`test/bench/peers/run.sh --update\`, which says what is compared and measured, with"
  echo "$(arm-none-eabi-gcc --version | head -n 1) and $(gcc --version | head -n 1), ${options[*]};"
  echo "lqgen $("$LQGEN" --version | head -n 1), Eigen $(eigen_version), CMSIS-DSP $cmsis_version," \
    "SymForce $(sed -n 's/^symforce==\([0-9.]*\).*/\1/p' "$peers/requirements.txt")."
  printf '\n![What TinyLQG needs over what the best of the others needs, for each model](record.svg)\n'
}

options=(-O2) eigen=/usr/include/eigen3 update='' cores=() designs=()
for argument in "$@"; do
  case $argument in
    --update) update=yes ;;
    -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;;
    *.toml)
      [ -e "$argument" ] || lqg_stop "no design file $argument"
      designs+=("$(realpath "$argument")")
      ;;
    *)
      if [[ " ${peer_cores[*]} " == *" $argument "* ]]; then
        cores+=("$argument")
      elif [ -e "$peers/models/$argument.toml" ]; then
        designs+=("$peers/models/$argument.toml")
      elif [ -e "$lqg_root/codegen/designs/$argument.toml" ]; then
        designs+=("$lqg_root/codegen/designs/$argument.toml")
      else
        lqg_stop "expected --update, a core (${peer_cores[*]}), a model or a design file, found $argument"
      fi
      ;;
  esac
done
[ -z "$update" ] || [ $# = 1 ] || lqg_stop "--update writes the record of all cores and models: expected nothing else"
[ ${#cores[@]} -gt 0 ] || cores=("${peer_cores[@]}")
if [ ${#designs[@]} = 0 ]; then
  shipped=("${shipped[@]/#/$lqg_root/codegen/designs/}")
  designs=("$peers"/models/*.toml "${shipped[@]/%/.toml}")
fi
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
select_core cortex-m4f
absent=$(missing_tools)
[ -z "$absent" ] || lqg_stop "Not found:$absent"
lqg_find_lqgen
fetch_cmsis
fetch_python
measure
"$python" "$peers/tables.py" "$folder/results.txt" >"$folder/tables.md"
if [ -n "$update" ]; then
  { echo "# One sample, beside others" && echo && print_versions && echo && cat "$folder/tables.md"; } \
    >"$peers/record.md"
  "$python" "$peers/plot.py" "$folder/results.txt" "$peers/record.svg"
fi
cat "$folder/tables.md"
