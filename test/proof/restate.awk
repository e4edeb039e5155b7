# An emitted header in, the same header for the prover out:
#   v - v == 0            becomes FINITE(v)
#   fabs(v) < limit       becomes BELOW(v, limit)
#   u[i] = …              ends the paths that led there: its range is what counts
#   a test of a sum       becomes a test of each of its terms, in the places where they were stored, which may fail in any case

function not_understood() { print "not understood: " $0 > "/dev/stderr"; exit 1 }

function add_place(value, where) { places[value] = places[value] " " where }

# The exponent of a literal that is a power of two.
function exponent_of(literal,   e) {
  e = int(log(literal + 0) / log(2) + (literal + 0 < 1 ? -0.5 : 0.5))
  if (literal / 2 ^ e > 1.000001 || literal / 2 ^ e < 0.999999) not_understood()
  return e
}

# v, and where it was stored, are below 2^exponent, or finite for the exponent "any".
function small(v, exponent,   all, i, count, where) {
  all = exponent == "any" ? "FINITE(" v ")" : "BELOW(" v ", 0x1p" exponent ")"
  count = split(places[v], where, " ")
  for (i = 1; i <= count; i++) all = all " && " (exponent == "any" ? "FINITE(" where[i] ")" : "BELOW(" where[i] ", 0x1p" exponent ")")
  return all
}

# The terms of a sum of numbers that have to be finite; v is made of two values, one of them perhaps a sum.
function finite_terms(v) {
  if (v in square_of || v in size_of) return small_terms(v, "any")
  return v in left ? finite_terms(left[v]) " && " finite_terms(right[v]) : small(v, "any")
}

# The terms of a sum below 2^exponent: squares and sizes, none of them negative. What was added before counts in units of its own.
function small_terms(v, exponent,   before) {
  before = v in summed ? small_terms(summed[v], exponent == "any" ? "any" : exponent - shift[v]) " && " : ""
  if (v in square_of) return before small(square_of[v], exponent == "any" ? "any" : exponent / 2)
  return before small(size_of[v], exponent)
}

/^static / {
  split("", left); split("", right); split("", places)
  split("", square_of); split("", size_of); split("", summed); split("", shift)
}

# sum = before + v * v, where before may be scaled, or fma(v, v, before), or before + fabs(v)
/const (float|double) sum[a-z0-9_]* = / {
  name = $3
  text = $0
  sub(/^[^=]*= /, "", text)
  sub(/;.*/, "", text)
  if (match(text, /^fmaf?\(/)) {
    sub(/^fmaf?\(/, "", text)
    sub(/\)$/, "", text)
    split(text, part, ", ")
    text = part[3] " + " part[1] " * " part[2]
  }
  count = split(text, part, " \\+ ")
  if (count == 2) {
    shift[name] = 0
    if (split(part[1], factor, " \\* ") == 2) { shift[name] = exponent_of(factor[1]); part[1] = factor[2] }
    summed[name] = part[1]
  }
  if (part[count] ~ /^fabsf?\(/) { sub(/^fabsf?\(/, "", part[count]); sub(/\)$/, "", part[count]); size_of[name] = part[count] }
  else if (split(part[count], factor, " \\* ") == 2 && factor[1] == factor[2]) square_of[name] = factor[1]
  else not_understood()
}

/const (float|double) others[a-z0-9_]* = [a-zA-Z0-9_]+ \+ [a-zA-Z0-9_]+;/ {
  left[$3] = $5
  right[$3] = $7
  sub(/;/, "", right[$3])
}

/self->[a-zA-Z_]+\[[0-9]+\] = [a-zA-Z0-9_]+;/ {
  fields = split($0, word, /[ ;]+/)
  for (i = 1; i <= fields; i++) if (word[i] == "=") add_place(word[i + 1], word[i - 1])
}

# What the emitted functions end with.
match($0, /if \(!\([a-z0-9_]+ - [a-z0-9_]+ < [^ ]+ - sum[a-z0-9_]*\)\)/) || match($0, /if \(!\(sum[a-z0-9_]* < [^ )]+\)\)/) ||
match($0, /if \(!\([a-z0-9_]+ - [a-z0-9_]+ == 0\.0f?\)\)/) {
  text = substr($0, RSTART + 6, RLENGTH - 8)
  split(text, word, " ")
  if (text ~ /^sum[a-z0-9_]* </) all = small_terms(word[1], exponent_of(word[3]))
  else if (text ~ / < .* - sum/) all = finite_terms(word[1]) " && " small_terms(word[7], exponent_of(word[5]))
  else all = finite_terms(word[1])
  print "    if (!any_int) { if (!(" all ")) stop(); } else"
  next
}

{
  while (match($0, /fabsf?\([a-zA-Z0-9_]+\) < [0-9.e+]+f?/)) {
    split(substr($0, RSTART, RLENGTH), word, /[() ]+/)
    $0 = substr($0, 1, RSTART - 1) "BELOW(" word[2] ", " word[4] ")" substr($0, RSTART + RLENGTH)
  }
  while (match($0, /[a-zA-Z0-9_]+ - [a-zA-Z0-9_]+ == 0\.0f?/)) {
    split(substr($0, RSTART, RLENGTH), word, " ")
    if (word[1] != word[3]) not_understood()
    $0 = substr($0, 1, RSTART - 1) "FINITE(" word[1] ")" substr($0, RSTART + RLENGTH)
  }
  if ($0 ~ / - [a-zA-Z0-9_]+ (==|<) / || $0 ~ /fabsf?\([^)]*\) </) not_understood()
  print
  if ($0 ~ /^    u\[[0-9]+\] = /) print "    /*@ slevel merge; */ ;"
}
