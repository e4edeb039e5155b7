#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What a filter that updates P costs with its number of states, on a Cortex-M4F at -O2: instructions of a sample
# (update, u = −K x̂, predict), dense plants and chains of masses, straight-line code, `style = "auto"` within 16,384
# bytes of flash, and `style = "compact"`.
#
#   test/bench/sizes.sh             prints the table
#   test/bench/sizes.sh --update    writes sizes.md, too
#
# LQGEN names an lqgen that is there already. FOLDER is where all work is done, default build/bench-sizes. Debian's
# packages: gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm python3.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"
bench=$lqg_root/test/bench folder=${FOLDER:-$lqg_root/build/bench-sizes}
# shellcheck source-path=SCRIPTDIR source=cores.sh
source "$bench/cores.sh"
most_states=24 most_unrolled=10  # beyond it a compiler takes minutes, and no microcontroller has the flash

# count <kind> <states> <style>: prints "instructions (flash)".
count() {
  local here=$folder/$1-$2-$3 instructions=0 error
  local flags=("-I$here" '-DMODEL="model.h"' '-DHEADER="plant.h"' -DNAME=plant -DCARRIED)
  mkdir -p "$here"
  python3 "$bench/sizes.py" "$1" "$2" "$3" >"$here/plant.toml"
  "$LQGEN" "$here/plant.toml" -o "$here" --quiet --only h,json
  python3 "$bench/peers/model.py" "$here/plant.json" carried >"$here/model.h"
  "${compiler[@]}" "${flags[@]}" -DWITH_SAMPLES "$bench/peers/measure.c" "$bench/peers/emitted.c" \
    "$folder"/{counter,startup}.o "$folder/library.a" "${linked[@]}" -lm -o "$here/plant.elf"
  # shellcheck disable=SC1090  # it has just been made
  source <(timeout 600 "${machine[@]}" "$here/plant.elf")
  [ "${error:-1000000}" -lt 50000 ] || lqg_stop "$1, $2 states, $3: another answer, by $error millionths"
  echo "$instructions ($(sed -n 's/^ *"flash": \([0-9]*\),\{0,1\}$/\1/p' "$here/plant.json" | tail -n 1))"
}

print() {
  local states kind style line
  echo "| states | dense, unrolled | dense, auto | dense, compact | chain, unrolled | chain, auto | chain, compact |"
  echo "| ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
  for ((states = 1; states <= most_states; states++)); do
    line="| $states |"
    for kind in dense chain; do
      for style in unrolled auto compact; do
        if [ $style = unrolled ] && [ "$states" -gt $most_unrolled ]; then
          line+=" – |"
        else
          line+=" $(count $kind "$states" $style) |"
        fi
      done
    done
    echo "$line"
  done
}

options=(-O2)
case ${1:-} in
  "" | --update) ;;
  -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;;
  *) lqg_stop "expected --update or nothing, found $1" ;;
esac
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
select_core cortex-m4f
absent=$(missing_tools)
[ -z "$absent" ] || lqg_stop "Not found:$absent"
lqg_find_lqgen
"${compiler[@]}" "-DMEGAHERTZ=$megahertz" -c "$bench/counter_cortex-m.c" -o "$folder/counter.o"
"${compiler[@]}" -c "$startup" -o "$folder/startup.o"
(
  mkdir -p "$folder/library" && cd "$folder/library" && "${compiler[@]}" -std=c99 -c "$lqg_root"/src/*.c &&
    rm -f ../library.a && "$archiver" rcs ../library.a ./*.o
)
print | tee "$folder/table.md"
if [ "${1:-}" = --update ]; then
  {
    echo "# Instructions of one sample with the number of states"
    echo
    echo "Made by \`test/bench/sizes.sh --update\`, which says what is measured; in brackets the flash that lqgen"
    echo "states."
    echo "$("${compiler[0]}" --version | head -n 1), ${options[*]}."
    echo
    cat "$folder/table.md"
  } >"$bench/sizes.md"
fi
