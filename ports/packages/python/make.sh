#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The Python wheel: lqgen, the C library and the module tinylqg.
#
#   make.sh <root of the source tree> <output folder>
#
# Writes tinylqg-<version>-py3-none-<platform>.whl. The lqgen in it is lqgen_portable, made
# of the objects of a build folder's lqgen: of LQG_BUILD; else of that whose codegen/lqgen LQGEN names; else of the one
# that all scripts share. LQG_LICENSES names the folder of codegen/cmake/licenses.cmake. The tools come from PyPI, those
# and only those whose hashes are in tools.txt.
set -euo pipefail
root=$(cd "$1" && pwd)
mkdir -p "$2"
output=$(cd "$2" && pwd)
source "$root/codegen/cmake/setup.sh"
source "$root/ports/packages/reproducible.sh"
here=$root/ports/packages/python

build=${LQG_BUILD:-}
if [ -z "$build" ] && [ -n "${LQGEN:-}" ]; then
  build=$(dirname "$(dirname "$(realpath "$LQGEN")")")
  [ -e "$build/CMakeCache.txt" ] ||
    lqg_stop "LQGEN: the wheel needs an lqgen with MPFR inside. Expected codegen/lqgen in a build folder, found $LQGEN"
fi
if [ -n "$build" ]; then
  lqg_compile "$build" --target lqgen_portable lqgen_libraries
else
  build=$lqg_build
  lqg_build_lqgen lqgen_portable lqgen_libraries
fi

tools=$output/tools
if ! cmp -s "$here/tools.txt" "$tools/installed"; then
  python3 -m venv --clear "$tools" || lqg_stop "Python cannot make a virtual environment (Debian: python3-venv)"
  "$tools/bin/python" -m pip install --quiet --require-hashes --only-binary :all: --requirement "$here/tools.txt" ||
    lqg_stop "pip cannot get the packages of $here/tools.txt from PyPI"
  cp "$here/tools.txt" "$tools/installed"
fi

# auditwheel gives the wheel the name of the oldest C library that it runs with.
plain=$output/plain
rm -rf "$plain" "$output"/*.whl
PATH=$tools/bin:$PATH "$tools/bin/python" -m pip wheel --quiet --no-deps --no-build-isolation \
  --config-settings=cmake.define.LQG_LQGEN_EXECUTABLE="$build/codegen/lqgen_portable" \
  --config-settings=cmake.define.LQG_LIBRARIES_EXECUTABLE="$build/codegen/lqgen_libraries" \
  ${LQG_LICENSES:+--config-settings=cmake.define.LQG_LICENSES="$LQG_LICENSES"} --wheel-dir "$plain" "$here"
PATH=$tools/bin:$PATH auditwheel repair --wheel-dir "$output" "$plain"/*.whl
rm -r "$plain"
