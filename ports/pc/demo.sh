#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Designs the balancing robot's controller from its design file, compiles what was emitted, and runs it in closed loop
# against the nonlinear robot with noise. Sets up what it needs.
#
#   ports/pc/demo.sh [--help]
#
# LQGEN names an lqgen that is there already; otherwise one is built in build/, which the other scripts share.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"

case ${1:-} in
  '') ;;
  -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;;
  *) lqg_stop "Expected no argument but --help, found $1" ;;
esac

folder=$lqg_root/build/demo
lqg_find_lqgen
mkdir -p "$lqg_root/build"
cmake -S "$lqg_root/ports/pc" -B "$folder" -DLQG_LQGEN_EXECUTABLE="$LQGEN" >"$folder.log" 2>&1 ||
  lqg_stop "CMake could not configure $folder: $folder.log"
cmake --build "$folder" --parallel "$(getconf _NPROCESSORS_ONLN)" >>"$folder.log" 2>&1 ||
  lqg_stop "The build failed: $folder.log"

header=$folder/lqg/balancing_robot_demo/balancing_robot.h
echo
echo "lqgen made $header:"
sed -n '/Regulator/,/Style/p' "$header" | sed 's/^ \*/ /'
"$LQGEN" "$lqg_root/codegen/designs/balancing_robot.toml" -o "$folder" --only html --quiet
"$folder/balancing_robot_demo" "$folder/balancing_robot.svg"
echo "  What lqgen says of the design: $folder/balancing_robot.html"
