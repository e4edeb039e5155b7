#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the packages of the ecosystems, all or those that are named, each into a folder build/packages/NAME.
#
#   ports/packages/make.sh [NAME]…
#
# A package is a folder beside this file with a script make.sh <root of the source tree> <output folder>. LQGEN names an
# lqgen that is there already, OUTPUT another folder than build/packages.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
source "$root/codegen/cmake/setup.sh"
case ${1:-} in -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;; esac
output=${OUTPUT:-$root/build/packages}

if [ $# = 0 ]; then
  for script in "$here"/*/make.sh; do
    set -- "$@" "$(basename "$(dirname "$script")")"
  done
fi
for name in "$@"; do
  if [ ! -x "$here/$name/make.sh" ]; then
    echo "there is no package $name; there are: $(cd "$here" && echo */make.sh | sed 's:/make.sh::g')" >&2
    exit 2
  fi
  rm -rf "${output:?}/$name"
  "$here/$name/make.sh" "$root" "$output/$name"
  echo "$output/$name"
done
