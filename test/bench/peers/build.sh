# SPDX-License-Identifier: MIT
# For bash scripts, to be sourced after setup.sh and cores.sh: how the contestants of a model are made and built for a
# core. A model is a folder, $here, with what make_model puts there; `name` and `kind` (constant, carried) say what it
# is. `folder` is where all work is done, `peers` this folder, `eigen` that of Eigen's headers.

cmsis_version=1.10.3

fetch_cmsis() {
  cmsis=$folder/cmsis
  if [ ! -e "$cmsis/Include" ]; then
    mkdir -p "$cmsis"
    "$lqg_root/test/sdist.sh" setuptools.build_meta cmsisdsp $cmsis_version "$peers/cmsisdsp.txt" "$cmsis" 1
  fi
}

# SymForce and what measures.
fetch_python() {
  python=$folder/venv/bin/python
  if ! cmp -s "$peers/requirements.txt" "$folder/venv/requirements.txt"; then
    python3 -m venv --clear "$folder/venv"
    "$python" -m pip --quiet --disable-pip-version-check install --require-hashes \
      --requirement "$peers/requirements.txt"
    cp "$peers/requirements.txt" "$folder/venv"
  fi
}

# ---- the model ---------------------------------------------------------------------------------------------------

# without_extras <lines of [kalman]> <line of [code]> <design>: the design without what the others do not have.
without_extras() {
  sed -e '/^\(gain\|covariance\|form\|gate\|spikes\|realisation\|arithmetic\|style\|flash\) *=/d' "$3" |
    awk -v kalman="$1" -v code="$2" '
      /^\[/ { left_out = /^\[+(limits|require|scenario)/ }
      !left_out
      /^\[kalman\]/ { print kalman }
      /^\[code\]/ { print code; has_code = 1 }
      END { if (!has_code) print "[code]\n" code }'
}

# emit <contestant> <line of [code]> <style>: $here/CONTESTANT.h; fails where lqgen refuses.
emit() {
  local made=$here/$1 lines='gain = "steady"'
  [ "$kind" = constant ] || lines='gain = "online"\ncovariance = "plain"'
  mkdir -p "$made"
  rm -f "$here/$1.h"
  without_extras "$lines" "$2" "$design" >"$made/$name.toml"
  "$LQGEN" "$made/$name.toml" -o "$made" --quiet --style "$3" --real float --only h,json 2>"$made/said" || return 1
  mv "$made/$name.h" "$here/$1.h"
}

# A header without the comment at its top, which names the design file.
code_of() { sed -n '/^#ifndef/,$p' "$here/$1.h"; }

# The emitted headers, the numbers for the others, and what SymForce writes for them, unless they stand for all that
# goes into them. Says so where lqgen refuses.
make_model() {
  local key
  key=$(sha256sum "$LQGEN" "$design" "$peers"/{build.sh,model.py,symforce_code.py})
  [ "$key" != "$(cat "$here/key" 2>/dev/null)" ] || return 0
  rm -f "$here/plain.h"
  if [ "$kind" = carried ] && grep -q '^covariance *= *"ud"' "$design"; then
    echo "$name, carried, is left out: it needs the factors U diag(d) Uᵀ, which the others have not" >&2
    return
  fi
  if ! emit plain '' unrolled; then
    echo "$name, $kind, is left out: $(head -n 1 "$here/plain/said")" >&2
    return
  fi
  emit fused 'arithmetic = "fused"' unrolled || lqg_stop "$(cat "$here/fused/said")"
  emit compact '' compact || lqg_stop "$(cat "$here/compact/said")"
  emit cheapest 'realisation = "cheapest"' unrolled || lqg_stop "$(cat "$here/cheapest/said")"
  ! cmp -s <(code_of plain) <(code_of cheapest) || rm "$here/cheapest.h"
  "$python" "$peers/model.py" "$here/plain/$name.json" "$kind" >"$here/model.h" || exit 1
  write_by_symforce
  echo "$key" >"$here/key"
}

# A minute for 12 states without zeros: kept for as long as the model stays.
write_by_symforce() {
  local key
  key=$(sha256sum "$peers/symforce_code.py" "$peers/requirements.txt" "$here/model.h")
  [ "$key" != "$(cat "$here/symforce/key" 2>/dev/null)" ] || return 0
  rm -rf "$here/symforce"
  "$python" "$peers/symforce_code.py" "$here/plain/$name.json" "$kind" "$here/symforce" >/dev/null || exit 1
  echo "$key" >"$here/symforce/key"
}

# Those of the model on the selected core: with fused multiply-adds where the hardware has them.
contestants_of_core() {
  contestants=(plain compact eigen eigen_tuned cmsis symforce)
  [ ! -e "$here/cheapest.h" ] || contestants+=(cheapest)
  [[ " $fused_reals " != *" float "* ]] || contestants+=(fused)
}

# ---- the core ----------------------------------------------------------------------------------------------------

# select_target <core or x86-64>: as select_core, and g++ with its options. Code of a Cortex-M0 runs on a Cortex-M3,
# which executes the same instructions and has more memory.
select_target() {
  if [ "$1" = x86-64 ]; then
    core=$1 fused_reals='' archiver=ar
    compiler=(gcc -fPIC -ffunction-sections "${options[@]}" "-I$lqg_root/include")
  else
    select_core cortex-m3
    local roomy_linked=("${linked[@]}") roomy_machine=("${machine[@]}") roomy_megahertz=$megahertz
    select_core "$1"
    if [ "$1" = cortex-m0 ]; then
      linked=("${roomy_linked[@]}") machine=("${roomy_machine[@]}") megahertz=$roomy_megahertz
    fi
  fi
  cxx=("${compiler[0]/gcc/g++}" "${compiler[@]:1}" -std=c++17 -DNDEBUG -fno-exceptions -fno-rtti
       -fno-threadsafe-statics -fno-math-errno)
  work=$folder/cores/$core
}

# print_sections <what> <pattern> <program>
print_sections() {
  "$size" -A "$3" | awk -v what="$1" -v pattern="^\\\\.($2)" \
    '$1 ~ pattern { sum += $2 } END { print what "=" sum + 0 }'
}

# The library in both arithmetics, and what measures.
compile_once() {
  make_library plain
  make_library fused -DLQG_FUSED -DLQG_SLOW_FUSED
  [ "$core" != x86-64 ] || return 0
  "${compiler[@]}" -c "$startup" -o "$work/startup.o"
  "${compiler[@]}" "-DMEGAHERTZ=$megahertz" -c "$bench/counter_$family.c" -o "$work/counter.o"
  "${compiler[@]}" -c "$peers/no_memory.c" -o "$work/no_memory.o"
}

# make_library <plain or fused> [option]…
make_library() {
  mkdir -p "$work/$1"
  (cd "$work/$1" && "${compiler[@]}" "${@:2}" -c "$lqg_root"/src/*.c && rm -f library.a &&
    "$archiver" rcs library.a ./*.o)
}

# The options by which a source of this folder finds the model.
flags_of_model() {
  flags=("-I$here" '-DMODEL="model.h"' "-DNAME=$name")
  [ "$kind" = constant ] || flags+=(-DCARRIED)
}

# compile <contestant>: $made.o, and its `library`.
compile() {
  local flags
  flags_of_model
  library=$work/plain/library.a
  case $1 in
    plain | compact | cheapest | fused)
      if [ "$1" = fused ]; then
        flags+=(-DLQG_FUSED)
        library=$work/fused/library.a
      fi
      "${compiler[@]}" "${flags[@]}" "-DHEADER=\"$1.h\"" -c "$peers/emitted.c" -o "$made.o"
      ;;
    cmsis)
      # Without what CMSIS-DSP takes from CMSIS Core: intrinsics that these functions do not use.
      "${compiler[@]}" "${flags[@]}" -w -std=gnu11 -D__GNUC_PYTHON__ -DARM_MATH_LOOPUNROLL \
        -I"$cmsis/Include" -I"$cmsis/PrivateInclude" \
        -r -nostdlib "$peers/cmsis.c" "$cmsis"/Source/MatrixFunctions/arm_mat_{mult,inverse,trans,add,sub}_f32.c \
        "$cmsis"/Source/BasicMathFunctions/arm_{add,sub,negate,scale}_f32.c \
        "$cmsis"/Source/SupportFunctions/arm_{copy,fill}_f32.c -o "$made.o"
      ;;
    symforce)
      "${cxx[@]}" "${flags[@]}" -isystem "$eigen" -I"$here/symforce" -c "$peers/symforce.cpp" -o "$made.o"
      ;;
    *) "${cxx[@]}" "${flags[@]}" -isystem "$eigen" -c "$peers/$1.cpp" -o "$made.o" ;;
  esac
}

# Of all that goes into a contestant.
key_of() {
  local parts=("$here/model.h" "$peers"/{build.sh,peer.h,loop.h,measure.c,cycles.py,no_memory.c})
  case $1 in
    plain | compact | cheapest | fused)
      parts+=("$here/$1.h" "$peers/emitted.c" "$lqg_root"/include/lqg/*.h "$lqg_root"/src/*.[ch])
      ;;
    cmsis) parts+=("$peers"/cmsis{.c,dsp.txt}) ;;
    symforce) parts+=("$peers/symforce.cpp" "$here/symforce"/*.h) ;;
    *) parts+=("$peers/$1.cpp") ;;
  esac
  echo "$name $kind $core ${cxx[*]} $("${compiler[0]}" --version | head -n 1) $(cat "${parts[@]}" | sha256sum)"
}
