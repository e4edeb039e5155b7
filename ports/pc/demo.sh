#!/usr/bin/env bash
# Designs the balancing robot's controller from its design file, compiles what was emitted, and runs it in closed loop
# against the nonlinear robot with noise. Sets up what it needs.
#
#   ports/pc/demo.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"

folder=$lqg_root/build/demo
lqg_install_packages
mkdir -p "$lqg_root/build"
cmake -S "$lqg_root/ports/pc" -B "$folder" >"$folder.log" 2>&1 || lqg_stop "CMake could not configure $folder: $folder.log"
echo "Building lqgen and the demo in $folder (a few minutes the first time)"
cmake --build "$folder" --parallel "$(getconf _NPROCESSORS_ONLN)" >>"$folder.log" 2>&1 || lqg_stop "The build failed: $folder.log"

header=$folder/lqg/balancing_robot_demo/balancing_robot.h
echo
echo "lqgen made $header:"
sed -n '/Regulator/,/Style/p' "$header" | sed 's/^ \*/ /'
"$folder/tinylqg/codegen/lqgen" "$lqg_root/codegen/designs/balancing_robot.toml" -o "$folder" --only html --quiet
"$folder/balancing_robot_demo" "$folder/balancing_robot.svg"
echo "  What lqgen says of the design: $folder/balancing_robot.html"
