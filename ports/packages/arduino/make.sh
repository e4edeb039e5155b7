#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The Arduino library: a folder TinyLQG for the IDE's libraries folder, and the same as TinyLQG-VERSION.zip where there
# is a zip. The IDE runs no generator, so the headers of the examples' controllers are made here.
#
#   make.sh <root of the source tree> <output folder>
source "$(dirname "${BASH_SOURCE[0]}")/../common.sh"
here=$(dirname "${BASH_SOURCE[0]}") library=$out/TinyLQG

# Everything below src is compiled; the library's private headers stay out of the sketches' way in a folder.
copy_library "$library/src/tinylqg" "$library/src"
cp "$here/TinyLQG.h" "$library/src"
cp "$root/LICENSE" "$library"
fill "$root/ports/packages/package.md" >"$library/README.md"
fill "$here/library.properties" >"$library/library.properties"

# keywords.txt: what the editor paints. Each line a keyword, a tab, its class.
keywords() {
  local class=$1
  shift
  sed -nE "$@" "$root"/include/lqg/*.h | sort -u | while read -r name; do printf '%s\t%s\n' "$name" "$class"; done
}
{
  keywords KEYWORD1 -e 's/^typedef .*[ *(](lqg_[a-z_]*_t|lqg_real)(;|\)\(.*)$/\1/p' -e 's/^} (lqg_[a-z_]*_t);$/\1/p'
  keywords KEYWORD2 -e 's/^#define (lqg_[a-z_]*) +LQG_VARIANT.*/\1/p' -e 's/^[a-z].*[ *](lqg_[a-z_]*)\(.*/\1/p' \
    -e 's/^#define (LQG_[A-Z_]*_STATE)\(.*/\1/p'
  keywords LITERAL1 -e 's/^#define (LQG_[A-Z_]*) +[0-9(].*/\1/p' -e 's/^    (LQG_[A-Z_]*_FORM).*/\1/p'
} >"$library/keywords.txt"

cp -R "$here/examples" "$library"
cp "$root/codegen/designs/dc_motor.toml" "$library/examples/DcMotor"
for design in "$library"/examples/*/*.toml; do
  make_controller "$design" "$(dirname "$design")" --style unrolled --real float
done

settle "$library"
if lqg_has_command zip; then
  (cd "$out" && find TinyLQG | sort | zip -qX "TinyLQG-$version.zip" -@)
fi
settle "$out"
