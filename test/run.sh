#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds TinyLQG and passes all its tests; sets up what it needs.
#
#   test/run.sh [--sanitize] [--firmware] [option of ctest]…        CC and CXX choose the compilers
#
# --sanitize builds with AddressSanitizer and UndefinedBehaviorSanitizer, --firmware leaves out the tests of lqgen's
# rooms. The build is in build/, or build-<compiler>-sanitize/ and so on.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../codegen/cmake/setup.sh"

case " $* " in *" -h "* | *" --help "*) lqg_print_help "${BASH_SOURCE[0]}" && exit ;; esac

# CMake gets Unity itself where its home can be reached.
upstream_is_reachable() {
  local script reachable=0
  script=$(mktemp)
  echo 'file(DOWNLOAD https://github.com STATUS status TIMEOUT 30)
    if(NOT status MATCHES "^0;")
      message(FATAL_ERROR "${status}")
    endif()' >"$script"
  cmake -P "$script" >/dev/null 2>&1 || reachable=1
  rm "$script"
  return $reachable
}

fetch_unity_from_pypi() {
  echo "Fetching Unity from PyPI"
  python3 -m pip --version >/dev/null 2>&1 || lqg_install python3-pip
  "$lqg_root/test/unity.sh" "$1" || lqg_stop "Unity can be had neither from github.com nor from PyPI (test/unity.txt)"
}

folder=$lqg_build
options=(-DLQG_BUILD_CODEGEN=ON -DLQG_BUILD_TESTS=ON)
if [ "${1:-}" = --sanitize ]; then
  shift
  folder+=-sanitize
  flags="-O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer"
  # In C++ not at every pointer: compiling the templates of Eigen and Boost takes twice the time with them, and what a
  # bad pointer reads or writes is found all the same.
  pointers="-fno-sanitize=null,alignment,object-size,vptr,nonnull-attribute,returns-nonnull-attribute"
  options+=(-DCMAKE_BUILD_TYPE=None "-DCMAKE_C_FLAGS=$flags" "-DCMAKE_CXX_FLAGS=$flags $pointers")
fi

if [ "${1:-}" = --firmware ]; then
  shift
  options+=(-DLQG_TEST_CODEGEN=OFF)
fi

lqg_install_packages

unity=$lqg_root/build/unity
if [ ! -e "$unity/src/unity.c" ] && ! upstream_is_reachable; then
  fetch_unity_from_pypi "$unity"
fi
if [ -e "$unity/src/unity.c" ]; then
  options+=("-DFETCHCONTENT_SOURCE_DIR_UNITY=$unity")
fi

lqg_configure "$folder" "${options[@]}"
lqg_compile "$folder"
exec ctest --test-dir "$folder" --output-on-failure --parallel "$(getconf _NPROCESSORS_ONLN)" "$@"
