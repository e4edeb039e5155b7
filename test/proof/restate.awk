# An emitted header in, the same header for the prover out:
#   v - v == 0            becomes FINITE(v)
#   u[i] = …              ends the paths that led there: its range is what counts
#   a test of a sum       becomes a test of each of its terms, in the place where it was stored, which may fail in any case
function terms(v) {
  if (v in left) return terms(left[v]) " && " terms(right[v])
  return "FINITE(" (v in place ? place[v] : v) ")"
}

/^static / { split("", left); split("", right); split("", place) }

/const (float|double) sum[a-z0-9_]* = [a-zA-Z0-9_]+ \+ [a-zA-Z0-9_]+;/ {
  fields = split($0, word, /[ ;]+/)
  for (i = 1; i <= fields; i++)
    if (word[i] == "=") { left[word[i - 1]] = word[i + 1]; right[word[i - 1]] = word[i + 3] }
}

/self->[a-zA-Z_]+\[[0-9]+\] = [a-zA-Z0-9_]+;/ {
  fields = split($0, word, /[ ;]+/)
  for (i = 1; i <= fields; i++) if (word[i] == "=") place[word[i + 1]] = word[i - 1]
}

/if \(!\(sum[a-z0-9_]* - sum[a-z0-9_]* == 0\.0f?\)\)/ {
  match($0, /sum[a-z0-9_]*/)
  print "    if (any_int || !(" terms(substr($0, RSTART, RLENGTH)) "))"
  next
}

{
  while (match($0, /[a-zA-Z0-9_]+ - [a-zA-Z0-9_]+ == 0\.0f?/)) {
    split(substr($0, RSTART, RLENGTH), word, " ")
    if (word[1] != word[3]) { print "not understood: " $0 > "/dev/stderr"; exit 1 }
    $0 = substr($0, 1, RSTART - 1) "FINITE(" word[1] ")" substr($0, RSTART + RLENGTH)
  }
  print
  if ($0 ~ /^    u\[[0-9]+\] = /) print "    /*@ slevel merge; */ ;"
}
