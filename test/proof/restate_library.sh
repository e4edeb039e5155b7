# restate_library <folder>: the library's sources into the folder, restated for the prover; see README.md.
restate_library() {
  cp "$root"/src/*.[ch] "$1"
  sed -i 's/return a - a == 0;/return FINITE(a);/' "$1/kernel.h"
  sed -i -e 's/^    if (is_finite(sum))$/    if (perhaps_all_finite(x, kalman->plant.nx))/' \
    -e 's/^    if (is_finite(add_all(0, x, kalman->plant.nx)))$/    if (perhaps_all_finite(x, kalman->plant.nx))/' "$1"/kalman_*.c
  sed -i 's/^    if (is_finite(sum))$/    if (perhaps_all_finite(x, ekf->nx))/' "$1/ekf.c"
  sed -i 's/^    if (is_finite(lqg_factors_sum(add_all(0, theta, ntheta), U, d, ntheta)))$/    if (perhaps_all_finite(theta, ntheta))/' "$1/rls.c"
  sed -i 's/^    if (is_finite(sum))$/    if (perhaps_all_finite(xi, servo->nxi) \&\& (!u_applied || perhaps_all_finite(u_applied, servo->nu)))/' \
    "$1/servo.c"
  [ "$(grep -l perhaps_all_finite "$1"/{kalman_*,ekf,rls,servo}.c | wc -l)" = 6 ] || stop "the library's test of its state reads otherwise than it did"
}
