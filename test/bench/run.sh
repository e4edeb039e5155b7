#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What the emitted controllers cost on the cores of ports/: prints a table for each core.
#
#   test/bench/run.sh [--all] [core]… [DESIGN.toml]… [option of the compiler]…     after -O2 -std=c99, such as -Os or
#                                                                                  -std=gnu99
#   test/bench/run.sh --update       writes the record, test/bench/record.md
#   test/bench/run.sh --check        shows what differs from the record, and keeps it in FOLDER/changes.txt; fails where
#                                    a figure has grown by more than 2 %
#
# A core is the name of its folder in ports/; without any it is all nine. The record has every design in both styles, in
# float, and where the FPU computes in double, too, those that are meant for it; --all has every design in both reals.
# With them comes two_mass with the covariance carried as it is, which is the filter that others are compared by, and
# three designs without their limits in each form of a constant gain; advance is called predict there.
# Fused arithmetic is left out where the hardware has none. Design files that are named come in place of all these: each
# in both styles and its own real. They have a filter and a regulator, or a filter and no input.
#
# LQGEN names an lqgen that is there already; otherwise one is built in build/, which the other scripts share. FOLDER is
# where all work is done, default build/bench. Debian's packages: gcc-arm-none-eabi libnewlib-arm-none-eabi
# qemu-system-arm gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf qemu-system-misc.
#
# Instructions are counted by QEMU, exactly: all that a function executes between its call and its return,
# library functions included. "most" is over the reference samples of the design's test and over the same with
# each output in turn left out of every third sample, as NaN; the others are the median of the reference
# samples. Step applies what it asks for, so that its samples are others than those of the calls; its median is that
# with a gate as it is after a while. Stack is the deepest reach of step below its caller, in bytes. Flash is what the
# linker brings for init and step: code, constants, library functions. In the compact style, whose step makes the calls,
# both are of the calls alone. What lqgen estimates stands there in brackets: of step for each core, of flash and stack
# for a Cortex-M4F.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"
bench=$lqg_root/test/bench folder=${FOLDER:-$lqg_root/build/bench}
source "$bench/cores.sh"

# ---- many things at once -----------------------------------------------------------------------------------------

running=0

# start <file> <command> [argument]…: in the background, its output in the file.
start() {
  local file=$1
  shift
  [ $running -lt "$(getconf _NPROCESSORS_ONLN)" ] || wait_for_one
  "$@" >"$file" &
  running=$((running + 1))
}

wait_for_one() {
  wait -n || exit 1
  running=$((running - 1))
}

wait_for_all() {
  while [ $running -gt 0 ]; do
    wait_for_one
  done
}

# ---- the controllers ---------------------------------------------------------------------------------------------

# The value of a key of a design file, and of "code" in a NAME.json.
# The first of that key: a scenario has a name, too.
design_value() { sed -n "/^[[:space:]]*$2 *= *\"\([a-z0-9_]*\)\".*/{s//\1/p;q}" "$1"; }
json_value() { sed -n "s/^ *\"$2\": \([0-9]*\),\{0,1\}\$/\1/p" "$1" | tail -n 1; }

# make_controller <folder> <title> <design> <style> <real>: its header, reference samples and figures; prints what
# add_row wants to know of it.
make_controller() {
  local name arithmetic has_input='' has_law='' keeps_z='' predicts=''
  name=$(design_value "$3" name)
  arithmetic=$(design_value "$3" arithmetic)
  "$LQGEN" "$3" -o "$1" --style "$4" --real "$5" --quiet || lqg_stop "lqgen refuses $3"
  grep -q "^static const .* y_in\[" "$1/${name}_test.c" || lqg_stop "$3: expected a filter, found a regulator alone"
  ! grep -q "^#define ${name^^}_NU " "$1/$name.h" || has_input=yes
  ! grep -q " ${name}_control(" "$1/$name.h" || has_law=yes
  sed -n '/^static const .* \(y_in\|u_out\)\[/,/^};/p' "$1/${name}_test.c" >"$1/vectors.h"
  if grep -q "^static inline .*${name}_advance(" "$1/$name.h"; then
    keeps_z=yes
    grep -q "_control(.* y\[" "$1/$name.h" || predicts=yes
  fi
  echo "title='$2' name=$name arithmetic=${arithmetic:-plain} style=$4 real=$5" \
    "has_input=$has_input has_law=$has_law keeps_z=$keeps_z predicts=$predicts"
}

# start_controller <title> <design> <style> <real>: in a folder of its own; those of the tables in their order.
start_controller() {
  local made
  made=$folder/controllers/$(printf '%03d' ${#controllers[@]})
  controllers+=("$made")
  mkdir -p "$made"
  start "$made/description" make_controller "$made" "$@"
}

# two_mass with `arithmetic` and the covariance carried as it is.
start_carried_controller() {
  local design=$folder/$1/two_mass.toml
  mkdir -p "$folder/$1"
  sed -e 's/^gain *=.*/gain = "online"\ncovariance = "plain"/' -e '/^arithmetic/d' \
    -e "s/^real *=.*/&\narithmetic = \"$1\"/" "$lqg_root/codegen/designs/two_mass.toml" >"$design"
  start_controller "two_mass, covariance carried, $1" "$design" unrolled float
}

# The design without its limits, in each form of a constant gain.
start_controllers_of_forms() {
  local form design=$lqg_root/codegen/designs/$1.toml changed
  for form in physical folded modal; do
    changed=$folder/$form/$1.toml
    mkdir -p "$folder/$form"
    sed -e '/^\[limits\]/,/^\[code\]/{/^\[code\]/!d}' -e "s/^\[code\]/&\nrealisation = \"$form\"/" "$design" >"$changed"
    start_controller "$1 without limits, $form" "$changed" unrolled float
  done
}

# has_style <design> <style>: the loops of compact code are of x̂, and of matrices.
has_style() { [ "$2" = unrolled ] || ! grep -qE '^(realisation|gain *= *"extended")' "$1"; }

make_controllers_of_designs() {
  local design real style
  for design in "${designs[@]}"; do
    real=$(design_value "$design" real)
    for style in unrolled compact; do
      ! has_style "$design" $style ||
        start_controller "$(design_value "$design" name)" "$design" $style "${real:-float}"
    done
  done
  wait_for_all
}

make_controllers() {
  local real design style
  controllers=()
  if [ ${#designs[@]} -gt 0 ]; then
    make_controllers_of_designs
    return
  fi
  start_carried_controller fused
  start_carried_controller plain
  for real in float double; do
    for design in "$lqg_root"/codegen/designs/*.toml; do
      if [ -n "$all" ] || [ $real = float ] || [ "$(design_value "$design" real)" = double ]; then
        for style in unrolled compact; do
          ! has_style "$design" $style || start_controller "$(design_value "$design" name)" "$design" $style $real
        done
      fi
    done
  done
  for design in two_mass dc_motor quadrotor; do
    start_controllers_of_forms $design
  done
  wait_for_all
}

# ---- the measurement ---------------------------------------------------------------------------------------------

# Start-up and counter, which all controllers of a core share.
compile_once() {
  rm -rf "$work"
  mkdir -p "$work"
  "${compiler[@]}" -c "$startup" -o "$work/startup.o"
  "${compiler[@]}" "-DMEGAHERTZ=$megahertz" -c "$bench/counter_$family.c" -o "$work/counter.o"
}

# find_library <folder> <option>…: the variant of the options in the folder, compiled where it is not there yet.
find_library() {
  local folder=$1
  shift
  library=$folder/library.a
  [ ! -e "$library" ] || return 0
  mkdir -p "$folder"
  (cd "$folder" && "${compiler[@]}" "$@" -c "$lqg_root"/src/*.c && "$archiver" rcs library.a ./*.o)
}

# link_controller <main> <option or file>…
link_controller() {
  local main=$1
  shift
  "${compiler[@]}" "${variant[@]}" "${names[@]}" "$bench/$main.c" "$@" "${linked[@]}" "$library" -lm \
    -o "$work/$main.elf"
}

# The sections of a program that go into flash.
flash_of() {
  "$size" -A "$1" | awk '$1 ~ /^\.(text|rodata|srodata|data|sdata|ARM\.exidx)/ { sum += $2 } END { print sum }'
}

# add_row <made>, of which the caller has read the description.
add_row() {
  local library variant=() names json=$1/$name.json estimated_flash='' estimated_stack='' stated
  local update control predict step most_update most_control most_predict most_step stack ram
  [ "$real" = float ] || variant+=(-DLQG_REAL_DOUBLE)
  [ "$arithmetic" = plain ] || variant+=(-DLQG_FUSED)
  names=("-I$1" "-DHEADER=\"$name.h\"" '-DVECTORS="vectors.h"' "-DNAME=$name" "-DUPPER_NAME=${name^^}" "-DREAL=$real")
  [ -n "$has_law" ] || names+=(-DESTIMATES)
  [ -z "$has_input" ] || names+=(-DHAS_INPUT)
  [ "$style" != compact ] || names+=(-DCALLS)
  [ -z "$keeps_z" ] || names+=(-DKEEPS_Z)
  [ -z "$predicts" ] || names+=(-DPREDICTS)
  ! grep -q ' widening\[' "$1/$name.h" || names+=(-DGATED)
  find_library "$work/${real}_$arithmetic" "${variant[@]}"
  link_controller footprint -Wl,-e,roots
  link_controller measure "$work/counter.o" "$work/startup.o"
  timeout 600 "${machine[@]}" "$work/measure.elf" >"$work/measured" ||
    lqg_stop "$core, $title, $style, $real: the measurement failed"
  source "$work/measured"
  stated=$(json_value "$json" "$core")
  if [ "$core" = cortex-m4f ]; then
    estimated_flash=" ($(json_value "$json" flash))" estimated_stack=" ($(json_value "$json" stack))"
  fi
  echo "| $title | $style | $real | $(json_value "$json" multiply_adds) | $update | $most_update |" \
    "$control | $most_control | $predict | $most_predict | $step${stated:+ ($stated)} | $most_step |" \
    "$(flash_of "$work/footprint.elf")$estimated_flash | $ram | $stack$estimated_stack |"
}

# is_measured: on this core, whose FPU fuses fused_reals, of the controller described.
is_measured() {
  [ "$arithmetic" = plain ] || [[ " $fused_reals " == *" $real "* ]] || return 1
  [ -n "$all" ] || [ "$real" = float ] || [[ " $fused_reals " == *" double "* ]]
}

heading() { echo "$("${compiler[0]}" --version | head -n 1), ${options[*]}"; }

# measure_core <core>: its section of the tables.
measure_core() {
  local made title name arithmetic style real has_input has_law keeps_z predicts
  select_core "$1"
  work=$folder/work/$core
  compile_once
  printf '## %s\n\n%s\n\n' "$core" "$(heading)"
  echo "| design | style | real | multiply-adds | update | most | control | most | predict | most | step | most |" \
    "flash | RAM | stack |"
  echo "| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
  for made in "${controllers[@]}"; do
    source "$made/description"
    if is_measured; then
      add_row "$made" </dev/null
    fi
  done
  echo
}

# measure <core>…: all of them, in $folder/CORE.md.
measure() {
  local core
  lqg_find_lqgen
  make_controllers
  for core in "$@"; do
    start "$folder/$core.md" measure_core "$core"
  done
  wait_for_all
}

# ---- the record --------------------------------------------------------------------------------------------------

record=$bench/record.md

# Finds the `comparable` cores, those of which this machine has the tools, and the compiler that the record was made
# with: another makes other code. Says which have been left out.
find_comparable_cores() {
  local missing recorded
  comparable=()
  for core in "${every_core[@]}"; do
    select_core "$core"
    missing=$(missing_tools)
    recorded=$(awk -v core="$core" '/^## / { here = $2 == core } here && /gcc/' "$record")
    if [ -n "$missing" ]; then
      echo "$core is left out. Not found:$missing"
    elif [ "$(heading)" != "$recorded" ]; then
      echo "$core is left out. The record was made with $recorded; this is $(heading)"
    else
      comparable+=("$core")
    fi
  done
}

check() {
  find_comparable_cores
  if [ ${#comparable[@]} = 0 ]; then
    echo "Nothing to compare"
    return
  fi
  measure "${comparable[@]}"
  (cd "$folder" && cat "${comparable[@]/%/.md}") >"$folder/measured.md"
  awk -f "$bench/compare.awk" -v "cores=${comparable[*]}" "$record" "$folder/measured.md" ||
    lqg_stop "More than 2 % of growth. If it is meant: test/bench/run.sh --update"
}

update() {
  require_tools "${every_core[@]}"
  measure "${every_core[@]}"
  {
    echo "# What the emitted controllers cost"
    echo
    echo "Made by \`test/bench/run.sh --update\`, which says what the columns mean."
    echo
    (cd "$folder" && cat "${every_core[@]/%/.md}") | sed '$d'
  } >"$record"
}

print() {
  require_tools "$@"
  measure "$@"
  (cd "$folder" && cat "${@/%/.md}")
}

require_tools() {
  local core packages='gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm'
  packages+=' gcc-riscv64-unknown-elf picolibc-riscv64-unknown-elf qemu-system-misc'
  for core in "$@"; do
    select_core "$core"
    [ -z "$(missing_tools)" ] || lqg_stop "$core needs$(missing_tools). Of Debian's packages: $packages"
  done
}

# ---- the command line --------------------------------------------------------------------------------------------

all='' task=print options=(-O2 -std=c99) cores=() designs=()
for argument in "$@"; do
  case $argument in
    --all) all=yes ;;
    --update | --check) task=${argument#--} ;;
    -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;;
    *.toml)
      [ -f "$argument" ] || lqg_stop "There is no design file $argument"
      designs+=("$argument") all=yes
      ;;
    -*) options+=("$argument") ;;
    *) cores+=("$argument") ;;
  esac
done
[ ${#cores[@]} -gt 0 ] || cores=("${every_core[@]}")
[ ${#designs[@]} = 0 ] || [ "$task" = print ] ||
  lqg_stop "The record is of the shipped designs: expected --$task alone, found ${designs[*]}"
mkdir -p "$folder"
case $task in
  print) print "${cores[@]}" ;;
  update) update ;;
  check) check 2>&1 | tee "$folder/changes.txt" ;;
esac
