#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How long `lqgen simulate --runs` takes: processor and wall time, and microseconds of processor a sample.
#
#   test/bench/monte_carlo.sh [RUNS]      of each scenario below; 10,000 unless told
#
# Times differ from machine to machine; compare those of one run.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$root/codegen/cmake/setup.sh"
lqg_find_lqgen

runs=${1:-10000}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Of a design and a scenario: one run with all its samples says how many there are.
measure() {
  local design=$root/codegen/designs/$1.toml scenario=$2 samples seconds
  "$LQGEN" simulate "$design" --scenario "$scenario" --quiet -o "$folder"
  samples=$(($(cat "$folder/$1"_*.csv | wc -l) - 1))
  rm "$folder"/*
  TIMEFORMAT="%U %R"
  seconds=$({ time "$LQGEN" simulate "$design" --scenario "$scenario" --runs "$runs" --quiet -o "$folder" >/dev/null \
    2>&1; } 2>&1)
  rm "$folder"/*
  awk -v name="$1, $scenario" -v runs="$runs" -v samples="$samples" '{
    printf "| %s | %d | %d | %.1f | %.1f | %.2f |\n", name, runs, samples, $1, $2, 1e6 * $1 / (runs * samples)
  }' <<<"$seconds"
}

echo "| scenario | runs | samples | processor, s | wall, s | µs a sample |"
echo "| --- | ---: | ---: | ---: | ---: | ---: |"
measure servo "heavy and late"
measure servo "bad cable"
measure balancing_robot "pushed"
