# An emitted header in, the same header for the prover out:
#   v - v == 0            becomes FINITE(v)
#   u[i] = …              ends the paths that led there: its range is what counts
#   a test of a sum       becomes a test of each of its terms, in the places where they were stored, which may fail in any case

function add_place(value, where) { places[value] = places[value] " && FINITE(" where ")" }

# The terms of sum v, which is made of two values, one of them perhaps a sum.
function terms(v) {
  if (v in left) return terms(left[v]) " && " terms(right[v])
  return "FINITE(" v ")" places[v]
}

# The terms of the sum that a loop has made, and the arrays to which it has copied them.
function summed_arrays(   name, all) {
  all = "any_int"
  for (name in bound_of) all = all " && perhaps_all_finite(" name ", " bound_of[name] ")" copies[name]
  return all
}

/^static / { split("", left); split("", right); split("", places); split("", bound_of); split("", copies) }

/const (float|double) sum[a-z0-9_]* = [a-zA-Z0-9_]+ \+ [a-zA-Z0-9_]+;/ {
  fields = split($0, word, /[ ;]+/)
  for (i = 1; i <= fields; i++)
    if (word[i] == "=") { left[word[i - 1]] = word[i + 1]; right[word[i - 1]] = word[i + 3] }
}

/self->[a-zA-Z_]+\[[0-9]+\] = [a-zA-Z0-9_]+;/ {
  fields = split($0, word, /[ ;]+/)
  for (i = 1; i <= fields; i++) if (word[i] == "=") add_place(word[i + 1], word[i - 1])
}

match($0, /i < [A-Z0-9_]+; i\+\+/) { bound = substr($0, RSTART + 4, RLENGTH - 9) }
match($0, /sum \+= [a-z_]+\[i\];/) { bound_of[substr($0, RSTART + 7, RLENGTH - 11)] = bound }
/self->[a-zA-Z_]+\[.*\] = [a-z_]+\[.*\];/ {
  member = $0
  sub(/^ */, "", member)
  sub(/\[.*/, "", member)
  name = $0
  sub(/.*= /, "", name)
  sub(/\[.*/, "", name)
  copies[name] = copies[name] " && perhaps_all_finite(" member ", sizeof " member " / sizeof *" member ")"
}

/if \(!\(sum[a-z0-9_]* - sum[a-z0-9_]* == 0\.0f?\)\)/ {
  match($0, /sum[a-z0-9_]*/)
  print "    if (any_int || !(" terms(substr($0, RSTART, RLENGTH)) "))"
  next
}

{
  if (match($0, /sum - sum == 0\)/))
    $0 = substr($0, 1, RSTART - 1) "(" summed_arrays() "))" substr($0, RSTART + RLENGTH)
  while (match($0, /[a-zA-Z0-9_]+ - [a-zA-Z0-9_]+ == 0\.0f?/)) {
    split(substr($0, RSTART, RLENGTH), word, " ")
    if (word[1] != word[3]) { print "not understood: " $0 > "/dev/stderr"; exit 1 }
    $0 = substr($0, 1, RSTART - 1) "FINITE(" word[1] ")" substr($0, RSTART + RLENGTH)
  }
  if ($0 ~ / - [a-zA-Z0-9_]+ == 0/) { print "not understood: " $0 > "/dev/stderr"; exit 1 }
  print
  if ($0 ~ /^    u\[[0-9]+\] = /) print "    /*@ slevel merge; */ ;"
}
