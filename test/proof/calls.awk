# NAME.h in, the driver's calls of its functions out: each with anything that its parameters may be. Wants -v name=NAME.

BEGIN { calls = 0 }

function not_understood(what) { print "not understood: " what > "/dev/stderr"; failed = 1; exit 2 }

# Declares what stands for a parameter, and returns how it is passed.
function argument(parameter,   word) {
  gsub(/^ +| +$/, "", parameter)
  if (parameter ~ "^(const )?" name "_t \\*self$") { uses_loop = 1; return "loop" }
  if (parameter == "lqg_status_t status") return "(lqg_status_t)any_count"
  if (parameter ~ /^unsigned long [a-z_]+$/) return "any_count"
  if (parameter ~ /^const (float|double) [a-z0-9_]+$/) return "any_real"
  if (parameter !~ /^(const )?(float|double) [a-zA-Z0-9_]+\[[A-Z0-9_]+\]$/) not_understood(parameter)
  split(parameter, word, /[][ ]+/)
  if (word[1] == "const") { in_arrays = in_arrays "    ANYTHING(" word[3] ", " word[4] ");\n"; return word[3] }
  out_arrays = out_arrays "    lqg_real " word[2] "[" word[3] "];\n"
  if (word[2] == "u") gives_input = 1
  return word[2]
}

function write_call(prototype,   call, list, count, parameter, i) {
  call = prototype
  sub(/\(.*/, "", call)
  sub(/.* /, "", call)
  list = prototype
  sub(/^[^(]*\(/, "", list)
  sub(/\).*/, "", list)
  count = split(list, parameter, ",")
  in_arrays = out_arrays = passed = ""
  gives_input = uses_loop = 0
  for (i = 1; i <= count; i++) passed = passed (i > 1 ? ", " : "") argument(parameter[i])
  print "\nstatic void call_" calls "(LOOP)\n{"
  printf "%s%s", out_arrays, in_arrays
  if (!uses_loop) print "    (void)loop;"
  print "    " call "(" passed ");"
  if (gives_input) print "    look_at_input(u);"
  if (call == name "_predict" || call == name "_step") print "    LOOK_AT_COVARIANCE(loop);"
  print "    /*@ slevel merge; */ ;\n    /*@ check " call "_returns: \\true; */ ;\n}"
  calls++
}

# A product with rows of A is a part of the prediction, which is called.
$0 ~ "^static inline (lqg_status_t|void) " name "_[a-z0-9_]+\\(" && $0 !~ name "_multiply_[0-9]+\\(" ||
  $0 ~ "^static lqg_status_t " name "_reset\\(" { prototype = " " }

prototype {
  prototype = prototype " " $0
  if ($0 ~ /\)$/) { write_call(prototype); prototype = "" }
}

END {
  if (failed) exit 2
  if (!calls) not_understood("a header without functions")
  print "\nenum { CALLS = " calls " };\n"
  print "/* One of the calls. */\nstatic void call_any(LOOP)\n{\n    const int call = any_int;"
  for (i = 0; i < calls; i++) print "    if (call == " i ")\n        call_" i "(loop);"
  print "}"
}
