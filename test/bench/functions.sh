#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What the functions of lqg/functions.h cost beside newlib's libm, in instructions at -O2.
#
#   test/bench/functions.sh             prints the tables
#   test/bench/functions.sh --update    writes functions.md, too
#   test/bench/functions.sh --check     fails where a figure of functions.md has grown by more than 2 %; only with the
#                                       record's compiler
#
# Instructions are counted by QEMU, exactly: all between the call and the return, for 250 arguments each; sin_cos of
# libm is sinf() and cosf(), wrap is remainderf(x, 2π). FOLDER is where all work is done, default
# build/bench-functions. Debian's packages: gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"
bench=$lqg_root/test/bench folder=${FOLDER:-$lqg_root/build/bench-functions}
# shellcheck source-path=SCRIPTDIR source=cores.sh
source "$bench/cores.sh"
cores=(cortex-m0 cortex-m3 cortex-m4f cortex-m7)
names=(sin_cos sin cos tan asin acos atan atan2 sqrt exp log tanh wrap)
options=(-O2 -std=c99)

# measure <core> <real>: leaves its figures in a file.
measure() {
  local here=$folder/$1-$2 suffix='##f'
  [ "$2" = float ] || suffix=
  select_core "$1"
  mkdir -p "$here"
  "${compiler[@]}" "-DMEGAHERTZ=$megahertz" "-DREAL=$2" "-DOURS(name)=lqg_##name$suffix" "-DLIBM(name)=name$suffix" \
    -I"$bench" "$bench/functions.c" "$bench/counter_$family.c" "$startup" "${linked[@]}" -lm -o "$here/functions.elf"
  timeout 600 "${machine[@]}" "$here/functions.elf" >"$here/measured" || lqg_stop "$1, $2: the measurement failed"
}

# figure <core> <real> <name>
figure() { sed -n "s/^$3=//p" "$folder/$1-$2/measured"; }

print_table() {
  local real=$1 line name core
  line="| $real |" && for core in "${cores[@]}"; do line+=" $core | libm |"; done
  echo "$line"
  line="| --- |" && for core in "${cores[@]}"; do line+=" ---: | ---: |"; done
  echo "$line"
  for name in "${names[@]}"; do
    line="| $name |"
    for core in "${cores[@]}"; do
      line+=" $(figure "$core" "$real" "${name}_mean") ($(figure "$core" "$real" "${name}_most")) |"
      line+=" $(figure "$core" "$real" "${name}_libm_mean") ($(figure "$core" "$real" "${name}_libm_most")) |"
    done
    echo "$line"
  done
}

print() {
  echo "# What elementary functions cost"
  echo
  echo "Instructions of a call, mean and (most), of lqg/functions.h and of newlib's libm; made by"
  echo '`test/bench/functions.sh --update`, which says more.'
  echo "$("${compiler[0]}" --version | head -n 1), ${options[*]}"
  for real in float double; do
    echo
    print_table $real
  done
}

# grown <file of tables>…: prints the lines in which one of our own figures is more than in the record.
grown() {
  awk -F'|' 'NR == FNR { if (NF > 4) for (i = 3; i < NF; i += 2) record[FNR, i] = $i + 0; next }
    NF > 4 && FNR > 6 { for (i = 3; i < NF; i += 2) if ($i + 0 > 1.02 * record[FNR, i]) { print; next } }' "$1" "$2"
}

case ${1:-} in
  "" | --update | --check) ;;
  -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;;
  *) lqg_stop "expected --update, --check or nothing, found $1" ;;
esac
for core in "${cores[@]}"; do
  select_core "$core"
  absent=$(missing_tools)
  [ -z "$absent" ] || { echo "Nothing to compare: no$absent" && exit; }
done
rm -rf "$folder"
mkdir -p "$folder"
for core in "${cores[@]}"; do
  for real in float double; do
    measure "$core" $real
  done
done
print | tee "$folder/functions.md"
case ${1:-} in
  --update) cp "$folder/functions.md" "$bench/functions.md" ;;
  --check)
    [ "$(sed -n 5p "$bench/functions.md")" = "$(sed -n 5p "$folder/functions.md")" ] ||
      { echo "Nothing to compare: another compiler than the record's" && exit; }
    found=$(grown "$bench/functions.md" "$folder/functions.md")
    [ -z "$found" ] || lqg_stop "more instructions than in functions.md:"$'\n'"$found"
    ;;
esac
