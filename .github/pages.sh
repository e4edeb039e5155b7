#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The project's pages: lqgen's report of every shipped design, and an index.html that leads to them.
#
#   .github/pages.sh [FOLDER]       build/pages without FOLDER
#
# LQGEN names an lqgen that is there already; otherwise one is built in build/, which the other scripts share.
set -euo pipefail
# shellcheck source=../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../codegen/cmake/setup.sh"

case ${1:-} in -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;; esac
[ $# -le 1 ] || lqg_stop "Expected one folder at most, found $*"

folder=${1:-$lqg_root/build/pages}
lqg_find_lqgen
mkdir -p "$folder"

# The string of a key at the head of a design file, as HTML.
string_of() {
  sed -n "/^\[/q;s/^$1 *= *\"\(.*\)\"\$/\1/p" "$2" | sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g'
}

print_index() {
  cat <<'EOF'
<!DOCTYPE html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>TinyLQG: reports of the shipped designs</title>
<style>body { font: 16px/1.5 sans-serif; max-width: 45em; margin: 2em auto; padding: 0 1em }</style>
<h1>TinyLQG</h1>
<p>From a plant model and a few weights to C99 that runs optimal control on a microcontroller. These are the reports
that <code>lqgen</code> makes of the designs that come with it: margins, poles, runs of the emitted controllers.</p>
<ul>
EOF
  for design in "$lqg_root"/codegen/designs/*.toml; do
    name=$(string_of name "$design")
    echo "<li><a href=\"$name.html\">$name</a>: $(string_of brief "$design")</li>"
  done
  echo '</ul>'
}

for design in "$lqg_root"/codegen/designs/*.toml; do
  "$LQGEN" "$design" -o "$folder" --only html --quiet
done
print_index >"$folder/index.html"
echo "$folder/index.html"
