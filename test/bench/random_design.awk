# A design file with a random plant: awk -f random_design.awk -v seed=7. Stable, dense or chained (each state drives the
# next), up to 24 states; with a constant gain or a covariance, carried as it is or as factors; float or double, both
# styles; the same bytes everywhere.

# 0 … 1. Products stay below 2^53.
function random() {
  state = (state * 16807) % 2147483647
  return state / 2147483647
}
function between(low, high) { return low + (high - low) * random() }
function whole(low, high) { return low + int((high - low + 1) * random()) }
function least(a, b) { return a < b ? a : b }

function list(count, value,    i, out) {
  for (i = 1; i <= count; i++) out = out (i > 1 ? ", " : "") value
  return "[" out "]"
}

function matrix(rows, columns, kind,    i, j, row, out, value) {
  for (i = 0; i < rows; i++) {
    row = ""
    for (j = 0; j < columns; j++) {
      if (!is_chained) value = kind == "A" ? between(-0.9, 0.9) / sqrt(rows) : between(-1, 1)
      else if (kind == "A") value = i == j ? between(0.7, 0.99) : j == i + 1 ? between(0.05, 0.2) : 0
      else if (kind == "B") value = i == rows - 1 - j * int(rows / columns) ? between(0.1, 1) : 0
      else value = j == i * int(columns / rows) ? 1 : 0
      row = row (j ? ", " : "") sprintf("%.6g", value)
    }
    out = out (i ? ",\n     " : "") "[" row "]"
  }
  return "[" out "]"
}

BEGIN {
  state = 1 + seed * 7919
  for (i = 0; i < 20; i++) random()
  is_chained = random() < 0.5
  is_online = random() < 0.5
  is_double = random() < 0.2
  split("1 2 3 4 5 6 7 8 10 12 14 16 20 24", sizes, " ")
  nx = sizes[whole(1, 14)]
  if (is_online) nx = least(nx, is_double ? 8 : is_chained ? 16 : 12)
  ny = whole(1, least(nx, 12))
  nu = whole(1, least(nx > 1 ? int(nx / 2) : 1, 6))
  print "name = \"random_" seed "\"\n[plant]\ndomain = \"discrete\"\nsample_time = 0.01"
  print "A = " matrix(nx, nx, "A") "\nB = " matrix(nx, nu, "B") "\nC = " matrix(ny, nx, "C")
  print "[lqr]\nQ = " list(nx, 1) "\nR = " list(nu, 1) "\ncost = \"discrete\""
  print "[kalman]\nprocess_noise = " list(nx, 0.01) "\nmeasurement_noise = " list(ny, 0.1) "\nnoise = \"discrete\""
  print "gain = \"" (is_online ? "online" : "steady") "\""
  if (is_online) print "covariance = \"" (random() < 0.6 ? "ud" : "plain") "\""
  if (random() < 0.25) print "gate = 0"
  if (random() < 0.6) print "[limits]\nu_min = " list(nu, -1) "\nu_max = " list(nu, 1)
  print "[code]\nflash = 1000000\nreal = \"" (is_double ? "double" : "float") "\""
  print "arithmetic = \"" (random() < 0.3 ? "fused" : "plain") "\""
  print "style = \"" (random() < 0.3 ? "compact" : "unrolled") "\""
}
