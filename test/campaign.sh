#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Long campaigns: for as long as it takes to meet what is rare. The tests run a sample of each, test/README.md says
# which.
#
#   test/campaign.sh                             lists them, and how long they take
#   test/campaign.sh <build> soak [samples]      every controller of test/soak: default 100000000 samples
#   test/campaign.sh <build> bits [core]…        test/bits/targets.sh: every core, compiler, level and mode; WAYS=1: one
#                                                of the twenty ways of each core
#   test/campaign.sh <build> random [designs]    random designs, emitted, compiled and compared: default 1000
#   test/campaign.sh <build> fuzz [seconds]      the library's and the design files' fuzzer: default 3600 each
#   test/campaign.sh <build> options [compiler]  test/options/options.sh: options of gcc and clang-19 that may change
#                                                arithmetic, alone and two by two, at four levels
#   test/campaign.sh <build> spikes [samples]    test/simulate/spikes.cpp of every shipped design, and honest samples of
#                                                its compiled header, test/flips/honest.c: default 100000000
#   test/campaign.sh <build> mutants [mutants]   emitted headers and src/, changed in one place: default every change,
#                                                or so many of each part; test/mutants
#   test/campaign.sh <build> proofs              test/proof/prove.sh of every design of this project, in both styles
#   test/campaign.sh <build> flips [flips]       every bit of the state of every controller, in both styles, and of 72
#                                                random designs, flipped once in closed loop: default all, or so many of
#                                                each; test/flips
#   test/campaign.sh <build> foresight [states]  random states of every design whose limits are foreseen, in float and
#                                                double, by the conditions of an optimum, and a thousandth as many by
#                                                another solver: default 1000000; test/foresight
#   test/campaign.sh <build> functions [share]   the error of each function of lqg/functions.h for all floats, or for
#                                                every share-th, and for 7 million doubles, or a share of them;
#                                                test/src/functions
#
# <build> is a build with tests, as test/run.sh leaves it in build/. For fuzz it has to be by clang: CC=clang-19
# test/run.sh. A campaign has parts, of which as many run side by side as there are processors. It ends at the first
# part that fails. Everything is written below <build>/campaign/NAME, or below FOLDER: summary.txt, and a folder for
# each part with its log.txt and what else it writes. A fuzzer keeps its corpus there, and begins with it the next time.
#
# Exit status 0: all parts have passed; 1: one has failed; 2: the command line is wrong, or something is not there. Bash
# 5.1.
set -euo pipefail
# shellcheck source-path=SCRIPTDIR source=../codegen/cmake/setup.sh
source "$(dirname "${BASH_SOURCE[0]}")/../codegen/cmake/setup.sh"
# shellcheck source-path=SCRIPTDIR source=bench/cores.sh
source "$lqg_root/test/bench/cores.sh"

list() {
  cat <<'END'
test/campaign.sh <build> <campaign>             on two processors
  soak [samples]    default 100000000            5 minutes
  bits [core]...    default all nine             7 minutes
  random [designs]  default 1000                10 minutes
  fuzz [seconds]    default 3600, of each        1 hour
  options [compiler] default both                6 hours
  spikes [samples]  default 100000000            3 minutes
  mutants [count]   default all of each part     2 hours
  flips [count]     default all of each part    2 minutes
  proofs                                        15 minutes
  foresight [states] default 1000000             6 minutes
  functions [share] default 1: all floats       half an hour
END
}

refuse() {
  echo "$1" >&2
  exit 2
}

# number <default> [argument]: the argument, if there is one; it has to be a number above 0.
number() {
  local found=${2:-$1}
  [[ $found =~ ^[1-9][0-9]{0,11}$ ]] || refuse "expected a number above 0, found: $found"
  echo "$found"
}

# ---- parts side by side ------------------------------------------------------------------------------------------

declare -A part_of=() began=() # running parts by their process, and the second in which they began
count=0 passed=0               # parts of this campaign, and those that have passed

say() { echo "$*" | tee -a "$folder/summary.txt"; }

# start <part> <command>…: in a folder of its own.
start() {
  local part=$1
  shift
  [ ${#part_of[@]} -lt "$(getconf _NPROCESSORS_ONLN)" ] || finish_one
  mkdir -p "$folder/$part"
  say "$part begins"
  (cd "$folder/$part" && TMPDIR=$PWD exec "$@") >"$folder/$part/log.txt" 2>&1 &
  part_of[$!]=$part began[$!]=$SECONDS
}

finish_one() {
  local process status=0 part
  wait -n -p process || status=$?
  part=${part_of[$process]}
  unset "part_of[$process]"
  [ $status = 0 ] || fail "$part" "$status"
  passed=$((passed + 1))
  say "$passed of $count: $part has passed in $((SECONDS - began[$process])) s: $(tail -n 1 "$folder/$part/log.txt")"
}

finish_all() {
  while [ ${#part_of[@]} -gt 0 ]; do
    finish_one
  done
  say "$campaign: all $count parts have passed in $SECONDS s"
  exit
}

fail() {
  tail -n 20 "$folder/$1/log.txt"
  say "FAILED: $1, with status $2: $folder/$1/log.txt"
  say "$campaign: FAILED after $SECONDS s; $passed of $count parts have passed"
  exit 1
}

# Each part is a process group of its own, which ends with the campaign.
# shellcheck disable=SC2317  # a trap calls it
end_all() {
  local process
  for process in "${!part_of[@]}"; do
    kill -- "-$process" 2>/dev/null || true
  done
}

# ---- the campaigns -----------------------------------------------------------------------------------------------

# parts_of <design file>…: parts gets each design in each style, but for straight-line code of several plants and the
# compact style of other numbers than x̂, which there are not.
parts_of() {
  local name style
  for name in "$@"; do
    for style in unrolled compact; do
      case $style in
        unrolled) ! grep -q '^\[\[stage\]\]' "$name" || continue ;;
        compact) ! grep -qE '^(realisation|gain *= *"extended")' "$name" || continue ;;
      esac
      parts+=("$(basename "$name" .toml).$style")
    done
  done
}

# keep_parts: those that PARTS asks for.
keep_parts() {
  mapfile -t parts < <(printf '%s\n' "${parts[@]}" | grep -E -- "${PARTS:-}")
  count=${#parts[@]}
  [ "$count" -gt 0 ] || refuse "no part of $campaign is called ${PARTS:-}"
}

# Two parts for each shipped design. PARTS: a regular expression of those to take.
spikes() {
  local samples parts=() part name design program=$build/test/simulate/spikes run=$lqg_root/test/flips/honest.py
  samples=$(number 100000000 "$@")
  [ -x "$program" ] || refuse "Not found: $program"
  lqg_has_command python3 || refuse "Not found: python3"
  for name in "$lqg_root"/codegen/designs/*.toml; do
    parts+=("$(basename "$name" .toml)".{spikes,honest})
  done
  keep_parts
  for part in "${parts[@]}"; do
    design=$lqg_root/codegen/designs/${part%.*}.toml
    case $part in
      *.spikes) start "$part" "$program" "$design" ;;
      *.honest) start "$part" python3 -B "$run" "$build" "$design" unrolled --samples "$samples" ;;
    esac
  done
}

soak() {
  local samples file programs=()
  samples=$(number 100000000 "$@")
  for file in "$build"/test/soak/soak_*; do
    if [ -f "$file" ] && [ -x "$file" ]; then
      programs+=("$file")
    fi
  done
  count=${#programs[@]}
  [ "$count" -gt 0 ] || refuse "Not found: programs in $build/test/soak"
  for file in "${programs[@]}"; do
    start "$(basename "$file")" "$file" "$samples"
  done
}

bits() {
  local absent=
  options=()
  [ -e "$build/test/bits/controllers/controllers.h" ] || refuse "Not found: $build/test/bits/controllers"
  [ $# -gt 0 ] || set -- "${every_core[@]}"
  for core in "$@"; do
    [[ " ${every_core[*]} " == *" $core "* ]] || refuse "no core $core: expected one of ${every_core[*]}"
    select_core "$core"
    absent+=$(missing_tools)
  done
  lqg_has_command clang-19 || absent+=" clang-19"
  [ -z "$absent" ] || refuse "Not found:$absent"
  count=$#
  for core in "$@"; do
    start "$core" "$lqg_root/test/bits/targets.sh" "$build" "$core"
  done
}

# A hundred designs a part. The tests have the first seeds.
random() {
  local designs seed here program=$build/test/codegen/emit/test_emit_emitted
  designs=$(number 1000 "$@")
  [ -x "$program" ] || refuse "Not found: $program"
  count=$(((designs + 99) / 100))
  for ((seed = 0; seed < designs; seed += 100)); do
    here=$((designs - seed < 100 ? designs - seed : 100))
    start "seeds_from_$((1000 + seed))" "$program" $((1000 + seed)) "$here"
  done
}

# fuzz_one <part> <program> <folder or file to begin with> <option>…: a minute or less, a sample, has a seed of its own;
# a campaign another one each time.
fuzz_one() {
  local part=$1 program=$2 seeds=$3 seed=()
  shift 3
  [ "$seconds" -gt 60 ] || seed=(-seed=1)
  mkdir -p "$folder/$part/corpus"
  start "$part" "$program" "-max_total_time=$seconds" -timeout=10 "${seed[@]}" "$@" corpus "$seeds"
}

fuzz() {
  local seconds library=$build/test/src/fuzz_library files=$build/test/codegen/input/fuzz_design_file
  seconds=$(number 3600 "$@")
  [ ! -x "$library" ] || count=$((count + 1))
  [ ! -x "$files" ] || count=$((count + 1))
  [ "$count" -gt 0 ] ||
    refuse "Not found: fuzzers in $build; they come with clang and its runtime library: CC=clang-19 test/run.sh"
  [ ! -x "$library" ] || fuzz_one library "$library" "$lqg_root/test/src/fuzz_corpus" -max_len=2000
  [ ! -x "$files" ] || fuzz_one design_files "$files" "$lqg_root/codegen/designs" -max_len=4000 \
    "-dict=$lqg_root/test/codegen/input/fuzz_design_file.dict"
}

options() {
  local compiler level number=0
  [ -e "$build/test/bits/controllers/controllers.h" ] || refuse "Not found: $build/test/bits/controllers"
  [ $# -gt 0 ] || set -- gcc clang-19
  for compiler in "$@"; do
    [[ $compiler =~ ^(gcc|clang-19)$ ]] || refuse "no compiler $compiler: expected gcc or clang-19"
    lqg_has_command "$compiler" || refuse "Not found: $compiler"
  done
  count=$(($# * 4))
  for compiler in "$@"; do
    for level in "-O0 -mfma" "-O2 -march=native" "-O3 -march=native -flto" "-Os -march=native -x c++"; do
      number=$((number + 1))
      start "${compiler}_$number" "$lqg_root/test/options/options.sh" "$build" pairs "$compiler" "$level"
    done
  done
}

# A part for each header, another for each file of the library. PARTS as above.
mutants() {
  local sample=(--sample "$(number 999999 "$@")") parts=() part name run=$lqg_root/test/mutants/mutants.py
  lqg_has_command python3 || refuse "Not found: python3"
  for name in two_mass double_integrator balancing_robot oven; do
    parts+=("$name.unrolled" "$name.compact")
  done
  parts+=(folded.unrolled)
  for name in "$lqg_root"/src/*.c; do
    parts+=("$(basename "$name")")
  done
  keep_parts
  for part in "${parts[@]}"; do
    name=$(compgen -G "$lqg_root/*/designs/${part%.*}.toml" || true)
    case $part in
      *.c) start "$part" python3 -B "$run" "$build" src "$part" "${sample[@]}" ;;
      *) start "$part" python3 -B "$run" "$build" header "$name" "${part#*.}" "${sample[@]}" ;;
    esac
  done
}

# A part for each design and style, another for each random design. PARTS as above.
flips() {
  local sample=(--sample "$(number 999999 "$@")") parts=() part name run=$lqg_root/test/flips/flips.py
  lqg_has_command python3 || refuse "Not found: python3"
  parts_of "$lqg_root"/codegen/designs/*.toml "$lqg_root"/test/designs/*.toml
  for name in {1..72}; do
    parts+=("$name.unrolled")
  done
  keep_parts
  for part in "${parts[@]}"; do
    name=${part%.*}
    [[ $name =~ ^[0-9]+$ ]] || name=$(compgen -G "$lqg_root/*/designs/$name.toml")
    start "$part" python3 -B "$run" "$build" "$name" "${part##*.}" "${sample[@]}"
  done
}

# Of each design that foresees limits a part for each real, and one beside DAQP where the tools of test/foresight are
# there. PARTS as above.
foresight() {
  local states parts=() part name run=$lqg_root/test/foresight tools=$build/test/foresight/tools/bin/python
  states=$(number 1000000 "$@")
  lqg_has_command python3 || refuse "Not found: python3"
  for name in "$lqg_root"/codegen/designs/*.toml "$run"/designs/*.toml; do
    awk '/^\[/ { table = $1 } table == "[limits]" && /^horizon *=/ { found = 1 } END { exit !found }' "$name" ||
      continue
    parts+=("$(basename "$name" .toml)".{float,double})
    [ ! -x "$tools" ] || parts+=("$(basename "$name" .toml).answers")
  done
  keep_parts
  for part in "${parts[@]}"; do
    name=$(compgen -G "$lqg_root/codegen/designs/${part%.*}.toml" || echo "$run/designs/${part%.*}.toml")
    case $part in
      *.answers) start "$part" "$tools" -B "$run/answers.py" "$build" "$name" $((states / 1000 + 50)) ;;
      *) start "$part" python3 -B "$run/foresight.py" "$build" "$name" "${part##*.}" conditions "$states" ;;
    esac
  done
}

# A part for each function of each scalar. PARTS as above.
functions() {
  local share parts=() part name tests=$build/test/src/functions
  share=$(number 1 "$@")
  for name in float double; do
    [ -x "$tests/${name}_errors" ] || refuse "Not found: $tests/${name}_errors"
    while read -r part; do
      parts+=("$name.$part")
    done < <("$tests/${name}_errors" list)
  done
  keep_parts
  for part in "${parts[@]}"; do
    case $part in
      float.*) start "$part" "$tests/float_errors" "$share" "${part#*.}" ;;
      double.*) start "$part" "$tests/double_errors" $((1000000 / share + 1)) "${part#*.}" ;;
    esac
  done
}

# A part for each design and style. PARTS as above.
proofs() {
  local parts=() part design
  lqg_has_command frama-c || refuse "Not found: frama-c"
  export LQGEN=$build/codegen/lqgen
  [ -x "$LQGEN" ] || refuse "Not found: $LQGEN"
  parts_of "$lqg_root"/codegen/designs/*.toml "$lqg_root"/test/designs/*.toml "$lqg_root"/test/proof/designs/*.toml
  keep_parts
  for part in "${parts[@]}"; do
    design=$(find "$lqg_root"/codegen/designs "$lqg_root"/test/designs "$lqg_root"/test/proof/designs \
      -name "${part%.*}.toml")
    start "$part" "$lqg_root/test/proof/prove.sh" "$design" --style "${part#*.}" -o .
  done
}

# ---- the command line --------------------------------------------------------------------------------------------

# All of the script is read before a campaign begins: bash reads a file as it goes, and this one may change meanwhile.
main() {
  if [ $# = 0 ]; then
    list
    exit
  fi
  [ $# -ge 2 ] || refuse "expected a build and a campaign, found: $*; test/campaign.sh lists the campaigns"
  [ -f "$1/CTestTestfile.cmake" ] || refuse "expected a build with tests, found: $1"
  build=$(cd "$1" && pwd) campaign=$2
  shift 2
  case $campaign in
    soak | random | fuzz | options | spikes | mutants | flips | foresight | functions)
      [ $# -le 1 ] || refuse "$campaign: expected one number at most, found: $*"
      ;;
    bits) ;;
    proofs) [ $# = 0 ] || refuse "proofs: expected nothing more, found: $*" ;;
    *) refuse "no campaign $campaign: test/campaign.sh lists them" ;;
  esac
  mkdir -p "${FOLDER:-$build/campaign}/$campaign"
  folder=$(cd "${FOLDER:-$build/campaign}/$campaign" && pwd)
  : >"$folder/summary.txt"
  set -m
  trap end_all EXIT
  trap 'exit 130' INT TERM
  case $campaign in
    soak) soak "$@" ;;
    spikes) spikes "$@" ;;
    bits) bits "$@" ;;
    random) random "$@" ;;
    fuzz) fuzz "$@" ;;
    options) options "$@" ;;
    mutants) mutants "$@" ;;
    flips) flips "$@" ;;
    foresight) foresight "$@" ;;
    functions) functions "$@" ;;
    proofs) proofs ;;
  esac
  finish_all
}
main "$@"
