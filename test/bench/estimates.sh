#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The flash and stack that lqgen states, against what the compiler makes that they are stated for: arm-none-eabi-gcc
# 12.2, -O2, Cortex-M4F.
#
#   test/bench/estimates.sh [--random COUNT] [--from SEED] [DESIGN.toml]…
#
# Without design files: the shipped ones, each in both styles and both reals; COUNT random designs beside them (default
# 0), of seed 1 … or SEED …, whose dimensions, filters, styles and arithmetic random_design.awk draws. Prints a line for
# each: stated, compiled, by how many per cent more was stated. Fails where less is stated than was compiled, or more
# than 15 % and 48 bytes more: a frame grows by 8 bytes at once, and small ones are of 24.
#
# Flash is what the linker brings for init and step, as in run.sh. Stack is the deepest reach of step below its caller
# along all calls that there are, taken or not: a reset is among them. In the compact style, whose step makes the calls
# of a sample, both are of the calls alone.
#
# LQGEN names an lqgen that is there already; FOLDER is where all work is done, default build/estimates. Without the
# compiler it says so and ends with status 0. Debian's packages: gcc-arm-none-eabi libnewlib-arm-none-eabi.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"
bench=$lqg_root/test/bench folder=${FOLDER:-$lqg_root/build/estimates}
source "$bench/cores.sh"
most_flash=15 most_stack=15 allowed=48

random=0 seed=1 designs=()
while [ $# -gt 0 ]; do
  case $1 in
    --random) random=$2 && shift ;;
    --from) seed=$2 && shift ;;
    -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;;
    *.toml) designs+=("$1") ;;
    *) lqg_stop "expected --random COUNT, --from SEED or a design file, found $1" ;;
  esac
  shift
done

options=(-O2 -std=c99)
select_core cortex-m4f
if ! lqg_has_command "${compiler[0]}" || [[ "$("${compiler[0]}" -dumpversion)" != 12.2.* ]]; then
  echo "Nothing to compare: no arm-none-eabi-gcc 12.2"
  exit
fi
lqg_find_lqgen
mkdir -p "$folder"

json_value() { sed -n "s/^ *\"$2\": \([0-9]*\),\{0,1\}\$/\1/p" "$1" | tail -n 1; }

# find_library <folder> <option>…
find_library() {
  local here=$1
  shift
  library=$here/library.a
  [ ! -e "$library" ] || return 0
  mkdir -p "$here"
  (cd "$here" && "${compiler[@]}" "$@" -c "$lqg_root"/src/*.c && arm-none-eabi-ar rcs library.a ./*.o)
}

# compare <title> <design> <option of lqgen>…
compare() {
  local title=$1 design=$2 name roots made library variant=() names stated_flash stated_stack flash stack
  shift 2
  name=$(sed -n '/^\[/q;s/^[[:space:]]*name *= *"\([a-z0-9_]*\)".*/\1/p' "$design")
  made=$folder/controller
  rm -rf "$made"
  if ! "$LQGEN" "$design" -o "$made" --quiet "$@" >"$folder/refusal" 2>&1; then
    echo "| $title | refused |"
    return
  fi
  names=("-I$made" "-DHEADER=\"$name.h\"" "-DNAME=$name")
  ! grep -q '"real": "double"' "$made/$name.json" || variant+=(-DLQG_REAL_DOUBLE)
  ! grep -q '"arithmetic": "fused"' "$made/$name.json" || variant+=(-DLQG_FUSED)
  ! grep -q "^static inline .*${name}_advance(" "$made/$name.h" || names+=(-DKEEPS_Z)
  grep -q " ${name}_control(" "$made/$name.h" || names+=(-DESTIMATES)
  roots=${name}_step
  if grep -q '"style": "compact"' "$made/$name.json"; then
    names+=(-DCALLS) roots="${name}_update ${name}_control ${name}_predict"
  fi
  find_library "$folder/library${variant[*]}" "${variant[@]}"
  "${compiler[@]}" "${variant[@]}" "${names[@]}" "$bench/footprint.c" -Wl,-e,roots "${linked[@]}" "$library" -lm \
    -o "$folder/footprint.elf"
  flash=$("$size" -A "$folder/footprint.elf" |
    awk '$1 ~ /^\.(text|rodata|data|ARM\.exidx)/ { sum += $2 } END { print sum }')
  stack=$(arm-none-eabi-objdump -d --no-show-raw-insn "$folder/footprint.elf" |
    awk -f "$bench/stack.awk" -v roots="$roots")
  stated_flash=$(json_value "$made/$name.json" flash) stated_stack=$(json_value "$made/$name.json" stack)
  awk -v title="$title" -v a="$stated_flash" -v b="$flash" -v c="$stated_stack" -v d="$stack" \
    -v most_flash=$most_flash -v most_stack=$most_stack -v allowed=$allowed '
    function fault(stated, compiled, most) {
      return stated < compiled ? " too little |" : stated > compiled * (1 + most / 100) + allowed ? " too much |" : ""
    }
    function more(stated, compiled) { return compiled ? sprintf("%+.1f %%", 100 * (stated - compiled) / compiled) : "" }
    BEGIN {
      print "| " title " | " a " | " b " | " more(a, b) " | " c " | " d " | " more(c, d) " |" \
        fault(a, b, most_flash) fault(c, d, most_stack)
    }' | tee -a "$folder/table.md"
}

: >"$folder/table.md"
echo "| design | flash stated | compiled | more | stack stated | compiled | more |"
echo "| --- | ---: | ---: | ---: | ---: | ---: | ---: |"
if [ ${#designs[@]} = 0 ]; then
  for design in "$lqg_root"/codegen/designs/*.toml; do
    for style in unrolled compact; do
      # Those loops are of x̂, and of matrices.
      if [ $style = compact ] && grep -qE '^(realisation|gain *= *"extended")' "$design"; then continue; fi
      for real in float double; do
        compare "$(basename "$design" .toml), $style, $real" "$design" --style $style --real $real
      done
    done
  done
else
  for design in "${designs[@]}"; do compare "$(basename "$design" .toml)" "$design"; done
fi
for ((i = seed; i < seed + random; i++)); do
  awk -f "$bench/random_design.awk" -v seed=$i >"$folder/random_$i.toml"
  compare "random $i" "$folder/random_$i.toml"
done
if grep -q "too little\|too much" "$folder/table.md"; then
  too_little=$(grep -c "too little" "$folder/table.md" || true)
  too_much=$(grep -c "too much" "$folder/table.md" || true)
  lqg_stop "$too_little too little, $too_much too much: codegen/emit/plan states what the compiler does not make"
fi
