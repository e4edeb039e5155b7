#!/usr/bin/env bash
# Proves of one emitted controller what README.md says, by Frama-C's Eva; fails when it cannot.
#
#   test/proof/prove.sh <design.toml> <style> <real> <folder with NAME.h> <folder for scratch> [sed script to break it first]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd) root=$here/../..
design=$1 style=$2 real=$3 emitted=$4 scratch=$5 break=${6:-}

source "$here/restate_library.sh"
stop() { echo "$*" >&2; exit 1; }
value() { sed -n "s/^$1 *= *\"\([a-z0-9_]*\)\".*/\1/p" "$design"; }
numbers() { sed -n "s/^$1 *= *\[\([^]]*\)\].*/{\1}/p" "$design"; }

name=$(value name)
variant=f32
rm -rf "$scratch"
mkdir -p "$scratch"

{
  echo "#define HEADER \"$name.h\""
  echo "#define NAME $name"
  echo "#define UPPER_NAME ${name^^}"
  [ "$real" = float ] || echo "#define LQG_REAL_DOUBLE"
  [ "$(value arithmetic)" != fused ] || echo "#define LQG_FUSED"
  for part in NU NR; do ! grep -q "^#define ${name^^}_$part " "$emitted/$name.h" || echo "#define HAS_$part"; done
  for call in control set_state set_input partial_update; do ! grep -q "^static inline .*${name}_$call(" "$emitted/$name.h" || echo "#define HAS_$call"; done
  for part in P U d; do ! grep -q "^    \(float\|double\) $part\[" "$emitted/$name.h" || echo "#define HAS_$part"; done
  rows=$(sed -n 's/^ *if (self->[a-z_]* < \([0-9]*\))$/, \1/p' "$emitted/$name.h" | tr -d '\n')
  [ -z "$rows" ] || echo "#define LAST_ROWS ${rows#, }"
  [ -z "$(numbers u_min)" ] || printf '#define U_MIN %s\n#define U_MAX %s\n' "$(numbers u_min)" "$(numbers u_max)"
} >"$scratch/design.h"
[ "$real" = float ] || variant=f64
[ "$(value arithmetic)" != fused ] || variant+=_fused

# One statement a line, then restated.
sed -z -e 's/\n *\([-+?:] \)/ \1/g' -e 's/,\n */, /g' "$emitted/$name.h" | sed "$break" | awk -f "$here/restate.awk" >"$scratch/$name.h"
sources=("$here/controller.c") control= state="x within its bounds"
grep -q "^static inline .*${name}_control(" "$scratch/$name.h" && control=${name}_control
if grep -q "^static inline .*${name}_advance(" "$scratch/$name.h"; then  # it keeps z
  sources=("$here/linear_controller.c") control=${name}_control_fault state="z finite"
  ! grep -q "${name}_control(.* y\\[" "$scratch/$name.h" || echo "#define HEARS_FIRST" >>"$scratch/design.h"
fi
if [ "$style" = compact ]; then
  restate_library "$scratch"
  for source in "$scratch"/{kalman_plain,kalman_steady,kalman_ud,factors,plant,lqr,servo,bounds_check}.c; do sources+=("$source"); done
  control=$(grep -o 'lqg_[a-z]*_control' "$scratch/$name.h" | tail -n 1 || true)
  control=${control:+${control}_$variant}
fi

# Loops have fixed lengths: all are unrolled. The paths through the limits of several inputs are kept apart.
frama-c -eva -eva-precision 2 -eva-domains equality -eva-split-return full -eva-auto-loop-unroll 200 -eva-min-loop-unroll 16 \
  ${control:+-eva-slevel-function "$control:10000"} -warn-special-float none -machdep x86_64 \
  -cpp-extra-args="-I$scratch -I$here -I$root/include -include design.h -include unknown.h" \
  "${sources[@]}" >"$scratch/eva.log" 2>&1 || stop "$(tail -n 20 "$scratch/eva.log")"

inputs=0
! grep -q HAS_control "$scratch/design.h" || inputs=1
! grep -q U_MIN "$scratch/design.h" || inputs=2
covariance=$(grep -c 'HAS_[PUd]$' "$scratch/design.h" || true)
checks=$((1 + inputs + covariance))
grep -A 2 '^\[eva:alarm\]' "$scratch/eva.log" >&2 && stop "not proved; see $scratch/eva.log"
grep -q "^  0 alarms generated" "$scratch/eva.log" || stop "not proved; see $scratch/eva.log"
grep -Eq "Assertions +$checks valid +0 unknown +0 invalid +$checks total" "$scratch/eva.log" || stop "not all checks were reached; see $scratch/eva.log"
said=("" ", u finite" ", u finite and within its limits") carried=""
[ "$covariance" = 0 ] || carried=", its covariance after every prediction"
echo "$name, $style, $real: no undefined behaviour, $state$carried${said[inputs]}"
