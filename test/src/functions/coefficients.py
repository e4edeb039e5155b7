#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes include/lqg/functions_polynomials.h, by Sollya (Debian: sollya).

    coefficients.py            prints it
    coefficients.py --check    whether the header is this; exit status 1: it is not
    coefficients.py --update   writes it

Sollya's fpminimax finds polynomials whose coefficients are floats or doubles to begin with: nothing is rounded
afterwards. The error is that of the polynomial in exact arithmetic, relative to the function. Exit status 3: no Sollya.
"""

import math
import pathlib
import re
import shutil
import subprocess
import sys

HEADER = pathlib.Path(__file__).resolve().parents[3] / "include" / "lqg" / "functions_polynomials.h"
TEXT = """/* SPDX-License-Identifier: MIT */
/* TinyLQG: the polynomials of elementary functions, made by test/src/functions/coefficients.py. Each has the least
 * largest relative error of those whose coefficients are numbers of its type; the errors are those of exact
 * arithmetic. */
#ifndef LQG_FUNCTIONS_POLYNOMIALS_H
#define LQG_FUNCTIONS_POLYNOMIALS_H

#include "lqg/arithmetic.h"
#include "lqg/functions_bits.h"

LQG_STRICT_BEGIN

{of_float}

#if LQG_HAS_DOUBLE
{of_double}
#endif

LQG_STRICT_END

#endif
"""

# Of each polynomial: name; what it approximates, over x; its fixed first terms; exponents of the others, for float and
# for double; the interval, for float and for double; what the comment says that P(z) or P(x) is.
SMALL = "2^-60"
# π/4 and a little more; of floats near 8192 the reduction leaves up to 0.7862, where the errors are a tenth larger.
QUARTER = (SMALL, "0.7855")
LN_2 = ("-0.3467", "0.3467")  # halved, likewise
ROOT_2 = ("-0.293", "0.41422")  # √½ … √2, less 1
RATIO = "log((1+x)/(1-x))/x"
OF_Z = "{0} x = x + x z P(z), z = x²"
ROWS = [
    ("sin", "sin(x)/x", "1", range(2, 7, 2), range(2, 13, 2), QUARTER, QUARTER, OF_Z),
    (
        "cos",
        "cos(x)",
        "1-x^2/2",
        range(4, 9, 2),
        range(4, 15, 2),
        QUARTER,
        QUARTER,
        "cos x = 1 − z/2 + z² P(z), z = x²",
    ),
    ("tan", "tan(x)/x", "1", range(2, 15, 2), range(2, 29, 2), QUARTER, QUARTER, OF_Z),
    ("asin", "asin(x)/x", "1", range(2, 13, 2), range(2, 27, 2), (SMALL, "0.5626"), (SMALL, "0.5626"), OF_Z),
    ("atan", "atan(x)/x", "1", range(2, 19, 2), range(2, 21, 2), (SMALL, "1"), (SMALL, "0.3751"), OF_Z),
    ("exp", "exp(x)", "1+x", range(2, 7), range(2, 12), LN_2, LN_2, "exp x = 1 + x + x² P(x)"),
    ("log", "log1p(x)/x", "1-x/2", range(2, 10), None, ROOT_2, None, "log(1 + x) = x − x²/2 + x³ P(x)"),
    ("log", RATIO, "2", None, range(2, 15, 2), None, (SMALL, "0.1717"), "log((1 + x)/(1 − x)) = 2x + x z P(z), z = x²"),
    ("tanh", "tanh(x)/x", "1", range(2, 11, 2), range(2, 21, 2), (SMALL, "0.5501"), (SMALL, "0.5501"), OF_Z),
]


def stop(message, status):
    print(message, file=sys.stderr)
    sys.exit(status)


def coefficients(function, fixed, exponents, interval, number):
    """Of the given exponents; and log2 of the largest relative error."""
    low, high = interval
    program = f"""prec = 200!; verbosity = 0!; f = {function};
        p = fpminimax(f, {listed(exponents)}, {listed([number] * len(exponents))}, [{low}; {high}], {fixed}, relative);
        print(round(log2(dirtyinfnorm(p / f - 1, [{low}; {high}])), 20, RU));
        display = hexadecimal!;
        for i in {listed(exponents)} do print(coeff(p, i));
        quit;
        """
    printed = subprocess.run(["sollya"], input=program, capture_output=True, text=True, check=True).stdout.split()
    if len(printed) != 1 + len(exponents):
        stop(f"not understood: Sollya says {' '.join(printed)} of {function}", 1)
    return [float.fromhex(text) for text in printed[1:]], float(printed[0])


def listed(values):
    return "[|" + ", ".join(str(value) for value in values) + "|]"


def polynomial(row, is_double):
    """The C function, or None where this scalar has no such polynomial."""
    name, function, fixed, *rest, formula = row
    formula = formula.format(name)
    exponents, interval = rest[is_double], rest[2 + is_double]
    if exponents is None:
        return None
    values, error = coefficients(function, fixed, list(exponents), interval, "D" if is_double else "SG")
    scalar, suffix, digits = ("double", "", 17) if is_double else ("float", "f", 9)
    argument = "z" if "z" in formula else "x"

    def literal(value):
        text = f"{value:.{digits}g}"
        return text + ("" if re.search("[.e]", text) else ".0") + suffix

    lines = [f"/* {formula}; off by 2^{math.ceil(error * 10) / 10:.1f}, relative. */".replace("^-", "^−")]
    lines += [f"static inline {scalar} lqg_{name}_polynomial{suffix}({scalar} {argument})", "{", "    LQG_STRICT_BODY"]
    lines.append(f"    {scalar} p = {literal(values[-1])};")
    for value in reversed(values[:-1]):
        lines.append(f"    p = p * {argument} {'-' if value < 0 else '+'} {literal(abs(value))};")
    return "\n".join([*lines, "    return p;", "}"])


def text_of(is_double):
    return "\n\n".join(filter(None, (polynomial(row, is_double) for row in ROWS)))


def main(arguments):
    if arguments not in ([], ["--check"], ["--update"]):
        stop(__doc__, 2)
    if not shutil.which("sollya"):
        stop("Not found: sollya (Debian: sollya)", 3)
    made = TEXT.format(of_float=text_of(False), of_double=text_of(True))
    if not arguments:
        print(made, end="")
    elif arguments == ["--update"]:
        HEADER.write_text(made, encoding="utf-8")
    elif HEADER.read_text(encoding="utf-8") != made:
        stop(f"{HEADER} is not what coefficients.py makes; --update writes it", 1)


main(sys.argv[1:])
