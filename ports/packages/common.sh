# SPDX-License-Identifier: MIT
# For the make.sh of each package, which has the arguments <root of the source tree> <output folder>. To be sourced; it
# makes the output folder and gives
#
#   root, out                     the two arguments, out as an absolute path
#   version                       of include/lqg/version.h: 1.2.3
#   fill <template>               prints it with @VERSION@ and @URL@ filled in
#   copy_library <folder for *.c> <folder for lqg/*.h>
#   copy_mass <folder for the design> <folder for main.c and the controller>   the example mass.c
#   make_controller <design> <folder> <option of lqgen>…   NAME.h, by lqg_find_lqgen's
#   settle <folder>               its modes and times, at the end
set -euo pipefail
source "$1/codegen/cmake/setup.sh"
source "$(dirname "${BASH_SOURCE[0]}")/reproducible.sh"

root=$(cd "$1" && pwd)
[ -f "$root/include/lqg/version.h" ] || lqg_stop "$1 is not TinyLQG's source tree: no include/lqg/version.h"
mkdir -p "${2:?which output folder?}"
out=$(cd "$2" && pwd)

version=$(sed -nE 's/^#define LQG_VERSION_(MAJOR|MINOR|PATCH) ([0-9]+)$/\2/p' "$root/include/lqg/version.h" |
  paste -sd . -)
# The project's page, which manifests name. No registry takes a package with the stand-in.
url=${TINYLQG_URL:-https://tinylqg.invalid}

fill() { sed -e "s|@VERSION@|$version|g" -e "s|@URL@|$url|g" "$1"; }

copy_library() {
  mkdir -p "$1" "$2/lqg"
  cp "$root"/src/*.c "$root"/src/*.h "$1"
  cp "$root"/include/lqg/*.h "$2/lqg"
}

make_controller() {
  local design=$1 folder=$2
  shift 2
  lqg_find_lqgen
  "$LQGEN" "$design" -o "$folder" --only h --quiet "$@"
}

copy_mass() {
  mkdir -p "$1" "$2"
  cp "$root/ports/packages/mass.c" "$2/main.c"
  cp "$root/codegen/designs/double_integrator.toml" "$1"
  make_controller "$1/double_integrator.toml" "$2" --style compact
}
