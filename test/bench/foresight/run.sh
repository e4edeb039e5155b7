#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What a sample of a law with limits costs by four methods, in multiply-adds, on the same states.
#
#   test/bench/foresight/run.sh [MODEL]…     prints the table
#   test/bench/foresight/run.sh --update     writes record.md, too
#
# A model is the name of a design file in models/; without any it is all three: two masses with a weak force, a servo
# with a limit of speed, the quadrotor of TinyMPC's examples at 50 Hz with the limits of its motors.
#
# States are those of closed loops from random starts in which a limit is active, until none is; STATES says how many,
# default 1000. TinyLQG's solver finds the optimum, exactly and from nothing in each sample, once in single steps and
# once in the blocks that lqgen chooses, which have an optimum of their own: 0 to 0.6 % dearer in the mean. The
# alternating direction method of multipliers (TinyMPC's iteration: admm.h) and the projected fast gradient method
# (gradient.h) have the problem in single steps. They end where u of this sample is within 1e-3 of the range of the
# optimum and stays there, which a target would not know; ρ is the best of nine. Cold: from nothing; warm: from the
# sample before. The last column is the share of samples that 5000 iterations of ADMM, or 20,000 of the gradient method,
# have not been enough for. Every multiply-add of matrices and vectors is counted as it happens (counted.h); divisions,
# projections and comparisons are not.
#
# LQGEN names an lqgen that is there already. FOLDER is where all work is done, default build/bench-foresight. From
# nothing it takes some 5 minutes. Needs gcc and python3.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../../../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../../../codegen/cmake/setup.sh"
here=$lqg_root/test/bench/foresight folder=${FOLDER:-$lqg_root/build/bench-foresight} states=${STATES:-1000}

update='' models=()
for argument in "$@"; do
  case $argument in
    --update) update=yes ;;
    -h | --help) lqg_print_help "${BASH_SOURCE[0]}" && exit ;;
    *)
      [ -f "$here/models/$argument.toml" ] || lqg_stop "no model $argument: expected one in $here/models"
      models+=("$argument")
      ;;
  esac
done
[ ${#models[@]} = 0 ] || [ -z "$update" ] || lqg_stop "the record is of all models: expected --update alone"
[ ${#models[@]} -gt 0 ] || models=(two_masses fast_servo quadrotor_50hz)
lqg_find_lqgen

table() {
  local model work native=()
  ! grep -qs ' fma ' /proc/cpuinfo || native=(-mfma)
  echo "| model | method | mean | worst | not arrived |"
  echo "| --- | --- | ---: | ---: | ---: |"
  for model in "${models[@]}"; do
    work=$folder/$model
    mkdir -p "$work"
    python3 -B "$here/problem.py" "$LQGEN" "$here/models/$model.toml" "$work"
    gcc -std=c99 -O2 "${native[@]}" -DLQG_REAL_DOUBLE -DLQG_FUSED -DLQG_SLOW_FUSED -I"$work" -I"$lqg_root/include" \
      "$here/compare.c" -lm -o "$work/compare"
    "$work/compare" "$model" "$states"
  done
}

mkdir -p "$folder"
table | tee "$folder/table.md"
if [ -n "$update" ]; then
  {
    printf '# Limits that are foreseen, by four methods\n\n'
    printf "Multiply-adds of a sample. Made by \`test/bench/foresight/run.sh --update\`, which says what is counted,\n"
    printf 'with %d states of each model.\n\n' "$states"
    cat "$folder/table.md"
  } >"$here/record.md"
fi
