#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Compares every bit of every controller on the emulated cores as bits.build.… does on the PC: by gcc and clang, at all
# levels, in ISO and GNU mode, with LTO, as C++. The tests build for a target in one way only; this takes some ten
# minutes.
#
#   test/bits/targets.sh <a build with tests> [core]…       after test/run.sh: test/bits/targets.sh build
#
# WAYS=1 tries the first way of each core alone. Temporary files go below TMPDIR.
# Debian's packages: those of test/bench/run.sh, and clang-19.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"
# shellcheck source-path=SCRIPTDIR source=../bench/cores.sh
source "$lqg_root/test/bench/cores.sh"
[ -e "${1:-}/test/bits/controllers/controllers.h" ] || lqg_stop "expected a build with tests, found: ${1:-nothing}"
controllers=$(cd "$1" && pwd)/test/bits/controllers
shift
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

# Of clang, in place of those that only gcc knows.
clang_options() {
  if [ "$family" = riscv ]; then
    echo "--target=riscv$(port_value lqg_bits)-unknown-elf -mcmodel=medany" \
      "-isystem /usr/lib/picolibc/riscv64-unknown-elf/include"
  else
    echo "--target=arm-none-eabi -mthumb -fshort-enums -isystem /usr/lib/arm-none-eabi/include"
  fi
}

# compare <real> <contracts> <compiler> <options> [linker]: what the selected core has of it in hardware.
compare() {
  local kinds=plain_$1 contracts=OFF emulator
  ways=$((ways + 1))
  [ "$ways" -le "${WAYS:-$ways}" ] || return 0
  if [[ " $fused_reals " == *" $1 "* ]]; then
    kinds+="|fused_$1" contracts=$2
  fi
  if [[ "$core $1 $4" == "cortex-m0 double "*-O3* ]]; then
    echo "$core, $1, $3, -O3: left out, 526 KiB do not fit the microbit"
    return
  fi
  emulator=$(IFS='|' && echo "${machine[*]}")
  echo "$core, $1"
  cmake "-DCOMPILER=$3" "-DOPTIONS=$4" "-DLINKER=${5:-}" "-DLINK_OPTIONS=$work/startup.o ${linked[*]}" \
    "-DEMULATOR=$emulator" "-DKINDS=$kinds" "-DCONTRACTS=$contracts" "-DROOT=$lqg_root" "-DCONTROLLERS=$controllers" \
    "-DWORK=$work/build" "-DHASHES=$lqg_root/test/bits/hashes.txt" -P "$lqg_root/test/bits/build.cmake"
}

# clang takes its freedom to contract where it finds that fused operations are faster: not on a Cortex-M4.
options=()
[ $# -gt 0 ] || set -- "${every_core[@]}"
for core in "$@"; do
  select_core "$core"
  ways=0
  gcc="${compiler[*]:1}" clang="$(clang_options) ${cpu[*]} -ffunction-sections -I$lqg_root/include"
  link=$(IFS=';' && echo "${compiler[*]}")
  "${compiler[@]}" -c "$startup" -o "$work/startup.o"
  for real in float double; do
    compare $real OFF "${compiler[0]}" "$gcc -O0 -std=c99"
    compare $real OFF "${compiler[0]}" "$gcc -O1 -std=gnu11"
    compare $real ON "${compiler[0]}" "$gcc -O2 -std=gnu99 -flto"
    compare $real ON "${compiler[0]}" "$gcc -O3 -std=gnu99"
    compare $real OFF "${compiler[0]}" "$gcc -Os -std=c99"
    compare $real ON "${compiler[0]}" "$gcc -O2 -x c++ -fno-exceptions"
    compare $real OFF clang-19 "$clang -O0 -std=gnu11" "$link"
    compare $real OFF clang-19 "$clang -O1 -std=c99" "$link"
    compare $real OFF clang-19 "$clang -O3 -std=gnu99" "$link"
    compare $real OFF clang-19 "$clang -Os -x c++ -fno-exceptions" "$link"
  done
done
