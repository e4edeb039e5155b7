#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Proves of the controller of a design file, yours or ours, what README.md says, by Frama-C's Eva; says what it could
# not prove or does not understand.
#
#   test/proof/prove.sh DESIGN.toml [--style unrolled|compact|auto] [--real float|double] [-o FOLDER] [--try]
#
# --try: the trial before the proof alone, which takes seconds. FOLDER keeps what was proved and the prover's log.
# LQGEN: the lqgen to take, if not that of build/ or on the PATH. BREAK: a sed script that breaks the controller first.
# Exit status: 0 proved, 1 not proved, 2 not understood, 3 something is missing, 4 lqgen refuses the design.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd) root=$(cd "$here/../.." && pwd)
source "$here/restate_library.sh"

stop() { echo "$2" >&2; exit "$1"; }
usage() {
  stop 2 "usage: prove.sh DESIGN.toml [--style unrolled|compact|auto] [--real float|double] [-o FOLDER] [--try]"
}
has() { command -v "$1" >/dev/null 2>&1; }

design='' folder='' only_try='' options=()
while [ $# -gt 0 ]; do
  case $1 in
    --style | --real) [ $# -gt 1 ] || usage; options+=("$1" "$2"); shift ;;
    -o) [ $# -gt 1 ] || usage; folder=$2; shift ;;
    --try) only_try=1 ;;
    -*) usage ;;
    *) [ -z "$design" ] || usage; design=$1 ;;
  esac
  shift
done
[ -n "$design" ] || usage

find_lqgen() {
  if [ -n "${LQGEN:-}" ]; then echo "$LQGEN"
  elif [ -x "$root/build/codegen/lqgen" ]; then echo "$root/build/codegen/lqgen"
  elif has lqgen; then command -v lqgen
  else stop 3 "lqgen is missing: build it (test/run.sh does), or say where it is in LQGEN"
  fi
}
lqgen=$(find_lqgen)
[ -n "$only_try" ] || has frama-c || stop 3 "frama-c is missing (Debian: frama-c-base)"
compiler=${CC:-cc}
has "$compiler" || stop 3 "a C compiler is missing: $compiler"
if [ -z "$folder" ]; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi
mkdir -p "$folder"
log=$folder/eva.log

# What is proved: NAME_proof.h. It has to be NAME.h but for what follows from the tests.
rm -f "$folder"/*_proof.h
"$lqgen" "$design" -o "$folder" --only h,proof --quiet ${options[@]+"${options[@]}"} || stop 4 "lqgen refuses $design"
proof=$(echo "$folder"/*_proof.h)
word() { sed -n "s/^#define PROOF_$1 \\(.*\\)/\\1/p" "$proof"; }
is() { grep -q "^#define PROOF_$1\$" "$proof"; }
name=$(word NAME) header=$folder/$(word NAME).h
text() { "$compiler" -E -P -I"$root/include" "${@:2}" - <"$1" | tr -d ' \n'; }

defines=() style=unrolled real=float variant=f32
! is COMPACT || style=compact
foresees=$(word FORESIGHT)
! is DOUBLE || { defines+=(-DLQG_REAL_DOUBLE) real=double variant=f64; }
! is FUSED || { defines+=(-DLQG_FUSED) variant+=_fused; }
sed 's|/\*@ slevel merge; \*/ ;||' "$proof" >"$folder/same.h"
[ "$(text "$folder/same.h" '-DRESTATED(test,facts)=test' "${defines[@]}")" = "$(text "$header" "${defines[@]}")" ] ||
  stop 2 "not understood: $proof is not $header"
[ -z "${BREAK:-}" ] || sed -i "$BREAK" "$proof"
awk -v name="$name" -f "$here/calls.awk" "$header" >"$folder/calls.h" ||
  stop 2 "prove.sh does not know how to call $header"

# What is said to follow from the tests is tried first.
flags=(-I"$folder" -I"$here" -I"$root/include" "${defines[@]}" "-DHEADER=\"$(basename "$proof")\"")
library=()
[ "$style" = unrolled ] && [ -z "$foresees" ] || library=("$root"/src/*.c)
"$compiler" -std=c99 -O1 -ffp-contract=off "${flags[@]}" -DPROOF_TRIED -include "$here/tried.h" "$here/tried.c" \
  "${library[@]}" -lm -o "$folder/tried" || stop 2 "not understood: $header does not compile with $here/tried.c"
"$folder/tried" || stop 1 "not proved: what should follow from a test does not"
[ -z "$only_try" ] || { echo "$name, $style, $real: tried"; exit 0; }

if [ ${#library[@]} -gt 0 ]; then
  mkdir -p "$folder/library"
  restate_library "$folder/library" || exit 2
  library=("$folder"/library/*.c)
  flags=(-I"$folder/library" "${flags[@]}")
fi

# Limits that are foreseen: first the library's solver with the tables of this controller and anything else of any
# bits, then the controller, which takes it at its word. Which rows are active is not told apart here, as there may be
# many; that only the first n are read, and that n is less than their number where one more is appended, is shown by
# prove_library.sh.
if [ -n "$foresees" ]; then
  begun='for (unsigned i = 0; i < mpc->rows; i++) state->m[i] = 0, state->active[i] = 0;'
  sed -i "/dynamic_split/s|.*|    $begun|; s|if (row < mpc->rows)|if (row < mpc->rows \\&\\& n < mpc->rows)|" \
    "$folder/library/mpc.c"
  grep -q 'active\[i\] = 0;' "$folder/library/mpc.c" && grep -q '&& n < mpc->rows' "$folder/library/mpc.c" ||
    stop 2 "not understood: src/mpc.c reads otherwise than it did"
  frama-c -eva -eva-precision 2 -eva-domains equality -eva-split-return full -eva-slevel-function take:10000 \
    -eva-auto-loop-unroll 200 -eva-min-loop-unroll 16 -warn-special-float none -machdep x86_64 \
    -cpp-extra-args="$(printf '%q ' "${flags[@]}") -include unknown.h" "$here/foresight.c" \
    "$folder"/library/{mpc,kernel}.c >"$folder/foresight.log" 2>&1 ||
    stop 2 "not understood: $(tail -n 20 "$folder/foresight.log")"
  grep -q "^  0 alarms generated" "$folder/foresight.log" &&
    grep -Eq "Assertions +2 valid +0 unknown +0 invalid +2 total" "$folder/foresight.log" ||
    stop 1 "$name: not proved: the limits that are foreseen; see $folder/foresight.log"
  rm "$folder/library/mpc.c"
  library=("$here/foresight_word.c")
  [ "$style" = unrolled ] || library+=("$folder"/library/*.c)
fi
control=$(grep -o 'lqg_[a-z]*_control(' "$header" | tail -n 1 | tr -d '(' || true)
control=${control:+${control}_$variant}
if is GIVES_INPUT; then
  grep -q "${name}_control_fault(" "$header" && control=${name}_control_fault || control=${control:-${name}_control}
fi
# Loops have fixed lengths: all are unrolled. The paths through the limits of several inputs are kept apart, those
# through the function that weighs an output are not: each would double those of all that follows. The library's callers
# look at bits of what it returns.
paths=(-eva-slevel 4)
! is KEEPS_gated || paths+=(-eva-slevel-function "${name}_weigh:0")
[ "$style" = unrolled ] || paths=(-eva-split-return full -eva-slevel-function "lqg_gate_weigh_$variant:0")
frama-c -eva -eva-precision 2 -eva-domains equality "${paths[@]}" -eva-auto-loop-unroll 200 -eva-min-loop-unroll 16 \
  ${control:+-eva-slevel-function "$control:10000"} -warn-special-float none -machdep x86_64 \
  -cpp-extra-args="$(printf '%q ' "${flags[@]}") -include unknown.h" "$here/controller.c" "${library[@]}" \
  >"$log" 2>&1 ||
  stop 2 "not understood: $(tail -n 20 "$log")"

# What was not proved, with the function it is in.
not_proved() {
  awk -v name="$name" '
    FNR == NR {
      if (match($0, "^static .*" name "_[a-z0-9_]+\\(")) { at = substr($0, 1, RLENGTH - 1); sub(/.* /, "", at) }
      within[FNR] = at
      next
    }
    /^\[/ { shows = 0 }
    /^\[eva:alarm\]/ {
      shows = 1
      if (match($0, name "_proof\\.h:[0-9]+")) {
        line = substr($0, RSTART, RLENGTH)
        sub(/.*:/, "", line)
        print within[line + 0] ":"
      }
    }
    shows { print }
  ' "$proof" "$log" | grep -v '^ *stack: .*' | head -n 60 >&2
}

checks=$("$compiler" -E -CC -P "${flags[@]}" -include "$here/unknown.h" "$here/controller.c" | grep -c '/\*@ check')
functions=$(sed -n "s/.*@ check ${name}_\\(.*\\)_returns.*/\\1/p" "$folder/calls.h" | paste -sd ' ')
grep -q "^  0 alarms generated" "$log" || { not_proved; stop 1 "$name, $style, $real: not proved"; }
grep -Eq "Assertions +$checks valid +0 unknown +0 invalid +$checks total" "$log" || {
  not_proved
  reached=$(grep 'Assertions ' "$log" | tr -s ' ' || true)
  stop 1 "$name, $style, $real: not proved; of $checks checks, those that were reached:$reached"
}
said=''
kept=x
! is KEEPS_z || kept=z
if is BOUNDS; then said+=", $kept within its bounds"; elif is KEEPS_z; then said+=', z finite'; fi
! is KEEPS_P && ! is KEEPS_d || said+=', its covariance after every prediction'
! is GIVES_INPUT || said+=', u finite'
[ -z "$(word U_MIN)" ] || said+=' and within its limits'
echo "$name, $style, $real: no undefined behaviour$said"
echo "  whatever comes in, in any order: $functions"
