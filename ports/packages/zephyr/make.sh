#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The Zephyr module: a folder for the manifest of west, or for ZEPHYR_EXTRA_MODULES.
#
#   make.sh <root of the source tree> <output folder>
source "$(dirname "${BASH_SOURCE[0]}")/../common.sh"
here=$(dirname "${BASH_SOURCE[0]}")

copy_library "$out/src" "$out/include"
cp "$root/LICENSE" "$out"
fill "$root/ports/packages/package.md" >"$out/README.md"
cp -R "$here/zephyr" "$out"
mkdir -p "$out/samples"
cp -R "$here/mass" "$out/samples"
copy_mass "$out/samples/mass" "$out/samples/mass/src"
settle "$out"
