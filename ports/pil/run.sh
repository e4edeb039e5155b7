#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Processor in the loop: designs the balancing robot's controller, compiles it for a target, and lets it hold the robot
# that this machine simulates; prints what every sample took.
#
#   ports/pil/run.sh [port] [DESIGN.toml] [option]…                  a port that QEMU emulates; default: cortex-m4f
#   ports/pil/run.sh <port> [DESIGN.toml] --build                    only compiles: what to flash is
#                                                                    build/pil/<port>/pil_target.bin
#   ports/pil/run.sh <port> [DESIGN.toml] --port DEVICE [option]…    a board that runs pil_target.bin, at a serial port
#                                                                    such as /dev/ttyACM0
#
# With a design file the target hears what the sensors say in the first 200 samples of the design's test, r being 0, and
# has to find the bits of this machine. The design has a filter and a regulator, and its real is float.
#
# FOLDER is where all work is done, default build/pil. The options are those at the top of host/main.c: --seconds S,
# --csv FILE, --svg FILE, --baud N, … LQGEN names an lqgen that is there already; otherwise one is built in build/,
# which the other scripts share. Debian's packages, for Arm: gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm;
# for RISC-V: gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf qemu-system-misc.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"

case " $* " in *" -h "* | *" --help "*) lqg_print_help "${BASH_SOURCE[0]}" && exit ;; esac

port=cortex-m4f
if [ $# -gt 0 ] && [[ $1 != -* && $1 != *.toml ]]; then
  port=$1
  shift
fi
design=''
if [ $# -gt 0 ] && [[ $1 == *.toml ]]; then
  [ -f "$1" ] || lqg_stop "There is no design file $1"
  design=$(realpath "$1")
  shift
fi
toolchain=$lqg_root/ports/$port/toolchain.cmake
folder=${FOLDER:-$lqg_root/build/pil}
host=$folder/host
target=$folder/$port

[ -f "$toolchain" ] ||
  lqg_stop "There is no port $port: expected one of the folders of ports/ with a toolchain.cmake, as cortex-m4f"
compiler=arm-none-eabi-gcc
[[ $port != rv* ]] || compiler=riscv64-unknown-elf-gcc
lqg_has_command "$compiler" ||
  lqg_stop "There is no $compiler: the packages are named at the top of ports/pil/run.sh"

# build <folder> <cmake argument>…: configures and compiles
build() {
  local folder=$1
  shift
  {
    cmake -B "$folder" "$@" && cmake --build "$folder" --parallel "$(getconf _NPROCESSORS_ONLN)"
  } >"$folder.log" 2>&1 || {
    tail -n 20 "$folder.log" >&2
    lqg_stop "The build failed: $folder.log"
  }
}

# What the sensors say in the design's test, as samples.h.
cut_samples() {
  local made=$host/samples
  rm -rf "$made"
  mkdir -p "$made"
  "$LQGEN" "$design" -o "$made" --only h,test --style unrolled --quiet || lqg_stop "lqgen refuses $design"
  sed -n '/^static const float y_in\[/,/^};/p' "$made"/*_test.c >"$made/samples.h"
  [ -s "$made/samples.h" ] && grep -q '_control(.* u\[' "$made"/*.h && grep -q '_predict(' "$made"/*.h ||
    lqg_stop "$design: expected a filter with a regulator, and real = \"float\", found another controller"
  options=(-DLQG_PIL_DESIGN="$design" -DLQG_PIL_SAMPLES="$made")
}

mkdir -p "$folder"
options=(-ULQG_PIL_DESIGN -ULQG_PIL_SAMPLES)
lqg_find_lqgen
[ -z "$design" ] || cut_samples
build "$host" -S "$lqg_root/ports/pil" -DLQG_LQGEN_EXECUTABLE="$LQGEN" "${options[@]}"
build "$target" --toolchain "$toolchain" -S "$lqg_root/ports/pil/target" -DCONTROLLER="$host/controller" "${options[@]}"

case " $* " in
  *" --build "*) echo "$target/pil_target.bin" ;;
  *" --port "*) exec "$host/pil" "$@" ;;
  *)
    [ -f "$target/emulate.sh" ] ||
      lqg_stop "No QEMU for $port, or it is not installed. For a board: ports/pil/run.sh $port --port DEVICE"
    echo "$port in QEMU:"
    exec "$host/pil" "$@" -- "$target/emulate.sh"
    ;;
esac
