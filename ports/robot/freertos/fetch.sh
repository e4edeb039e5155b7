#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Gets FreeRTOS' kernel, V11.2.0, and prints its folder. It comes with the crate freertos-next from crates.io, by cargo,
# which compares it with the registry's checksum; the crate itself has to be the one that is named here.
#
#   ports/robot/freertos/fetch.sh FOLDER
#
# Exit status 3: it cannot be had (no cargo, no network).
set -euo pipefail

version=0.12.0
checksum=b7824fb42660c16e1b3b573eef99c2fe5c5cba6294a631c309084635f6bfcbb0
folder=$1
crate=$folder/crates/freertos-next-$version

if ! [ -d "$crate" ]; then
  command -v cargo >/dev/null || { echo "FreeRTOS cannot be fetched: there is no cargo" >&2; exit 3; }
  mkdir -p "$folder/src"
  touch "$folder/src/lib.rs"
  cat >"$folder/Cargo.toml" <<END
[package]
name = "kernel"
version = "0.0.0"
edition = "2021"
[dependencies]
freertos-next = { version = "=$version", default-features = false }
END
  (cd "$folder" && timeout 120 cargo vendor --quiet --versioned-dirs crates >/dev/null) ||
    { rm -rf "$folder/crates"; echo "FreeRTOS cannot be fetched: cargo vendor failed" >&2; exit 3; }
fi
grep -q "\"package\":\"$checksum\"" "$crate/.cargo-checksum.json" ||
  { echo "$crate: expected the checksum $checksum" >&2; exit 1; }
echo "$crate/FreeRTOS-Kernel"
