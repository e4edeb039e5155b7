#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The PlatformIO library: its folder is what `pio pkg pack` packs, and what lib_deps may name.
#
#   make.sh <root of the source tree> <output folder>
source "$(dirname "${BASH_SOURCE[0]}")/../common.sh"
here=$(dirname "${BASH_SOURCE[0]}") example=$out/examples/mass

copy_library "$out/src" "$out/include"
cp "$root/LICENSE" "$out"
fill "$root/ports/packages/package.md" >"$out/README.md"
fill "$here/library.json" >"$out/library.json"
mkdir -p "$out/examples"
cp -R "$here/mass" "$out/examples"
copy_mass "$example" "$example/src"
settle "$out"
