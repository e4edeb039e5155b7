#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The whole library in one file, tinylqg.h, and beside it lqg/*.h of one line each, which lead the emitted headers
# there.
#
#   make.sh <root of the source tree> <output folder>
source "$(dirname "${BASH_SOURCE[0]}")/../common.sh"
here=$(dirname "${BASH_SOURCE[0]}")

# In the order in which they need each other.
public=(arithmetic status version functions_bits functions_polynomials functions_float functions_double functions kalman
        lqr mpc loop ekf rls servo lqg check)
private=(kernel bounds_check covariance factors gate plant)

check_names() {
  local folder=$1 expected
  shift
  expected=$(printf '%s.h\n' "$@" | sort)
  [ "$expected" = "$(cd "$folder" && printf '%s\n' *.h | sort)" ] ||
    lqg_stop "$folder has other headers than the script expects: $*"
}
check_names "$root/include/lqg" "${public[@]}"
check_names "$root/src" "${private[@]}"


# A file without its licence, which stands at the end, and its includes of other files of the library.
body_of() { sed "/SPDX-License-Identifier/d; /^#include \"/d" "$1"; }

# The static functions of a file become lqg_static_FILE_NAME: in one file they are beside those of other files and of
# the user. A name is what stands before a parenthesis, but not after . or ->, which is a member.
static_names() { sed -n 's/^static .*[ *]\([a-z_A-Z0-9]*\)(.*/\1/p' "$1" | sort -u; }
renaming() {
  local name
  for name in $(static_names "$1"); do
    echo "s/(?<![\\w.>])$name(?=\\()/lqg_static_$(basename "${1%.*}")_$name/g;"
  done
}

{
  fill "$here/introduction.h"
  for name in "${public[@]}"; do
    body_of "$root/include/lqg/$name.h"
  done
  echo
  echo '#ifdef LQG_IMPLEMENTATION'
  echo '#ifndef LQG_IMPLEMENTED'
  echo '#define LQG_IMPLEMENTED'
  everywhere=$(for name in "${private[@]}"; do renaming "$root/src/$name.h"; done)
  for file in "${private[@]/%/.h}" $(cd "$root/src" && printf '%s\n' *.c); do
    echo
    body_of "$root/src/$file" | perl -pe "$everywhere $(renaming "$root/src/$file")"
  done
  echo
  echo '#endif'
  echo '#endif'
  echo
  echo '/*'
  cat "$root/LICENSE"
  echo '*/'
} >"$out/tinylqg.h"

mkdir -p "$out/lqg"
for name in "${public[@]}"; do
  echo '#include "../tinylqg.h"' >"$out/lqg/$name.h"
done
settle "$out"
