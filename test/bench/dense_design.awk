# SPDX-License-Identifier: MIT
# A design file with a random dense plant of this size, some of whose modes grow:
# awk -f dense_design.awk -v nx=12 -v nu=4 -v ny=6. The same bytes everywhere.

# −1 … 1. Products stay below 2^53.
function random() {
  state = (state * 16807) % 2147483647
  return 2 * state / 2147483647 - 1
}

function list(count, value,    i, out) {
  for (i = 1; i <= count; i++) out = out (i > 1 ? ", " : "") value
  return "[" out "]"
}

function matrix(rows, columns, scale,    i, j, row, out) {
  for (i = 0; i < rows; i++) {
    row = ""
    for (j = 0; j < columns; j++) row = row (j ? ", " : "") sprintf("%.6g", scale * random())
    out = out (i ? ",\n     " : "") "[" row "]"
  }
  return "[" out "]"
}

BEGIN {
  state = 55434
  for (i = 0; i < 20; i++) random()
  print "name = \"random_" nx "\"\n[plant]\ndomain = \"discrete\"\nsample_time = 0.01"
  print "A = " matrix(nx, nx, 1.62 / sqrt(nx)) "\nB = " matrix(nx, nu, 1) "\nC = " matrix(ny, nx, 1)
  print "[lqr]\nQ = " list(nx, 1) "\nR = " list(nu, 1) "\ncost = \"discrete\""
  print "[kalman]\nprocess_noise = " list(nx, 0.01) "\nmeasurement_noise = " list(ny, 0.1) "\nnoise = \"discrete\""
  print "gain = \"steady\"\n[code]\nflash = 1000000\nreal = \"float\""
}
