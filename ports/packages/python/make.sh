#!/usr/bin/env bash
# The Python wheel: lqgen, the C library and the module tinylqg.
#
#   make.sh <root of the source tree> <output folder>
#
# Writes tinylqg-<version>-py3-none-<platform>.whl. LQG_BUILD names a build folder of TinyLQG whose lqgen may be taken;
# without it everything is built in <output folder>/build. LQG_LICENSES names the folder of codegen/cmake/licenses.cmake. The tools come from PyPI, those and only those whose hashes are in
# tools.txt.
set -euo pipefail
root=$(cd "$1" && pwd)
mkdir -p "$2"
output=$(cd "$2" && pwd)
source "$root/codegen/cmake/setup.sh"
source "$root/ports/packages/reproducible.sh"
here=$root/ports/packages/python

build=${LQG_BUILD:-}
if [ -z "$build" ]; then
  lqg_install_packages
  build=$output/build
  lqg_configure "$build" -DLQG_BUILD_CODEGEN=ON -DLQG_BUILD_TESTS=OFF
fi
lqg_compile "$build" --target lqgen_portable lqgen_libraries

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
