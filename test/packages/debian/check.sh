#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the Debian package and looks into it; unpacks it to <folder>/root.
#
#   LQG_BUILD=<build> check.sh <root of the source tree> <folder> <lqgen of the build>
set -euo pipefail
root=$1 folder=$2 lqgen=$3

fail() {
  echo "$1" >&2
  exit 1
}

"$root/ports/packages/debian/make.sh" "$root" "$folder"
package=$(echo "$folder"/*.deb)
field() { dpkg-deb --field "$package" "$1"; }

version=$(sed -nE 's/^#define LQG_VERSION_(MAJOR|MINOR|PATCH) ([0-9]+)$/\2/p' "$root/include/lqg/version.h" |
  paste -sd .)
[ "$(basename "$package")" = "tinylqg_${version}_$(dpkg --print-architecture).deb" ] ||
  fail "The file is called $package"
[ "$(field Version)" = "$version" ] || fail "Version: expected $version, found $(field Version)"
[ "$(field Section)" = devel ] || fail "Section: expected devel, found $(field Section)"
for library in libc6 libmpfr6 libstdc++6; do
  field Depends | grep -q -F "$library (>= " || fail "Depends: expected $library, found $(field Depends)"
done
[[ $(field Maintainer) =~ ^[^\<]+\ \<[^@]+@[^@]+\>$ ]] ||
  fail "Maintainer: expected a name and <address>, found $(field Maintainer)"

rm -rf "$folder/root"
dpkg-deb -x "$package" "$folder/root"
usr=$folder/root/usr
grep -q "Copyright: 2026 TinyLQG contributors" "$usr/share/doc/tinylqg/copyright" || fail "copyright: no holder"
grep -q "MERCHANTABILITY" "$usr/share/doc/tinylqg/copyright" || fail "copyright: no licence"
for library in boost chart-js cli11 eigen fast-cpp-csv-parser gmp mbedtls mpfr nlohmann-json tomlplusplus; do
  grep -q -i "copyright" "$usr/share/doc/tinylqg/libraries/$library.copyright" ||
    fail "libraries: no licence of $library"
done
grep -q "Boost Software License" "$usr/share/doc/tinylqg/libraries/boost.copyright" ||
  fail "libraries: no licence of Boost"

# Once more, by somebody else: the same bytes.
(umask 077 && TZ=Pacific/Chatham LC_ALL=C.UTF-8 "$root/ports/packages/debian/make.sh" "$root" "$folder/again")
cmp "$package" "$folder/again/$(basename "$package")" || fail "The package made again is another"

# The packed lqgen is the build's, and its manual has every option.
design=$root/codegen/designs/two_mass.toml
mkdir -p "$folder/packed" "$folder/built"
"$usr/bin/lqgen" "$design" -o "$folder/packed" --quiet
"$lqgen" "$design" -o "$folder/built" --quiet
diff -r "$folder/packed" "$folder/built"
options=$("$usr/bin/lqgen" --help | grep -oE -- '(^|[ ,])--?[a-z]+(-[a-z]+)*' | tr -d ' ,' | sort -u)
[ "$(echo "$options" | wc -w)" -ge 7 ] || fail "--help: expected at least 7 options, found $options"
manual=$(gunzip --stdout "$usr/share/man/man1/lqgen.1.gz" | sed 's/\\-/-/g')
for option in $options; do
  grep -q -E -- "(^| |\")$option( |\"|\$)" <<<"$manual" || fail "lqgen.1: nothing about $option"
done

if command -v lintian >/dev/null; then
  lintian --allow-root --fail-on error,warning "$package"
else
  echo "Without lintian"
fi
