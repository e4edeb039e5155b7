#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Of the library's loops, what codegen/emit/plan/library_cost.cpp has as numbers: bytes of flash, without the C library,
# of each filter's and law's functions together with all that they call, and the deepest reach of the stack of each; of
# float, fused float, double, fused double. To be run, and its numbers taken over, when src/ has changed. FOLDER is
# where all work is done, default build/figures.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../codegen/cmake/setup.sh"
bench=$lqg_root/test/bench folder=${FOLDER:-$lqg_root/build/figures}
source "$bench/cores.sh"
options=(-O2 -std=c99)
select_core cortex-m4f
mkdir -p "$folder"

# measure <title> <function>…: for the variant of `suffix` and `define`
measure() {
  local title=$1 function functions=() deepest=''
  shift
  for function in "$@"; do functions+=("lqg_$function$suffix"); done
  {
    echo 'typedef void function(void);'
    printf 'extern function %s;\n' "${functions[@]}"
    echo "__attribute__((section(\".roots\"))) function *const roots[] = {$(IFS=, && echo "${functions[*]}")};"
  } >"$folder/roots.c"
  "${compiler[@]}" "$folder/roots.c" -Wl,-e,roots "${linked[@]}" "$folder/$suffix/library.a" -lm \
    -Wl,-Map="$folder/map" -o "$folder/roots.elf"
  for function in "${functions[@]}"; do
    deepest+=" $(arm-none-eabi-objdump -d --no-show-raw-insn "$folder/roots.elf" |
      awk -f "$bench/stack.awk" -v roots="$function")"
  done
  echo "$title$suffix: flash $(sed '1,/Linker script and memory map/d' "$folder/map" | awk '
    function hexadecimal(text,    i, value) {
      for (i = 3; i <= length(text); i++) value = 16 * value + index("0123456789abcdef", substr(text, i, 1)) - 1
      return value
    }
    / \.(text|rodata)/ { is_code = 1 }
    is_code && /library\.a/ { sum += hexadecimal($(NF - 1)) }
    is_code && /0x/ { is_code = 0 }
    END { print sum }'), stack of ${*}:$deepest"
}

for suffix in _f32 _f32_fused _f64 _f64_fused; do
  define=()
  [[ $suffix != _f64* ]] || define+=(-DLQG_REAL_DOUBLE)
  [[ $suffix != *_fused ]] || define+=(-DLQG_FUSED)
  mkdir -p "$folder/$suffix"
  (
    cd "$folder/$suffix" && "${compiler[@]}" "${define[@]}" -c "$lqg_root"/src/*.c &&
      arm-none-eabi-ar rcs library.a ./*.o
  )
  for filter in steady plain ud; do
    measure $filter kalman_${filter}_{init,partial_update,predict}
    measure "$filter, whole update" kalman_${filter}_{init,update,predict}
  done
  measure law lqr_control
  measure "limits that are foreseen" mpc_limit
  measure "steady and servo without a memory" kalman_steady_{init,partial_update,predict} servo_{init,control}
  measure "steady and servo" kalman_steady_{init,partial_update,predict} servo_{init,control,advance}
  measure "steady, servo and integrals" kalman_steady_{init,partial_update,predict} servo_{init,control,advance,observe}
done
