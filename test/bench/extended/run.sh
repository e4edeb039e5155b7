#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What one sample of an extended Kalman filter costs (update, predict) in float at -O2: what lqgen emits, beside what
# others make of the same model. Equal answers are checked first: x̂ and P of every sample, in float and in double.
#
#   test/bench/extended/run.sh [core]… [model]…    prints the tables
#   test/bench/extended/run.sh --update            writes record.md, too
#   test/bench/extended/run.sh --check             answers and times of the pendulum on this PC, where SymForce, SymPy
#                                                  and NumPy are installed already, for python3 or in FOLDER
#
# A core is one of cortex-m0, cortex-m3, cortex-m4f, cortex-m7 and x86-64; a model one of models/: a pendulum, a cart
# with a pole (both with a Runge-Kutta step a sample), a robot that is seen from a beacon (discrete, with atan2 and
# sqrt). Without any it is all of them.
#
# Contestants. TinyLQG: `step` of the emitted header with the covariance as it is (plain), with fused multiply-adds
# where the hardware has them (fused), and as U diag(d) Uᵀ (ud). SymForce's C++ of the same filter (symforce_code.py),
# with the Jacobian of the Runge-Kutta step as a whole (symforce) and by the chain rule (staged). Loops over matrices in
# the manner of TinyEKF with Jacobians by hand (loops.c), which is code of this benchmark's own. TinyEKF itself is in no
# registry: where TINYEKF names a tinyekf.h (github.com/simondlevy/TinyEKF; the record has that of the commit 1442ecb),
# it competes, too, with the same Jacobians. sin, cos, atan2 and sqrt are those of lqg/functions.h for TinyLQG,
# newlib's for all others, glibc's on x86-64. The compiler fuses multiply-adds of all but TinyLQG where it can. Only the
# emitted code checks anything: measurements, bounds, resets.
#
# Answers. The reference is a filter in double with Jacobians by SymPy (model.py). What differs at most in 301 samples,
# in standard deviations of x̂, and of P relative to its diagonal: less than 5 thousandths in float, 1e-9 in double.
#
# Measures: as in ../peers/run.sh. LQGEN names an lqgen that is there already. FOLDER is where all work is done, default
# build/bench-extended. It takes three minutes. Python's packages and Debian's are those of ../peers/run.sh.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../../../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../../codegen/cmake/setup.sh"
bench=$lqg_root/test/bench peers=$lqg_root/test/bench/peers here=$lqg_root/test/bench/extended
folder=${FOLDER:-$lqg_root/build/bench-extended}
# shellcheck source-path=SCRIPTDIR source=../cores.sh
source "$bench/cores.sh"
# shellcheck source-path=SCRIPTDIR source=../peers/build.sh
source "$peers/build.sh"

every_target=(cortex-m0 cortex-m3 cortex-m4f cortex-m7 x86-64)
every_model=(pendulum cart_pole tracker)

# ---- the models --------------------------------------------------------------------------------------------------

# emit <real> <contestant> <line of [kalman]> <line of [code]>: $folder/MODEL/REAL/CONTESTANT.h
emit() {
  local made=$folder/$model/$1/$2
  mkdir -p "$made"
  { sed "s/^\[kalman\]/&\n$3/" "$here/models/$model.toml" && printf '\n[code]\nflash = 65536\n%s\n' "$4"; } \
    >"$made/$model.toml"
  "$LQGEN" "$made/$model.toml" -o "$made" --quiet --real "$1" --only h || lqg_stop "$model, $1: lqgen refuses $2"
  mv "$made/$model.h" "$made.h"
}

make_model() {
  local real
  mkdir -p "$folder/$model/symforce"
  "$python" "$here/model.py" "$here/models/$model.toml" >"$folder/$model/model.h"
  "$python" "$here/symforce_code.py" "$here/models/$model.toml" "$folder/$model/symforce" >/dev/null
  for real in float double; do
    emit $real plain 'covariance = "plain"' ''
    emit $real ud 'covariance = "ud"' ''
  done
  emit float fused 'covariance = "plain"' 'arithmetic = "fused"'
}

# Those of the model on the selected core.
contestants_of_core() {
  contestants=(plain ud symforce staged loops)
  [ -z "${TINYEKF:-}" ] || contestants+=(tinyekf)
  [[ " $fused_reals " != *" float "* ]] || contestants+=(fused)
}

# compile_contestant <name> <real>: $made.o, and its `library`.
compile_contestant() {
  local flags=("-DREAL=$2" "-I$folder/$model" "-I$here" "-DNAME=$model")
  library=$work/plain/library.a
  case $1 in
    plain | ud | fused)
      [ "$1" != ud ] || flags+=(-DWITH_FACTORS)
      if [ "$1" = fused ]; then
        flags+=(-DLQG_FUSED)
        library=$work/fused/library.a
      fi
      "${compiler[@]}" "${flags[@]}" "-DHEADER=\"$2/$1.h\"" -c "$here/emitted.c" -o "$made.o"
      ;;
    symforce | staged)
      [ "$1" != staged ] || flags+=(-DPREDICT=PredictStaged)
      "${cxx[@]}" "${flags[@]}" -isystem "$eigen" -I"$folder/$model/symforce" -c "$here/symforce.cpp" -o "$made.o"
      ;;
    *)
      [ "$1" != tinyekf ] || flags+=(-w "-DTINYEKF=\"$(realpath "$TINYEKF")\"")
      "${compiler[@]}" "${flags[@]}" -fno-math-errno "-DHAND_WRITTEN=\"models/$model.h\"" -c "$here/loops.c" \
        -o "$made.o"
      ;;
  esac
}

# ---- the measurement ---------------------------------------------------------------------------------------------

# measure_on_core <contestant>: its results as assignments.
measure_on_core() {
  local results error instructions traced off library
  compile_contestant "$1" float
  "${cxx[@]}" "$made.o" "$work/no_memory.o" "${linked[@]}" -Wl,-e,peer_sample,-u,peer_init "$library" -lm \
    -o "$made.footprint.elf"
  "${compiler[@]}" -DREAL=float -DWITH_SAMPLES "-I$folder/$model" -c "$here/measure.c" -o "$made.measure.o"
  "${cxx[@]}" "$made.measure.o" "$work"/{counter,startup,no_memory}.o "$made.o" "${linked[@]}" "$library" -lm \
    -o "$made.elf"
  results=$(timeout 900 "${machine[@]}" "$made.elf") || lqg_stop "$core, $model: $1 does not end well"
  if [ "$core" = cortex-m4f ]; then
    results+=$'\n'$("$python" "$peers/cycles.py" "$made.elf")
  fi
  # shellcheck disable=SC1090  # it has just been made
  source <(echo "$results")
  [ "$error" -lt 5000 ] || lqg_stop "$core, $model: $1 answers something else, by $error millionths"
  off=$((20 * (${traced:-$instructions} - instructions)))
  [ "${off#-}" -lt "$instructions" ] || # more than 5 %
    lqg_stop "$core, $model, $1: QEMU counts $instructions instructions, cycles.py traces $traced"
  { echo "$results"
    print_sections flash 'text|rodata|data|ARM.exidx' "$made.footprint.elf"
    print_sections ram 'data|bss' "$made.footprint.elf"; } | sed -n "s/^\([a-z]*\)=\(.*\)/$core $model $1 \1 \2/p"
}

# race <real> <most that answers may be off>: lines "contestant ns ratio error".
race() {
  local contestant made arguments=() library
  for contestant in "${contestants[@]}"; do
    made=$folder/$model/$core/$contestant-$1
    compile_contestant "$contestant" "$1"
    gcc -shared "$made.o" "$library" -lm -o "$made.so"
    arguments+=("$contestant=$made.so")
  done
  made=$folder/$model/$core/race-$1
  gcc -O2 "-DREAL=$1" -DWITH_SAMPLES "-I$folder/$model" "$here/race.c" -ldl -lm -o "$made"
  "$made" "${arguments[@]}" | awk -v model="$model" -v real="$1" -v most="$2" '
    !($4 < most) { print model ", " real ": " $1 " answers something else, by " $4 >"/dev/stderr"; exit 1 }
    1'
}

measure_on_pc() {
  race float 0.005 | awk -v of="x86-64 $model" '
    { print of, $1, "ns", $2; print of, $1, "ratio", $3; print of, $1, "error", 1e6 * $4 }'
  race double 1e-9 | awk -v of="x86-64 $model" '{ print of, $1, "error_in_double", $4 }'
}

measure() {
  local core model contestant contestants made
  for core in "${cores[@]}"; do
    select_target "$core"
    compile_once
    for model in "${models[@]}"; do
      mkdir -p "$folder/$model/$core"
      contestants_of_core
      if [ "$core" = x86-64 ]; then
        measure_on_pc
        continue
      fi
      for contestant in "${contestants[@]}"; do
        made=$folder/$model/$core/$contestant
        measure_on_core "$contestant"
      done
    done
  done
}

# What --check uses.
find_python() {
  for python in "$folder/venv/bin/python" python3; do
    ! { "$python" -c 'import numpy, symforce, sympy' && [ -e "$eigen/Eigen" ]; } 2>/dev/null || return 0
  done
  return 1
}

# ---- the command line --------------------------------------------------------------------------------------------

tinyekf_version() {
  [ -z "${TINYEKF:-}" ] || echo ", a tinyekf.h with the SHA-256 $(sha256sum "$TINYEKF" | cut -c 1-12)…"
}

print_versions() {
  echo "Made by \`test/bench/extended/run.sh --update\`, which says what is compared and measured, with"
  echo "$(arm-none-eabi-gcc --version | head -n 1) and $(gcc --version | head -n 1), ${options[*]};"
  echo "lqgen $("$LQGEN" --version | head -n 1)," \
    "SymForce $(sed -n 's/^symforce==\([0-9.]*\).*/\1/p' "$peers/requirements.txt")$(tinyekf_version)."
}

options=(-O2) eigen=/usr/include/eigen3 update='' check='' cores=() models=()
for argument in "$@"; do
  case $argument in
    --update) update=yes ;;
    --check) check=yes ;;
    -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;;
    *)
      if [[ " ${every_target[*]} " == *" $argument "* ]]; then
        cores+=("$argument")
      elif [[ " ${every_model[*]} " == *" $argument "* ]]; then
        models+=("$argument")
      else
        lqg_stop "expected an option, a core (${every_target[*]}) or a model (${every_model[*]}), found $argument"
      fi
      ;;
  esac
done
[ -z "$update$check" ] || [ $# = 1 ] || lqg_stop "expected nothing beside --update and --check"
[ -z "$check" ] || { cores=(x86-64) && models=(pendulum); }
[ ${#cores[@]} -gt 0 ] || cores=("${every_target[@]}")
[ ${#models[@]} -gt 0 ] || models=("${every_model[@]}")
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
if [ -n "$check" ]; then
  find_python || { echo "Nothing to compare: no SymForce, SymPy and NumPy, or no Eigen" && exit; }
else
  select_core cortex-m4f
  absent=$(missing_tools)
  [ -z "$absent" ] || lqg_stop "Not found:$absent"
  fetch_python
fi
lqg_find_lqgen
for model in "${models[@]}"; do
  make_model
done
measure >"$folder/results.txt"
"$python" "$here/tables.py" "$folder/results.txt" >"$folder/tables.md"
if [ -n "$update" ]; then
  { echo "# One sample of an extended Kalman filter, beside others" && echo && print_versions && echo &&
    cat "$folder/tables.md"; } >"$here/record.md"
fi
cat "$folder/tables.md"
