# SPDX-License-Identifier: MIT
# restate_library <folder>: the library's sources into the folder, restated for the prover; see README.md.
restate_library() {
  cp "$root"/src/*.[ch] "$1"
  sed -i 's/return a - a == 0;/return FINITE(a);/' "$1/kernel.h"
  local below='return limits ? absolute(a) < limits\[i\] : is_finite(a);'
  sed -i "s/$below/return limits ? BELOW(a, limits[i]) : is_finite(a);/" "$1/kernel.h"
  local within='perhaps_all_scaled_below(state->x, kalman->x_scale, kalman->plant.nx)'
  sed -i "s/^    if (is_within_bounds(&check))\$/    if ($within)/" "$1/kalman_steady.c"
  local P='perhaps_diagonal_below(state->P, kalman->x_scale, kalman->plant.nx)'
  local factors='perhaps_factors_below(state->U, state->d, kalman->x_scale, nx)'
  sed -i "s/recover(kalman, state, is_within_bounds(&check), /recover(kalman, state, $within, /" \
    "$1"/kalman_{plain,ud}.c
  sed -i "s/^    const int x_is_fit = is_within_bounds(&check);\$/    const int x_is_fit = $within;/" \
    "$1"/kalman_{plain,ud}.c
  sed -i "s/recover(kalman, state, x_is_fit, is_within_bounds(&check))/recover(kalman, state, x_is_fit, $P)/" \
    "$1/kalman_plain.c"
  sed -i "s/recover(kalman, state, x_is_fit, is_within_bounds(&check))/recover(kalman, state, x_is_fit, $factors)/" \
    "$1/kalman_ud.c"
  sed -i '0,/is_within_bounds(&check)/s//perhaps_all_finite(state->x, ekf->nx)/; s/!is_within_bounds(&check)/any_int/' \
    "$1/ekf.c"
  local theta='perhaps_all_finite(state->theta, rls->ntheta)'
  sed -i "0,/is_within_bounds(&check)/s//$theta/; s/!is_within_bounds(&check)/any_int/" "$1/rls.c"
  local xi='perhaps_all_scaled_below(state->xi, servo->xi_scale, servo->nxi)'
  local applied='(!state->u_applied || perhaps_all_finite(state->u_applied, servo->nu))'
  sed -i "s/^    if (is_within_bounds(&check))\$/    if ($xi \\&\\& $applied)/" "$1/servo.c"
  local known='/*@ dynamic_split n; */ /*@ dynamic_split blocking; */' # so that the active rows are told apart
  sed -i "s|^    unsigned n = 0, blocking = 0;\$|&\n    $known|" "$1/mpc.c"
  sed -i 's/if (\(lowest\|highest\) /if (\1 == \1 \&\& \1 /' "$1/mpc.c"
  local inside='perhaps_all_within(u, mpc->low, mpc->high, mpc->nu)' # what foresee has found
  sed -i "s/if (foresee(mpc, state, x, u))/if (foresee(mpc, state, x, u) \\&\\& $inside)/" "$1/mpc.c"
  [ "$(grep -l perhaps_all "$1"/{kalman_*,ekf,rls,servo}.c | wc -l)" = 6 ] && grep -q 'BELOW(a' "$1/kernel.h" &&
    grep -q dynamic_split "$1/mpc.c" && grep -q perhaps_all_within "$1/mpc.c" &&
    grep -q 'highest == highest' "$1/mpc.c" &&
    ! grep -q 'is_within_bounds(&check)' "$1"/{kalman_*,ekf,rls,servo}.c || {
    echo "not understood: the library's test of its state reads otherwise than it did" >&2
    return 1
  }
}

# restate_functions <folder>: the elementary functions into the folder, with comparisons of bits as comparisons of the
# numbers, signs that are any, and any number of [0, 1] for the ratio of a smaller number to a larger one.
restate_functions() {
  local file scalar f one
  mkdir -p "$1/lqg"
  cp "$root"/include/lqg/functions*.h "$1/lqg"
  sed -i 's/return .*(sign & 0x8.*/return any_int ? x : -x;/
    s/lqg_sqrt\(f\{0,1\}([a-z]* x)\)/not_sqrt\1/' "$1/lqg/functions_bits.h"
  for file in "$1"/lqg/functions_{float,double}.h; do
    scalar=double f='' one=1.0
    [[ $file != *float.h ]] || scalar=float f=f one=1.0f
    sed -i "s/lqg_of_bits$f(a\(_bits\)\{0,1\})/(x < 0 ? -x : x)/
      s/\<a\(_bits\)\{0,1\} > 0x4\(6\|13\)0*u/!(x >= -LQG_ANGLE_MAX${f^^} \&\& x <= LQG_ANGLE_MAX${f^^})/
      s/\<a > 0x3f\(8\|f\)0*u) \/\* π/t > $one) \/\* π/
      s/\<a > 0x3f\(8\|f\)0*u/!(x >= -$one \&\& x <= $one)/
      s/\<a <= 0x3f\(1\|e2\)0*u/x >= -0.5625$f \&\& x <= 0.5625$f/
      s/\<a > 0x7f\(8\|f\)0*u/x != x/
      s/(bits & 0x7f*u) > 0x7f\(8\|f\)0*u/x != x/
      s/\<a <= 0x3f\(0c*\|e19*\).u/t <= 0.5500001$f/
      s/t = small == .*/t = any_ratio$f();/
      s/lqg_\(reduce\|exp_within\|sqrt\)\(f\{0,1\}([a-z]* [ax][,)]\)/not_\1\2/
      s/^        a = a [-+] quarters \* 2.*e-.*/        a = any_${scalar}_within(-3.2$f, 3.2$f);/" "$file"
    [ "$(grep -c 'LQG_ANGLE_MAXF\{0,1\} && x' "$file") $(grep -c 'x != x' "$file")" = "5 3" ] &&
      [ "$(grep -c "x <= $one)" "$file") $(grep -c 'x <= 0.5625' "$file")" = "2 2" ] &&
      grep -q "t > $one)" "$file" && grep -q 't <= 0.55' "$file" && grep -q any_ratio "$file" &&
      [ "$(grep -c "not_\|any_${scalar}_within" "$file") $(grep -c not_ "$1/lqg/functions_bits.h")" = "3 2" ] &&
      grep -q 'any_int ? x : -x' "$1/lqg/functions_bits.h" || {
      echo "not understood: ${file##*/} reads otherwise than it did" >&2
      return 1
    }
  done
}
