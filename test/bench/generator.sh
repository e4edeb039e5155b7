#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How long lqgen takes, in seconds of the processor (user time): for the header alone and for all four files, of shipped
# designs and of random dense ones with 4, 12, 24 and 50 states; and an answer of its live page, in milliseconds.
#
#   test/bench/generator.sh [RUNS]      the least of so many runs, of 50 states two at most; 5 unless told
#
# Times differ from machine to machine; compare those of one run on a machine that does nothing else.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$root/codegen/cmake/setup.sh"
lqg_find_lqgen

runs=${1:-5}
folder=$(mktemp -d)
server=
finish() {
  [ -z "$server" ] || kill "$server" 2>/dev/null || true
  rm -rf "$folder"
}
trap finish EXIT

TIMEFORMAT=%U

# The least user time of some runs of lqgen with these arguments.
least_time() {
  local count=$1 i
  shift
  for ((i = 0; i < count; ++i)); do
    { time "$LQGEN" "$@" -o "$folder/out" --quiet >/dev/null 2>&1; } 2>&1
  done | sort -g | head -1
}

design_row() {
  local name=$1 states=$2 file=$3 count=$runs
  if [ "$states" -ge 50 ] && [ "$runs" -gt 2 ]; then count=2; fi
  echo "| $name | $states | $(least_time "$count" "$file" --only h) | $(least_time "$count" "$file") |"
}

shipped() { design_row "$1" "$2" "$root/codegen/designs/$1.toml"; }

random() {
  local file=$folder/random_$1.toml
  awk -f "$root/test/bench/dense_design.awk" -v nx="$1" -v nu="$2" -v ny="$3" >"$file"
  design_row "random, $2 inputs, $3 outputs" "$1" "$file"
}

# Processor time of a process, user and system, in clock ticks.
ticks() { awk '{ sub(/.*\) /, ""); print $12 + $13 }' "/proc/$1/stat"; }

# The mean of 20 answers to a request.
answer_time() {
  local url=$1 path=$2 revision=$3 before i
  before=$(ticks "$server")
  for ((i = 0; i < 20; ++i)); do
    curl -sf "$url$path" -H 'Content-Type: application/json' -d "{\"revision\": $revision, \"changes\": []}" \
      >"$folder/answer"
  done
  grep -q '"has_page":true' "$folder/answer"
  awk -v ticks=$(($(ticks "$server") - before)) -v hertz="$(getconf CLK_TCK)" \
    'BEGIN { printf "%.0f", 1000 * ticks / hertz / 20 }'
}

live_row() {
  local url revision
  cp "$root/codegen/designs/$1.toml" "$folder/"
  "$LQGEN" watch "$folder/$1.toml" >"$folder/said" 2>&1 &
  server=$!
  until grep -q 'http://' "$folder/said"; do sleep 0.05; done
  url=$(sed -n 's/.*\(http:[^ ]*\).*/\1/p' "$folder/said")
  revision=$(curl -sf "${url}state?since=0" | sed 's/^{"revision":\([0-9]*\),.*/\1/')
  echo "| $1 | $2 | $(answer_time "$url" look "$revision") | $(answer_time "$url" solve "$revision") |"
  kill "$server"
  wait "$server" 2>/dev/null || true
  server=
}

mkdir "$folder/out"
echo "| design | states | header, s | all files, s |"
echo "| --- | ---: | ---: | ---: |"
shipped two_mass 4
random 4 1 2
shipped quadrotor 12
random 12 1 1
random 12 4 6
random 24 4 6
random 50 4 6

lqg_has_command curl || lqg_stop "The live page is measured by curl, which is not there."
echo
echo "| live page | states | first look, ms | the whole design, ms |"
echo "| --- | ---: | ---: | ---: |"
live_row servo 2
live_row quadrotor 12
