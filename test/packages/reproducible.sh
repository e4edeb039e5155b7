#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes the packages again from a copy of the tree that another person checked out, elsewhere, at another time, with
# another umask, time zone and language: names, modes, times and bytes are those of the first ones.
#
#   reproducible.sh <root of the source tree> <packages that were made> <folder> <lqgen>
set -euo pipefail
root=$1 first=$2 folder=$3 lqgen=$4
rm -rf "$folder"
mkdir -p "$folder/tree"
umask 077
for part in include src ports LICENSE codegen/cmake codegen/designs; do
  mkdir -p "$folder/tree/$(dirname "$part")"
  cp -R "$root/$part" "$folder/tree/$part"
done
find "$folder/tree" -type f -exec chmod go= {} +

# What `diff` compares: each file and folder on a line.
list() {
  (
    cd "$1" && find . -printf '%p %y %m %T@ ' \( -type f -exec sha256sum {} \; -o -printf '\n' \) |
      sed 's| \./.*$||' | LC_ALL=C sort
  )
}

packages=(arduino esp-idf platformio single-header zephyr)
env -u SOURCE_DATE_EPOCH OUTPUT="$folder/made" LQGEN="$lqgen" TZ=Pacific/Chatham LC_ALL=C.UTF-8 LANGUAGE=de \
  "$folder/tree/ports/packages/make.sh" "${packages[@]}"
for package in "${packages[@]}"; do
  list "$first/$package" >"$folder/$package.first"
  list "$folder/made/$package" >"$folder/$package.again"
  [ "$(wc -l <"$folder/$package.first")" -gt 5 ]
  diff "$folder/$package.first" "$folder/$package.again"
done
