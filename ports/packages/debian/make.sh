#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The Debian package: lqgen, the C library, the design engine, the CMake package. What is in it says
# codegen/cmake/package.cmake.
#
#   make.sh <root of the source tree> <output folder>
#
# Writes tinylqg_<version>_<architecture>.deb. LQG_BUILD names a finished build folder of TinyLQG; without it everything
# is built in <output folder>/build.
set -euo pipefail
root=$(cd "$1" && pwd)
mkdir -p "$2"
output=$(cd "$2" && pwd)
source "$root/codegen/cmake/setup.sh"
source "$root/ports/packages/reproducible.sh"
lqg_has_command dpkg-shlibdeps || lqg_install dpkg-dev

build=${LQG_BUILD:-}
if [ -z "$build" ]; then
  lqg_install_packages
  build=$output/build
  lqg_configure "$build" -DLQG_BUILD_CODEGEN=ON -DLQG_BUILD_TESTS=OFF -DCMAKE_INSTALL_PREFIX=/usr
  lqg_compile "$build"
fi

rm -f "$output"/*.deb
# Everything is built: cpack, told that Ninja did it, does not ask make once more.
(cd "$build" && cpack -G DEB -B "$output" -D CPACK_CMAKE_GENERATOR=Ninja)
rm -rf "$output/_CPack_Packages"
