#!/usr/bin/env bash
# Processor in the loop: designs the balancing robot's controller, compiles it for a target, and lets it hold the robot that this
# machine simulates; prints what every sample took.
#
#   ports/pil/run.sh [port] [option]…                  a port that QEMU emulates; default: cortex-m4f
#   ports/pil/run.sh <port> --build                    only compiles: what to flash is build/pil/<port>/pil_target.bin
#   ports/pil/run.sh <port> --port DEVICE [option]…    a board that runs pil_target.bin, at a serial port such as /dev/ttyACM0
#
# The options are those at the top of host/main.c: --seconds S, --csv FILE, --svg FILE, --baud N, … FOLDER is where all work is
# done, default build/pil.
# LQGEN names an lqgen that is there already; otherwise one is built in build/, which the other scripts share. Debian's packages, for Arm:
# gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm; for RISC-V: gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf
# qemu-system-misc.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"

case " $* " in *" -h "* | *" --help "*) lqg_print_help "${BASH_SOURCE[0]}" && exit ;; esac

port=cortex-m4f
if [ $# -gt 0 ] && [[ $1 != -* ]]; then
  port=$1
  shift
fi
toolchain=$lqg_root/ports/$port/toolchain.cmake
folder=${FOLDER:-$lqg_root/build/pil}
host=$folder/host
target=$folder/$port

[ -f "$toolchain" ] || lqg_stop "There is no port $port: expected one of the folders of ports/ with a toolchain.cmake, as cortex-m4f"
compiler=arm-none-eabi-gcc
[[ $port != rv* ]] || compiler=riscv64-unknown-elf-gcc
lqg_has_command "$compiler" ||
  lqg_stop "There is no $compiler: the packages are named at the top of ports/pil/run.sh"

# build <folder> <cmake argument>…: configures and compiles
build() {
  local folder=$1
  shift
  { cmake -B "$folder" "$@" && cmake --build "$folder" --parallel "$(getconf _NPROCESSORS_ONLN)"; } >"$folder.log" 2>&1 || {
    tail -n 20 "$folder.log" >&2
    lqg_stop "The build failed: $folder.log"
  }
}

mkdir -p "$folder"
lqg_find_lqgen
build "$host" -S "$lqg_root/ports/pil" -DLQG_LQGEN_EXECUTABLE="$LQGEN"
build "$target" --toolchain "$toolchain" -S "$lqg_root/ports/pil/target" -DCONTROLLER="$host/controller"

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
