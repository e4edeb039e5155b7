#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The ESP-IDF component: the folder tinylqg, for a project's folder components, or packed by compote.
#
#   make.sh <root of the source tree> <output folder>
source "$(dirname "${BASH_SOURCE[0]}")/../common.sh"
here=$(dirname "${BASH_SOURCE[0]}") component=$out/tinylqg

copy_library "$component/src" "$component/include"
cp "$root/LICENSE" "$here/CMakeLists.txt" "$here/Kconfig" "$component"
fill "$here/idf_component.yml" >"$component/idf_component.yml"
fill "$root/ports/packages/package.md" >"$component/README.md"
mkdir -p "$component/examples"
cp -R "$here/mass" "$component/examples"
copy_mass "$component/examples/mass" "$component/examples/mass/main"
settle "$out"
