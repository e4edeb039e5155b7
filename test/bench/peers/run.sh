#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Instructions of one sample (update, u = −K x̂, predict) on an emulated Cortex-M4F at -O2, median of the samples: what
# lqgen emits, beside what others make of the same model, in float. Equal answers are checked first.
#
#   test/bench/peers/run.sh             prints the table
#   test/bench/peers/run.sh --update    writes record.md, too
#
# Contestants: Eigen, fixed sizes, the formulas of the textbook (eigen.cpp); CMSIS-DSP's matrix functions, the same
# formulas (cmsis.c); SymForce, which writes C++ for this model as lqgen writes C (symforce_code.py). Only the emitted
# code checks anything: measurements, bounds, resets. Models: shipped designs without limits, in filter form, with a
# constant gain, and with the covariance carried along.
#
# LQGEN names an lqgen that is there already. FOLDER is where all work is done, default build/bench-peers. CMSIS-DSP and
# SymForce come from PyPI, by hash. Debian's packages: gcc-arm-none-eabi libnewlib-arm-none-eabi
# libstdc++-arm-none-eabi-newlib qemu-system-arm libeigen3-dev python3-venv.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../../../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../../codegen/cmake/setup.sh"
bench=$lqg_root/test/bench peers=$lqg_root/test/bench/peers folder=${FOLDER:-$lqg_root/build/bench-peers}
# shellcheck source-path=SCRIPTDIR source=../cores.sh
source "$bench/cores.sh"

# That of balancing_robot is carried as U diag(d) Uᵀ only.
models=(constant:{double_integrator,dc_motor,two_mass,balancing_robot,quadrotor}
        carried:{double_integrator,dc_motor,two_mass,quadrotor})
contestants=(emitted cheapest eigen cmsis symforce)

fetch_peers() {
  cmsis=$folder/cmsis
  if [ ! -e "$cmsis/Include" ]; then
    mkdir -p "$cmsis"
    "$lqg_root/test/sdist.sh" setuptools.build_meta cmsisdsp 1.10.3 "$peers/cmsisdsp.txt" "$cmsis" 1
  fi
  python=$folder/venv/bin/python
  if ! "$python" -c 'import symforce' 2>/dev/null; then
    python3 -m venv --clear "$folder/venv"
    "$python" -m pip --quiet --disable-pip-version-check install --require-hashes --requirement "$peers/symforce.txt"
  fi
}

# design <name> <line of [kalman]…>: the shipped design without what the others do not have, in $here.
design() {
  local name=$1
  shift
  sed -e '/^\[\(limits\|require\)\]/,/^\[/{/^\[\(limits\|require\)\]/d;/^\[/!d}' \
    -e '/^\(gain\|covariance\|form\|gate\|spikes\|realisation\) *=/d' \
    -e "s/^\[kalman\]/&\n$1/" -e "s/^\[code\]/&\n${2:-}/" \
    "$lqg_root/codegen/designs/$name.toml" >"$here/$name.toml"
  "$LQGEN" "$here/$name.toml" -o "$here" --quiet --style unrolled --real float --only h,json
}

make_model() {
  if [ "$kind" = constant ]; then
    design "$1" 'gain = "steady"' 'realisation = "cheapest"'
    mv "$here/$1.h" "$here/cheapest.h"
    design "$1" 'gain = "steady"'
  else
    design "$1" 'gain = "online"\ncovariance = "plain"'
  fi
  "$python" "$peers/model.py" "$here/$1.json" "$kind" >"$here/model.h"
}

# build <contestant> <name>: $here/CONTESTANT.elf
build() {
  local flags=(-I"$here" '-DMODEL="model.h"' "-DNAME=$2")
  local cxx=("${compiler[0]/gcc/g++}" "${compiler[@]:1}" -std=c++17 -DNDEBUG)
  cxx+=(-fno-exceptions -fno-rtti -fno-threadsafe-statics)
  [ "$kind" = constant ] || flags+=(-DCARRIED)
  if [ "$1" = cheapest ]; then
    flags+=('-DHEADER="cheapest.h"')
    if grep -q "_advance(" "$here/cheapest.h"; then
      flags+=(-DKEEPS_Z)
      grep -q "_control(.* y\[" "$here/cheapest.h" || flags+=(-DPREDICTS)
    fi
  else
    flags+=("-DHEADER=\"$2.h\"")
  fi
  case $1 in
    emitted | cheapest) "${compiler[@]}" "${flags[@]}" -c "$peers/emitted.c" -o "$here/$1.o" ;;
    cmsis)
      # Without what CMSIS-DSP takes from CMSIS Core: intrinsics that these functions do not use.
      "${compiler[@]}" "${flags[@]}" -w -std=gnu11 -D__GNUC_PYTHON__ -DARM_MATH_LOOPUNROLL \
        -I"$cmsis/Include" -I"$cmsis/PrivateInclude" \
        -r -nostdlib "$peers/cmsis.c" "$cmsis"/Source/MatrixFunctions/arm_mat_{mult,inverse,trans,add,sub}_f32.c \
        "$cmsis"/Source/BasicMathFunctions/arm_{add,sub,negate,scale}_f32.c \
        "$cmsis"/Source/SupportFunctions/arm_{copy,fill}_f32.c -o "$here/$1.o"
      ;;
    eigen) "${cxx[@]}" "${flags[@]}" -isystem "$eigen" -c "$peers/eigen.cpp" -o "$here/$1.o" ;;
    symforce)
      "$python" "$peers/symforce_code.py" "$here/$2.json" "$kind" "$here/symforce" >/dev/null
      "${cxx[@]}" "${flags[@]}" -isystem "$eigen" -I"$here/symforce" -c "$peers/symforce.cpp" -o "$here/$1.o"
      ;;
  esac
  "${compiler[@]}" "${flags[@]}" -DWITH_SAMPLES -c "$peers/measure.c" -o "$here/measure.o"
  "${cxx[@]}" "$here/measure.o" "$folder"/{counter,startup}.o "$here/$1.o" "${linked[@]}" -lm -o "$here/$1.elf"
}

# count <contestant> <name>: prints the instructions, once the answers agree.
count() {
  local instructions error
  build "$@"
  # shellcheck disable=SC1090  # it has just been made
  source <(timeout 600 "${machine[@]}" "$here/$1.elf" || echo error=1000000)
  [ "$error" -lt 1000 ] || lqg_stop "$2, $kind: $1 answers something else, by $error millionths"
  echo "$instructions"
}

print() {
  local model kind name here counts contestant line
  echo "| model | gain | TinyLQG | its cheapest form | Eigen | CMSIS-DSP | SymForce |"
  echo "| --- | --- | ---: | ---: | ---: | ---: | ---: |"
  for model in "${models[@]}"; do
    kind=${model%:*} name=${model#*:} here=$folder/${model/:/-}
    mkdir -p "$here"
    make_model "$name"
    counts=()
    for contestant in "${contestants[@]}"; do
      if [ "$kind $contestant" = "carried cheapest" ]; then
        counts+=(–)
      else
        counts+=("$(count "$contestant" "$name")")
      fi
    done
    line=$(printf ' %s |' "${counts[@]}")
    echo "| $name | $kind |$line"
  done
}

eigen_version() {
  sed -n 's/^#define EIGEN_\(WORLD\|MAJOR\|MINOR\)_VERSION \([0-9]*\)/\2/p' "$eigen/Eigen/src/Core/util/Macros.h" |
    paste -s -d .
}

options=(-O2) eigen=/usr/include/eigen3
case ${1:-} in
  "" | --update) ;;
  -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;;
  *) lqg_stop "expected --update or nothing, found $1" ;;
esac
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
select_core cortex-m4f
absent=$(missing_tools)
[ -z "$absent" ] || lqg_stop "Not found:$absent"
lqg_find_lqgen
fetch_peers
"${compiler[@]}" "-DMEGAHERTZ=$megahertz" -c "$bench/counter_cortex-m.c" -o "$folder/counter.o"
"${compiler[@]}" -c "$startup" -o "$folder/startup.o"
print >"$folder/table.md"
if [ "${1:-}" = --update ]; then
  {
    echo "# Instructions of one sample, beside others"
    echo
    echo "Made by \`test/bench/peers/run.sh --update\`, which says what is compared:"
    echo "$("${compiler[0]}" --version | head -n 1), ${options[*]};"
    echo "Eigen $(eigen_version), CMSIS-DSP 1.10.3, SymForce 0.12.0."
    echo "Only TinyLQG checks what comes in and what it computes."
    echo
    cat "$folder/table.md"
  } >"$peers/record.md"
fi
cat "$folder/table.md"
