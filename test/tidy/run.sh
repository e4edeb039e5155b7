#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# clang-tidy 19 over the library and lqgen, as .clang-tidy says; a finding is an error.
#
#   test/tidy/run.sh <build folder of its own> [regular expression of the units to look at]
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"
folder=$1 chosen=${2:-}
for tool in clang-19 clang++-19 clang-tidy-19 python3; do
  lqg_has_command "$tool" || { echo "Not found: $tool" && exit; }
done

# Without precompiled headers, which only their own compiler reads.
CC=clang-19 CXX=clang++-19 lqg_configure "$folder" -DLQG_BUILD_CODEGEN=ON -DLQG_BUILD_TESTS=OFF \
  -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >"$folder.log"

# Each unit once: a file of the library is compiled for each of its variants.
units=$(python3 - "$folder/compile_commands.json" "$chosen" <<'END'
import json
import re
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    units = sorted({entry["file"] for entry in json.load(file)})
print("\n".join(unit for unit in units if re.search(sys.argv[2], unit)))
END
)
[ -n "$units" ] || lqg_stop "no unit is called $chosen"
# tidy <ending> [option…]: the units that end so. The C headers are looked at as C: as C++ they would be asked for
# `using`.
tidy() {
  local ending=$1
  shift
  { grep "\.$ending\$" <<<"$units" || true; } | xargs -r -n 1 -P "$(getconf _NPROCESSORS_ONLN)" \
    clang-tidy-19 --config-file="$lqg_root/.clang-tidy" -p "$folder" --quiet "$@"
}
tidy c
tidy cpp --header-filter='/codegen/[^ ]*$'
tidy cxx --header-filter='/codegen/[^ ]*$'
