# The deepest reach of the stack below the callers of the functions in `roots`, from the listing of a linked Cortex-M
# program (objdump -d --no-show-raw-insn): what each function pushes and sets aside, and what it calls. A tail call
# comes after the pop. The functions do not call each other in circles.

function hexadecimal(text,    i, value) {
  for (i = 1; i <= length(text); i++) value = 16 * value + index("0123456789abcdef", substr(text, i, 1)) - 1
  return value
}

# Of "{r4, r6-r8, lr}".
function registers_in(text,    list, parts, ends, count, i) {
  list = text
  sub(/.*\{/, "", list)
  sub(/\}.*/, "", list)
  count = 0
  for (i = split(list, parts, ","); i > 0; i--) {
    gsub(/[a-z ]/, "", parts[i])
    count += split(parts[i], ends, "-") == 2 ? ends[2] - ends[1] + 1 : 1
  }
  return count
}

function number_behind(text, sign) {
  sub(".*" sign, "", text)
  return text + 0
}

function depth(f,    i, callee, below, deepest) {
  if (f in known) return known[f]
  deepest = frame[f]
  for (i = 1; i <= calls[f]; i++) {
    callee = owner[target[f, i]]
    if (callee == "" || callee == f) continue
    below = depth(callee) + (returns[f, i] ? frame[f] : 0)
    if (below > deepest) deepest = below
  }
  return known[f] = deepest
}

/^[0-9a-f]+ <.*>:$/ {
  current = $1
  name[current] = substr($2, 2, length($2) - 3)
  frame[current] = 0
  next
}

/^ *[0-9a-f]+:\t/ {
  split($0, columns, "\t")
  place = columns[1]
  gsub(/[ :]/, "", place)
  owner[hexadecimal(place)] = current
  operation = columns[2]
  gsub(/ /, "", operation)
  operands = columns[3]
  sub(/[@;].*/, "", operands)
  if (operation == "push" || (operation == "stmdb" && operands ~ /^sp!/)) frame[current] += 4 * registers_in(operands)
  else if (operation == "vpush") frame[current] += (operands ~ /\{d/ ? 8 : 4) * registers_in(operands)
  else if (operation ~ /^(str|str\.w|strd)$/ && operands ~ /\[sp, #-[0-9]+\]!/)
    frame[current] += number_behind(operands, "#-")
  else if (operation ~ /^sub(\.w|w)?$/ && operands ~ /^sp, (sp, )?#/) frame[current] += number_behind(operands, "#")
  else if (operation ~ /^b/ && operands ~ /^[0-9a-f]+ </) {
    split(operands, parts, " ")
    calls[current]++
    target[current, calls[current]] = hexadecimal(parts[1])
    returns[current, calls[current]] = operation ~ /^blx?$/
  }
}

END {
  for (f in name)
    if (index(" " roots " ", " " name[f] " ") && depth(f) > most) most = depth(f)
  print most + 0
}
