#!/usr/bin/env bash
# What the emitted controllers cost on a Cortex-M4F: prints one table and writes it to build/bench.md.
#
#   test/bench/run.sh [option of the compiler]…        after -O2 -std=c99, such as -Os or -std=gnu99
#
# Every design in both styles and both reals, and two_mass with the covariance carried as it is, which is the
# filter that others are compared by. LQGEN names an lqgen that is there already; otherwise one is built in
# build/bench. Debian's packages: gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm.
#
# Instructions are counted by QEMU, exactly: all that a function executes between its call and its return,
# library functions included. "most" is over the reference samples of the design's test and over the same with
# each output in turn left out of every third sample, as NaN; the others are the median of the reference
# samples. Stack is the deepest reach of update, control and predict below their caller. Flash is what the
# linker brings for init, update, control and predict: code, constants, library functions. What lqgen estimates
# stands in brackets.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"

bench=$lqg_root/test/bench port=$lqg_root/ports/cortex-m4f shared=$lqg_root/ports/cortex-m
folder=$lqg_root/build/bench
options=(-O2 -std=c99 "$@")
cpu=(-mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard -ffunction-sections -fdata-sections)
compiler=(arm-none-eabi-gcc "${cpu[@]}" "${options[@]}" -I"$lqg_root/include")
linker=(arm-none-eabi-gcc "${cpu[@]}" -nostartfiles --specs=nano.specs -Wl,--gc-sections)
machine=(qemu-system-arm -machine mps2-an386 -nographic -monitor none -serial none -icount shift=8
         -chardev stdio,id=pc -semihosting-config enable=on,target=native,chardev=pc -kernel)

lqg_has_command arm-none-eabi-gcc && lqg_has_command qemu-system-arm ||
  lqg_stop "Please install what Debian calls: gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm"
mkdir -p "$folder"
if [ -z "${LQGEN:-}" ]; then
  LQGEN=$folder/codegen/lqgen
  lqg_configure "$folder" -DLQG_BUILD_CODEGEN=ON -DLQG_BUILD_TESTS=OFF >&2
  lqg_compile "$folder" --target lqgen >&2
fi

# The value of a key of a design file, and of "code" in a NAME.json.
design_value() { sed -n "s/^$2 *= *\"\([a-z0-9_]*\)\".*/\1/p" "$1"; }
json_value() { sed -n "s/^ *\"$2\": \([0-9]*\),\{0,1\}\$/\1/p" "$1" | tail -n 1; }

# make_controller <design> <style> <real> <folder>: header, reference samples, and the library where it is needed
make_controller() {
  local name definitions=() source
  name=$(design_value "$1" name)
  "$LQGEN" "$1" -o "$4" --style "$2" --real "$3" --quiet
  sed -n '/^static const .* \(y_in\|u_out\)\[/,/^};/p' "$4/${name}_test.c" >"$4/vectors.h"
  if [ "$2" = compact ]; then
    [ "$3" = float ] || definitions+=(-DLQG_REAL_DOUBLE)
    [ "$(design_value "$1" arithmetic)" != fused ] || definitions+=(-DLQG_FUSED)
    for source in "$lqg_root"/src/*.c; do
      "${compiler[@]}" "${definitions[@]}" -c "$source" -o "$4/$(basename "$source" .c).o"
    done
  fi
  grep -q '^B *=' "$1" || definitions+=(-DESTIMATES)
  definitions+=("-DHEADER=\"$name.h\"" '-DVECTORS="vectors.h"' "-DNAME=$name" "-DUPPER_NAME=${name^^}" "-DREAL=$3")
  "${compiler[@]}" "${definitions[@]}" -I"$4" -c "$bench/measure.c" -o "$4/measure.main"
  "${compiler[@]}" "${definitions[@]}" -I"$4" -c "$bench/footprint.c" -o "$4/footprint.main"
}

# link_controller <folder> <main> <option>…
link_controller() {
  local folder=$1 main=$2 library
  shift 2
  mapfile -t library < <(find "$folder" -name '*.o')
  "${linker[@]}" "$folder/$main.main" "${library[@]}" "$@" -lm -o "$folder/$main.elf"
}

# The sections of footprint.elf that go into flash.
flash_of() { arm-none-eabi-size -A "$1" | awk '$1 ~ /^\.(text|rodata|data|ARM\.exidx)/ { sum += $2 } END { print sum }'; }

# add_row <title> <design> <style> <real>
add_row() {
  local made name update control predict most_update most_control most_predict stack ram
  made=$(mktemp -d "$folder/controller.XXXXXX")
  make_controller "$2" "$3" "$4" "$made"
  link_controller "$made" footprint -Wl,-e,roots
  link_controller "$made" measure -L "$port" -T "$shared/link.ld" "${startup[@]}"
  timeout 600 "${machine[@]}" "$made/measure.elf" >"$made/measured" || lqg_stop "$1: the measurement failed"
  source "$made/measured"
  name=$(design_value "$2" name)
  echo "| $1 | $3 | $4 | $(json_value "$made/$name.json" multiply_adds) | $update | $control | $predict |" \
    "$((most_update + most_control + most_predict)) |" \
    "$(flash_of "$made/footprint.elf") ($(json_value "$made/$name.json" flash)) | $ram |" \
    "$stack ($(json_value "$made/$name.json" stack)) |"
  rm -r "$made"
}

# two_mass with `arithmetic` and the covariance carried as it is.
add_carried_row() {
  local design=$folder/two_mass.toml
  sed -e 's/^gain *=.*/gain = "online"\ncovariance = "plain"/' -e '/^arithmetic/d' \
    -e "s/^real *=.*/&\narithmetic = \"$1\"/" "$lqg_root/codegen/designs/two_mass.toml" >"$design"
  add_row "two_mass, covariance carried, $1" "$design" unrolled float
}

startup=("$folder/startup.main")
"${compiler[@]}" -c "$shared/startup.c" -o "${startup[0]}"
{
  echo "Cortex-M4F, $(arm-none-eabi-gcc --version | head -n 1), ${options[*]}"
  echo
  echo "| design | style | real | multiply-adds | update | control | predict | most, all three | flash, bytes | RAM | stack |"
  echo "| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
  add_carried_row fused
  add_carried_row plain
  for real in float double; do
    for design in "$lqg_root"/codegen/designs/*.toml; do
      for style in unrolled compact; do
        add_row "$(design_value "$design" name)" "$design" "$style" "$real"
      done
    done
  done
} | tee "$lqg_root/build/bench.md"
